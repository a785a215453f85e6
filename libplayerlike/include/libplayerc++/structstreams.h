// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "libplayerc/playerc.h"
#include "libplayerinterface/player.h"

// Stream operators of Player's data types, in Player's format: all fields on one line, separated by
// commas. A device is printed as interface, index and driver.
namespace std {
std::ostream& operator<<(std::ostream& os, const player_point_2d_t& c);
std::ostream& operator<<(std::ostream& os, const player_point_3d_t& c);
std::ostream& operator<<(std::ostream& os, const player_orientation_3d_t& c);
std::ostream& operator<<(std::ostream& os, const player_pose2d_t& c);
std::ostream& operator<<(std::ostream& os, const player_pose3d_t& c);
std::ostream& operator<<(std::ostream& os, const player_bbox2d_t& c);
std::ostream& operator<<(std::ostream& os, const player_bbox3d_t& c);
std::ostream& operator<<(std::ostream& os, const player_segment_t& c);
std::ostream& operator<<(std::ostream& os, const player_extent2d_t& c);
std::ostream& operator<<(std::ostream& os, const playerc_device_info_t& c);
}  // namespace std
