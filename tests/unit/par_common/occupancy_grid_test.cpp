// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/occupancy_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "grids.h"

namespace par {
namespace {

// Ten cells of 0.1 m in a row; the sensor is at the centre of the first and faces along the row.
GridFrame corridor() { return test::frame(10, 1, 0.1); }

Scan one_beam(double range_m) {
  Scan scan;
  scan.sensor = {0.05, 0.05, 0.0};
  scan.max_range_m = 5.0;
  scan.ranges_m = {range_m};
  return scan;
}

TEST(OccupancyGrid, StartsUnknown) {
  const OccupancyGrid map(corridor());
  EXPECT_EQ(map.state({3, 0}), CellState::kUnknown);
  EXPECT_DOUBLE_EQ(map.probability({3, 0}), 0.5);
  EXPECT_DOUBLE_EQ(map.probability({30, 0}), 0.5) << "outside";
  EXPECT_EQ(map.state({-1, 0}), CellState::kUnknown);
}

TEST(OccupancyGrid, Beam_AddsMissesAndHitAtEnd) {
  OccupancyGrid map(corridor());
  map.update(one_beam(0.5));  // ends at x = 0.55 m, 0.56 m with its depth: in cell 5
  for (int column = 0; column < 5; ++column) {
    EXPECT_FLOAT_EQ(static_cast<float>(map.log_odds({column, 0})), -0.40F);
  }
  EXPECT_FLOAT_EQ(static_cast<float>(map.log_odds({5, 0})), 0.85F);
  EXPECT_EQ(map.log_odds({6, 0}), 0.0) << "behind";
  // log(p / (1 - p)) = 0.85 means p = 1 / (1 + e^-0.85) = 0.7005671...
  EXPECT_NEAR(map.probability({5, 0}), 0.7005671, 1e-6);
  EXPECT_EQ(map.state({5, 0}), CellState::kOccupied);
}

TEST(OccupancyGrid, Converges_ToLimitsAndRecovers) {
  OccupancyGrid map(corridor());
  for (int i = 0; i < 1000; ++i) map.update(one_beam(0.5));
  EXPECT_FLOAT_EQ(static_cast<float>(map.log_odds({5, 0})), 3.5F);
  EXPECT_FLOAT_EQ(static_cast<float>(map.log_odds({2, 0})), -3.5F);
  EXPECT_NEAR(map.probability({5, 0}), 0.970688, 1e-6);  // 1 / (1 + e^-3.5)
  // The obstacle has moved away. Free means p < 0.196: log odds below -1.412. From 3.5 that takes
  // (3.5 + 1.412) / 0.40 = 12.3, so 13 scans.
  for (int i = 0; i < 12; ++i) map.update(one_beam(0.9));
  EXPECT_NE(map.state({5, 0}), CellState::kFree);
  map.update(one_beam(0.9));
  EXPECT_EQ(map.state({5, 0}), CellState::kFree);
}

TEST(OccupancyGrid, CellOfScan_CountedOnceHitsFirst) {
  OccupancyGrid map(corridor());
  Scan scan = one_beam(0.5);
  // all along the row: two beams pass through the cell that three hit
  scan.ranges_m = {0.7, 0.5, 0.7, 0.5, 0.5};
  map.update(scan);
  EXPECT_FLOAT_EQ(static_cast<float>(map.log_odds({5, 0})), 0.85F);
  EXPECT_FLOAT_EQ(static_cast<float>(map.log_odds({1, 0})), -0.40F);
}

TEST(OccupancyGrid, BeamWithoutHit_AddsMissesOnly) {
  OccupancyGrid map(corridor());
  Scan scan = one_beam(5.0);
  scan.max_range_m = 0.6;
  scan.ranges_m = {0.6};
  map.update(scan);
  EXPECT_LT(map.log_odds({6, 0}), 0.0);  // 0.65 m lies in cell 6
  EXPECT_EQ(map.log_odds({7, 0}), 0.0);
  scan.ranges_m = {std::numeric_limits<double>::infinity()};
  map.update(scan);
  EXPECT_EQ(map.log_odds({7, 0}), 0.0);
}

TEST(OccupancyGrid, BeamBeyondUsableRange_Ignored) {
  OccupancyParams params;
  params.usable_range_m = 0.3;
  OccupancyGrid map(corridor(), params);
  map.update(one_beam(0.5));
  EXPECT_LT(map.log_odds({3, 0}), 0.0);  // 0.35 m
  EXPECT_EQ(map.log_odds({4, 0}), 0.0);
  EXPECT_EQ(map.log_odds({5, 0}), 0.0) << "a hit, but too far away";
}

TEST(OccupancyGrid, Beams_RotatedByHeadingAndBearing) {
  OccupancyGrid map(test::frame(9, 9, 0.1));
  Scan scan;
  scan.sensor = {0.45, 0.45, 0.5 * kPi};  // in the middle, looking up
  scan.first_bearing_rad = -0.5 * kPi;    // beam 0 to the right, 1 ahead, 2 to the left
  scan.bearing_step_rad = 0.5 * kPi;
  scan.ranges_m = {0.2, 0.3, 0.4};
  map.update(scan);
  EXPECT_EQ(map.state({6, 4}), CellState::kOccupied);
  EXPECT_EQ(map.state({4, 1}), CellState::kOccupied);  // up is towards row 0
  EXPECT_EQ(map.state({0, 4}), CellState::kOccupied);
  EXPECT_EQ(count(cells_in_state(map.states(), CellState::kOccupied)), 3U);
}

TEST(OccupancyGrid, InvalidReadingsAndOutside_LeftOut) {
  OccupancyGrid map(corridor());
  for (const double range : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    map.update(one_beam(range));
  }
  EXPECT_EQ(map.log_odds({0, 0}), 0.0);
  map.update(one_beam(3.0));  // ends far outside
  EXPECT_EQ(count(cells_in_state(map.states(), CellState::kOccupied)), 0U);
  Scan from_outside = one_beam(1.45);
  from_outside.sensor = {-1.0, 0.05, 0.0};
  OccupancyGrid other(corridor());
  other.update(from_outside);
  EXPECT_EQ(other.state({4, 0}), CellState::kOccupied);
  EXPECT_LT(other.log_odds({3, 0}), 0.0);
}

TEST(OccupancyGrid, StatesAndProbabilities_MatchSingleCells) {
  OccupancyGrid map(test::frame(20, 20, 0.1));
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    Scan scan;
    scan.sensor = {1.0, 1.0, 0.0};
    scan.bearing_step_rad = 0.1;
    for (int beam = 0; beam < 60; ++beam) {
      scan.ranges_m.push_back(0.3 + 0.001 * static_cast<double>(random() % 500));
    }
    map.update(scan);
  }
  const Grid<CellState> states = map.states();
  const Grid<float> probabilities = map.probabilities();
  for (std::size_t i = 0; i < states.values().size(); ++i) {
    const Cell cell = map.frame().cell_at(i);
    EXPECT_EQ(states.values()[i], map.state(cell));
    EXPECT_FLOAT_EQ(probabilities.values()[i], static_cast<float>(map.probability(cell)));
  }
}

// Number of cells marked as occupied in front of a wall, after noisy scans of it. The wall is on a
// border of cells, at x = 0.4 m.
std::size_t occupied_before_the_wall(const OccupancyParams& params) {
  OccupancyGrid map(test::frame(40, 40, 0.02), params);
  std::mt19937 random(6);
  for (int i = 0; i < 30; ++i) {
    Scan scan;
    scan.sensor = {0.1, 0.3 + 0.007 * i, 0.0};
    scan.first_bearing_rad = -0.7;
    scan.bearing_step_rad = 0.007;
    for (int beam = 0; beam < 200; ++beam) {
      const double noise_m = 1e-5 * (static_cast<double>(random() % 1001) - 500.0);  // +-5 mm
      scan.ranges_m.push_back(0.3 / std::cos(-0.7 + 0.007 * beam) + noise_m);
    }
    map.update(scan);
  }
  std::size_t occupied = 0;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 20; ++column) {
      if (map.state({column, row}) == CellState::kOccupied) ++occupied;
    }
  }
  return occupied;
}

