// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/planners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "grids.h"
#include "par_common/occupancy_grid.h"

namespace par {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRoot2 = 1.4142135623730951;
// Rounding of a sum of some hundred steps of 1 and sqrt(2).
constexpr double kRounding = 1e-9;

bool is_step(const Mask& blocked, const Cell& a, const Cell& b) {
  const int columns = std::abs(a.column - b.column);
  const int rows = std::abs(a.row - b.row);
  return std::max(columns, rows) == 1 && blocked.value_or(a, 1) == 0 &&
         blocked.value_or(b, 1) == 0 && blocked.value_or({a.column, b.row}, 1) == 0 &&
         blocked.value_or({b.column, a.row}, 1) == 0;
}

/// Lengths of the shortest paths from `start` by Bellman's and Ford's algorithm: relaxes every step
/// until no path gets shorter.
Grid<double> slow_distances(const Mask& blocked, const Cell& start) {
  Grid<double> distances(blocked.frame(), kInfinity);
  if (blocked.value_or(start, 1) != 0) return distances;
  distances[start] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < blocked.frame().size(); ++i) {
      const Cell cell = blocked.frame().cell_at(i);
      for (int r = -1; r <= 1; ++r) {
        for (int c = -1; c <= 1; ++c) {
          const Cell next{cell.column + c, cell.row + r};
          if (!is_step(blocked, cell, next)) continue;
          const double length = distances[cell] + (r != 0 && c != 0 ? kRoot2 : 1.0);
          if (length < distances[next] - kRounding) {
            distances[next] = length;
            changed = true;
          }
        }
      }
    }
  }
  return distances;
}

/// Whether the closed square around a cell's centre and the segment between two centres have a
/// common point: the separating axes of a segment and a square, in integers (twice the
/// coordinates).
bool touches(const Cell& cell, const Cell& a, const Cell& b) {
  const auto apart = [](int least, int greatest, int centre) {
    return greatest < centre - 1 || least > centre + 1;
  };
  const auto [x0, x1] = std::minmax({2 * a.column, 2 * b.column});
  const auto [y0, y1] = std::minmax({2 * a.row, 2 * b.row});
  if (apart(x0, x1, 2 * cell.column) || apart(y0, y1, 2 * cell.row)) return false;
  const long dx = 2 * (b.column - a.column);
  const long dy = 2 * (b.row - a.row);
  const long offset = dx * 2 * (cell.row - a.row) - dy * 2 * (cell.column - a.column);
  return std::abs(offset) <= std::abs(dx) + std::abs(dy);
}

bool slow_line_of_sight(const Mask& blocked, const Cell& a, const Cell& b) {
  for (std::size_t i = 0; i < blocked.frame().size(); ++i) {
    if (blocked.values()[i] != 0 && touches(blocked.frame().cell_at(i), a, b)) return false;
  }
  return true;
}

struct Problem {
  Mask blocked;
  Cell start;
  Cell goal;
};

/// Random grids of many sizes and densities.
std::vector<Problem> random_problems(int number, int max_side) {
  std::mt19937 random(3);
  std::vector<Problem> problems;
  for (int i = 0; i < number; ++i) {
    const auto side = [&] {
      return 1 + static_cast<int>(random() % static_cast<unsigned>(max_side));
    };
    const int width = side();
    const GridFrame frame = test::frame(width, side(), 0.02);
    Problem problem;
    problem.blocked = test::random_mask(frame, random() % 45, random);
    problem.start = test::random_cell(frame, random);
    problem.goal = test::random_cell(frame, random);
    if (random() % 4 != 0) {  // else they may be blocked
      problem.blocked[problem.start] = 0;
      problem.blocked[problem.goal] = 0;
    }
    problems.push_back(problem);
  }
  return problems;
}

/// Checks that a path leads from start to goal by the planners' steps, and has the stated length.
void expect_steps(const Problem& problem, const Path& path) {
  ASSERT_TRUE(path.found());
  EXPECT_EQ(path.cells.front(), problem.start);
  EXPECT_EQ(path.cells.back(), problem.goal);
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    EXPECT_TRUE(is_step(problem.blocked, path.cells[i - 1], path.cells[i]));
  }
  EXPECT_NEAR(path.length_m, path_length_m(problem.blocked.frame(), path.cells), kRounding);
}

