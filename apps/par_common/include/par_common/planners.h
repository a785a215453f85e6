// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "par_common/grid.h"

namespace par {

/// A way over a grid.
struct Path {
  std::vector<Cell> cells;   ///< from start to goal, both included; empty: there is no way
  double length_m = 0.0;     ///< sum of the distances from cell to cell [m]
  std::size_t expanded = 0;  ///< cells that the planner looked at the neighbours of: its work

  [[nodiscard]] bool found() const { return !cells.empty(); }
};

/// The length of a way along the centres of cells [m].
[[nodiscard]] double path_length_m(const GridFrame& frame, const std::vector<Cell>& cells);
/// The length of a way along points [m].
[[nodiscard]] double path_length_m(const std::vector<Point>& points);

// All planners: a robot that is a point (inflate the map first) steps from a free cell to one of
// its 8 free neighbours; a straight step costs 1 cell, a diagonal one sqrt(2) cells, and a diagonal
// one is allowed only if both cells beside it are free: corners are not cut. Where start or goal is
// blocked or outside the grid there is no way. Start = goal: a way of one cell.

/// Shortest ways from one cell to all others.
///
/// E. W. Dijkstra, "A note on two problems in connexion with graphs", Numerische Mathematik 1,
/// 1959: of all cells reached but not finished, take the one nearest to the start; it is finished,
/// as every other way to it leads through something farther; see whether its neighbours are better
/// reached through it. One run tells the way to every goal, so use it when there are many: which
/// frontier is the nearest? O(n log n) for n cells.
class DistanceField {
 public:
  /// Runs Dijkstra's algorithm from `start` over the whole grid.
  DistanceField(const Mask& blocked, const Cell& start);

  /// Length of the shortest way to a cell [m]; infinity if there is none.
  [[nodiscard]] double distance_m(const Cell& cell) const;
  [[nodiscard]] bool reachable(const Cell& cell) const;
  /// The way to a cell.
  [[nodiscard]] Path path_to(const Cell& cell) const;
  /// All cells that can be reached, the start among them.
  [[nodiscard]] Mask reachable() const;
  [[nodiscard]] const GridFrame& frame() const { return distance_.frame(); }

 private:
  Grid<double> distance_;             // [cells]
  std::vector<std::int32_t> parent_;  // index of the cell before, -1: none
  std::size_t expanded_ = 0;
};

/// Shortest way by Dijkstra's algorithm, which ends as soon as the goal is finished.
[[nodiscard]] Path dijkstra(const Mask& blocked, const Cell& start, const Cell& goal);

/// Shortest way by A*: as Dijkstra's, but the cells are taken in the order of g + h, the way so far
/// plus an estimate of the rest, so that the search runs towards the goal.
///
/// P. E. Hart, N. J. Nilsson and B. Raphael, "A formal basis for the heuristic determination of
/// minimum cost paths", IEEE Transactions on Systems Science and Cybernetics 4(2), 1968. The
/// estimate is the octile distance, the length of the way if nothing were blocked: it never says
/// too much, so the way found is as short as Dijkstra's.
[[nodiscard]] Path a_star(const Mask& blocked, const Cell& start, const Cell& goal);

/// A way of any angle by Theta*: as A*, but a cell may have any cell that it can see as its
/// predecessor. When s is expanded and its neighbour t is in sight of s's own predecessor p, then t
/// is reached from p straight away, which by the triangle inequality is never longer than over s.
///
/// A. Nash, K. Daniel, S. Koenig and A. Felner, "Theta*: any-angle path planning on grids", AAAI
/// 2007. Two things are different. Sight is line_of_sight() between centres of cells. And a
/// finished cell that is later reached by a shorter way is taken up again: in the paper's algorithm
/// it is not, as f need not grow along a way; with it the way is never longer than A*'s (before the
/// goal is taken, some cell of A*'s way is open with a g no greater than along that way, so its f
/// is at most the length of that way). The result holds only the cells where the way turns, and is
/// short, but not always the shortest.
[[nodiscard]] Path theta_star(const Mask& blocked, const Cell& start, const Cell& goal);

/// Whether the straight line between the centres of two cells touches no blocked cell, not even at
/// a corner; the same whichever is named first. For neighbours it is the rule of the planners: no
/// corners cut. False if either end is blocked or outside. Whole numbers only: exact. O(cells
/// between).
[[nodiscard]] bool line_of_sight(const Mask& blocked, const Cell& a, const Cell& b);

/// The same way with fewer turns: from each turn that is kept straight to the last cell of the way
/// that can be seen from there. A way on 8 neighbours turns by multiples of 45 degrees only, and is
/// up to 8 % longer than it need be; pulled straight like this it is easier to drive, and never
/// longer (triangle inequality). It passes each obstacle on the side on which the way did, even
/// where the other side has become the shorter one; Theta* looks for such while it searches.
///
/// Known as string pulling; C. Thorpe, "Path relaxation: path planning for a mobile robot", AAAI
/// 1984, is an early one for grids.
/// @return first and last cell and the turns between; empty for an empty way.
[[nodiscard]] Path smooth(const Mask& blocked, const Path& path);

/// Every cell on the straight lines between the cells of a way, in order, each next to the one
/// before: for drawing a way that has turns only, or for seeing whether it is still free in a new
/// map.
[[nodiscard]] std::vector<Cell> trace(const std::vector<Cell>& turns);

/// Whether a way is free in a map: each stretch of it in line of sight.
[[nodiscard]] bool is_free(const Mask& blocked, const std::vector<Cell>& turns);

}  // namespace par
