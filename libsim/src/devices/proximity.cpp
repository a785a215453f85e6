// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/proximity.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/world/description.h"

namespace sim {

Proximity::Proximity(std::string name, const ProximityParams& params)
    : SensorOf(std::move(name), "proximity", params.frequency_hz), params_(params) {}

std::optional<std::string> Proximity::apply(const Command& command) {
  const auto* track = std::get_if<TrackCommand>(&command);
  if (track == nullptr) return Sensor::apply(command);
  if (track->range_m && !(*track->range_m > 0.0 && *track->range_m <= 1000.0)) {
    return "a range is a number of metres over 0, and at most 1000";
  }
  params_.range_m = track->range_m.value_or(params_.range_m);
  params_.track = track->tag.value_or(params_.track);
  return std::nullopt;
}

void Proximity::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(params_.range_m, params_.track);
}

void Proximity::measure(const StepContext& context) {
  auto& reading = next(context);
  auto& found = reading.near_objects;
  found.clear();
  const Vec2 p_WB = context.body.X_WB.position();
  const auto is_tracked = [&](const std::vector<std::string>& tags) {
    return params_.track.empty() || std::ranges::binary_search(tags, params_.track);
  };
  const auto look_at = [&](const std::string& name, const Vec2& p_W) {
    const double distance_m = (p_W - p_WB).norm();
    if (distance_m <= params_.range_m) found.push_back({name, distance_m});
  };
  for (int i = 0; i < context.physics.robot_count(); ++i) {
    const RobotDescription& robot = context.world.robots[static_cast<std::size_t>(i)];
    if (i == context.robot || !is_tracked(robot.tags)) continue;
    look_at(robot.name, context.physics.body(i).X_WB.position());
  }
  if (params_.obstacles) {
    const ArenaDescription& arena = context.world.arena;
    for (const ObstacleDescription& obstacle : arena.obstacles) {
      if (obstacle.state != ObstacleState::kExtended || obstacle.carried_by == context.robot)
        continue;
      if (is_tracked(obstacle.tags)) look_at(obstacle.name, obstacle.center);
    }
    for (const ObstacleDescription& separator : arena.dock_separators) {
      if (!params_.track.empty()) break;
      look_at(separator.name, separator.center);
    }
  }
  using Neighbour = ProximityReading::Neighbour;
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::tie(a.name, a.distance_m) < std::tie(b.name, b.distance_m);
  });
}

constexpr Field kProximitySettings[] = {
    frequency_field<&ProximityParams::frequency_hz>(),
    field<&ProximityParams::range_m>("range", "m", "maximum distance of listed objects")
        .within(kLeastLength_m, 1000.0),
    field<&ProximityParams::obstacles>("obstacles", "",
                                       "whether it also lists obstacles and dock separators"),
    field<&ProximityParams::track>("track", "", "lists only what has this tag; `\"\"`: everything"),
};
SIM_FIELDS(ProximityParams, kProximitySettings)

constexpr Field kNeighbour[] = {
    field<&ProximityReading::Neighbour::name>("name"),
    field<&ProximityReading::Neighbour::distance_m>("distance", "m"),
};
SIM_FIELDS(ProximityReading::Neighbour, kNeighbour)

constexpr Field kProximityReading[] = {
    field<&ProximityReading::near_objects>("near_objects", "",
                                           "objects within the range, and their distances in m"),
};
SIM_FIELDS(ProximityReading, kProximityReading)

DeviceKind proximity_kind() {
  return device_kind<Proximity, ProximityParams, ProximityReading>("proximity", {});
}

}  // namespace sim
