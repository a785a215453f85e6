// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/distance_wave.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

namespace playerlike {
namespace {

// Cells of at least this occupancy are obstacles; unknown cells have 0.5.
constexpr float kOccupied = 0.5F;
// A start that is not free is moved by at most this distance.
constexpr double kStartSearch_m = 1.0;
constexpr double kFar = 1e12;  // squared cells; farther than any obstacle
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// One pass of the distance transform: d[i] = min over j of f[j] + (i - j)^2, by the lower envelope
// of parabolas.
void transform_line(std::span<const double> f, std::span<double> d, std::vector<int>& roots,
                    std::vector<double>& borders) {
  const auto n = static_cast<int>(f.size());
  const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
  roots.assign(f.size(), 0);
  borders.assign(f.size() + 1, kInfinite);
  borders[0] = -kInfinite;
  std::size_t k = 0;
  for (int q = 1; q < n; ++q) {
    double s = 0.0;
    while (true) {
      const int v = roots[k];
      s = ((at(q) + 1.0 * q * q) - (at(v) + 1.0 * v * v)) / (2.0 * (q - v));
      if (s > borders[k]) break;
      --k;
    }
    ++k;
    roots[k] = q;
    borders[k] = s;
    borders[k + 1] = kInfinite;
  }
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (borders[k + 1] < q) ++k;
    const double off = q - roots[k];
    d[static_cast<std::size_t>(q)] = off * off + at(roots[k]);
  }
}

// Distance of each cell's centre from the nearest obstacle cell, in cells; the bottom row comes
// first. The map is surrounded by obstacles.
std::vector<double> obstacle_distances(const sim::OccupancyMap& map) {
  const auto width = static_cast<std::size_t>(map.width) + 2;
  const auto height = static_cast<std::size_t>(map.height) + 2;
  std::vector<double> squares(width * height, 0.0);
  for (std::size_t y = 1; y + 1 < height; ++y) {
    const int row = map.height - static_cast<int>(y);  // the map's row 0 is at the top
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const bool occupied = map.at(static_cast<int>(x) - 1, row) >= kOccupied;
      squares[y * width + x] = occupied ? 0.0 : kFar;
    }
  }
  std::vector<int> roots;
  std::vector<double> borders;
  std::vector<double> line(std::max(width, height));
  std::vector<double> transformed(line.size());
  for (std::size_t x = 0; x < width; ++x) {
    for (std::size_t y = 0; y < height; ++y) line[y] = squares[y * width + x];
    transform_line(std::span(line).first(height), std::span(transformed).first(height), roots,
                   borders);
    for (std::size_t y = 0; y < height; ++y) squares[y * width + x] = transformed[y];
  }
  std::vector<double> distances;
  distances.reserve(map.cells.size());
  for (std::size_t y = 1; y + 1 < height; ++y) {
    transform_line(std::span(squares).subspan(y * width, width),
                   std::span(transformed).first(width), roots, borders);
    for (std::size_t x = 1; x + 1 < width; ++x) distances.push_back(std::sqrt(transformed[x]));
  }
  return distances;
}

}  // namespace

DistanceWave::DistanceWave(const sim::OccupancyMap& map, const WavefrontSettings& settings)
    : width_(map.width),
      height_(map.height),
      cell_size_m_(map.cell_size_m),
      origin_(map.origin),
      keep_away_m_(settings.robot_radius_m + settings.safety_dist_m),
      clearance_m_(obstacle_distances(map)) {
  step_factor_.reserve(clearance_m_.size());
  for (double& clearance_m : clearance_m_) {
    // An obstacle begins half a cell before its centre.
    clearance_m = std::max(0.0, (clearance_m - 0.5) * cell_size_m_);
    const double near_m = std::max(0.0, settings.max_radius_m - clearance_m);
    step_factor_.push_back(1.0 + settings.dist_penalty * near_m);
  }
}

std::optional<std::size_t> DistanceWave::cell_of(const sim::Vec2& p_W) const {
  const sim::Vec2 cell = ((p_W - origin_) / cell_size_m_).array().floor();
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < width_ && cell.y() < height_)) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(cell.x());
}

