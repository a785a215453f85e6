// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"
#include "sim/world/occupancy_map.h"

namespace playpen::grade {

/// Cell size of the true map that maps are compared with [m].
inline constexpr double kTruthCell_m = 0.02;

/// State of a cell: free if it is certainly less than half occupied, solid if certainly more.
enum class CellState : std::uint8_t { kFree, kUnknown, kSolid };

/// @param value  0 (free) .. 1 (occupied); from 0.45 to 0.55 the cell is unknown.
[[nodiscard]] CellState cell_state(float value) noexcept;

/// The floor that a robot's own sensors have seen, from a run's report.
struct SeenFloor {
  double cell_size_m = 0.02;             ///< [m], > 0
  sim::Vec2 origin = sim::Vec2::Zero();  ///< bottom left corner [m]
  int width = 0;                         ///< columns
  int height = 0;                        ///< rows
  std::vector<std::uint8_t> bits;        ///< from the bottom left cell along x; bit 7 comes first

  /// Whether the cell with this point was seen; false outside.
  [[nodiscard]] bool contains(const sim::Vec2& p_W) const;
};

/// Quality of a map.
struct MapScore {
  /// Share of the reachable free cells that the map shows as free and that were seen, 0..1.
  double coverage = 0.0;
  double drawn = 0.0;  ///< share of these cells that the map shows as free, seen or not, 0..1
  double seen = 0.0;   ///< share of these cells that were seen, drawn or not, 0..1
  /// Share of the map's known cells that are correct, 0..1; 0 if it has no known cells.
  double correctness = 0.0;
  std::size_t reachable_cells = 0;  ///< reachable free cells of the true map
  std::size_t known_cells = 0;      ///< cells of the map that were compared
};

/// The true map that maps are compared with: sim::true_map with cells of kTruthCell_m. It starts at
/// the floor's bottom left corner and includes a margin of some cells around the floor.
[[nodiscard]] sim::OccupancyMap make_truth(const sim::ArenaDescription& arena);

/// Cells of the true map that can be reached from the start through free cells that share a side.
/// @return in the order of the map's cells; 1: reachable.
[[nodiscard]] std::vector<std::uint8_t> reachable_cells(const sim::OccupancyMap& truth,
                                                        const sim::Vec2& start);

/// Compares a map with the truth by the world positions of its cells: the maps may differ in
/// origin, size and cell size.
///
/// A free cell is correct if the truth is free at the cell's centre, and the cell was seen. A solid
/// cell is correct if the
/// truth is solid there or in one of the eight cells around it. Cells outside the true map are
/// ignored.
/// @param seen  null: everything counts as seen.
[[nodiscard]] MapScore score_map(const sim::OccupancyMap& map, const sim::OccupancyMap& truth,
                                 const sim::Vec2& start, const SeenFloor* seen = nullptr);

/// Compares a map with the truth, as score_map() does.
/// @param reachable  for each cell of the true map: whether coverage considers it if it is free.
[[nodiscard]] MapScore score_map_within(const sim::OccupancyMap& map,
                                        const sim::OccupancyMap& truth,
                                        const std::vector<std::uint8_t>& reachable,
                                        const SeenFloor* seen = nullptr);

}  // namespace playpen::grade
