// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "grids.h"

namespace par {
namespace {

TEST(GridFrame, Rows_CountedFromTop) {
  const GridFrame frame;  // of the default arena's canvas
  // x = 0.05 m is in the third column (0.04 .. 0.06 m); y = 0.05 m is in the third row from the
  // bottom, which is row 186 - 1 - 2 from the top.
  EXPECT_EQ(frame.cell_of({0.05, 0.05}), (Cell{2, 183}));
  EXPECT_EQ(frame.cell_of({0.01, 3.71}), (Cell{0, 0}));
}

TEST(GridFrame, OutsideCells_Detected) {
  const GridFrame frame = test::frame(4, 3, 0.5);
  EXPECT_EQ(frame.cell_of({-0.1, -0.1}), (Cell{-1, 3}));
  EXPECT_FALSE(frame.contains(frame.cell_of({-0.1, 0.1})));
  EXPECT_FALSE(frame.contains(frame.cell_of({0.1, 1.6})));
  EXPECT_FALSE(frame.contains(frame.cell_of({1e300, 0.1})));
  EXPECT_FALSE(frame.contains(frame.cell_of({0.1, -1e300})));
  EXPECT_FALSE(frame.contains(frame.cell_of({std::numeric_limits<double>::quiet_NaN(), 0.1})));
}

TEST(GridFrame, Centres_MapBackToIndices) {
  GridFrame frame = test::frame(7, 5, 0.25);
  frame.origin = {-1.0, 2.0};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Cell cell = frame.cell_at(i);
    EXPECT_TRUE(frame.contains(cell));
    EXPECT_EQ(frame.index(cell), i);
    EXPECT_EQ(frame.cell_of(frame.centre_of(cell)), cell);
  }
  // Half a cell from the corner: -1 + 0.125, and 2 + 0.125 for the bottom row.
  EXPECT_EQ(frame.centre_of({0, 4}), (Point{-0.875, 2.125}));
}

TEST(Grid, StoresValuesTopRowFirst) {
  Grid<int> grid(test::frame(3, 2), 7);
  grid[{2, 0}] = 1;
  grid[{0, 1}] = 2;
  EXPECT_EQ(grid.values(), (std::vector<int>{7, 7, 1, 2, 7, 7}));
  EXPECT_EQ(grid.value_or({2, 0}, -1), 1);
  EXPECT_EQ(grid.value_or({3, 0}, -1), -1);
  EXPECT_EQ(grid.value_or({0, -1}, -1), -1);
}

TEST(Grid, FrameWithoutCells_Refused) {
  EXPECT_THROW(Mask(test::frame(0, 3)), std::invalid_argument);
  EXPECT_THROW(Mask(test::frame(3, -1)), std::invalid_argument);
  EXPECT_THROW(Mask(test::frame(3, 3, 0.0)), std::invalid_argument);
  EXPECT_THROW(Mask(test::frame(3, 3, std::numeric_limits<double>::quiet_NaN())),
               std::invalid_argument);
}

TEST(Grid, NoFrame_HasNoCells) {
  const Mask none;
  EXPECT_FALSE(none.contains({0, 0}));
  EXPECT_EQ(count(none), 0U);
}

TEST(Grid, CountsCellsOfState) { EXPECT_EQ(count(test::mask({"#..", ".##"})), 3U); }

TEST(Angle, WrappedToHalfTurn) {
  EXPECT_DOUBLE_EQ(normalize_angle(1.5 * kPi), -0.5 * kPi);
  EXPECT_DOUBLE_EQ(normalize_angle(-kPi), kPi);
  EXPECT_DOUBLE_EQ(normalize_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(normalize_angle(0.25), 0.25);
}

}  // namespace
}  // namespace par