sim::Vec2 DistanceWave::center_of(std::size_t cell) const {
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t row = cell / width;
  const std::size_t column = cell % width;
  return origin_ + cell_size_m_ *
                       sim::Vec2(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
}

double DistanceWave::clearance_m(const sim::Vec2& p_W) const {
  const std::optional<std::size_t> cell = cell_of(p_W);
  return cell ? clearance_m_[*cell] : 0.0;
}

bool DistanceWave::is_free(const sim::Vec2& p_W) const { return clearance_m(p_W) >= keep_away_m_; }

bool DistanceWave::is_line_free(const sim::Vec2& a, const sim::Vec2& b) const {
  const double length_m = (b - a).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * length_m / cell_size_m_)));
  for (int i = 0; i <= steps; ++i) {
    if (!is_free(a + (b - a) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

// The cell of the start, or the nearest free one.
std::optional<std::size_t> DistanceWave::free_start(const sim::Vec2& start) const {
  if (is_free(start)) return cell_of(start);
  const int reach = static_cast<int>(kStartSearch_m / cell_size_m_);
  std::optional<std::size_t> nearest;
  double nearest_m = kStartSearch_m;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const sim::Vec2 p = start + cell_size_m_ * sim::Vec2(x, y);
      if (!is_free(p)) continue;
      const std::optional<std::size_t> cell = cell_of(p);
      const double distance_m = (center_of(*cell) - start).norm();
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      nearest = cell;
    }
  }
  return nearest;
}

std::optional<PlannedPath> DistanceWave::plan(const sim::Vec2& start, const sim::Vec2& goal) const {
  const std::optional<std::size_t> first = free_start(start);
  if (!first || !is_free(goal)) return std::nullopt;
  const std::size_t last = *cell_of(goal);
  // The wave, from the goal to the start.
  std::vector<double> costs(clearance_m_.size(), kInfinite);
  std::vector<std::size_t> next(clearance_m_.size(), last);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  costs[last] = 0.0;
  front.emplace(0.0, last);
  while (!front.empty()) {
    const auto [cost, cell] = front.top();
    front.pop();
    if (cost > costs[cell]) continue;
    if (cell == *first) break;
    const int column = static_cast<int>(cell % static_cast<std::size_t>(width_));
    const int row = static_cast<int>(cell / static_cast<std::size_t>(width_));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = column + dx;
        const int y = row + dy;
        if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
        const auto to = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                        static_cast<std::size_t>(x);
        if (clearance_m_[to] < keep_away_m_) continue;
        const double length_m = cell_size_m_ * std::sqrt(static_cast<double>(dx * dx + dy * dy));
        const double next_cost = cost + length_m * step_factor_[cell];
        if (next_cost >= costs[to]) continue;
        costs[to] = next_cost;
        next[to] = cell;
        front.emplace(next_cost, to);
      }
    }
  }
  if (costs[*first] == kInfinite) return std::nullopt;

  PlannedPath path;
  for (std::size_t cell = *first; cell != last; cell = next[cell]) {
    path.cells.push_back(center_of(cell));
  }
  path.cells.push_back(goal);
  // Each waypoint is the last point of the path that the robot can reach straight from the one
  // before.
  sim::Vec2 from = path.cells.front();
  if ((from - start).norm() > cell_size_m_) path.waypoints.push_back(from);
  for (std::size_t i = 0; i + 1 < path.cells.size();) {
    std::size_t to = i + 1;
    while (to + 1 < path.cells.size() && is_line_free(from, path.cells[to + 1])) ++to;
    from = path.cells[to];
    path.waypoints.push_back(from);
    i = to;
  }
  if (path.waypoints.empty()) path.waypoints.push_back(goal);
  sim::Vec2 before = start;
  for (const sim::Vec2& waypoint : path.waypoints) {
    path.length_m += (waypoint - before).norm();
    before = waypoint;
  }
  return path;
}

}  // namespace playerlike
