// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "drivers/local_obstacles.h"
#include "drivers/navigator.h"

namespace playerlike {

/// Nearness-Diagram navigation: J. Minguez and L. Montano, "Nearness Diagram (ND) Navigation:
/// Collision Avoidance in Troublesome Scenarios", IEEE Transactions on Robotics and Automation
/// 20(1), 2004. Each step:
/// 1. The diagram: the distance of the nearest obstacle in each of 144 sectors; gaps, where
///    neighbours differ by more than the robot's diameter; regions between gaps.
/// 2. The region with a rising gap nearest to the goal, if the robot fits through.
/// 3. The situation: obstacles within the security zone on both sides, on one side, or on none; the
///    goal in the region; a wide or a narrow region.
/// 4. The action of that situation: a direction, a speed and a turn rate.
///
/// docs/nd.md lists the differences from the paper and their reasons.
///
/// Not thread-safe. Deterministic. Cost: some tens of microseconds per step.
class NearnessDiagram final : public Navigator {
 public:
  /// The situations of the paper's figure 3. HS: high safety, no obstacle in the security zone; LS:
  /// low safety.
  enum class Case {
    kHighSafetyGoalInRegion,
    kHighSafetyWideRegion,
    kHighSafetyNarrowRegion,
    kLowSafetyOneSide,
    kLowSafetyTwoSides,
  };

  explicit NearnessDiagram(const NdSettings& settings) { use(settings); }

  void set_settings(const GoalDriverSettings& settings) override {
    use(std::get<NdSettings>(settings));
  }

  /// The situation of the last step; none before the first, or if no region is free.
  [[nodiscard]] std::optional<Case> situation() const { return situation_; }

 protected:
  void begin() override;
  [[nodiscard]] std::optional<sim::Twist> drive(const Situation& now,
                                                const NavigationScan& scan) override;
  [[nodiscard]] bool gives_up_turning(double in_vain_for_s) const override {
    return in_vain_for_s > settings_.rotate_stuck_time_s;
  }

 private:
  /// A run of sectors that begins with a rising gap.
  struct Region {
    double bearing_rad;  ///< of the gap, in B
    int side;            ///< the region lies to the left (1) or to the right (-1) of the gap
    double corner_m;     ///< distance of the obstacle at the gap
    double width_rad;
  };
  /// An obstacle in the security zone.
  struct Threat {
    double distance_m;  ///< from the robot's disc
    double bearing_rad;
  };

  void use(const NdSettings& settings) {
    settings_ = settings;
    set_limits(settings.limits(), settings.min_turnrate_radps);
  }
  [[nodiscard]] double radius_m() const {
    return settings_.robot_radius_m + settings_.safety_dist_m;
  }
  [[nodiscard]] bool is_stuck(const Situation& now);
  void measure_distances(double beam_rad);
  [[nodiscard]] bool reaches(const sim::Vec2& p_BG) const;
  [[nodiscard]] std::vector<Region> regions() const;
  [[nodiscard]] bool is_navigable(const Region& region) const;
  [[nodiscard]] std::optional<Region> choose_region(const Situation& now);
  [[nodiscard]] std::optional<Threat> threat(double heading_rad, int side) const;
  [[nodiscard]] sim::Twist act(const Situation& now, double heading_rad);

  NdSettings settings_;
  LocalObstacles obstacles_;
  std::vector<double> distances_m_;  ///< by sector: of the nearest obstacle
  std::optional<Case> situation_;
  std::optional<sim::Vec2> p_WG_;         ///< the gap chosen last
  std::optional<sim::Pose> X_WB_before_;  ///< where it last drove on
  double moved_time_s_ = 0.0;
};

}  // namespace playerlike
