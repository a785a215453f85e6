// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/assert.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

/// A solid that reaches into a cell by at most this fraction of its side only touches it: positions
/// in files have few digits, and multiples of 0.02 are not exact in binary.
constexpr double kTouching = 1e-6;

/// An interval of columns, in cells; empty if low > high.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// The columns spanned by the part of the segment ab between two heights.
Span span_between(const Vec2& a, const Vec2& b, double bottom, double top) {
  const Vec2& lower = a.y() <= b.y() ? a : b;
  const Vec2& upper = a.y() <= b.y() ? b : a;
  if (upper.y() < bottom || lower.y() > top) return {};
  const double rise = upper.y() - lower.y();
  const auto x_at = [&](double y) {
    return lower.x() + (y - lower.y()) / rise * (upper.x() - lower.x());
  };
  const double x0 = lower.y() >= bottom ? lower.x() : x_at(bottom);
  const double x1 = upper.y() <= top ? upper.x() : x_at(top);
  return {std::min(x0, x1), std::max(x0, x1)};
}

/// Fills cells of a map. Uses cells as units, relative to the grid's bottom left corner; rows count
/// from the bottom here.
class Painter {
 public:
  explicit Painter(OccupancyMap& map) : map_(map) {}

  [[nodiscard]] Vec2 in_cells(const Vec2& p_W) const {
    return (p_W - map_.origin) / map_.cell_size_m;
  }

  /// Fills the cells that a convex polygon reaches into. Its part between the lower and the upper
  /// side of a row of cells is convex, so it reaches into exactly the cells whose columns it spans.
  void add_convex(const Polygon& outline) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec2& p : outline) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
    const auto [first, last] = rows_between(low, high);
    for (int row = first; row <= last; ++row) {
      Span span;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Span piece = span_in_row(outline[i], outline[(i + 1) % outline.size()], row);
        span = {std::min(span.low, piece.low), std::max(span.high, piece.high)};
      }
      fill(row, span);
    }
  }

  /// Fills the cells that a circle reaches into. Within a row of cells, the circle is as wide as at
  /// the height that is nearest to its centre.
  void add_circle(const Vec2& center, double radius) {
    const auto [first, last] = rows_between(center.y() - radius, center.y() + radius);
    for (int row = first; row <= last; ++row) {
      const double aside =
          std::clamp(center.y(), row + kTouching, row + 1 - kTouching) - center.y();
      if (std::abs(aside) >= radius) continue;
      const double half = std::sqrt((radius - aside) * (radius + aside));
      fill(row, {center.x() - half, center.x() + half});
    }
  }

  /// Fills the cells that the solid within the loops reaches into. A cell with an edge in it is
  /// filled, because an edge has the solid on its left. All other cells are completely solid or
  /// completely free, and are filled if their centre is solid.
  void add_walls(const std::vector<WallLoop>& walls) {
    /// Intersection of an edge with the horizontal line through the centres of a row's cells.
    struct Crossing {
      double x;
      int winding;  ///< +1: the loop's solid begins on its right, -1: it ends there
    };
    std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(map_.height));
    for (const WallLoop& loop : walls) {
      for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
        const Vec2 a = in_cells(loop.vertices[i]);
        const Vec2 b = in_cells(loop.vertices[(i + 1) % loop.vertices.size()]);
        const auto [first, last] = rows_between(std::min(a.y(), b.y()), std::max(a.y(), b.y()));
        for (int row = first; row <= last; ++row) {
          fill(row, span_in_row(a, b, row));
          const double middle = row + 0.5;
          if ((a.y() > middle) == (b.y() > middle)) continue;
          const double x = a.x() + (middle - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
          crossings[static_cast<std::size_t>(row)].push_back({x, b.y() < a.y() ? 1 : -1});
        }
      }
    }
    for (int row = 0; row < map_.height; ++row) {
      std::vector<Crossing>& in_row = crossings[static_cast<std::size_t>(row)];
      std::sort(in_row.begin(), in_row.end(),
                [](const Crossing& p, const Crossing& q) { return p.x < q.x; });
      int winding = 0;
      for (std::size_t i = 0; i + 1 < in_row.size(); ++i) {
        winding += in_row[i].winding;
        if (winding <= 0) continue;
        // Cells whose centres lie between the two crossings.
        fill_columns(row, std::ceil(in_row[i].x - 0.5), std::floor(in_row[i + 1].x - 0.5));
      }
    }
  }

  /// Fills the cells that reach beyond the floor, where the border stands.
  void add_border(const Vec2& low, const Vec2& high) {
    for (int row = 0; row < map_.height; ++row) {
      const bool beyond = row < low.y() - kTouching || row + 1 > high.y() + kTouching;
      if (beyond) {
        fill_columns(row, 0.0, map_.width);
      } else {
        fill_columns(row, 0.0, std::ceil(low.x() - kTouching) - 1.0);
        fill_columns(row, std::floor(high.x() + kTouching), map_.width);
      }
    }
  }

 private:
  /// The rows that a shape between these heights may reach into; none if first > last.
  [[nodiscard]] std::pair<int, int> rows_between(double low, double high) const {
    const double limit = map_.height;
    return {static_cast<int>(std::clamp(std::floor(low), 0.0, limit)),
            static_cast<int>(std::clamp(std::floor(high), -1.0, limit - 1.0))};
  }

  /// The part of an edge within a row, without parts that only touch the row.
  static Span span_in_row(const Vec2& a, const Vec2& b, int row) {
    return span_between(a, b, row + kTouching, row + 1 - kTouching);
  }

  /// Fills the cells that a span reaches into.
  void fill(int row, const Span& span) {
    if (span.low > span.high) return;
    fill_columns(row, std::floor(span.low + kTouching), std::ceil(span.high - kTouching) - 1.0);
  }

  /// Fills the cells of a row from the first to the last column, inclusive.
  void fill_columns(int row, double first, double last) {
    const auto from = static_cast<int>(std::clamp(first, 0.0, static_cast<double>(map_.width)));
    const auto to = static_cast<int>(std::clamp(last, -1.0, map_.width - 1.0));
    float* const cells =
        map_.cells.data() + static_cast<std::ptrdiff_t>(map_.height - 1 - row) * map_.width;
    for (int column = from; column <= to; ++column) cells[column] = 1.0F;
  }

  OccupancyMap& map_;
};