TEST(Planners, Length_MatchesBellmanFord) {
  int found = 0;
  for (const Problem& problem : random_problems(300, 24)) {
    const Grid<double> distances = slow_distances(problem.blocked, problem.start);
    const double shortest_m = distances[problem.goal] * 0.02;
    const Path dijkstras = dijkstra(problem.blocked, problem.start, problem.goal);
    const Path a_stars = a_star(problem.blocked, problem.start, problem.goal);
    ASSERT_EQ(dijkstras.found(), shortest_m < kInfinity);
    ASSERT_EQ(a_stars.found(), shortest_m < kInfinity);
    if (!dijkstras.found()) continue;
    ++found;
    expect_steps(problem, dijkstras);
    expect_steps(problem, a_stars);
    EXPECT_NEAR(dijkstras.length_m, shortest_m, kRounding);
    EXPECT_NEAR(a_stars.length_m, shortest_m, kRounding);
  }
  EXPECT_GT(found, 100);
}

TEST(Planners, DistanceField_LeadsFromEveryCell) {
  for (const Problem& problem : random_problems(60, 16)) {
    const Grid<double> distances = slow_distances(problem.blocked, problem.start);
    const DistanceField field(problem.blocked, problem.start);
    const Mask reachable = field.reachable();
    for (std::size_t i = 0; i < distances.values().size(); ++i) {
      const Cell cell = problem.blocked.frame().cell_at(i);
      const double expected_m = distances.values()[i] * 0.02;
      EXPECT_EQ(field.reachable(cell), expected_m < kInfinity);
      EXPECT_EQ(reachable.values()[i] != 0, expected_m < kInfinity);
      if (!field.reachable(cell)) {
        EXPECT_EQ(field.distance_m(cell), kInfinity);
        EXPECT_FALSE(field.path_to(cell).found());
        continue;
      }
      EXPECT_NEAR(field.distance_m(cell), expected_m, kRounding);
      const Path path = field.path_to(cell);
      expect_steps({problem.blocked, problem.start, cell}, path);
      EXPECT_NEAR(path.length_m, expected_m, kRounding);
    }
    EXPECT_FALSE(field.reachable({-1, 0}));
  }
}

TEST(Planners, ThetaStar_BetweenStraightLineAndAStar) {
  int shorter = 0;
  for (const Problem& problem : random_problems(600, 60)) {
    const Path a_stars = a_star(problem.blocked, problem.start, problem.goal);
    const Path thetas = theta_star(problem.blocked, problem.start, problem.goal);
    ASSERT_EQ(thetas.found(), a_stars.found());
    if (!thetas.found()) continue;
    EXPECT_EQ(thetas.cells.front(), problem.start);
    EXPECT_EQ(thetas.cells.back(), problem.goal);
    EXPECT_TRUE(is_free(problem.blocked, thetas.cells));
    EXPECT_LE(thetas.length_m, a_stars.length_m + kRounding);
    EXPECT_GE(thetas.length_m, distance_cells(problem.start, problem.goal) * 0.02 - kRounding);
    if (thetas.length_m < a_stars.length_m - 1e-3) ++shorter;
  }
  EXPECT_GT(shorter, 100) << "any angle should pay";
}

TEST(Planners, ThetaStar_StraightInFreeSpace) {
  const Path path = theta_star(Mask(test::frame(30, 20)), {2, 3}, {27, 14});
  EXPECT_EQ(path.cells, (std::vector<Cell>{{2, 3}, {27, 14}}));
  EXPECT_DOUBLE_EQ(path.length_m, std::hypot(25.0, 11.0));
}

