// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/shortest_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include "sim/core/math.h"

namespace playpen::grade {
namespace {

constexpr float kSolidAbove = 0.5F;
constexpr std::int64_t kUnits = 1024;  ///< units per side of a cell

/// A point in units of 1/kUnits cell from the map's bottom left corner, y up.
struct Point {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

double distance(const Point& a, const Point& b) {
  return sim::math::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y));
}

std::int64_t floor_div(std::int64_t a, std::int64_t b) {  // b > 0
  return a / b - (a % b < 0 ? 1 : 0);
}

/// A point where the path may turn, and the direction of its solid cell.
struct Corner {
  Point at;
  int solid_x = 0;  ///< -1 or 1; 0: an end of the path, which is not a corner
  int solid_y = 0;
};

class Space {
 public:
  explicit Space(const sim::OccupancyMap& map) : map_(map) {}

  /// Whether a cell is solid, by column and row from the bottom; everything outside the map is
  /// solid.
  [[nodiscard]] bool solid(std::int64_t column, std::int64_t row) const {
    if (column < 0 || row < 0 || column >= map_.width || row >= map_.height) return true;
    return map_.at(static_cast<int>(column), map_.height - 1 - static_cast<int>(row)) > kSolidAbove;
  }

  [[nodiscard]] Point point(const sim::Vec2& p_W) const {
    const sim::Vec2 p = (p_W - map_.origin) / map_.cell_size_m * static_cast<double>(kUnits);
    return {std::llround(p.x()), std::llround(p.y())};
  }

  [[nodiscard]] sim::Vec2 in_world(const Point& p) const {
    return map_.origin + sim::Vec2(static_cast<double>(p.x), static_cast<double>(p.y)) *
                             (map_.cell_size_m / static_cast<double>(kUnits));
  }

  /// Whether a point lies in a free cell, or on the border of one.
  [[nodiscard]] bool is_free(const Point& p) const {
    const std::int64_t column = floor_div(p.x, kUnits);
    const std::int64_t row = floor_div(p.y, kUnits);
    const std::int64_t left = p.x % kUnits == 0 ? column - 1 : column;
    const std::int64_t below = p.y % kUnits == 0 ? row - 1 : row;
    return !solid(column, row) || !solid(left, row) || !solid(column, below) || !solid(left, below);
  }

  /// Corners around which a shortest path may turn: those with three free cells around them.
  [[nodiscard]] std::vector<Corner> corners() const {
    std::vector<Corner> found;
    for (std::int64_t y = 1; y < map_.height; ++y) {
      for (std::int64_t x = 1; x < map_.width; ++x) {
        int count = 0;
        Corner corner{{x * kUnits, y * kUnits}};
        for (const int dx : {-1, 1}) {
          for (const int dy : {-1, 1}) {
            if (!solid(dx < 0 ? x - 1 : x, dy < 0 ? y - 1 : y)) continue;
            ++count;
            corner.solid_x = dx;
            corner.solid_y = dy;
          }
        }
        if (count == 1) found.push_back(corner);
      }
    }
    return found;
  }

  /// Whether the straight line between two points avoids the interior of solid cells and does not
  /// pass between two that meet at a corner.
  [[nodiscard]] bool sees(Point from, Point to) const {
    if (from == to) return true;
    // The loop iterates over bands of rows; a horizontal line is transposed first.
    const bool turned = from.y == to.y;
    if (turned) {
      std::swap(from.x, from.y);
      std::swap(to.x, to.y);
    }
    const auto is_solid = [this, turned](std::int64_t column, std::int64_t row) {
      return turned ? solid(row, column) : solid(column, row);
    };
    if (from.y > to.y) std::swap(from, to);
    const std::int64_t dx = to.x - from.x;
    const std::int64_t dy = to.y - from.y;
    const std::int64_t per_column = dy * kUnits;
    // x of the line at a height, in units of 1/per_column columns.
    const auto x_at = [&](std::int64_t y) { return from.x * dy + dx * (y - from.y); };

    for (std::int64_t row = floor_div(from.y, kUnits); row * kUnits < to.y; ++row) {
      const std::int64_t top = (row + 1) * kUnits;
      const auto [low, high] =
          std::minmax({x_at(std::max(from.y, row * kUnits)), x_at(std::min(to.y, top))});
      if (low == high && low % per_column == 0) {
        const std::int64_t column = low / per_column;
        if (is_solid(column - 1, row) && is_solid(column, row)) return false;
      } else {
        const std::int64_t last = -floor_div(-high, per_column) - 1;
        for (std::int64_t column = floor_div(low, per_column); column <= last; ++column) {
          if (is_solid(column, row)) return false;
        }
      }
      if (top < to.y && x_at(top) % per_column == 0) {
        const std::int64_t column = x_at(top) / per_column;
        if ((is_solid(column - 1, row) && is_solid(column, row + 1)) ||
            (is_solid(column, row) && is_solid(column - 1, row + 1))) {
          return false;
        }
      }
    }
    return true;
  }

  /// The centre of the free cell nearest to a point, within `reach` units.
  [[nodiscard]] std::optional<Point> nearest_free(const Point& p, double reach) const {
    const auto cells = static_cast<std::int64_t>(std::ceil(reach / static_cast<double>(kUnits)));
    const std::int64_t column = floor_div(p.x, kUnits);
    const std::int64_t row = floor_div(p.y, kUnits);
    std::optional<Point> nearest;
    for (std::int64_t r = std::max<std::int64_t>(row - cells, 0);
         r <= std::min<std::int64_t>(row + cells, map_.height - 1); ++r) {
      for (std::int64_t c = std::max<std::int64_t>(column - cells, 0);
           c <= std::min<std::int64_t>(column + cells, map_.width - 1); ++c) {
        const Point middle{c * kUnits + kUnits / 2, r * kUnits + kUnits / 2};
        if (solid(c, r) || distance(p, middle) > reach) continue;
        if (!nearest || distance(p, middle) < distance(p, *nearest)) nearest = middle;
      }
    }
    return nearest;
  }

