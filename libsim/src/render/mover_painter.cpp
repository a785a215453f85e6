// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Obstacles that move or can be pushed, and the paths of those that follow one. They are drawn anew
// in each picture.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/controller_painter.h"
#include "render/robot_place.h"
#include "sim/core/math.h"

namespace sim::render {
namespace {

class MoverPainter {
 public:
  MoverPainter(const SceneSnapshot& scene, const Layout& layout, Painter& painter)
      : scene_(scene), layout_(layout), painter_(painter) {}

  void draw_tracks() {
    for (const ObstacleTrack& track : scene_.tracks) {
      const std::vector<Vec2> points = layout_(track.points);
      const bool drawable = std::all_of(points.begin(), points.end(), is_drawable);
      if (points.size() < 2 || !drawable) continue;
      Shape line;
      line.add_line(points, layout_.line_px(1.6), track.closed && points.size() > 2);
      for (const Vec2& point : points) line.add_disc(point, layout_.line_px(3.2, 1.8));
      painter_.fill(line, colour_of(track), 0.3);
    }
  }

  void draw_shadows() {
    Shape all;
    for (const ObstacleDescription& mover : scene_.arena.obstacles) {
      if (!is_movable(mover)) continue;
      const std::vector<Vec2> outline = obstacle_outline(mover, layout_);
      if (is_shown(outline)) all.add_piece(outline);
    }
    for (const double distance : {1.0, 2.2, 3.6, 5.0}) {
      Shape moved;
      moved.append(all, Vec2(0.8, 1.0) * distance * layout_.unit_px);
      painter_.fill(moved, palette::kShadow, 0.075);
    }
  }

  void draw_movers() {
    for (const ObstacleDescription& mover : scene_.arena.obstacles) {
      if (!is_movable(mover)) continue;
      const std::vector<Vec2> outline = obstacle_outline(mover, layout_);
      if (!is_shown(outline)) continue;
      const Colour colour = colour_of(mover);
      const Colour edge = mix(colour, palette::kInk, 0.45);
      Shape body;
      body.add_piece(outline);
      painter_.fill(body, colour);
      Shape marks;
      if (is_pushable(mover)) {
        add_crate(mover, outline, marks);
      } else if (mover.motion->faces_way) {
        add_chevron(mover, marks);
      }
      painter_.fill(marks, edge, 0.7);
      Shape line;
      line.add_line(outline, layout_.line_px(1.6), true);
      painter_.fill(line, edge);
    }
  }

 private:
  [[nodiscard]] static Colour colour_of(const ObstacleDescription& mover) {
    if (mover.colour) return opaque(*mover.colour);
    return mover.motion ? palette::kDriven : palette::kCrate;
  }
  [[nodiscard]] Colour colour_of(const ObstacleTrack& track) const {
    const auto index = static_cast<std::size_t>(track.obstacle);
    return track.obstacle >= 0 && index < scene_.arena.obstacles.size()
               ? colour_of(scene_.arena.obstacles[index])
               : palette::kDriven;
  }

  [[nodiscard]] bool is_shown(const std::vector<Vec2>& outline) const {
    if (outline.size() < 3) return false;
    Vec2 low = outline.front();
    Vec2 high = low;
    for (const Vec2& point : outline) {
      if (!is_drawable(point)) return false;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    const Vec2 rim = Vec2::Constant(10.0 * layout_.unit_px);
    const Rectangle picture{0.0, 0.0, static_cast<double>(layout_.width),
                            static_cast<double>(layout_.height)};
    return rectangle(low - rim, high + rim).overlap(picture) > 0.0;
  }

  // The boards of a crate, or the rim of a drum: this can be pushed.
  void add_crate(const ObstacleDescription& mover, const std::vector<Vec2>& outline,
                 Shape& marks) const {
    const double width_px = layout_.line_px(1.4);
    if (0.5 * mover.size.minCoeff() * layout_.pixels_per_m < 3.0 * width_px) return;
    if (mover.shape == ObstacleShape::kBox) {
      marks.add_line({outline[0], outline[2]}, width_px);
      marks.add_line({outline[1], outline[3]}, width_px);
      return;
    }
    Vec2 middle = Vec2::Zero();
    for (const Vec2& point : outline) middle += point / static_cast<double>(outline.size());
    std::vector<Vec2> inner;
    for (const Vec2& point : outline) inner.emplace_back(middle + 0.6 * (point - middle));
    marks.add_line(inner, width_px, true);
  }

  // An arrowhead along the x axis.
  void add_chevron(const ObstacleDescription& mover, Shape& marks) const {
    const double half_px = 0.25 * mover.size.minCoeff() * layout_.pixels_per_m;
    if (half_px < 2.0) return;
    const Vec2 ahead = half_px * Vec2(math::cos(mover.yaw_rad), -math::sin(mover.yaw_rad));
    const Vec2 aside(ahead.y(), -ahead.x());
    const Vec2 center = layout_(mover.center);
    marks.add_piece({center + ahead, center - 0.8 * ahead + 0.9 * aside, center - 0.3 * ahead});
    marks.add_piece({center + ahead, center - 0.3 * ahead, center - 0.8 * ahead - 0.9 * aside});
  }

  const SceneSnapshot& scene_;
  const Layout& layout_;
  Painter& painter_;
};

bool has_movers(const SceneSnapshot& scene) {
  return std::any_of(scene.arena.obstacles.begin(), scene.arena.obstacles.end(), is_movable);
}

}  // namespace

void draw_tracks(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  MoverPainter(scene, layout, painter).draw_tracks();
}

void draw_mover_shadows(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  if (has_movers(scene)) MoverPainter(scene, layout, painter).draw_shadows();
}

void draw_movers(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  MoverPainter(scene, layout, painter).draw_movers();
}

}  // namespace sim::render
