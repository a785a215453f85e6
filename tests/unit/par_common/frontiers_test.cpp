// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/frontiers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grids.h"

namespace par {
namespace {

/// `.` free, `#` occupied, `?` unknown.
Grid<CellState> states(const std::vector<std::string>& rows) {
  Grid<CellState> result(
      test::frame(static_cast<int>(rows.front().size()), static_cast<int>(rows.size())));
  for (std::size_t i = 0; i < result.values().size(); ++i) {
    const Cell cell = result.frame().cell_at(i);
    const char c = rows[static_cast<std::size_t>(cell.row)][static_cast<std::size_t>(cell.column)];
    result.values()[i] = c == '.'   ? CellState::kFree
                         : c == '#' ? CellState::kOccupied
                                    : CellState::kUnknown;
  }
  return result;
}

TEST(Frontiers, FreeCellsBesideUnknown) {
  const Mask frontier = frontier_cells(states({"???????",  //
                                               "?#####?",  //
                                               "?#...??",  // only its right end is open
                                               "?#.#.#?",  //
                                               "?#.####"}));
  EXPECT_EQ(frontier.values(), test::mask({".......",  //
                                           ".......",  //
                                           "....#..",  //
                                           ".......",  //
                                           "......."})
                                   .values());
}

TEST(Frontiers, EdgeAndCorners_AreNone) {
  EXPECT_EQ(count(frontier_cells(states({"...", "..."}))), 0U);
  // The unknown cell touches free ones only at a corner.
  EXPECT_EQ(count(frontier_cells(states({"?#", "#."}))), 0U);
  EXPECT_EQ(count(frontier_cells(states({"##", "??"}))), 0U);
}

TEST(Cluster, TouchingCells_JoinedAlsoAtCorners) {
  const std::vector<Frontier> frontiers = cluster(test::mask({"#....",  //
                                                              ".#..#",  //
                                                              "....#",  //
                                                              "##..#"}));
  ASSERT_EQ(frontiers.size(), 3U);
  EXPECT_EQ(frontiers[0].cells, (std::vector<Cell>{{0, 0}, {1, 1}}));
  EXPECT_EQ(frontiers[1].cells, (std::vector<Cell>{{4, 1}, {4, 2}, {4, 3}}));
  EXPECT_EQ(frontiers[1].centre, (Cell{4, 2}));
  EXPECT_EQ(frontiers[2].cells, (std::vector<Cell>{{0, 3}, {1, 3}}));
}

TEST(Cluster, SmallClusters_LeftOut) {
  const Mask cells = test::mask({"#.##.###"});
  EXPECT_EQ(cluster(cells, 1).size(), 3U);
  EXPECT_EQ(cluster(cells, 2).size(), 2U);
  EXPECT_EQ(cluster(cells, 3).size(), 1U);
  EXPECT_TRUE(cluster(cells, 4).empty());
}

TEST(Cluster, Centre_IsCellOfBentFrontier) {
  // The mean of a ring is its empty middle.
  const std::vector<Frontier> ring = cluster(test::mask({"###", "#.#", "###"}));
  ASSERT_EQ(ring.size(), 1U);
  EXPECT_EQ(ring[0].cells.size(), 8U);
  EXPECT_EQ(distance_cells(ring[0].centre, {1, 1}), 1.0);
}

TEST(Frontiers, FoundAndClusteredInOneCall) {
  const std::vector<Frontier> frontiers = find_frontiers(states({"..?..", "..?.."}));
  ASSERT_EQ(frontiers.size(), 2U);
  EXPECT_EQ(frontiers[0].cells, (std::vector<Cell>{{1, 0}, {1, 1}}));
  EXPECT_EQ(frontiers[1].cells, (std::vector<Cell>{{3, 0}, {3, 1}}));
}

TEST(Split, LongFrontier_CutIntoShortParts) {
  const Frontier line = cluster(test::mask({std::string(36, '#')})).front();
  // 36 cells, range 10: 1 + floor(36 / 18 + 0.5) = 3 parts of 12, plus or minus a cell that is
  // midway between two means.
  const std::vector<Frontier> parts = split(line, 10.0);
  ASSERT_EQ(parts.size(), 3U);
  std::vector<int> columns;
  for (const Frontier& part : parts) {
    EXPECT_NEAR(static_cast<double>(part.cells.size()), 12.0, 1.0);
    EXPECT_NE(std::find(part.cells.begin(), part.cells.end(), part.centre), part.cells.end());
    for (const Cell& cell : part.cells) columns.push_back(cell.column);
  }
  std::sort(columns.begin(), columns.end());
  for (int i = 0; i < 36; ++i) EXPECT_EQ(columns[static_cast<std::size_t>(i)], i);
}

TEST(Split, ShortFrontier_Whole) {
  const Frontier line = cluster(test::mask({"#####"})).front();
  // 1 + floor(5 / 18 + 0.5) = 1.
  EXPECT_EQ(split(line, 10.0).size(), 1U);
  EXPECT_EQ(split(line, 10.0).front().cells, line.cells);
  EXPECT_EQ(split(line, 0.1).size(), 5U) << "no more parts than cells";
  EXPECT_THROW(static_cast<void>(split(line, 0.0)), std::invalid_argument);
}

TEST(InformationGain, CountsVisibleUnknownCellsWithinRange) {
  const Grid<CellState> map = states({".....??",  //
                                      "....#??",  //
                                      ".....??"});
  // Straight ahead of (0, 1), the wall at (4, 1) hides (5, 1) and (6, 1). Above and below, the
  // lines to the far cells cross only free cells.
  EXPECT_EQ(information_gain(map, {0, 1}, 100.0), 4U);
  EXPECT_EQ(information_gain(map, {0, 1}, 4.0), 0U) << "too near sighted";
  EXPECT_EQ(information_gain(map, {4, 1}, 100.0), 0U) << "in the wall";
  EXPECT_EQ(information_gain(map, {-1, 1}, 100.0), 0U) << "outside";
}

TEST(InformationGain, AllUnknown_CountsDisc) {
  const Grid<CellState> unknown(test::frame(41, 41), CellState::kUnknown);
  // Cells whose centre is within 10 cells: 317 (Gauss's circle problem, N(10)).
  EXPECT_EQ(information_gain(unknown, {20, 20}, 10.0), 317U);
  // At a corner of the grid, a quarter of the disc. Of the 317 cells, 41 are on the two axes, so
  // (317 - 41) / 4 are inside the quarter, 2 x 10 on its edges, and 1 in the corner: 90.
  EXPECT_EQ(information_gain(unknown, {0, 0}, 10.0), 90U);
}

}  // namespace
}  // namespace par
