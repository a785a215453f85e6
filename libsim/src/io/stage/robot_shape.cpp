// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "io/document.h"
#include "io/stage/draft.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim::io::stage {
namespace {

constexpr std::size_t kMostCorners = 8;

/// Whether a body of a robot can have that outline.
bool is_body(const Polygon& outline) {
  constexpr double kLeastArea_m2 = 1.1e-4;
  constexpr double kLeastExtent_m = 0.001;
  return outline.size() >= 3 && area_m2(outline) >= kLeastArea_m2 &&
         least_extent_m(outline) >= kLeastExtent_m;
}

bool is_superstructure(const Polygon& outline) {
  constexpr double kLeastArea_m2 = 1.1e-6;
  constexpr double kLeastExtent_m = 0.0011;
  return outline.size() >= 3 && area_m2(outline) >= kLeastArea_m2 &&
         least_extent_m(outline) >= kLeastExtent_m;
}

/// The convex outline of the solid parts that reach at least up to a height.
Polygon outline_above(const std::vector<RobotDraft::Part>& parts, double top_m) {
  std::vector<Vec2> points;
  for (const RobotDraft::Part& part : parts) {
    if (part.solid && part.top_m >= top_m) {
      points.insert(points.end(), part.points.begin(), part.points.end());
    }
  }
  return convex_outline(std::move(points));
}

/// The greatest height up to which the outline of the solid parts is as wide as that of all.
double height_of_body(const std::vector<RobotDraft::Part>& parts, const Polygon& whole) {
  constexpr double kAsWide = 0.995;  // as a share of the area
  std::vector<double> tops_m;
  for (const RobotDraft::Part& part : parts) {
    if (part.solid) tops_m.push_back(part.top_m);
  }
  std::sort(tops_m.rbegin(), tops_m.rend());
  for (const double top_m : tops_m) {
    if (area_m2(outline_above(parts, top_m)) >= kAsWide * area_m2(whole)) return top_m;
  }
  return tops_m.empty() ? 0.0 : tops_m.back();
}

/// Whether a convex outline contains all points of another.
bool contains(const Polygon& outer, const Polygon& inner) {
  constexpr double kRounding_m2 = 1e-9;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Vec2 side = outer[(i + 1) % outer.size()] - outer[i];
    for (const Vec2& point : inner) {
      const Vec2 to = point - outer[i];
      if (side.x() * to.y() - side.y() * to.x() < -kRounding_m2) return false;
    }
  }
  return true;
}

/// What is higher than the body, the largest parts first. Parts within others that are at least as
/// high are left out.
std::vector<std::pair<Polygon, double>> higher_parts(const std::vector<RobotDraft::Part>& parts,
                                                     double height_m) {
  constexpr double kHigher_m = 1e-3;
  std::vector<std::pair<Polygon, double>> higher;
  for (const RobotDraft::Part& part : parts) {
    const double top_m = std::min(part.top_m, kGreatestRobotHeight_m);
    if (top_m < height_m + kHigher_m) continue;
    Polygon outline = convex_outline(part.points);
    reduce_corners(outline, kMostCorners);
    if (is_superstructure(outline)) higher.emplace_back(std::move(outline), top_m);
  }
  std::stable_sort(higher.begin(), higher.end(), [](const auto& a, const auto& b) {
    return area_m2(a.first) > area_m2(b.first);
  });
  std::vector<std::pair<Polygon, double>> seen;
  for (auto& part : higher) {
    const bool hidden = std::any_of(seen.begin(), seen.end(), [&](const auto& larger) {
      return larger.second >= part.second && contains(larger.first, part.first);
    });
    if (!hidden) seen.push_back(std::move(part));
  }
  return seen;
}

Json points_json(const Polygon& outline) {
  Json points = Json::array();
  for (const Vec2& point : outline) points.push_back(point_json(point));
  return points;
}

}  // namespace

void add_part(const Body& body, const Mount& mount, bool solid, bool seen, RobotDraft& robot) {
  if (!solid && !seen) return;
  const auto add = [&](const std::vector<Vec2>& points, double z_max_m) {
    RobotDraft::Part part;
    for (const Vec2& point : points) part.points.push_back(mount.X_BM * point);
    part.top_m = seen ? std::max(0.0, mount.z_m + z_max_m) : 0.0;
    part.solid = solid;
    robot.parts.push_back(std::move(part));
  };
  for (const Block& block : body.blocks) add(block.points, block.z_max_m);
  if (body.bitmap) {
    add(extreme_points(*body.bitmap, {body.size_m[0], body.size_m[1]}), body.size_m[2]);
  }
}

void set_body(Report& report, RobotDraft& robot) {
  const Polygon whole = outline_above(robot.parts, 0.0);
  // Only superstructures may reach beyond the footprint, as what is not solid does.
  const bool overhangs = std::any_of(
      robot.parts.begin(), robot.parts.end(),
      [&](const RobotDraft::Part& part) { return !part.solid && !contains(whole, part.points); });
  const double height_m = overhangs ? 0.0 : height_of_body(robot.parts, whole);
  Polygon outline = whole;
  reduce_corners(outline, kMostCorners);
  if (!is_body(outline)) {
    report.note("no body", robot.place,
                "a robot with a body of less than 1 cm^2 gets one of 2 x 2 cm");
    outline = {{-0.01, -0.01}, {0.01, -0.01}, {0.01, 0.01}, {-0.01, 0.01}};
  }
  for (const Vec2& point : outline) {
    constexpr double kFarthest_m = 100.0;
    if (point.cwiseAbs().maxCoeff() <= kFarthest_m) continue;
    report.error(robot.place, "stage/bad-body",
                 "a robot whose body ends at most 100 m from its pose",
                 number_text(point.cwiseAbs().maxCoeff()) + " m", "is unit_length right?");
    break;
  }
  robot.model["footprint"] = points_json(outline);
  robot.model["height"] = neat(std::clamp(height_m, kLeastLength_m, kGreatestRobotHeight_m));
  auto higher = higher_parts(robot.parts, std::max(height_m, kLeastLength_m));
  if (higher.size() > kMostSuperstructures) {
    higher.resize(kMostSuperstructures);
    report.note("superstructures", robot.place,
                "a robot has at most " + std::to_string(kMostSuperstructures) +
                    " parts above its body; the smallest ones are left out");
  }
  robot.top_m = height_m;
  Json superstructures = Json::array();
  for (const auto& [part, top_m] : higher) {
    superstructures.push_back({{"outline", points_json(part)}, {"height", neat(top_m)}});
    robot.top_m = std::max(robot.top_m, top_m);
  }
  if (!superstructures.empty()) robot.model["superstructures"] = std::move(superstructures);
  robot.footprint = std::move(outline);
}

}  // namespace sim::io::stage
