// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/scan/scan_kernel.h"

namespace sim::scan {

/// A cone from a point: everything within half the opening angle on either side of its direction.
struct Cone {
  double x_m = 0.0;                ///< apex, in the frame of the edges [m]
  double y_m = 0.0;                ///< [m]
  double yaw_rad = 0.0;            ///< direction, counter-clockwise from the frame's x axis
  double field_of_view_rad = 0.0;  ///< full angle, [0, pi]; 0: a single ray
};

/// Least distance within the cone from its apex to an edge that faces the apex.
///
/// Each edge is clipped to the two half-planes that bound the cone, and the nearest point of the
/// rest counts. Nothing can hide that point: an occluder would be nearer and inside the cone as
/// well. So the result is exact except for rounding (1e-15 of the coordinates). A single ray meets
/// an edge that begins on its left (or on it) and ends on its right. Therefore it meets exactly one
/// of two edges that share a corner bit by bit.
/// @return [m], in [0, range_max_m]; range_max_m if nothing is met.
/// @note O(edges), a few nanoseconds each. Thread-safe.
[[nodiscard]] double least_range_in_cone_m(std::span<const Edge> edges, const Cone& cone,
                                           double range_max_m);

/// Edges as columns (structure of arrays), so that vector instructions test several at a time; for
/// many cones over the same edges. The results are bit-identical to least_range_in_cone_m() of the
/// edges. Not thread-safe (scratch memory). clear() keeps the memory.
class EdgeColumns {
 public:
  void clear() noexcept { size_ = 0; }
  void add(const Edge& edge) {
    if (size_ == x0_.size()) grow();
    x0_[size_] = static_cast<double>(edge.x0_m);
    y0_[size_] = static_cast<double>(edge.y0_m);
    x1_[size_] = static_cast<double>(edge.x1_m);
    y1_[size_] = static_cast<double>(edge.y1_m);
    ++size_;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// least_range_in_cone_m() of these edges.
  [[nodiscard]] double least_range_in_cone_m(const Cone& cone, double range_max_m);

 private:
  void grow();

  std::size_t size_ = 0;
  std::vector<double> x0_, y0_, x1_, y1_;  ///< the first size_ of each are in use
  std::vector<double> within_;             ///< scratch
};

}  // namespace sim::scan
