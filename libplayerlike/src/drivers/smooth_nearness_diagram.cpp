// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/smooth_nearness_diagram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace playerlike {
namespace {

constexpr double kPi = std::numbers::pi;

// Sectors are one degree wide: sector s is centred on (s - 180) degrees.
constexpr int kSectors = 360;
constexpr double kSector_rad = 2.0 * kPi / kSectors;
constexpr double kUnseen = -1.0;
constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
// Memory of points outside of the laser's view: duration, minimum spacing, maximum number.
constexpr double kMemory_s = 60.0;
constexpr double kMemorySpacing_m = 0.01;
constexpr std::size_t kMemories = 2000;
// Free depths are clipped here: what is beyond is considered when the robot is nearer.
constexpr double kHorizon_m = 3.0;
// Margin that is added to the robot's radius.
constexpr double kMargin_m = 0.01;
// Cost of turning by one radian, as a path length.
constexpr double kTurnCost_m = 0.1;
// Hysteresis: another gap is chosen only if the path through it is shorter by this.
constexpr double kGapHysteresis_m = 1.0;
// The hysteresis shrinks by this for each metre by which the chosen path has become longer.
constexpr double kDetourPenalty = 2.0;
// A gap within this distance of the one chosen last counts as the same gap.
constexpr double kSameGap_m = 0.3;
// Minimum approach to the goal that counts as progress.
constexpr double kProgress_m = 0.02;
// Turn rate per radian of heading error. A command holds for a period of the readings, so
// kGainPerPeriod / period limits the gain to avoid oscillation.
constexpr double kTurnGain_per_s = 3.0;
constexpr double kGainPerPeriod = 0.5;
// Beyond this heading error the robot turns on the spot.
constexpr double kTurnOnSpot_rad = kPi / 3.0;
// Fraction of the speed that remains under the greatest threat.
constexpr double kLeastShare = 0.25;
// Speed per metre of distance to the goal, and the minimum speed of the approach.
constexpr double kApproach_per_s = 2.0;
constexpr double kLeastApproach_mps = 0.05;
// A twist must be free of collisions for its period plus this time.
constexpr double kBraking_s = 0.15;

double bearing_of(int sector) {
  constexpr int kAhead = kSectors / 2;
  return (sector - kAhead) * kSector_rad;
}

int wrapped(int sector) { return (sector % kSectors + kSectors) % kSectors; }

int sector_of(double bearing_rad) {
  return wrapped(static_cast<int>(std::lround(bearing_rad / kSector_rad)) + kSectors / 2);
}

double asin_of_share(double share) { return std::asin(std::clamp(share, 0.0, 1.0)); }

}  // namespace

void SmoothNearnessDiagram::start(const SndGoal& goal) {
  goal_ = goal;
  state_ = SndState::kMoving;
  arrived_ = false;
  last_time_s_.reset();
  nearest_m_ = std::numeric_limits<double>::infinity();
  p_WG_.reset();
}

sim::Twist SmoothNearnessDiagram::step(double time_s, const sim::Pose& X_WB, const SndScan& scan) {
  if (state_ != SndState::kMoving) return {};
  const double period_s = std::clamp(time_s - last_time_s_.value_or(time_s - 0.1), 0.01, 0.5);
  last_time_s_ = time_s;

  const sim::Vec2 p_BG = X_WB.inverse() * goal_.position;
  const double goal_m = p_BG.norm();
  arrived_ = goal_m <= (arrived_ ? 1.5 : 1.0) * settings_.goal_distance_m;
  if (gives_up(time_s, goal_m)) {
    state_ = SndState::kBlocked;
    return {};
  }
  const double gain_per_s = std::min(kTurnGain_per_s, kGainPerPeriod / period_s);
  if (arrived_) {
    const double error_rad =
        goal_.yaw_rad ? sim::normalize_angle(*goal_.yaw_rad - X_WB.yaw_rad) : 0.0;
    if (std::abs(error_rad) <= settings_.goal_angle_rad) {
      state_ = SndState::kReached;
      return {};
    }
    return {0.0, std::clamp(gain_per_s * error_rad, -settings_.max_turn_rate_radps,
                            settings_.max_turn_rate_radps)};
  }
  update_obstacles(time_s, X_WB, scan);
  measure_depths(time_s, X_WB);
  return drive(choose_heading(X_WB, p_BG), goal_m, period_s);
}

