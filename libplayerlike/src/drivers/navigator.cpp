// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/navigator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "drivers/nearness_diagram.h"
#include "drivers/smooth_nearness_diagram.h"
#include "drivers/straight_drive.h"
#include "drivers/vector_field_histogram.h"

namespace playerlike {
namespace {

// Minimum approach to the goal that counts as progress.
constexpr double kProgress_m = 0.02;
// Minimum turn to the goal's heading that counts as progress.
constexpr double kTurnProgress_rad = 0.02;
// Turn rate per radian of heading error, and the limit of its product with the period.
constexpr double kTurnGain_per_s = 3.0;
constexpr double kGainPerPeriod = 0.5;

}  // namespace

double Navigator::turn_gain_per_s(double period_s) {
  return std::min(kTurnGain_per_s, kGainPerPeriod / period_s);
}

void Navigator::start(const NavigationGoal& goal) {
  goal_ = goal;
  state_ = GoalState::kMoving;
  arrived_ = false;
  last_time_s_.reset();
  turning_since_s_.reset();
  nearest_m_ = std::numeric_limits<double>::infinity();
  begin();
}

sim::Twist Navigator::step(double time_s, const sim::Pose& X_WB, const NavigationScan& scan) {
  if (state_ != GoalState::kMoving) return {};
  const double period_s = std::clamp(time_s - last_time_s_.value_or(time_s - 0.1), 0.01, 0.5);
  last_time_s_ = time_s;

  const sim::Vec2 p_BG = X_WB.inverse() * goal_.position;
  const double goal_m = p_BG.norm();
  arrived_ = goal_m <= (arrived_ ? 1.5 : 1.0) * limits_.goal_distance_m;
  if (gives_up(time_s, goal_m)) {
    state_ = GoalState::kBlocked;
    return {};
  }
  if (arrived_) {
    const double error_rad =
        goal_.yaw_rad ? sim::normalize_angle(*goal_.yaw_rad - X_WB.yaw_rad) : 0.0;
    if (std::abs(error_rad) <= limits_.goal_angle_rad) {
      state_ = GoalState::kReached;
      return {};
    }
    return turn(time_s, error_rad, period_s);
  }
  turning_since_s_.reset();
  const std::optional<sim::Twist> twist =
      drive({time_s, period_s, X_WB, goal_.position, p_BG, goal_m}, scan);
  if (!twist) state_ = GoalState::kBlocked;
  return twist.value_or(sim::Twist{});
}

bool Navigator::gives_up_turning(double in_vain_for_s) const {
  static_cast<void>(in_vain_for_s);
  return false;
}

// Turns on the spot to the goal's heading.
sim::Twist Navigator::turn(double time_s, double error_rad, double period_s) {
  if (!turning_since_s_ || std::abs(error_rad) < least_error_rad_ - kTurnProgress_rad) {
    turning_since_s_ = time_s;
    least_error_rad_ = std::abs(error_rad);
  }
  if (gives_up_turning(time_s - *turning_since_s_)) {
    state_ = GoalState::kBlocked;
    return {};
  }
  const double least_radps = std::min(min_turn_rate_radps_, std::abs(error_rad) / period_s);
  const double rate_radps =
      std::min(std::max(turn_gain_per_s(period_s) * std::abs(error_rad), least_radps),
               limits_.max_turn_rate_radps);
  return {0.0, std::copysign(rate_radps, error_rad)};
}

// Whether the robot has made no progress towards the goal for longer than its patience.
bool Navigator::gives_up(double time_s, double goal_m) {
  if (arrived_ || goal_m < nearest_m_ - kProgress_m) {
    nearest_m_ = std::min(nearest_m_, goal_m);
    nearest_time_s_ = time_s;
  }
  return time_s - nearest_time_s_ > limits_.patience_s;
}

std::unique_ptr<Navigator> make_navigator(const GoalDriverSettings& settings) {
  return std::visit(
      [](const auto& own) -> std::unique_ptr<Navigator> {
        using Settings = std::remove_cvref_t<decltype(own)>;
        if constexpr (std::is_same_v<Settings, SndSettings>) {
          return std::make_unique<SmoothNearnessDiagram>(own);
        } else if constexpr (std::is_same_v<Settings, VfhSettings>) {
          return std::make_unique<VectorFieldHistogram>(own);
        } else if constexpr (std::is_same_v<Settings, NdSettings>) {
          return std::make_unique<NearnessDiagram>(own);
        } else {
          return std::make_unique<StraightDrive>(own);
        }
      },
      settings);
}

}  // namespace playerlike
