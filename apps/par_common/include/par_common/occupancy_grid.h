// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "par_common/grid.h"

namespace par {

/// State of a cell in a map.
enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// A laser scan as input of a map.
struct Scan {
  Pose sensor;                     ///< pose of the LASER, not of the robot's centre, in W
  double first_bearing_rad = 0.0;  ///< direction of beam 0 relative to sensor.yaw [rad]
  double bearing_step_rad = 0.0;   ///< angle between neighbouring beams, counter-clockwise [rad]
  double max_range_m = 5.0;        ///< a beam that reads this or more hit nothing [m]
  std::vector<double> ranges_m;    ///< [m]
};

/// Weights of the measurements, and thresholds.
struct OccupancyParams {
  /// Added to the log odds of a cell where a beam ends: log(p / (1 - p)) for p = 0.7.
  double hit_log_odds = 0.85;
  /// Added to the log odds of a cell that a beam passes: p = 0.4.
  double miss_log_odds = -0.40;
  /// Log odds are clamped to +-limit (p = 0.97). So a cell that was seen free a thousand times can
  /// still become occupied within a dozen scans when somebody moves a block.
  double limit_log_odds = 3.5;
  /// A cell with a higher probability is occupied.
  double occupied_threshold = 0.65;
  /// A cell with a lower probability is free; between the thresholds it is unknown. (The prior is
  /// 0.5.) Both are the thresholds of ROS's map_saver, so a cell that is known here is also known
  /// in a saved map. A cell becomes free after four more free than occupied measurements.
  double free_threshold = 0.196;
  /// The end of a beam is shifted this much further along the beam [m]. A beam ends on the face of
  /// an obstacle. Where faces lie on borders of cells, rounding and noise would put half of the
  /// ends into the free cell in front.
  double depth_m = 0.01;
  /// Beams are used up to this range [m]. A longer beam only marks cells up to this range as free.
  /// Far ends are uncertain, because a small heading error moves them far.
  double usable_range_m = 5.0;
};

/// An occupancy grid: the probability of each cell to be occupied, learned from scans.
///
/// H. Moravec and A. Elfes, "High resolution maps from wide angle sonar", ICRA 1985; in the form of
/// S. Thrun, W. Burgard and D. Fox, Probabilistic Robotics (2005), table 9.1. Cells are assumed to
/// be independent. Each cell stores its log odds l = log(p / (1 - p)), and Bayes's rule becomes an
/// addition: l += l_measured (the prior is l = 0: p = 0.5, unknown). A scan measures a hit in the
/// cell where a beam ends, and a miss in each cell before it on Bresenham's line.
///
/// Unlike in the book, a cell changes at most once per scan, and a hit takes precedence over a miss
/// (as in W. Hess, D. Kohler, H. Rapp and D. Andor, "Real-time loop closure in 2D LIDAR SLAM", ICRA
/// 2016, sec. IV). The reason: near the sensor dozens of beams cross one cell, and they are far
/// from independent; and beams that graze a wall pass cells that their neighbours hit.
class OccupancyGrid {
 public:
  /// A map in which all cells are unknown.
  /// @throw std::invalid_argument for a frame without cells, or if the signs or the order of
  ///        params make no sense (hit > 0 > miss, limit > 0, free < 0.5 < occupied, ...).
  explicit OccupancyGrid(const GridFrame& frame, const OccupancyParams& params = OccupancyParams());

  [[nodiscard]] const GridFrame& frame() const { return log_odds_.frame(); }
  [[nodiscard]] const OccupancyParams& params() const { return params_; }

  /// Adds a scan to the map. Ignores ranges that are not numbers or not above 0, and the part of a
  /// beam outside the grid. O(beams x cells of a beam).
  void update(const Scan& scan);

  /// State of a cell; unknown outside the grid.
  [[nodiscard]] CellState state(const Cell& cell) const;
  /// Probability that a cell is occupied, 0..1; 0.5 outside the grid.
  [[nodiscard]] double probability(const Cell& cell) const;
  /// Log odds of a cell; 0 outside the grid.
  [[nodiscard]] double log_odds(const Cell& cell) const { return log_odds_.value_or(cell, 0.0F); }

  /// Probabilities of all cells, for a grey layer: 0 free (white) .. 1 occupied (black).
  [[nodiscard]] Grid<float> probabilities() const;
  /// States of all cells, for finding frontiers.
  [[nodiscard]] Grid<CellState> states() const;

  /// Sets all cells whose centre is within radius_m of `centre` to free, regardless of earlier
  /// measurements. Use it for the place where the robot stands: nothing else can be there, and the
  /// laser may not see it.
  void set_free(const Point& centre, double radius_m);

  /// Forgets all cells whose centre is in a rectangle: they become unknown. Use it where something
  /// has changed since the robot was there.
  /// @param centre    its middle, in W; yaw is the direction of its length.
  /// @param length_m  extent along the yaw [m], >= 0.
  /// @param width_m   extent across the yaw [m], >= 0.
  void set_unknown(const Pose& centre, double length_m, double width_m);

 private:
  void mark_ray(const Cell& from, const Cell& to, bool hit);

  OccupancyParams params_;
  Grid<float> log_odds_;
  std::vector<std::uint8_t> seen_;    // per cell, for the current scan: 0 nothing, 1 miss, 2 hit
  std::vector<std::size_t> touched_;  // cells with seen_ != 0
};

/// The cells with a given state.
[[nodiscard]] Mask cells_in_state(const Grid<CellState>& states, CellState state);

/// The cells of Bresenham's line from one cell to another (J. E. Bresenham, "Algorithm for computer
/// control of a digital plotter", IBM Systems Journal 4(1), 1965), in order and including both
/// ends. They are max(|columns|, |rows|) + 1 cells, each next to the previous one.
[[nodiscard]] std::vector<Cell> bresenham_line(const Cell& from, const Cell& to);

}  // namespace par
