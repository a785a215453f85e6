// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "par_common/grid.h"

namespace par {

/// A path over a grid.
struct Path {
  std::vector<Cell> cells;   ///< from start to goal, both included; empty: there is no path
  double length_m = 0.0;     ///< sum of the distances from cell to cell [m]
  std::size_t expanded = 0;  ///< number of cells that the planner expanded: its effort

  [[nodiscard]] bool found() const { return !cells.empty(); }
};

/// Length of a path along the centres of cells [m].
[[nodiscard]] double path_length_m(const GridFrame& frame, const std::vector<Cell>& cells);
/// Length of a path along points [m].
[[nodiscard]] double path_length_m(const std::vector<Point>& points);

// All planners treat the robot as a point (inflate the map first) that steps from a free cell to
// one of its 8 free neighbours. A straight step costs 1 cell, a diagonal step sqrt(2) cells. A
// diagonal step is allowed only if both cells beside it are free, so paths do not cut corners.
// There is no path if start or goal is blocked or outside the grid. If start = goal, the path has
// one cell.

/// Shortest paths from one cell to all others.
///
/// E. W. Dijkstra, "A note on two problems in connexion with graphs", Numerische Mathematik 1,
/// 1959. In each iteration, take the cell nearest to the start that is reached but not finished. It
/// is now finished, because every other path to it leads through a cell farther away. Then check
/// whether its neighbours have a shorter path through it. One run gives the path to every goal, so
/// use it when there are many goals, for example to find the nearest frontier. O(n log n) for n
/// cells.
class DistanceField {
 public:
  /// Runs Dijkstra's algorithm from `start` over the whole grid.
  DistanceField(const Mask& blocked, const Cell& start);

  /// Length of the shortest path to a cell [m]; infinity if there is none.
  [[nodiscard]] double distance_m(const Cell& cell) const;
  [[nodiscard]] bool reachable(const Cell& cell) const;
  /// The path to a cell.
  [[nodiscard]] Path path_to(const Cell& cell) const;
  /// All reachable cells, including the start.
  [[nodiscard]] Mask reachable() const;
  [[nodiscard]] const GridFrame& frame() const { return distance_.frame(); }

 private:
  Grid<double> distance_;             // [cells]
  std::vector<std::int32_t> parent_;  // index of the previous cell, -1: none
  std::size_t expanded_ = 0;
};

/// Shortest path by Dijkstra's algorithm, which stops as soon as the goal is finished.
[[nodiscard]] Path dijkstra(const Mask& blocked, const Cell& start, const Cell& goal);

/// Shortest path by A*. It differs from Dijkstra's algorithm in the order of expansion: by g + h,
/// the length so far plus an estimate of the rest. So the search is directed towards the goal.
///
/// P. E. Hart, N. J. Nilsson and B. Raphael, "A formal basis for the heuristic determination of
/// minimum cost paths", IEEE Transactions on Systems Science and Cybernetics 4(2), 1968. The
/// estimate is the octile distance: the length of the path if no cell were blocked. It never
/// overestimates, so the path is as short as Dijkstra's.
[[nodiscard]] Path a_star(const Mask& blocked, const Cell& start, const Cell& goal);

/// An any-angle path by Theta*. It differs from A* in that the predecessor of a cell may be any
/// cell in its line of sight. When s is expanded and its neighbour t is in sight of s's predecessor
/// p, then t is reached directly from p. By the triangle inequality this is never longer than the
/// path over s.
///
/// A. Nash, K. Daniel, S. Koenig and A. Felner, "Theta*: any-angle path planning on grids", AAAI
/// 2007. This implementation differs in two points. Line of sight is line_of_sight() between
/// centres of cells. And a finished cell is reopened when a shorter path to it is found; the
/// paper's algorithm does not do that, although f may decrease along a path. With reopening, the
/// path is never longer than A*'s: before the goal is taken, some cell of A*'s path is open with a
/// g no greater than along that path, so its f is at most the length of that path. The result
/// contains only the cells where the path turns. It is short, but not always the shortest.
[[nodiscard]] Path theta_star(const Mask& blocked, const Cell& start, const Cell& goal);

/// Whether the straight line between the centres of two cells touches no blocked cell, not even at
/// a corner. Symmetric in a and b. For neighbours it equals the planners' rule of not cutting
/// corners. False if either end is blocked or outside. Exact, because it uses integers only.
/// O(cells between).
[[nodiscard]] bool line_of_sight(const Mask& blocked, const Cell& a, const Cell& b);

/// Removes turns from a path: connects each kept turn to the last cell of the path that is in line
/// of sight. A path over 8 neighbours turns only by multiples of 45 degrees and is up to 8 % longer
/// than necessary. The smoothed path is easier to drive, and never longer (triangle inequality). It
/// passes each obstacle on the same side as the original path, even if the other side has become
/// shorter; Theta* considers both sides during its search.
///
/// This method is known as string pulling; C. Thorpe, "Path relaxation: path planning for a mobile
/// robot", AAAI 1984, is an early version for grids.
/// @return first and last cell and the turns between them; empty for an empty path.
[[nodiscard]] Path smooth(const Mask& blocked, const Path& path);

/// Every cell on the straight lines between the cells of a path, in order, each next to the
/// previous one. Use it to draw a path that consists of turns, or to check whether it is still free
/// in a new map.
[[nodiscard]] std::vector<Cell> trace(const std::vector<Cell>& turns);

/// Whether a path is free in a map: each segment is in line of sight.
[[nodiscard]] bool is_free(const Mask& blocked, const std::vector<Cell>& turns);

}  // namespace par
