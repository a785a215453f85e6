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

// Scan-line fill at the cells' centres: a cell is filled if an odd number of edges cross its row to
// the left of its centre.
std::vector<CellSpan> polygon_spans(const CanvasInfo& canvas, std::span<const sim::Vec2> corners) {
  struct Corner {
    double column, row;  // in cells from the top left corner
  };
  std::vector<CellSpan> spans;
  const auto height = static_cast<double>(canvas.height);
  std::vector<Corner> in_cells(corners.size());
  double top = height;
  double bottom = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    in_cells[i] = {(corners[i].x() - canvas.origin_x_m) / canvas.cell_size_m,
                   height - (corners[i].y() - canvas.origin_y_m) / canvas.cell_size_m};
    top = std::min(top, in_cells[i].row);
    bottom = std::max(bottom, in_cells[i].row);
  }
  const int first_row = static_cast<int>(std::clamp(std::floor(top), 0.0, height));
  const int last_row = static_cast<int>(std::clamp(std::floor(bottom), -1.0, height - 1.0));
  std::vector<double> crossings;
  for (int row = first_row; row <= last_row; ++row) {
    const double middle = row + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < in_cells.size(); ++i) {
      const Corner& a = in_cells[i];
      const Corner& b = in_cells[(i + 1) % in_cells.size()];
      if ((a.row <= middle) == (b.row <= middle)) continue;
      crossings.push_back(a.column + (b.column - a.column) * ((middle - a.row) / (b.row - a.row)));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double first = std::ceil(crossings[i] - 0.5);
      const double last = std::ceil(crossings[i + 1] - 0.5) - 1.0;
      const CellSpan span{
          row, static_cast<int>(std::clamp(first, 0.0, static_cast<double>(canvas.width))),
          static_cast<int>(std::clamp(last, -1.0, static_cast<double>(canvas.width - 1)))};
      if (span.first <= span.last) spans.push_back(span);
    }
  }
  return spans;
}

}  // namespace playerlike
