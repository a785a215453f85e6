// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/smooth_nearness_diagram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace playerlike {
namespace {

constexpr double kPi = std::numbers::pi;

// Sectors are one degree wide: sector s is centred on (s - 180) degrees.
constexpr int kSectors = 360;
constexpr double kSector_rad = 2.0 * kPi / kSectors;
constexpr double kNothingSeen = -1.0;
constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
constexpr double kMemory_s = LocalObstacles::kMemory_s;
constexpr double kMargin_m = LocalObstacles::kMargin_m;
// Free depths are clipped here: what is beyond is considered when the robot is nearer.
constexpr double kHorizon_m = LocalObstacles::kHorizon_m;
// Cost of turning by one radian, as a path length.
constexpr double kTurnCost_m = 0.1;
// Hysteresis: another gap is chosen only if the path through it is shorter by this.
constexpr double kGapHysteresis_m = 1.0;
// The hysteresis shrinks by this for each metre by which the chosen path has become longer.
constexpr double kDetourPenalty = 2.0;
// A gap within this distance of the one chosen last counts as the same gap.
constexpr double kSameGap_m = 0.3;
// Beyond this heading error the robot turns on the spot.
constexpr double kTurnOnSpot_rad = kPi / 3.0;
// Fraction of the speed that remains under the greatest threat.
constexpr double kLeastShare = 0.25;
// Speed per metre of distance to the goal, and the minimum speed of the approach.
constexpr double kApproach_per_s = 2.0;
constexpr double kLeastApproach_mps = 0.05;

double bearing_of(int sector) {
  constexpr int kAhead = kSectors / 2;
  return (sector - kAhead) * kSector_rad;
}

int wrapped(int sector) { return (sector % kSectors + kSectors) % kSectors; }

int sector_of(double bearing_rad) {
  return wrapped(static_cast<int>(std::lround(bearing_rad / kSector_rad)) + kSectors / 2);
}

double asin_of_share(double share) { return sim::math::asin(std::clamp(share, 0.0, 1.0)); }

}  // namespace

std::optional<sim::Twist> SmoothNearnessDiagram::drive(const Situation& now,
                                                       const NavigationScan& scan) {
  goal_position_ = now.p_WG;
  obstacles_.update(now.time_s, now.X_WB, scan);
  note_seen(now.time_s, now.X_WB);
  measure_depths(now.time_s, now.X_WB);
  return drive_along(choose_heading(now.X_WB, now.p_BG), now.goal_m, now.period_s);
}

// Notes in which directions the laser looks now.
void SmoothNearnessDiagram::note_seen(double time_s, const sim::Pose& X_WB) {
  last_seen_s_.resize(kSectors, -kMemory_s);
  for (int s = 0; s < kSectors; ++s) {
    if (!obstacles_.in_view(bearing_of(s))) continue;
    last_seen_s_[static_cast<std::size_t>(sector_of(bearing_of(s) + X_WB.yaw_rad))] = time_s;
  }
}

// Measures how far the robot's disc can move straight in each direction. If the line passes an
// obstacle at the distance h < r, a disc of radius r touches it sqrt(r^2 - h^2) before the foot of
// the perpendicular.
void SmoothNearnessDiagram::measure_depths(double time_s, const sim::Pose& X_WB) {
  const double radius_m = settings_.robot_radius_m + kMargin_m;
  free_depths_m_.assign(kSectors, kHorizon_m);
  blocking_obstacles_.assign(kSectors, kNobody);
  for (std::size_t i = 0; i < obstacles().size(); ++i) {
    const LocalObstacles::Obstacle& o = obstacles()[i];
    if (o.distance_m > kHorizon_m + radius_m) continue;
    // If the disc overlaps an obstacle already, half of all directions lead further into it.
    const double half_rad =
        o.distance_m <= radius_m ? 0.5 * kPi : asin_of_share(radius_m / o.distance_m);
    const int middle = sector_of(o.bearing_rad);
    const int reach = static_cast<int>(half_rad / kSector_rad) + 1;
    for (int s = middle - reach; s <= middle + reach; ++s) {
      double& depth_m = free_depths_m_[static_cast<std::size_t>(wrapped(s))];
      const double off_rad = bearing_of(s) - o.bearing_rad;
      const double across_m = o.distance_m * sim::math::sin(off_rad);
      const double along_m = o.distance_m * sim::math::cos(off_rad);
      if (along_m <= 0.0 || std::abs(across_m) >= radius_m) continue;
      const double free_m = along_m - std::sqrt(radius_m * radius_m - across_m * across_m);
      if (free_m >= depth_m) continue;
      depth_m = std::max(0.0, free_m);
      blocking_obstacles_[static_cast<std::size_t>(wrapped(s))] = i;
    }
  }
  for (int s = 0; s < kSectors; ++s) {
    const auto in_world = static_cast<std::size_t>(sector_of(bearing_of(s) + X_WB.yaw_rad));
    if (time_s - last_seen_s_[in_world] > kMemory_s)
      free_depths_m_[static_cast<std::size_t>(s)] = kNothingSeen;
  }
}

