// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "drivers/local_obstacles.h"
#include "drivers/navigator.h"

namespace playerlike {

/// VFH+ navigation: I. Ulrich and J. Borenstein, "VFH+: Reliable Obstacle Avoidance for Fast Mobile
/// Robots", ICRA 1998. Each step:
/// 1. A local map: cells that the scan shows as occupied or hidden.
/// 2. Primary histogram: each such cell adds its magnitude to all sectors in which the disc would
///    meet it (sec. 2.1 of the paper: enlargement angle asin(r / d)).
/// 3. Binary histogram, with hysteresis (sec. 2.2).
/// 4. Masked histogram: sectors that the robot cannot turn to at its speed are blocked (sec. 2.3).
/// 5. Candidate directions from the openings; the one of the least cost wins (sec. 2.4).
///
/// Magnitudes, speeds and defaults are those of Player's driver `vfh`. docs/vfh.md lists the
/// differences and their reasons.
///
/// Not thread-safe. Deterministic. Cost: about a tenth of a millisecond per step.
class VectorFieldHistogram final : public Navigator {
 public:
  explicit VectorFieldHistogram(const VfhSettings& settings) { use(settings); }

  void set_settings(const GoalDriverSettings& settings) override {
    use(std::get<VfhSettings>(settings));
  }

  /// The masked histogram of the last step: whether sector s, counter-clockwise from behind, is
  /// blocked.
  [[nodiscard]] const std::vector<bool>& blocked_sectors() const { return masked_; }

 protected:
  void begin() override;
  [[nodiscard]] std::optional<sim::Twist> drive(const Situation& now,
                                                const NavigationScan& scan) override;

 private:
  /// A cell of the local map.
  struct Cell {
    sim::Vec2 p_BC;
    double distance_m;
    double bearing_rad;
    double magnitude;
  };
  /// A direction in B that the robot may take.
  struct Candidate {
    double bearing_rad;
    double max_speed_mps;
  };

  void use(const VfhSettings& settings);
  void make_cells();
  void find_occupied(double goal_m, double keep_away_m);
  void make_histograms(double keep_away_m);
  [[nodiscard]] std::vector<Candidate> candidates(double goal_rad) const;
  [[nodiscard]] double keep_away_m() const;
  [[nodiscard]] double max_turn_rate_radps() const;
  [[nodiscard]] double turning_radius_m() const;
  [[nodiscard]] bool cannot_turn_to(const sim::Vec2& p_BG) const;

  VfhSettings settings_;
  LocalObstacles obstacles_;
  std::vector<Cell> cells_;              ///< all cells of the window except that of the robot
  std::vector<const Cell*> occupied_;    ///< into cells_
  std::vector<double> free_m_;           ///< by bearing in B: distance of the nearest obstacle
  std::vector<double> magnitudes_;       ///< primary histogram, by sector
  std::vector<bool> binary_;             ///< blocked sectors
  std::vector<bool> masked_;             ///< blocked sectors, for the robot's speed
  double speed_mps_ = 0.0;               ///< commanded last
  std::optional<double> bearing_W_rad_;  ///< chosen last, in W
};

}  // namespace playerlike
