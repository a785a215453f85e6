// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace sim {

/// What to write in a world file in place of an option of Player's driver, as a hint of an error
/// message: for "snd" and "goal_position_tol" that the setting is "goal_distance" here.
/// @param driver  its type, e.g. "snd".
/// @param option  as the documentation of Player 3 names it.
/// @return a sentence; "" if the driver has no such option, or the setting has the option's name
///     and is also a single number.
[[nodiscard]] std::string hint_for_player_option(std::string_view driver, std::string_view option);

}  // namespace sim
