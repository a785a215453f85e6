// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/feasible_twist.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/core/math.h"

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
    const double length = math::hypot(nx, ny);
    // Neither driving nor turning can push against such a contact (its normal runs along the axle
    // through B), so it constrains nothing.
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

Twist feasible_planar_twist(const Twist& target, double mass_kg, double inertia_kgm2,
                            const std::vector<TwistConstraint>& constraints) {
  // In the scaled space (sqrt(m) v, sqrt(m) lateral, sqrt(I) omega), the cost is the squared
  // distance.
  using Eigen::Vector3d;
  const Vector3d scale(std::sqrt(mass_kg), std::sqrt(mass_kg), std::sqrt(inertia_kgm2));
  struct Plane {
    Vector3d normal;  // of unit length
    double limit;
  };
  std::vector<Plane> planes;
  planes.reserve(constraints.size());
  for (const TwistConstraint& c : constraints) {
    const Vector3d normal = Vector3d(c.along, c.sideways, c.turning).cwiseQuotient(scale);
    const double length = normal.norm();
    if (length < 1e-12) continue;
    planes.push_back({normal / length, c.limit / length});
  }
  const auto allowed = [&planes](const Vector3d& p) {
    return std::all_of(planes.begin(), planes.end(), [&p](const Plane& plane) {
      return plane.normal.dot(p) <= plane.limit + kTolerance;
    });
  };

  const Vector3d wanted =
      Vector3d(target.v_mps, target.lateral_mps, target.omega_radps).cwiseProduct(scale);
  if (allowed(wanted)) return target;

  Vector3d best = Vector3d::Zero();
  const auto consider = [&](const Vector3d& p) {
    if ((p - wanted).squaredNorm() < (best - wanted).squaredNorm() && allowed(p)) best = p;
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Plane& a = planes[i];
    const double excess_a = a.normal.dot(wanted) - a.limit;
    if (excess_a > 0.0) consider(wanted - excess_a * a.normal);
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Plane& b = planes[j];
      // The nearest point at which both constraints hold with equality: a combination of the two
      // normals.
      const double cosine = a.normal.dot(b.normal);
      const double det = 1.0 - cosine * cosine;
      if (det < 1e-9) continue;
      const double excess_b = b.normal.dot(wanted) - b.limit;
      consider(wanted - ((excess_a - cosine * excess_b) / det) * a.normal -
               ((excess_b - cosine * excess_a) / det) * b.normal);
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        Eigen::Matrix3d normals;
        normals << a.normal.transpose(), b.normal.transpose(), planes[k].normal.transpose();
        if (std::abs(normals.determinant()) < 1e-9) continue;
        consider(normals.inverse() * Vector3d(a.limit, b.limit, planes[k].limit));
      }
    }
  }
  best = best.cwiseQuotient(scale);
  return {best.x(), best.z(), best.y()};
}

Twist feasible_share(const Twist& target, const std::vector<TwistConstraint>& constraints) {
  double share = 1.0;
  for (const TwistConstraint& c : constraints) {
    const double closing_mps =
        c.along * target.v_mps + c.sideways * target.lateral_mps + c.turning * target.omega_radps;
    if (closing_mps > c.limit) share = std::min(share, c.limit / closing_mps);
  }
  return {share * target.v_mps, share * target.omega_radps, share * target.lateral_mps};
}

}  // namespace sim
