// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "session/player_values/poses.h"
#include "session/range_settings.h"
#include "sim/devices/bumper.h"

/// @file
/// Player's interface bumper.
namespace playerlike {

template <typename Data, MaybeConst<sim::BumperReading> Felt, typename Same>
void same_values(Data& data, Felt& felt, Same same) {
  same(data.bumpers, felt.pressed);
}

/// The segments of a bumper. @throws SessionError as element_mountings().
template <typename Segment>
[[nodiscard]] std::vector<Segment> bumper_segments(const DeviceSettings& settings) {
  std::vector<Segment> segments;
  for (const Mounting& place : element_mountings(settings)) {
    const std::string number = std::to_string(segments.size());
    Segment& segment = segments.emplace_back();
    segment.pose = to_players<decltype(segment.pose)>(place);
    segment.length = static_cast<float>(setting_of(settings, "length_" + number));
    segment.radius = static_cast<float>(setting_of(settings, "radius_" + number));
  }
  return segments;
}

}  // namespace playerlike
