// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/nearness_diagram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace playerlike {
namespace {

// The paper's number of sectors. Sector s is centred on (s - kNdSectors / 2) * kNdSector_rad.
constexpr int kNdSectors = 144;
constexpr double kNdSector_rad = 2.0 * std::numbers::pi / kNdSectors;
// Regions of at least this width are wide (a quarter of all sectors in the paper).
constexpr double kNdWide_rad = 0.5 * std::numbers::pi;
// Obstacles within this angle of the heading count as being at its side.
constexpr double kNdSide_rad = 0.5 * std::numbers::pi;
// Hysteresis: the gap chosen last counts as this much nearer to the goal.
constexpr double kGapHysteresis_rad = 0.35;
// A gap within this distance of the one chosen last counts as the same gap.
constexpr double kNdSameGap_m = 0.3;

int wrapped_sector(int sector) { return (sector % kNdSectors + kNdSectors) % kNdSectors; }
int nd_sector_of(double bearing_rad) {
  return wrapped_sector(static_cast<int>(std::lround(bearing_rad / kNdSector_rad)) +
                        kNdSectors / 2);
}
double nd_bearing_of(int sector) {
  constexpr int kAhead = kNdSectors / 2;
  return sim::normalize_angle((sector - kAhead) * kNdSector_rad);
}

}  // namespace

void NearnessDiagram::begin() {
  p_WG_.reset();
  X_WB_before_.reset();
  situation_.reset();
}

std::optional<sim::Twist> NearnessDiagram::drive(const Situation& now, const NavigationScan& scan) {
  if (is_stuck(now)) return std::nullopt;
  obstacles_.update(now.time_s, now.X_WB, scan);
  measure_distances(scan.resolution_rad);
  const double goal_rad = sim::math::atan2(now.p_BG.y(), now.p_BG.x());
  if (reaches(now.p_BG)) {
    p_WG_.reset();
    situation_ = Case::kHighSafetyGoalInRegion;
    return act(now, goal_rad);
  }
  const std::optional<Region> region = choose_region(now);
  if (!region) {  // looks around
    situation_.reset();
    return sim::Twist{.omega_radps = std::copysign(settings_.max_turnrate_radps, goal_rad)};
  }
  const bool is_wide = region->width_rad >= kNdWide_rad;
  situation_ = is_wide ? Case::kHighSafetyWideRegion : Case::kHighSafetyNarrowRegion;
  double off_rad = 0.5 * region->width_rad;
  if (is_wide) {
    // Half of the least width of a wide region, or what keeps the corner out of the security zone.
    const double away_m = radius_m() + settings_.avoid_dist_m;
    off_rad = std::min(0.5 * kNdWide_rad,
                       sim::math::asin(std::min(1.0, away_m / std::max(away_m, region->corner_m))));
  }
  return act(now, sim::normalize_angle(region->bearing_rad + region->side * off_rad));
}

// Whether the robot has hardly moved for some time.
bool NearnessDiagram::is_stuck(const Situation& now) {
  const bool moved =
      !X_WB_before_ ||
      (now.X_WB.position() - X_WB_before_->position()).norm() >= settings_.translate_stuck_dist_m ||
      std::abs(sim::normalize_angle(now.X_WB.yaw_rad - X_WB_before_->yaw_rad)) >=
          settings_.translate_stuck_angle_rad;
  if (moved) {
    X_WB_before_ = now.X_WB;
    moved_time_s_ = now.time_s;
  }
  return now.time_s - moved_time_s_ > settings_.translate_stuck_time_s;
}

void NearnessDiagram::measure_distances(double beam_rad) {
  distances_m_.assign(kNdSectors, LocalObstacles::kHorizon_m);
  for (const LocalObstacles::Obstacle& o : obstacles_.all()) {
    // A beam may be wider than a sector.
    const int first = nd_sector_of(o.bearing_rad - 0.5 * beam_rad);
    const int last = nd_sector_of(o.bearing_rad + 0.5 * beam_rad);
    for (int s = first;; s = wrapped_sector(s + 1)) {
      double& distance_m = distances_m_[static_cast<std::size_t>(s)];
      distance_m = std::min(distance_m, o.distance_m);
      if (s == last) break;
    }
  }
}

// Whether the disc fits along the straight line to a point.
bool NearnessDiagram::reaches(const sim::Vec2& p_BG) const {
  const double length_m = p_BG.norm();
  const sim::Vec2 u = p_BG / std::max(length_m, 1e-9);
  const double room_m = radius_m() + LocalObstacles::kMargin_m;
  return std::ranges::none_of(obstacles_.all(), [&](const LocalObstacles::Obstacle& o) {
    const double along_m = o.p_BO.dot(u);
    const double across_m = std::abs(u.x() * o.p_BO.y() - u.y() * o.p_BO.x());
    return along_m > 0.0 && along_m < length_m && across_m < room_m;
  });
}

