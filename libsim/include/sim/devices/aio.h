// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sim/devices/device.h"
#include "sim/devices/wire.h"

namespace sim {

/// What an analog input shows of its robot.
enum class AnalogSignal {
  kSpeed,     ///< forward speed, 1 V for each m/s
  kTurnRate,  ///< counter-clockwise, 1 V for each rad/s
};
/// The voltage of a robot's battery, by the name of that device.
struct BatteryTap {
  std::string device = "battery";
};
/// What stands at an analog input: a constant voltage [V], its robot's state or battery, an output
/// of an aio device, or a range that a laser, sonar or infra-red measures (1 V for each m).
using AnalogSource = std::variant<double, AnalogSignal, BatteryTap, Wire>;

/// Settings of analog inputs and outputs.
struct AioParams {
  static constexpr int kMaxLines = 8;       ///< inputs, and outputs (Player's limit)
  static constexpr double kMaxVolts = 1e6;  ///< of an output, to either side

  double frequency_hz = 10.0;  ///< (0, 1000]
  double noise_v = 0.0;        ///< standard deviation of each input [V], >= 0
  /// What input 0, 1, ... is wired to; at most kMaxLines.
  std::vector<AnalogSource> inputs = {AnalogSignal::kSpeed, AnalogSignal::kTurnRate};
  int outputs = 2;  ///< 0..kMaxLines
};

/// The voltages at the inputs, and the outputs.
struct AioReading final : Reading {
  std::vector<double> inputs_v;   ///< [V]
  std::vector<double> outputs_v;  ///< [V]
};

/// Analog inputs and outputs. Outputs are 0 V at first and keep what AnalogOutputCommand sets;
/// inputs of any robot may be wired to them. Inputs that follow a sensor show its newest reading
/// (0 V before the first), and each input adds normal noise of its own.
class Aio final : public SensorOf<AioReading> {
 public:
  Aio(std::string name, const AioParams& params, RandomStream noise);

  [[nodiscard]] const AioParams& params() const noexcept { return params_; }
  /// Voltage of an output now [V]; 0 for one that is not there.
  [[nodiscard]] double output_v(int index) const noexcept {
    return index >= 0 && index < params_.outputs ? outputs_v_[static_cast<std::size_t>(index)]
                                                 : 0.0;
  }

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  std::optional<std::string> apply(const Command& command) override;
  [[nodiscard]] bool measures_after_others() const noexcept override { return true; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  [[nodiscard]] double voltage_v(std::size_t input, const StepContext& context) const;

  AioParams params_;
  RandomStream noise_;
  std::vector<const Device*> wired_;  ///< for each input; nullptr: to no device
  std::vector<double> outputs_v_;
};

}  // namespace sim
