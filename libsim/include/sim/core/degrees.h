// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace sim {

/// A degree [rad]: "45.0 * kDegrees" is an angle in radians.
inline constexpr double kDegrees = std::numbers::pi / 180.0;

}  // namespace sim
