// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/occupancy_map.h"

namespace sim {

/// How ranges scatter around the obstacles of a map.
struct LikelihoodSettings {
  double deviation_m = 0.1;  ///< standard deviation of a range, map errors included, > 0 [m]
  double bad_share = 0.1;    ///< share of ranges that do not come from the map, (0, 1)
};

/// Beams of one scan that met something, as points in the body frame B [m].
struct ScanPoints {
  std::vector<Vec2> p_BQ;
};

/// Selects beams of a scan, evenly spread, and turns them into points. Beams that met nothing, with
/// a range of range_max_m or more, and ranges that are not positive numbers are left out, as in
/// table 6.3 of the book.
/// @param X_BL        pose of the laser L in B.
/// @param ranges_m    one per beam, counter-clockwise.
/// @param most_beams  maximum number of beams to use, >= 1.
[[nodiscard]] ScanPoints scan_points(const Pose& X_BL, std::span<const double> ranges_m,
                                     double angle_min_rad, double resolution_rad,
                                     double range_max_m, int most_beams);

/// How well a scan fits a map, for any pose of the robot: the likelihood field of S. Thrun,
/// W. Burgard, D. Fox, "Probabilistic Robotics" (2005), section 6.4, table 6.3.
///
/// The likelihood of a beam whose point lies at distance d from the nearest surface is
///
///     p = (1 - bad) exp(-d^2 / (2 deviation^2)) + bad
///
/// with the surface of the solids as occupied cells (those with a cell that is not occupied among
/// their eight neighbours), in units of the Gaussian's peak; the common factor cancels when weights
/// are normalised. The field stores log p for each cell. Points beyond the map have p = bad.
class LikelihoodField {
 public:
  /// @pre the map has cells; 0 < bad_share < 1, deviation_m > 0.
  LikelihoodField(const OccupancyMap& map, const LikelihoodSettings& settings);

  /// Mean log-likelihood of a scan's beams, in [log bad, 0]; 0 for a scan without points.
  /// @note One table look-up per point. Safe from many threads.
  [[nodiscard]] double mean_log_likelihood(const Pose& X_WB, const ScanPoints& scan) const;

  /// Draws nothing and changes nothing: maps a number from [0, 1) to the centre of a free cell, all
  /// free cells with the same probability. The corner of the map if no cell is free.
  [[nodiscard]] Vec2 free_position(double uniform) const;
  /// Number of cells whose probability of being occupied is below 0.5.
  [[nodiscard]] std::size_t free_cells() const noexcept { return free_.size(); }

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] double cell_size_m() const noexcept { return cell_size_m_; }

 private:
  int width_;
  int height_;
  double cell_size_m_;
  Vec2 origin_;
  float log_bad_;
  std::vector<float> log_p_;         // by cell, row 0 at the bottom
  std::vector<std::uint32_t> free_;  // indices of free cells in log_p_
};

}  // namespace sim
