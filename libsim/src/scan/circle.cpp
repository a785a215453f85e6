// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/scan/circle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "scan/scan_job.h"
#include "sim/core/math.h"
#include "sim/scan/cone.h"

namespace sim::scan {

std::optional<Chord> chord_of(const Circle& circle, double x, double y) {
  const double aside_m = x * circle.y_m - y * circle.x_m;
  const double root2 = (circle.radius_m - aside_m) * (circle.radius_m + aside_m);
  if (!(root2 >= 0.0)) return std::nullopt;
  const double middle_m = x * circle.x_m + y * circle.y_m;
  const double half_m = std::sqrt(root2);
  const double distance_m = std::sqrt(circle.x_m * circle.x_m + circle.y_m * circle.y_m);
  const double product = (distance_m - circle.radius_m) * (distance_m + circle.radius_m);
  if (middle_m > 0.0) {
    const double leave_m = middle_m + half_m;
    return Chord{product / leave_m, leave_m};
  }
  const double enter_m = middle_m - half_m;
  return Chord{enter_m, enter_m < 0.0 ? product / enter_m : half_m};
}

double least_range_in_cone_m(std::span<const Circle> circles, const Cone& cone,
                             double range_max_m) {
  double least_m = range_max_m;
  for (const Circle& circle : circles) {
    const Circle from_apex{circle.x_m - cone.x_m, circle.y_m - cone.y_m, circle.radius_m};
    const double distance_m =
        std::sqrt(from_apex.x_m * from_apex.x_m + from_apex.y_m * from_apex.y_m);
    if (distance_m < circle.radius_m || distance_m - circle.radius_m >= least_m) continue;
    // The direction of the centre, counter-clockwise from the middle of the cone.
    const auto [s, c] = math::sin_cos(cone.yaw_rad);
    const double off_rad =
        math::atan2(c * from_apex.y_m - s * from_apex.x_m, c * from_apex.x_m + s * from_apex.y_m);
    const double half_rad = 0.5 * cone.field_of_view_rad;
    if (std::abs(off_rad) <= half_rad) {
      least_m = distance_m - circle.radius_m;
      continue;
    }
    const double side_rad = cone.yaw_rad + std::copysign(half_rad, off_rad);
    const std::optional<Chord> chord =
        chord_of(from_apex, math::cos(side_rad), math::sin(side_rad));
    if (chord && chord->enter_m >= 0.0) least_m = std::min(least_m, chord->enter_m);
  }
  return least_m;
}

namespace detail {
namespace {

// See scan_circle().
template <typename Range>
void lower_to_circle(const ScanJob& job, const Circle& circle, Range* ranges_m) {
  const Circle turned{job.cos_yaw * circle.x_m + job.sin_yaw * circle.y_m,
                      job.cos_yaw * circle.y_m - job.sin_yaw * circle.x_m, circle.radius_m};
  const double distance_m = std::sqrt(turned.x_m * turned.x_m + turned.y_m * turned.y_m);
  if (distance_m < turned.radius_m || distance_m - turned.radius_m >= job.range_max_m) return;
  // The beams between the two tangents, and one more on either side: the chord decides.
  const double middle_rad = math::atan2(turned.y_m, turned.x_m);
  const double half_rad = math::asin(turned.radius_m / distance_m);
  const double center = 0.5 * static_cast<double>(job.beam_count - 1);
  const auto last_beam = static_cast<double>(job.beam_count - 1);
  for (const int turn : {-1, 0, 1}) {
    const double bearing_rad = middle_rad + 2.0 * std::numbers::pi * turn;
    const double first = std::ceil((bearing_rad - half_rad) / job.resolution_rad + center) - 1.0;
    const double last = std::floor((bearing_rad + half_rad) / job.resolution_rad + center) + 1.0;
    if (last < 0.0 || first > last_beam) continue;
    const auto end = static_cast<std::ptrdiff_t>(std::min(last, last_beam)) + 1;
    for (auto beam = static_cast<std::ptrdiff_t>(std::max(first, 0.0)); beam < end; ++beam) {
      const std::optional<Chord> chord =
          chord_of(turned, job.beams[2 * beam], job.beams[2 * beam + 1]);
      if (!chord || chord->enter_m < 0.0) continue;
      ranges_m[beam] = std::min(ranges_m[beam], static_cast<Range>(chord->enter_m));
    }
  }
}

}  // namespace

void scan_circle(const ScanJob& job, const Circle& circle, double* ranges_m) {
  lower_to_circle(job, circle, ranges_m);
}

void scan_circle(const ScanJob& job, const Circle& circle, float* ranges_m) {
  lower_to_circle(job, circle, ranges_m);
}

}  // namespace detail
}  // namespace sim::scan
