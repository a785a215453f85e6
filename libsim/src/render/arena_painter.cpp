// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/arena_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/outline.h"

namespace sim::render {
namespace {

// The number at the end of a dock's name, e.g. "7" of "dock7"; without one, the dock's index + 1.
std::string dock_label(const std::string& name, std::size_t index) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const std::string digits = last == std::string::npos ? name : name.substr(last + 1);
  return digits.empty() || digits.size() > 3 ? std::to_string(index + 1) : digits;
}

bool is_retracted(const ObstacleDescription& obstacle) {
  return obstacle.type == ObstacleType::kDynamic && obstacle.state == ObstacleState::kRetracted;
}

// Rising and sinking blocks are drawn by block_painter.cpp, moving obstacles by mover_painter.cpp.
bool is_standing(const ObstacleDescription& obstacle) {
  return !is_retracted(obstacle) && !obstacle.present_height_m && !is_movable(obstacle);
}

// A counter-clockwise outline with each side moved inwards. Sharp corners move by at most twice the
// distance, so that they stay near their places.
std::vector<Vec2> moved_inwards(const std::vector<Vec2>& outline, double distance_m) {
  std::vector<Vec2> inner;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = (outline[i] - outline[(i + n - 1) % n]).normalized();
    const Vec2 after = (outline[(i + 1) % n] - outline[i]).normalized();
    const Vec2 normals = Vec2(-before.y(), before.x()) + Vec2(-after.y(), after.x());
    // The length of `normals` is twice the cosine of half the angle between the sides' normals.
    inner.push_back(outline[i] +
                    normals * (2.0 * distance_m / std::max(normals.squaredNorm(), 1.0)));
  }
  return inner;
}

class GroundPainter {
 public:
  GroundPainter(const ArenaDescription& arena, const Layout& layout, Painter& painter)
      : arena_(arena), layout_(layout), painter_(painter) {}

  void draw_floor() {
    Shape floor;
    floor.add_piece(rectangle_corners(layout_.floor, 0.0));
    painter_.fill(floor, palette::kFloor);
    // Grid lines every half metre, unless that is too dense or too sparse.
    double step_m = 0.5;
    if (step_m * layout_.pixels_per_m < 28.0 * layout_.unit_px) {
      step_m = round_below(100.0 * layout_.unit_px / layout_.pixels_per_m);
    } else if (step_m * layout_.pixels_per_m > 450.0 * layout_.unit_px) {
      step_m = round_below(200.0 * layout_.unit_px / layout_.pixels_per_m);
    }
    const double width_px = layout_.line_px(1.0, 0.7);
    Shape grid;
    // Draw only the visible lines of a large arena.
    const Vec2 begin = layout_.origin.cwiseMax(layout_.view_low);
    const Vec2 end = (layout_.origin + arena_.size).cwiseMin(layout_.view_low + layout_.view_size);
    const auto line = [&](const Vec2& p_WA, const Vec2& p_WB) {
      const Vec2 a = layout_(p_WA);
      const Vec2 b = layout_(p_WB);
      const Vec2 half(0.5 * width_px, 0.5 * width_px);
      grid.add_piece({a.cwiseMin(b) - half,
                      {std::max(a.x(), b.x()) + half.x(), std::min(a.y(), b.y()) - half.y()},
                      a.cwiseMax(b) + half,
                      {std::min(a.x(), b.x()) - half.x(), std::max(a.y(), b.y()) + half.y()}});
    };
    // Counted in whole steps: a sum of steps would drift, and would stop increasing far from zero.
    const auto lines_along = [&](int axis) {
      const double first = std::floor(begin[axis] / step_m) + 1.0;
      const int count = static_cast<int>(std::ceil(end[axis] / step_m) - first);
      for (int i = 0; i < count; ++i) {
        Vec2 from = begin;
        Vec2 to = end;
        from[axis] = to[axis] = (first + i) * step_m;
        line(from, to);
      }
    };
    lines_along(0);
    lines_along(1);
    painter_.fill(grid, palette::kGrid);
  }

  void draw_docks() {
    std::size_t index = 0;
    for (const DockDescription& dock : arena_.docks) {
      const std::vector<Vec2> corners = layout_(box_corners(dock.pose, dock.size));
      Shape area;
      area.add_piece(corners);
      painter_.fill(area, palette::kDock);
      draw_dock_corners(corners);
      const Vec2 center = layout_(dock.pose.position());
      const double side_px = dock.size.minCoeff() * layout_.pixels_per_m;
      draw_bolt(center, 0.3 * side_px);
      draw_dock_number(dock_label(dock.name, index++), dock, side_px);
    }
  }

