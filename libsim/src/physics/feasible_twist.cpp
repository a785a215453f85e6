// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/feasible_twist.h"

#include <cmath>
#include <cstddef>

namespace sim {
namespace {

// In the scaled plane (sqrt(m) v, sqrt(I) omega) the cost is the squared distance.
struct Point {
  double x, y;
};

struct Line {
  double nx, ny, limit;  // nx x + ny y <= limit, (nx, ny) of unit length
};

constexpr double kTolerance = 1e-9;

bool feasible(const Point& p, const std::vector<Line>& lines) {
  for (const Line& line : lines) {
    if (line.nx * p.x + line.ny * p.y > line.limit + kTolerance) return false;
  }
  return true;
}

double squared_distance(const Point& a, const Point& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

}  // namespace

Twist feasible_twist(const Twist& target, double mass_kg, double inertia_kgm2,
                     const std::vector<TwistConstraint>& constraints) {
  const double sv = std::sqrt(mass_kg);
  const double sw = std::sqrt(inertia_kgm2);
  std::vector<Line> lines;
  lines.reserve(constraints.size());
  for (const TwistConstraint& c : constraints) {
    const double nx = c.along / sv;
    const double ny = c.turning / sw;
    const double length = std::hypot(nx, ny);
    // A contact that neither driving nor turning can push against (a normal along the axle,
    // through its centre) constrains nothing.
    if (length < 1e-12) continue;
    lines.push_back({nx / length, ny / length, c.limit / length});
  }

  const Point wanted{sv * target.v_mps, sw * target.omega_radps};
  if (feasible(wanted, lines)) return target;

  Point best{0.0, 0.0};
  double best_cost = squared_distance(best, wanted);
  const auto consider = [&](const Point& p) {
    const double cost = squared_distance(p, wanted);
    if (cost < best_cost && feasible(p, lines)) {
      best = p;
      best_cost = cost;
    }
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& a = lines[i];
    const double excess = a.nx * wanted.x + a.ny * wanted.y - a.limit;
    if (excess > 0.0) consider({wanted.x - excess * a.nx, wanted.y - excess * a.ny});
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const Line& b = lines[j];
      const double det = a.nx * b.ny - a.ny * b.nx;
      if (std::abs(det) < 1e-9) continue;
      consider({(a.limit * b.ny - b.limit * a.ny) / det, (a.nx * b.limit - b.nx * a.limit) / det});
    }
  }
  return {best.x / sv, best.y / sw, 0.0};
}

}  // namespace sim
