// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "io/document.h"
#include "io/stage/draft.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace sim::io::stage {
namespace {

constexpr std::size_t kMostCorners = 8;
constexpr double kHigher_m = 1e-3;  ///< least difference of heights that matters

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

/// Whether the outline of a part is so much smaller than the convex outline around it that it is
/// more exact to divide it.
bool is_hollowed(const Polygon& points, const Polygon& convex) {
  constexpr double kAsLarge = 0.98;  // as a share of the area
  return points.size() > 3 && area_m2(points) < kAsLarge * area_m2(convex) &&
         !crossing_sides(points);
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

/// Whether sensors look under a part: no part below contains it.
bool has_room_below(const RobotDraft::Part& part, const std::vector<RobotDraft::Part>& all) {
  if (part.bottom_m < kHigher_m || part.top_m < part.bottom_m) return false;
  return std::none_of(all.begin(), all.end(), [&](const RobotDraft::Part& below) {
    return below.bottom_m < kHigher_m && below.top_m > part.bottom_m - kHigher_m &&
           contains(convex_outline(below.points), part.points);
  });
}

/// The convex outlines that together are a part. Those that are no area for a robot are left out.
std::vector<Polygon> convex_pieces(const RobotDraft::Part& part) {
  std::vector<Polygon> pieces{convex_outline(part.points)};
  if (is_hollowed(part.points, pieces.front())) {
    pieces = convex_parts_of(part.points, kMostCorners);
  } else {
    reduce_corners(pieces.front(), kMostCorners);
  }
  std::erase_if(pieces, [](const Polygon& piece) { return !is_superstructure(piece); });
  return pieces;
}

/// Pieces without those that lie within a larger one which hides them. The largest come first.
/// @param hides  whether a piece hides another one that lies within it.
template <typename Hides>
std::vector<Superstructure> without_hidden(std::vector<Superstructure> pieces, Hides hides) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
    return area_m2(a.outline) > area_m2(b.outline);
  });
  std::vector<Superstructure> kept;
  for (Superstructure& piece : pieces) {
    const bool hidden = std::any_of(kept.begin(), kept.end(), [&](const auto& larger) {
      return hides(larger, piece) && contains(larger.outline, piece.outline);
    });
    if (!hidden) kept.push_back(std::move(piece));
  }
  return kept;
}

/// What is higher than the body, the largest parts first. Parts within others that are at least as
/// high are left out.
std::vector<Superstructure> higher_parts(const std::vector<RobotDraft::Part>& parts,
                                         double height_m) {
  std::vector<Superstructure> higher;
  for (const RobotDraft::Part& part : parts) {
    const double top_m = std::min(part.top_m, kGreatestRobotHeight_m);
    if (top_m < height_m + kHigher_m) continue;
    const bool has_gap = part.bottom_m > height_m && part.bottom_m < top_m - kHigher_m;
    for (Polygon& piece : convex_pieces(part)) {
      higher.push_back({std::move(piece), top_m, has_gap ? part.bottom_m : 0.0});
    }
  }
  return without_hidden(std::move(higher), [](const auto& larger, const auto& piece) {
    return larger.height_m >= piece.height_m && larger.bottom_m <= piece.bottom_m;
  });
}

/// The solid pieces of a body that is not convex. Those within others are left out, since they add
/// nothing to the outline.
std::vector<Superstructure> solid_pieces(const std::vector<RobotDraft::Part>& parts) {
  std::vector<Superstructure> pieces;
  for (const RobotDraft::Part& part : parts) {
    if (!part.solid) continue;
    for (Polygon& piece : convex_pieces(part)) pieces.push_back({std::move(piece), part.top_m});
  }
  return without_hidden(std::move(pieces), [](const auto&, const auto&) { return true; });
}

/// The share of a convex outline that none of the parts covers.
double uncovered_share(const Polygon& whole, const std::vector<Superstructure>& parts) {
  constexpr int kSamples = 100;  // along the longer side of the box around the outline
  Vec2 low = whole.front();
  Vec2 high = low;
  for (const Vec2& corner : whole) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double spacing_m = (high - low).maxCoeff() / kSamples;
  int within = 0;
  int uncovered = 0;
  for (double x = low.x() + 0.5 * spacing_m; x < high.x(); x += spacing_m) {
    for (double y = low.y() + 0.5 * spacing_m; y < high.y(); y += spacing_m) {
      if (!is_inside(whole, {x, y})) continue;
      ++within;
      if (std::none_of(parts.begin(), parts.end(), [&](const Superstructure& part) {
            return is_inside(part.outline, {x, y});
          })) {
        ++uncovered;
      }
    }
  }
  return within == 0 ? 0.0 : static_cast<double>(uncovered) / within;
}

