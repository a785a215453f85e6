// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/core/pose.h"

/// From metres to cells of the canvas, for all that draw on it.
namespace playerlike {

/// Column of the canvas at x, possibly outside of it. @param x_m  finite [m].
[[nodiscard]] int column_of(const CanvasInfo& canvas, double x_m);
/// Row at y, counted from the top, possibly outside of the canvas. @param y_m  finite [m].
[[nodiscard]] int row_of(const CanvasInfo& canvas, double y_m);

/// Neighbouring cells of a row of the canvas.
struct CellSpan {
  int row = 0;
  int first = 0;  ///< column
  int last = 0;   ///< column, >= first
};

/// Finds the cells of a polygon whose centres lie inside of it (even-odd rule), clipped to the
/// canvas, row by row from the top. A row takes time in proportion to the number of corners.
class PolygonRows {
 public:
  /// @param corners  finite [m].
  PolygonRows(const CanvasInfo& canvas, std::span<const sim::Vec2> corners);
  /// Appends the cells of the next row. @return false: all rows are done.
  bool next(std::vector<CellSpan>& spans);

 private:
  struct Corner {
    double column, row;  // in cells from the top left corner
  };

  int width_;
  std::vector<Corner> corners_;
  int row_ = 0;  // the next one
  int last_row_ = -1;
  std::vector<double> crossings_;
};

/// All cells of PolygonRows.
[[nodiscard]] std::vector<CellSpan> polygon_spans(const CanvasInfo& canvas,
                                                  std::span<const sim::Vec2> corners);

}  // namespace playerlike
