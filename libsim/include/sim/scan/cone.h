// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/scan/scan_kernel.h"

namespace sim::scan {

/// A cone from a point: what lies within half its angle on either side of where it looks.
struct Cone {
  double x_m = 0.0;                ///< its apex, in the frame of the edges [m]
  double y_m = 0.0;                ///< [m]
  double yaw_rad = 0.0;            ///< where it looks, counter-clockwise from the frame's x axis
  double field_of_view_rad = 0.0;  ///< full angle, [0, pi]; 0: a single ray
};

/// Least distance from a cone's apex to an edge that faces it, within the cone.
///
/// Each edge is clipped to the two half-planes that make the cone; of what is left the point
/// nearest to the apex counts, which nothing can hide: what did would be nearer, and within the
/// cone as well. So the result is exact but for rounding: 1e-15 of the coordinates.
/// A ray meets an edge that begins on its left (or on it) and ends on its right, so that it meets
/// one of two edges that share the bits of a corner.
/// @return [m], in [0, range_max_m]; range_max_m where nothing is met.
/// @note O(edges), a few nanoseconds each. Safe from many threads.
[[nodiscard]] double least_range_in_cone_m(std::span<const Edge> edges, const Cone& cone,
                                           double range_max_m);

/// Edges in columns, so that processors look at several at a time: for many cones over the same
/// edges. Gives the bits that least_range_in_cone_m() of the edges gives.
/// Not thread-safe (scratch memory); clear() keeps the memory.
class EdgeColumns {
 public:
  void clear() noexcept;
  void add(const Edge& edge);
  [[nodiscard]] std::size_t size() const noexcept { return x0_.size(); }

  /// least_range_in_cone_m() of these edges.
  [[nodiscard]] double least_range_in_cone_m(const Cone& cone, double range_max_m);

 private:
  std::vector<double> x0_, y0_, x1_, y1_;
  std::vector<double> within_;  ///< scratch
};

}  // namespace sim::scan
