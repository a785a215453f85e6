// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/frontiers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "line.h"

namespace par {
namespace {

/// Mean of cells' columns and rows.
struct Mean {
  double column = 0.0;
  double row = 0.0;
};

Mean mean_of(const std::vector<Cell>& cells) {
  Mean mean;
  for (const Cell& cell : cells) {
    mean.column += cell.column;
    mean.row += cell.row;
  }
  mean.column /= static_cast<double>(cells.size());
  mean.row /= static_cast<double>(cells.size());
  return mean;
}

double squared_distance(const Cell& cell, const Mean& mean) {
  const double columns = cell.column - mean.column;
  const double rows = cell.row - mean.row;
  return columns * columns + rows * rows;
}

/// The cell nearest to the mean; of equally near cells, the first.
Cell middle_of(const std::vector<Cell>& cells) {
  const Mean mean = mean_of(cells);
  return *std::min_element(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
    return squared_distance(a, mean) < squared_distance(b, mean);
  });
}

}  // namespace

Mask frontier_cells(const Grid<CellState>& states) {
  Mask mask(states.frame());
  for (int row = 0; row < states.height(); ++row) {
    for (int column = 0; column < states.width(); ++column) {
      if (states[{column, row}] != CellState::kFree) continue;
      const auto is_unknown = [&](int c, int r) {
        return states.value_or({c, r}, CellState::kFree) == CellState::kUnknown;
      };
      if (is_unknown(column + 1, row) || is_unknown(column - 1, row) ||
          is_unknown(column, row + 1) || is_unknown(column, row - 1)) {
        mask[{column, row}] = 1;
      }
    }
  }
  return mask;
}

std::vector<Frontier> cluster(const Mask& cells, std::size_t min_cells) {
  std::vector<Frontier> frontiers;
  Mask left = cells;
  for (int row = 0; row < cells.height(); ++row) {
    for (int column = 0; column < cells.width(); ++column) {
      if (left[{column, row}] == 0) continue;
      // All cells that are connected to this one through neighbours. The list grows while the loop
      // reads it.
      Frontier frontier;
      frontier.cells.push_back({column, row});
      left[{column, row}] = 0;
      for (std::size_t i = 0; i < frontier.cells.size(); ++i) {
        const Cell cell = frontier.cells[i];
        for (int r = cell.row - 1; r <= cell.row + 1; ++r) {
          for (int c = cell.column - 1; c <= cell.column + 1; ++c) {
            if (left.value_or({c, r}, 0) == 0) continue;
            left[{c, r}] = 0;
            frontier.cells.push_back({c, r});
          }
        }
      }
      if (frontier.cells.size() < min_cells) continue;
      frontier.centre = middle_of(frontier.cells);
      frontiers.push_back(std::move(frontier));
    }
  }
  return frontiers;
}

std::vector<Frontier> find_frontiers(const Grid<CellState>& states, std::size_t min_cells) {
  return cluster(frontier_cells(states), min_cells);
}

std::vector<Frontier> split(const Frontier& frontier, double range_cells) {
  if (!(range_cells > 0.0)) throw std::invalid_argument("split: the range must be more than 0");
  const std::size_t cells = frontier.cells.size();
  const std::size_t parts =
      std::min(cells, 1 + static_cast<std::size_t>(
                              std::floor(static_cast<double>(cells) / (1.8 * range_cells) + 0.5)));
  if (parts <= 1) return {frontier};

  // Lloyd's algorithm: assign each cell to the nearest mean, move each mean to the middle of its
  // cells, repeat until nothing changes. The sum of squared distances decreases, so it always ends;
  // the bound only limits the run time.
  std::vector<Mean> means;
  for (std::size_t part = 0; part < parts; ++part) {
    const Cell& cell = frontier.cells[(2 * part + 1) * cells / (2 * parts)];
    means.push_back({static_cast<double>(cell.column), static_cast<double>(cell.row)});
  }
  std::vector<std::vector<Cell>> members;
  std::vector<std::size_t> nearest(cells, parts);
  for (int round = 0; round < 100; ++round) {
    bool changed = false;
    members.assign(parts, {});
    for (std::size_t i = 0; i < cells; ++i) {
      const auto best = std::min_element(means.begin(), means.end(), [&](auto& a, auto& b) {
        return squared_distance(frontier.cells[i], a) < squared_distance(frontier.cells[i], b);
      });
      const auto part = static_cast<std::size_t>(best - means.begin());
      changed = changed || nearest[i] != part;
      nearest[i] = part;
      members[part].push_back(frontier.cells[i]);
    }
    if (!changed) break;
    for (std::size_t part = 0; part < parts; ++part) {
      if (!members[part].empty()) means[part] = mean_of(members[part]);
    }
  }
  std::vector<Frontier> result;
  for (std::vector<Cell>& part : members) {
    if (part.empty()) continue;
    const Cell centre = middle_of(part);
    result.push_back({std::move(part), centre});
  }
  return result;
}

std::size_t information_gain(const Grid<CellState>& states, const Cell& from, double range_m) {
  if (states.value_or(from, CellState::kOccupied) == CellState::kOccupied) return 0;
  const GridFrame& frame = states.frame();
  // The range is at most the distance between opposite corners of the grid.
  const double range = std::min(range_m / frame.cell_size_m,
                                std::hypot(static_cast<double>(frame.width), frame.height));
  const int reach = static_cast<int>(std::floor(range));
  std::vector<std::uint8_t> seen(frame.size(), 0);
  std::size_t gain = 0;
  const auto look_at = [&](int columns, int rows) {
    walk_line(from, {from.column + columns, from.row + rows}, [&](const Cell& cell) {
      if (!frame.contains(cell) || distance_cells(cell, from) > range) return false;
      if (states[cell] == CellState::kOccupied) return false;
      std::uint8_t& mark = seen[frame.index(cell)];
      if (states[cell] == CellState::kUnknown && mark == 0) ++gain;
      mark = 1;
      return true;
    });
  };
  for (int i = -reach; i <= reach; ++i) {
    look_at(i, -reach);
    look_at(i, reach);
    look_at(-reach, i);
    look_at(reach, i);
  }
  return gain;
}

}  // namespace par
