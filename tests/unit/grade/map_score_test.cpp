// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/map_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "drawn_map.h"
#include "sim/world/robot_model.h"

namespace playpen::grade {
namespace {

using sim::OccupancyMap;
using sim::Vec2;
using test_support::drawn_map;

/// A room of 4 x 3 cells, and a free cell behind a wall that cannot be reached.
const OccupancyMap kTruth = drawn_map({"########",  //
                                       "#....#.#",  //
                                       "#....###",  //
                                       "#....#.#",  //
                                       "########"});
const Vec2 kStart(1.5, 1.5);

TEST(CellState, UnknownAroundHalf) {
  EXPECT_EQ(cell_state(0.0F), CellState::kFree);
  EXPECT_EQ(cell_state(0.44F), CellState::kFree);
  EXPECT_EQ(cell_state(0.5F), CellState::kUnknown);
  // Greys of 8 bits have no middle: 127 and 128 of 255.
  EXPECT_EQ(cell_state(127.0F / 255.0F), CellState::kUnknown);
  EXPECT_EQ(cell_state(128.0F / 255.0F), CellState::kUnknown);
  EXPECT_EQ(cell_state(0.56F), CellState::kSolid);
  EXPECT_EQ(cell_state(1.0F), CellState::kSolid);
}

TEST(ReachableCells, JoinedToStartBySides) {
  const std::vector<std::uint8_t> reached = reachable_cells(kTruth, kStart);
  EXPECT_EQ(std::accumulate(reached.begin(), reached.end(), 0), 12);  // 4 x 3
  // Cells that meet only at a corner are not connected.
  const OccupancyMap corner = drawn_map({".#", "#."});
  const std::vector<std::uint8_t> one = reachable_cells(corner, {0.5, 1.5});
  EXPECT_EQ(std::accumulate(one.begin(), one.end(), 0), 1);
  EXPECT_EQ(one[0], 1);
}

TEST(ReachableCells, SolidStartOrOffMap_None) {
  for (const Vec2& start : {Vec2(0.5, 0.5), Vec2(-1.0, 1.0), Vec2(100.0, 1.0)}) {
    const std::vector<std::uint8_t> reached = reachable_cells(kTruth, start);
    EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), 0);
  }
}

TEST(ScoreMap, Truth_ScoresPerfect) {
  const MapScore score = score_map(kTruth, kTruth, kStart);
  EXPECT_EQ(score.coverage, 1.0);
  EXPECT_EQ(score.correctness, 1.0);
  EXPECT_EQ(score.reachable_cells, 12U);
  EXPECT_EQ(score.known_cells, 40U);
}

TEST(ScoreMap, Within_ConsidersFreeCellsOnly) {
  std::vector<std::uint8_t> all(kTruth.cells.size(), 1);
  const MapScore whole = score_map_within(kTruth, kTruth, all);
  EXPECT_EQ(whole.coverage, 1.0);
  EXPECT_GT(whole.reachable_cells, 12U) << "free cells that do not hang together with the start";
  EXPECT_LT(whole.reachable_cells, all.size()) << "solid cells do not count";
  EXPECT_EQ(score_map_within(kTruth, kTruth, std::vector<std::uint8_t>(all.size(), 0)).coverage,
            0.0);
}

TEST(ScoreMap, UnknownCells_CoverNothing) {
  const OccupancyMap map = drawn_map({"????????",  //
                                      "?..?????",  //
                                      "?..?????",  //
                                      "?...????",  //
                                      "????????"});
  const MapScore score = score_map(map, kTruth, kStart);
  EXPECT_DOUBLE_EQ(score.coverage, 7.0 / 12.0);
  EXPECT_EQ(score.correctness, 1.0);
  EXPECT_EQ(score.known_cells, 7U);
}

TEST(ScoreMap, Free_CorrectOnlyWhereTruthIsFree) {
  const OccupancyMap map = drawn_map({"????????",  //
                                      "?....???",  //
                                      "?....???",  //
                                      "?.......",  // the last three: solid, free, solid
                                      "????????"});
  const MapScore score = score_map(map, kTruth, kStart);
  EXPECT_EQ(score.coverage, 1.0);
  EXPECT_DOUBLE_EQ(score.correctness, 13.0 / 15.0);
}

TEST(ScoreMap, Solid_CorrectWithinOneCell) {
  const OccupancyMap truth = drawn_map({".....", ".....", "..#..", ".....", "....."});
  // Beside the block, at its corner, and two cells away.
  for (const auto& [rows, correctness] : std::vector<std::pair<std::vector<std::string>, double>>{
           {{"?????", "?????", "???#?", "?????", "?????"}, 1.0},
           {{"?????", "?#???", "?????", "?????", "?????"}, 1.0},
           {{"?????", "?????", "????#", "?????", "?????"}, 0.0}}) {
    EXPECT_EQ(score_map(drawn_map(rows), truth, {0.5, 0.5}).correctness, correctness);
  }
}

TEST(ScoreMap, UnknownMap_ScoresZero) {
  const OccupancyMap blank = drawn_map(std::vector<std::string>(5, std::string(8, '?')));
  const MapScore score = score_map(blank, kTruth, kStart);
  EXPECT_EQ(score.coverage, 0.0);
  EXPECT_EQ(score.correctness, 0.0);
}

TEST(ScoreMap, ComparesByWorldPosition) {
  // Only the room's left part, with cells of half the size and another origin.
  OccupancyMap map = drawn_map(std::vector<std::string>(6, std::string(4, '.')), 0.5, {1.0, 1.0});
  const MapScore fine = score_map(map, kTruth, kStart);
  EXPECT_DOUBLE_EQ(fine.coverage, 6.0 / 12.0);
  EXPECT_EQ(fine.correctness, 1.0);
  EXPECT_EQ(fine.known_cells, 24U);
  // Half of the map is outside the truth, where it is ignored.
  map.origin = {-1.0, 1.0};
  const MapScore off = score_map(map, kTruth, kStart);
  EXPECT_EQ(off.known_cells, 12U);
  EXPECT_EQ(off.correctness, 0.0) << "the wall on the left, called free";
  // A coarse cell covers everything below it.
  const OccupancyMap coarse = drawn_map({"."}, 3.0, {1.0, 1.0});
  EXPECT_DOUBLE_EQ(score_map(coarse, kTruth, kStart).coverage, 9.0 / 12.0);
}

TEST(MakeTruth, HasFloorWithBorder) {
  const sim::ArenaDescription arena = sim::syrotek_arena();
  const OccupancyMap truth = make_truth(arena);
  EXPECT_EQ(truth.cell_size_m, 0.02);
  EXPECT_EQ(truth.width, 171 + 4);   // 3.42 m and two cells on each side
  EXPECT_EQ(truth.height, 186 + 4);  // 3.72 m
  EXPECT_EQ(truth.origin, Vec2(-0.04, -0.04));
  for (int column = 0; column < truth.width; ++column) {
    EXPECT_EQ(truth.at(column, 1), 1.0F) << "the upper border";
    EXPECT_EQ(truth.at(column, truth.height - 2), 1.0F) << "the lower border";
  }
  // The robot's start is free, and most of the floor can be reached from there.
  const Vec2 start = sim::syrotek_start_pose().position();
  const std::vector<std::uint8_t> reached = reachable_cells(truth, start);
  const auto count = static_cast<double>(std::count(reached.begin(), reached.end(), 1));
  EXPECT_GT(count, 0.6 * 171.0 * 186.0);
  EXPECT_LT(count, 171.0 * 186.0);
}

}  // namespace
}  // namespace playpen::grade
