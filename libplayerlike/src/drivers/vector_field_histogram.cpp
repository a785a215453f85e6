// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/vector_field_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/core/math.h"

namespace playerlike {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// Bins of the distances to obstacles, half a degree wide.
constexpr std::size_t kBins = 720;
// Player's magnitude of a cell at distance d is (3000 - d / mm)^4 / 10^8.
constexpr double kReach_m = 3.0;
constexpr double kMagnitude_per_m4 = 1e4;
// Openings: those below the first width are ignored, those below the second are narrow. In a wide
// one the robot keeps half the second width from the border. The values are Player's.
constexpr double kLeastOpening_rad = 10.0 * kRadPerDegree;
constexpr double kWideOpening_rad = 80.0 * kRadPerDegree;
// The turn rate is the greatest beyond this bearing, and proportional to the bearing below
// (Player).
constexpr double kFullTurn_rad = 75.0 * kRadPerDegree;
// Beyond this bearing the robot turns on the spot.
constexpr double kVfhTurnOnSpot_rad = 0.5 * std::numbers::pi;

std::size_t bin_of(double bearing_rad) {
  const double share =
      (sim::normalize_angle(bearing_rad) + std::numbers::pi) / (2.0 * std::numbers::pi);
  return static_cast<std::size_t>(share * kBins) % kBins;
}

// The value at a speed of a setting that is given at 0 and at 1 m/s.
double at_speed(double at_0ms, double at_1ms, double speed_mps) {
  return std::max(0.0, at_0ms + (at_1ms - at_0ms) * speed_mps);
}

}  // namespace

void VectorFieldHistogram::use(const VfhSettings& settings) {
  settings_ = settings;
  set_limits(settings.limits(), settings.min_turnrate_radps);
  make_cells();
}

void VectorFieldHistogram::begin() {
  const double sectors =
      std::max(1.0, std::round(2.0 * std::numbers::pi / settings_.sector_angle_rad));
  binary_.assign(static_cast<std::size_t>(sectors), true);
  bearing_W_rad_.reset();
  speed_mps_ = 0.0;
}

void VectorFieldHistogram::make_cells() {
  cells_.clear();
  const int half = settings_.window_diameter / 2;
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      if (x == 0 && y == 0) continue;
      const sim::Vec2 p_BC = settings_.cell_size_m * sim::Vec2(x, y);
      const double distance_m = p_BC.norm();
      const double near_m = std::max(0.0, kReach_m - distance_m);
      cells_.push_back({p_BC, distance_m, sim::math::atan2(p_BC.y(), p_BC.x()),
                        kMagnitude_per_m4 * near_m * near_m * near_m * near_m});
    }
  }
}

double VectorFieldHistogram::keep_away_m() const {
  return settings_.robot_radius_m +
         at_speed(settings_.safety_dist_0ms_m,
                  settings_.safety_dist_1ms_m.value_or(settings_.safety_dist_0ms_m), speed_mps_);
}

double VectorFieldHistogram::max_turn_rate_radps() const {
  return at_speed(settings_.max_turnrate_0ms_radps,
                  settings_.max_turnrate_1ms_radps.value_or(settings_.max_turnrate_0ms_radps),
                  speed_mps_);
}

double VectorFieldHistogram::turning_radius_m() const {
  const double turn_radps = max_turn_rate_radps();
  if (turn_radps <= 0.0) return std::numeric_limits<double>::max();
  return settings_.min_turn_radius_safety_factor * speed_mps_ / turn_radps;
}

