// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "io/solid_limits.h"
#include "sim/core/fields.h"

namespace sim::io {

/// Reports each number, choice, text and list of a struct that is outside of the range of its
/// field, with its place as the key. Readers refuse such values already; programs can make them. A
/// field whose default is described in words may also be infinite, or 0 if its range does not
/// include 0, which means that it is left out.
/// @param place  of the struct, as a JSON pointer.
/// @param only   the fields to be checked; empty: all.
void check_ranges(const FieldTable& table, const void* object, const std::string& place,
                  const std::function<void(SolidError)>& report,
                  std::initializer_list<std::string_view> only = {});

/// The first value of a struct that check_ranges() reports.
[[nodiscard]] std::optional<SolidError> out_of_range(
    const FieldTable& table, const void* object, std::initializer_list<std::string_view> only = {});

}  // namespace sim::io
