// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/surface.h"

#include <algorithm>

#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace playpen::grade {
namespace {

constexpr double kTouches_m = 0.02;

void add_sides(const sim::Polygon& outline, double bottom_m, double top_m,
               std::vector<SolidSide>& sides) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sides.push_back({outline[i], outline[(i + 1) % outline.size()], bottom_m, top_m});
  }
}

}  // namespace

std::vector<SolidSide> surface_of(const sim::WorldDescription& world, const std::string& partner) {
  constexpr double kRound_m = 0.001;
  std::vector<SolidSide> sides;
  const sim::ArenaDescription& arena = world.arena;
  for (const auto* list : {&arena.obstacles, &arena.dock_separators}) {
    for (const sim::ObstacleDescription& obstacle : *list) {
      if (obstacle.name != partner || obstacle.state == sim::ObstacleState::kRetracted) continue;
      add_sides(outline_of(obstacle, kRound_m), obstacle.bottom_m, standing_height_m(obstacle),
                sides);
    }
  }
  for (const sim::RobotDescription& robot : world.robots) {
    const sim::RobotModel* model = sim::find_robot_model(world, robot.model);
    if (robot.name != partner || model == nullptr || !model->superstructures.empty()) continue;
    for (const sim::Polygon& part : sim::body_parts(*model)) {
      sim::Polygon outline;
      for (const sim::Vec2& p_B : part) outline.push_back(robot.pose * p_B);
      add_sides(outline, 0.0, model->height_m, sides);
    }
  }
  if (!sides.empty()) return sides;
  if (partner == "border" && arena.border) {
    const sim::Vec2 middle = arena.origin + 0.5 * arena.size;
    add_sides(sim::box_corners({middle.x(), middle.y(), 0.0}, arena.size), 0.0,
              arena.border_height_m, sides);
  } else if (partner == "wall") {
    for (const sim::WallLoop& loop : arena.walls) {
      add_sides(loop.vertices, 0.0, loop.height_m, sides);
    }
  }
  return sides;
}

const SolidSide& nearest_side(const std::vector<SolidSide>& sides, const sim::Vec2& place) {
  return *std::ranges::min_element(sides, {}, [&place](const SolidSide& side) {
    return sim::distance_to_segment_m(place, side.a, side.b);
  });
}

bool is_on(const std::vector<SolidSide>& sides, const sim::Vec2& place) {
  const SolidSide& side = nearest_side(sides, place);
  return sim::distance_to_segment_m(place, side.a, side.b) <= kTouches_m;
}

}  // namespace playpen::grade
