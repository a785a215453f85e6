// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/builtin.h"
#include "sim/io/world_io.h"
#include "sim/simulation/simulation.h"

namespace sim {

WorldDescription load_world(const std::string& path) {
  if (path.empty()) return load_world_text("{\"name\": \"syrotek\"}", "");
  return io::read_world(path, device_types());
}

RobotModel load_model(const std::string& path) {
  return io::read_robot_model(path, device_types());
}

WorldDescription load_world_text(std::string_view text, const std::string& file) {
  return io::read_world_text(text, file, device_types());
}

}  // namespace sim
