// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/planners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "line.h"

namespace par {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDiagonal = 1.4142135623730950488;  // sqrt(2)

// A path must be shorter by this to count as better [cells]; smaller differences are rounding.
constexpr double kGain = 1e-9;

/// A map with a border of one blocked cell, so that no code needs to check whether a neighbour is
/// outside. Cells are identified by their index in the list.
class Walls {
 public:
  explicit Walls(const Mask& blocked)
      : frame_(blocked.frame()),
        stride_(blocked.width() + 2),
        cells_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(blocked.height() + 2),
               1) {
    auto from = blocked.values().begin();
    for (int row = 0; row < blocked.height(); ++row) {
      std::copy(from, from + blocked.width(), cells_.begin() + (row + 1) * stride_ + 1);
      from += blocked.width();
    }
    offsets_ = {1, -stride_, -1, stride_, 1 - stride_, -1 - stride_, -1 + stride_, 1 + stride_};
  }

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] bool is_free(int place) const { return cells_[at(place)] == 0; }
  /// -1 for cells outside the map.
  [[nodiscard]] int place(const Cell& cell) const {
    return frame_.contains(cell) ? (cell.row + 1) * stride_ + cell.column + 1 : -1;
  }
  [[nodiscard]] Cell cell(int place) const { return {place % stride_ - 1, place / stride_ - 1}; }

  /// Calls `visit` for each place that can be reached in one step, with the cost of the step.
  template <typename Visit>
  void for_each_neighbour(int place, Visit visit) const {
    std::array<bool, 4> free{};  // right, up, left, down
    for (std::size_t i = 0; i < 4; ++i) {
      const int neighbour = place + offsets_[i];
      free[i] = is_free(neighbour);
      if (free[i]) visit(neighbour, 1.0);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const int neighbour = place + offsets_[i + 4];
      if (free[i] && free[(i + 1) % 4] && is_free(neighbour)) visit(neighbour, kDiagonal);
    }
  }

  [[nodiscard]] bool sees(int a, int b) const {
    return line_is_clear(cells_.data(), stride_, a % stride_, a / stride_, b % stride_,
                         b / stride_);
  }
  [[nodiscard]] double distance(int a, int b) const {
    const int columns = a % stride_ - b % stride_;
    const int rows = a / stride_ - b / stride_;
    return std::sqrt(static_cast<double>(columns * columns + rows * rows));
  }
  /// Length of the shortest path if no cell were blocked.
  [[nodiscard]] double octile_distance(int a, int b) const {
    const int columns = std::abs(a % stride_ - b % stride_);
    const int rows = std::abs(a / stride_ - b / stride_);
    return std::abs(columns - rows) + kDiagonal * std::min(columns, rows);
  }

  static std::size_t at(int place) { return static_cast<std::size_t>(place); }

 private:
  GridFrame frame_;
  int stride_;
  std::vector<std::uint8_t> cells_;
  std::array<int, 8> offsets_{};  // right, up, left, down, and the diagonal after each
};

/// A cell that waits to be expanded.
struct Open {
  double key;   // the smallest is next
  double rest;  // tie-break 1: the shortest estimated rest, which leads to the goal
  int place;    // tie-break 2: the first place, so that the result does not depend on the heap

  friend bool operator>(const Open& a, const Open& b) {
    if (a.key != b.key) return a.key > b.key;
    if (a.rest != b.rest) return a.rest > b.rest;
    return a.place > b.place;
  }
};

/// The state that the three planners share: the best length so far and a predecessor for each cell,
/// and the open cells.
class Search {
 public:
  explicit Search(const Walls& walls)
      : walls_(walls),
        so_far_(walls.size(), kInfinity),
        parent_(walls.size(), -1),
        expanded_at_(walls.size(), kInfinity) {}

  /// Stores a new, better path to a place; `rest` is the estimated length from the place to the
  /// goal.
  void reach(int place, double length, int parent, double rest) {
    so_far_[Walls::at(place)] = length;
    parent_[Walls::at(place)] = parent;
    open_.push({length + rest, rest, place});
  }

  /// The place to expand next; -1 if none is open. A place that was reached several times is in the
  /// queue several times, and is expanded only for its best entry.
  int next() {
    while (!open_.empty()) {
      const int place = open_.top().place;
      open_.pop();
      const std::size_t i = Walls::at(place);
      if (so_far_[i] >= expanded_at_[i]) continue;
      expanded_at_[i] = so_far_[i];
      ++expanded_;
      return place;
    }
    return -1;
  }

  [[nodiscard]] double so_far(int place) const { return so_far_[Walls::at(place)]; }
  [[nodiscard]] int parent(int place) const { return parent_[Walls::at(place)]; }
  [[nodiscard]] std::size_t expanded() const { return expanded_; }

  [[nodiscard]] Path path_to(int goal, const GridFrame& frame) const {
    Path path;
    for (int place = goal; place >= 0; place = parent(place)) {
      path.cells.push_back(walls_.cell(place));
    }
    std::reverse(path.cells.begin(), path.cells.end());
    path.length_m = path_length_m(frame, path.cells);
    path.expanded = expanded_;
    return path;
  }

 private:
  const Walls& walls_;
  std::vector<double> so_far_;       // length of the shortest known path from the start [cells]
  std::vector<int> parent_;          // the previous place on that path
  std::vector<double> expanded_at_;  // so_far_ at the last expansion
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  std::size_t expanded_ = 0;
};

