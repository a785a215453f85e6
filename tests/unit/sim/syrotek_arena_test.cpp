// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>

#include "sim/world/robot_model.h"

namespace sim {
namespace {

constexpr double kClosed_m = 0.02;    // a gap up to this width counts as closed
constexpr double kCorridor_m = 0.30;  // a gap from this width on counts as a corridor
constexpr double kRounding_m = 1e-9;  // rounding of sums of two-digit decimals

struct Box {
  std::string name;
  Pose X_WO;
  Vec2 half;

  [[nodiscard]] Polygon corners() const {
    return {X_WO * Vec2(-half.x(), -half.y()), X_WO * Vec2(half.x(), -half.y()),
            X_WO * Vec2(half.x(), half.y()), X_WO * Vec2(-half.x(), half.y())};
  }
  /// Distance of a point from the box, 0 inside [m].
  [[nodiscard]] double distance_m(const Vec2& p_W) const {
    const Vec2 p_O = X_WO.inverse() * p_W;
    return Vec2(std::max(std::abs(p_O.x()) - half.x(), 0.0),
                std::max(std::abs(p_O.y()) - half.y(), 0.0))
        .norm();
  }
};

Box box_of(const ObstacleDescription& o) {
  return {o.name, {o.center.x(), o.center.y(), o.yaw_rad}, 0.5 * o.size};
}

/// All solid boxes: blocks (dynamic ones either extended or retracted), separators, and the borders
/// as boxes outside of the floor.
std::vector<Box> solids(bool dynamic_extended) {
  const ArenaDescription arena = syrotek_arena();
  std::vector<Box> boxes;
  for (const ObstacleDescription& o : arena.obstacles) {
    if (o.type == ObstacleType::kStatic || dynamic_extended) boxes.push_back(box_of(o));
  }
  for (const ObstacleDescription& o : arena.dock_separators) boxes.push_back(box_of(o));
  const Vec2 half = 0.5 * arena.size;
  boxes.push_back({"left", {-0.1, half.y(), 0}, {0.1, half.y()}});
  boxes.push_back({"right", {arena.size.x() + 0.1, half.y(), 0}, {0.1, half.y()}});
  boxes.push_back({"bottom", {half.x(), -0.1, 0}, {half.x(), 0.1}});
  boxes.push_back({"top", {half.x(), arena.size.y() + 0.1, 0}, {half.x(), 0.1}});
  return boxes;
}

/// The shortest connection of two boxes: from a corner of one to the outline of the other.
struct Gap {
  double width_m = std::numeric_limits<double>::infinity();
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
};

Gap gap_between(const Box& a, const Box& b) {
  Gap gap;
  for (const auto& [corners_of, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Vec2& corner : corners_of->corners()) {
      const Vec2 p = other->X_WO.inverse() * corner;
      const Vec2 rim = other->X_WO * Vec2(std::clamp(p.x(), -other->half.x(), other->half.x()),
                                          std::clamp(p.y(), -other->half.y(), other->half.y()));
      const double width_m = (rim - corner).norm();
      if (width_m < gap.width_m) gap = {width_m, corner, rim};
    }
  }
  return gap;
}

double clearance_m(const std::vector<Box>& boxes, const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) least = std::min(least, box.distance_m(p));
  return least;
}

/// Widths of the gaps between two solids without a third one between them.
std::vector<double> open_gaps(bool dynamic_extended) {
  const std::vector<Box> boxes = solids(dynamic_extended);
  std::vector<double> widths;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const Gap gap = gap_between(boxes[i], boxes[j]);
      if (gap.width_m <= kClosed_m) continue;
      bool filled = false;
      for (int k = 1; k < 20; ++k) {
        const Vec2 p = gap.from + (k / 20.0) * (gap.to - gap.from);
        filled = filled || std::any_of(boxes.begin(), boxes.end(), [&](const Box& other) {
                   return &other != &boxes[i] && &other != &boxes[j] && other.distance_m(p) == 0.0;
                 });
      }
      if (filled) continue;
      EXPECT_GE(gap.width_m, kCorridor_m - kRounding_m)
          << "between " << boxes[i].name << " and " << boxes[j].name;
      widths.push_back(gap.width_m);
    }
  }
  return widths;
}

/// Connected parts of the floor points, on a grid of 1 cm, that are at least `radius_m` away from
/// all solids; the part of each point (0: not in the set).
struct Parts {
  static constexpr double kCell_m = 0.01;
  int columns = 0;
  int rows = 0;
  int count = 0;
  std::vector<int> part;

  [[nodiscard]] int at(int column, int row) const {
    return part[static_cast<std::size_t>(row * columns + column)];
  }
};

