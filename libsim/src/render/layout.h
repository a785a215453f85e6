// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "render/painter.h"
#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/render/palette.h"
#include "sim/render/render.h"
#include "sim/world/description.h"

namespace sim::render {

/// Linear interpolation from a to b; `share` 1 gives b.
[[nodiscard]] Colour mix(Colour a, Colour b, double share);

/// Luma of BT.601, 0..1.
[[nodiscard]] double luma(Colour colour);

[[nodiscard]] inline Colour opaque(Colour colour) { return {colour.r, colour.g, colour.b, 255}; }

/// The largest of ..., 0.1, 0.2, 0.5, 1, 2, 5, 10, ... that is at most `limit` > 0.
[[nodiscard]] double round_below(double limit);

/// `text`, truncated with dots if it is too long; "" if not even that fits.
[[nodiscard]] std::string shortened(const std::string& text, const TextStyle& style,
                                    double width_px);

/// A part of the picture [pixels].
struct Rectangle {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  [[nodiscard]] double overlap(const Rectangle& other) const {
    const double width = std::min(right, other.right) - std::max(left, other.left);
    const double height = std::min(bottom, other.bottom) - std::max(top, other.top);
    return width > 0.0 && height > 0.0 ? width * height : 0.0;
  }
};

/// Positions and sizes in the picture.
struct Layout {
  double unit_px = 1.0;  ///< a thousandth of the longer side; line widths and texts scale with it
  bool text = true;      ///< whether there is room for any text
  int width = 0;         ///< of the picture
  int height = 0;
  double margin_px = 0.0;
  double footer_px = 0.0;  ///< height of the footer below the arena
  double border_px = 0.0;  ///< width of the border around the floor; 0: none
  double pixels_per_m = 1.0;
  Rectangle floor;                ///< floor of the arena; may extend beyond the view
  Rectangle view;                 ///< area of the scene: the floor, or the requested part of it
  bool cropped = false;           ///< whether the view shows a part of the world
  Vec2 view_low = Vec2::Zero();   ///< W position of the view's bottom left corner [m]
  Vec2 view_size = Vec2::Zero();  ///< [m]
  Vec2 origin = Vec2::Zero();     ///< W position of the floor's bottom left corner [m]
  bool view_only = false;         ///< robots beyond the view are not drawn

  /// @param part  part to show; none: the whole arena.
  Layout(const ArenaDescription& arena, const RenderOptions& options,
         const std::optional<ScenePart>& part = {});

  /// Picture position of a point in W.
  [[nodiscard]] Vec2 operator()(const Vec2& p_W) const {
    return {floor.left + (p_W.x() - origin.x()) * pixels_per_m,
            floor.bottom - (p_W.y() - origin.y()) * pixels_per_m};
  }
  [[nodiscard]] std::vector<Vec2> operator()(const std::vector<Vec2>& points_in_world) const;

  /// The pixels of the view that the floor covers completely or partly; at least one.
  [[nodiscard]] PixelRect floor_pixels() const;

  /// A line width proportional to the picture's size, but at least `least_px`.
  [[nodiscard]] double line_px(double thousandths, double least_px = 0.8) const {
    return std::max(thousandths * unit_px, least_px);
  }
  /// A text size proportional to the picture's size, but legible.
  [[nodiscard]] TextStyle text_style(double cap_height, Colour colour) const;
};

/// The corners of a rectangle that is enlarged on all sides, clockwise in the picture.
[[nodiscard]] std::vector<Vec2> rectangle_corners(const Rectangle& rectangle, double grown_px);

}  // namespace sim::render
