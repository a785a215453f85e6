// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session/player_values/fields.h"
#include "sim/devices/device.h"
#include "sim/devices/dio.h"

/// @file
/// Player's interface dio.
namespace playerlike {

template <typename Data, MaybeConst<sim::DioReading> Lines, typename Same>
void same_values(Data& data, Lines& lines, Same same) {
  same(data.count, lines.input_count);
  same(data.bits, lines.inputs);
}

template <typename Command, MaybeConst<sim::DigitalOutputCommand> Output, typename Same>
void same_values(Command& command, Output& output, Same same) {
  same(command.count, output.count);
  same(command.digout, output.bits);
}

}  // namespace playerlike
