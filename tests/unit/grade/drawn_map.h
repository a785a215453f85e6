// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/world/occupancy_map.h"

namespace test_support {

/// A map from text, one string per row from the top: '#' solid, '.' free, anything else unknown.
[[nodiscard]] inline sim::OccupancyMap drawn_map(const std::vector<std::string>& rows,
                                                 double cell_size_m = 1.0,
                                                 const sim::Vec2& origin = sim::Vec2::Zero()) {
  sim::OccupancyMap map;
  map.width = static_cast<int>(rows.front().size());
  map.height = static_cast<int>(rows.size());
  map.cell_size_m = cell_size_m;
  map.origin = origin;
  for (const std::string& row : rows) {
    for (const char c : row) map.cells.push_back(c == '#' ? 1.0F : c == '.' ? 0.0F : 0.5F);
  }
  return map;
}

}  // namespace test_support
