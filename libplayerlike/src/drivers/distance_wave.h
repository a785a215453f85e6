// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "playerlike/messages/driver_settings.h"
#include "sim/core/pose.h"
#include "sim/world/occupancy_map.h"

namespace playerlike {

/// A path over a map.
struct PlannedPath {
  std::vector<sim::Vec2> cells;      ///< centres of cells from the start to the goal
  std::vector<sim::Vec2> waypoints;  ///< ends of straight lines; the last one is the goal
  double length_m = 0.0;             ///< along the waypoints, from the start
};

/// Plans paths by a wave that expands from the goal (docs/wavefront.md).
///
/// Configuration space: a cell is free if the robot's disc, enlarged by `safety_dist`, fits there.
/// Occupied and unknown cells are obstacles, and so is all outside of the map. Distances to
/// obstacles are exact (P. Felzenszwalb and D. Huttenlocher, "Distance Transforms of Sampled
/// Functions", Theory of Computing 8, 2012).
///
/// Cost of a step to a neighbouring cell (8 neighbours): its length times 1 + penalty, where the
/// penalty is `dist_penalty` times (max_radius - d) for a cell at distance d < `max_radius` from
/// the nearest obstacle. The wave is E. W. Dijkstra's algorithm (1959).
///
/// Not changed by planning, so it is safe from many threads.
class DistanceWave {
 public:
  DistanceWave(const sim::OccupancyMap& map, const WavefrontSettings& settings);

  /// The cheapest path; nullopt if there is none.
  ///
  /// A start that is not free (the robot was pushed, or the map is coarse) begins at the nearest
  /// free cell within 1 m. A goal that is not free has no path.
  [[nodiscard]] std::optional<PlannedPath> plan(const sim::Vec2& start,
                                                const sim::Vec2& goal) const;
  /// Whether the robot can stand at a point.
  [[nodiscard]] bool is_free(const sim::Vec2& p_W) const;
  /// Whether the robot can drive straight from a to b.
  [[nodiscard]] bool is_line_free(const sim::Vec2& a, const sim::Vec2& b) const;
  /// Distance of a point's cell to the nearest obstacle [m]; 0 outside of the map.
  [[nodiscard]] double clearance_m(const sim::Vec2& p_W) const;

 private:
  [[nodiscard]] std::optional<std::size_t> cell_of(const sim::Vec2& p_W) const;
  [[nodiscard]] sim::Vec2 center_of(std::size_t cell) const;
  [[nodiscard]] std::optional<std::size_t> free_start(const sim::Vec2& start) const;

  int width_;
  int height_;
  double cell_size_m_;
  sim::Vec2 origin_;
  double keep_away_m_;
  std::vector<double> clearance_m_;  ///< by cell, the bottom row first
  std::vector<double> step_factor_;  ///< by cell: cost per metre
};

}  // namespace playerlike