TEST(Planners, Corners_NotCut) {
  // The diagonal from (1, 1) to (2, 0) would touch the wall's corner; the path around it has two
  // steps.
  const Mask blocked = test::mask({"#..", "..."});
  EXPECT_DOUBLE_EQ(dijkstra(blocked, {0, 1}, {1, 0}).length_m, 2.0);
  EXPECT_DOUBLE_EQ(a_star(blocked, {0, 1}, {1, 0}).length_m, 2.0);
  EXPECT_DOUBLE_EQ(theta_star(blocked, {0, 1}, {1, 0}).length_m, 2.0);
  // There is no path between two walls that meet at a corner.
  const Mask closed = test::mask({".#", "#."});
  EXPECT_FALSE(dijkstra(closed, {0, 0}, {1, 1}).found());
  EXPECT_FALSE(a_star(closed, {0, 0}, {1, 1}).found());
  EXPECT_FALSE(theta_star(closed, {0, 0}, {1, 1}).found());
}

TEST(Planners, WallsAndOutside_HaveNoPath) {
  const Mask blocked = test::mask({".#", ".."});
  for (const auto& planner : {dijkstra, a_star, theta_star}) {
    EXPECT_FALSE(planner(blocked, {1, 0}, {0, 0}).found());
    EXPECT_FALSE(planner(blocked, {0, 0}, {1, 0}).found());
    EXPECT_FALSE(planner(blocked, {0, 0}, {2, 0}).found());
    EXPECT_FALSE(planner(blocked, {0, -1}, {0, 0}).found());
    const Path stay = planner(blocked, {0, 1}, {0, 1});
    EXPECT_EQ(stay.cells, (std::vector<Cell>{{0, 1}}));
    EXPECT_EQ(stay.length_m, 0.0);
  }
}

TEST(Planners, Dijkstra_ExpandsMoreCellsThanAStar) {
  const Mask empty(test::frame(60, 60));
  // Straight across from the middle of a side: Dijkstra's wave fills the grid, A*'s goes straight
  // ahead.
  const Path dijkstras = dijkstra(empty, {0, 30}, {59, 30});
  const Path a_stars = a_star(empty, {0, 30}, {59, 30});
  EXPECT_GT(dijkstras.expanded, 3000U);
  EXPECT_EQ(a_stars.expanded, 60U);  // only the cells of the path
}

TEST(Planners, EachCell_ExpandedAtMostOnce) {
  // Counts expansions, because a clock would fail on a busy machine (bench_planning measures time).
  std::mt19937 random(5);
  const Mask blocked = test::random_mask(GridFrame(), 10, random);
  const Cell start{0, 185};
  const Cell goal{171, 0};
  Mask open = blocked;
  open[start] = open[goal] = 0;
  const std::size_t cells = open.frame().size();
  EXPECT_LE(dijkstra(open, start, goal).expanded, cells);
  EXPECT_LE(a_star(open, start, goal).expanded, cells);
  // Theta* may reopen cells; on such maps it reopens few.
  EXPECT_LE(theta_star(open, start, goal).expanded, cells + cells / 4);
}

TEST(LineOfSight, TrueWhereNoBlockedCellIsTouched) {
  std::mt19937 random(11);
  int seen = 0;
  for (int round = 0; round < 4000; ++round) {
    const GridFrame frame =
        test::frame(1 + static_cast<int>(random() % 18), 1 + static_cast<int>(random() % 18));
    const Mask blocked = test::random_mask(frame, random() % 20, random);
    const Cell a = test::random_cell(frame, random);
    const Cell b = test::random_cell(frame, random);
    const bool expected = slow_line_of_sight(blocked, a, b);
    seen += expected ? 1 : 0;
    ASSERT_EQ(line_of_sight(blocked, a, b), expected);
    ASSERT_EQ(line_of_sight(blocked, b, a), expected) << "the other way";
  }
  EXPECT_GT(seen, 400);
  EXPECT_LT(seen, 3600);
}

TEST(LineOfSight, Outside_False) {
  EXPECT_FALSE(line_of_sight(test::mask({".."}), {0, 0}, {2, 0}));
  EXPECT_FALSE(line_of_sight(test::mask({".."}), {0, -1}, {0, 0}));
}

TEST(LineOfSight, Neighbours_MatchPlannerSteps) {
  std::mt19937 random(2);
  const Mask blocked = test::random_mask(test::frame(20, 20), 30, random);
  for (std::size_t i = 0; i < blocked.frame().size(); ++i) {
    const Cell a = blocked.frame().cell_at(i);
    for (const Cell& b : {Cell{a.column + 1, a.row}, Cell{a.column + 1, a.row + 1},
                          Cell{a.column - 1, a.row + 1}, Cell{a.column, a.row + 1}}) {
      EXPECT_EQ(line_of_sight(blocked, a, b), is_step(blocked, a, b));
    }
  }
}

