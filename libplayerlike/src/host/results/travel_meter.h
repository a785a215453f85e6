// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "sim/core/pose.h"

namespace playerlike {

/// Measures how far a robot has got. Unlike the length of its path, both measures ignore movements
/// on the spot.
///
/// Jumps, such as those of a robot that a trap puts back to its start, add no distance.
class TravelMeter {
 public:
  /// Length of the straight moves that distance_m() adds up [m].
  static constexpr double kMove_m = 0.25;
  /// Side of the squares that visited_area_m2() counts [m].
  static constexpr double kSquare_m = 0.25;

  /// Notes where the robot is after a step.
  /// @param path_length_m  length of its path so far; it does not grow by a jump.
  void observe(const sim::Vec2& place, double path_length_m);

  /// Sum of straight moves of at least kMove_m each: from the start to the first place that is that
  /// far from it, and so on from there [m].
  [[nodiscard]] double distance_m() const noexcept { return distance_m_; }
  /// Area of the squares, on a grid from the world's origin, in which the centre of the robot's
  /// axle has been [m^2].
  [[nodiscard]] double visited_area_m2() const noexcept {
    return static_cast<double>(visited_.size()) * kSquare_m * kSquare_m;
  }

 private:
  std::optional<sim::Vec2> last_;
  sim::Vec2 anchor_ = sim::Vec2::Zero();  ///< where the present move began
  double last_path_m_ = 0.0;
  double distance_m_ = 0.0;
  std::pair<std::int64_t, std::int64_t> square_{};
  std::set<std::pair<std::int64_t, std::int64_t>> visited_;
};

}  // namespace playerlike
