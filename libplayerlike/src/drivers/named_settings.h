// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "sim/core/fields.h"

/// @file
/// Settings of drivers in programs: numbers, by their names and in the units of world files.
namespace playerlike {

/// Whether a program can set a field; it must be a number or a whole number.
using IsSetting = std::function<bool(const sim::Field&)>;

/// Sets one setting. The range is not checked; see fault_of().
/// @param fun  function that errors name.
/// @throws PlayerCc::PlayerError kBadArgument for an unknown name, and for a number that is not
///         whole where a whole one is needed.
void set_named(const std::string& fun, const sim::FieldTable& table, const IsSetting& is_setting,
               void* object, const std::string& name, double value);
/// Returns one setting; NaN if it has no value.
/// @throws PlayerCc::PlayerError kBadArgument for an unknown name.
[[nodiscard]] double get_named(const std::string& fun, const sim::FieldTable& table,
                               const IsSetting& is_setting, const void* object,
                               const std::string& name);

/// Numbers and whole numbers: what LocalDriver offers.
[[nodiscard]] inline bool is_number(const sim::Field& field) {
  return field.type == sim::FieldType::kNumber || field.type == sim::FieldType::kInt;
}

}  // namespace playerlike
