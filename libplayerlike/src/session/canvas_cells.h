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

/// The cells of a polygon whose centres lie inside of it (even-odd rule), clipped to the canvas,
/// from the top. O(rows * corners).
/// @param corners  finite [m].
[[nodiscard]] std::vector<CellSpan> polygon_spans(const CanvasInfo& canvas,
                                                  std::span<const sim::Vec2> corners);

}  // namespace playerlike
