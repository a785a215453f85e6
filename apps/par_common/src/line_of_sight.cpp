// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <vector>

#include "line.h"
#include "par_common/occupancy_grid.h"
#include "par_common/planners.h"

namespace par {

std::vector<Cell> bresenham_line(const Cell& from, const Cell& to) {
  std::vector<Cell> cells;
  walk_line(from, to, [&](const Cell& cell) {
    cells.push_back(cell);
    return true;
  });
  return cells;
}

bool line_of_sight(const Mask& blocked, const Cell& a, const Cell& b) {
  return blocked.contains(a) && blocked.contains(b) &&
         line_is_clear(blocked.values().data(), blocked.width(), a.column, a.row, b.column, b.row);
}

Path smooth(const Mask& blocked, const Path& path) {
  Path smoothed;
  if (!path.found()) return smoothed;
  smoothed.cells.push_back(path.cells.front());
  for (std::size_t at = 0; at + 1 < path.cells.size();) {
    // Find the last cell in sight. The next cell of the path is always in sight.
    std::size_t next = path.cells.size() - 1;
    while (next > at + 1 && !line_of_sight(blocked, path.cells[at], path.cells[next])) --next;
    smoothed.cells.push_back(path.cells[next]);
    at = next;
  }
  smoothed.length_m = path_length_m(blocked.frame(), smoothed.cells);
  smoothed.expanded = path.expanded;
  return smoothed;
}

std::vector<Cell> trace(const std::vector<Cell>& turns) {
  std::vector<Cell> cells;
  if (!turns.empty()) cells.push_back(turns.front());
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const std::vector<Cell> stretch = bresenham_line(turns[i - 1], turns[i]);
    cells.insert(cells.end(), stretch.begin() + 1, stretch.end());
  }
  return cells;
}

bool is_free(const Mask& blocked, const std::vector<Cell>& turns) {
  if (turns.size() == 1) return line_of_sight(blocked, turns[0], turns[0]);
  for (std::size_t i = 1; i < turns.size(); ++i) {
    if (!line_of_sight(blocked, turns[i - 1], turns[i])) return false;
  }
  return true;
}

}  // namespace par
