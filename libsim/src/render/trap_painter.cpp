// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Traps on the floor, and marks of the newest events.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "render/controller_painter.h"
#include "render/robot_place.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"

namespace sim::render {
namespace {

double dash_px(const Layout& layout) { return layout.line_px(6.0, 3.5); }

// Whether a figure reaches into the view.
bool is_in_view(const std::vector<Vec2>& points, const Layout& layout) {
  Vec2 low = points.front();
  Vec2 high = low;
  for (const Vec2& point : points) {
    if (!is_drawable(point)) return false;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Vec2 rim = Vec2::Constant(1.0);
  return rectangle(low - rim, high + rim).overlap(layout.view) > 0.0;
}

// A dashed line, or a full one while a robot is inside.
Shape line_of(const TrapMark& trap, const std::vector<Vec2>& outline, double width_px,
              const Layout& layout) {
  Shape line;
  if (trap.robots.empty()) {
    line.add_dashed_outline(outline, width_px, dash_px(layout));
  } else {
    line.add_line(outline, width_px, true);
  }
  return line;
}

class EventPainter {
 public:
  EventPainter(const SceneSnapshot& scene, const Layout& layout, bool traps, Painter& painter)
      : scene_(scene), layout_(layout), traps_(traps), painter_(painter) {}

  void draw() {
    for (const ArenaEvent& event : scene_.events) {
      const double age = event_age(scene_, event);
      if (age > 1.0) continue;
      switch (event.kind) {
        case ArenaEventKind::kTrap:
        case ArenaEventKind::kEnabled:
          if (traps_) draw_trap(event.what, age);
          break;
        case ArenaEventKind::kExtended:
        case ArenaEventKind::kRetracted:
        case ArenaEventKind::kPlaced:
          draw_object(event.what, palette::kDynamic, age);
          break;
        case ArenaEventKind::kWaiting:
        case ArenaEventKind::kRefused:
        case ArenaEventKind::kBlocked:
        case ArenaEventKind::kPushed:
          draw_object(event.what, palette::kAlert, age);
          break;
        case ArenaEventKind::kRestart:
          draw_object(event.who, palette::kTrap, age);
          break;
        default:
          break;
      }
    }
  }

 private:
  // A line round a figure that fades while it widens.
  void draw_halo(const std::vector<Vec2>& outline, Colour colour, double age) {
    if (!is_in_view(outline, layout_)) return;
    Shape line;
    line.add_line(outline, (3.0 + 11.0 * age) * layout_.unit_px, true);
    painter_.fill(line, colour, 0.6 * (1.0 - age));
  }

  void draw_trap(const std::string& name, double age) {
    for (const TrapMark& trap : scene_.traps) {
      if (trap.name != name) continue;
      const std::vector<Vec2> outline = trap_outline(trap, layout_);
      if (outline.empty()) return;
      Shape area;
      area.add_piece(outline);
      painter_.fill(area, palette::kTrap, 0.22 * (1.0 - age));
      return draw_halo(outline, palette::kTrap, age);
    }
  }

  // Marks the obstacle or the robot of that name.
  void draw_object(const std::string& name, Colour colour, double age) {
    for (const ObstacleDescription& obstacle : scene_.arena.obstacles) {
      if (obstacle.name == name) return draw_halo(obstacle_outline(obstacle, layout_), colour, age);
    }
    for (const RobotSnapshot& robot : scene_.robots) {
      if (robot.name != name || !has_place(robot, layout_)) continue;
      const double radius_px =
          marked_radius_px(robot, layout_) + (4.0 + 12.0 * age) * layout_.unit_px;
      colour.a = static_cast<std::uint8_t>(std::lround(255.0 * 0.8 * (1.0 - age)));
      painter_.fill_ring(layout_(robot.X_WB.position()), radius_px, layout_.line_px(3.0, 1.5),
                         colour);
    }
  }

  const SceneSnapshot& scene_;
  const Layout& layout_;
  bool traps_;  // whether traps are drawn
  Painter& painter_;
};

}  // namespace

std::vector<Vec2> trap_outline(const TrapMark& trap, const Layout& layout) {
  std::vector<Vec2> outline = layout(trap.outline);
  if (outline.empty()) {
    const Vec2 center = layout(trap.center);
    const double radius_px = trap.radius_m * layout.pixels_per_m;
    if (!is_drawable(center) || !(radius_px > 0.0) || !is_drawable({radius_px, 0.0})) return {};
    // add_dashed_outline() draws one dash over each corner of a polygon with such sides.
    const double corners =
        std::clamp(std::round(std::numbers::pi * radius_px / dash_px(layout)), 16.0, 720.0);
    for (int i = 0; i < static_cast<int>(corners); ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / corners;
      outline.push_back(center + radius_px * unit_vector(angle_rad));
    }
  }
  if (outline.size() < 3 || !is_in_view(outline, layout)) return {};
  return outline;
}

void draw_traps(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  for (const TrapMark& trap : scene.traps) {
    const std::vector<Vec2> outline = trap_outline(trap, layout);
    if (outline.empty()) continue;
    const bool occupied = trap.enabled && !trap.robots.empty();
    Shape area;
    area.add_piece(outline);
    if (trap.enabled) painter.fill(area, palette::kTrap, occupied ? 0.2 : 0.07);
    painter.fill(line_of(trap, outline, layout.line_px(occupied ? 2.6 : 1.7, 1.0), layout),
                 palette::kTrap,
                 occupied       ? 1.0
                 : trap.enabled ? 0.85
                                : 0.35);
  }
}

void draw_covered_traps(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  for (const TrapMark& trap : scene.traps) {
    if (!trap.enabled) continue;
    const std::vector<Vec2> outline = trap_outline(trap, layout);
    if (outline.empty()) continue;
    painter.fill(line_of(trap, outline, layout.line_px(1.4, 0.9), layout), palette::kTrap, 0.3);
  }
}

double event_age(const SceneSnapshot& scene, const ArenaEvent& event) {
  const double age_s = scene.time_s - to_seconds(event.time_ns);
  return age_s >= 0.0 ? age_s / kShownEventTime_s
                      : 2.0;  // a saved state may be older than the event
}

void draw_events(const SceneSnapshot& scene, const Layout& layout, bool traps, Painter& painter) {
  EventPainter(scene, layout, traps, painter).draw();
}

}  // namespace sim::render
