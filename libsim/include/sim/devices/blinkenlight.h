// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of a light. Commands can change all but the position.
struct BlinkenlightParams {
  double frequency_hz = 10.0;  ///< [Hz]
  Colour colour{0xff, 0x3b, 0x30, 0xff};
  bool enabled = false;
  double period_s = 1.0;     ///< of one on-off cycle [s]; 0: does not blink
  double duty_cycle = 0.5;   ///< fraction of the period in which it is lit
  Vec2 p_BL = {-0.05, 0.0};  ///< position on the robot, in B [m]
};

/// Whether a light is lit at a given time. It is lit from each multiple of the period on, for the
/// fraction duty_cycle of the period; with period 0 it is always lit.
/// @param time_ns  simulated time, >= 0.
[[nodiscard]] bool is_lit(double period_s, double duty_cycle, SimTime time_ns);

/// Settings of a light, and whether it was lit at the time of the reading.
struct BlinkenlightReading final : Reading {
  bool enabled = false;
  Colour colour;
  double period_s = 0.0;
  double duty_cycle = 0.0;
  bool lit = false;
};

/// A light on the robot's back, shown in pictures only; sensors of other robots do not see it.
/// Takes LightCommand.
class Blinkenlight final : public SensorOf<BlinkenlightReading> {
 public:
  Blinkenlight(std::string name, const BlinkenlightParams& params);

  [[nodiscard]] const BlinkenlightParams& params() const noexcept { return params_; }
  [[nodiscard]] Colour colour() const noexcept { return now_.colour; }
  [[nodiscard]] bool enabled() const noexcept { return now_.enabled; }
  [[nodiscard]] bool lit(SimTime time_ns) const {
    return now_.enabled && is_lit(now_.period_s, now_.duty_cycle, time_ns);
  }

  std::optional<std::string> apply(const Command& command) override;
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  BlinkenlightParams params_;
  BlinkenlightParams now_;
};

}  // namespace sim
