// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "playerlike/messages/messages.h"
#include "session/player_values/fields.h"
#include "session/range_settings.h"
#include "sim/core/pose.h"

/// @file
/// Poses, speeds and sizes, which several of Player's interfaces have.
namespace playerlike {

/// A pose in the plane; Player's may be one in space.
template <typename Players, MaybeConst<sim::Pose> Pose, typename Same>
void same_values(Players& players, Pose& pose, Same same) {
  same(players.px, pose.x_m);
  same(players.py, pose.y_m);
  if constexpr (requires { players.pyaw; }) {
    same(players.pyaw, pose.yaw_rad);
  } else {
    same(players.pa, pose.yaw_rad);
  }
}

/// A pose with its heading in (-pi, pi].
template <typename Pose2d>
[[nodiscard]] sim::Pose normalized_pose(const Pose2d& players) {
  return {players.px, players.py, sim::normalize_angle(players.pa)};
}

template <typename Speeds, MaybeConst<sim::Twist> Twist, typename Same>
void same_values(Speeds& speeds, Twist& twist, Same same) {
  same(speeds.px, twist.v_mps);
  same(speeds.py, twist.lateral_mps);
  same(speeds.pa, twist.omega_radps);
}

template <typename Pose3d, MaybeConst<Mounting> Place, typename Same>
void same_values(Pose3d& pose, Place& place, Same same) {
  same(pose.px, place.x_m);
  same(pose.py, place.y_m);
  same(pose.pz, place.z_m);
  same(pose.pyaw, place.yaw_rad);
}

template <typename Box, typename Sized, typename Same>
requires MaybeConst<Sized, BoxSize> || MaybeConst<Sized, RobotInfo>
void same_values(Box& box, Sized& sized, Same same) {
  same(box.sw, sized.width_m);
  same(box.sl, sized.length_m);
  same(box.sh, sized.height_m);
}

}  // namespace playerlike
