// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/world/description.h"

namespace sim {

/// All levels, from the most exact to the least.
inline constexpr std::array<Realism, 3> kRealismLevels{Realism::kIdeal, Realism::kCourse,
                                                       Realism::kReal};

/// The level with that name in world files, options and environment variables: "ideal", "course" or
/// "real"; nullopt for anything else.
[[nodiscard]] std::optional<Realism> parse_realism(std::string_view text);

/// The name that parse_realism() reads.
[[nodiscard]] std::string_view to_string(Realism level);

}  // namespace sim