bool SmoothNearnessDiagram::View::covers(double bearing_rad) const {
  return std::abs(sim::normalize_angle(bearing_rad - middle_rad)) <= half_rad;
}

// Collects the points that the laser sees, relative to the body's centre, and remembered points
// outside of its view. Without memory, a laser with a limited field of view would lose the wall
// behind the robot in a turn, and the goal would draw the robot back to the wall.
void SmoothNearnessDiagram::update_obstacles(double time_s, const sim::Pose& X_WB,
                                             const SndScan& scan) {
  const double span_rad = scan.resolution_rad * static_cast<double>(scan.ranges_m.size());
  view_ = {scan.angle_min_rad + 0.5 * (span_rad - scan.resolution_rad) + scan.X_BL.yaw_rad,
           std::min(0.5 * span_rad, kPi)};
  const sim::Pose X_BW = X_WB.inverse();
  const auto add = [this](const sim::Vec2& p_BO) {
    obstacles_.push_back({p_BO, p_BO.norm(), std::atan2(p_BO.y(), p_BO.x())});
  };
  const auto in_view = [&](const sim::Vec2& p_BO) {
    const sim::Vec2 p_LO = p_BO - scan.X_BL.position();
    return view_.covers(std::atan2(p_LO.y(), p_LO.x()));
  };
  obstacles_.clear();
  std::erase_if(memory_, [&](const Memory& m) {
    const sim::Vec2 p_BO = X_BW * m.p_WO;
    return time_s - m.time_s > kMemory_s || p_BO.norm() > kHorizon_m || in_view(p_BO);
  });
  for (const Memory& m : last_scan_) {
    const sim::Vec2 p_BO = X_BW * m.p_WO;
    if (p_BO.norm() > kHorizon_m || in_view(p_BO) || memory_.size() >= kMemories) continue;
    const bool is_known = std::any_of(memory_.begin(), memory_.end(), [&](const Memory& known) {
      return (known.p_WO - m.p_WO).cwiseAbs().maxCoeff() < kMemorySpacing_m;
    });
    if (!is_known) memory_.push_back(m);
  }
  for (const Memory& m : memory_) add(X_BW * m.p_WO);
  last_scan_.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.resolution_rad;
    const sim::Vec2 p_LO = scan.ranges_m[i] * sim::Vec2(std::cos(angle_rad), std::sin(angle_rad));
    add(scan.X_BL * p_LO);
    last_scan_.push_back({X_WB * obstacles_.back().p_BO, time_s});
  }
  std::stable_sort(obstacles_.begin(), obstacles_.end(), [](const Obstacle& a, const Obstacle& b) {
    return a.bearing_rad < b.bearing_rad;
  });
  last_seen_s_.resize(kSectors, -kMemory_s);
  for (int s = 0; s < kSectors; ++s) {
    if (!view_.covers(bearing_of(s))) continue;
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
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const Obstacle& o = obstacles_[i];
    if (o.distance_m > kHorizon_m + radius_m) continue;
    // If the disc overlaps an obstacle already, half of all directions lead further into it.
    const double half_rad =
        o.distance_m <= radius_m ? 0.5 * kPi : asin_of_share(radius_m / o.distance_m);
    const int middle = sector_of(o.bearing_rad);
    const int reach = static_cast<int>(half_rad / kSector_rad) + 1;
    for (int s = middle - reach; s <= middle + reach; ++s) {
      double& depth_m = free_depths_m_[static_cast<std::size_t>(wrapped(s))];
      const double off_rad = bearing_of(s) - o.bearing_rad;
      const double across_m = o.distance_m * std::sin(off_rad);
      const double along_m = o.distance_m * std::cos(off_rad);
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
      free_depths_m_[static_cast<std::size_t>(s)] = kUnseen;
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
    return depth(sector) != kUnseen && depth(sector + 1) != kUnseen &&
           std::abs(depth(sector + 1) - depth(sector)) > jump_m;
  };
  const bool goal_is_seen = sees(X_WB.inverse() * goal_.position);
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
    const sim::Vec2 p_BG = corner_m * sim::Vec2(std::cos(bearing_rad), std::sin(bearing_rad));
    gaps.push_back({bearing_rad, corner_m, side, 0.5 * width * kSector_rad, X_WB * p_BG});
  }
  return gaps;
}

