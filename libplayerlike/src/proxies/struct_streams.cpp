// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/structstreams.h"
#include "proxies/link.h"

namespace std {

std::ostream& operator<<(std::ostream& os, const player_point_2d_t& c) {
  return os << c.px << ", " << c.py;
}

std::ostream& operator<<(std::ostream& os, const player_point_3d_t& c) {
  return os << c.px << ", " << c.py << ", " << c.pz;
}

std::ostream& operator<<(std::ostream& os, const player_orientation_3d_t& c) {
  return os << c.proll << ", " << c.ppitch << ", " << c.pyaw;
}

std::ostream& operator<<(std::ostream& os, const player_pose2d_t& c) {
  return os << c.px << ", " << c.py << ", " << c.pa;
}

std::ostream& operator<<(std::ostream& os, const player_pose3d_t& c) {
  return os << c.px << ", " << c.py << ", " << c.pz << ", " << c.proll << ", " << c.ppitch << ", "
            << c.pyaw;
}

std::ostream& operator<<(std::ostream& os, const player_bbox2d_t& c) {
  return os << c.sw << ", " << c.sl;
}

std::ostream& operator<<(std::ostream& os, const player_bbox3d_t& c) {
  return os << c.sw << ", " << c.sl << ", " << c.sh;
}

std::ostream& operator<<(std::ostream& os, const player_segment_t& c) {
  return os << c.x0 << ", " << c.y0 << ", " << c.x1 << ", " << c.y1;
}

std::ostream& operator<<(std::ostream& os, const player_extent2d_t& c) {
  return os << c.x0 << ", " << c.y0 << ", " << c.x1 << ", " << c.y1;
}

std::ostream& operator<<(std::ostream& os, const playerc_device_info_t& c) {
  const char* name = PlayerCc::interface_name(c.addr.interf);
  return os << (name == nullptr ? "unknown" : name) << ':' << c.addr.index << " (" << c.drivername
            << ')';
}

}  // namespace std
