// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/pose.h"

namespace playpen::grade {

/// The true trajectory of a robot. All lists have one value per row of trajectory.csv.
struct Trajectory {
  std::string robot;
  std::vector<double> time_s;  ///< simulated, never decreasing
  std::vector<sim::Pose> X_WB;
  std::vector<double> v_mps;
  std::vector<double> omega_radps;
};

/// Reads a trajectory.csv from a result folder (docs/start_here.md). An incomplete last row, as a
/// program leaves that is killed while it writes, is ignored.
/// @return one trajectory per robot, in the order of their first rows; at least one.
/// @throws std::runtime_error naming file and line, the expected content and the actual content.
[[nodiscard]] std::vector<Trajectory> read_trajectories(const std::filesystem::path& file);

}  // namespace playpen::grade