Parts parts_of_floor(const std::vector<Box>& boxes, double radius_m) {
  const ArenaDescription arena = syrotek_arena();
  Parts parts;
  parts.columns = static_cast<int>(std::lround(arena.size.x() / Parts::kCell_m));
  parts.rows = static_cast<int>(std::lround(arena.size.y() / Parts::kCell_m));
  const auto cells = static_cast<std::size_t>(parts.columns * parts.rows);
  std::vector<bool> free(cells);
  for (int row = 0; row < parts.rows; ++row) {
    for (int column = 0; column < parts.columns; ++column) {
      const Vec2 p((column + 0.5) * Parts::kCell_m, (row + 0.5) * Parts::kCell_m);
      free[static_cast<std::size_t>(row * parts.columns + column)] =
          clearance_m(boxes, p) >= radius_m;
    }
  }
  parts.part.assign(cells, 0);
  for (int start = 0; start < static_cast<int>(cells); ++start) {
    if (!free[static_cast<std::size_t>(start)] ||
        parts.part[static_cast<std::size_t>(start)] != 0) {
      continue;
    }
    ++parts.count;
    std::queue<int> queue;
    queue.push(start);
    parts.part[static_cast<std::size_t>(start)] = parts.count;
    while (!queue.empty()) {
      const int column = queue.front() % parts.columns;
      const int row = queue.front() / parts.columns;
      queue.pop();
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const int c = column + dx;
        const int r = row + dy;
        if (c < 0 || c >= parts.columns || r < 0 || r >= parts.rows) continue;
        const auto next = static_cast<std::size_t>(r * parts.columns + c);
        if (!free[next] || parts.part[next] != 0) continue;
        parts.part[next] = parts.count;
        queue.push(static_cast<int>(next));
      }
    }
  }
  return parts;
}

TEST(SyrotekArena, HasFloorAndAboutTwentyBlocks) {
  const ArenaDescription arena = syrotek_arena();
  EXPECT_EQ(arena.preset, "syrotek");
  EXPECT_EQ(arena.size, Vec2(3.42, 3.72));
  EXPECT_TRUE(arena.border);
  int dynamic = 0;
  std::set<std::string> names;
  for (const ObstacleDescription& o : arena.obstacles) {
    names.insert(o.name);
    EXPECT_EQ(o.height_m, 0.16);
    if (o.type != ObstacleType::kDynamic) continue;
    ++dynamic;
    EXPECT_EQ(o.state, ObstacleState::kRetracted) << o.name;
  }
  EXPECT_EQ(names.size(), arena.obstacles.size());
  EXPECT_GE(dynamic, 6);
  EXPECT_GE(arena.obstacles.size(), 18U);
  EXPECT_LE(arena.obstacles.size(), 24U);
}

TEST(SyrotekArena, Docks_OnLeftSideWithSeparators) {
  const ArenaDescription arena = syrotek_arena();
  EXPECT_EQ(arena.docks.size(), 7U);
  EXPECT_EQ(arena.dock_separators.size(), 6U);
  for (const DockDescription& dock : arena.docks) EXPECT_EQ(dock.pose.x_m, 0.15);
  const std::vector<Box> boxes = solids(true);
  // A docked S1R can turn on the spot; its farthest corner is 0.098 m from its centre.
  for (const DockDescription& dock : arena.docks) {
    EXPECT_GT(clearance_m(boxes, dock.pose.position()), 0.098) << dock.name;
  }
}

TEST(SyrotekArena, Gaps_ClosedOrCorridors) {
  // With the dynamic blocks and without; the narrowest corridor is 0.30 m, as in the drawing.
  for (const bool extended : {true, false}) {
    const std::vector<double> widths = open_gaps(extended);
    ASSERT_FALSE(widths.empty());
    EXPECT_NEAR(*std::min_element(widths.begin(), widths.end()), kCorridor_m, kRounding_m);
  }
}

TEST(SyrotekArena, OpenSpace_FitsDiscAsWideAsCorridor) {
  // Another test of this rule. Inflating all solids by half a corridor (minus a grid step) must not
  // divide any part of the floor that stays connected when they are inflated by half a closed gap.
  for (const bool extended : {true, false}) {
    const std::vector<Box> boxes = solids(extended);
    const Parts thin = parts_of_floor(boxes, 0.5 * kClosed_m + 0.001);
    const Parts wide = parts_of_floor(boxes, 0.5 * kCorridor_m - Parts::kCell_m);
    EXPECT_EQ(thin.count, wide.count) << "dynamic blocks extended: " << extended;
  }
}

TEST(SyrotekArena, RetractedBlocks_AllFloorReachable) {
  EXPECT_EQ(parts_of_floor(solids(false), 0.001).count, 1);
  // An S1R can, too; its farthest corner is 0.098 m from its centre.
  EXPECT_EQ(parts_of_floor(solids(false), 0.1).count, 1);
}

TEST(SyrotekArena, StartPose_FreeWithLongPathAhead) {
  for (const bool extended : {true, false}) {
    const std::vector<Box> boxes = solids(extended);
    const Pose X_WB = syrotek_start_pose();
    for (double ahead_m = 0.0; ahead_m <= 3.0; ahead_m += 0.01) {
      // 0.2 m of clearance on each side: an avoider that looks 40 degrees to both sides sees
      // nothing nearer than 0.2 m / sin(40 deg) = 0.31 m.
      EXPECT_GT(clearance_m(boxes, X_WB * Vec2(ahead_m, 0.0)), 0.2) << ahead_m;
    }
  }
}

}  // namespace
}  // namespace sim
