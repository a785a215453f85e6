// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/map_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/world/outline.h"

namespace sim::io {
namespace {

/// Counter-clockwise: adding one turns left.
enum Direction : unsigned { kEast = 0, kNorth = 1, kWest = 2, kSouth = 3 };

/// The grid with a frame of free cells around it, which saves bounds checks. Rows count from the
/// bottom.
class FramedGrid {
 public:
  explicit FramedGrid(const OccupancyGrid& grid)
      : stride_(static_cast<std::size_t>(grid.width) + 2),
        cells_(stride_ * (static_cast<std::size_t>(grid.height) + 2), 0) {
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        const std::size_t from =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
            static_cast<std::size_t>(column);
        cells_[index(column, grid.height - 1 - row)] = grid.solid[from] != 0 ? 1 : 0;
      }
    }
  }

  [[nodiscard]] bool solid(int column, int row) const { return cells_[index(column, row)] != 0; }

  /// Whether an outline leaves the lattice point (i, j) in that direction, with solid on its left
  /// and free space on its right. Point (i, j) is the bottom left corner of cell (i, j).
  [[nodiscard]] bool edge_leaves(int i, int j, unsigned direction) const {
    switch (direction) {
      case kEast:
        return solid(i, j) && !solid(i, j - 1);
      case kNorth:
        return solid(i - 1, j) && !solid(i, j);
      case kWest:
        return solid(i - 1, j - 1) && !solid(i - 1, j);
      default:
        return solid(i, j - 1) && !solid(i - 1, j - 1);
    }
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row + 1) * stride_ + static_cast<std::size_t>(column + 1);
  }

  std::size_t stride_;
  std::vector<std::uint8_t> cells_;
};

/// Marks the vertices between two kept ones that must be kept as well. `last` may be
/// vertices.size(), which stands for the first vertex.
void keep_between(const std::vector<Vec2>& vertices, std::size_t first, std::size_t last,
                  double tolerance_m, std::vector<std::uint8_t>& kept) {
  // An explicit stack, since the outline of a large map may have a million vertices.
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double farthest_m = tolerance_m;
    std::size_t farthest = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off_m =
          distance_to_segment_m(vertices[i], vertices[from], vertices[to % vertices.size()]);
      if (off_m > farthest_m) {
        farthest_m = off_m;
        farthest = i;
      }
    }
    if (farthest == from) continue;
    kept[farthest] = 1;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
}

}  // namespace

void simplify_walls(std::vector<WallLoop>& walls, double tolerance_m) {
  for (WallLoop& loop : walls) {
    const std::vector<Vec2>& vertices = loop.vertices;
    const auto far_end = std::max_element(
        vertices.begin(), vertices.end(), [&vertices](const Vec2& a, const Vec2& b) {
          return (a - vertices[0]).squaredNorm() < (b - vertices[0]).squaredNorm();
        });
    const auto middle = static_cast<std::size_t>(far_end - vertices.begin());
    std::vector<std::uint8_t> kept(vertices.size(), 0);
    kept[0] = kept[middle] = 1;
    keep_between(vertices, 0, middle, tolerance_m, kept);
    keep_between(vertices, middle, vertices.size(), tolerance_m, kept);
    std::vector<Vec2> few;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (kept[i] != 0) few.push_back(vertices[i]);
    }
    if (few.size() >= 3) loop.vertices = std::move(few);
  }
}

std::optional<std::vector<WallLoop>> trace_walls(const OccupancyGrid& grid, const Vec2& origin,
                                                 double resolution_m) {
  constexpr std::array<int, 4> kStepX{1, 0, -1, 0};
  constexpr std::array<int, 4> kStepY{0, 1, 0, -1};
  const FramedGrid cells(grid);
  const std::size_t stride = static_cast<std::size_t>(grid.width) + 1;
  // Every loop has an eastward edge, so it suffices to mark these as followed.
  std::vector<std::uint8_t> followed(stride * (static_cast<std::size_t>(grid.height) + 1), 0);
  const auto at = [stride](int i, int j) {
    return static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i);
  };
  const auto point = [&](int i, int j) {
    return Vec2(origin.x() + i * resolution_m, origin.y() + j * resolution_m);
  };

  std::vector<WallLoop> loops;
  std::size_t edges = 0;
  for (int start_j = 0; start_j <= grid.height; ++start_j) {
    for (int start_i = 0; start_i < grid.width; ++start_i) {
      if (followed[at(start_i, start_j)] != 0 || !cells.edge_leaves(start_i, start_j, kEast)) {
        continue;
      }
      // This is the leftmost edge of its run, since the others are followed right after it, so it
      // begins at a corner.
      WallLoop loop;
      loop.vertices.push_back(point(start_i, start_j));
      int i = start_i;
      int j = start_j;
      unsigned direction = kEast;
      for (;;) {
        if (direction == kEast) followed[at(i, j)] = 1;
        i += kStepX[direction];
        j += kStepY[direction];
        // Prefer a left turn: where two solid cells meet only at a corner, the outline stays with
        // its own.
        unsigned next = (direction + 1U) % 4U;
        if (!cells.edge_leaves(i, j, next)) {
          next = cells.edge_leaves(i, j, direction) ? direction : (direction + 3U) % 4U;
        }
        if (i == start_i && j == start_j && next == kEast) break;
        if (next != direction) loop.vertices.push_back(point(i, j));
        direction = next;
      }
      edges += loop.vertices.size();
      if (edges > kMaxWallEdges) return std::nullopt;
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

}  // namespace sim::io
