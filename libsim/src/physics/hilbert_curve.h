// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/core/pose.h"

namespace sim {

/// Side of the squares that the curve goes through [m]. The origin is a corner of four of them.
inline constexpr double kHilbertSquare_m = 0.25;

/// Where along a Hilbert curve a point lies, in squares: points that follow one another on it are
/// near each other in the plane (Hilbert, "Ueber die stetige Abbildung einer Linie auf ein
/// Flaechenstueck", Math. Ann. 38, 459, 1891). The curve fills 8 km either way of the origin;
/// points outside count as on the edge.
[[nodiscard]] std::uint32_t along_hilbert_curve(const Vec2& p_W);

}  // namespace sim
