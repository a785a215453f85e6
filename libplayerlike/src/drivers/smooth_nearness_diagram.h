// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "playerlike/messages/snd_settings.h"
#include "sim/core/pose.h"

namespace playerlike {

/// A goal, in the frame of the poses passed to SmoothNearnessDiagram::step().
struct SndGoal {
  sim::Vec2 position = sim::Vec2::Zero();  ///< [m]
  std::optional<double> yaw_rad;           ///< final heading; none: any heading
};

/// State of the navigation to a goal.
enum class SndState {
  kIdle,     ///< there is no goal
  kMoving,   ///< on the way
  kReached,  ///< arrived: the robot has stopped within the tolerances
  kBlocked,  ///< given up: the robot has stopped, having made no progress for a while
};

/// A laser scan with the fields of Player's laser interface.
struct SndScan {
  std::vector<double> ranges_m;  ///< counter-clockwise; range_max_m and above: no hit
  double angle_min_rad = 0.0;    ///< of the first beam, relative to L's x axis
  double resolution_rad = 0.0;   ///< between neighbouring beams
  double range_max_m = 0.0;
  sim::Pose X_BL;  ///< mounting pose of the laser on the body
};

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
class SmoothNearnessDiagram {
 public:
  explicit SmoothNearnessDiagram(const SndSettings& settings) : settings_(settings) {}

  /// Sets other settings for the next step() and later ones. @pre fault_of(settings) is empty.
  void set_settings(const SndSettings& settings) { settings_ = settings; }

  /// Sets a new goal; the next step() begins to pursue it.
  void start(const SndGoal& goal);
  /// Drops the goal.
  void cancel() noexcept { state_ = SndState::kIdle; }
  [[nodiscard]] SndState state() const noexcept { return state_; }

  /// The twist for the time until the next step; zero unless the state is kMoving.
  /// @param time_s  simulated time of the scan [s], not less than in the previous step.
  /// @param X_WB    pose of the robot.
  [[nodiscard]] sim::Twist step(double time_s, const sim::Pose& X_WB, const SndScan& scan);

 private:
  /// A point that the laser measured, in B.
  struct Obstacle {
    sim::Vec2 p_BO;
    double distance_m;
    double bearing_rad;
  };
  /// The start of free space behind a corner.
  struct Gap {
    double bearing_rad;     ///< of the first free direction, in B
    double corner_m;        ///< distance of the corner
    int side;               ///< the valley lies to the left (1) or to the right (-1) of the gap
    double half_width_rad;  ///< of the valley
    sim::Vec2 p_WG;         ///< where the robot would pass the corner
  };

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

  void update_obstacles(double time_s, const sim::Pose& X_WB, const SndScan& scan);
  void measure_depths(double time_s, const sim::Pose& X_WB);
  [[nodiscard]] std::vector<Gap> find_gaps(const sim::Pose& X_WB) const;
  [[nodiscard]] bool sees(const sim::Vec2& p_BQ) const;
  [[nodiscard]] bool hides_something(int near_sector, int far_sector, int side) const;
  [[nodiscard]] double depth_at(double bearing_rad) const;
  [[nodiscard]] double choose_heading(const sim::Pose& X_WB, const sim::Vec2& p_BG);
  [[nodiscard]] sim::Twist drive(double heading_rad, double goal_m, double period_s) const;
  [[nodiscard]] bool is_safe(const sim::Twist& twist, double period_s) const;
  [[nodiscard]] bool gives_up(double time_s, double goal_m);

  SndSettings settings_;
  SndGoal goal_;
  SndState state_ = SndState::kIdle;
  bool arrived_ = false;
  std::optional<double> last_time_s_;
  double nearest_m_ = 0.0;
  double nearest_time_s_ = 0.0;
  std::optional<sim::Vec2> p_WG_;  ///< the gap chosen last
  double least_way_m_ = 0.0;       ///< shortest path through it so far

  View view_ = {0.0, 0.0};
  std::vector<Obstacle> obstacles_;  ///< seen now or remembered, sorted by bearing
  std::vector<Memory> last_scan_;
  std::vector<Memory> memory_;         ///< points outside of the laser's current view
  std::vector<double> last_seen_s_;    ///< by bearing in W: when the laser last looked there
  std::vector<double> free_depths_m_;  ///< by sector, see the source file; negative: not seen
  std::vector<std::size_t> blocking_obstacles_;  ///< by sector: the obstacle that limits its depth
};

}  // namespace playerlike
