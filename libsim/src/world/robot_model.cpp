// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/robot_model.h"

namespace sim {

RobotModel s1r_model() {
  RobotModel model;
  model.name = "s1r";
  model.description = "The small robot of the SyRoTek arena.";
  model.footprint = {{0.087, -0.045}, {0.087, 0.045},   {0.050, 0.081},   {-0.050, 0.081},
                     {-0.087, 0.045}, {-0.087, -0.045}, {-0.050, -0.081}, {0.050, -0.081}};
  return model;
}

const RobotModel& default_robot_model() {
  // The devices have no settings here: io adds the defaults of each type, since this layer does not
  // know the types' settings. Never destroyed: simulations hold pointers to the model, and one may
  // still be drawn while the program exits.
  static const auto* const model = [] {
    auto* s1r = new RobotModel(s1r_model());
    for (const char* device : {"laser", "motion", "odometry", "pen", "pose"}) {
      s1r->devices.push_back({device, device, {}});
    }
    return s1r;
  }();
  return *model;
}

const RobotModel* find_robot_model(const WorldDescription& world, const std::string& model) {
  const auto own = world.models.find(model);
  if (own != world.models.end()) return own->second.get();
  const RobotModel& fallback = default_robot_model();
  return model == fallback.name ? &fallback : nullptr;
}

}  // namespace sim
