// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "playerlike/messages/messages.h"

/// Converts properties of robots and obstacles to and from the untyped bytes of Player's programs;
/// only the number of bytes is known. docs/simulation.md lists the formats.
namespace playerlike {

/// The name of a property in Playpen: programs for Stage prepend "_mp_" and write "color".
[[nodiscard]] std::string property_name(const std::string& name);

/// Writes a property's value to a program's memory; the length determines the format. @throws
/// SessionError kBadArgument for a length that fits none of the property's formats.
void write_property(const std::string& property, const PropertyValue& value, void* bytes,
                    std::size_t length);

/// Reads a property's new value from a program's memory.
/// @param now  the present value; it determines the type (numbers or text) and the count.
/// @throws SessionError kBadArgument as write_property().
[[nodiscard]] PropertyValue read_property(const std::string& property, const PropertyValue& now,
                                          const void* bytes, std::size_t length);

}  // namespace playerlike
