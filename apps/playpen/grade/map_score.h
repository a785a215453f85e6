// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"
#include "sim/world/occupancy_map.h"

namespace playpen::grade {

/// Side of a cell of the truth that maps are compared with [m].
inline constexpr double kTruthCell_m = 0.02;

/// What a map says of a cell: free if it is surely less than half occupied, solid if surely more.
enum class CellState : std::uint8_t { kFree, kUnknown, kSolid };

/// @param value  0 (free) .. 1 (occupied); from 0.45 to 0.55 nothing is known.
[[nodiscard]] CellState cell_state(float value) noexcept;

/// How good a map of an arena is.
struct MapScore {
  /// Of the truly free cells that can be reached, the share that the map calls free, 0..1.
  double coverage = 0.0;
  /// Of the cells of which the map knows something, the share that are right, 0..1; 0 if it knows
  /// nothing.
  double correctness = 0.0;
  std::size_t reachable_cells = 0;  ///< free cells of the truth that can be reached
  std::size_t known_cells = 0;      ///< cells of the map that were judged
};

/// The truth that maps are compared with: sim::true_map in cells of kTruthCell_m, from the floor's
/// bottom left corner on, with some cells of the border round the floor.
[[nodiscard]] sim::OccupancyMap make_truth(const sim::ArenaDescription& arena);

/// Cells of the truth that a point can be moved to from the start, through free cells that share
/// a side.
/// @return laid out as the map's cells; 1: can be reached.
[[nodiscard]] std::vector<std::uint8_t> reachable_cells(const sim::OccupancyMap& truth,
                                                        const sim::Vec2& start);

/// Compares a map with the truth, by the positions of its cells in the world: the maps may differ
/// in origin, size and cells.
///
/// A free cell is right if the truth is free at its middle; a solid one if the truth is solid
/// there or in one of the eight cells round it. Cells of the map that lie off the truth are not
/// judged.
[[nodiscard]] MapScore score_map(const sim::OccupancyMap& map, const sim::OccupancyMap& truth,
                                 const sim::Vec2& start);

}  // namespace playpen::grade
