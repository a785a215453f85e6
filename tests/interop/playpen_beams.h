// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Rangers of a robot of Playpen, for the programs of this folder that link the simulator.
#pragma once

#include <string>
#include <vector>

#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/simulation.h"

namespace interop {

/// A ranger of Playpen: where its beams start and what they measure.
struct Beams {
  std::vector<sim::Pose> X_BS;
  std::vector<double> ranges_m;
  std::vector<double> heights_m;  // of each beam
  std::vector<double> ranges_max_m;
  double noise_m = 0.0;
};

inline Beams beams_of(const sim::Simulation& simulation, int robot, const std::string& name) {
  Beams beams;
  const sim::Device& device = simulation.device(robot, simulation.find_device(robot, name).value());
  if (const auto* laser = dynamic_cast<const sim::Laser*>(&device)) {
    const sim::LaserParams& params = laser->params();
    for (int i = 0; i < params.beam_count; ++i) {
      const double angle_rad = params.resolution_rad * (i - 0.5 * (params.beam_count - 1));
      beams.X_BS.push_back(params.X_BL * sim::Pose{0.0, 0.0, angle_rad});
    }
    beams.ranges_m = laser->reading().ranges_m;
    beams.heights_m.assign(beams.ranges_m.size(), params.height_m);
    beams.ranges_max_m.assign(beams.ranges_m.size(), params.range_max_m);
    beams.noise_m = params.noise_m;
  } else if (const auto* ring = dynamic_cast<const sim::Ranger*>(&device)) {
    beams.X_BS = ring->reading().X_BS;
    beams.ranges_m = ring->reading().ranges_m;
    beams.ranges_max_m = ring->params().ranges_max_m;
    if (beams.ranges_max_m.empty()) {
      beams.ranges_max_m.assign(beams.ranges_m.size(), ring->params().range_max_m);
    }
    beams.noise_m = ring->params().noise_m;
    beams.heights_m = ring->params().heights_m;
    if (beams.heights_m.empty()) {
      beams.heights_m.assign(beams.ranges_m.size(), ring->params().height_m);
    }
  }
  return beams;
}

/// Names of a robot's rangers, in the order of their indices.
inline std::vector<std::string> rangers_of(const sim::Simulation& simulation, int robot) {
  const auto& description = simulation.world().robots[static_cast<std::size_t>(robot)];
  const auto found = description.interfaces.find("ranger");
  return found == description.interfaces.end() ? std::vector<std::string>() : found->second;
}

}  // namespace interop
