// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

namespace sim {

/// Index of the first element of that name, e.g. of an arena's obstacles; nullopt if there is none.
/// O(n).
template <typename List>
[[nodiscard]] std::optional<int> find_named(const List& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const auto& element) { return element.name == name; });
  if (found == list.end()) return std::nullopt;
  return static_cast<int>(found - list.begin());
}

}  // namespace sim