double SmoothNearnessDiagram::depth_at(double bearing_rad) const {
  return free_depths_m_[static_cast<std::size_t>(sector_of(bearing_rad))];
}

// Finds rising gaps: sectors where the free depth rises by more than the robot's radius, towards
// one side. Unseen sectors count as not free.
std::vector<SmoothNearnessDiagram::Gap> SmoothNearnessDiagram::find_gaps(
    const sim::Pose& X_WB) const {
  const double jump_m = 1.0 * settings_.robot_radius_m;
  const auto depth = [this](int sector) {
    return free_depths_m_[static_cast<std::size_t>(wrapped(sector))];
  };
  const auto is_gap = [&](int sector) {
    return depth(sector) != kNothingSeen && depth(sector + 1) != kNothingSeen &&
           std::abs(depth(sector + 1) - depth(sector)) > jump_m;
  };
  const bool goal_is_seen = sees(X_WB.inverse() * goal_position_);
  std::vector<Gap> gaps;
  for (int s = 0; s < kSectors; ++s) {
    if (!is_gap(s)) continue;
    const bool left = depth(s + 1) > depth(s);
    const int side = left ? 1 : -1;
    const int first = left ? s + 1 : s;  // the first free sector
    const int before = left ? s : s + 1;
    int width = 1;
    while (width < kSectors && !is_gap(left ? first + width - 1 : first - width)) ++width;
    if (!goal_is_seen && !hides_something(wrapped(before), wrapped(first), side)) continue;
    const double bearing_rad = sim::normalize_angle(bearing_of(first));
    const double corner_m = depth(before) + settings_.robot_radius_m;
    const sim::Vec2 p_BG = corner_m * sim::unit_vector(bearing_rad);
    gaps.push_back({bearing_rad, corner_m, side, 0.5 * width * kSector_rad, X_WB * p_BG});
  }
  return gaps;
}

// Whether no obstacle lies between the body's centre and a point.
bool SmoothNearnessDiagram::sees(const sim::Vec2& p_BQ) const {
  const double bearing_rad = sim::math::atan2(p_BQ.y(), p_BQ.x());
  return std::none_of(
      obstacles().begin(), obstacles().end(), [&](const LocalObstacles::Obstacle& o) {
        return o.distance_m < p_BQ.norm() &&
               std::abs(sim::normalize_angle(o.bearing_rad - bearing_rad)) < kSector_rad;
      });
}

// Whether a gap may lead to free space. It does not if near and far obstacle belong to one surface,
// seen at a flat angle, whose points are too close together for the robot to pass.
bool SmoothNearnessDiagram::hides_something(int near_sector, int far_sector, int side) const {
  const std::size_t near = blocking_obstacles_[static_cast<std::size_t>(near_sector)];
  const std::size_t far = blocking_obstacles_[static_cast<std::size_t>(far_sector)];
  if (near == kNobody || far == kNobody) return true;
  const std::size_t count = obstacles().size();
  std::size_t at = near;
  for (std::size_t steps = 0; at != far; ++steps) {
    if (steps > count / 2) return true;  // on different sides: they form no single surface
    const std::size_t next = side > 0 ? (at + 1) % count : (at + count - 1) % count;
    if ((obstacles()[next].p_BO - obstacles()[at].p_BO).norm() > 2.0 * settings_.robot_radius_m) {
      return true;
    }
    at = next;
  }
  return false;
}

