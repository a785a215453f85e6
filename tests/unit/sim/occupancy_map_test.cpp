// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/occupancy_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "outlines.h"
#include "sim/world/robot_model.h"

namespace sim {
namespace {

ArenaDescription open_floor(double width_m, double height_m) {
  ArenaDescription arena;
  arena.size = {width_m, height_m};
  arena.border = false;
  return arena;
}

ObstacleDescription box(Vec2 center, Vec2 size, double yaw_rad = 0.0) {
  return test::box("", std::move(center), std::move(size), yaw_rad);
}

CanvasDescription grid_of(int width, int height, double cell_size_m = 1.0,
                          Vec2 origin = Vec2::Zero()) {
  return {
      .width = width, .height = height, .cell_size_m = cell_size_m, .origin = std::move(origin)};
}

/// The map as text: # is occupied, . is free, the top row first.
std::vector<std::string> drawn(const OccupancyMap& map) {
  std::vector<std::string> rows;
  for (int row = 0; row < map.height; ++row) {
    rows.emplace_back();
    for (int column = 0; column < map.width; ++column) {
      rows.back() += map.at(column, row) == 1.0F ? '#' : map.at(column, row) == 0.0F ? '.' : '?';
    }
  }
  return rows;
}

using Rows = std::vector<std::string>;

TEST(TrueMap, PlaceAndSize_FromGrid) {
  const OccupancyMap map = true_map(open_floor(4, 3), grid_of(4, 3, 0.5, {-1.0, 2.0}));
  EXPECT_EQ(map.width, 4);
  EXPECT_EQ(map.height, 3);
  EXPECT_EQ(map.cell_size_m, 0.5);
  EXPECT_EQ(map.origin, Vec2(-1.0, 2.0));
  EXPECT_EQ(map.cells, std::vector<float>(12, 0.0F));
}

TEST(TrueMap, TouchedCell_Free) {
  ArenaDescription arena = open_floor(5, 4);
  arena.obstacles.push_back(box({1.5, 2.5}, {1.0, 1.0}));
  EXPECT_EQ(drawn(true_map(arena, grid_of(5, 4))), (Rows{".....",  //
                                                         ".#...",  //
                                                         ".....",  //
                                                         "....."}));
  // 0.01 m larger on each side: it reaches into the eight cells around it.
  arena.obstacles[0].size = {1.02, 1.02};
  EXPECT_EQ(drawn(true_map(arena, grid_of(5, 4))), (Rows{"###..",  //
                                                         "###..",  //
                                                         "###..",  //
                                                         "....."}));
}

TEST(TrueMap, InexactBinaryPlaces_TouchAsMeasured) {
  // x = 0.82 to 0.94 and y = 0.46 to 0.58 are cells 41 to 46 and 23 to 28 of 0.02 m. In double
  // precision, quotients such as 0.82 / 0.02 may round to either side.
  ArenaDescription arena = open_floor(3.42, 3.72);
  for (const double yaw_rad : {0.0, std::numbers::pi / 2, std::numbers::pi}) {
    arena.obstacles = {box({0.88, 0.52}, {0.12, 0.12}, yaw_rad)};
    const OccupancyMap map = true_map(arena, grid_of(172, 186, 0.02));
    for (int row = 0; row < 186; ++row) {
      for (int column = 0; column < 172; ++column) {
        const int from_bottom = 185 - row;
        const bool inside = column >= 41 && column <= 46 && from_bottom >= 23 && from_bottom <= 28;
        ASSERT_EQ(map.at(column, row), inside ? 1.0F : 0.0F) << column << " " << from_bottom;
      }
    }
  }
}

TEST(TrueMap, RotatedBox_FillsCellsItReaches) {
  // A square of side sqrt(8) rotated by 45 degrees: a diamond with corners 2 m from (3, 3).
  ArenaDescription arena = open_floor(6, 6);
  arena.obstacles.push_back(box({3, 3}, {std::sqrt(8.0), std::sqrt(8.0)}, std::numbers::pi / 4));
  EXPECT_EQ(drawn(true_map(arena, grid_of(6, 6))), (Rows{"......",  //
                                                         "..##..",  //
                                                         ".####.",  //
                                                         ".####.",  //
                                                         "..##..",  //
                                                         "......"}));
}

TEST(TrueMap, RetractedBlocks_FreeButSeparatorsNot) {
  ArenaDescription arena = open_floor(4, 1);
  arena.obstacles.push_back(box({0.5, 0.5}, {0.5, 0.5}));
  arena.obstacles[0].type = ObstacleType::kDynamic;
  arena.obstacles[0].state = ObstacleState::kRetracted;
  arena.dock_separators.push_back(box({2.5, 0.5}, {0.01, 0.5}));
  EXPECT_EQ(drawn(true_map(arena, grid_of(4, 1))), Rows{"..#."});
  arena.obstacles[0].state = ObstacleState::kExtended;
  EXPECT_EQ(drawn(true_map(arena, grid_of(4, 1))), Rows{"#.#."});
}

TEST(TrueMap, BeyondFloor_BorderIfAny) {
  ArenaDescription arena = open_floor(2.5, 2.0);
  arena.origin = {1.0, 1.0};
  EXPECT_EQ(drawn(true_map(arena, grid_of(5, 4))), Rows(4, "....."));
  arena.border = true;
  // The floor's right side, x = 3.5, is in the middle of a cell.
  EXPECT_EQ(drawn(true_map(arena, grid_of(5, 4))), (Rows{"#####",  //
                                                         "#..##",  //
                                                         "#..##",  //
                                                         "#####"}));
}

TEST(TrueMap, ArenaFloor_FitsCanvas) {
  // 3.42 m are 171 cells, while the canvas has 172; 3.72 m are its 186.
  const OccupancyMap map = true_map(syrotek_arena(), grid_of(172, 186, 0.02));
  int occupied_in_last_column = 0;
  int occupied_in_first_row = 0;
  for (int row = 0; row < 186; ++row) occupied_in_last_column += map.at(171, row) == 1.0F;
  for (int column = 0; column < 60; ++column) occupied_in_first_row += map.at(column, 0) == 1.0F;
  EXPECT_EQ(occupied_in_last_column, 186);
  EXPECT_EQ(occupied_in_first_row, 0);  // no block stands at the top left
}

TEST(TrueMap, Walls_SolidOnLeft) {
  ArenaDescription arena = open_floor(8, 7);
  // A solid square from (0.5, 0.5) to (6.5, 6), with a hole from (2, 2) to (5, 5), and in the hole
  // a triangular island.
  arena.walls.push_back({{{0.5, 0.5}, {6.5, 0.5}, {6.5, 6.0}, {0.5, 6.0}}});
  arena.walls.push_back({{{2, 2}, {2, 5}, {5, 5}, {5, 2}}});
  arena.walls.push_back({{{3.2, 3.2}, {3.8, 3.2}, {3.5, 3.8}}});
  EXPECT_EQ(drawn(true_map(arena, grid_of(8, 7))), (Rows{"........",  //
                                                         "#######.",  //
                                                         "##...##.",  //
                                                         "##.#.##.",  //
                                                         "##...##.",  //
                                                         "#######.",  //
                                                         "#######."}));
}

TEST(TrueMap, ObjectsBesideGrid_CutOff) {
  ArenaDescription arena = open_floor(100, 100);
  arena.obstacles.push_back(box({-1e6, 0}, {2.0, 2.0}));
  arena.obstacles.push_back(box({0, 0}, {3.0, 1e6}));  // right side at x = 1.5
  arena.walls.push_back({{{2.5, -1e5}, {1e6, -1e5}, {1e6, 0.5}, {2.5, 0.5}}});
  EXPECT_EQ(drawn(true_map(arena, grid_of(4, 2))), (Rows{"##..",  //
                                                         "####"}));
}

/// Whether a point is in the solid of the walls (winding number with the ray to the right).
bool in_walls(const std::vector<WallLoop>& walls, const Vec2& p) {
  int winding = 0;
  for (const WallLoop& loop : walls) {
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      const Vec2& a = loop.vertices[i];
      const Vec2& b = loop.vertices[(i + 1) % loop.vertices.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x()) {
        winding += b.y() > a.y() ? 1 : -1;
      }
    }
  }
  return winding > 0;
}

bool in_box(const ObstacleDescription& o, const Vec2& p) {
  const Pose X_WO{o.center.x(), o.center.y(), o.yaw_rad};
  const Vec2 q = X_WO.inverse() * p;
  return std::abs(q.x()) < 0.5 * o.size.x() && std::abs(q.y()) < 0.5 * o.size.y();
}

// Every solid sample must be in an occupied cell. An occupied cell must contain such a sample,
// unless the solid extends into it by less than the distance of the samples.
TEST(TrueMap, RandomArenas_MatchSamples) {
  constexpr int kCells = 24;
  constexpr int kSamples = 24;  // along a side of a cell
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int occupied_without_sample = 0;
  int occupied = 0;
  for (int round = 0; round < 12; ++round) {
    ArenaDescription arena = open_floor(6, 6);
    for (int i = 0; i < 4; ++i) {
      arena.obstacles.push_back(box({uniform(0, 6), uniform(0, 6)},
                                    {uniform(0.02, 2), uniform(0.02, 2)}, uniform(-4, 4)));
    }
    // A star with a star-shaped hole: both are concave.
    const Vec2 middle(uniform(2, 4), uniform(2, 4));
    WallLoop outer;
    WallLoop hole;
    for (int i = 0; i < 14; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 14.0;
      const Vec2 direction(std::cos(angle), std::sin(angle));
      outer.vertices.emplace_back(middle + uniform(1.2, 2.5) * direction);
      hole.vertices.insert(hole.vertices.begin(), middle + uniform(0.2, 1.0) * direction);
    }
    arena.walls = {outer, hole};
    const double cell_m = uniform(0.2, 0.3);
    const Vec2 origin(uniform(-1, 1), uniform(-1, 1));
    const OccupancyMap map = true_map(arena, grid_of(kCells, kCells, cell_m, origin));
    for (int row = 0; row < kCells; ++row) {
      for (int column = 0; column < kCells; ++column) {
        bool solid = false;
        for (int i = 0; i < kSamples * kSamples; ++i) {
          const Vec2 in_cell((i % kSamples + 0.5) / kSamples, (i / kSamples + 0.5) / kSamples);
          const Vec2 p = origin + cell_m * (Vec2(column, kCells - 1 - row) + in_cell);
          solid = solid || in_walls(arena.walls, p) ||
                  std::any_of(arena.obstacles.begin(), arena.obstacles.end(),
                              [&p](const ObstacleDescription& o) { return in_box(o, p); });
          if (solid) break;
        }
        if (solid) {
          ASSERT_EQ(map.at(column, row), 1.0F) << round << ": " << column << ", " << row;
        }
        occupied += map.at(column, row) == 1.0F;
        occupied_without_sample += map.at(column, row) == 1.0F && !solid;
      }
    }
  }
  ASSERT_GT(occupied, 2000);
  // Samples miss only slivers: on outlines, about one cell in some hundred has a solid that extends
  // into its corner by less than 1/24 of its side.
  EXPECT_LT(occupied_without_sample, occupied / 100);
}

}  // namespace
}  // namespace sim
