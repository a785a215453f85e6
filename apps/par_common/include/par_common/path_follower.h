// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "par_common/grid.h"

namespace par {

/// A command: forward speed [m/s] and turn rate [rad/s, counter-clockwise].
struct Velocity {
  double forward_mps = 0.0;
  double turn_radps = 0.0;
};

/// Parameters of a PathFollower.
struct FollowerParams {
  double max_speed_mps = 0.35;  ///< (the S1R's limit is 0.5)
  double max_turn_radps = 2.0;  ///< (the S1R's limit is 3)
  double lookahead_m = 0.08;    ///< distance of the aim point; greater: smoother, but cuts corners
  double turn_gain = 4.0;       ///< turn rate on the spot per error [rad/s per rad]
  double turn_on_spot_rad = 0.7;   ///< with a greater error, stops and turns on the spot ...
  double aligned_rad = 0.15;       ///< ... until the error is less than this
  double goal_tolerance_m = 0.02;  ///< the robot has arrived within this distance of the end
  double braking_mps2 = 0.3;       ///< deceleration before the end
};

/// Drives a differential-drive robot along a path.
///
/// Pure pursuit (R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm",
/// CMU-RI-TR-92-01, 1992). The aim is the point on the path that is `lookahead_m` ahead of the
/// point nearest to the robot. The robot drives the circle through the aim that is tangent to its
/// heading. At distance d and angle alpha this circle has the curvature 2 sin(alpha) / d. Where the
/// angle is too large, at the start and at sharp corners, the robot stops and turns on the spot, so
/// it needs no room beside the path. It never drives backwards. It searches for its progress only a
/// little ahead, so it does not lose its place where the path crosses itself.
class PathFollower {
 public:
  /// @throw std::invalid_argument unless speeds, lookahead, tolerance and braking are > 0 and
  ///        aligned <= turn_on_spot.
  explicit PathFollower(const FollowerParams& params = FollowerParams());

  /// Sets a new path through points in W [m], which replaces the current one. Without points,
  /// done() is true at once.
  void set_path(std::vector<Point> points);
  [[nodiscard]] const std::vector<Point>& path() const { return points_; }

  /// Returns the command for the robot's current pose; zero when done. Call it with each new pose.
  [[nodiscard]] Velocity update(const Pose& robot);

  /// Whether the robot has reached the end (or the path is empty). Stays true until the next
  /// set_path().
  [[nodiscard]] bool done() const { return done_; }
  /// Length of the remaining path, from the point nearest to the robot [m].
  [[nodiscard]] double remaining_m() const;
  /// Distance between the robot and its path at the last update [m].
  [[nodiscard]] double cross_track_m() const { return cross_track_m_; }
  /// The last aim point, for drawing.
  [[nodiscard]] const Point& aim() const { return aim_; }

 private:
  [[nodiscard]] Point point_at(double along_m) const;
  void find_progress(const Point& robot);

  FollowerParams params_;
  std::vector<Point> points_;
  std::vector<double> along_m_;  // length of the path up to each point
  double progress_m_ = 0.0;      // position of the robot along the path
  double cross_track_m_ = 0.0;
  Point aim_;
  bool turning_ = false;
  bool done_ = true;
};

}  // namespace par
