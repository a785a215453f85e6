// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "playerlike/messages/snd_settings.h"
#include "sim/core/pose.h"

namespace playerlike {

/// Where to drive, in the frame of the poses that SmoothNearnessDiagram::step() is given.
struct SndGoal {
  sim::Vec2 position = sim::Vec2::Zero();  ///< [m]
  std::optional<double> yaw_rad;           ///< heading at the end; none: any will do
};

/// How far a goal has been pursued.
enum class SndState {
  kIdle,     ///< there is no goal
  kMoving,   ///< on the way
  kReached,  ///< arrived: the robot stands within the tolerances
  kBlocked,  ///< given up: the robot stands, since it has come no nearer for a while
};

/// A laser's scan, as Player's laser interface tells it.
struct SndScan {
  std::vector<double> ranges_m;  ///< counter-clockwise; range_max_m and above: nothing met
  double angle_min_rad = 0.0;    ///< of the first beam, from L's x axis
  double resolution_rad = 0.0;   ///< between neighbouring beams
  double range_max_m = 0.0;
  sim::Pose X_BL;  ///< where the laser is mounted on the body
};

/// Smooth Nearness-Diagram navigation: from a pose, a scan and a goal to a twist, again and again.
///
/// Frames: W that of poses and goal; B body (x forward, y left); L laser. Model: J. W. Durham and
/// F. Bullo, "Smooth Nearness-Diagram Navigation", IROS 2008, on the base of J. Minguez and
/// L. Montano, "Nearness Diagram (ND) Navigation", IEEE Transactions on Robotics and Automation
/// 20(1), 2004. Each step:
/// 1. Free depths: how far the robot, as a disc, could go straight in each direction.
/// 2. Gaps where neighbouring depths differ by over a robot's diameter; valleys between gaps.
/// 3. If the goal can be reached straight, its direction, else that of the best valley's rising
///    gap, kept off the corner by the safety distance where the valley is wide enough.
/// 4. Deflection away from all obstacles within the safety distance, weighted by threat squared.
/// 5. Speed reduced by the greatest threat and by what is left to turn.
/// Differences from the papers, and why, are listed in docs/snd.md.
///
/// Not thread-safe. Deterministic. Cost: some tens of microseconds a step for 682 beams.
class SmoothNearnessDiagram {
 public:
  explicit SmoothNearnessDiagram(const SndSettings& settings) : settings_(settings) {}

  /// Takes other settings from the next step() on. @pre fault_of(settings) is empty.
  void set_settings(const SndSettings& settings) { settings_ = settings; }

  /// Takes a new goal and begins to pursue it with the next step().
  void start(const SndGoal& goal);
  /// Drops the goal.
  void cancel() noexcept { state_ = SndState::kIdle; }
  [[nodiscard]] SndState state() const noexcept { return state_; }

  /// The twist to drive until the next step; zero unless the state is kMoving.
  /// @param time_s  simulated time of the scan [s], not less than that of the step before.
  /// @param X_WB    where the robot is.
  [[nodiscard]] sim::Twist step(double time_s, const sim::Pose& X_WB, const SndScan& scan);

 private:
  /// Something that the laser saw, in B.
  struct Obstacle {
    sim::Vec2 p_BO;
    double distance_m;
    double bearing_rad;
  };
  /// Where free space behind a corner begins.
  struct Gap {
    double bearing_rad;     ///< of the first free direction, in B
    double corner_m;        ///< how far away the corner is
    int side;               ///< the valley lies to the left (1) or to the right (-1) of it
    double half_width_rad;  ///< of the valley
    sim::Vec2 p_WG;         ///< where the robot would pass the corner
  };

  /// Something that was seen and has left the laser's view since.
  struct Memory {
    sim::Vec2 p_WO;
    double time_s;  ///< when it was seen last
  };
  /// The bearings from B that a scan covers.
  struct View {
    double middle_rad;
    double half_rad;
    [[nodiscard]] bool covers(double bearing_rad) const;
  };

  void see(double time_s, const sim::Pose& X_WB, const SndScan& scan);
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
  double least_way_m_ = 0.0;       ///< the shortest that the way through it has been so far

  View view_ = {0.0, 0.0};
  std::vector<Obstacle> obstacles_;  ///< seen now or remembered, in order of bearing
  std::vector<Memory> last_scan_;
  std::vector<Memory> memory_;         ///< of what the laser does not look at now
  std::vector<double> looked_s_;       ///< by bearing in W: when the laser looked there last
  std::vector<double> depths_m_;       ///< by sector, see the source; negative: not seen
  std::vector<std::size_t> blockers_;  ///< by sector: the obstacle that ends its depth
};

}  // namespace playerlike
