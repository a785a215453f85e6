// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "playerlike/messages/driver_settings.h"
#include "proxies/goal_driver.h"
#include "sim/core/pose.h"

namespace playerlike {

/// A goal, in the frame of the poses passed to Navigator::step().
struct NavigationGoal {
  sim::Vec2 position = sim::Vec2::Zero();  ///< [m]
  std::optional<double> yaw_rad;           ///< final heading; none: any heading
};

/// A laser scan with the fields of Player's laser interface.
struct NavigationScan {
  std::vector<double> ranges_m;  ///< counter-clockwise; range_max_m and above: no hit
  double angle_min_rad = 0.0;    ///< of the first beam, relative to L's x axis
  double resolution_rad = 0.0;   ///< between neighbouring beams
  double range_max_m = 0.0;
  sim::Pose X_BL;  ///< mounting pose of the laser on the body
};

/// A method that drives a robot to a goal: each step computes a twist from a pose, a scan and the
/// goal. This class has what all methods share: the state, arriving at the goal, turning to its
/// heading, and giving up. A method implements drive().
///
/// Frames: W of poses and goal; B body (x forward, y left); L laser.
///
/// Not thread-safe. Deterministic.
class Navigator {
 public:
  Navigator() = default;
  Navigator(const Navigator&) = delete;
  Navigator& operator=(const Navigator&) = delete;
  virtual ~Navigator() = default;

  /// Sets other settings for the next step() and later ones.
  /// @pre they are of this method's kind, and fault_of() them is empty.
  virtual void set_settings(const GoalDriverSettings& settings) = 0;

  /// Sets a new goal; the next step() begins to pursue it.
  void start(const NavigationGoal& goal);
  /// Drops the goal.
  void cancel() noexcept { state_ = GoalState::kIdle; }
  [[nodiscard]] GoalState state() const noexcept { return state_; }

  /// The twist for the time until the next step; zero unless the state is kMoving.
  /// @param time_s  simulated time of the scan [s], not less than in the previous step.
  /// @param X_WB    pose of the robot.
  [[nodiscard]] sim::Twist step(double time_s, const sim::Pose& X_WB, const NavigationScan& scan);

 protected:
  /// What drive() gets.
  struct Situation {
    double time_s;
    double period_s;  ///< for which the twist will hold
    sim::Pose X_WB;
    sim::Vec2 p_WG;  ///< the goal
    sim::Vec2 p_BG;
    double goal_m;  ///< distance of the goal
  };

  /// To be called by set_settings() and by the constructor of a method.
  /// @param min_turn_rate_radps  slowest turn to the goal's heading.
  void set_limits(const DrivingLimits& limits, double min_turn_rate_radps = 0.0) {
    limits_ = limits;
    min_turn_rate_radps_ = min_turn_rate_radps;
  }
  /// Forgets what belongs to the previous goal.
  virtual void begin() {}
  /// The twist towards a goal that is not reached yet; nullopt: the method gives up.
  [[nodiscard]] virtual std::optional<sim::Twist> drive(const Situation& now,
                                                        const NavigationScan& scan) = 0;
  /// Whether the method gives up because it could not reach the goal's heading in time.
  [[nodiscard]] virtual bool gives_up_turning(double in_vain_for_s) const;

  /// Turn rate per radian of heading error [1/s]. A command holds for a period of the readings,
  /// which limits the gain to avoid oscillation.
  [[nodiscard]] static double turn_gain_per_s(double period_s);

 private:
  [[nodiscard]] sim::Twist turn(double time_s, double error_rad, double period_s);
  [[nodiscard]] bool gives_up(double time_s, double goal_m);

  DrivingLimits limits_;
  double min_turn_rate_radps_ = 0.0;
  NavigationGoal goal_;
  GoalState state_ = GoalState::kIdle;
  bool arrived_ = false;
  std::optional<double> last_time_s_;
  std::optional<double> turning_since_s_;  ///< when it last came nearer to the goal's heading
  double least_error_rad_ = 0.0;           ///< of the heading at that time
  double nearest_m_ = 0.0;
  double nearest_time_s_ = 0.0;
};

/// Makes the navigator of a kind of driver.
[[nodiscard]] std::unique_ptr<Navigator> make_navigator(const GoalDriverSettings& settings);

}  // namespace playerlike
