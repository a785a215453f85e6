// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/canvas/cell_raster.h"
#include "sim/core/colour.h"
#include "sim/world/description.h"

namespace sim {

/// The grid-map raster that robots draw on.
///
/// Cells are square; column 0 is at the left, row 0 at the top of the picture:
/// column = floor((x - origin_x) / cell), row = height - 1 - floor((y - origin_y) / cell).
/// Row-major RGBA, 4 bytes per cell. A new canvas is transparent black (0, 0, 0, 0). Its LayerStack
/// resizes it together with the other layers. Not thread-safe; the owner must serialise access.
class Canvas {
 public:
  /// @pre sides in 1..kMaxCanvasSide cells, cell size > 0 (asserted; check_world reports violations
  ///     to users).
  explicit Canvas(const CanvasDescription& description);

  [[nodiscard]] int width() const noexcept { return cells_.width(); }
  [[nodiscard]] int height() const noexcept { return cells_.height(); }
  [[nodiscard]] double cell_size_m() const noexcept { return cell_size_m_; }
  [[nodiscard]] Vec2 origin() const noexcept { return origin_; }

  /// Column of a W position; may lie outside [0, width). Saturates at +-2^30.
  [[nodiscard]] int column(double x_m) const noexcept;
  /// Row of a W position, counted from the top; may lie outside [0, height).
  [[nodiscard]] int row(double y_m) const noexcept;
  [[nodiscard]] bool contains(int column, int row) const noexcept {
    return cells_.contains(column, row);
  }

  /// Sets one cell; does nothing outside the canvas. A colour with alpha below 255 is blended over
  /// the old one (source-over, Porter and Duff 1984, in integers, so bit-identical on all
  /// machines); 255 replaces it.
  void set_pixel(int column, int row, Colour colour) noexcept { cells_.blend(column, row, colour); }
  /// Colour of a cell; nullopt outside the canvas.
  [[nodiscard]] std::optional<Colour> pixel(int column, int row) const noexcept;
  /// Draws a line by Bresenham's algorithm (IBM Systems Journal 4(1), 1965). Both ends are drawn,
  /// each cell once. Clipping is exact: the cells inside the canvas are those of the unclipped
  /// line. The order of the ends does not matter. Takes any int coordinates; the cost grows with
  /// the cells inside. Where the line is midway between two cells, it takes the one further from
  /// its left end (from its upper end if it is steeper than a diagonal).
  void draw_line(int column0, int row0, int column1, int row1, Colour colour) noexcept;
  /// Sets every cell to this colour without blending.
  void clear(Colour colour = {0, 0, 0, 0}) noexcept;

  /// Cells as RGBA bytes, row-major from the top; width * height * 4 of them.
  [[nodiscard]] const std::vector<std::uint8_t>& data() const noexcept { return cells_.data(); }

  /// Writes or reads size and cells.
  void archive(StateArchive& archive) { cells_.archive(archive); }

 private:
  friend class LayerStack;  // resizes it with the other layers, and reads its marks

  static_assert(sizeof(Colour) == sizeof(CellValue), "a cell is copied as one Colour");

  CellRaster cells_;
  double cell_size_m_;
  Vec2 origin_;
};

}  // namespace sim
