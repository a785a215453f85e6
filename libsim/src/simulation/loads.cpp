// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "simulation/loads.h"

#include <utility>

#include "io/check_world.h"

namespace sim {

std::optional<std::string> Simulation::Impl::Loads::pick_up(std::size_t robot, int index) {
  ObstacleDescription& thing = impl_.obstacle(index);
  const bool moves = thing.present_height_m.has_value();
  if (!thing.portable || thing.state != ObstacleState::kExtended || thing.carried_by >= 0 ||
      moves) {
    return "obstacle " + thing.name + " cannot be taken: it is " +
           (!thing.portable         ? "not portable"
            : thing.carried_by >= 0 ? "carried already"
            : moves                 ? "moving"
                                    : "retracted");
  }
  thing.carried_by = static_cast<int>(robot);
  const Pose X_WT{thing.center.x(), thing.center.y(), thing.yaw_rad};
  loads_.push_back({robot, index, body_pose(robot).inverse() * X_WT, false});
  impl_.physics->set_extended(index, false);
  update_outlines(robot);
  impl_.invalidate_clearances();
  return std::nullopt;
}

void Simulation::Impl::Loads::carry_at(std::size_t robot, int index, const Pose& X_BT,
                                       bool inside) {
  for (Load& load : loads_) {
    if (load.robot != robot || load.obstacle != index) continue;
    load.X_BT = X_BT;
    load.inside = inside;
  }
  follow_robots();
  update_outlines(robot);
}

std::optional<std::string> Simulation::Impl::Loads::put_down(std::size_t robot, int index) {
  ObstacleDescription& thing = impl_.obstacle(index);
  if (thing.carried_by != static_cast<int>(robot)) {
    return "robot " + impl_.world.robots[robot].name + " does not carry obstacle " + thing.name;
  }
  std::vector<Pose> poses;
  for (int k = 0; k < impl_.physics->robot_count(); ++k)
    poses.push_back(impl_.physics->body(k).X_WB);
  if (const auto what = io::put_down_blocked_by(impl_.world, poses, robot, thing)) {
    return "obstacle " + thing.name + " cannot be put down: " + *what;
  }
  detach(index);
  impl_.physics->change_obstacle(index, thing);
  impl_.invalidate_clearances();
  return std::nullopt;
}

void Simulation::Impl::Loads::detach(int index) {
  const auto robot = static_cast<std::size_t>(std::exchange(impl_.obstacle(index).carried_by, -1));
  std::erase_if(loads_, [&](const Load& load) { return load.obstacle == index; });
  impl_.physics->set_extended(index, true);
  update_outlines(robot);
}

void Simulation::Impl::Loads::update_outlines(std::size_t robot) {
  std::vector<PhysicsWorld::Load> seen;
  for (const Load& load : loads_) {
    if (load.robot != robot || load.inside) continue;
    seen.push_back({load.obstacle, impl_.obstacle(load.obstacle)});
    seen.back().solid_B.center = load.X_BT.position();
    seen.back().solid_B.yaw_rad = load.X_BT.yaw_rad;
  }
  impl_.physics->set_load(static_cast<int>(robot), seen);
}

void Simulation::Impl::Loads::follow_robots() {
  for (const Load& load : loads_) {
    const Pose X_WT = body_pose(load.robot) * load.X_BT;
    impl_.obstacle(load.obstacle).center = X_WT.position();
    impl_.obstacle(load.obstacle).yaw_rad = normalize_angle(X_WT.yaw_rad);
  }
}

void Simulation::Impl::Loads::archive(StateArchive& archive) {
  archive.list(loads_, [&](Load& load) {
    archive.index(load.robot, impl_.robots.size());
    archive.index(load.obstacle, impl_.world.arena.obstacles.size());
    archive(load.X_BT, load.inside);
    archive.expect(impl_.obstacle(load.obstacle).carried_by == static_cast<int>(load.robot),
                   "loads of those who carry them");
  });
}

}  // namespace sim
