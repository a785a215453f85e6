// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/map_score.h"

#include <cmath>
#include <optional>
#include <utility>

namespace playpen::grade {
namespace {

/// Column and row (from the top) of a cell.
using Cell = std::pair<int, int>;

std::size_t index(const sim::OccupancyMap& map, const Cell& cell) {
  return static_cast<std::size_t>(cell.second) * static_cast<std::size_t>(map.width) +
         static_cast<std::size_t>(cell.first);
}

bool contains(const sim::OccupancyMap& map, const Cell& cell) {
  return cell.first >= 0 && cell.first < map.width && cell.second >= 0 && cell.second < map.height;
}

/// The cell that contains a point of the world, if it is inside the map.
std::optional<Cell> cell_at(const sim::OccupancyMap& map, const sim::Vec2& p_W) {
  const sim::Vec2 p = (p_W - map.origin) / map.cell_size_m;
  if (!(p.x() >= 0.0 && p.x() < map.width && p.y() >= 0.0 && p.y() < map.height)) {
    return std::nullopt;
  }
  return Cell{static_cast<int>(p.x()), map.height - 1 - static_cast<int>(p.y())};
}

sim::Vec2 middle_of(const sim::OccupancyMap& map, const Cell& cell) {
  return map.origin +
         sim::Vec2(cell.first + 0.5, map.height - 1 - cell.second + 0.5) * map.cell_size_m;
}

CellState state_at(const sim::OccupancyMap& map, const Cell& cell) {
  return cell_state(map.at(cell.first, cell.second));
}

bool solid_within_a_cell(const sim::OccupancyMap& truth, const Cell& cell) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell near{cell.first + dx, cell.second + dy};
      if (contains(truth, near) && state_at(truth, near) == CellState::kSolid) return true;
    }
  }
  return false;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

CellState cell_state(float value) noexcept {
  constexpr float kFreeBelow = 0.45F;
  constexpr float kSolidAbove = 0.55F;
  if (value < kFreeBelow) return CellState::kFree;
  return value > kSolidAbove ? CellState::kSolid : CellState::kUnknown;
}

sim::OccupancyMap make_truth(const sim::ArenaDescription& arena) {
  constexpr int kMargin = 2;  // cells around the floor
  sim::CanvasDescription grid;
  grid.cell_size_m = kTruthCell_m;
  grid.origin = arena.origin - sim::Vec2::Constant(kMargin * kTruthCell_m);
  const auto cells = [](double length_m) {
    // 1e-9 absorbs rounding: 3.42 / 0.02 > 171.
    return static_cast<int>(std::ceil(length_m / kTruthCell_m - 1e-9)) + 2 * kMargin;
  };
  grid.width = cells(arena.size.x());
  grid.height = cells(arena.size.y());
  return sim::true_map(arena, grid);
}

std::vector<std::uint8_t> reachable_cells(const sim::OccupancyMap& truth, const sim::Vec2& start) {
  std::vector<std::uint8_t> reached(truth.cells.size(), 0);
  std::vector<Cell> open;
  const auto visit = [&](const Cell& cell) {
    if (!contains(truth, cell) || state_at(truth, cell) != CellState::kFree) return;
    std::uint8_t& mark = reached[index(truth, cell)];
    if (mark != 0) return;
    mark = 1;
    open.push_back(cell);
  };
  if (const std::optional<Cell> first = cell_at(truth, start)) visit(*first);
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    visit({column - 1, row});
    visit({column + 1, row});
    visit({column, row - 1});
    visit({column, row + 1});
  }
  return reached;
}

bool SeenFloor::contains(const sim::Vec2& p_W) const {
  const sim::Vec2 p = (p_W - origin) / cell_size_m;
  if (!(p.x() >= 0.0 && p.x() < width && p.y() >= 0.0 && p.y() < height)) return false;
  const std::size_t cell = static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(p.x());
  return (bits[cell / 8] & (0x80U >> (cell % 8))) != 0;
}

MapScore score_map(const sim::OccupancyMap& map, const sim::OccupancyMap& truth,
                   const sim::Vec2& start, const SeenFloor* seen) {
  return score_map_within(map, truth, reachable_cells(truth, start), seen);
}

MapScore score_map_within(const sim::OccupancyMap& map, const sim::OccupancyMap& truth,
                          const std::vector<std::uint8_t>& reachable, const SeenFloor* seen) {
  const auto was_seen = [seen](const sim::Vec2& p_W) {
    return seen == nullptr || seen->contains(p_W);
  };
  MapScore score;
  std::size_t covered = 0;
  std::size_t drawn_cells = 0;
  std::size_t seen_cells = 0;
  for (int row = 0; row < truth.height; ++row) {
    for (int column = 0; column < truth.width; ++column) {
      const Cell cell{column, row};
      if (reachable[index(truth, cell)] == 0 || state_at(truth, cell) != CellState::kFree) continue;
      ++score.reachable_cells;
      const sim::Vec2 middle = middle_of(truth, cell);
      const std::optional<Cell> drawn = cell_at(map, middle);
      const bool is_drawn = drawn && state_at(map, *drawn) == CellState::kFree;
      const bool is_seen = was_seen(middle);
      if (is_drawn) ++drawn_cells;
      if (is_seen) ++seen_cells;
      if (is_drawn && is_seen) ++covered;
    }
  }
  std::size_t right = 0;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const CellState said = state_at(map, {column, row});
      if (said == CellState::kUnknown) continue;
      const sim::Vec2 middle = middle_of(map, {column, row});
      const std::optional<Cell> cell = cell_at(truth, middle);
      if (!cell) continue;
      ++score.known_cells;
      const bool is_right = said == CellState::kFree
                                ? state_at(truth, *cell) == CellState::kFree && was_seen(middle)
                                : solid_within_a_cell(truth, *cell);
      if (is_right) ++right;
    }
  }
  score.coverage = share(covered, score.reachable_cells);
  score.drawn = share(drawn_cells, score.reachable_cells);
  score.seen = share(seen_cells, score.reachable_cells);
  score.correctness = share(right, score.known_cells);
  return score;
}

}  // namespace playpen::grade
