// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/scan/cone.h"

#include <algorithm>
#include <cmath>

namespace sim::scan {
namespace {

// An edge seen from the apex: a left of b if it faces it.
struct Sight {
  double ax, ay, bx, by;
  double cross;  // of a and b: twice the area of the triangle with the apex; < 0 if it faces it
};

Sight sight_of(const Edge& edge, const Cone& cone) {
  Sight s{static_cast<double>(edge.x0_m) - cone.x_m, static_cast<double>(edge.y0_m) - cone.y_m,
          static_cast<double>(edge.x1_m) - cone.x_m, static_cast<double>(edge.y1_m) - cone.y_m,
          0.0};
  s.cross = s.ax * s.by - s.ay * s.bx;
  return s;
}

// Keeps of [t0, t1] the part of an edge where a linear function that is f0 at its begin and f1 at
// its end is not negative.
void clip(double f0, double f1, double& t0, double& t1) {
  if (f0 < 0.0) t0 = std::max(t0, f0 / (f0 - f1));
  if (f1 < 0.0) t1 = std::min(t1, f0 / (f0 - f1));
}

double least_along_ray_m(std::span<const Edge> edges, const Cone& cone, double range_max_m) {
  const double c = std::cos(cone.yaw_rad);
  const double s = std::sin(cone.yaw_rad);
  double least_m = range_max_m;
  for (const Edge& edge : edges) {
    const Sight e = sight_of(edge, cone);
    const double left_of_ray = c * e.ay - s * e.ax;
    const double right_of_ray = s * e.bx - c * e.by;
    if (e.cross >= 0.0 || left_of_ray < 0.0 || right_of_ray <= 0.0) continue;
    least_m = std::min(least_m, -e.cross / (left_of_ray + right_of_ray));
  }
  return least_m;
}

}  // namespace

double least_range_in_cone_m(std::span<const Edge> edges, const Cone& cone, double range_max_m) {
  if (cone.field_of_view_rad <= 0.0) return least_along_ray_m(edges, cone, range_max_m);
  const double half = 0.5 * cone.field_of_view_rad;
  const double lx = std::cos(cone.yaw_rad + half);  // along the cone's left side
  const double ly = std::sin(cone.yaw_rad + half);
  const double rx = std::cos(cone.yaw_rad - half);
  const double ry = std::sin(cone.yaw_rad - half);
  double least_m2 = range_max_m * range_max_m;
  for (const Edge& edge : edges) {
    const Sight e = sight_of(edge, cone);
    const double a_in_left = e.ax * ly - e.ay * lx;  // >= 0: to the right of the left side
    const double b_in_left = e.bx * ly - e.by * lx;
    const double a_in_right = rx * e.ay - ry * e.ax;
    const double b_in_right = rx * e.by - ry * e.bx;
    if (e.cross >= 0.0 || std::max(a_in_left, b_in_left) < 0.0 ||
        std::max(a_in_right, b_in_right) < 0.0) {
      continue;
    }
    double t0 = 0.0;
    double t1 = 1.0;
    clip(a_in_left, b_in_left, t0, t1);
    clip(a_in_right, b_in_right, t0, t1);
    if (t0 > t1) continue;
    const double dx = e.bx - e.ax;
    const double dy = e.by - e.ay;
    const double t = std::min(std::max(-(e.ax * dx + e.ay * dy) / (dx * dx + dy * dy), t0), t1);
    const double x = e.ax + t * dx;
    const double y = e.ay + t * dy;
    least_m2 = std::min(least_m2, x * x + y * y);
  }
  return std::min(std::sqrt(least_m2), range_max_m);
}

}  // namespace sim::scan
