// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/world/description.h"

namespace sim {

/// All view modes, in the order in which a viewer cycles through them.
inline constexpr std::array<ViewMode, 3> kViewModes{ViewMode::kGround, ViewMode::kMiniMap,
                                                    ViewMode::kFullScreen};

/// The mode with that name in world files, options and environment variables: "ground", "mini-map"
/// or "full-screen"; nullopt for anything else.
[[nodiscard]] std::optional<ViewMode> parse_view_mode(std::string_view text);

/// The name that parse_view_mode reads.
[[nodiscard]] std::string_view to_string(ViewMode mode);

}  // namespace sim
