// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sim/devices/device.h"
#include "sim/devices/wire.h"

namespace sim {

/// State of the robot that a digital input shows.
enum class DigitalSignal {
  kContact,  ///< something solid touches the robot
  kStalled,  ///< something blocks the robot, see BodyState::stalled
  kDock,     ///< the centre of its axle is on a dock
};
/// Source of a digital input: a constant level, the robot's state, or an output of a dio device.
using DigitalSource = std::variant<bool, DigitalSignal, Wire>;

/// Settings of digital inputs and outputs.
struct DioParams {
  static constexpr int kMaxLines = 32;  ///< maximum number of inputs or outputs

  double frequency_hz = 10.0;  ///< [Hz]
  /// Sources of inputs 0, 1, ...; at most kMaxLines.
  std::vector<DigitalSource> inputs = {DigitalSignal::kContact, DigitalSignal::kStalled,
                                       DigitalSignal::kDock};
  int outputs = 8;  ///< 0..kMaxLines
};

/// The inputs at the time of the reading, and the outputs.
struct DioReading final : Reading {
  int input_count = 0;
  std::uint32_t inputs = 0;  ///< input i is bit i
  int output_count = 0;
  std::uint32_t outputs = 0;  ///< output i is bit i
};

/// Digital inputs and outputs. Outputs are initially low and keep what DigitalOutputCommand sets;
/// inputs of any robot may be wired to them. If a command sets an output before a step, the inputs
/// wired to it show it in that step's readings, whatever the order of the robots.
class Dio final : public SensorOf<DioReading> {
 public:
  Dio(std::string name, const DioParams& params);

  [[nodiscard]] const DioParams& params() const noexcept { return params_; }
  /// Current level of an output; low if there is no such output.
  [[nodiscard]] bool output(int index) const noexcept {
    return index >= 0 && index < params_.outputs && ((outputs_ >> index) & 1U) != 0;
  }

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  std::optional<std::string> apply(const Command& command) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  DioParams params_;
  std::vector<const Dio*> wired_;  ///< for each input; nullptr if its source is not a wire
  std::uint32_t outputs_ = 0;
};

}  // namespace sim
