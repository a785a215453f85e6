// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/solids.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "io/cross.h"
#include "sim/world/outline.h"

namespace sim::io {
namespace {

/// The interval that a solid covers along a direction.
std::pair<double, double> extent(const Solid& solid, const Vec2& normal) {
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
  for (const Vec2& p : solid.outline) {
    min = std::min(min, normal.dot(p));
    max = std::max(max, normal.dot(p));
  }
  if (!solid.round) return {min, max};
  return {min - solid.radius_m, max + solid.radius_m};
}

/// The shift along a direction that separates two solids; 0 or less if they are apart.
double overlap_along(const Solid& a, const Solid& b, const Vec2& normal) {
  const auto [a_min, a_max] = extent(a, normal);
  const auto [b_min, b_max] = extent(b, normal);
  return std::min(a_max - b_min, b_max - a_min);
}

/// The direction from the nearest vertex of a solid to the centre of a circle.
Vec2 towards(const Solid& circle, const Solid& other) {
  const Vec2 nearest = *std::min_element(
      other.outline.begin(), other.outline.end(), [&circle](const Vec2& p, const Vec2& q) {
        return (p - circle.middle).squaredNorm() < (q - circle.middle).squaredNorm();
      });
  const Vec2 way = circle.middle - nearest;
  return way.isZero(0.0) ? Vec2::UnitX() : Vec2(way.normalized());
}

/// Whether a part of the segment lies inside the convex, counter-clockwise polygon shrunk by
/// kTouching_m (Cyrus-Beck clipping).
bool crosses_polygon(const Polygon& outline, const Vec2& from, const Vec2& to) {
  const Vec2 way = to - from;
  double enter = 0.0;
  double leave = 1.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& corner = outline[i];
    const Vec2 edge = (outline[(i + 1) % outline.size()] - corner).normalized();
    const double depth = cross(edge, from - corner) - kTouching_m;  // > 0: inside this edge
    const double change = cross(edge, way);
    if (change == 0.0) {
      if (depth <= 0.0) return false;
    } else if (change > 0.0) {
      enter = std::max(enter, -depth / change);
    } else {
      leave = std::min(leave, -depth / change);
    }
  }
  return enter < leave;
}

/// Whether a part of the segment lies inside the solid shrunk by kTouching_m.
bool crosses(const Solid& solid, const Vec2& from, const Vec2& to) {
  if (!solid.round) return crosses_polygon(solid.outline, from, to);
  return distance_to_segment_m(solid.middle, from, to) < solid.radius_m - kTouching_m;
}

/// Whether the point lies in the solid of the walls: inside an odd number of loops.
bool in_solid(const std::vector<WallLoop>& walls, const Vec2& p) {
  return std::count_if(
             walls.begin(), walls.end(),
             [&p](const WallLoop& loop) { return loop.solid && is_inside(loop.vertices, p); }) %
             2 ==
         1;
}

}  // namespace

Solid::Solid(Polygon polygon) : outline(std::move(polygon)) {
  for (const Vec2& p : outline) middle += p;
  middle /= static_cast<double>(outline.size());
  for (const Vec2& p : outline) radius_m = std::max(radius_m, (p - middle).norm());
}

Solid::Solid(const Vec2& center, double round_radius_m)
    : outline{center}, middle(center), radius_m(round_radius_m), round(true) {}

Polygon placed(const Polygon& footprint, const Pose& X_WB, double scale) {
  Polygon outline;
  outline.reserve(footprint.size());
  for (const Vec2& p : footprint) outline.push_back(X_WB * Vec2(p * scale));
  return outline;
}

std::vector<Solid> solids_of(const RobotModel& model, const Pose& X_WB) {
  std::vector<Solid> solids;
  for (const Polygon& part : body_parts(model)) solids.emplace_back(placed(part, X_WB));
  return solids;
}

std::vector<Solid> solids_of(const ObstacleDescription& obstacle) {
  if (obstacle.shape == ObstacleShape::kCircle) {
    return {Solid(obstacle.center, radius_m(obstacle))};
  }
  if (obstacle.shape == ObstacleShape::kPolygon) {
    const Polygon corners = corners_of(obstacle);
    if (is_convex(corners)) return {Solid(corners)};
    std::vector<Solid> solids;
    for (Polygon& triangle : triangles_of(corners)) solids.emplace_back(std::move(triangle));
    return solids;
  }
  const Pose X_WO = pose_of(obstacle);
  const Vec2 half = 0.5 * obstacle.size;
  return {Solid({X_WO * Vec2(-half.x(), -half.y()), X_WO * Vec2(half.x(), -half.y()),
                 X_WO * Vec2(half.x(), half.y()), X_WO * Vec2(-half.x(), half.y())})};
}

double overlap_m(const Solid& a, const Solid& b) {
  if ((a.middle - b.middle).norm() >= a.radius_m + b.radius_m) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Solid* solid : {&a, &b}) {
    if (solid->round) continue;
    const Polygon& outline = solid->outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i];
      const Vec2 normal = Vec2(edge.y(), -edge.x()).normalized();
      least = std::min(least, overlap_along(a, b, normal));
      if (least <= kTouching_m) return 0.0;
    }
  }
  if (a.round) least = std::min(least, overlap_along(a, b, towards(a, b)));
  if (b.round) least = std::min(least, overlap_along(a, b, towards(b, a)));
  return least <= kTouching_m ? 0.0 : least;
}

double overlap_m(const std::vector<Solid>& a, const std::vector<Solid>& b) {
  double greatest = 0.0;
  for (const Solid& of_a : a) {
    for (const Solid& of_b : b) greatest = std::max(greatest, overlap_m(of_a, of_b));
  }
  return greatest;
}

std::optional<Vec2> wall_within(const std::vector<WallLoop>& walls, const Solid& solid) {
  for (const WallLoop& loop : walls) {
    if (!loop.solid) continue;
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      const Vec2& a = loop.vertices[i];
      const Vec2& b = loop.vertices[(i + 1) % loop.vertices.size()];
      if (std::max(a.x(), b.x()) < solid.middle.x() - solid.radius_m ||
          std::min(a.x(), b.x()) > solid.middle.x() + solid.radius_m ||
          std::max(a.y(), b.y()) < solid.middle.y() - solid.radius_m ||
          std::min(a.y(), b.y()) > solid.middle.y() + solid.radius_m) {
        continue;
      }
      if (crosses(solid, a, b)) return nearest_on_segment(solid.middle, a, b);
    }
  }
  if (in_solid(walls, solid.middle)) return solid.middle;
  return std::nullopt;
}

std::pair<const char*, double> beyond_floor(const ArenaDescription& arena,
                                            const std::vector<Solid>& solids) {
  const Vec2 low = arena.origin;
  const Vec2 high = arena.origin + arena.size;
  std::pair<const char*, double> worst{"", kTouching_m};
  const auto note = [&worst](const char* side, double depth_m) {
    if (depth_m > worst.second) worst = {side, depth_m};
  };
  for (const Solid& solid : solids) {
    const double around_m = solid.round ? solid.radius_m : 0.0;
    for (const Vec2& p : solid.outline) {
      note("left", low.x() - p.x() + around_m);
      note("right", p.x() + around_m - high.x());
      note("bottom", low.y() - p.y() + around_m);
      note("top", p.y() + around_m - high.y());
    }
  }
  if (worst.first[0] == '\0') worst.second = 0.0;
  return worst;
}

}  // namespace sim::io
