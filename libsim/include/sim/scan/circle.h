// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

namespace sim::scan {

struct Cone;

/// The outline of a round solid, relative to the sensor's position, with the axes of W (not
/// rotated) [m]. In double precision: ranges of circles are exact except for rounding.
struct Circle {
  double x_m;
  double y_m;
  double radius_m;  ///< > 0
};

/// The part of a line within a circle, as distances along the line from the origin [m].
struct Chord {
  double enter_m;
  double leave_m;  ///< >= enter_m
};

/// The chord that a line through the origin cuts out of a circle; nullopt if the line misses the
/// circle.
///
/// The distances are the roots of |t u - p|^2 = r^2 (Ericson, Real-Time Collision Detection, 2005,
/// sec. 5.3.2). The discriminant is r^2 - (u x p)^2, and the root nearer to the origin is the
/// quotient of the product of the roots and the farther one. Both avoid cancellation, so the error
/// is about 1e-15 of the distances, except for lines that graze the circle.
/// @param x, y  direction u of the line, a unit vector.
[[nodiscard]] std::optional<Chord> chord_of(const Circle& circle, double x, double y);

/// Least distance within a cone from its apex to a circle that does not contain the apex.
///
/// The nearest point of a circle is in the direction of its centre, and points farther from that
/// direction are farther away. So the result is that of the centre's direction if it is within the
/// cone, otherwise that of the nearer side of the cone. The apex of the cone may be anywhere.
/// @return [m], in [0, range_max_m]; range_max_m if nothing is met.
/// @note O(circles). Thread-safe.
[[nodiscard]] double least_range_in_cone_m(std::span<const Circle> circles, const Cone& cone,
                                           double range_max_m);

}  // namespace sim::scan