 private:
  const sim::OccupancyMap& map_;
};

/// Whether a taut path in this direction may pass or end at a corner: it must not point into the
/// solid cell or away from it.
bool touches(const Corner& corner, std::int64_t dx, std::int64_t dy) {
  const auto sign = [](std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; };
  return sign(dx) * corner.solid_x * sign(dy) * corner.solid_y <= 0;
}

}  // namespace

double inscribed_radius(const sim::Polygon& outline) {
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const sim::Vec2& a = outline[i];
    const sim::Vec2 side = outline[(i + 1) % outline.size()] - a;
    // Distance of the origin from the line through a side.
    radius = std::min(radius, std::abs(side.x() * a.y() - side.y() * a.x()) / side.norm());
  }
  return radius;
}

sim::OccupancyMap inflate(const sim::OccupancyMap& map, double radius_m) {
  sim::OccupancyMap result = map;
  for (float& cell : result.cells) cell = cell > kSolidAbove ? 1.0F : 0.0F;
  const auto is_solid = [&map](int column, int row) {
    return column >= 0 && row >= 0 && column < map.width && row < map.height &&
           map.at(column, row) > kSolidAbove;
  };
  const double radius = radius_m / map.cell_size_m;
  const int reach = static_cast<int>(std::ceil(radius + 0.5));
  std::vector<std::pair<int, int>> disc;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double away =
          sim::math::hypot(std::max(std::abs(dx) - 0.5, 0.0), std::max(std::abs(dy) - 0.5, 0.0));
      constexpr double kRounding = 1e-9;  // a distance equal to the radius is free
      if (away < radius - kRounding) disc.emplace_back(dx, dy);
    }
  }
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      if (!is_solid(column, row)) continue;
      // A cell inside a solid area inflates no farther than its neighbours.
      if (is_solid(column - 1, row) && is_solid(column + 1, row) && is_solid(column, row - 1) &&
          is_solid(column, row + 1)) {
        continue;
      }
      for (const auto& [dx, dy] : disc) {
        const int c = column + dx;
        const int r = row + dy;
        if (c < 0 || r < 0 || c >= map.width || r >= map.height) continue;
        result.cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(map.width) +
                     static_cast<std::size_t>(c)] = 1.0F;
      }
    }
  }
  return result;
}

std::optional<Way> shortest_way(const sim::OccupancyMap& map, const sim::Vec2& start,
                                const sim::Vec2& goal, double slip_m) {
  const Space space(map);
  const double cell = static_cast<double>(kUnits);
  Way way;
  std::vector<Corner> nodes(2);  // start and goal, followed by the corners
  for (std::size_t i = 0; i < 2; ++i) {
    nodes[i].at = space.point(i == 0 ? start : goal);
    if (space.is_free(nodes[i].at)) continue;
    const std::optional<Point> free =
        space.nearest_free(nodes[i].at, slip_m / map.cell_size_m * cell);
    if (!free) return std::nullopt;
    nodes[i].at = *free;
  }
  const std::vector<Corner> corners = space.corners();
  nodes.insert(nodes.end(), corners.begin(), corners.end());

  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> length(nodes.size(), kFar);
  std::vector<std::size_t> before(nodes.size(), 0);
  std::vector<bool> settled(nodes.size(), false);
  using Entry = std::pair<double, std::size_t>;  // lower bound of the whole path's length, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  length[0] = 0.0;
  open.emplace(distance(nodes[0].at, nodes[1].at), 0);
  while (!open.empty() && !settled[1]) {
    const std::size_t here = open.top().second;
    open.pop();
    if (settled[here]) continue;
    settled[here] = true;
    const Corner& from = nodes[here];
    for (std::size_t next = 1; next < nodes.size(); ++next) {
      if (settled[next]) continue;
      const Corner& to = nodes[next];
      const std::int64_t dx = to.at.x - from.at.x;
      const std::int64_t dy = to.at.y - from.at.y;
      if (!touches(from, dx, dy) || !touches(to, dx, dy)) continue;
      const double total = length[here] + distance(from.at, to.at);
      if (total >= length[next] || !space.sees(from.at, to.at)) continue;
      length[next] = total;
      before[next] = here;
      open.emplace(total + distance(to.at, nodes[1].at), next);
    }
  }
  if (!settled[1]) return std::nullopt;

  way.points.push_back(space.in_world(nodes[1].at));
  for (std::size_t i = 1; i != 0; i = before[i]) {
    way.points.push_back(space.in_world(nodes[before[i]].at));
  }
  std::reverse(way.points.begin(), way.points.end());
  // Use the exact start and goal. An end in a solid cell is connected by a straight line.
  if (nodes[0].at == space.point(start)) way.points.erase(way.points.begin());
  way.points.insert(way.points.begin(), start);
  if (nodes[1].at == space.point(goal)) way.points.pop_back();
  way.points.push_back(goal);
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    way.length_m += (way.points[i] - way.points[i - 1]).norm();
  }
  return way;
}

}  // namespace playpen::grade
