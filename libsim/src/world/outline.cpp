// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace sim {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Twice the signed area of the triangle abc: positive if c is to the left of the line from a to b.
double side(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

// Whether a point that is in line with a and b lies between them, or is one of them.
bool is_between(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (p.array() >= a.cwiseMin(b).array()).all() && (p.array() <= a.cwiseMax(b).array()).all();
}

// Whether the segments ab and cd have a point in common.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double c_side = side(a, b, c);
  const double d_side = side(a, b, d);
  const double a_side = side(c, d, a);
  const double b_side = side(c, d, b);
  if (((c_side > 0.0 && d_side < 0.0) || (c_side < 0.0 && d_side > 0.0)) &&
      ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0))) {
    return true;
  }
  return (c_side == 0.0 && is_between(a, b, c)) || (d_side == 0.0 && is_between(a, b, d)) ||
         (a_side == 0.0 && is_between(c, d, a)) || (b_side == 0.0 && is_between(c, d, b));
}

// Whether the triangle at vertex i can be cut off: it turns left, and no other vertex lies in it.
bool is_ear(const Polygon& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vec2& a = outline[(i + n - 1) % n];
  const Vec2& b = outline[i];
  const Vec2& c = outline[(i + 1) % n];
  if (side(a, b, c) <= 0.0) return false;
  return std::none_of(outline.begin(), outline.end(), [&](const Vec2& p) {
    if (p == a || p == b || p == c) return false;
    return side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
  });
}

// Two polygons as one, without straight angles, if they have a side in common; otherwise empty.
Polygon joined_at_side(const Polygon& a, const Polygon& b) {
  constexpr double kStraight_rad = 1e-6;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a[i] != b[(k + 1) % b.size()] || a[(i + 1) % a.size()] != b[k]) continue;
      Polygon joined;
      for (std::size_t n = 1; n < a.size(); ++n) joined.push_back(a[(i + n) % a.size()]);
      for (std::size_t n = 1; n < b.size(); ++n) joined.push_back(b[(k + n) % b.size()]);
      std::erase_if(joined, [corners = joined](const Vec2& corner) {
        const auto at = std::find(corners.begin(), corners.end(), corner) - corners.begin();
        const auto n = static_cast<std::ptrdiff_t>(corners.size());
        const Vec2 before = corner - corners[static_cast<std::size_t>((at + n - 1) % n)];
        const Vec2 after = corners[static_cast<std::size_t>((at + 1) % n)] - corner;
        return std::abs(math::atan2(cross(before, after), before.dot(after))) < kStraight_rad;
      });
      return joined;
    }
  }
  return {};
}

}  // namespace

double area_m2(const Polygon& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  return 0.5 * twice;
}

bool is_convex(const Polygon& outline) {
  const std::size_t n = outline.size();
  double turned_rad = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outline[(i + 1) % n] - outline[i];
    const Vec2 after = outline[(i + 2) % n] - outline[(i + 1) % n];
    const double turn_rad = math::atan2(cross(before, after), before.dot(after));
    if (turn_rad < 1e-6) return false;
    turned_rad += turn_rad;
  }
  return turned_rad < 2.0 * std::numbers::pi + 1e-6;
}

double least_extent_m(const Polygon& outline) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 side = outline[(i + 1) % outline.size()] - outline[i];
    double across_m = 0.0;
    for (const Vec2& vertex : outline) {
      across_m = std::max(across_m, cross(side, vertex - outline[i]) / side.norm());
    }
    least_m = std::min({least_m, side.norm(), across_m});
  }
  return least_m;
}

std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(const Polygon& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % n];
    // The next side must not fold back onto this one.
    const Vec2& after = outline[(i + 2) % n];
    if (side(a, b, after) == 0.0 && (b - a).dot(after - b) < 0.0) {
      return std::pair(std::min(i, (i + 1) % n), std::max(i, (i + 1) % n));
    }
    for (std::size_t k = i + 2; k < n; ++k) {
      if ((k + 1) % n == i) continue;  // it shares a vertex
      if (meet(a, b, outline[k], outline[(k + 1) % n])) return std::pair(i, k);
    }
  }
  return std::nullopt;
}

bool is_inside(const Polygon& outline, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x > p.x()) inside = !inside;
  }
  return inside;
}

