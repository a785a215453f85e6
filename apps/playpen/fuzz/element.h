// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace playpen::fuzz {

/// An obstacle that a scenario adds to its world. Its numbers are round, so that people can read
/// them: lengths in centimetres, angles in degrees.
struct Element {
  enum class Shape {
    kBox,
    kCircle,    ///< of the diameter size.x
    kTriangle,  ///< its base is size.x, its height size.y
    kDoor,      ///< a wall of the length size.x and the thickness size.y with an opening
    kCorridor,  ///< two parallel walls of the length size.x and the thickness size.y
  };
  Shape shape = Shape::kBox;
  sim::Vec2 center = sim::Vec2::Zero();  ///< in W [m]
  sim::Vec2 size = {0.1, 0.1};           ///< [m]
  int yaw_deg = 0;
  double opening_m = 0.0;  ///< of a door, in the middle of the wall; between the walls of a
                           ///< corridor [m]
  bool of_map = false;     ///< a wall of a generated map
  bool moves = false;      ///< there and back
  sim::Vec2 goes_to = sim::Vec2::Zero();  ///< if it moves [m]
  double speed_mps = 0.0;                 ///< if it moves [m/s]

  /// Whether it consists of walls with a free space of `opening_m`.
  [[nodiscard]] bool has_opening() const {
    return shape == Shape::kDoor || shape == Shape::kCorridor;
  }
  /// Radius of a circle around its centre that contains it [m].
  [[nodiscard]] double radius_m() const {
    const double across_m = size.y() * (shape == Shape::kCorridor ? 2.0 : 1.0) +
                            (shape == Shape::kCorridor ? opening_m : 0.0);
    return 0.5 * sim::math::hypot(size.x(), across_m);
  }
};

/// A number to a whole number of hundredths.
[[nodiscard]] inline double centimetres(double value) { return std::round(value * 100.0) / 100.0; }

/// Adds an element to a list of obstacles of a world file, as one obstacle or two.
/// @param name  of it; of two obstacles their common beginning.
void add_element(nlohmann::ordered_json& list, const Element& element, const std::string& name);

/// A phrase about an element: "a box of 0.20 m x 0.10 m at (1.2, 0.5)".
[[nodiscard]] std::string text_of(const Element& element);

/// "(1.2, 0.5)".
[[nodiscard]] std::string place_text(const sim::Vec2& place);

}  // namespace playpen::fuzz
