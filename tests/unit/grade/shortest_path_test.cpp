// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/shortest_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "drawn_map.h"

namespace playpen::grade {
namespace {

using sim::Vec2;
using test_support::drawn_map;

/// Ends are rounded to 1/1024 cell, in each of two coordinates, at both ends of a piece.
constexpr double kRounding_m = 2e-3;

double length(const sim::OccupancyMap& map, const Vec2& start, const Vec2& goal) {
  const std::optional<Way> way = shortest_way(map, start, goal);
  return way ? way->length_m : std::numeric_limits<double>::infinity();
}

TEST(Inflate, MeasuresFromCellCentreToSolidArea) {
  const sim::OccupancyMap map = drawn_map({".....", ".....", "..#..", ".....", "....."});
  // The centre of a side neighbour is 0.5 cells away, of a corner neighbour 0.71, of the next cell
  // 1.5.
  EXPECT_EQ(inflate(map, 0.5).cells, map.cells);
  EXPECT_EQ(inflate(map, 0.51).cells,
            drawn_map({".....", "..#..", ".###.", "..#..", "....."}).cells);
  EXPECT_EQ(inflate(map, 0.71).cells,
            drawn_map({".....", ".###.", ".###.", ".###.", "....."}).cells);
  EXPECT_EQ(inflate(map, 1.55).cells,
            drawn_map({"..#..", ".###.", "#####", ".###.", "..#.."}).cells);
}

TEST(Inflate, UsesMetres) {
  const sim::OccupancyMap map = drawn_map({"###..", "###..", "###.."}, 0.02);
  EXPECT_EQ(inflate(map, 0.011).cells, drawn_map({"####.", "####.", "####."}).cells);
  EXPECT_EQ(inflate(map, 0.0).cells, map.cells);
}

TEST(ShortestWay, FreeMap_Straight) {
  const sim::OccupancyMap map = drawn_map({".....", ".....", "....."});
  const std::optional<Way> way = shortest_way(map, {0.25, 0.25}, {4.25, 2.25});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->length_m, std::hypot(4.0, 2.0), kRounding_m);
  EXPECT_EQ(way->points.size(), 2U);
  EXPECT_EQ(length(map, {1.0, 1.0}, {1.0, 1.0}), 0.0);
}

TEST(ShortestWay, TurnsAtCornersOfObstacles) {
  const sim::OccupancyMap map = drawn_map({".....", "..#..", "..#..", "..#..", "....."});
  // From (0.5, 2.5) around the corners (2, 4) and (3, 4), or symmetrically below, to (4.5, 2.5).
  const std::optional<Way> way = shortest_way(map, {0.5, 2.5}, {4.5, 2.5});
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->length_m, 2.0 * std::hypot(1.5, 1.5) + 1.0, kRounding_m);
  ASSERT_EQ(way->points.size(), 4U);
  EXPECT_EQ(way->points.front(), Vec2(0.5, 2.5));
  EXPECT_EQ(way->points.back(), Vec2(4.5, 2.5));
  EXPECT_EQ(std::abs(way->points[1].y() - 2.5), 1.5);
  EXPECT_EQ(way->points[1].x(), 2.0);
}

TEST(ShortestWay, DeadEnd_Avoided) {
  const sim::OccupancyMap map =
      drawn_map({".......", ".####..", "....#..", "....#..", ".####..", "......."});
  // Out of the pocket to the left, over the corners (1, 5) and (5, 5), down to the right.
  EXPECT_NEAR(length(map, {3.5, 3.0}, {6.5, 3.0}),
              std::hypot(2.5, 1.0) + 1.0 + 4.0 + std::hypot(1.5, 2.0), kRounding_m);
}

