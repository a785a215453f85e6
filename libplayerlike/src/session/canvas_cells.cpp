// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/canvas_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace playerlike {
namespace {

// Clamped as in sim::Canvas, so that far positions stay outside of the canvas.
constexpr double kFarCell = 1 << 30;

int cell_number(double cells) {
  return static_cast<int>(std::clamp(std::floor(cells), -kFarCell, kFarCell));
}

}  // namespace

int column_of(const CanvasInfo& canvas, double x_m) {
  return cell_number((x_m - canvas.origin_x_m) / canvas.cell_size_m);
}

int row_of(const CanvasInfo& canvas, double y_m) {
  return canvas.height - 1 - cell_number((y_m - canvas.origin_y_m) / canvas.cell_size_m);
}

PolygonRows::PolygonRows(const CanvasInfo& canvas, std::span<const sim::Vec2> corners)
    : width_(canvas.width), corners_(corners.size()) {
  const auto height = static_cast<double>(canvas.height);
  double top = height;
  double bottom = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners_[i] = {(corners[i].x() - canvas.origin_x_m) / canvas.cell_size_m,
                   height - (corners[i].y() - canvas.origin_y_m) / canvas.cell_size_m};
    top = std::min(top, corners_[i].row);
    bottom = std::max(bottom, corners_[i].row);
  }
  row_ = static_cast<int>(std::clamp(std::floor(top), 0.0, height));
  last_row_ = static_cast<int>(std::clamp(std::floor(bottom), -1.0, height - 1.0));
}

// Scan-line fill at the cells' centres: a cell is filled if an odd number of edges cross its row to
// the left of its centre.
bool PolygonRows::next(std::vector<CellSpan>& spans) {
  if (row_ > last_row_) return false;
  const double middle = row_ + 0.5;
  crossings_.clear();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Corner& a = corners_[i];
    const Corner& b = corners_[i + 1 == corners_.size() ? 0 : i + 1];
    if ((a.row <= middle) == (b.row <= middle)) continue;
    crossings_.push_back(a.column + (b.column - a.column) * ((middle - a.row) / (b.row - a.row)));
  }
  std::sort(crossings_.begin(), crossings_.end());
  for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
    const double first = std::ceil(crossings_[i] - 0.5);
    const double last = std::ceil(crossings_[i + 1] - 0.5) - 1.0;
    const CellSpan span{row_, static_cast<int>(std::clamp(first, 0.0, static_cast<double>(width_))),
                        static_cast<int>(std::clamp(last, -1.0, static_cast<double>(width_ - 1)))};
    if (span.first <= span.last) spans.push_back(span);
  }
  ++row_;
  return true;
}

std::vector<CellSpan> polygon_spans(const CanvasInfo& canvas, std::span<const sim::Vec2> corners) {
  std::vector<CellSpan> spans;
  PolygonRows rows(canvas, corners);
  while (rows.next(spans)) {
  }
  return spans;
}

}  // namespace playerlike