// Whether no obstacle lies between the body's centre and a point.
bool SmoothNearnessDiagram::sees(const sim::Vec2& p_BQ) const {
  const double bearing_rad = std::atan2(p_BQ.y(), p_BQ.x());
  return std::none_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& o) {
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
  const std::size_t count = obstacles_.size();
  std::size_t at = near;
  for (std::size_t steps = 0; at != far; ++steps) {
    if (steps > count / 2) return true;  // on different sides: they form no single surface
    const std::size_t next = side > 0 ? (at + 1) % count : (at + count - 1) % count;
    if ((obstacles_[next].p_BO - obstacles_[at].p_BO).norm() > 2.0 * settings_.robot_radius_m) {
      return true;
    }
    at = next;
  }
  return false;
}

// The desired direction in B.
double SmoothNearnessDiagram::choose_heading(const sim::Pose& X_WB, const sim::Vec2& p_BG) {
  const double goal_m = p_BG.norm();
  const double goal_rad = std::atan2(p_BG.y(), p_BG.x());
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
    const double way_m = (gap.p_WG - X_WB.position()).norm() + (goal_.position - gap.p_WG).norm();
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

sim::Twist SmoothNearnessDiagram::drive(double heading_rad, double goal_m, double period_s) const {
  // Near the goal only obstacles on the way to it matter.
  const double safety_m = std::min(settings_.safety_distance_m, std::max(0.02, goal_m));
  double greatest = 0.0;
  double weights = 0.0;
  double deflection_rad = 0.0;
  for (const Obstacle& o : obstacles_) {
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

  const double gain_per_s = std::min(kTurnGain_per_s, kGainPerPeriod / period_s);
  const double turn_radps = std::clamp(gain_per_s * turn_rad, -settings_.max_turn_rate_radps,
                                       settings_.max_turn_rate_radps);
  const double speed_mps = settings_.max_speed_mps * std::max(kLeastShare, 1.0 - greatest) *
                           std::clamp(1.0 - std::abs(turn_rad) / kTurnOnSpot_rad, 0.0, 1.0);
  const double approach_mps = std::max(kLeastApproach_mps, kApproach_per_s * goal_m);
  constexpr std::array kShares{1.0, 0.75, 0.5, 0.25, 0.1};
  for (const double share : kShares) {
    const sim::Twist twist{share * std::min(speed_mps, approach_mps), turn_radps};
    if (is_safe(twist, period_s)) return twist;
  }
  return {0.0, turn_radps};
}

// Whether the robot's disc stays clear of all obstacles under this twist until it could have
// stopped. Leaving an obstacle that the disc overlaps already is safe.
bool SmoothNearnessDiagram::is_safe(const sim::Twist& twist, double period_s) const {
  constexpr int kPlaces = 5;
  const double radius_m = settings_.robot_radius_m + kMargin_m;
  const double reach_m = std::abs(twist.v_mps) * (period_s + kBraking_s) + radius_m;
  const double step_s = (period_s + kBraking_s) / kPlaces;
  sim::Pose X_BP;
  std::array<sim::Vec2, kPlaces> places;
  for (sim::Vec2& place : places) {
    const double mid_rad = X_BP.yaw_rad + 0.5 * twist.omega_radps * step_s;
    X_BP.x_m += twist.v_mps * step_s * std::cos(mid_rad);
    X_BP.y_m += twist.v_mps * step_s * std::sin(mid_rad);
    X_BP.yaw_rad += twist.omega_radps * step_s;
    place = X_BP.position();
  }
  for (const Obstacle& o : obstacles_) {
    if (o.distance_m > reach_m) continue;
    double before_m = o.distance_m;
    for (const sim::Vec2& place : places) {
      const double distance_m = (o.p_BO - place).norm();
      if (distance_m < radius_m && distance_m < before_m) return false;
      before_m = distance_m;
    }
  }
  return true;
}

// Whether the robot has made no progress towards the goal for longer than its patience.
bool SmoothNearnessDiagram::gives_up(double time_s, double goal_m) {
  if (arrived_ || goal_m < nearest_m_ - kProgress_m) {
    nearest_m_ = std::min(nearest_m_, goal_m);
    nearest_time_s_ = time_s;
  }
  return time_s - nearest_time_s_ > settings_.patience_s;
}

}  // namespace playerlike