TEST(ShortestWay, DiagonalGap_Closed) {
  const sim::OccupancyMap closed = drawn_map({"..#", ".#.", "#.."});
  EXPECT_FALSE(shortest_way(closed, {0.5, 2.5}, {2.5, 0.5}));
  const sim::OccupancyMap mirrored = drawn_map({"#..", ".#.", "..#"});
  EXPECT_FALSE(shortest_way(mirrored, {0.5, 0.5}, {2.5, 2.5}));
  // Nor along the line on which they meet.
  const sim::OccupancyMap upright = drawn_map({"#.", ".#"});
  EXPECT_FALSE(shortest_way(upright, {1.0, 0.2}, {1.0, 1.8}));
  EXPECT_FALSE(shortest_way(upright, {0.2, 1.0}, {1.8, 1.0}));
}

TEST(ShortestWay, SolidSide_PassableOnOneSideOnly) {
  EXPECT_NEAR(length(drawn_map({"###", "..."}), {0.5, 1.0}, {2.5, 1.0}), 2.0, 1e-12);
  EXPECT_FALSE(shortest_way(drawn_map({".#.", ".#."}), {0.5, 1.0}, {2.5, 1.0}));
}

TEST(ShortestWay, UsesOriginAndCellSize) {
  const sim::OccupancyMap map = drawn_map({".....", "..#..", "..#.."}, 0.1, {-5.0, 7.0});
  // In cells from (0.5, 1) over (2, 2) and (3, 2) to (4.5, 1).
  EXPECT_NEAR(length(map, {-4.95, 7.1}, {-4.55, 7.1}), 0.1 * (2.0 * std::hypot(1.5, 1.0) + 1.0),
              0.1 * kRounding_m);
}

TEST(ShortestWay, SolidEnds_MovedToNearestFreeCell) {
  const sim::OccupancyMap map = drawn_map({"#...", "#...", "#..."});
  EXPECT_FALSE(shortest_way(map, {0.5, 1.5}, {3.5, 1.5}));
  EXPECT_FALSE(shortest_way(map, {0.5, 1.5}, {3.5, 1.5}, 0.99));
  const std::optional<Way> way = shortest_way(map, {0.5, 1.5}, {3.5, 1.5}, 1.0);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->length_m, 3.0, kRounding_m);
  EXPECT_EQ(way->points.front(), Vec2(0.5, 1.5));
  EXPECT_TRUE(shortest_way(map, {3.5, 1.5}, {0.5, 1.5}, 1.0));
  EXPECT_FALSE(shortest_way(map, {9.0, 9.0}, {3.5, 1.5}, 1.0)) << "far off the map";
}

/// A slow reference: boxes for solid cells, and all crossings of grid lines as nodes.
class SlowSearch {
 public:
  explicit SlowSearch(const sim::OccupancyMap& map) : map_(map) {
    constexpr double kShrink = 1e-7;  // touching is allowed
    const auto add = [&](double x0, double y0, double x1, double y1) {
      boxes_.push_back({{x0 + kShrink, y0 + kShrink}, {x1 - kShrink, y1 - kShrink}});
    };
    for (int y = -1; y <= map.height; ++y) {
      for (int x = -1; x <= map.width; ++x) {
        if (!solid(x, y)) continue;
        add(x, y, x + 1, y + 1);
        // Two adjacent cells leave no gap between them.
        if (solid(x + 1, y)) add(x, y, x + 2, y + 1);
        if (solid(x, y + 1)) add(x, y, x + 1, y + 2);
        if (solid(x + 1, y + 1)) slits_.emplace_back(x + 1, y + 1);
        if (solid(x - 1, y + 1)) slits_.emplace_back(x, y + 1);
      }
    }
  }

