// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "drivers/local_obstacles.h"
#include "drivers/navigator.h"

namespace playerlike {

/// Smooth Nearness-Diagram navigation: each step computes a twist from a pose, a scan and a goal.
///
/// Frames: W of poses and goal; B body (x forward, y left); L laser. Model: J. W. Durham and F.
/// Bullo, "Smooth Nearness-Diagram Navigation", IROS 2008, based on J. Minguez and L. Montano,
/// "Nearness Diagram (ND) Navigation", IEEE Transactions on Robotics and Automation 20(1), 2004.
/// Each step:
/// 1. Free depths: how far the robot, as a disc, can move straight in each direction.
/// 2. Gaps, where neighbouring depths differ by more than the robot's radius; valleys between gaps.
/// 3. Heading: the goal's direction if the way to it is free, otherwise the direction of the best
///    valley's rising gap. It keeps the safety distance from the corner if the valley is wide
///    enough.
/// 4. Deflection away from all obstacles within the safety distance, weighted by squared threat.
/// 5. Speed reduced by the greatest threat and by the remaining turn.
///
/// docs/snd.md lists the differences from the papers and their reasons.
///
/// Not thread-safe. Deterministic. Cost: some tens of microseconds per step for 682 beams.
class SmoothNearnessDiagram final : public Navigator {
 public:
  explicit SmoothNearnessDiagram(const SndSettings& settings) { use(settings); }

  void set_settings(const GoalDriverSettings& settings) override {
    use(std::get<SndSettings>(settings));
  }

 protected:
  void begin() override { p_WG_.reset(); }
  [[nodiscard]] std::optional<sim::Twist> drive(const Situation& now,
                                                const NavigationScan& scan) override;

 private:
  /// The start of free space behind a corner.
  struct Gap {
    double bearing_rad;     ///< of the first free direction, in B
    double corner_m;        ///< distance of the corner
    int side;               ///< the valley lies to the left (1) or to the right (-1) of the gap
    double half_width_rad;  ///< of the valley
    sim::Vec2 p_WG;         ///< where the robot would pass the corner
  };

  void use(const SndSettings& settings) {
    settings_ = settings;
    set_limits(settings.limits());
  }
  [[nodiscard]] const std::vector<LocalObstacles::Obstacle>& obstacles() const {
    return obstacles_.all();
  }
  void note_seen(double time_s, const sim::Pose& X_WB);
  void measure_depths(double time_s, const sim::Pose& X_WB);
  [[nodiscard]] std::vector<Gap> find_gaps(const sim::Pose& X_WB) const;
  [[nodiscard]] bool sees(const sim::Vec2& p_BQ) const;
  [[nodiscard]] bool hides_something(int near_sector, int far_sector, int side) const;
  [[nodiscard]] double depth_at(double bearing_rad) const;
  [[nodiscard]] double choose_heading(const sim::Pose& X_WB, const sim::Vec2& p_BG);
  [[nodiscard]] sim::Twist drive_along(double heading_rad, double goal_m, double period_s) const;

  SndSettings settings_;
  sim::Vec2 goal_position_ = sim::Vec2::Zero();
  std::optional<sim::Vec2> p_WG_;  ///< the gap chosen last
  double least_way_m_ = 0.0;       ///< shortest path through it so far

  LocalObstacles obstacles_;           ///< seen now or remembered
  std::vector<double> last_seen_s_;    ///< by bearing in W: when the laser last looked there
  std::vector<double> free_depths_m_;  ///< by sector, see the source file; negative: not seen
  std::vector<std::size_t> blocking_obstacles_;  ///< by sector: the obstacle that limits its depth
};

}  // namespace playerlike
