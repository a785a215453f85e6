// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grids.h"

namespace par {
namespace {

/// The reference: tests every blocked cell and, on request, a frame of blocked cells as wide as the
/// grid.
double slow_distance_cells(const Mask& blocked, const Cell& from, Outside outside) {
  double least = std::numeric_limits<double>::infinity();
  for (int row = -1; row <= blocked.height(); ++row) {
    for (int column = -1; column <= blocked.width(); ++column) {
      const std::uint8_t beyond = outside == Outside::kBlocked ? 1 : 0;
      if (blocked.value_or({column, row}, beyond) != 0) {
        least = std::min(least, distance_cells(from, {column, row}));
      }
    }
  }
  return least;
}

TEST(Distance, NearestOfAllBlockedCells) {
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    const GridFrame frame =
        test::frame(1 + static_cast<int>(random() % 30), 1 + static_cast<int>(random() % 30), 0.02);
    const Mask blocked = test::random_mask(frame, random() % 12, random);
    for (const Outside outside : {Outside::kFree, Outside::kBlocked}) {
      const Grid<double> distances = distance_to_blocked_m(blocked, outside);
      for (std::size_t i = 0; i < frame.size(); ++i) {
        // Squared distances are exact integers; the root and the factor may round.
        EXPECT_DOUBLE_EQ(distances.values()[i],
                         slow_distance_cells(blocked, frame.cell_at(i), outside) * 0.02);
      }
    }
  }
}

TEST(Distance, NothingBlocked_Infinite) {
  const Grid<double> distances = distance_to_blocked_m(test::mask({"..", ".."}), Outside::kFree);
  for (const double d : distances.values()) EXPECT_TRUE(std::isinf(d));
}

TEST(Inflate, GrowsCellIntoDisc) {
  const Mask grown =
      inflate(test::mask({".....", ".....", "..#..", ".....", "....."}), 2.0, Outside::kFree);
  EXPECT_EQ(grown.values(), test::mask({"..#..", ".###.", "#####", ".###.", "..#.."}).values());
}

TEST(Inflate, BlockedOutside_BlocksCellsAlongEdge) {
  EXPECT_EQ(inflate(Mask(test::frame(4, 4)), 1.0).values(),
            test::mask({"####", "#..#", "#..#", "####"}).values());
  EXPECT_EQ(count(inflate(Mask(test::frame(4, 4)), 1.0, Outside::kFree)), 0U);
}

TEST(Inflate, ByZero_ChangesNothing) {
  std::mt19937 random(1);
  const Mask blocked = test::random_mask(test::frame(20, 10), 30, random);
  EXPECT_EQ(inflate(blocked, 0.0).values(), blocked.values());
}

TEST(Inflate, RadiusOfWholeCells_IndependentOfRounding) {
  // 0.06 / 0.02 is 2.9999999999999996 in double precision, but means three cells.
  Mask blocked(test::frame(9, 1, 0.02));
  blocked[{4, 0}] = 1;
  EXPECT_EQ(count(inflate(blocked, 0.06, Outside::kFree)), 7U);
}

TEST(Inflate, InvalidRadius_Refused) {
  EXPECT_THROW(static_cast<void>(inflate(test::mask({"."}), -0.1)), std::invalid_argument);
  EXPECT_THROW(
      static_cast<void>(inflate(test::mask({"."}), std::numeric_limits<double>::quiet_NaN())),
      std::invalid_argument);
}

TEST(NearestFree, CellItselfOrNearestWithinReach) {
  const Mask blocked = test::mask({"####.", "####.", "##..."});
  EXPECT_EQ(nearest_free(blocked, {4, 0}, 0.0), (Cell{4, 0}));
  // From (0, 0): (2, 2) at sqrt(8) cells, (4, 0) at 4.
  EXPECT_EQ(nearest_free(blocked, {0, 0}, 3.0), (Cell{2, 2}));
  EXPECT_EQ(nearest_free(blocked, {0, 0}, 2.0), std::nullopt);
  EXPECT_EQ(nearest_free(blocked, {6, 1}, 2.0), (Cell{4, 1})) << "from outside";
  EXPECT_EQ(nearest_free(test::mask({"##"}), {0, 0}, 100.0), std::nullopt);
  // Equally near: the first in row-major order.
  EXPECT_EQ(nearest_free(test::mask({".#."}), {1, 0}, 1.0), (Cell{0, 0}));
}

}  // namespace
}  // namespace par
