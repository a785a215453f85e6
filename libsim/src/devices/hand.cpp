// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "sim/core/math.h"
#include "sim/world/description.h"

namespace sim {

Hand::Hand(std::string name, const HandParams& params)
    : SensorOf(std::move(name), "hand", params.frequency_hz), params_(params), mounting_(params) {}

std::optional<std::string> Hand::connect(std::string_view robot, const DeviceDirectory& devices) {
  return mounting_.connect(robot, devices);
}

bool Hand::holds(const WorldDescription& world, int robot) const {
  const auto index = static_cast<std::size_t>(held_);
  return held_ >= 0 && index < world.arena.obstacles.size() &&
         world.arena.obstacles[index].carried_by == robot;
}

std::string Hand::held(const WorldDescription& world, int robot) const {
  if (!holds(world, robot)) return "";
  return world.arena.obstacles[static_cast<std::size_t>(held_)].name;
}

int Hand::nearest(const WorldDescription& world, const BodyState& body) const {
  const Eigen::Isometry3d X_HW = mounting_.in_world(body).inverse();
  int found = -1;
  double nearest_m = params_.distance_m;
  const auto& things = world.arena.obstacles;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const ObstacleDescription& thing = things[i];
    if (!thing.portable || thing.carried_by >= 0 || thing.state != ObstacleState::kExtended ||
        (!params_.tag.empty() && !std::ranges::binary_search(thing.tags, params_.tag))) {
      continue;
    }
    const Eigen::Vector3d p_HT =
        X_HW * Eigen::Vector3d(thing.center.x(), thing.center.y(), 0.5 * standing_height_m(thing));
    const double distance_m = p_HT.norm();
    if (distance_m > nearest_m) continue;
    const double aside_rad = math::atan2(math::hypot(p_HT.y(), p_HT.z()), p_HT.x());
    if (aside_rad > 0.5 * params_.angle_rad) continue;
    found = static_cast<int>(i);
    nearest_m = distance_m;
  }
  return found;
}

std::optional<std::string> Hand::execute(const Command& command, RobotControl& robot) {
  const auto* grip = std::get_if<GripCommand>(&command);
  if (grip == nullptr) return apply(command);
  const StepContext now = robot.context();
  if (!holds(now.world, now.robot)) held_ = -1;
  if (grip->action == GripCommand::Action::kClose) {
    if (held_ >= 0) return std::nullopt;
    const int found = nearest(now.world, now.body);
    if (found < 0) return "there is nothing within reach of hand " + name();
    if (auto refusal = robot.pick_up(found)) {
      return "hand " + name() + " cannot take it: " + *refusal;
    }
    held_ = found;
    return std::nullopt;
  }
  if (grip->action == GripCommand::Action::kOpen) {
    if (held_ < 0) return std::nullopt;
    if (auto refusal = robot.put_down(held_)) {
      return "hand " + name() + " cannot open: " + *refusal;
    }
    held_ = -1;
    return std::nullopt;
  }
  return "hand " + name() + " can be opened and closed, and nothing else";
}

void Hand::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.held = held(context.world, context.robot);
  const int found = nearest(context.world, context.body);
  reading.near =
      found < 0 ? "" : context.world.arena.obstacles[static_cast<std::size_t>(found)].name;
}

void Hand::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(held_);
  archive.expect(held_ >= -1, "an index of an obstacle, or -1");
}

constexpr Field kHandSettings[] = {
    frequency_field<&HandParams::frequency_hz>(),
    field<&HandParams::angle_rad>("angle_deg", "degrees",
                                  "full aperture of the cone about its x axis that it reaches")
        .above(0.0, 360.0),
    field<&HandParams::distance_m>("distance", "m", "of the farthest object that it reaches")
        .above(0.0, 100.0),
    field<&HandParams::tag>("tag", "", "it takes objects with this tag; `\"\"`: all"),
    include<HandParams, SensorMount>(),
};
SIM_FIELDS(HandParams, kHandSettings)

constexpr Field kHandReading[] = {
    field<&HandReading::held>("held", "", "name of the obstacle that it holds; empty: none"),
    field<&HandReading::near>("near", "", "name of the obstacle that it would take; empty: none"),
};
SIM_FIELDS(HandReading, kHandReading)

DeviceKind hand_kind() { return device_kind<Hand, HandParams, HandReading>("hand", {}); }

}  // namespace sim