 private:
  // Corner marks of a parking place.
  void draw_dock_corners(const std::vector<Vec2>& corners) {
    Shape marks;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2& corner = corners[i];
      const Vec2 to_next = (corners[(i + 1) % 4] - corner) * 0.18;
      const Vec2 to_last = (corners[(i + 3) % 4] - corner) * 0.18;
      marks.add_line({corner + to_next, corner, corner + to_last}, layout_.line_px(2.0));
    }
    painter_.fill(marks, palette::kDockInk);
  }

  // A lightning bolt, the symbol of charging, always upright.
  void draw_bolt(const Vec2& center, double half_height_px) {
    const double h = half_height_px;
    Shape bolt;
    bolt.add_outline({center + h * Vec2(0.22, -1.0), center + h * Vec2(-0.52, 0.16),
                      center + h * Vec2(-0.06, 0.16), center + h * Vec2(-0.22, 1.0),
                      center + h * Vec2(0.52, -0.16), center + h * Vec2(0.06, -0.16)});
    painter_.fill(bolt, palette::kDockInk, 0.75);
  }

  void draw_dock_number(const std::string& label, const DockDescription& dock, double side_px) {
    if (!layout_.text) return;
    TextStyle style;
    style.cap_height_px = std::min(0.15 * side_px, 40.0 * layout_.unit_px);
    style.weight = 0.14;
    style.colour = palette::kDockInk;
    if (style.cap_height_px < 5.0) return;  // would not be legible
    const Vec2 corner = layout_(dock.pose * Vec2(-0.5 * dock.size.x(), -0.5 * dock.size.y()));
    const Vec2 center = layout_(dock.pose.position());
    // In the rear right corner, which a docked robot does not cover.
    const Vec2 middle = corner + (center - corner) * 0.38;
    painter_.draw_text(label,
                       {middle.x() - 0.5 * Painter::text_width_px(label, style),
                        middle.y() + 0.5 * style.cap_height_px},
                       style);
  }

  const ArenaDescription& arena_;
  const Layout& layout_;
  Painter& painter_;
};

class SolidsPainter {
 public:
  SolidsPainter(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& painter)
      : arena_(arena), layout_(layout), painter_(painter) {}

  void draw_retracted() {
    Shape outlines;
    for (const ObstacleDescription& obstacle : arena_.obstacles) {
      if (!is_retracted(obstacle)) continue;
      add_dashes(obstacle, outlines);
    }
    painter_.fill(outlines, palette::kDynamic, 0.6);
  }

  // Borders, separators, blocks and walls. Shadows come first, so that none falls on a neighbour's
  // top.
  void draw_solids() {
    Shape borders;
    Shape separators;
    Shape statics;
    Shape dynamics;
    Shape coloured;  // blocks with their own colour
    Shape walls;
    Shape floor_walls;  // of maps that are not solid
    const double border_px = layout_.border_px;
    if (arena_.border) {
      borders.add_outline(rectangle_corners(layout_.floor, border_px));
      std::vector<Vec2> inner = rectangle_corners(layout_.floor, 0.0);
      std::reverse(inner.begin(), inner.end());
      borders.add_outline(inner);
    }
    for (const ObstacleDescription& box : arena_.dock_separators) {
      separators.add_piece(layout_(box_corners(box)));
    }
    for (const ObstacleDescription& box : arena_.obstacles) {
      if (!is_standing(box) || !box.solid) continue;
      Shape& alike = box.colour                           ? coloured
                     : box.type == ObstacleType::kDynamic ? dynamics
                                                          : statics;
      alike.add_piece(outline_px(box));
    }
    for (const WallLoop& loop : arena_.walls) {
      (loop.solid ? walls : floor_walls).add_outline(layout_(loop.vertices));
    }

    // What robots drive through is drawn like a marking: beneath everything else, without a shadow.
    painter_.fill(floor_walls, palette::kWall);
    draw_blocks(false);
    draw_shadows({&separators, &statics, &dynamics, &coloured, &walls});
    if (arena_.border) {
      draw_border_shade();
    } else {
      outline(rectangle_corners(layout_.floor, 0.0), palette::kFaintInk, layout_.line_px(1.2), 0.6);
    }
    painter_.fill(walls, palette::kWall);
    for (const WallLoop& loop : arena_.walls) {
      outline(layout_(loop.vertices), palette::kWallEdge, layout_.line_px(1.0, 0.7));
    }
    painter_.fill(borders, palette::kBorder);
    if (arena_.border) {
      outline(rectangle_corners(layout_.floor, border_px), palette::kBorderEdge,
              layout_.line_px(1.2));
      outline(rectangle_corners(layout_.floor, 0.0), palette::kBorderEdge, layout_.line_px(1.2));
    }
    painter_.fill(separators, palette::kBorder);
    for (const ObstacleDescription& box : arena_.dock_separators) {
      outline(layout_(box_corners(box)), palette::kBorderEdge, layout_.line_px(1.2));
    }
    painter_.fill(statics, palette::kStatic);
    painter_.fill(dynamics, palette::kDynamic);
    draw_blocks(true);
  }

