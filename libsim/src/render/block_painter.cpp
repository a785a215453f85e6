// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Dynamic blocks that rise, sink, or wait until they can rise.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/controller_painter.h"
#include "render/robot_place.h"
#include "sim/core/math.h"
#include "sim/world/outline.h"

namespace sim::render {
namespace {

// The part of a convex polygon where `normal` * p <= limit.
std::vector<Vec2> cut(const std::vector<Vec2>& polygon, const Vec2& normal, double limit) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double outside_a = normal.dot(a) - limit;
    const double outside_b = normal.dot(b) - limit;
    if (outside_a <= 0.0) kept.push_back(a);
    if ((outside_a < 0.0 && outside_b > 0.0) || (outside_a > 0.0 && outside_b < 0.0)) {
      kept.push_back(a + (b - a) * (outside_a / (outside_a - outside_b)));
    }
  }
  return kept;
}

// Adds dashes along a closed outline, as many as gaps.
void add_dashes(const std::vector<Vec2>& outline, double width_px, double dash_px, Shape& into) {
  constexpr std::size_t kMostCorners = 8;  // an outline with more of them is round
  if (outline.size() <= kMostCorners) return into.add_dashed_outline(outline, width_px, dash_px);
  double length_px = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    length_px += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  }
  const double piece_px =
      length_px / (2.0 * std::clamp(std::round(length_px / (2.0 * dash_px)), 3.0, 2000.0));
  double to_end_px = piece_px;  // of this dash or gap
  bool is_dash = true;
  std::vector<Vec2> line{outline[0]};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Vec2 at = outline[i];
    const Vec2& end = outline[(i + 1) % outline.size()];
    for (double rest_px = (end - at).norm(); rest_px > to_end_px; rest_px = (end - at).norm()) {
      at += (end - at) * (to_end_px / rest_px);
      line.push_back(at);
      if (is_dash) into.add_line(line, width_px);
      is_dash = !is_dash;
      line = {at};
      to_end_px = piece_px;
    }
    to_end_px -= (end - at).norm();
    line.push_back(end);
  }
}

// A block in the picture.
class BlockFigure {
 public:
  BlockFigure(const ObstacleDescription& block, const Layout& layout)
      : outline_(obstacle_outline(block, layout)),
        center_(layout(block.center)),
        half_(0.5 * layout.pixels_per_m * block.size),
        x_axis_(math::cos(block.yaw_rad), -math::sin(block.yaw_rad)),
        y_axis_(-math::sin(block.yaw_rad), -math::cos(block.yaw_rad)) {
    for (const Vec2& corner : outline_) reach_px_ = std::max(reach_px_, (corner - center_).norm());
  }

  [[nodiscard]] const std::vector<Vec2>& outline() const { return outline_; }
  [[nodiscard]] const Vec2& center() const { return center_; }
  [[nodiscard]] double least_half_px() const { return half_.minCoeff(); }

  [[nodiscard]] bool is_drawable_within(const Layout& layout) const {
    if (outline_.size() < 3 || !is_drawable(center_) || !is_drawable({reach_px_, 0.0})) {
      return false;
    }
    const Vec2 reach = Vec2::Constant(reach_px_ + 20.0 * layout.unit_px);
    const Rectangle picture{0.0, 0.0, static_cast<double>(layout.width),
                            static_cast<double>(layout.height)};
    return rectangle(center_ - reach, center_ + reach).overlap(picture) > 0.0;
  }

  // The part of the block that a gauge along its longer side fills: from the left or lower end.
  [[nodiscard]] std::vector<Vec2> filled(double share) const {
    Vec2 along = half_.x() >= half_.y() ? x_axis_ : y_axis_;
    const bool level = std::abs(along.y()) < 0.5 * std::abs(along.x());
    if (level ? along.x() < 0.0 : along.y() > 0.0) along = -along;
    double low = along.dot(outline_.front());
    double high = low;
    for (const Vec2& corner : outline_) {
      low = std::min(low, along.dot(corner));
      high = std::max(high, along.dot(corner));
    }
    return cut(outline_, along, low + share * (high - low));
  }

  // Diagonal stripes within the block.
  [[nodiscard]] Shape stripes(double period_px, double width_px) const {
    constexpr double kMostStripes = 300.0;
    const Vec2 across = (x_axis_ + y_axis_) / std::sqrt(2.0);
    const double period = std::max(period_px, 2.0 * reach_px_ / kMostStripes);
    const double width = width_px * period / period_px;
    const double middle = across.dot(center_);
    Shape shape;
    for (double at = middle - reach_px_; at < middle + reach_px_; at += period) {
      const std::vector<Vec2> stripe = cut(cut(outline_, across, at + width), -across, -at);
      if (stripe.size() >= 3) shape.add_piece(stripe);
    }
    return shape;
  }

 private:
  std::vector<Vec2> outline_;
  Vec2 center_;
  Vec2 half_;    // of its size
  Vec2 x_axis_;  // unit vectors
  Vec2 y_axis_;
  double reach_px_ = 0.0;  // from the centre to the farthest corner
};

class BlockPainter {
 public:
  BlockPainter(const SceneSnapshot& scene, const Layout& layout, Painter& painter)
      : scene_(scene), layout_(layout), painter_(painter) {}

  void draw_shadows() {
    for (const MovingBlock& moving : scene_.moving_blocks) {
      if (!is_shown(moving) || moving.phase == BlockPhase::kRetracted) continue;
      const BlockFigure figure(block(moving), layout_);
      if (!figure.is_drawable_within(layout_)) continue;
      Shape body;
      body.add_piece(figure.outline());
      for (const double distance : {1.0, 2.2, 3.6, 5.0}) {
        Shape moved;
        moved.append(body, Vec2(0.8, 1.0) * distance * share(moving) * layout_.unit_px);
        painter_.fill(moved, palette::kShadow, 0.075);
      }
    }
  }

