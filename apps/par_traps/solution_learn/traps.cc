// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "traps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "par_common/planners.h"

namespace {

const double RADIUS = 0.22;  // radius of a known trap [m]
// What a crossing of a trap costs, in metres of path that the robot would rather drive.
const double METRES_PER_POINT = 2.0;
const double METRES_PUT_BACK = 20.0;

}  // namespace

void CTraps::add(const std::string& trap, const par::Point& at) {
  Place place;
  place.trap = trap;
  place.at = at;
  known.push_back(place);
}

void CTraps::setLoss(const std::string& trap, double points) {
  for (auto place = known.rbegin(); place != known.rend(); ++place) {
    if (place->trap != trap) continue;
    place->points = std::max(0.0, points);
    return;
  }
}

void CTraps::setPutBack() {
  if (!known.empty()) known.back().putBack = true;
}

par::Grid<double> CTraps::costs(const par::GridFrame& frame) const {
  par::Grid<double> result(frame);
  // A path through the middle of a circle crosses this many cells.
  const double across = 2.0 * RADIUS / frame.cell_size_m;
  const int reach = static_cast<int>(std::ceil(RADIUS / frame.cell_size_m));
  for (const Place& place : known) {
    const double metres = METRES_PER_POINT * place.points + (place.putBack ? METRES_PUT_BACK : 0.0);
    const double cost = metres / frame.cell_size_m / across;
    const par::Cell centre = frame.cell_of(place.at);
    for (int row = centre.row - reach; row <= centre.row + reach; row++) {
      for (int column = centre.column - reach; column <= centre.column + reach; column++) {
        const par::Cell cell = {column, row};
        if (!result.contains(cell) || par::distance_m(frame.centre_of(cell), place.at) > RADIUS) {
          continue;
        }
        result[cell] = std::max(result[cell], cost);
      }
    }
  }
  return result;
}

std::vector<par::Cell> cheapestPath(const par::Mask& blocked, const par::Grid<double>& costs,
                                    const par::Cell& start, const par::Cell& goal) {
  typedef std::pair<double, std::size_t> Open;  // cost from the start, index of the cell
  const par::GridFrame& frame = blocked.frame();
  par::Grid<double> best(frame, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(frame.size(), frame.size());
  std::priority_queue<Open, std::vector<Open>, std::greater<Open>> open;
  best[start] = 0.0;
  open.push({0.0, frame.index(start)});
  while (!open.empty()) {
    const Open next = open.top();
    open.pop();
    const par::Cell cell = frame.cell_at(next.second);
    if (cell == goal) break;
    if (next.first > best[cell]) continue;  // a cheaper path was found meanwhile
    for (int dy = -1; dy <= 1; dy++) {
      for (int dx = -1; dx <= 1; dx++) {
        const par::Cell to = {cell.column + dx, cell.row + dy};
        // A diagonal step must not touch the corner of a wall.
        if (blocked.value_or(to, 1) != 0 || blocked.value_or({to.column, cell.row}, 1) != 0 ||
            blocked.value_or({cell.column, to.row}, 1) != 0) {
          continue;
        }
        const double cost = next.first + std::hypot(dx, dy) + costs[to];
        if (cost >= best[to]) continue;
        best[to] = cost;
        from[frame.index(to)] = next.second;
        open.push({cost, frame.index(to)});
      }
    }
  }
  std::vector<par::Cell> path;
  if (!std::isfinite(best[goal])) return path;
  for (par::Cell cell = goal; cell != start; cell = frame.cell_at(from[frame.index(cell)])) {
    path.push_back(cell);
  }
  path.push_back(start);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<par::Cell> straighten(const par::Mask& blocked, const par::Grid<double>& costs,
                                  const std::vector<par::Cell>& path) {
  par::Mask closed = blocked;
  for (std::size_t i = 0; i < closed.values().size(); i++) {
    if (costs.values()[i] > 0.0) closed.values()[i] = 1;
  }
  std::vector<par::Cell> turns;
  for (std::size_t at = 0; at < path.size();) {
    turns.push_back(path[at]);
    std::size_t next = at + 1;  // inside a trap, every cell is a turn
    while (next + 1 < path.size() && par::line_of_sight(closed, path[at], path[next + 1])) next++;
    at = next;
  }
  return turns;
}
