// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

namespace sim {

/// Whether a thing of the name `known` is meant by `asked`. Programs may ask by names of Stage's
/// worlds, whose characters other than letters, digits, _ and - are _ here.
[[nodiscard]] inline bool is_named(std::string_view known, std::string_view asked) {
  const auto same = [](char ours, char theirs) {
    const bool is_of_names = (theirs >= '0' && theirs <= '9') || (theirs >= 'a' && theirs <= 'z') ||
                             (theirs >= 'A' && theirs <= 'Z') || theirs == '_' || theirs == '-';
    return ours == (is_of_names ? theirs : '_');
  };
  return known == asked || std::equal(known.begin(), known.end(), asked.begin(), asked.end(), same);
}

/// Index of the first element of that name, e.g. of an arena's obstacles; nullopt if there is none.
/// O(n).
template <typename List>
[[nodiscard]] std::optional<int> find_named(const List& list, std::string_view name) {
  const auto found = std::find_if(
      list.begin(), list.end(), [&](const auto& element) { return is_named(element.name, name); });
  if (found == list.end()) return std::nullopt;
  return static_cast<int>(found - list.begin());
}

}  // namespace sim
