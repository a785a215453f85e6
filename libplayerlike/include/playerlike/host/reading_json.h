// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "sim/devices/device.h"

/// @file
/// Readings and commands as JSON texts, for programs that export a run. The texts follow from the
/// field tables, and their members are those of the protocol (docs/protocol.md). Numbers are exact;
/// those that are not finite are null. Invalid UTF-8 is replaced. All functions are safe to call
/// from many threads.
namespace playerlike {

/// A reading as a JSON object: "seq", "t" (time of the measurement [ns]) and the fields of its
/// type. Bytes are a text in base64.
/// @param type  of the device, e.g. "laser".
/// @throws std::runtime_error if devices of that type make no readings.
[[nodiscard]] std::string reading_json(std::string_view type, const sim::Reading& reading);

/// The JSON Schema (draft 2020-12) of reading_json(). Descriptions state meaning and unit.
/// @throws std::runtime_error as reading_json().
[[nodiscard]] std::string reading_schema(std::string_view type);

/// A command as a JSON object: "kind", e.g. "twist", and the fields of that kind.
[[nodiscard]] std::string command_json(const sim::Command& command);

}  // namespace playerlike
