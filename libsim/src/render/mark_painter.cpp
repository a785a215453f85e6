// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Marks of collisions and goals.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "render/robot_painter.h"

namespace sim::render {
namespace {

// Whether the centre of a mark is in the picture.
bool is_marked(const Vec2& center, const Layout& layout) {
  return is_drawable(center) &&
         (!layout.view_only || (center.x() > layout.view.left && center.x() < layout.view.right &&
                                center.y() > layout.view.top && center.y() < layout.view.bottom));
}

void fill_disc(Painter& painter, const Vec2& center, double radius_px, Colour colour) {
  Shape disc;
  disc.add_disc(center, radius_px);
  painter.fill(disc, colour);
}

}  // namespace

// Draws a red cross with a light rim. Repeated collisions of a robot at one place get one cross.
void draw_collisions(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  const double arm_px = layout.line_px(6.0, 3.5);
  const double apart_px = 1.5 * arm_px;
  std::vector<Vec2> places;
  for (const CollisionMark& collision : scene.collisions) {
    const Vec2 center = layout(collision.place);
    if (!is_marked(center, layout)) continue;
    const bool is_there = std::any_of(places.begin(), places.end(), [&](const Vec2& place) {
      return (place - center).norm() < apart_px;
    });
    if (!is_there) places.push_back(center);
  }
  const auto crosses = [&](double width_px) {
    Shape shape;
    for (const Vec2& center : places) {
      shape.add_line({center - Vec2(arm_px, arm_px), center + Vec2(arm_px, arm_px)}, width_px);
      shape.add_line({center + Vec2(arm_px, -arm_px), center + Vec2(-arm_px, arm_px)}, width_px);
    }
    return shape;
  };
  painter.fill(crosses(layout.line_px(6.0, 3.6)), palette::kHalo, 0.9);
  painter.fill(crosses(layout.line_px(3.0, 1.8)), palette::kStalled);
}

// Draws a ring in the robot's colour, with a dot in it if the goal was reached. The newest goal of
// a robot has a larger ring than its earlier goals.
void draw_goals(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  for (const GoalMark& goal : scene.goals) {
    const Vec2 center = layout(goal.place);
    if (!is_marked(center, layout)) continue;
    const auto robot = static_cast<std::size_t>(goal.robot);
    if (robot >= scene.robots.size()) continue;
    const double share = goal.newest ? 1.0 : 0.6;
    const Colour colour = mix(opaque(scene.robots[robot].colour), palette::kInk, 0.3);
    const double radius_px = share * layout.line_px(10.0, 5.0);
    const double width_px = share * layout.line_px(3.2, 1.8);
    painter.fill_ring(center, radius_px, width_px + 2.0 * layout.line_px(1.6, 0.9), palette::kHalo);
    painter.fill_ring(center, radius_px, width_px, colour);
    if (goal.newest) {
      Shape hairs;
      for (const Vec2& side : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
        hairs.add_line({center + 0.75 * radius_px * side, center + 1.6 * radius_px * side},
                       0.8 * width_px);
      }
      painter.fill(hairs, colour);
    }
    if (!goal.reached) continue;
    fill_disc(painter, center, 0.52 * radius_px + layout.line_px(1.4, 0.8), palette::kHalo);
    fill_disc(painter, center, 0.52 * radius_px, colour);
  }
}

}  // namespace sim::render
