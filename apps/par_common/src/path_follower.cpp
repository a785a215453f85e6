// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/path_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace par {
namespace {

// Lowest speed before the end; without it, braking would never finish [m/s].
constexpr double kCreep_mps = 0.02;

/// Parameter of the point on the segment from a to b that is nearest to p: 0 at a, 1 at b.
double nearest_fraction(const Point& a, const Point& b, const Point& p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  if (squared <= 0.0) return 0.0;
  return std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0);
}

Point between(const Point& a, const Point& b, double fraction) {
  return {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
}

}  // namespace

PathFollower::PathFollower(const FollowerParams& params) : params_(params) {
  if (!(params.max_speed_mps > 0.0) || !(params.max_turn_radps > 0.0) ||
      !(params.lookahead_m > 0.0) || !(params.turn_gain > 0.0) || !(params.aligned_rad > 0.0) ||
      !(params.goal_tolerance_m > 0.0) || !(params.braking_mps2 > 0.0)) {
    throw std::invalid_argument("FollowerParams: all values must be more than 0");
  }
  if (params.aligned_rad > params.turn_on_spot_rad) {
    throw std::invalid_argument("FollowerParams: aligned_rad must be at most turn_on_spot_rad");
  }
}

void PathFollower::set_path(std::vector<Point> points) {
  points_ = std::move(points);
  along_m_.clear();
  double along = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i > 0) along += distance_m(points_[i - 1], points_[i]);
    along_m_.push_back(along);
  }
  progress_m_ = 0.0;
  cross_track_m_ = 0.0;
  turning_ = false;
  done_ = points_.empty();
  aim_ = points_.empty() ? Point() : points_.front();
}

double PathFollower::remaining_m() const {
  return along_m_.empty() ? 0.0 : along_m_.back() - progress_m_;
}

Point PathFollower::point_at(double along_m) const {
  const auto next = std::upper_bound(along_m_.begin(), along_m_.end(), along_m);
  if (next == along_m_.begin()) return points_.front();
  if (next == along_m_.end()) return points_.back();
  const std::size_t i = static_cast<std::size_t>(next - along_m_.begin());
  const double length = along_m_[i] - along_m_[i - 1];
  return between(points_[i - 1], points_[i], (along_m - along_m_[i - 1]) / length);
}

void PathFollower::find_progress(const Point& robot) {
  // Search from the last progress to a little ahead. Ignore the path behind, and later passes near
  // this place.
  const double from_m = progress_m_;
  const double to_m = progress_m_ + 3.0 * params_.lookahead_m;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::size_t next = std::min(i + 1, points_.size() - 1);
    if (along_m_[next] < from_m || along_m_[i] > to_m) continue;
    const double length = along_m_[next] - along_m_[i];
    const double along = std::clamp(
        along_m_[i] + nearest_fraction(points_[i], points_[next], robot) * length, from_m, to_m);
    const double distance = distance_m(point_at(along), robot);
    if (distance < least) {
      least = distance;
      progress_m_ = along;
    }
  }
  cross_track_m_ = least;
}

Velocity PathFollower::update(const Pose& robot) {
  if (done_) return {};
  const Point here{robot.x, robot.y};
  find_progress(here);
  if (remaining_m() <= params_.lookahead_m &&
      distance_m(here, points_.back()) <= params_.goal_tolerance_m) {
    done_ = true;
    aim_ = points_.back();
    return {};
  }

  aim_ = point_at(progress_m_ + params_.lookahead_m);
  const double distance = distance_m(here, aim_);
  const double error_rad =
      normalize_angle(std::atan2(aim_.y - here.y, aim_.x - here.x) - robot.yaw);
  if (std::fabs(error_rad) > params_.turn_on_spot_rad) turning_ = true;
  if (std::fabs(error_rad) < params_.aligned_rad) turning_ = false;
  if (turning_) {
    return {0.0, std::clamp(params_.turn_gain * error_rad, -params_.max_turn_radps,
                            params_.max_turn_radps)};
  }

  // Fast enough to stop at the end, but not faster than the robot can turn along the circle to the
  // aim.
  double speed = std::clamp(std::sqrt(2.0 * params_.braking_mps2 * remaining_m()), kCreep_mps,
                            params_.max_speed_mps);
  const double curvature = 2.0 * std::sin(error_rad) / std::max(distance, 1e-6);
  if (std::fabs(curvature) * speed > params_.max_turn_radps) {
    speed = params_.max_turn_radps / std::fabs(curvature);
  }
  return {speed, curvature * speed};
}

}  // namespace par
