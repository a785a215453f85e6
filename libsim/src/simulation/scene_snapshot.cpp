// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/scene_snapshot.h"

#include <algorithm>

#include "simulation/controller.h"
#include "simulation/obstacle_motions.h"
#include "simulation/simulation_impl.h"

namespace sim {

RobotSnapshot Simulation::robot_snapshot(int number) const {
  const auto i = static_cast<std::size_t>(number);
  const RobotParts& robot = impl_->robots[i];
  const BodyState& body = impl_->physics->body(number);
  RobotSnapshot shot;
  shot.name = impl_->world.robots[i].name;
  shot.colour = impl_->world.robots[i].colour;
  shot.X_WB = body.X_WB;
  shot.footprint = robot.model->footprint;
  shot.parts = robot.model->parts;
  for (const Superstructure& part : robot.model->superstructures) {
    shot.superstructures.push_back(part.outline);
  }
  shot.stalled = body.stalled;
  for (const auto& device : robot.devices) device->show(impl_->now_ns, shot);
  return shot;
}

SceneSnapshot Simulation::snapshot(bool with_canvas) const {
  SceneSnapshot scene;
  scene.world_name = impl_->world.name;
  scene.arena = impl_->world.arena;
  scene.canvas_description = impl_->layers.description();
  if (with_canvas) {
    scene.canvas = impl_->layers.composed();
    scene.layers = impl_->layers.layers();
  }
  scene.view_mode = impl_->view_mode;
  scene.time_s = to_seconds(impl_->now_ns);
  for (int i = 0; i < robot_count(); ++i) scene.robots.push_back(robot_snapshot(i));
  scene.moving_blocks = moving_blocks();
  if (impl_->obstacle_motions) impl_->obstacle_motions->show(scene);
  scene.scores = scores();
  scene.verdict = verdict();
  if (impl_->controller) impl_->controller->show(scene);
  const auto& events = arena_events().newest;
  const SimTime first_ns = impl_->now_ns - from_seconds(kShownEventTime_s);
  const auto is_old = [&](const ArenaEvent& event) { return event.time_ns < first_ns; };
  const auto newest = std::find_if(events.rbegin(), events.rend(), is_old);
  scene.events.assign(newest.base(), events.end());
  return scene;
}

}  // namespace sim
