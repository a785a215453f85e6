// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/pose.h"

namespace sim::scan {

/// The edges that a scan may meet, as arrays, in the sensor's neighbourhood.
///
/// Each edge runs from (x0, y0) to (x1, y1) with the solid on its left, so its outer face is on
/// its right; a sensor on the left of it does not see it. Coordinates are relative to the
/// sensor's position, but W-aligned (not turned), [m]. Filled by physics, read by ScanKernel;
/// reused from scan to scan, so that no memory is taken in steady state.
struct EdgeBuffer {
  std::vector<float> x0, y0, x1, y1;
  bool inside = false;  ///< the sensor's origin lies inside a solid: every beam reads 0

  void clear();
  void add(float x0_m, float y0_m, float x1_m, float y1_m);
  [[nodiscard]] std::size_t size() const noexcept { return x0.size(); }
};

/// Directions of a scanner's beams: `beam_count` of them, `resolution_rad` apart, symmetric
/// about forward; beam 0 is the rightmost (least angle).
struct ScanGeometry {
  int beam_count = 682;         ///< >= 1
  double resolution_rad = 0.0;  ///< > 0; (beam_count - 1) * resolution <= 2 pi
  double range_max_m = 5.0;     ///< > 0

  [[nodiscard]] double angle_min_rad() const {
    return -0.5 * resolution_rad * static_cast<double>(beam_count - 1);
  }
  /// Angle of a beam from the sensor's x axis, counter-clockwise [rad].
  [[nodiscard]] double angle_rad(int beam) const {
    return angle_min_rad() + resolution_rad * static_cast<double>(beam);
  }
};

/// Least distance to any edge, for every beam of a scanner at once.
///
/// Edges that face the sensor are swept into the interval of beams they span; each beam keeps
/// the nearest. Work grows with edges + beams covered, not with their product.
/// Result: range in [0, range_max]; range_max where nothing is met. Single precision inside, with
/// an error below 1e-5 m + 1e-6 of the range. The same bits on every x86-64 processor: the
/// wider instruction paths, chosen at run time, do the same operations in the same order.
/// Not thread-safe (scratch memory); one kernel a sensor.
class ScanKernel {
 public:
  explicit ScanKernel(const ScanGeometry& geometry);

  /// @param edges    edges near the sensor, relative to its position, W-aligned [m].
  /// @param yaw_rad  the sensor's heading in W [rad].
  /// @param ranges_m beam_count values out, beam 0 the rightmost [m].
  void scan(const EdgeBuffer& edges, double yaw_rad, std::span<double> ranges_m);

  [[nodiscard]] const ScanGeometry& geometry() const noexcept { return geometry_; }

 private:
  ScanGeometry geometry_;
  std::vector<float> beam_x_, beam_y_;  ///< unit directions in the sensor's frame
  std::vector<float> ranges_;           ///< scratch, one a beam
};

}  // namespace sim::scan
