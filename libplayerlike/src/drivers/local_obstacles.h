// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "drivers/navigator.h"

namespace playerlike {

/// The obstacles around a robot: points of the newest scan, and remembered points outside of the
/// laser's view. Without memory, a laser with a limited field of view would lose the wall behind
/// the robot in a turn, and the goal would draw the robot back to the wall.
///
/// Points are remembered for 60 s, within 3 m of the robot.
class LocalObstacles {
 public:
  /// A point that the laser measured.
  struct Obstacle {
    sim::Vec2 p_BO;
    double distance_m;
    double bearing_rad;  ///< in B
  };

  static constexpr double kHorizon_m = 3.0;
  static constexpr double kMemory_s = 60.0;
  /// Margin that is added to a robot's radius.
  static constexpr double kMargin_m = 0.01;

  /// Takes a scan.
  void update(double time_s, const sim::Pose& X_WB, const NavigationScan& scan);
  /// The points in B, sorted by bearing.
  [[nodiscard]] const std::vector<Obstacle>& all() const { return obstacles_; }
  /// Whether the newest scan covers a bearing in B.
  [[nodiscard]] bool in_view(double bearing_rad) const { return view_.covers(bearing_rad); }

  /// Reduces a speed until the robot's disc stays clear of all points until it could have stopped.
  /// @param speed_mps  forward.
  [[nodiscard]] sim::Twist safe_twist(double speed_mps, double turn_radps, double period_s,
                                      double robot_radius_m) const;

 private:
  /// A point that was seen and has left the laser's view.
  struct Memory {
    sim::Vec2 p_WO;
    double time_s;  ///< when it was last seen
  };
  /// The bearings in B that a scan covers.
  struct View {
    double middle_rad;
    double half_rad;
    [[nodiscard]] bool covers(double bearing_rad) const;
  };

  [[nodiscard]] bool is_safe(const sim::Twist& twist, double period_s, double robot_radius_m) const;

  View view_ = {0.0, 0.0};
  std::vector<Obstacle> obstacles_;
  std::vector<Memory> last_scan_;
  std::vector<Memory> memory_;  ///< points outside of the laser's current view
};

}  // namespace playerlike