 private:
  // The edges of blocks, and those blocks that are not filled with the others of their type.
  void draw_blocks(bool solid) {
    for (const ObstacleDescription& box : arena_.obstacles) {
      if (!is_standing(box) || box.solid != solid) continue;
      const bool dynamic = box.type == ObstacleType::kDynamic;
      const Colour of_type = dynamic ? palette::kDynamic : palette::kStatic;
      if (box.colour || !solid) {
        const Colour colour = box.colour ? opaque(*box.colour) : of_type;
        Shape block;
        block.add_piece(outline_px(box));
        painter_.fill(block, colour);
        draw_block_edge(box, mix(colour, palette::kInk, 0.4));
        continue;
      }
      draw_block_edge(box, dynamic ? palette::kDynamicEdge : palette::kStaticEdge);
    }
  }

  // Adds the dashed outline of a retracted block.
  void add_dashes(const ObstacleDescription& obstacle, Shape& into) {
    const double width_px = layout_.line_px(1.6);
    const double dash_px = layout_.line_px(5.0, 3.0);
    if (obstacle.shape != ObstacleShape::kCircle) {
      into.add_dashed_outline(outline_px(obstacle), width_px, dash_px);
      return;
    }
    // As many dashes as gaps.
    const double turn_rad = 2.0 * std::numbers::pi;
    const double length_px = turn_rad * radius_m(obstacle) * layout_.pixels_per_m;
    const int dashes = static_cast<int>(std::clamp(length_px / (2.0 * dash_px), 6.0, 2000.0));
    constexpr int kPieces = 4;  // of a dash
    for (int dash = 0; dash < dashes; ++dash) {
      std::vector<Vec2> arc;
      for (int i = 0; i <= kPieces; ++i) {
        const double angle_rad = turn_rad / dashes * (dash + 0.5 * i / kPieces);
        arc.push_back(obstacle.center + radius_m(obstacle) * unit_vector(angle_rad));
      }
      into.add_line(layout_(arc), width_px);
    }
  }

  // An edge line inside the block's outline, so that adjacent blocks do not overlap.
  void draw_block_edge(const ObstacleDescription& box, Colour colour) {
    const double width_px = layout_.line_px(1.6);
    const double inset_m = width_px / layout_.pixels_per_m;
    if (box.size.minCoeff() <= 2.0 * inset_m) return;
    if (box.shape == ObstacleShape::kPolygon) {
      outline(layout_(moved_inwards(corners_of(box), 0.5 * inset_m)), colour, width_px);
      return;
    }
    ObstacleDescription inner = box;
    inner.size -= Vec2(inset_m, inset_m);
    outline(outline_px(inner), colour, width_px);
  }

  // The outline of an obstacle in pixels; a circle has vertices so close that it looks round.
  [[nodiscard]] std::vector<Vec2> outline_px(const ObstacleDescription& obstacle) const {
    constexpr double kTolerance_px = 0.05;
    return layout_(outline_of(obstacle, kTolerance_px / layout_.pixels_per_m));
  }

  void outline(const std::vector<Vec2>& points, Colour colour, double width_px,
               double opacity = 1.0) {
    Shape line;
    line.add_line(points, width_px, true);
    painter_.fill(line, colour, opacity);
  }

  // Soft shadows to the lower right: several copies, each fainter and farther away.
  void draw_shadows(const std::vector<const Shape*>& solids) {
    Shape all;
    for (const Shape* solid : solids) all.append(*solid, Vec2::Zero());
    for (const double distance : {1.0, 2.2, 3.6, 5.0}) {
      Shape moved;
      moved.append(all, Vec2(0.8, 1.0) * distance * layout_.unit_px);
      painter_.fill(moved, palette::kShadow, 0.075);
    }
  }

  // The shadow of the border on the floor along its upper and left side.
  void draw_border_shade() {
    const Rectangle& floor = layout_.floor;
    for (const double depth : {1.5, 3.0, 5.0}) {
      const double d = depth * layout_.unit_px;
      Shape shade;
      shade.add_piece({{floor.left, floor.top},
                       {floor.right, floor.top},
                       {floor.right, floor.top + d},
                       {floor.left + 0.8 * d, floor.top + d},
                       {floor.left + 0.8 * d, floor.bottom},
                       {floor.left, floor.bottom}});
      painter_.fill(shade, palette::kShadow, 0.06);
    }
  }

  const ArenaDescription& arena_;
  const Layout& layout_;
  Overlay::Canvas& painter_;
};

}  // namespace

void draw_ground(const ArenaDescription& arena, const Layout& layout, Painter& painter) {
  GroundPainter ground(arena, layout, painter);
  ground.draw_floor();
  ground.draw_docks();
}

void draw_retracted(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& overlay) {
  SolidsPainter(arena, layout, overlay).draw_retracted();
}

void draw_solids(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& overlay) {
  SolidsPainter(arena, layout, overlay).draw_solids();
}

}  // namespace sim::render
