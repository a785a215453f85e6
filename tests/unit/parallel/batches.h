// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/parallel/batch.h"

namespace sim::test {

/// Two robots with noisy wheels and lasers of 40 beams in a room with a round block. The world's
/// duration is 1 s.
inline constexpr const char* kRoom = R"({
  "arena": {"size": [4, 3], "obstacles": [
    {"name": "pillar", "shape": "circle", "center": [2, 1.5], "radius": 0.2},
    {"name": "box", "center": [3.2, 2.3], "size": [0.3, 0.5]}]},
  "simulation": {"seed": 7, "duration": 1},
  "robots": [
    {"name": "a", "pose": {"x": 0.6, "y": 1.5}, "devices": {
      "motion": {"slip": 0.1}, "laser": {"beams": 40, "resolution_deg": 6, "noise": 0.01},
      "pose": {}, "pen": {}}},
    {"name": "b", "pose": {"x": 3.2, "y": 0.6, "yaw_deg": 120}, "devices": {
      "motion": {"slip": 0.1}, "laser": {"beams": 40, "resolution_deg": 6}}},
    {"name": "post", "pose": {"x": 0.5, "y": 2.6}, "devices": {"motion": null}}]})";

/// The caller's arrays for a batch, without gaps.
struct Arrays {
  Arrays(int simulations, int robots, int beams)
      : poses(static_cast<std::size_t>(simulations * robots * 3)),
        twists(poses.size()),
        scans(static_cast<std::size_t>(simulations * robots * beams)),
        clearances(static_cast<std::size_t>(simulations * robots)),
        collisions(clearances.size()),
        done(static_cast<std::size_t>(simulations)),
        times(done.size()) {}
  explicit Arrays(const Batch& batch)
      : Arrays(batch.simulations(), batch.robots(), batch.beams()) {}

  [[nodiscard]] BatchObservations out() {
    return {{poses}, {twists}, {scans}, {clearances}, {collisions}, {done}, {times}};
  }
  friend bool operator==(const Arrays&, const Arrays&) = default;

  std::vector<double> poses;
  std::vector<double> twists;
  std::vector<float> scans;
  std::vector<double> clearances;
  std::vector<std::int32_t> collisions;
  std::vector<std::uint8_t> done;
  std::vector<double> times;
};

/// Actions that differ among simulations, robots and calls.
[[nodiscard]] inline std::vector<double> varied_actions(int simulations, int robots, int call) {
  std::vector<double> actions;
  for (int i = 0; i < simulations * robots; ++i) {
    actions.push_back(0.5 * std::cos(0.3 * i + 0.05 * call));
    actions.push_back(2.0 * std::sin(0.7 * i + 0.1 * call));
  }
  return actions;
}

/// Text of the error that f() throws; empty if it throws none.
template <typename F>
[[nodiscard]] std::string error_of(F f) {
  try {
    f();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace sim::test
