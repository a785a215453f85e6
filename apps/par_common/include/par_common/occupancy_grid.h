// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "par_common/grid.h"

namespace par {

/// What a map says of a cell.
enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// A laser scan, ready for a map.
struct Scan {
  Pose sensor;                     ///< where the LASER was, not the robot's centre, in W
  double first_bearing_rad = 0.0;  ///< direction of beam 0 against sensor.yaw [rad]
  double bearing_step_rad = 0.0;   ///< from a beam to the next, counter-clockwise [rad]
  double max_range_m = 5.0;        ///< a beam that reads this or more met nothing [m]
  std::vector<double> ranges_m;    ///< [m]
};

/// How much a measurement counts.
struct OccupancyParams {
  /// Added to the log odds of a cell where a beam ends: log(p / (1 - p)) for p = 0.7.
  double hit_log_odds = 0.85;
  /// Added to those of a cell that a beam passes: p = 0.4.
  double miss_log_odds = -0.40;
  /// Log odds stay within +-this, so that a cell that was seen free a thousand times can still
  /// change its mind in a dozen scans when somebody moves a block: p = 0.97.
  double limit_log_odds = 3.5;
  /// Probabilities above this are occupied ...
  double occupied_threshold = 0.65;
  /// ... below this free, and between them unknown. (The prior is 0.5.) Both are those by which
  /// ROS's map_saver judges: what is called known here is known in a saved map, too. A cell is free
  /// once four scans more have seen it free than not.
  double free_threshold = 0.196;
  /// A beam ends on the face of an obstacle, and where faces lie on borders of cells, rounding and
  /// noise put half the ends into the free cell in front. So the end is taken this much further
  /// along the beam [m].
  double depth_m = 0.01;
  /// Beams are used up to here [m]: a longer one tells that so much is free, and nothing of its
  /// end. Far ends are uncertain, and a small error of heading moves them far.
  double usable_range_m = 5.0;
};

/// An occupancy grid: for each cell, how likely something stands there, learned from scans.
///
/// H. Moravec and A. Elfes, "High resolution maps from wide angle sonar", ICRA 1985; in the form of
/// S. Thrun, W. Burgard and D. Fox, Probabilistic Robotics (2005), table 9.1: cells are taken as
/// independent, each keeps the logarithm of its odds l = log(p / (1 - p)), and Bayes's rule becomes
/// an addition: l += l_measured (the prior's l is 0: p = 0.5, unknown). Measured is a hit in the
/// cell where a beam ends, and a miss in each cell before it, which Bresenham's line names.
///
/// Unlike the book's, a cell changes at most once a scan, and a hit goes before a miss (as in
/// W. Hess, D. Kohler, H. Rapp and D. Andor, "Real-time loop closure in 2D LIDAR SLAM", ICRA 2016,
/// sec. IV): near the sensor dozens of beams cross one cell, which are far from independent, and
/// beams that graze a wall pass cells that their neighbours hit.
class OccupancyGrid {
 public:
  /// A map in which all is unknown.
  /// @throw std::invalid_argument for a frame without cells, or if the signs or the order of
  ///        params make no sense (hit > 0 > miss, limit > 0, free < 0.5 < occupied, ...).
  explicit OccupancyGrid(const GridFrame& frame, const OccupancyParams& params = OccupancyParams());

  [[nodiscard]] const GridFrame& frame() const { return log_odds_.frame(); }
  [[nodiscard]] const OccupancyParams& params() const { return params_; }

  /// Learns from a scan. Ranges that are not numbers, or not above 0, are left out; so is the part
  /// of a beam that lies outside the grid. O(beams x cells of a beam).
  void update(const Scan& scan);

  /// What is known of a cell; outside the grid, unknown.
  [[nodiscard]] CellState state(const Cell& cell) const;
  /// Probability that a cell is occupied, 0..1; outside the grid 0.5.
  [[nodiscard]] double probability(const Cell& cell) const;
  /// Log odds of a cell; outside the grid 0.
  [[nodiscard]] double log_odds(const Cell& cell) const { return log_odds_.value_or(cell, 0.0F); }

  /// Probabilities of all cells, for a grey layer: 0 free (white) .. 1 occupied (black).
  [[nodiscard]] Grid<float> probabilities() const;
  /// States of all cells, for frontiers.
  [[nodiscard]] Grid<CellState> states() const;

  /// Forgets what is known of cells within a circle, and takes them as free: the robot stands
  /// there, so nothing else does, however blind its laser is close by. Cells whose centre lies
  /// within radius_m of the centre.
  void set_free(const Point& centre, double radius_m);

 private:
  void mark_ray(const Cell& from, const Cell& to, bool hit);

  OccupancyParams params_;
  Grid<float> log_odds_;
  std::vector<std::uint8_t> seen_;    // of this scan, by cell: 0 nothing, 1 miss, 2 hit
  std::vector<std::size_t> touched_;  // cells with seen_ != 0
};

/// The cells that are in one state.
[[nodiscard]] Mask cells_in_state(const Grid<CellState>& states, CellState state);

/// The cells of Bresenham's line (J. E. Bresenham, "Algorithm for computer control of a digital
/// plotter", IBM Systems Journal 4(1), 1965) from one cell to another, both included, in order:
/// max(|columns|, |rows|) + 1 of them, each next to the one before.
[[nodiscard]] std::vector<Cell> bresenham_line(const Cell& from, const Cell& to);

}  // namespace par
