// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/pose.h"
#include "sim/world/obstacle_motion.h"

/// The social-force model: D. Helbing and P. Molnar, "Social force model for pedestrian dynamics",
/// Physical Review E 51, 4282 (1995). Forces are accelerations. All vectors are in W.
namespace sim::social_force {

/// Ratio of a pedestrian's greatest speed to the desired one.
inline constexpr double kSpeedRatio = 1.3;

/// The acceleration towards the desired velocity: (v0 e - v) / tau, eq. (2).
/// @param direction  e, of length 1; or 0, to stop.
[[nodiscard]] Vec2 towards(const Vec2& direction, double speed_mps, const Vec2& velocity,
                           const SocialForce& constants);

/// The repulsion by another pedestrian: -grad V0 exp(-b / sigma), eqs. (3) and (4). b is the
/// semi-minor axis of the ellipse 2b = sqrt((|r| + |r - s|)^2 - |s|^2), where s is the other's way
/// in the next 2 s. What is behind the pedestrian counts half (eqs. 8 and 9: 2 phi = 200 degrees, c
/// = 0.5).
/// @param offset      r, from the other to the pedestrian [m].
/// @param velocity    of the other [m/s].
/// @param direction   of the pedestrian, of length 1; or 0, then nothing is behind it.
/// @return [m/s^2]; 0 if it is below a thousandth of its maximum.
[[nodiscard]] Vec2 repulsion(const Vec2& offset, const Vec2& velocity, const Vec2& direction,
                             const SocialForce& constants);

/// The repulsion by a solid: -grad U0 exp(-|r| / R), eq. (5).
/// @param offset  r, from the nearest point of the solid to the pedestrian [m].
/// @return [m/s^2]; 0 if it is below a thousandth of its maximum.
[[nodiscard]] Vec2 wall_repulsion(const Vec2& offset, const SocialForce& constants);

/// Distance beyond which a solid does not repel a pedestrian [m].
[[nodiscard]] double wall_reach_m(const SocialForce& constants);

}  // namespace sim::social_force
