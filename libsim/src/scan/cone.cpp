// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/scan/cone.h"

#include <algorithm>
#include <cmath>

#include "sim/core/math.h"

namespace sim::scan {
namespace {

// The two boundary lines of a cone. For a single ray, both are the ray itself.
struct Sides {
  explicit Sides(const Cone& cone)
      : lx(math::cos(cone.yaw_rad + 0.5 * cone.field_of_view_rad)),
        ly(math::sin(cone.yaw_rad + 0.5 * cone.field_of_view_rad)),
        rx(math::cos(cone.yaw_rad - 0.5 * cone.field_of_view_rad)),
        ry(math::sin(cone.yaw_rad - 0.5 * cone.field_of_view_rad)) {}

  double lx, ly;
  double rx, ry;
};

// The ends of an edge relative to a cone's apex: a, then b.
struct EdgeFromApex {
  double ax, ay, bx, by;

  // Twice the signed area of the triangle with the apex. It is < 0 if the edge faces the apex; a is
  // then to the left of b.
  [[nodiscard]] double cross() const { return ax * by - ay * bx; }
};

// Not negative if an edge that faces the apex may be within the half-planes. Negative for edges
// that do not face it.
double within(const EdgeFromApex& e, const Sides& sides) {
  const double a_in_left = e.ax * sides.ly - e.ay * sides.lx;  // >= 0: right of the left side
  const double b_in_left = e.bx * sides.ly - e.by * sides.lx;
  const double a_in_right = sides.rx * e.ay - sides.ry * e.ax;
  const double b_in_right = sides.rx * e.by - sides.ry * e.bx;
  const double in_left = a_in_left > b_in_left ? a_in_left : b_in_left;
  const double in_right = a_in_right > b_in_right ? a_in_right : b_in_right;
  const double in_both = in_left < in_right ? in_left : in_right;
  return e.cross() < 0.0 ? in_both : -1.0;
}

// Clips [t0, t1] to the part of an edge where a linear function is not negative. f0 and f1 are its
// values at the ends of the edge.
void clip(double f0, double f1, double& t0, double& t1) {
  if (f0 < 0.0) t0 = std::max(t0, f0 / (f0 - f1));
  if (f1 < 0.0) t1 = std::min(t1, f0 / (f0 - f1));
}

// Square of the least distance to an edge for which within() is not negative, at most `least_m2`.
double nearer_m2(const EdgeFromApex& e, const Sides& sides, double least_m2) {
  double t0 = 0.0;
  double t1 = 1.0;
  clip(e.ax * sides.ly - e.ay * sides.lx, e.bx * sides.ly - e.by * sides.lx, t0, t1);
  clip(sides.rx * e.ay - sides.ry * e.ax, sides.rx * e.by - sides.ry * e.bx, t0, t1);
  if (t0 > t1) return least_m2;
  const double dx = e.bx - e.ax;
  const double dy = e.by - e.ay;
  const double foot = -(e.ax * dx + e.ay * dy) / (dx * dx + dy * dy);
  const double t = std::min(std::max(foot, t0), t1);
  const double x = e.ax + t * dx;
  const double y = e.ay + t * dy;
  return std::min(least_m2, x * x + y * y);
}

// Distance along a ray to an edge, if the ray passes between its ends; at most `least_m`.
double nearer_on_ray_m(const EdgeFromApex& e, const Sides& ray, double least_m) {
  const double left_of_ray = ray.rx * e.ay - ray.ry * e.ax;
  const double right_of_ray = ray.ry * e.bx - ray.rx * e.by;
  if (left_of_ray < 0.0 || right_of_ray <= 0.0) return least_m;
  return std::min(least_m, -e.cross() / (left_of_ray + right_of_ray));
}

}  // namespace

double least_range_in_cone_m(std::span<const Edge> edges, const Cone& cone, double range_max_m) {
  EdgeColumns columns;
  for (const Edge& edge : edges) columns.add(edge);
  return columns.least_range_in_cone_m(cone, range_max_m);
}

void EdgeColumns::grow() {
  constexpr std::size_t kLeast = 64;
  const std::size_t room = std::max(kLeast, 2 * size_);
  for (auto* column : {&x0_, &y0_, &x1_, &y1_, &within_}) column->resize(room);
}

double EdgeColumns::least_range_in_cone_m(const Cone& cone, double range_max_m) {
  const Sides sides(cone);
  const std::size_t count = size_;
  const double* const x0 = x0_.data();
  const double* const y0 = y0_.data();
  const double* const x1 = x1_.data();
  const double* const y1 = y1_.data();
  double* const kept = within_.data();
  const auto edge_from_apex = [&](std::size_t i) {
    return EdgeFromApex{x0[i] - cone.x_m, y0[i] - cone.y_m, x1[i] - cone.x_m, y1[i] - cone.y_m};
  };
  // Most edges are outside the cone. This loop has no branches, so compilers can vectorise it.
  for (std::size_t i = 0; i < count; ++i) kept[i] = within(edge_from_apex(i), sides);

  if (cone.field_of_view_rad <= 0.0) {
    double least_m = range_max_m;
    for (std::size_t i = 0; i < count; ++i) {
      if (kept[i] >= 0.0) least_m = nearer_on_ray_m(edge_from_apex(i), sides, least_m);
    }
    return least_m;
  }
  double least_m2 = range_max_m * range_max_m;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept[i] >= 0.0) least_m2 = nearer_m2(edge_from_apex(i), sides, least_m2);
  }
  return std::min(std::sqrt(least_m2), range_max_m);
}

}  // namespace sim::scan
