// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/error.h"

namespace sim::io::stage {

/// The colour of that name in X11's rgb.txt; upper case and blanks do not matter. nullopt if there
/// is none.
[[nodiscard]] std::optional<Colour> x11_colour(std::string_view name);

/// The X11 name that is nearest to a misspelt one; "" if none is near.
[[nodiscard]] std::string nearest_x11_name(std::string_view name);

}  // namespace sim::io::stage
