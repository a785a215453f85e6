// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace playerlike {

/// The name of one of Player's interface codes, e.g. "laser"; null if there is none.
[[nodiscard]] const char* player_interface_name(int code) noexcept;
/// The code of one of Player's interfaces; nullopt if there is none of that name.
[[nodiscard]] std::optional<int> player_interface_code(std::string_view name) noexcept;

}  // namespace playerlike
