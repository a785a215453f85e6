// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/core/pose.h"

namespace sim {

/// Side of the squares that the curve visits [m]. The origin is a corner of four of them.
inline constexpr double kHilbertSquare_m = 0.25;

/// Position of a point along a Hilbert curve, counted in squares. Consecutive squares of the curve
/// are near each other in the plane (Hilbert, "Ueber die stetige Abbildung einer Linie auf ein
/// Flaechenstueck", Math. Ann. 38, 459, 1891). The curve covers 8 km on either side of the origin;
/// points outside are clamped to its edge.
[[nodiscard]] std::uint32_t along_hilbert_curve(const Vec2& p_W);

}  // namespace sim
