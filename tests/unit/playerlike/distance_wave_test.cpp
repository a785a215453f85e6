// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Paths on maps, without a simulation.
#include "drivers/distance_wave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace playerlike {
namespace {

using sim::Vec2;

// A map from rows of text, the topmost first: '#' occupied, '?' unknown, other characters free.
sim::OccupancyMap map_of(const std::vector<std::string>& rows, double cell_size_m = 0.1) {
  sim::OccupancyMap map;
  map.width = static_cast<int>(rows.front().size());
  map.height = static_cast<int>(rows.size());
  map.cell_size_m = cell_size_m;
  for (const std::string& row : rows) {
    for (const char c : row) map.cells.push_back(c == '#' ? 1.0F : c == '?' ? 0.5F : 0.0F);
  }
  return map;
}

WavefrontSettings point_robot() {
  WavefrontSettings settings;
  settings.robot_radius_m = 0.01;
  settings.safety_dist_m = 0.0;
  settings.dist_penalty = 0.0;
  return settings;
}

std::vector<std::string> empty_rows(int width, int height) {
  return std::vector<std::string>(static_cast<std::size_t>(height),
                                  std::string(static_cast<std::size_t>(width), '.'));
}

TEST(DistanceWave, Clearances_MatchAllPairsOfCells) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::string> rows = empty_rows(17, 11);
    for (std::string& row : rows) {
      for (char& c : row) c = random() % 9 == 0 ? '#' : '.';
    }
    const sim::OccupancyMap map = map_of(rows);
    const DistanceWave wave(map, point_robot());
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        double nearest = std::numeric_limits<double>::infinity();
        for (int v = -1; v <= map.height; ++v) {
          for (int u = -1; u <= map.width; ++u) {
            const bool outside = u < 0 || v < 0 || u == map.width || v == map.height;
            if (outside || map.at(u, map.height - 1 - v) > 0.5F)
              nearest = std::min(nearest, std::hypot(u - x, v - y));
          }
        }
        EXPECT_NEAR(wave.clearance_m({0.1 * x + 0.05, 0.1 * y + 0.05}),
                    0.1 * std::max(0.0, nearest - 0.5), 1e-9);
      }
    }
  }
}

TEST(DistanceWave, FreeSpace_WaypointIsGoal) {
  const DistanceWave wave(map_of(empty_rows(30, 30)), point_robot());
  const auto path = wave.plan({0.55, 0.55}, {2.45, 1.85});
  ASSERT_TRUE(path);
  ASSERT_EQ(path->waypoints.size(), 1U);
  EXPECT_EQ(path->waypoints[0], Vec2(2.45, 1.85));
  EXPECT_DOUBLE_EQ(path->length_m, std::hypot(1.9, 1.3));
}

TEST(DistanceWave, Wall_PassedOnShorterSideWithClearance) {
  std::vector<std::string> rows = empty_rows(40, 40);
  // A wall at x = 2.0 from the bottom up to y = 2.4.
  for (std::size_t r = 16; r < 40; ++r) rows[r][20] = '#';
  WavefrontSettings settings = point_robot();
  settings.robot_radius_m = 0.2;
  settings.safety_dist_m = 0.1;
  const DistanceWave wave(map_of(rows), settings);
  const auto path = wave.plan({1.05, 1.05}, {3.05, 1.05});
  ASSERT_TRUE(path);
  for (const Vec2& cell : path->cells) EXPECT_GE(wave.clearance_m(cell), 0.3);
  // At least over the corner: hypot(1, 1.35) twice.
  EXPECT_GT(path->length_m, 2.0 * std::hypot(1.0, 1.35));
  EXPECT_LT(path->length_m, 2.0 * std::hypot(1.0, 1.35) + 1.2);
  Vec2 before(1.05, 1.05);
  for (const Vec2& waypoint : path->waypoints) {
    EXPECT_TRUE(wave.is_line_free(before, waypoint));
    before = waypoint;
  }
}

TEST(DistanceWave, NarrowOrUnknownGap_NoPath) {
  std::vector<std::string> rows = empty_rows(40, 20);
  for (std::string& row : rows) row[20] = '#';
  for (const std::size_t r : {9U, 10U, 11U, 12U}) rows[r][20] = '.';
  WavefrontSettings settings = point_robot();
  settings.robot_radius_m = 0.15;
  EXPECT_TRUE(DistanceWave(map_of(rows), settings).plan({1.0, 1.0}, {3.0, 1.0}));
  settings.safety_dist_m = 0.1;
  EXPECT_FALSE(DistanceWave(map_of(rows), settings).plan({1.0, 1.0}, {3.0, 1.0}));
  settings.safety_dist_m = 0.0;
  rows[10][20] = '?';
  EXPECT_FALSE(DistanceWave(map_of(rows), settings).plan({1.0, 1.0}, {3.0, 1.0}));
}

TEST(DistanceWave, Penalty_KeepsPathInMiddle) {
  const std::vector<std::string> rows = empty_rows(60, 20);  // a corridor of 2 m
  WavefrontSettings settings = point_robot();
  settings.robot_radius_m = 0.2;
  const auto lowest = [&](double penalty) {
    settings.dist_penalty = penalty;
    double lowest_m = 10.0;
    const auto path = DistanceWave(map_of(rows), settings).plan({0.35, 0.35}, {5.65, 0.35});
    double middle_m = 0.0;
    for (const Vec2& cell : path->cells) {
      if (cell.x() > 2.5 && cell.x() < 3.5) middle_m = std::max(middle_m, cell.y());
      lowest_m = std::min(lowest_m, cell.y());
    }
    return middle_m;
  };
  EXPECT_LT(lowest(0.0), 0.5);
  EXPECT_GT(lowest(5.0), 0.8);
}

TEST(DistanceWave, StartNearWall_MovedButGoalNearWallHasNoPath) {
  WavefrontSettings settings = point_robot();
  settings.robot_radius_m = 0.3;
  const DistanceWave wave(map_of(empty_rows(40, 40)), settings);
  const auto path = wave.plan({0.1, 2.0}, {3.0, 2.0});
  ASSERT_TRUE(path);
  EXPECT_GE(path->cells.front().x(), 0.3);
  EXPECT_FALSE(wave.plan({3.0, 2.0}, {0.1, 2.0}));
  EXPECT_FALSE(wave.plan({3.0, 2.0}, {-5.0, 2.0}));
  EXPECT_FALSE(wave.plan({-5.0, 2.0}, {3.0, 2.0}));
  EXPECT_FALSE(wave.plan({3.0, 2.0}, {std::nan(""), 2.0}));
}

}  // namespace
}  // namespace playerlike
