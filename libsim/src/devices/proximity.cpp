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

void Proximity::measure(const StepContext& context) {
  auto& reading = next(context);
  auto& found = reading.near_objects;
  found.clear();
  const Vec2 p_WB = context.body.X_WB.position();
  const auto look_at = [&](const std::string& name, const Vec2& p_W) {
    const double distance_m = (p_W - p_WB).norm();
    if (distance_m <= params_.range_m) found.push_back({name, distance_m});
  };
  for (int i = 0; i < context.physics.robot_count(); ++i) {
    if (i == context.robot) continue;
    look_at(context.world.robots[static_cast<std::size_t>(i)].name,
            context.physics.body(i).X_WB.position());
  }
  if (params_.obstacles) {
    const ArenaDescription& arena = context.world.arena;
    for (const ObstacleDescription& obstacle : arena.obstacles) {
      if (obstacle.state != ObstacleState::kExtended || obstacle.carried_by == context.robot)
        continue;
      look_at(obstacle.name, obstacle.center);
    }
    for (const ObstacleDescription& separator : arena.dock_separators) {
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
};
SIM_FIELDS(ProximityParams, kProximitySettings)

constexpr Field kNeighbour[] = {
    field<&ProximityReading::Neighbour::name>("name"),
    field<&ProximityReading::Neighbour::distance_m>("distance", "m"),
};
SIM_FIELDS(ProximityReading::Neighbour, kNeighbour)

constexpr Field kProximityReading[] = {
    field<&ProximityReading::near_objects>("near_objects"),
};
SIM_FIELDS(ProximityReading, kProximityReading)

DeviceKind proximity_kind() {
  return device_kind<Proximity, ProximityParams, ProximityReading>("proximity", {});
}

}  // namespace sim
