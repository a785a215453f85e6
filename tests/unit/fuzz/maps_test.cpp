// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace playpen::fuzz {
namespace {

constexpr double kCell_m = 0.02;

/// Which places of an area of 6 m x 4 m a robot of some radius can come to among walls.
class Ways {
 public:
  Ways(const std::vector<Element>& walls, double radius_m) : free_(kColumns * kRows, true) {
    for (const Element& wall : walls) {
      const double w = 0.5 * wall.size.x();
      const double h = 0.5 * wall.size.y();
      const auto cell = [](double x) { return static_cast<int>(std::max(x, 0.0) / kCell_m); };
      const int last_row = std::min(cell(wall.center.y() + h + radius_m), kRows - 1);
      const int last_column = std::min(cell(wall.center.x() + w + radius_m), kColumns - 1);
      for (int row = cell(wall.center.y() - h - radius_m); row <= last_row; ++row) {
        for (int column = cell(wall.center.x() - w - radius_m); column <= last_column; ++column) {
          const double x = std::abs((column + 0.5) * kCell_m - wall.center.x()) - w;
          const double y = std::abs((row + 0.5) * kCell_m - wall.center.y()) - h;
          if (std::hypot(std::max(x, 0.0), std::max(y, 0.0)) < radius_m) {
            free_[index(column, row)] = false;
          }
        }
      }
    }
  }

  [[nodiscard]] long count_free() const { return std::ranges::count(free_, true); }
  /// Number of free cells that can be reached from the first one.
  [[nodiscard]] long count_reached() const {
    std::vector<bool> left = free_;
    const auto first = static_cast<int>(std::ranges::find(left, true) - left.begin());
    std::vector<int> open = {first};
    left[static_cast<std::size_t>(first)] = false;
    long count = 0;
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      ++count;
      const int column = cell % kColumns;
      const int row = cell / kColumns;
      const auto visit = [&](int c, int r) {
        if (c < 0 || r < 0 || c >= kColumns || r >= kRows || !left[index(c, r)]) return;
        left[index(c, r)] = false;
        open.push_back(r * kColumns + c);
      };
      visit(column - 1, row);
      visit(column + 1, row);
      visit(column, row - 1);
      visit(column, row + 1);
    }
    return count;
  }

 private:
  static constexpr int kColumns = 300;
  static constexpr int kRows = 200;
  static std::size_t index(int column, int row) {
    return static_cast<std::size_t>(row * kColumns + column);
  }
  std::vector<bool> free_;
};

MapPlan plan() {
  MapPlan plan;
  plan.high = {6.0, 4.0};
  plan.width_m = {0.4, 0.6};
  plan.places = {{1.0, 1.0}, {4.4, 2.2}};
  plan.away_m = 0.25;
  return plan;
}

/// Expects what all maps have in common.
void expect_good(const std::vector<Element>& walls, const std::string& what) {
  EXPECT_GT(walls.size(), 2U) << what;
  EXPECT_LT(walls.size(), 120U) << what;
  for (const Element& wall : walls) {
    EXPECT_TRUE(wall.of_map);
    for (const int axis : {0, 1}) {
      EXPECT_GE(wall.center[axis] - 0.5 * wall.size[axis], 0.0) << what;
      EXPECT_LE(wall.center[axis] + 0.5 * wall.size[axis], plan().high[axis]) << what;
    }
    for (const sim::Vec2& place : plan().places) {
      const sim::Vec2 beyond = ((place - wall.center).cwiseAbs() - 0.5 * wall.size).cwiseMax(0.0);
      EXPECT_GT(beyond.norm(), 0.24) << what;
    }
  }
  // Corridors and doors are at least 0.4 m wide, so a radius of 0.17 m comes through all of them.
  const Ways ways(walls, 0.17);
  EXPECT_EQ(ways.count_reached(), ways.count_free()) << what;
}

TEST(FuzzMaps, Maze_AllOfItCanBeReached) {
  for (int i = 0; i < 10; ++i) {
    sim::RandomStream random(7, std::to_string(i));
    expect_good(maze_walls(plan(), random), "maze " + std::to_string(i));
  }
}

TEST(FuzzMaps, Rooms_AllOfThemCanBeReached) {
  for (int i = 0; i < 10; ++i) {
    sim::RandomStream random(7, std::to_string(i));
    expect_good(room_walls(plan(), random), "rooms " + std::to_string(i));
  }
}

TEST(FuzzMaps, AreaThatIsTooSmall_NoWalls) {
  MapPlan small = plan();
  small.high = {0.8, 4.0};
  small.width_m = {0.4, 0.4};
  sim::RandomStream random(1, "");
  EXPECT_TRUE(maze_walls(small, random).empty());  // two corridors of 0.45 m need 0.9 m
  small.high = {0.9, 0.9};
  EXPECT_TRUE(room_walls(small, random).empty());  // two rooms of 0.5 m need 1 m
}

}  // namespace
}  // namespace playpen::fuzz
