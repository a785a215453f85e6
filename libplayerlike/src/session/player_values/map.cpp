// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/player_values/map.h"

#include <algorithm>
#include <cstddef>

namespace playerlike {

std::vector<std::int8_t> map_cells(const sim::OccupancyMap& map) {
  const auto cell = [](float occupancy) -> std::int8_t {
    if (occupancy > 0.5F) return kMapDataRange;
    return occupancy < 0.5F ? static_cast<std::int8_t>(-kMapDataRange) : std::int8_t{0};
  };
  std::vector<std::int8_t> cells(map.cells.size());
  // The first row is the top row here, and the bottom row in Player.
  for (int row = 0; row < map.height; ++row) {
    const auto from = map.cells.begin() + static_cast<std::ptrdiff_t>(row) * map.width;
    const std::ptrdiff_t y = map.height - 1 - row;
    std::transform(from, from + map.width, cells.begin() + y * map.width, cell);
  }
  return cells;
}

}  // namespace playerlike
