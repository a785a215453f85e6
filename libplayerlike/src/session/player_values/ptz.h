// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session/player_values/fields.h"
#include "sim/devices/device.h"
#include "sim/devices/ptz.h"

/// @file
/// Player's interface ptz.
namespace playerlike {

template <typename Data, MaybeConst<sim::PtzReading> Head, typename Same>
void same_values(Data& data, Head& head, Same same) {
  same(data.pan, head.pan_rad);
  same(data.tilt, head.tilt_rad);
  same(data.zoom, head.view_rad);
  same(data.panspeed, head.pan_speed_radps);
  same(data.tiltspeed, head.tilt_speed_radps);
  same(data.status, head.moving);
}

template <typename Command, MaybeConst<sim::PointCommand> Point, typename Same>
void same_values(Command& command, Point& point, Same same) {
  same(command.pan, point.pan_rad);
  same(command.tilt, point.tilt_rad);
  same(command.zoom, point.view_rad);
  same(command.panspeed, point.pan_speed_radps);
  same(command.tiltspeed, point.tilt_speed_radps);
}

/// Player has no zoom speed.
template <typename Command, MaybeConst<sim::PanCommand> Pan, typename Same>
void same_values(Command& command, Pan& pan, Same same) {
  same(command.panspeed, pan.pan_speed_radps);
  same(command.tiltspeed, pan.tilt_speed_radps);
}

}  // namespace playerlike
