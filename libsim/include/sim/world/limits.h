// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

/// Sizes and places that a world may have. Physics counts in single precision, 0.25 mm apart at
/// worst for what it keeps apart, so smaller or farther solids cannot be built from it.
namespace sim {

/// The least side of a solid, of a robot's body or of a wheel [m].
inline constexpr double kLeastLength_m = 0.001;

/// The longest side of a floor, and of a box on it [m].
inline constexpr double kGreatestLength_m = 10'000.0;

/// The least mass of a robot [kg].
inline constexpr double kLeastMass_kg = 0.001;
inline constexpr double kGreatestMass_kg = 10'000.0;  ///< the greatest [kg]

/// How far from the origin of W, along x or y, a floor and all that stands on it may reach [m].
inline constexpr double kFarthest_m = 10'000.0;

/// The least side of a solid that reaches so far from the origin of W [m]: kLeastLength_m up to
/// 1 km, then a millionth of the distance, which is ten times what single precision tells apart.
/// @param farthest_m  the greatest coordinate of the solid, without sign.
[[nodiscard]] inline double least_length_m(double farthest_m) {
  return std::max(kLeastLength_m, 1e-6 * farthest_m);
}

}  // namespace sim
