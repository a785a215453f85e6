// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/world/occupancy_map.h"

/// @file
/// Player's interface map.
namespace playerlike {

/// Greatest absolute value of cells of Player's maps.
inline constexpr std::int8_t kMapDataRange = 1;

/// The cells of a map in Player's form: row-major from the bottom row; -kMapDataRange: free, 0:
/// unknown, kMapDataRange: occupied.
[[nodiscard]] std::vector<std::int8_t> map_cells(const sim::OccupancyMap& map);

}  // namespace playerlike