std::vector<NearnessDiagram::Region> NearnessDiagram::regions() const {
  const double jump_m = 2.0 * radius_m();
  const auto distance = [this](int s) {
    return distances_m_[static_cast<std::size_t>(wrapped_sector(s))];
  };
  const auto is_gap = [&](int s) { return std::abs(distance(s + 1) - distance(s)) > jump_m; };
  std::vector<Region> found;
  for (int s = 0; s < kNdSectors; ++s) {
    if (!is_gap(s)) continue;
    const bool left = distance(s + 1) > distance(s);
    const int first = left ? s + 1 : s;  // the first free sector
    int width = 1;
    while (width < kNdSectors && !is_gap(left ? first + width - 1 : first - width)) ++width;
    found.push_back({nd_bearing_of(wrapped_sector(first)), left ? 1 : -1,
                     std::min(distance(s), distance(s + 1)), width * kNdSector_rad});
  }
  return found;
}

// Whether the disc fits between the corner of the gap and the obstacles on its other side.
bool NearnessDiagram::is_navigable(const Region& region) const {
  const sim::Vec2 corner = region.corner_m * sim::unit_vector(region.bearing_rad);
  const double room_m = 2.0 * radius_m();
  return std::ranges::none_of(obstacles_.all(), [&](const LocalObstacles::Obstacle& o) {
    const double off_rad = region.side * sim::normalize_angle(o.bearing_rad - region.bearing_rad);
    return off_rad > kNdSector_rad && off_rad < 0.5 * std::numbers::pi &&
           (o.p_BO - corner).norm() < room_m;
  });
}

std::optional<NearnessDiagram::Region> NearnessDiagram::choose_region(const Situation& now) {
  const double goal_rad = sim::math::atan2(now.p_BG.y(), now.p_BG.x());
  std::optional<Region> best;
  std::optional<sim::Vec2> best_p_WG;
  double least_rad = std::numeric_limits<double>::infinity();
  for (const Region& region : regions()) {
    const sim::Vec2 p_WG = now.X_WB * (region.corner_m * sim::unit_vector(region.bearing_rad));
    double off_rad = std::abs(sim::normalize_angle(region.bearing_rad - goal_rad));
    if (p_WG_ && (p_WG - *p_WG_).norm() < kNdSameGap_m) off_rad -= kGapHysteresis_rad;
    if (off_rad >= least_rad || !is_navigable(region)) continue;
    least_rad = off_rad;
    best = region;
    best_p_WG = p_WG;
  }
  p_WG_ = best_p_WG;
  return best;
}

// The obstacle in the security zone that is nearest on one side of a heading.
std::optional<NearnessDiagram::Threat> NearnessDiagram::threat(double heading_rad, int side) const {
  std::optional<Threat> nearest;
  for (const LocalObstacles::Obstacle& o : obstacles_.all()) {
    const double distance_m = std::max(0.0, o.distance_m - radius_m());
    if (distance_m >= settings_.avoid_dist_m || (nearest && distance_m >= nearest->distance_m)) {
      continue;
    }
    const double off_rad = side * sim::normalize_angle(o.bearing_rad - heading_rad);
    if (off_rad >= 0.0 && off_rad < kNdSide_rad) nearest = Threat{distance_m, o.bearing_rad};
  }
  return nearest;
}

// Turns the heading away from obstacles in the security zone and chooses the speeds.
sim::Twist NearnessDiagram::act(const Situation& now, double heading_rad) {
  const std::optional<Threat> left = threat(heading_rad, 1);
  const std::optional<Threat> right = threat(heading_rad, -1);
  // Near the goal only obstacles on the way to it matter.
  const double zone_m = std::min(settings_.avoid_dist_m, std::max(0.02, now.goal_m));
  double deflection_rad = 0.0;
  double nearest_m = zone_m;
  for (const auto& [side, threat] : {std::pair(-1, left), std::pair(1, right)}) {
    if (!threat || threat->distance_m >= zone_m) continue;
    const double share = (zone_m - threat->distance_m) / zone_m;
    const double away_rad =
        std::abs(sim::normalize_angle(threat->bearing_rad + std::numbers::pi - heading_rad));
    deflection_rad += side * share * away_rad;
    nearest_m = std::min(nearest_m, threat->distance_m);
  }
  if (left && right) {
    situation_ = Case::kLowSafetyTwoSides;
  } else if (left || right) {
    situation_ = Case::kLowSafetyOneSide;
  }
  const double turn_rad = std::clamp(sim::normalize_angle(heading_rad) + deflection_rad,
                                     -std::numbers::pi, std::numbers::pi);
  const double most_radps = settings_.max_turnrate_radps;
  const double turn_radps = std::clamp(turn_rad / (0.5 * std::numbers::pi), -1.0, 1.0) * most_radps;
  const double share = std::clamp(1.0 - std::abs(turn_rad) / (0.5 * std::numbers::pi), 0.0, 1.0);
  double speed_mps = settings_.max_speed_mps * share * nearest_m / zone_m;
  if (share > 0.0) {
    speed_mps = std::max(speed_mps, std::min(settings_.min_speed_mps, settings_.max_speed_mps));
  }
  speed_mps = std::min(speed_mps, std::max(settings_.min_speed_mps, 2.0 * now.goal_m));
  return obstacles_.safe_twist(speed_mps, turn_radps, now.period_s, radius_m());
}

}  // namespace playerlike
