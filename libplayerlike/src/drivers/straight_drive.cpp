// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/straight_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/math.h"

namespace playerlike {
namespace {

// It stops turning on the spot below the first heading error, and begins to turn above the second.
constexpr double kAligned_rad = 5.0 * std::numbers::pi / 180.0;
constexpr double kAstray_rad = 20.0 * std::numbers::pi / 180.0;
// Distance of the goal from which on the speed is the greatest.
constexpr double kFullSpeed_m = 2.0;

}  // namespace

std::optional<sim::Twist> StraightDrive::drive(const Situation& now, const NavigationScan& scan) {
  static_cast<void>(scan);
  const double error_rad = sim::math::atan2(now.p_BG.y(), now.p_BG.x());
  turns_ = std::abs(error_rad) > (turns_ ? kAligned_rad : kAstray_rad);
  const double gain_per_s = turn_gain_per_s(now.period_s);
  const double most_radps = settings_.max_angular_vel_radps;
  const double turn_radps = std::clamp(gain_per_s * error_rad, -most_radps, most_radps);
  if (turns_) {
    const double least_radps =
        std::min({settings_.min_angular_vel_radps, std::abs(error_rad) / now.period_s, most_radps});
    return sim::Twist{.omega_radps =
                          std::copysign(std::max(std::abs(turn_radps), least_radps), error_rad)};
  }
  const double least_mps = std::min(settings_.min_vel_mps, settings_.max_vel_mps);
  const double speed_mps = std::clamp(settings_.max_vel_mps * now.goal_m / kFullSpeed_m, least_mps,
                                      settings_.max_vel_mps);
  // Not past the goal before the next step.
  return sim::Twist{.v_mps = std::min(speed_mps, now.goal_m / now.period_s),
                    .omega_radps = turn_radps};
}

}  // namespace playerlike