std::optional<sim::Twist> VectorFieldHistogram::drive(const Situation& now,
                                                      const NavigationScan& scan) {
  obstacles_.update(now.time_s, now.X_WB, scan);
  const double goal_rad = sim::math::atan2(now.p_BG.y(), now.p_BG.x());
  find_occupied(now.goal_m, keep_away_m());
  make_histograms(keep_away_m());

  const double last_rad =
      bearing_W_rad_ ? sim::normalize_angle(*bearing_W_rad_ - now.X_WB.yaw_rad) : 0.0;
  const Candidate* best = nullptr;
  double least_cost = std::numeric_limits<double>::infinity();
  const std::vector<Candidate> all = candidates(goal_rad);
  for (const Candidate& candidate : all) {
    const auto off = [&](double rad) {
      return std::abs(sim::normalize_angle(candidate.bearing_rad - rad));
    };
    const double cost =
        settings_.weight_desired_dir * off(goal_rad) + settings_.weight_current_dir * off(last_rad);
    if (cost >= least_cost) continue;
    least_cost = cost;
    best = &candidate;
  }
  const double most_radps = max_turn_rate_radps();
  if (best == nullptr) {  // brakes, and looks around
    speed_mps_ = 0.0;
    return sim::Twist{.omega_radps = std::copysign(most_radps, goal_rad)};
  }
  bearing_W_rad_ = sim::normalize_angle(best->bearing_rad + now.X_WB.yaw_rad);
  const double turn_radps = std::clamp(best->bearing_rad / kFullTurn_rad, -1.0, 1.0) * most_radps;
  double most_mps = best->max_speed_mps;
  if (std::abs(best->bearing_rad) > kVfhTurnOnSpot_rad) most_mps = 0.0;
  if (now.goal_m < 2.0 * settings_.distance_epsilon_m) {
    most_mps = std::min(most_mps, 0.5 * settings_.max_speed_mps);
  }
  const double change_mps = settings_.max_acceleration_mps2 * now.period_s;
  const double wish_mps =
      cannot_turn_to(now.p_BG) ? speed_mps_ - change_mps : speed_mps_ + change_mps;
  const sim::Twist twist =
      obstacles_.safe_twist(std::clamp(wish_mps, 0.0, std::max(0.0, most_mps)), turn_radps,
                            now.period_s, settings_.robot_radius_m);
  speed_mps_ = twist.v_mps;
  return twist;
}

// Finds the cells that are occupied or hidden behind an obstacle. What lies beyond the goal does
// not matter.
void VectorFieldHistogram::find_occupied(double goal_m, double keep_away_m) {
  free_m_.assign(kBins, std::numeric_limits<double>::infinity());
  for (const LocalObstacles::Obstacle& o : obstacles_.all()) {
    // An obstacle is as wide as a cell.
    const double half_rad = sim::math::atan2(0.5 * settings_.cell_size_m, o.distance_m);
    const auto first =
        static_cast<int>(std::floor((o.bearing_rad - half_rad) * kBins / (2.0 * std::numbers::pi)));
    const auto last =
        static_cast<int>(std::floor((o.bearing_rad + half_rad) * kBins / (2.0 * std::numbers::pi)));
    for (int bin = first; bin <= last; ++bin) {
      const auto b = static_cast<std::size_t>(bin + static_cast<int>(kBins) * 3 / 2) % kBins;
      free_m_[b] = std::min(free_m_[b], o.distance_m);
    }
  }
  occupied_.clear();
  const double farthest_m = goal_m + keep_away_m;
  for (const Cell& cell : cells_) {
    if (cell.magnitude <= 0.0 || cell.distance_m > farthest_m) continue;
    if (cell.distance_m + 0.5 * settings_.cell_size_m <= free_m_[bin_of(cell.bearing_rad)])
      continue;
    occupied_.push_back(&cell);
  }
}

