// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

/// Limits for sizes and positions in a world. Physics uses single precision, whose spacing is at
/// worst 0.25 mm for the solids it must keep apart, so smaller or more distant solids cannot be
/// simulated.
namespace sim {

/// Minimum side of a solid, of a robot's body or of a wheel [m].
inline constexpr double kLeastLength_m = 0.001;

/// Maximum side of a floor, and of a box on it [m].
inline constexpr double kGreatestLength_m = 10'000.0;

/// Minimum mass of a robot [kg].
inline constexpr double kLeastMass_kg = 0.001;
inline constexpr double kGreatestMass_kg = 10'000.0;  ///< maximum mass of a robot [kg]

/// Maximum height of a robot [m].
inline constexpr double kGreatestRobotHeight_m = 10.0;
/// Maximum number of robots of a world.
inline constexpr std::size_t kMostRobots = 1000;
/// Maximum number of convex parts of a robot's body.
inline constexpr std::size_t kMostBodyParts = 16;
/// Maximum number of superstructures of a robot model.
inline constexpr std::size_t kMostSuperstructures = 32;

/// Maximum number of transducers of an infrared ranger or sonar.
inline constexpr std::size_t kMostTransducers = 1024;

/// Heights that differ by less are equal [m]: sums such as 0.37 - 0.02 + 0.05 + 0.01 and 0.41
/// differ by rounding only.
inline constexpr double kSameHeight_m = 1e-6;

/// Whether a sensor at a height meets a solid that ends there or higher. A solid whose top is
/// exactly at the sensor's height is seen, as in Stage (World::Raytrace() of libstage/world.cc).
[[nodiscard]] inline bool reaches_height(double top_m, double height_m) {
  return top_m > height_m - kSameHeight_m;
}

/// Whether a sensor at a height meets a solid that begins and ends at these heights; both included.
[[nodiscard]] inline bool spans_height(double bottom_m, double top_m, double height_m) {
  return bottom_m < height_m + kSameHeight_m && reaches_height(top_m, height_m);
}

/// Maximum distance from the origin of W, along x or y, of a floor and everything on it [m].
inline constexpr double kFarthest_m = 10'000.0;

/// Minimum side of a solid that reaches this far from the origin of W [m]: kLeastLength_m up to 1
/// km, then a millionth of the distance, which is ten times the resolution of single precision.
/// @param farthest_m  largest absolute coordinate of the solid [m].
[[nodiscard]] inline double least_length_m(double farthest_m) {
  return std::max(kLeastLength_m, 1e-6 * farthest_m);
}

}  // namespace sim
