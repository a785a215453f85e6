// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/scan/scan_kernel.h"

namespace playpen::test {

/// Result of the slow reference method for one beam.
struct ReferenceBeam {
  double range_m = 0.0;         ///< range_max if the beam hits nothing
  double corner_off_rad = 4.0;  ///< angle between the beam and the nearest corner of any edge
};

/// A scan by the simplest method: every beam against every edge, in double precision.
///
/// The beam with direction b from the origin intersects the edge from p with direction d where p +
/// s d = r b. With the cross product this gives r = (p x d) / (b x d) and s = (p x b) / (b x d). An
/// edge counts if the origin is strictly on its right (p x d < 0) and 0 <= s <= 1.
/// @param edges    relative to the sensor, W-aligned, with the solid on their left [m].
/// @param yaw_rad  the sensor's heading in W [rad].
[[nodiscard]] inline std::vector<ReferenceBeam> reference_scan(
    std::span<const sim::scan::Edge> edges, const sim::scan::ScanGeometry& geometry,
    double yaw_rad) {
  std::vector<ReferenceBeam> beams(static_cast<std::size_t>(geometry.beam_count));
  for (int i = 0; i < geometry.beam_count; ++i) {
    ReferenceBeam& beam = beams[static_cast<std::size_t>(i)];
    beam.range_m = geometry.range_max_m;
    const double bx = std::cos(geometry.angle_rad(i) + yaw_rad);
    const double by = std::sin(geometry.angle_rad(i) + yaw_rad);
    for (const sim::scan::Edge& edge : edges) {
      const auto px = static_cast<double>(edge.x0_m);
      const auto py = static_cast<double>(edge.y0_m);
      const auto qx = static_cast<double>(edge.x1_m);
      const auto qy = static_cast<double>(edge.y1_m);
      for (const double off : {std::atan2(bx * py - by * px, bx * px + by * py),
                               std::atan2(bx * qy - by * qx, bx * qx + by * qy)}) {
        beam.corner_off_rad = std::fmin(beam.corner_off_rad, std::fabs(off));
      }
      const double dx = qx - px;
      const double dy = qy - py;
      const double turn = bx * dy - by * dx;
      const double facing = px * dy - py * dx;
      if (!(facing < 0.0) || turn == 0.0) continue;
      const double range_m = facing / turn;
      const double part = (px * by - py * bx) / turn;
      if (range_m >= 0.0 && part >= 0.0 && part <= 1.0) {
        beam.range_m = std::fmin(beam.range_m, range_m);
      }
    }
  }
  return beams;
}

}  // namespace playpen::test
