// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "par_common/grid.h"

namespace par {

/// What to command: forward speed [m/s] and turn rate [rad/s, counter-clockwise].
struct Velocity {
  double forward_mps = 0.0;
  double turn_radps = 0.0;
};

/// How a PathFollower drives.
struct FollowerParams {
  double max_speed_mps = 0.35;  ///< (the S1R's limit is 0.5)
  double max_turn_radps = 2.0;  ///< (the S1R's limit is 3)
  double lookahead_m = 0.08;    ///< distance to the point that is driven at; greater: smoother, and
                                ///< corners are cut more
  double turn_gain = 4.0;       ///< turn rate on the spot, [rad/s] a radian of error
  double turn_on_spot_rad = 0.7;   ///< further off than this, it stops and turns first ...
  double aligned_rad = 0.15;       ///< ... until it is within this
  double goal_tolerance_m = 0.02;  ///< so near to the end it has arrived
  double braking_mps2 = 0.3;       ///< slows down before the end as if braking with this
};

/// Drives a differential-drive robot along a way.
///
/// Pure pursuit (R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm",
/// CMU-RI-TR-92-01, 1992): aim at the point of the way that lies `lookahead_m` on from the point
/// nearest to the robot, and drive the circle through it that is tangent to the heading. At
/// distance d and angle alpha that circle has curvature 2 sin(alpha) / d. Where the aim is too far
/// off the heading, at the start and at sharp corners, the robot stops and turns on the spot, so
/// that it needs no room beside the way. It never drives backwards, and never loses its place where
/// the way crosses itself: progress along the way is only searched for a little ahead.
class PathFollower {
 public:
  /// @throw std::invalid_argument unless speeds, lookahead, tolerance and braking are > 0 and
  ///        aligned <= turn_on_spot.
  explicit PathFollower(const FollowerParams& params = FollowerParams());

  /// A new way, through points in W [m]; replaces the one there is. No points: nothing to do, done.
  void set_path(std::vector<Point> points);
  [[nodiscard]] const std::vector<Point>& path() const { return points_; }

  /// What to command, given where the robot is now; zero when done. Call it with each new pose.
  [[nodiscard]] Velocity update(const Pose& robot);

  /// Whether the end has been reached (or there was no way). Stays so until the next set_path().
  [[nodiscard]] bool done() const { return done_; }
  /// What is left of the way, from the point nearest to the robot on [m].
  [[nodiscard]] double remaining_m() const;
  /// How far beside its way the robot was at the last update [m].
  [[nodiscard]] double cross_track_m() const { return cross_track_m_; }
  /// The point that was aimed at last: nice to draw.
  [[nodiscard]] const Point& aim() const { return aim_; }

 private:
  [[nodiscard]] Point point_at(double along_m) const;
  void find_progress(const Point& robot);

  FollowerParams params_;
  std::vector<Point> points_;
  std::vector<double> along_m_;  // length of the way up to each point
  double progress_m_ = 0.0;      // where on the way the robot is
  double cross_track_m_ = 0.0;
  Point aim_;
  bool turning_ = false;
  bool done_ = true;
};

}  // namespace par
