// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"

/// Segments, polygons, and the outlines of obstacles.
namespace sim {

/// Where on the segment from a to b the point that is nearest to p lies: 0 at a, 1 at b. 0 if both
/// ends are equal.
[[nodiscard]] inline double nearest_share(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = along.squaredNorm();
  return length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
}

/// The point of the segment from a to b that is nearest to p [m].
[[nodiscard]] inline Vec2 nearest_on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  return a + nearest_share(p, a, b) * (b - a);
}

/// Distance of a point from the segment from a to b [m].
[[nodiscard]] inline double distance_to_segment_m(const Vec2& p, const Vec2& a, const Vec2& b) {
  // In this order: rounding decides between corners of a map that are equally far from a line.
  return (p - a - nearest_share(p, a, b) * (b - a)).norm();
}

/// Signed area of a polygon [m^2]: positive if it runs counter-clockwise.
[[nodiscard]] double area_m2(const Polygon& outline);

/// Whether a counter-clockwise outline turns left at each vertex, once around. An outline with a
/// straight angle is not convex in this sense, since the physics would drop the vertex.
[[nodiscard]] bool is_convex(const Polygon& outline);

/// The smaller of the shortest side of a convex outline and the least distance of two parallel
/// lines that enclose it [m].
[[nodiscard]] double least_extent_m(const Polygon& outline);

/// Two sides of an outline that have a point in common besides the vertex between them, as indices
/// of their first vertices, the lesser first; nullopt if the outline is simple. O(n squared).
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(
    const Polygon& outline);

/// Whether a point is inside a simple polygon (even-odd rule, half-open at vertices).
[[nodiscard]] bool is_inside(const Polygon& outline, const Vec2& p);

/// Divides a simple, counter-clockwise polygon into triangles by cutting off ears (G. H. Meisters,
/// Polygons Have Ears, American Mathematical Monthly 82, 1975). Straight angles give no triangle.
/// O(n cubed).
[[nodiscard]] std::vector<Polygon> triangles_of(const Polygon& outline);

/// Corners of the convex outline around points, counter-clockwise. Corners that are less than 2 mm
/// from their neighbour or on a straight line are left out.
/// (A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", Information
/// Processing Letters 9(5), 1979.)
[[nodiscard]] Polygon convex_outline(std::vector<Vec2> points);

/// Divides a simple, counter-clockwise polygon into convex ones of at most `most_corners` corners:
/// triangles_of(), joined where that leaves them convex (S. Hertel and K. Mehlhorn, Fast
/// Triangulation of Simple Polygons, Foundations of Computation Theory, LNCS 158, 1983).
[[nodiscard]] std::vector<Polygon> convex_parts_of(const Polygon& outline,
                                                   std::size_t most_corners);

/// Makes an obstacle a circle of that radius [m].
void make_circle(ObstacleDescription& obstacle, double radius_m);

/// Makes an obstacle a polygon. Reverses a clockwise outline.
/// @param outline  in the obstacle's own frame [m].
void make_polygon(ObstacleDescription& obstacle, Polygon outline);

/// Changes the extent of an obstacle along its own axes. The outline of a polygon is scaled about
/// the origin of its own frame.
/// @param size_m  each > 0 [m]; of a circle both must be equal.
void resize(ObstacleDescription& obstacle, const Vec2& size_m);

/// Radius of an obstacle that is a circle [m].
[[nodiscard]] inline double radius_m(const ObstacleDescription& circle) {
  return 0.5 * circle.size.x();
}

/// Pose X_WO of an obstacle's own frame.
[[nodiscard]] inline Pose pose_of(const ObstacleDescription& obstacle) {
  return {obstacle.center.x(), obstacle.center.y(), obstacle.yaw_rad};
}

/// Corners of a box or a polygon in W, counter-clockwise [m]; none for a circle.
[[nodiscard]] Polygon corners_of(const ObstacleDescription& obstacle);

/// The outline of an obstacle in W, counter-clockwise [m]. A circle becomes a regular polygon with
/// its vertices on the circle.
/// @param tolerance_m  maximum distance of that polygon from the circle, > 0; at most 720 vertices
///     are made.
[[nodiscard]] Polygon outline_of(const ObstacleDescription& obstacle, double tolerance_m);

}  // namespace sim