/// Expands a place: checks whether its neighbours have a shorter path through it.
template <typename Rest>
void expand(const Walls& walls, Search& search, int place, Rest rest) {
  const double so_far = search.so_far(place);
  walls.for_each_neighbour(place, [&](int neighbour, double step) {
    const double length = so_far + step;
    if (length < search.so_far(neighbour) - kGain) {
      search.reach(neighbour, length, place, rest(neighbour));
    }
  });
}

/// Whether both ends are free.
bool ends_are_free(const Walls& walls, int start, int goal) {
  return start >= 0 && goal >= 0 && walls.is_free(start) && walls.is_free(goal);
}

/// The search of Dijkstra's algorithm and A*, from start to goal.
template <typename Rest>
Path plan(const Walls& walls, const GridFrame& frame, int start, int goal, Rest rest) {
  Search search(walls);
  search.reach(start, 0.0, -1, rest(start));
  for (int place = search.next(); place >= 0; place = search.next()) {
    if (place == goal) return search.path_to(goal, frame);
    expand(walls, search, place, rest);
  }
  Path none;
  none.expanded = search.expanded();
  return none;
}

}  // namespace

double path_length_m(const GridFrame& frame, const std::vector<Cell>& cells) {
  double length = 0.0;
  for (std::size_t i = 1; i < cells.size(); ++i) length += distance_cells(cells[i - 1], cells[i]);
  return length * frame.cell_size_m;
}

double path_length_m(const std::vector<Point>& points) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length_m += distance_m(points[i - 1], points[i]);
  return length_m;
}

DistanceField::DistanceField(const Mask& blocked, const Cell& start)
    : distance_(blocked.frame(), kInfinity), parent_(blocked.frame().size(), -1) {
  const Walls walls(blocked);
  const int first = walls.place(start);
  if (!ends_are_free(walls, first, first)) return;
  Search search(walls);
  const auto no_rest = [](int) { return 0.0; };
  search.reach(first, 0.0, -1, 0.0);
  for (int place = search.next(); place >= 0; place = search.next()) {
    expand(walls, search, place, no_rest);
    const std::size_t i = distance_.frame().index(walls.cell(place));
    distance_.values()[i] = search.so_far(place);
    if (search.parent(place) >= 0) {
      parent_[i] =
          static_cast<std::int32_t>(distance_.frame().index(walls.cell(search.parent(place))));
    }
  }
  expanded_ = search.expanded();
}

double DistanceField::distance_m(const Cell& cell) const {
  return distance_.value_or(cell, kInfinity) * distance_.frame().cell_size_m;
}

bool DistanceField::reachable(const Cell& cell) const {
  return distance_.value_or(cell, kInfinity) < kInfinity;
}

Path DistanceField::path_to(const Cell& cell) const {
  Path path;
  path.expanded = expanded_;
  if (!reachable(cell)) return path;
  for (std::int64_t i = static_cast<std::int64_t>(frame().index(cell)); i >= 0;
       i = parent_[static_cast<std::size_t>(i)]) {
    path.cells.push_back(frame().cell_at(static_cast<std::size_t>(i)));
  }
  std::reverse(path.cells.begin(), path.cells.end());
  path.length_m = path_length_m(frame(), path.cells);
  return path;
}

Mask DistanceField::reachable() const {
  Mask mask(frame());
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    mask.values()[i] = distance_.values()[i] < kInfinity ? 1 : 0;
  }
  return mask;
}

Path dijkstra(const Mask& blocked, const Cell& start, const Cell& goal) {
  const Walls walls(blocked);
  const int from = walls.place(start);
  const int to = walls.place(goal);
  if (!ends_are_free(walls, from, to)) return {};
  return plan(walls, blocked.frame(), from, to, [](int) { return 0.0; });
}

Path a_star(const Mask& blocked, const Cell& start, const Cell& goal) {
  const Walls walls(blocked);
  const int from = walls.place(start);
  const int to = walls.place(goal);
  if (!ends_are_free(walls, from, to)) return {};
  return plan(walls, blocked.frame(), from, to,
              [&](int place) { return walls.octile_distance(place, to); });
}

Path theta_star(const Mask& blocked, const Cell& start, const Cell& goal) {
  const Walls walls(blocked);
  const int from = walls.place(start);
  const int to = walls.place(goal);
  if (!ends_are_free(walls, from, to)) return {};

  Search search(walls);
  search.reach(from, 0.0, -1, walls.distance(from, to));
  for (int place = search.next(); place >= 0; place = search.next()) {
    if (place == to) return search.path_to(to, blocked.frame());
    // The start has no predecessor: its neighbours are reached from the start itself.
    const int parent = search.parent(place) >= 0 ? search.parent(place) : place;
    walls.for_each_neighbour(place, [&](int neighbour, double step) {
      // Try the predecessor first, and the place itself if the predecessor does not see the
      // neighbour. The path over the predecessor is the shorter one: if it is no improvement,
      // neither is the other.
      const double direct = search.so_far(parent) + walls.distance(parent, neighbour);
      const double better = search.so_far(neighbour) - kGain;
      if (!(direct < better)) return;
      if (walls.sees(parent, neighbour)) {
        search.reach(neighbour, direct, parent, walls.distance(neighbour, to));
      } else if (const double length = search.so_far(place) + step; length < better) {
        search.reach(neighbour, length, place, walls.distance(neighbour, to));
      }
    });
  }
  Path none;
  none.expanded = search.expanded();
  return none;
}

}  // namespace par
