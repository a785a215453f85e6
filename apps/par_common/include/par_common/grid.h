// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Building blocks for the course's planning and exploration tasks: grids, planners, frontiers, a
/// path follower. Plain C++17. It depends neither on the simulator nor on the Player library, so
/// you can try, test and reuse it without either.
///
/// Metres are in the frame W of the arena (origin bottom left, x right, y up, angles
/// counter-clockwise from x in radians). Cells count as on the canvas: columns from the left, rows
/// from the TOP.
///
/// Nothing here is thread-safe: protect objects that several threads use with a mutex. Functions
/// only read arguments passed by const reference, so many may run at once on data that nobody
/// changes. All functions are deterministic: equal arguments give bit-identical results.
namespace par {

constexpr double kPi = 3.14159265358979323846;

/// A position in W [m].
struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(const Point& a, const Point& b) { return !(a == b); }
};

/// Distance between two positions [m].
[[nodiscard]] inline double distance_m(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// A robot's (or a sensor's) position [m] and heading [rad, counter-clockwise, 0 along x] in W.
struct Pose {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
};

/// The same direction as angle_rad, in (-pi, pi].
[[nodiscard]] inline double normalize_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// One square of a grid: column from the left, row from the top, both from 0.
struct Cell {
  int column = 0;
  int row = 0;

  friend bool operator==(const Cell& a, const Cell& b) {
    return a.column == b.column && a.row == b.row;
  }
  friend bool operator!=(const Cell& a, const Cell& b) { return !(a == b); }
};

/// Distance between the centres of two cells, in cells.
[[nodiscard]] inline double distance_cells(const Cell& a, const Cell& b) {
  return std::hypot(static_cast<double>(a.column - b.column), static_cast<double>(a.row - b.row));
}

/// Position of a grid in the world: its size in cells, and the mapping between cells and metres.
///
/// The mapping is that of the canvas: column = floor((x - origin.x) / cell_size_m),
/// row = height - 1 - floor((y - origin.y) / cell_size_m). With the default arena's canvas (172 x
/// 186 cells of 0.02 m, origin 0) a cell of the grid is a pixel of the picture.
struct GridFrame {
  int width = 172;            ///< columns
  int height = 186;           ///< rows
  double cell_size_m = 0.02;  ///< side of a cell [m], > 0
  Point origin = Point();     ///< bottom left corner of the bottom left cell, in W [m]

  /// Number of cells.
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// Whether the grid has this cell.
  [[nodiscard]] bool contains(const Cell& cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < width && cell.row < height;
  }
  /// Index of a cell in a row-major list that begins with the top row. @pre contains(cell)
  [[nodiscard]] std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.column);
  }
  /// The cell at an index of that list; the inverse of index().
  [[nodiscard]] Cell cell_at(std::size_t index) const {
    const std::size_t columns = static_cast<std::size_t>(width);
    return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
  }
  /// The cell that contains a position. Positions outside the grid give cells outside it (check
  /// with contains()). Columns and rows saturate at about a thousand million.
  [[nodiscard]] Cell cell_of(const Point& point) const;
  /// Position of a cell's centre [m]; also of cells outside the grid.
  [[nodiscard]] Point centre_of(const Cell& cell) const {
    return {origin.x + (cell.column + 0.5) * cell_size_m,
            origin.y + (height - 1 - cell.row + 0.5) * cell_size_m};
  }

  friend bool operator==(const GridFrame& a, const GridFrame& b) {
    return a.width == b.width && a.height == b.height && a.cell_size_m == b.cell_size_m &&
           a.origin == b.origin;
  }
  friend bool operator!=(const GridFrame& a, const GridFrame& b) { return !(a == b); }
};

/// A value for each cell of a frame.
template <typename T>
class Grid {
 public:
  /// A grid without cells.
  Grid() { frame_.width = frame_.height = 0; }
  /// A grid with the same value in every cell.
  /// @throw std::invalid_argument unless sides and cell size are > 0.
  explicit Grid(const GridFrame& frame, T value = T()) : frame_(frame) {
    if (frame.width <= 0 || frame.height <= 0 || !(frame.cell_size_m > 0.0)) {
      throw std::invalid_argument("a grid needs at least one cell, and cells of more than 0 m");
    }
    values_.assign(frame.size(), value);
  }

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] int width() const { return frame_.width; }
  [[nodiscard]] int height() const { return frame_.height; }
  [[nodiscard]] bool contains(const Cell& cell) const { return frame_.contains(cell); }

  /// Value of a cell. @pre contains(cell)
  [[nodiscard]] T& operator[](const Cell& cell) { return values_[frame_.index(cell)]; }
  [[nodiscard]] const T& operator[](const Cell& cell) const { return values_[frame_.index(cell)]; }
  /// Value of a cell, or another one for cells outside the grid.
  [[nodiscard]] T value_or(const Cell& cell, T outside) const {
    return contains(cell) ? (*this)[cell] : outside;
  }

  /// All values, row-major, the top row first: the order that GridMapLayer::SetCells expects.
  [[nodiscard]] const std::vector<T>& values() const { return values_; }
  [[nodiscard]] std::vector<T>& values() { return values_; }

 private:
  GridFrame frame_;
  std::vector<T> values_;
};

/// A set of cells: 1 if a cell belongs to it, 0 if not. For obstacles, 1 is blocked and 0 is free.
/// (Not bool: std::vector<bool> packs bits, which is slower and has no data().)
using Mask = Grid<std::uint8_t>;

/// Number of cells in a set.
[[nodiscard]] std::size_t count(const Mask& mask);

/// Converts cells (as in a path) to the positions of their centres.
[[nodiscard]] std::vector<Point> to_points(const GridFrame& frame, const std::vector<Cell>& cells);

}  // namespace par
