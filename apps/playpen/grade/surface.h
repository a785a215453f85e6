// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace playpen::grade {

/// A side of a solid in W.
struct SolidSide {
  sim::Vec2 a;
  sim::Vec2 b;
  double bottom_m;
  double top_m;
};

/// The surface of a partner in a contact, as a world describes it; empty if it is not there, or has
/// another outline at another height.
[[nodiscard]] std::vector<SolidSide> surface_of(const sim::WorldDescription& world,
                                                const std::string& partner);
/// The side that is nearest to a place. @pre there are sides.
[[nodiscard]] const SolidSide& nearest_side(const std::vector<SolidSide>& sides,
                                            const sim::Vec2& place);
/// Whether a place is on a side, within 2 cm: a robot touches within the tolerances of the physics.
/// @pre there are sides.
[[nodiscard]] bool is_on(const std::vector<SolidSide>& sides, const sim::Vec2& place);

}  // namespace playpen::grade
