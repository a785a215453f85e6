// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/canvas.h"

#include <algorithm>
#include <cmath>

#include "sim/core/assert.h"

namespace sim {
namespace {

constexpr int kCoordinateLimit = 1 << 30;

// floor(value), saturated; NaN gives the lower limit.
int saturated_floor(double value) noexcept {
  const double floored = std::floor(value);
  if (!(floored > -kCoordinateLimit)) return -kCoordinateLimit;
  if (floored > kCoordinateLimit) return kCoordinateLimit;
  return static_cast<int>(floored);
}

}  // namespace

Canvas::Canvas(const CanvasDescription& description)
    : cells_(description.width, description.height, CellValue{}),
      cell_size_m_(description.cell_size_m),
      origin_(description.origin) {
  SIM_ASSERT(width() <= kMaxCanvasSide && height() <= kMaxCanvasSide);
  SIM_ASSERT(cell_size_m_ > 0.0);
}

int Canvas::column(double x_m) const noexcept {
  return saturated_floor((x_m - origin_.x()) / cell_size_m_);
}

int Canvas::row(double y_m) const noexcept {
  const int from_bottom = saturated_floor((y_m - origin_.y()) / cell_size_m_);
  return std::clamp(height() - 1 - from_bottom, -kCoordinateLimit, kCoordinateLimit);
}

std::optional<Colour> Canvas::pixel(int column, int row) const noexcept {
  if (!contains(column, row)) return std::nullopt;
  return cells_.at(column, row).colour();
}

void Canvas::draw_line(int column0, int row0, int column1, int row1, Colour colour) noexcept {
  cells_.blend_line(column0, row0, column1, row1, colour);
}

void Canvas::clear(Colour colour) noexcept { cells_.fill(CellValue::of(colour)); }

}  // namespace sim
