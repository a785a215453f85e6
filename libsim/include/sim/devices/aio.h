// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sim/devices/device.h"
#include "sim/devices/wire.h"

namespace sim {

/// State of the robot that an analog input shows.
enum class AnalogSignal {
  kSpeed,     ///< forward speed, 1 V per m/s
  kTurnRate,  ///< turn rate, counter-clockwise, 1 V per rad/s
};
/// The voltage of a battery device of the same robot, by the device's name.
struct BatteryTap {
  std::string device = "battery";
};
/// Source of an analog input: a constant voltage [V], the robot's state or battery, an output of an
/// aio device, or a range of a laser, sonar or infrared device (1 V per m).
using AnalogSource = std::variant<double, AnalogSignal, BatteryTap, Wire>;

/// Settings of analog inputs and outputs.
struct AioParams {
  static constexpr int kMaxLines = 8;  ///< maximum number of inputs or outputs (Player's limit)
  static constexpr double kMaxVolts = 1e6;  ///< maximum magnitude of an output voltage

  double frequency_hz = 10.0;  ///< [Hz]
  double noise_v = 0.0;        ///< standard deviation of each input [V]
  /// Sources of inputs 0, 1, ...; at most kMaxLines.
  std::vector<AnalogSource> inputs = {AnalogSignal::kSpeed, AnalogSignal::kTurnRate};
  int outputs = 2;  ///< 0..kMaxLines
};

/// The voltages of all inputs and outputs.
struct AioReading final : Reading {
  std::vector<double> inputs_v;   ///< [V]
  std::vector<double> outputs_v;  ///< [V]
};

/// Analog inputs and outputs. Outputs are initially 0 V and keep what AnalogOutputCommand sets;
/// inputs of any robot may be wired to them. An input that follows a sensor shows its newest
/// reading (0 V before the first). Each input adds its own Gaussian noise.
class Aio final : public SensorOf<AioReading> {
 public:
  Aio(std::string name, const AioParams& params, RandomStream noise);

  [[nodiscard]] const AioParams& params() const noexcept { return params_; }
  /// Current voltage of an output [V]; 0 if there is no such output.
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
  std::vector<const Device*> wired_;  ///< for each input; nullptr if its source is not a device
  std::vector<double> outputs_v_;
};

}  // namespace sim
