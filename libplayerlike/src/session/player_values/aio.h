// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "session/player_values/fields.h"
#include "sim/core/number_text.h"
#include "sim/devices/aio.h"
#include "sim/devices/device.h"

/// @file
/// Player's interface aio.
namespace playerlike {

template <typename Data, MaybeConst<sim::AioReading> Lines, typename Same>
void same_values(Data& data, Lines& lines, Same same) {
  same(data.voltages, lines.inputs_v);
}

template <typename Command, MaybeConst<sim::AnalogOutputCommand> Output, typename Same>
void same_values(Command& command, Output& output, Same same) {
  same(command.id, output.channel);
  same(command.voltage, output.voltage_v);
}

/// Whether a line can have the voltage.
[[nodiscard]] inline bool is_line_voltage(double volts) {
  return std::abs(volts) <= sim::AioParams::kMaxVolts;
}
/// Why an output cannot be set. @param count  number of outputs.
[[nodiscard]] inline std::string output_fault(std::uint32_t output, double volts,
                                              std::uint32_t count) {
  return "output " + std::to_string(output) + " cannot have " + sim::rounded_text(volts, 6) +
         " V: there are " + std::to_string(count) +
         " outputs, counted from 0, of at most 1e6 V to either side";
}

}  // namespace playerlike