// The desired direction in B.
double SmoothNearnessDiagram::choose_heading(const sim::Pose& X_WB, const sim::Vec2& p_BG) {
  const double goal_m = p_BG.norm();
  const double goal_rad = sim::math::atan2(p_BG.y(), p_BG.x());
  if (depth_at(goal_rad) >= std::min(goal_m - settings_.goal_distance_m, kHorizon_m)) {
    p_WG_.reset();
    return goal_rad;
  }
  const std::vector<Gap> gaps = find_gaps(X_WB);
  const Gap* best = nullptr;
  double best_cost_m = std::numeric_limits<double>::infinity();
  double best_way_m = 0.0;
  bool is_same = false;
  for (const Gap& gap : gaps) {
    const double way_m = (gap.p_WG - X_WB.position()).norm() + (goal_position_ - gap.p_WG).norm();
    double cost_m = way_m + kTurnCost_m * std::abs(gap.bearing_rad);
    // Hysteresis keeps the gap chosen last. It shrinks as the path through that gap grows, since
    // the edge of a round obstacle recedes for ever.
    const bool same = p_WG_ && (gap.p_WG - *p_WG_).norm() < kSameGap_m;
    if (same) cost_m -= std::max(0.0, kGapHysteresis_m - kDetourPenalty * (way_m - least_way_m_));
    if (cost_m >= best_cost_m) continue;
    best = &gap;
    best_cost_m = cost_m;
    best_way_m = way_m;
    is_same = same;
  }
  if (best == nullptr) return goal_rad;
  p_WG_ = best->p_WG;
  least_way_m_ = is_same ? std::min(least_way_m_, best_way_m) : best_way_m;
  const double radius_m = settings_.robot_radius_m;
  const double corner_m = std::max(best->corner_m, radius_m);
  const double clear_rad = asin_of_share((radius_m + settings_.safety_distance_m) / corner_m) -
                           asin_of_share(radius_m / corner_m);
  return sim::normalize_angle(best->bearing_rad +
                              best->side * std::min(clear_rad, best->half_width_rad));
}

sim::Twist SmoothNearnessDiagram::drive_along(double heading_rad, double goal_m,
                                              double period_s) const {
  // Near the goal only obstacles on the way to it matter.
  const double safety_m = std::min(settings_.safety_distance_m, std::max(0.02, goal_m));
  double greatest = 0.0;
  double weights = 0.0;
  double deflection_rad = 0.0;
  for (const LocalObstacles::Obstacle& o : obstacles()) {
    const double threat =
        std::clamp((settings_.robot_radius_m + safety_m - o.distance_m) / safety_m, 0.0, 1.0);
    if (threat <= 0.0) continue;
    const double away_rad = sim::normalize_angle(o.bearing_rad + kPi - heading_rad);
    greatest = std::max(greatest, threat);
    weights += threat * threat;
    deflection_rad += threat * threat * threat * away_rad;
  }
  if (weights > 0.0) deflection_rad /= weights;
  const double turn_rad = sim::normalize_angle(heading_rad + deflection_rad);

  const double gain_per_s = turn_gain_per_s(period_s);
  const double turn_radps = std::clamp(gain_per_s * turn_rad, -settings_.max_turn_rate_radps,
                                       settings_.max_turn_rate_radps);
  const double speed_mps = settings_.max_speed_mps * std::max(kLeastShare, 1.0 - greatest) *
                           std::clamp(1.0 - std::abs(turn_rad) / kTurnOnSpot_rad, 0.0, 1.0);
  const double approach_mps = std::max(kLeastApproach_mps, kApproach_per_s * goal_m);
  return obstacles_.safe_twist(std::min(speed_mps, approach_mps), turn_radps, period_s,
                               settings_.robot_radius_m);
}

}  // namespace playerlike