TEST(OccupancyGrid, Depth_KeepsWallOutOfFreeCells) {
  // 10 mm deeper at up to 0.7 rad from the normal are at least 7.6 mm in x, more than 5 mm of
  // noise.
  EXPECT_EQ(occupied_before_the_wall(OccupancyParams()), 0U);
  OccupancyParams flat;
  flat.depth_m = 0.0;
  EXPECT_GT(occupied_before_the_wall(flat), 10U);
}

TEST(OccupancyGrid, FloorUnderRobot_Free) {
  OccupancyGrid map(test::frame(9, 9, 0.1));
  map.set_free({0.45, 0.45}, 0.1);
  EXPECT_EQ(map.state({4, 4}), CellState::kFree);
  // The next centre is 0.1 m away at the side, 0.14 m diagonally.
  EXPECT_EQ(map.state({5, 5}), CellState::kUnknown);
  map.set_free({-5.0, 20.0}, 0.1);  // outside: no effect
  map.set_free({0.0, 0.0}, 0.08);   // partly outside
  EXPECT_EQ(map.state({0, 8}), CellState::kFree);
}

TEST(OccupancyGrid, Rectangle_Forgotten) {
  const auto unknown_of = [](const Pose& centre, double length_m, double width_m) {
    OccupancyGrid map(test::frame(9, 9, 0.1));
    map.set_free({0.45, 0.45}, 2.0);  // all cells
    map.set_unknown(centre, length_m, width_m);
    return count(cells_in_state(map.states(), CellState::kUnknown));
  };
  EXPECT_EQ(unknown_of({0.45, 0.45, 0.0}, 0.5, 0.1), 5U);
  EXPECT_EQ(unknown_of({0.45, 0.45, kPi / 2.0}, 0.5, 0.1), 5U);
  // Along a diagonal, the centres are 0.141 m apart; the next diagonal is 0.07 m away.
  EXPECT_EQ(unknown_of({0.45, 0.45, kPi / 4.0}, 0.58, 0.1), 5U);
  EXPECT_EQ(unknown_of({0.0, 0.0, 0.0}, 0.4, 0.2), 2U) << "partly outside";
  EXPECT_EQ(unknown_of({20.0, -3.0, 0.0}, 1.0, 1.0), 0U);

  OccupancyGrid map(test::frame(9, 9, 0.1));
  map.set_free({0.45, 0.45}, 2.0);
  map.set_unknown({0.25, 0.75, 0.0}, 0.1, 0.1);
  EXPECT_EQ(map.log_odds({2, 1}), 0.0);
  EXPECT_EQ(map.state({2, 2}), CellState::kFree);
}

TEST(OccupancyGrid, InvalidParameters_Refused) {
  const auto refused = [](auto change) {
    OccupancyParams params;
    change(params);
    EXPECT_THROW(OccupancyGrid(corridor(), params), std::invalid_argument);
  };
  refused([](OccupancyParams& p) { p.hit_log_odds = -0.1; });
  refused([](OccupancyParams& p) { p.miss_log_odds = 0.1; });
  refused([](OccupancyParams& p) { p.limit_log_odds = 0.0; });
  refused([](OccupancyParams& p) { p.occupied_threshold = 0.4; });
  refused([](OccupancyParams& p) { p.free_threshold = 0.6; });
  refused([](OccupancyParams& p) { p.depth_m = -0.01; });
  refused([](OccupancyParams& p) { p.usable_range_m = std::nan(""); });
}

}  // namespace
}  // namespace par
