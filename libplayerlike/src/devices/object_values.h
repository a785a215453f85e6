// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "playerlike/messages/messages.h"

/// Properties of robots and obstacles as Player's programs hand them over: bytes, of which nothing
/// is known but how many there are. docs/simulation.md lists the forms.
namespace playerlike {

/// A property's own name: programs for Stage put "_mp_" in front, and write "color".
[[nodiscard]] std::string property_name(const std::string& name);

/// Writes a property's value into a program's memory, in the form that its length tells.
/// @throws SessionError kBadArgument for a length that no form of it has.
void write_property(const std::string& property, const PropertyValue& value, void* bytes,
                    std::size_t length);

/// Reads what a program wants a property to be.
/// @param now  its present value, which tells whether it is numbers or a text, and how many.
/// @throws SessionError kBadArgument as write_property().
[[nodiscard]] PropertyValue read_property(const std::string& property, const PropertyValue& now,
                                          const void* bytes, std::size_t length);

}  // namespace playerlike
