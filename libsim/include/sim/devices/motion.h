// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/devices/device.h"

namespace sim {

/// Settings of the (v, omega) motion controller. Limits of 0 mean: none beyond the model's.
struct MotionParams {
  double max_speed_mps = 0.5;                 ///< > 0
  double max_turn_rate_radps = 3.0;           ///< > 0
  double max_acceleration_mps2 = 0.0;         ///< >= 0; 0: no limit, speed changes at once
  double max_turn_acceleration_radps2 = 0.0;  ///< >= 0; 0: no limit
  bool enabled_at_start = true;               ///< whether the motors are on before a client says so
};

/// Motors of a differential drive, commanded by twist.
class Motion final : public Actuator {
 public:
  Motion(std::string name, const MotionParams& params);

  /// Takes TwistCommand (components clamped to the limits) and MotorEnableCommand.
  std::optional<std::string> apply(const Command& command) override;
  /// As apply(); a twist also takes the motors from whatever else steers, unless they are off.
  std::optional<std::string> carry_out(const Command& command, RobotControl& robot) override;
  void placed(const Pose& X_WB) override;

  /// The twist to strive for during the next step of dt_s, limits applied; advances the ramp.
  [[nodiscard]] Twist next_target(double dt_s);

  [[nodiscard]] const MotionParams& params() const noexcept { return params_; }
  [[nodiscard]] bool enabled() const noexcept { return enabled_; }
  [[nodiscard]] const Twist& commanded() const noexcept { return commanded_; }
  void hash(StateHash& hash) const override;

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  MotionParams params_;
  bool enabled_;
  Twist commanded_;  ///< clamped, as last told
  Twist target_;     ///< after the acceleration limit
};

}  // namespace sim