Polygon box_outline(const ObstacleDescription& box) {
  const Pose X_WO{box.center.x(), box.center.y(), box.yaw_rad};
  const Vec2 half = 0.5 * box.size;
  return {X_WO * Vec2(-half.x(), -half.y()), X_WO * Vec2(half.x(), -half.y()),
          X_WO * Vec2(half.x(), half.y()), X_WO * Vec2(-half.x(), half.y())};
}

}  // namespace

std::optional<CanvasDescription> floor_grid(const ArenaDescription& arena, double cell_size_m) {
  // The tolerance keeps rounding from adding a cell to a side that is a whole number of cells long.
  const Vec2 cells = ((arena.size / cell_size_m).array() - kTouching).ceil().max(1.0);
  if (!(cell_size_m > 0.0) || !(cells.maxCoeff() <= kMaxCanvasSide)) return std::nullopt;
  CanvasDescription grid;
  grid.width = static_cast<int>(cells.x());
  grid.height = static_cast<int>(cells.y());
  grid.cell_size_m = cell_size_m;
  grid.origin = arena.origin;
  return grid;
}

OccupancyMap true_map(const ArenaDescription& arena, const CanvasDescription& grid) {
  SIM_ASSERT(grid.width >= 1 && grid.height >= 1 && grid.cell_size_m > 0.0);
  OccupancyMap map{grid.width, grid.height, grid.cell_size_m, grid.origin, {}};
  map.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                   0.0F);
  Painter painter(map);
  const auto add_solid = [&painter, &grid](const ObstacleDescription& solid) {
    if (solid.shape == ObstacleShape::kCircle) {
      painter.add_circle(painter.in_cells(solid.center), radius_m(solid) / grid.cell_size_m);
      return;
    }
    if (solid.shape == ObstacleShape::kPolygon) {
      painter.add_walls({{corners_of(solid)}});
      return;
    }
    Polygon outline = box_outline(solid);
    for (Vec2& p : outline) p = painter.in_cells(p);
    painter.add_convex(outline);
  };
  for (const ObstacleDescription& obstacle : arena.obstacles) {
    if (!obstacle.solid) continue;
    if (obstacle.state == ObstacleState::kExtended && obstacle.carried_by < 0) add_solid(obstacle);
  }
  for (const ObstacleDescription& separator : arena.dock_separators) add_solid(separator);
  painter.add_walls(arena.walls);
  if (arena.border) {
    painter.add_border(painter.in_cells(arena.origin), painter.in_cells(arena.origin + arena.size));
  }
  return map;
}

}  // namespace sim