  [[nodiscard]] double length(const Vec2& start, const Vec2& goal) const {
    std::vector<Vec2> nodes = {start, goal};
    for (int y = 0; y <= map_.height; ++y) {
      for (int x = 0; x <= map_.width; ++x) nodes.emplace_back(x, y);
    }
    std::vector<double> lengths(nodes.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> done(nodes.size(), false);
    lengths[0] = 0.0;
    for (std::size_t round = 0; round < nodes.size(); ++round) {
      std::size_t here = nodes.size();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!done[i] && (here == nodes.size() || lengths[i] < lengths[here])) here = i;
      }
      if (here == 1 || std::isinf(lengths[here])) break;
      done[here] = true;
      for (std::size_t next = 1; next < nodes.size(); ++next) {
        const double total = lengths[here] + (nodes[next] - nodes[here]).norm();
        if (total < lengths[next] && sees(nodes[here], nodes[next])) lengths[next] = total;
      }
    }
    return lengths[1];
  }

 private:
  struct Box {
    Vec2 low;
    Vec2 high;
  };

  [[nodiscard]] bool solid(int x, int y) const {
    if (x < 0 || y < 0 || x >= map_.width || y >= map_.height) return true;
    return map_.at(x, map_.height - 1 - y) > 0.5F;
  }

  [[nodiscard]] bool sees(const Vec2& a, const Vec2& b) const {
    for (const Box& box : boxes_) {
      // The part of the line between both pairs of sides (Liang and Barsky).
      double from = 0.0;
      double to = 1.0;
      for (int axis = 0; axis < 2; ++axis) {
        const double step = b[axis] - a[axis];
        if (step == 0.0) {
          if (a[axis] < box.low[axis] || a[axis] > box.high[axis]) to = -1.0;
          continue;
        }
        const double one = (box.low[axis] - a[axis]) / step;
        const double other = (box.high[axis] - a[axis]) / step;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
      }
      if (from < to) return false;
    }
    for (const Vec2& slit : slits_) {
      const Vec2 along = b - a;
      const double t = (slit - a).dot(along) / along.squaredNorm();
      if (t > 0.0 && t < 1.0 && (a + t * along - slit).norm() < 1e-9) return false;
    }
    // A path must not turn where it could change to the other side of a slit.
    return std::none_of(slits_.begin(), slits_.end(),
                        [&](const Vec2& slit) { return slit == a || slit == b; });
  }

  const sim::OccupancyMap& map_;
  std::vector<Box> boxes_;
  std::vector<Vec2> slits_;  ///< where two solid cells meet at a corner
};

TEST(ShortestWay, RandomMaps_MatchSlowSearch) {
  std::mt19937 random(7);  // the same numbers everywhere, as the standard fixes this engine
  int ways = 0;
  for (unsigned trial = 0; trial < 120; ++trial) {
    sim::OccupancyMap map = drawn_map(std::vector<std::string>(8, std::string(9, '.')));
    for (float& cell : map.cells) cell = random() % 100 < 10 + trial % 30 ? 1.0F : 0.0F;
    map.cells[7 * 9] = 0.0F;
    map.cells[8] = 0.0F;
    const double slow = SlowSearch(map).length({0.5, 0.5}, {8.5, 7.5});
    const double fast = length(map, {0.5, 0.5}, {8.5, 7.5});
    if (std::isinf(slow)) {
      EXPECT_TRUE(std::isinf(fast)) << trial;
      continue;
    }
    ++ways;
    EXPECT_NEAR(fast, slow, 1e-9) << trial;  // halves are rounded to themselves
  }
  EXPECT_GT(ways, 40);
  EXPECT_LT(ways, 120);
}

TEST(ShortestWay, Reversed_SameLength) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 50; ++trial) {
    sim::OccupancyMap map = drawn_map(std::vector<std::string>(10, std::string(10, '.')));
    for (float& cell : map.cells) cell = random() % 100 < 20 ? 1.0F : 0.0F;
    map.cells[90] = 0.0F;
    map.cells[9] = 0.0F;
    const double there = length(map, {0.5, 0.5}, {9.5, 9.5});
    const double back = length(map, {9.5, 9.5}, {0.5, 0.5});
    if (std::isinf(there)) {
      EXPECT_TRUE(std::isinf(back)) << trial;
    } else {
      EXPECT_NEAR(there, back, 1e-9) << trial;
    }
  }
}

}  // namespace
}  // namespace playpen::grade