// The primary, the binary and the masked histogram.
void VectorFieldHistogram::make_histograms(double keep_away_m) {
  const std::size_t count = binary_.size();
  const double sector_rad = 2.0 * std::numbers::pi / static_cast<double>(count);
  magnitudes_.assign(count, 0.0);
  for (const Cell* cell : occupied_) {
    const double half_rad = sim::math::asin(std::min(1.0, keep_away_m / cell->distance_m));
    const auto first = static_cast<int>(
        std::floor((cell->bearing_rad - half_rad + std::numbers::pi) / sector_rad));
    const auto last = static_cast<int>(
        std::floor((cell->bearing_rad + half_rad + std::numbers::pi) / sector_rad));
    const auto all = static_cast<int>(count);
    for (int s = first; s <= std::min(last, first + all - 1); ++s) {
      magnitudes_[static_cast<std::size_t>((s % all + all) % all)] += cell->magnitude;
    }
  }
  const double low = at_speed(
      settings_.free_space_cutoff_0ms,
      settings_.free_space_cutoff_1ms.value_or(settings_.free_space_cutoff_0ms), speed_mps_);
  const double high_0ms = settings_.obs_cutoff_0ms.value_or(settings_.free_space_cutoff_0ms);
  const double high = at_speed(
      high_0ms,
      settings_.obs_cutoff_1ms.value_or(settings_.free_space_cutoff_1ms.value_or(high_0ms)),
      speed_mps_);
  for (std::size_t s = 0; s < count; ++s) {
    if (magnitudes_[s] > high) {
      binary_[s] = true;
    } else if (magnitudes_[s] < low) {
      binary_[s] = false;
    }
  }
  // The robot turns on a circle to either side, which it cannot leave inwards. An occupied cell in
  // the disc's way on that circle limits how far it can turn.
  const double radius_m = turning_radius_m();
  const double reach_m = radius_m + keep_away_m;
  double left_rad = std::numbers::pi;
  double right_rad = -std::numbers::pi;
  for (const Cell* cell : occupied_) {
    const bool is_left = cell->bearing_rad >= 0.0;
    const sim::Vec2 center(0.0, is_left ? radius_m : -radius_m);
    if ((cell->p_BC - center).norm() >= reach_m || radius_m <= 0.0) continue;
    if (is_left) {
      left_rad = std::min(left_rad, cell->bearing_rad);
    } else {
      right_rad = std::max(right_rad, cell->bearing_rad);
    }
  }
  masked_ = binary_;
  for (std::size_t s = 0; s < count; ++s) {
    const double bearing_rad = (static_cast<double>(s) + 0.5) * sector_rad - std::numbers::pi;
    if (bearing_rad > left_rad || bearing_rad < right_rad) masked_[s] = true;
  }
}

std::vector<VectorFieldHistogram::Candidate> VectorFieldHistogram::candidates(
    double goal_rad) const {
  const std::size_t count = masked_.size();
  const double sector_rad = 2.0 * std::numbers::pi / static_cast<double>(count);
  const double most_mps = settings_.max_speed_mps;
  const auto first_blocked = std::find(masked_.begin(), masked_.end(), true);
  if (first_blocked == masked_.end()) return {{goal_rad, most_mps}};
  const double narrow_mps =
      std::min(most_mps, settings_.max_speed_narrow_opening_mps.value_or(most_mps));
  const double wide_mps =
      std::min(most_mps, settings_.max_speed_wide_opening_mps.value_or(most_mps));
  const auto start = static_cast<std::size_t>(first_blocked - masked_.begin());
  std::vector<Candidate> found;
  for (std::size_t k = 1; k < count;) {
    if (masked_[(start + k) % count]) {
      ++k;
      continue;
    }
    const std::size_t first = k;
    while (k < count && !masked_[(start + k) % count]) ++k;
    const double right_rad = static_cast<double>(start + first) * sector_rad - std::numbers::pi;
    const double width_rad = static_cast<double>(k - first) * sector_rad;
    if (width_rad < kLeastOpening_rad) continue;
    const auto add = [&](double from_right_rad, double speed_mps) {
      found.push_back({sim::normalize_angle(right_rad + from_right_rad), speed_mps});
    };
    const bool is_narrow = width_rad < kWideOpening_rad;
    add(0.5 * width_rad, is_narrow ? narrow_mps : most_mps);
    if (is_narrow) continue;
    add(0.5 * kWideOpening_rad, wide_mps);
    add(width_rad - 0.5 * kWideOpening_rad, wide_mps);
    const double goal_off_rad =
        std::remainder(goal_rad - right_rad - 0.5 * width_rad, 2.0 * std::numbers::pi);
    if (std::abs(goal_off_rad) < 0.5 * (width_rad - kWideOpening_rad)) {
      found.push_back({goal_rad, wide_mps});
    }
  }
  return found;
}

// Whether the goal lies in a circle that the robot cannot turn into at its speed.
bool VectorFieldHistogram::cannot_turn_to(const sim::Vec2& p_BG) const {
  const double radius_m = turning_radius_m();
  const sim::Vec2 center(0.0, std::copysign(radius_m, p_BG.y()));
  return (p_BG - center).norm() + settings_.distance_epsilon_m < radius_m;
}

}  // namespace playerlike
