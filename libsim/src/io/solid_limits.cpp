// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/solid_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/check_ranges.h"
#include "io/document.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

// Box2D's limit for polygons.
constexpr std::size_t kMostVertices = 8;
// A smaller robot is within the tolerances of the contact solver.
constexpr double kLeastArea_m2 = 1e-4;
constexpr double kLeastPartArea_m2 = 1e-6;
// Distance of a vertex from the centre of the axle.
constexpr double kFarthestVertex_m = 100.0;

constexpr const char* kTooThin = "the physics cannot build anything thinner";

// The form of this condition makes it refuse NaN.
bool within(double value, double least, double most) { return value >= least && value <= most; }

double greatest_coordinate(const Vec2& p) { return p.cwiseAbs().maxCoeff(); }

std::string range_text(double least, double most, const char* unit) {
  return describe_range(NumberRange{least, most, false, unit});
}

std::optional<SolidError> check_length(const char* key, double value, double most) {
  if (within(value, kLeastLength_m, most)) return std::nullopt;
  return SolidError{key, range_text(kLeastLength_m, most, "m"), number_text(value) + " m",
                    value < kLeastLength_m ? kTooThin : ""};
}

}  // namespace

std::optional<SolidError> check_box(const ObstacleDescription& box) {
  if (!within(greatest_coordinate(box.center), 0.0, kFarthest_m)) {
    return SolidError{"/center", range_text(-kFarthest_m, kFarthest_m, "m") + " for x and y",
                      number_text(box.center.x()) + " and " + number_text(box.center.y()),
                      "move the world's things near its origin"};
  }
  if (!std::isfinite(box.yaw_rad)) {
    return SolidError{"/yaw_deg", "a number", number_text(box.yaw_rad), ""};
  }
  for (const Eigen::Index axis : {0, 1}) {
    if (auto error =
            check_length(axis == 0 ? "/size/0" : "/size/1", box.size[axis], kGreatestLength_m)) {
      return error;
    }
  }
  const double far_m = greatest_coordinate(box.center) + 0.5 * box.size.maxCoeff();
  const double least_m = least_length_m(far_m);
  if (box.size.minCoeff() < least_m) {
    return SolidError{box.size.x() < least_m ? "/size/0" : "/size/1",
                      "sides of at least " + number_text(least_m) + " m so far from the origin (" +
                          number_text(far_m) + " m)",
                      number_text(box.size.minCoeff()) + " m", kTooThin};
  }
  if (std::isinf(box.height_m) && box.height_m > 0.0) return std::nullopt;  // height without limit
  return check_length("/height", box.height_m, kGreatestLength_m);
}

namespace {

std::optional<SolidError> check_circle(const ObstacleDescription& circle) {
  constexpr double kGreatestRadius_m = 0.5 * kGreatestLength_m;
  if (circle.size.x() != circle.size.y()) {
    return SolidError{"/radius", "a circle with the same extent along x and y",
                      number_text(circle.size.x()) + " and " + number_text(circle.size.y()) + " m",
                      ""};
  }
  const double r = radius_m(circle);
  if (auto error = check_length("/radius", r, kGreatestRadius_m)) return error;
  auto error = check_box(circle);
  if (error && error->key.starts_with("/size")) error->key = "/radius";
  return error;
}

SolidError bad_outline(std::string expected, std::string found, std::string hint = "") {
  return {"/outline", std::move(expected), std::move(found), std::move(hint), "world/bad-outline"};
}

// Checks an outline by itself, in its own frame.
std::optional<SolidError> check_outline(const Polygon& outline) {
  constexpr double kLeastOutline_m2 = 1e-6;
  if (outline.size() < 3 || outline.size() > kMostOutlineVertices) {
    return bad_outline(
        std::string("3 to ") + std::to_string(kMostOutlineVertices) + " points [x, y]",
        std::to_string(outline.size()) + " points in the outline");
  }
  for (const Vec2& vertex : outline) {
    if (within(greatest_coordinate(vertex), 0.0, kGreatestLength_m)) continue;
    return bad_outline(std::string("points at most ") + number_text(kGreatestLength_m) +
                           " m from the origin of the outline along x and y",
                       number_text(vertex.x()) + " and " + number_text(vertex.y()) + " m");
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double side_m = (outline[(i + 1) % outline.size()] - outline[i]).norm();
    if (side_m >= kLeastLength_m) continue;
    return bad_outline(
        std::string("sides of at least ") + number_text(kLeastLength_m) + " m",
        number_text(side_m) + " m from point " + std::to_string(i) + " to the next in the outline",
        side_m == 0.0 ? "leave out the repeated point" : kTooThin);
  }
  if (const auto sides = crossing_sides(outline)) {
    return bad_outline("an outline that does not cross or touch itself",
                       std::string("sides ") + std::to_string(sides->first) + " and " +
                           std::to_string(sides->second) + " that meet in the outline",
                       "side 0 goes from the first point to the second one; list the points in "
                       "order round the obstacle");
  }
  if (area_m2(outline) < kLeastOutline_m2) {
    return bad_outline("a counter-clockwise outline of at least 1 mm^2",
                       number_text(area_m2(outline) * 1e6) + " mm^2 in the outline",
                       "points are in m");
  }
  // The physics makes one convex solid of it.
  if (is_convex(outline) && least_extent_m(outline) < kLeastLength_m) {
    return bad_outline(
        std::string("an outline that is at least ") + number_text(kLeastLength_m) + " m wide",
        number_text(least_extent_m(outline)) + " m as the width", kTooThin);
  }
  return std::nullopt;
}

std::optional<SolidError> check_polygon(const ObstacleDescription& polygon) {
  if (auto error = check_outline(polygon.outline)) return error;
  ObstacleDescription exact = polygon;
  make_polygon(exact, polygon.outline);
  if (!(polygon.size - exact.size).isZero(1e-9 * exact.size.maxCoeff())) {
    return bad_outline("an outline that extends over the size of the obstacle",
                       number_text(exact.size.x()) + " x " + number_text(exact.size.y()) + " m",
                       "use make_polygon() and resize()");
  }
  if (auto error = check_box(polygon)) {
    if (error->key.starts_with("/size")) error->key = "/outline";
    return error;
  }
  double far_m = 0.0;
  double shortest_m = kGreatestLength_m;
  const Polygon corners = corners_of(polygon);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    far_m = std::max(far_m, greatest_coordinate(corners[i]));
    shortest_m = std::min(shortest_m, (corners[(i + 1) % corners.size()] - corners[i]).norm());
  }
  const double least_m = least_length_m(far_m);
  if (shortest_m >= (1.0 - 1e-3) * least_m) return std::nullopt;
  return bad_outline(std::string("sides of at least ") + number_text(least_m) +
                         " m so far from the origin (" + number_text(far_m) + " m)",
                     number_text(shortest_m) + " m as a side", kTooThin);
}