TEST(Smooth, Path_StaysFreeAndGetsNoLonger) {
  int shorter = 0;
  for (const Problem& problem : random_problems(300, 50)) {
    for (const auto& planner : {dijkstra, theta_star}) {
      const Path path = planner(problem.blocked, problem.start, problem.goal);
      const Path smoothed = smooth(problem.blocked, path);
      ASSERT_EQ(smoothed.found(), path.found());
      if (!path.found()) continue;
      EXPECT_EQ(smoothed.cells.front(), problem.start);
      EXPECT_EQ(smoothed.cells.back(), problem.goal);
      EXPECT_TRUE(is_free(problem.blocked, smoothed.cells));
      EXPECT_LE(smoothed.length_m, path.length_m + kRounding);
      EXPECT_NEAR(smoothed.length_m, path_length_m(problem.blocked.frame(), smoothed.cells),
                  kRounding);
      if (smoothed.length_m < path.length_m - 1e-3) ++shorter;
    }
  }
  EXPECT_GT(shorter, 50);
}

TEST(Smooth, KeepsNecessaryTurnsOnly) {
  const Mask blocked = test::mask({".....", ".###.", "....."});
  const Path path = dijkstra(blocked, {0, 0}, {4, 2});
  EXPECT_EQ(smooth(blocked, path).cells.size(), 3U);  // round one corner
}

TEST(Trace, ListsCellsOfPath) {
  EXPECT_EQ(trace({{0, 0}, {2, 0}, {2, 1}}), (std::vector<Cell>{{0, 0}, {1, 0}, {2, 0}, {2, 1}}));
  EXPECT_EQ(trace({{3, 3}}), (std::vector<Cell>{{3, 3}}));
  EXPECT_TRUE(trace({}).empty());
}

TEST(Trace, FreePath_StaysOnFreeCells) {
  for (const Problem& problem : random_problems(100, 40)) {
    const Path path = theta_star(problem.blocked, problem.start, problem.goal);
    for (const Cell& cell : trace(path.cells)) EXPECT_EQ(problem.blocked[cell], 0);
  }
}

TEST(IsFree, ChecksEachSegment) {
  const Mask blocked = test::mask({"...", ".#.", "..."});
  EXPECT_TRUE(is_free(blocked, {{0, 0}, {2, 0}, {2, 2}}));
  EXPECT_FALSE(is_free(blocked, {{0, 0}, {2, 2}}));
  EXPECT_FALSE(is_free(blocked, {{1, 1}}));
  EXPECT_TRUE(is_free(blocked, {}));
}

TEST(BresenhamLine, ConnectedAndNearTrueLine) {
  std::mt19937 random(4);
  const GridFrame frame = test::frame(40, 40);
  for (int round = 0; round < 500; ++round) {
    const Cell a = test::random_cell(frame, random);
    const Cell b = test::random_cell(frame, random);
    const std::vector<Cell> cells = bresenham_line(a, b);
    const int columns = std::abs(a.column - b.column);
    const int rows = std::abs(a.row - b.row);
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(std::max(columns, rows)) + 1);
    EXPECT_EQ(cells.front(), a);
    EXPECT_EQ(cells.back(), b);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      // Along the shorter side, a cell is at most half a cell from the line.
      const double t =
          cells.size() == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(cells.size() - 1);
      EXPECT_LE(std::fabs(a.column + t * (b.column - a.column) - cells[i].column), 0.5 + kRounding);
      EXPECT_LE(std::fabs(a.row + t * (b.row - a.row) - cells[i].row), 0.5 + kRounding);
    }
  }
}

TEST(PathLength, SumOfSegments) {
  EXPECT_DOUBLE_EQ(path_length_m(std::vector<Point>{{0.0, 0.0}, {3.0, 4.0}, {3.0, 5.0}}), 6.0);
  EXPECT_EQ(path_length_m(std::vector<Point>{}), 0.0);
}

}  // namespace
}  // namespace par