std::vector<Polygon> triangles_of(const Polygon& outline) {
  std::vector<Polygon> triangles;
  Polygon rest = outline;
  while (rest.size() > 2) {
    const std::size_t n = rest.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(rest, ear)) ++ear;
    if (ear == n) {
      // Only straight angles are left, except for rounding: cut off the flattest vertex.
      const auto flatness = [&](std::size_t i) {
        return std::abs(side(rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]));
      };
      ear = 0;
      for (std::size_t i = 1; i < n; ++i) {
        if (flatness(i) < flatness(ear)) ear = i;
      }
    } else {
      triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    }
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

Polygon convex_outline(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  Polygon outline;
  const auto half = [&](auto begin, auto end) {
    const std::size_t base = outline.size();
    for (auto point = begin; point != end; ++point) {
      while (outline.size() >= base + 2 &&
             turn(outline[outline.size() - 2], outline.back(), *point) <= 1e-12) {
        outline.pop_back();
      }
      outline.push_back(*point);
    }
    if (!outline.empty()) outline.pop_back();  // it begins the other half
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  constexpr double kNear_m = 0.002;
  for (bool changed = true; changed && outline.size() > 3;) {
    changed = false;
    for (std::size_t i = 0; i < outline.size() && outline.size() > 3; ++i) {
      const std::size_t n = outline.size();
      const Vec2& before = outline[(i + n - 1) % n];
      const Vec2& after = outline[(i + 1) % n];
      const bool near = (outline[i] - before).norm() < kNear_m;
      const bool straight = turn(before, outline[i], after) <
                            1e-4 * (outline[i] - before).norm() * (after - outline[i]).norm();
      if (!near && !straight) continue;
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
      break;
    }
  }
  return outline;
}

std::vector<Polygon> convex_parts_of(const Polygon& outline, std::size_t most_corners) {
  std::vector<Polygon> parts = triangles_of(outline);
  const auto join_two = [&] {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t k = i + 1; k < parts.size(); ++k) {
        Polygon joined = joined_at_side(parts[i], parts[k]);
        if (joined.empty() || joined.size() > most_corners || !is_convex(joined)) continue;
        parts[i] = std::move(joined);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
        return true;
      }
    }
    return false;
  };
  while (join_two()) {
  }
  return parts;
}

void make_circle(ObstacleDescription& obstacle, double radius_m) {
  obstacle.shape = ObstacleShape::kCircle;
  obstacle.size = Vec2::Constant(2.0 * radius_m);
  obstacle.outline.clear();
}

void make_polygon(ObstacleDescription& obstacle, Polygon outline) {
  if (area_m2(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const Vec2& vertex : outline) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  obstacle.shape = ObstacleShape::kPolygon;
  obstacle.size = high - low;
  obstacle.outline = std::move(outline);
}

void resize(ObstacleDescription& obstacle, const Vec2& size_m) {
  const Vec2 factor = size_m.cwiseQuotient(obstacle.size);
  for (Vec2& vertex : obstacle.outline) vertex = vertex.cwiseProduct(factor);
  obstacle.size = size_m;
}

Polygon corners_of(const ObstacleDescription& obstacle) {
  if (obstacle.shape == ObstacleShape::kBox) return box_corners(obstacle);
  const Pose X_WO = pose_of(obstacle);
  Polygon corners;
  corners.reserve(obstacle.outline.size());
  for (const Vec2& vertex : obstacle.outline) corners.push_back(X_WO * vertex);
  return corners;
}

Polygon outline_of(const ObstacleDescription& obstacle, double tolerance_m) {
  if (obstacle.shape != ObstacleShape::kCircle) return corners_of(obstacle);
  constexpr double kMostVertices = 720.0;
  const double r = radius_m(obstacle);
  // A chord is r (1 - cos(half angle)) away from the middle of its arc.
  const double half_rad = math::acos(std::clamp(1.0 - tolerance_m / r, 0.0, 1.0));
  const int count = static_cast<int>(
      std::clamp(std::ceil(std::numbers::pi / std::max(half_rad, 1e-6)), 12.0, kMostVertices));
  Polygon outline;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / count;
    outline.push_back(obstacle.center + r * unit_vector(angle_rad));
  }
  return outline;
}

}  // namespace sim
