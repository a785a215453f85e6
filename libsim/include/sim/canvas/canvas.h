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
/// Cells are square; column 0 is the left, row 0 the top of the picture:
/// column = floor((x - origin_x) / cell), row = height - 1 - floor((y - origin_y) / cell).
/// Row-major RGBA, 4 bytes a cell. A fresh canvas is transparent black (0, 0, 0, 0).
/// Its size is changed by the LayerStack that it is the base of, with that of the other layers.
/// Not thread-safe: its owner serialises.
class Canvas {
 public:
  /// @pre sides in 1..kMaxCanvasSide cells, cell size > 0 (asserted; check_world reports it to
  /// users).
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

  /// Sets one cell; outside the canvas nothing happens. Alpha below 255 blends over what is there
  /// (source-over, Porter and Duff 1984, in whole numbers, so the same everywhere); 255 replaces.
  void set_pixel(int column, int row, Colour colour) noexcept { cells_.blend(column, row, colour); }
  /// Colour of a cell; nullopt outside.
  [[nodiscard]] std::optional<Colour> pixel(int column, int row) const noexcept;
  /// Line by Bresenham's algorithm (IBM Systems Journal 4(1), 1965), both ends drawn, each cell
  /// once, clipped exactly (the cells inside are those of the unclipped line); the same cells
  /// whichever end is named first. Any int coordinates; cost grows with the cells inside.
  /// A line midway between two cells takes the one further from its left end (its upper end, if
  /// it is steeper than a diagonal).
  void draw_line(int column0, int row0, int column1, int row1, Colour colour) noexcept;
  /// Gives every cell this colour; no blending.
  void clear(Colour colour = {0, 0, 0, 0}) noexcept;

  /// Cells as RGBA bytes, row-major from the top; width * height * 4 of them.
  [[nodiscard]] const std::vector<std::uint8_t>& data() const noexcept { return cells_.data(); }

  /// Writes or reads size and cells.
  void archive(StateArchive& archive) { cells_.archive(archive); }

 private:
  friend class LayerStack;  // resizes it with the other layers, and looks at what has changed

  static_assert(sizeof(Colour) == sizeof(CellValue), "a cell is copied as one Colour");

  CellRaster cells_;
  double cell_size_m_;
  Vec2 origin_;
};

}  // namespace sim
