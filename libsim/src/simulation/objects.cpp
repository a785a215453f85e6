// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Objects by name: where they are put, and how they look.
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "io/check_world.h"
#include "io/solid_limits.h"
#include "sim/core/assert.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"
#include "simulation/loads.h"
#include "simulation/obstacle_motions.h"

namespace sim {
namespace {

// Maximum number of names in a message.
constexpr std::size_t kMostNames = 40;

}  // namespace

// Edits a block, unless the result is invalid; returns the reason then.
template <typename Edit>
std::optional<std::string> Simulation::Impl::change_block(const std::string& name, Edit edit) {
  const std::optional<int> found = find_obstacle(name);
  SIM_ASSERT(found.has_value());
  const int index = *found;
  ObstacleDescription& block = obstacle(index);
  ObstacleDescription now = block;
  edit(now);
  if (now.present_height_m) now.present_height_m = std::min(*now.present_height_m, now.height_m);
  // A portable block may be placed beyond the floor, as programs for Stage do.
  const auto where = now.portable ? std::nullopt : io::outside_floor(world.arena, now);
  if (where) return "obstacle " + name + " would " + *where;
  if (const auto error = io::check_obstacle(now)) {
    return "obstacle " + name + " cannot be so: expected " + error->expected + ", found " +
           error->found;
  }
  const int body = physics->robot_within(now, physics->body_of_obstacle(index));
  if (body >= 0 && now.state == ObstacleState::kExtended) {
    return "obstacle " + name + " cannot be put there: " + title_of_body(body) + " stands there";
  }
  block = std::move(now);
  if (block.carried_by >= 0) loads->detach(index);
  physics->change_obstacle(index, block);
  if (obstacle_motions) obstacle_motions->placed(index);
  invalidate_clearances();
  return std::nullopt;
}

const std::string& Simulation::Impl::name_of_body(int body) const {
  if (body < physics->robot_count()) return world.robots[static_cast<std::size_t>(body)].name;
  return world.arena.obstacles[static_cast<std::size_t>(physics->obstacle_of_body(body))].name;
}

std::string Simulation::Impl::title_of_body(int body) const {
  return (body < physics->robot_count() ? "robot " : "obstacle ") + name_of_body(body);
}

std::optional<std::string> Simulation::Impl::place(std::size_t i, const Pose& X_WB) {
  const RobotPlace place{static_cast<int>(i), X_WB};
  return this->place({&place, 1});
}

std::optional<std::string> Simulation::Impl::place(std::span<const RobotPlace> places) {
  std::vector<Pose> poses;
  for (int k = 0; k < physics->robot_count(); ++k) poses.push_back(physics->body(k).X_WB);
  for (const RobotPlace& place : places) {
    poses.at(static_cast<std::size_t>(place.robot)) = place.X_WB;
  }
  for (const auto& [robot, X_WB] : places) {
    const auto i = static_cast<std::size_t>(robot);
    if (auto refusal = refusal_of_mirrored(i)) return refusal;
    if (const auto what = io::blocked_by(world, poses, i, X_WB)) {
      return "robot " + world.robots[i].name + " cannot be put there: " + *what;
    }
    if (!io::is_valid_pose(X_WB)) {
      return "robot " + world.robots[i].name + " cannot be put there: a pose takes finite numbers";
    }
  }
  for (const auto& [robot, X_WB] : places) {
    RobotParts& parts = robots[static_cast<std::size_t>(robot)];
    physics->set_pose(robot, X_WB);
    parts.last_position = X_WB.position();  // the jump adds no path length
    loads->follow_robots();
    for (const auto& device : parts.devices) device->placed(X_WB);
  }
  invalidate_clearances();
  return std::nullopt;
}

std::optional<std::string> Simulation::place_robots(std::span<const RobotPlace> places) {
  ++interventions_;
  return impl_->place(places);
}

std::optional<std::string> Simulation::Impl::refusal_of_mirrored(std::size_t i) const {
  const RobotDescription& robot = world.robots.at(i);
  if (!robot.real) return std::nullopt;
  return "robot " + robot.name +
         " mirrors a real robot: it is where that one is, and only commands to its motors move it";
}

std::optional<std::string> Simulation::refusal_of_mirrored() const {
  std::optional<std::string> refusal;
  for (std::size_t i = 0; i < impl_->world.robots.size() && !refusal; ++i) {
    refusal = impl_->refusal_of_mirrored(i);
  }
  return refusal;
}

std::optional<std::string> Simulation::follow_real(int robot, const Pose& X_WB) {
  ++interventions_;
  const auto i = static_cast<std::size_t>(robot);
  const RobotDescription& description = impl_->world.robots.at(i);
  if (!description.real) return "robot " + description.name + " mirrors no real robot";
  if (!io::is_valid_pose(X_WB)) return "a pose takes finite numbers";
  if (robot_dynamics(robot)) {
    impl_->physics->set_suspended(robot, true);
    impl_->robots[i].last_position = X_WB.position();
  }
  impl_->physics->set_pose(robot, X_WB);
  impl_->loads->follow_robots();
  for (const auto& device : impl_->robots[i].devices) device->placed(X_WB);
  impl_->invalidate_clearances();
  return std::nullopt;
}

std::optional<std::string> Simulation::set_object_dynamics(const std::string& name, bool on) {
  ++interventions_;
  if (const auto robot = find_robot(name)) return set_robot_dynamics(*robot, on);
  const std::optional<int> obstacle = impl_->find_obstacle(name);
  if (obstacle && is_movable(impl_->obstacle(*obstacle))) {
    impl_->physics->set_suspended(impl_->physics->body_of_obstacle(*obstacle), !on);
    return std::nullopt;
  }
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  return object->kind + " \"" + name + "\" has no dynamics: it stands fast and moves for nobody" +
         (object->dynamic ? ", though it can be extended and retracted" : "");
}

std::vector<SceneObject> Simulation::scene_objects() const {
  const ArenaDescription& arena = impl_->world.arena;
  std::vector<SceneObject> objects;
  const auto add_box = [&objects](const ObstacleDescription& o, const char* kind) {
    objects.push_back({o.name,
                       kind,
                       {o.center.x(), o.center.y(), o.yaw_rad},
                       o.size,
                       o.type == ObstacleType::kDynamic,
                       o.state == ObstacleState::kExtended});
  };
  for (int i = 0; i < robot_count(); ++i) {
    Eigen::AlignedBox2d box;
    for (const Vec2& v : model(i).footprint) box.extend(v);
    objects.push_back({impl_->world.robots[static_cast<std::size_t>(i)].name, "robot", body(i).X_WB,
                       box.sizes(), true});
  }
  for (const ObstacleDescription& o : arena.obstacles) add_box(o, "block");
  for (const ObstacleDescription& o : arena.dock_separators) add_box(o, "separator");
  if (arena.border) {
    const Vec2 middle = arena.origin + 0.5 * arena.size;
    objects.push_back({"border", "border", {middle.x(), middle.y(), 0.0}, arena.size});
  }
  Eigen::AlignedBox2d walls;
  for (const WallLoop& loop : arena.walls) {
    for (const Vec2& v : loop.vertices) walls.extend(v);
  }
  if (!walls.isEmpty()) {
    const Vec2 middle = walls.center();
    objects.push_back({"wall", "wall", {middle.x(), middle.y(), 0.0}, walls.sizes()});
  }
  return objects;
}

std::optional<SceneObject> Simulation::find_object(const std::string& name) const {
  std::vector<SceneObject> objects = scene_objects();
  const auto it = std::find_if(objects.begin(), objects.end(), [&](const SceneObject& object) {
    return is_named(object.name, name);
  });
  if (it == objects.end()) return std::nullopt;
  return std::move(*it);
}

std::string Simulation::no_such_object(const std::string& name) const {
  const std::vector<SceneObject> objects = scene_objects();
  std::string known;
  for (std::size_t i = 0; i < std::min(objects.size(), kMostNames); ++i) {
    known += (i == 0 ? "" : ", ") + objects[i].name;
  }
  if (objects.size() > kMostNames) {
    known += " and " + std::to_string(objects.size() - kMostNames) + " more";
  }
  return "there is no robot or obstacle named \"" + name +
         "\"; this world has: " + (known.empty() ? "nothing" : known);
}

std::optional<std::string> Simulation::place_object(const std::string& name, const Pose& pose) {
  ++interventions_;
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  if (object->kind == "robot") {
    const auto robot = static_cast<std::size_t>(*find_robot(name));
    Motion* motion = impl_->robots[robot].motion;
    const Twist told = motion == nullptr ? Twist{} : motion->commanded();
    if (auto refusal = impl_->place(robot, pose)) return refusal;
    if (motion != nullptr && told != Twist{}) {
      static_cast<void>(motion->apply(TwistCommand{told}));
    }
    return std::nullopt;
  }
  if (object->kind != "block") return object->kind + " \"" + name + "\" stands fast";
  return impl_->place_block(name, pose);
}

std::optional<std::string> Simulation::Impl::place_block(const std::string& name,
                                                         const Pose& pose) {
  return change_block(name, [&](ObstacleDescription& block) {
    block.center = pose.position();
    block.yaw_rad = pose.yaw_rad;
  });
}

std::optional<std::string> Simulation::set_block_size(const std::string& name, const Vec2& size_m,
                                                      double height_m) {
  ++interventions_;
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  if (object->kind != "block") return object->kind + " \"" + name + "\" keeps its size";
  // The limits of the world's reader; Box2D cannot represent smaller solids.
  if (!(size_m.minCoeff() >= kLeastLength_m && height_m >= kLeastLength_m)) {
    return "the sides and the height of a block are at least 0.001 m";
  }
  const std::optional<int> index = impl_->find_obstacle(name);
  SIM_ASSERT(index.has_value());
  const ObstacleDescription& now = impl_->obstacle(*index);
  if (is_movable(now)) return "block \"" + name + "\" can move: it keeps its size";
  if (now.shape == ObstacleShape::kCircle && size_m.x() != size_m.y()) {
    return "block \"" + name + "\" is a circle: both sides must be its diameter";
  }
  return impl_->change_block(name, [&](ObstacleDescription& block) {
    resize(block, size_m);
    block.height_m = height_m;
  });
}

template <typename Edit>
std::optional<std::string> Simulation::Impl::change_appearance(const Simulation& simulation,
                                                               const std::string& name,
                                                               const char* refusal, Edit edit) {
  if (const auto robot = simulation.find_robot(name)) {
    edit(world.robots[static_cast<std::size_t>(*robot)]);
    return std::nullopt;
  }
  if (const auto index = find_obstacle(name)) {
    edit(obstacle(*index));
    return std::nullopt;
  }
  const std::optional<SceneObject> object = simulation.find_object(name);
  if (!object) return simulation.no_such_object(name);
  return object->kind + " \"" + name + "\" " + refusal;
}

std::optional<std::string> Simulation::set_object_colour(const std::string& name, Colour colour) {
  ++interventions_;
  return impl_->change_appearance(*this, name, "keeps its colour",
                                  [&](auto& object) { object.colour = colour; });
}

std::optional<std::string> Simulation::set_object_fiducial(const std::string& name, int fiducial) {
  ++interventions_;
  if (fiducial < 0) return "the number of a fiducial is at least 0";
  return impl_->change_appearance(*this, name, "bears no fiducial",
                                  [&](auto& object) { object.fiducial = fiducial; });
}

}  // namespace sim
