// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/robot_model.h"

#include <algorithm>

namespace sim {
namespace {

/// All models, in order of name. Settings of their devices are left empty: io fills in the
/// defaults of each type, since the types' settings lie above this layer. Never destroyed:
/// simulations hold pointers to models, and one may still be drawn while the program exits.
const std::vector<RobotModel>& models() {
  static const auto* const all = [] {
    RobotModel s1r = s1r_model();
    for (const char* device : {"laser", "motion", "odometry", "pen", "pose"}) {
      s1r.devices.push_back({device, device, {}});
    }
    return new std::vector<RobotModel>{std::move(s1r)};
  }();
  return *all;
}

}  // namespace

RobotModel s1r_model() {
  RobotModel model;
  model.name = "s1r";
  model.footprint = {{0.087, -0.045}, {0.087, 0.045},   {0.050, 0.081},   {-0.050, 0.081},
                     {-0.087, 0.045}, {-0.087, -0.045}, {-0.050, -0.081}, {0.050, -0.081}};
  return model;
}

const RobotModel* find_robot_model(const std::string& name) {
  const std::vector<RobotModel>& all = models();
  const auto model =
      std::find_if(all.begin(), all.end(), [&name](const RobotModel& m) { return m.name == name; });
  return model == all.end() ? nullptr : &*model;
}

std::vector<std::string> robot_model_names() {
  std::vector<std::string> names;
  for (const RobotModel& model : models()) names.push_back(model.name);
  return names;
}

}  // namespace sim
