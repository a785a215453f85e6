// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/world_hash.h"

#include <cmath>
#include <string>
#include <vector>

#include "sim/core/hash.h"
#include "sim/devices/builtin.h"
#include "sim/world/realism.h"
#include "sim/world/robot_model.h"
#include "simulation/controller_hash.h"

namespace sim {
namespace {

void add(StateHash& hash, const Vec2& p) {
  hash.add(p.x());
  hash.add(p.y());
}

void add(StateHash& hash, const Pose& pose) {
  add(hash, pose.position());
  hash.add(pose.yaw_rad);
}

void add(StateHash& hash, const Colour& colour) {
  for (const std::uint8_t part : {colour.r, colour.g, colour.b, colour.a}) {
    hash.add(std::uint64_t{part});
  }
}

void add(StateHash& hash, const ObstacleDescription& box) {
  hash.add(box.name);
  hash.add(static_cast<int>(box.type));
  add(hash, box.center);
  add(hash, box.size);
  hash.add(box.yaw_rad);
  hash.add(box.height_m);
  hash.add(static_cast<int>(box.state));
  hash.add(box.fiducial);
  for (const std::string& tag : box.tags) hash.add(tag);
  hash.add(box.colour.has_value() ? 1 : 0);
  if (box.colour) add(hash, *box.colour);
  hash.add(box.portable ? 1 : 0);
  if (!box.solid) hash.add(1);
  if (box.bottom_m != 0.0) hash.add(box.bottom_m);
  if (box.rise_speed_mps != 0.0 || box.when_blocked != WhenBlocked::kRefuse) {
    hash.add(box.rise_speed_mps);
    hash.add(static_cast<int>(box.when_blocked));
  }
  if (box.mass_kg) {
    hash.add(*box.mass_kg);
    hash.add(box.friction);
  }
  // A drive that stands was added for the controller.
  if (box.motion && box.motion->law != MotionLaw::kStand) add_motion(hash, *box.motion);
  if (box.shape == ObstacleShape::kBox) return;
  hash.add(static_cast<int>(box.shape));
  hash.add(box.outline.size());
  for (const Vec2& vertex : box.outline) add(hash, vertex);
}

void add(StateHash& hash, const std::vector<ObstacleDescription>& boxes) {
  hash.add(boxes.size());
  for (const ObstacleDescription& box : boxes) add(hash, box);
}

void add(StateHash& hash, const std::vector<DeviceDescription>& devices, Realism level) {
  hash.add(devices.size());
  for (const DeviceDescription& device : devices) {
    hash.add(device.name);
    hash.add(device.type);
    // At this level a setting that a file states differs from one that is left out.
    if (level == Realism::kReal) {
      hash.add(device.given.size());
      for (const std::string& key : device.given) hash.add(key);
    }
    if (!device.params.has_value()) continue;
    const DeviceKind* kind = find_device_kind(device.type);
    if (kind == nullptr) continue;
    for (const auto& [name, value] : kind->properties(device.params)) {
      hash.add(name);
      hash.add(value);
    }
  }
}

void add(StateHash& hash, const RobotModel& model) {
  hash.add(model.name);
  hash.add(model.footprint.size());
  for (const Vec2& corner : model.footprint) add(hash, corner);
  for (const Polygon& part : model.parts) {
    hash.add(part.size());
    for (const Vec2& corner : part) add(hash, corner);
  }
  const DriveDescription& drive = model.drive;
  hash.add(static_cast<int>(drive.kind));
  for (const double value :
       {model.height_m, model.mass_kg, model.max_speed_mps, model.max_turn_rate_radps,
        drive.wheel_radius_m, drive.wheel_separation_m, drive.wheelbase_m, drive.max_steering_rad,
        drive.max_steering_rate_radps}) {
    hash.add(value);
  }
  if (drive.steering_commands) hash.add(1);
  if (!model.solid) hash.add(1);
  for (const Superstructure& part : model.superstructures) {
    if (part.bottom_m != 0.0) hash.add(part.bottom_m);
    hash.add(part.height_m);
    hash.add(part.outline.size());
    for (const Vec2& corner : part.outline) add(hash, corner);
  }
}

void add(StateHash& hash, const RobotDescription& robot, const WorldDescription& world) {
  hash.add(robot.name);
  hash.add(robot.model);
  if (const RobotModel* model = find_robot_model(world, robot.model)) add(hash, *model);
  add(hash, robot.pose);
  // A robot on the floor has the hash that it had before robots had an elevation.
  if (robot.elevation != Elevation{}) {
    hash.add(robot.elevation.z_m);
    hash.add(robot.elevation.roll_rad);
    hash.add(robot.elevation.pitch_rad);
  }
  for (const std::string& tag : robot.tags) hash.add(tag);
  add(hash, robot.colour);
  hash.add(robot.port);
  hash.add(robot.fiducial);
  add(hash, robot.devices, world.simulation.realism);
  for (const auto& [interface, index] : robot.proxies) {
    hash.add(interface);
    hash.add(index);
  }
  for (const auto& [interface, names] : robot.interfaces) {
    hash.add(interface);
    for (const std::string& name : names) hash.add(name);
  }
  hash.add(robot.drivers.size());
  for (const DriverDescription& driver : robot.drivers) {
    hash.add(driver.type);
    for (const auto& [key, value] : driver.settings) {
      hash.add(key);
      hash.add(value);
    }
  }
}

}  // namespace

std::uint64_t world_hash(const WorldDescription& world) {
  StateHash hash;
  hash.add(world.name);
  const ArenaDescription& arena = world.arena;
  add(hash, arena.origin);
  add(hash, arena.size);
  hash.add(arena.border ? 1 : 0);
  hash.add(arena.border_height_m);
  add(hash, arena.obstacles);
  add(hash, arena.dock_separators);
  hash.add(arena.docks.size());
  for (const DockDescription& dock : arena.docks) {
    hash.add(dock.name);
    add(hash, dock.pose);
    add(hash, dock.size);
  }
  hash.add(arena.walls.size());
  for (const WallLoop& loop : arena.walls) {
    hash.add(loop.vertices.size());
    for (const Vec2& vertex : loop.vertices) add(hash, vertex);
    if (std::isfinite(loop.height_m)) hash.add(loop.height_m);
    if (!loop.solid) hash.add(1);
  }
  hash.add(world.simulation.step_ns);
  hash.add(world.simulation.start_gate_clients);
  hash.add(world.simulation.objects_locked ? 1 : 0);
  if (world.simulation.realism != Realism::kCourse) {
    hash.add(std::string(to_string(world.simulation.realism)));
  }
  hash.add(world.robots.size());
  for (const RobotDescription& robot : world.robots) add(hash, robot, world);
  hash.add(world.canvas.width);
  hash.add(world.canvas.height);
  hash.add(world.canvas.cell_size_m);
  add(hash, world.canvas.origin);
  if (!world.controller.empty()) add_controller(hash, world.controller);
  return hash.value();
}

}  // namespace sim