// Checks a convex outline of a robot's body or of a part of it.
std::optional<SolidError> check_convex(const char* key, const Polygon& outline, double least_m2,
                                       const char* least_text) {
  if (outline.size() < 3 || outline.size() > kMostVertices) {
    return SolidError{key, "3 to 8 points", std::to_string(outline.size()), ""};
  }
  for (const Vec2& vertex : outline) {
    if (within(greatest_coordinate(vertex), 0.0, kFarthestVertex_m)) continue;
    return SolidError{key, "points at most 100 m from the middle of the robot along x and y",
                      number_text(vertex.x()) + " and " + number_text(vertex.y()), ""};
  }
  if (!is_convex(outline)) {
    return SolidError{key, "the corners of a convex outline, in order",
                      "an outline with a notch, a straight corner or a crossing",
                      "take the convex outline round the robot, or a list of convex parts"};
  }
  if (area_m2(outline) < least_m2) {
    return SolidError{key, std::string("an outline of at least ") + least_text,
                      number_text(area_m2(outline) * 1e4) + " cm^2", "points are in m"};
  }
  if (const double extent_m = least_extent_m(outline); extent_m < kLeastLength_m) {
    return SolidError{key,
                      "an outline that is at least " + number_text(kLeastLength_m) +
                          " m wide, with no side shorter than that",
                      number_text(extent_m) + " m", "leave out points that are that close"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<SolidError> check_obstacle(const ObstacleDescription& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kCircle:
      return check_circle(obstacle);
    case ObstacleShape::kPolygon:
      return check_polygon(obstacle);
    case ObstacleShape::kBox:
      break;
  }
  return check_box(obstacle);
}

std::optional<SolidError> check_movable(const ObstacleDescription& obstacle) {
  if (!is_movable(obstacle)) return std::nullopt;
  const char* key = obstacle.motion ? "/motion" : "/mass";
  const char* what = obstacle.motion ? "a static obstacle that moves" : "a static obstacle to push";
  if (obstacle.type == ObstacleType::kDynamic || obstacle.state == ObstacleState::kRetracted) {
    return SolidError{key, what, "a dynamic one", "blocks that rise and sink do not move",
                      "world/conflicting-keys"};
  }
  if (obstacle.portable) {
    return SolidError{key, what, "a portable one", "grippers take only obstacles that stand fast",
                      "world/conflicting-keys"};
  }
  if (obstacle.shape == ObstacleShape::kPolygon &&
      (obstacle.outline.size() > kMostVertices || !is_convex(obstacle.outline))) {
    return bad_outline(std::string("a convex outline of at most ") + std::to_string(kMostVertices) +
                           " points, because the obstacle can move",
                       is_convex(obstacle.outline)
                           ? std::to_string(obstacle.outline.size()) + " points in the outline"
                           : std::string("a concave outline"),
                       "use a simpler outline, or several obstacles");
  }
  return std::nullopt;
}

std::optional<SolidError> check_floor(const ArenaDescription& arena) {
  for (const Eigen::Index axis : {0, 1}) {
    if (auto error =
            check_length(axis == 0 ? "/size/0" : "/size/1", arena.size[axis], kGreatestLength_m)) {
      return error;
    }
  }
  const double reach_m =
      std::max(greatest_coordinate(arena.origin), greatest_coordinate(arena.origin + arena.size));
  if (!within(reach_m, 0.0, kFarthest_m)) {
    return SolidError{"/origin",
                      "a floor that ends at most " + number_text(kFarthest_m) +
                          " m from the world's origin, along x and along y",
                      number_text(reach_m) + " m", "subtract the same from all places"};
  }
  if (!std::isinf(arena.border_height_m) || arena.border_height_m < 0.0) {
    return check_length("/border_height", arena.border_height_m, kGreatestLength_m);
  }
  return std::nullopt;
}

std::optional<SolidError> check_walls(const ArenaDescription& arena) {
  constexpr double kRounding = 1.0 - 1e-3;  // of positions far from the origin
  for (const WallLoop& loop : arena.walls) {
    if (loop.vertices.size() < 3) {
      return SolidError{"/map", "walls of at least 3 vertices",
                        std::to_string(loop.vertices.size()), ""};
    }
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      const Vec2& a = loop.vertices[i];
      const double far_m = greatest_coordinate(a);
      if (!within(far_m, 0.0, kFarthest_m)) {
        return SolidError{"/map/origin",
                          "walls that end at most " + number_text(kFarthest_m) +
                              " m from the world's origin, along x and along y",
                          number_text(far_m) + " m", "subtract the same from all places"};
      }
      const double edge_m = (loop.vertices[(i + 1) % loop.vertices.size()] - a).norm();
      const double least_m = least_length_m(far_m);
      if (!(edge_m >= kRounding * least_m)) {
        return SolidError{"/map/resolution",
                          "walls with edges of at least " + number_text(least_m) +
                              " m so far from the origin (" + number_text(far_m) + " m)",
                          number_text(edge_m) + " m", kTooThin};
      }
    }
  }
  return std::nullopt;
}

std::optional<SolidError> check_footprint(const Polygon& outline) {
  return check_convex("/footprint", outline, kLeastArea_m2, "1 cm^2");
}

std::optional<SolidError> check_parts(const RobotModel& model) {
  const std::size_t count = model.parts.size();
  if (count < 2 || count > kMostBodyParts) {
    return SolidError{"/footprint", "2 to " + std::to_string(kMostBodyParts) + " convex parts",
                      std::to_string(count), "a list of corners is a footprint of one part"};
  }
  for (std::size_t i = 0; i < count; ++i) {
    auto error = check_convex("/footprint", model.parts[i], kLeastPartArea_m2, "1 mm^2");
    if (!error) continue;
    error->found += " in part " + std::to_string(i);
    return error;
  }
  return std::nullopt;
}

std::optional<SolidError> check_superstructure(const Superstructure& part, double body_height_m) {
  if (auto error = check_convex("/outline", part.outline, kLeastPartArea_m2, "1 mm^2")) {
    return error;
  }
  if (!within(part.bottom_m, 0.0, part.height_m - kLeastLength_m)) {
    return SolidError{"/bottom", range_text(0.0, part.height_m - kLeastLength_m, "m"),
                      number_text(part.bottom_m) + " m", ""};
  }
  if (part.height_m > body_height_m && part.height_m <= kGreatestRobotHeight_m) return std::nullopt;
  return SolidError{"/height",
                    "a number greater than the height of the body, " + number_text(body_height_m) +
                        " m, and at most " + number_text(kGreatestRobotHeight_m) + " m",
                    number_text(part.height_m) + " m", "lower parts belong to the footprint"};
}

std::optional<SolidError> check_model(const RobotModel& model) {
  constexpr double kGreatestRobot_m = 100.0;
  if (model.parts.empty()) {
    if (auto error = check_footprint(model.footprint)) return error;
  } else if (auto error = check_parts(model)) {
    return error;
  }
  if (auto error = check_length("/height", model.height_m, kGreatestRobot_m)) return error;
  for (std::size_t i = 0; i < model.superstructures.size(); ++i) {
    if (auto error = check_superstructure(model.superstructures[i], model.height_m)) {
      error->key = "/superstructures/" + std::to_string(i) + error->key;
      return error;
    }
  }
  return out_of_range(fields_of<RobotModel>(), &model, {"mass", "drive"});
}

bool is_valid_pose(const Pose& X_WB) noexcept {
  return within(greatest_coordinate(X_WB.position()), 0.0, kFarthest_m) &&
         std::isfinite(X_WB.yaw_rad);
}

}  // namespace sim::io