  void draw_blocks() {
    for (const MovingBlock& moving : scene_.moving_blocks) {
      if (!is_shown(moving)) continue;
      const BlockFigure figure(block(moving), layout_);
      if (!figure.is_drawable_within(layout_)) continue;
      if (moving.phase == BlockPhase::kRetracted) {
        draw_waiting(figure);
      } else {
        draw_moving(moving, figure);
      }
    }
  }

 private:
  [[nodiscard]] bool is_shown(const MovingBlock& moving) const {
    return moving.obstacle >= 0 &&
           static_cast<std::size_t>(moving.obstacle) < scene_.arena.obstacles.size();
  }
  [[nodiscard]] const ObstacleDescription& block(const MovingBlock& moving) const {
    return scene_.arena.obstacles[static_cast<std::size_t>(moving.obstacle)];
  }
  // The share of its height to which a block has risen.
  [[nodiscard]] double share(const MovingBlock& moving) const {
    const double height_m = block(moving).height_m;
    return height_m > 0.0 ? std::clamp(moving.height_m / height_m, 0.0, 1.0) : 1.0;
  }

  // Pale stripes, and the block's colour as far as the gauge says.
  void draw_moving(const MovingBlock& moving, const BlockFigure& figure) {
    const ObstacleDescription& box = block(moving);
    const Colour colour = box.colour ? opaque(*box.colour) : palette::kDynamic;
    const Colour edge = box.colour ? mix(colour, palette::kInk, 0.4) : palette::kDynamicEdge;
    Shape base;
    base.add_piece(figure.outline());
    painter_.fill(base, mix(palette::kFloor, colour, 0.16));
    painter_.fill(figure.stripes(11.0 * layout_.unit_px, 4.0 * layout_.unit_px), colour, 0.34);
    const std::vector<Vec2> filled = figure.filled(share(moving));
    if (filled.size() >= 3) {
      Shape gauge;
      gauge.add_piece(filled);
      painter_.fill(gauge, colour);
    }
    Shape line;
    line.add_line(figure.outline(), layout_.line_px(1.6), true);
    painter_.fill(line, edge);
    draw_arrow(figure, moving.phase == BlockPhase::kRising, edge);
  }

  // An arrow up or down on a light disc, upright in the picture.
  void draw_arrow(const BlockFigure& figure, bool up, Colour colour) {
    const double radius_px = disc_radius_px(figure);
    if (radius_px < 3.0) return;
    const Vec2& c = figure.center();
    fill_disc(c, radius_px, palette::kLight);
    painter_.fill_ring(c, radius_px, layout_.line_px(1.2), colour);
    const double y = (up ? 1.0 : -1.0) * radius_px;
    const double x = radius_px;
    Shape arrow;
    arrow.add_outline({c + Vec2(0.0, -0.62 * y), c + Vec2(0.52 * x, -0.02 * y),
                       c + Vec2(0.19 * x, -0.02 * y), c + Vec2(0.19 * x, 0.58 * y),
                       c + Vec2(-0.19 * x, 0.58 * y), c + Vec2(-0.19 * x, -0.02 * y),
                       c + Vec2(-0.52 * x, -0.02 * y)});
    painter_.fill(arrow, colour);
  }

  // A bold dashed outline with an hourglass. The area stays clear: a robot stands there.
  void draw_waiting(const BlockFigure& figure) {
    painter_.fill(figure.stripes(11.0 * layout_.unit_px, 3.0 * layout_.unit_px), palette::kAlert,
                  0.18);
    Shape dashes;
    add_dashes(figure.outline(), layout_.line_px(2.8, 1.4), layout_.line_px(6.5, 3.5), dashes);
    painter_.fill(dashes, palette::kAlert);
    const double radius_px = disc_radius_px(figure);
    if (radius_px < 3.0) return;
    // In the lower right corner: the robot in the way is in the middle, and its name above it.
    Vec2 corner = figure.center();
    for (const Vec2& p : figure.outline()) {
      if (p.sum() > corner.sum()) corner = p;
    }
    fill_disc(corner, radius_px, palette::kLight);
    painter_.fill_ring(corner, radius_px, layout_.line_px(1.4, 1.0), palette::kAlert);
    const double r = 0.56 * radius_px;
    Shape glass;
    glass.add_piece({corner + Vec2(-0.75 * r, -r), corner + Vec2(0.75 * r, -r), corner});
    glass.add_piece({corner + Vec2(-0.75 * r, r), corner + Vec2(0.75 * r, r), corner});
    painter_.fill(glass, palette::kAlert);
  }

  [[nodiscard]] double disc_radius_px(const BlockFigure& figure) const {
    return std::min(0.62 * figure.least_half_px(), layout_.line_px(11.0, 5.0));
  }

  void fill_disc(const Vec2& center, double radius_px, Colour colour) {
    Shape disc;
    disc.add_disc(center, radius_px);
    painter_.fill(disc, colour);
  }

  const SceneSnapshot& scene_;
  const Layout& layout_;
  Painter& painter_;
};

}  // namespace

std::vector<Vec2> obstacle_outline(const ObstacleDescription& obstacle, const Layout& layout) {
  constexpr double kTolerance_px = 0.05;
  return layout(outline_of(obstacle, kTolerance_px / layout.pixels_per_m));
}

void draw_moving_shadows(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  BlockPainter(scene, layout, painter).draw_shadows();
}

void draw_moving_blocks(const SceneSnapshot& scene, const Layout& layout, Painter& painter) {
  BlockPainter(scene, layout, painter).draw_blocks();
}

}  // namespace sim::render