Json points_json(const Polygon& outline) {
  Json points = Json::array();
  for (const Vec2& point : outline) points.push_back(point_json(point));
  return points;
}

}  // namespace

void add_part(const Body& body, const Mount& mount, bool solid, bool seen, RobotDraft& robot) {
  if (!solid && !seen) return;
  const auto add = [&](const std::vector<Vec2>& points, double z_min_m, double z_max_m) {
    RobotDraft::Part part;
    for (const Vec2& point : points) part.points.push_back(mount.X_BM * point);
    part.bottom_m = std::max(0.0, mount.z_m + z_min_m);
    part.top_m = seen ? std::max(0.0, mount.z_m + z_max_m) : 0.0;
    part.solid = solid;
    robot.parts.push_back(std::move(part));
  };
  for (const Block& block : body.blocks) add(block.points, block.z_min_m, block.z_max_m);
  if (body.bitmap) {
    const Vec2 size_m(body.size_m[0], body.size_m[1]);
    // Outlines of a concave body; corners that matter for the convex outline of others.
    const Polygon around = convex_outline(extreme_points(*body.bitmap, size_m));
    const auto outlines = outlines_of(*body.bitmap, size_m);
    double area = 0.0;
    if (outlines) {
      for (const Polygon& outline : *outlines) area += area_m2(outline);
    }
    constexpr double kConcave = 0.9;  // pixels of a round body leave gaps, too
    if (outlines && area < kConcave * area_m2(around)) {
      for (const Polygon& outline : *outlines) add(outline, 0.0, body.size_m[2]);
    } else {
      add(extreme_points(*body.bitmap, size_m), 0.0, body.size_m[2]);
    }
  }
}

void set_body(Report& report, RobotDraft& robot) {
  // As in Stage, a robot without a solid part drives through everything, and others through it.
  const bool solid = std::any_of(robot.parts.begin(), robot.parts.end(),
                                 [](const RobotDraft::Part& part) { return part.solid; });
  if (!solid) {
    robot.model["solid"] = false;
    for (RobotDraft::Part& part : robot.parts) part.solid = true;
  }
  const Polygon whole = outline_above(robot.parts, 0.0);
  // Only superstructures may reach beyond the footprint, as what is not solid does, and have room
  // below.
  const bool overhangs =
      std::any_of(robot.parts.begin(), robot.parts.end(), [&](const RobotDraft::Part& part) {
        return part.solid ? has_room_below(part, robot.parts) : !contains(whole, part.points);
      });
  double height_m = overhangs ? 0.0 : height_of_body(robot.parts, whole);
  Polygon outline = whole;
  reduce_corners(outline, kMostCorners);
  if (!is_body(outline)) {
    if (solid) {
      report.note("no body", robot.place,
                  "a robot with a body of less than 1 cm^2 gets one of 2 x 2 cm");
    }
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
  constexpr double kConvex = 0.02;  // a smaller share of the area does not matter
  const std::vector<Superstructure> several = solid_pieces(robot.parts);
  if (several.size() > 1 && uncovered_share(outline, several) > kConvex) {
    if (several.size() > kMostBodyParts) {
      report.note("body of many parts", robot.place,
                  "a body has at most " + std::to_string(kMostBodyParts) +
                      " convex parts; others become the convex outline around them");
    } else {
      Json parts = Json::array();
      double lowest_top_m = kGreatestRobotHeight_m;  // up to which all parts reach
      for (const Superstructure& part : several) {
        parts.push_back(points_json(part.outline));
        lowest_top_m = std::min(lowest_top_m, part.height_m);
      }
      robot.model["footprint"] = std::move(parts);
      if (!overhangs) height_m = lowest_top_m;
    }
  }
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
  for (const Superstructure& part : higher) {
    Json json = {{"outline", points_json(part.outline)}, {"height", neat(part.height_m)}};
    if (part.bottom_m > 0.0) json["bottom"] = neat(part.bottom_m);
    superstructures.push_back(std::move(json));
    robot.top_m = std::max(robot.top_m, part.height_m);
  }
  if (!superstructures.empty()) robot.model["superstructures"] = std::move(superstructures);
  robot.footprint = std::move(outline);
}

}  // namespace sim::io::stage
