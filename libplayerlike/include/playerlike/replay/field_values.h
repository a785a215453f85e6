// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/fields.h"
#include "sim/devices/device.h"

namespace playerlike::replay {

/// A list of more numbers than this is a list; a shorter one is as many single values.
inline constexpr std::size_t kMostListedNumbers = 8;
/// Of a list of structs, this many elements are single values.
inline constexpr std::size_t kMostListedElements = 4;

/// What a struct's field table says of a number in it.
struct FieldValue {
  std::string name;  ///< the field's key, with the keys of the structs around it: "own.ip"
  const char* unit = "";
  std::span<const char* const> words = {};  ///< names of a choice's values: 0, 1, ...
  double value = 0.0;
  bool may_be_left_out = false;  ///< messages may lack it
};

/// Calls `number` with each number of a struct and `list` with each longer list of numbers, in the
/// table's order, by the struct's field table alone. A switch is 0 or 1. A vector or pose gives its
/// coordinates; a list of structs its length and the numbers of its first elements. Texts, bytes,
/// empty optional values and fields that occur in messages only are left out.
/// @param list  its name, unit and numbers.
void visit_values(
    const sim::FieldTable& table, const void* object, const std::function<void(FieldValue)>& number,
    const std::function<void(const std::string&, const char*, std::span<const double>)>& list);

/// A command in words: "twist v=0.3 omega=-0.1". Numbers have four significant digits.
[[nodiscard]] std::string text_of(const sim::Command& command);

}  // namespace playerlike::replay
