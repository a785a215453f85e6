// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fuzz/choice.h"

namespace playpen::fuzz {
namespace {

constexpr double kEdge_m = 0.01;       // between walls and the border, because numbers are round
constexpr double kLeastWall_m = 0.03;  // shorter ones are left out
constexpr double kOpened = 0.15;       // share of a maze's walls
constexpr double kMostCells = 30.0;    // along a side of a maze

// A point given by its coordinates along an axis and across it.
sim::Vec2 on_axes(int axis, double along, double across) {
  return axis == 0 ? sim::Vec2(along, across) : sim::Vec2(across, along);
}

// A wall from one coordinate to another along an axis.
Element wall_along(int axis, double from, double to, double across) {
  Element wall;
  wall.of_map = true;
  wall.center = on_axes(axis, centimetres(0.5 * (from + to)), centimetres(across));
  wall.size = on_axes(axis, centimetres(to - from), kMapWall_m);
  return wall;
}

// The distance of a place to a wall from one coordinate to another.
double distance_to_wall(int axis, double from, double to, double across, const sim::Vec2& place) {
  const double nearest = std::clamp(place[axis], from, to);
  return (place - on_axes(axis, nearest, across)).norm();
}

bool is_away(const MapPlan& plan, int axis, double from, double to, double across) {
  return std::ranges::all_of(plan.places, [&](const sim::Vec2& place) {
    return distance_to_wall(axis, from, to, across, place) >= plan.away_m + 0.5 * kMapWall_m;
  });
}

/// A cell of a maze: its column and row.
struct Cell {
  int at[2];

  [[nodiscard]] Cell moved(int axis, int by) const {
    Cell next = *this;
    next.at[axis] += by;
    return next;
  }
};

/// The cells of a maze, with walls between neighbours.
class Maze {
 public:
  Maze(const MapPlan& plan, sim::RandomStream& random) : plan_(plan), random_(random) {
    const double pitch_m = between(random, plan.width_m.x(), plan.width_m.y()) + kMapWall_m;
    for (const int axis : {0, 1}) {
      const double side_m = plan.high[axis] - plan.low[axis];
      count_[axis] = static_cast<int>(std::clamp(side_m / pitch_m, 0.0, kMostCells));
      if (count_[axis] > 0) pitch_m_[axis] = side_m / count_[axis];
    }
  }

  [[nodiscard]] std::vector<Element> walls() {
    if (count_[0] < 2 || count_[1] < 2) return {};
    for (const int axis : {0, 1}) closed_[axis].assign(cells(), true);
    carve();
    for (const int axis : {0, 1}) {
      for (std::size_t cell = 0; cell < cells(); ++cell) {
        if (chance(random_, kOpened)) closed_[axis][cell] = false;
      }
    }
    std::vector<Element> all;
    for (const int axis : {0, 1}) {
      for (int line = 0; line + 1 < count_[axis]; ++line) add_line(axis, line, all);
    }
    return all;
  }

 private:
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]);
  }
  [[nodiscard]] std::size_t index_of(const Cell& cell) const {
    return static_cast<std::size_t>(cell.at[1]) * static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(cell.at[0]);
  }
  [[nodiscard]] int below(int count) {
    return static_cast<int>(index_below(random_, static_cast<std::size_t>(count)));
  }

  // Opens walls until a way leads from each cell to each other one.
  void carve() {
    std::vector<bool> visited(cells(), false);
    std::vector<Cell> way = {Cell{{below(count_[0]), below(count_[1])}}};
    visited[index_of(way.back())] = true;
    while (!way.empty()) {
      const Cell cell = way.back();
      std::vector<std::pair<int, int>> steps;  // axis, and by how many cells
      for (const int axis : {0, 1}) {
        for (const int by : {-1, 1}) {
          const Cell next = cell.moved(axis, by);
          const bool is_inside = next.at[axis] >= 0 && next.at[axis] < count_[axis];
          if (is_inside && !visited[index_of(next)]) steps.emplace_back(axis, by);
        }
      }
      if (steps.empty()) {
        way.pop_back();
        continue;
      }
      const auto [axis, by] = steps[index_below(random_, steps.size())];
      const Cell next = cell.moved(axis, by);
      closed_[axis][index_of(by > 0 ? cell : next)] = false;
      visited[index_of(next)] = true;
      way.push_back(next);
    }
  }

  [[nodiscard]] double edge(int axis, int i) const { return plan_.low[axis] + i * pitch_m_[axis]; }

  // The walls across an axis between a line of cells and the next one. They lie along the other
  // axis, and those without a gap are one.
  void add_line(int axis, int line, std::vector<Element>& all) const {
    const int along = 1 - axis;
    const double across = edge(axis, line + 1);
    int begin = 0;
    for (int i = 0; i <= count_[along]; ++i) {
      Cell cell{};
      cell.at[axis] = line;
      cell.at[along] = i;
      const bool stands = i < count_[along] && closed_[axis][index_of(cell)] &&
                          is_away(plan_, along, edge(along, i), edge(along, i + 1), across);
      if (stands) continue;
      if (i > begin) {
        // Walls reach into the posts at their ends.
        const double from =
            std::max(edge(along, begin) - 0.5 * kMapWall_m, plan_.low[along] + kEdge_m);
        const double to = std::min(edge(along, i) + 0.5 * kMapWall_m, plan_.high[along] - kEdge_m);
        all.push_back(wall_along(along, from, to, across));
      }
      begin = i + 1;
    }
  }

  const MapPlan& plan_;
  sim::RandomStream& random_;
  int count_[2] = {0, 0};
  double pitch_m_[2] = {0.0, 0.0};
  // closed_[axis][cell]: the wall between a cell and the next one along that axis
  std::vector<bool> closed_[2];
};

/// Rooms by recursive division.
class Rooms {
 public:
  Rooms(const MapPlan& plan, sim::RandomStream& random) : plan_(plan), random_(random) {}

  [[nodiscard]] std::vector<Element> walls() {
    divide(plan_.low, plan_.high, 0);
    return std::move(walls_);
  }

 private:
  void divide(const sim::Vec2& low, const sim::Vec2& high, int depth) {
    const sim::Vec2 side_m = high - low;
    const int axis = side_m.x() >= side_m.y() ? 0 : 1;  // that is cut
    const int along = 1 - axis;
    const double width_m = centimetres(between(random_, plan_.width_m.x(), plan_.width_m.y()));
    if (side_m[axis] < 2.0 * plan_.least_room_m || side_m[along] < width_m + 2.0 * kEdge_m) return;
    if (depth > 1 && chance(random_, 0.2)) return;  // rooms of different sizes
    constexpr int kTries = 8;
    for (int i = 0; i < kTries; ++i) {
      const double across = centimetres(
          between(random_, low[axis] + plan_.least_room_m, high[axis] - plan_.least_room_m));
      if (!may_stand(axis, low, high, across)) continue;
      add_wall(along, low[along], high[along], across, width_m);
      sim::Vec2 middle_high = high;
      middle_high[axis] = across;
      sim::Vec2 middle_low = low;
      middle_low[axis] = across;
      divide(low, middle_high, depth + 1);
      divide(middle_low, high, depth + 1);
      return;
    }
  }

  // Whether a wall across an axis is away from the places, and does not end at a door.
  [[nodiscard]] bool may_stand(int axis, const sim::Vec2& low, const sim::Vec2& high,
                               double across) const {
    const int along = 1 - axis;
    if (!is_away(plan_, along, low[along], high[along], across)) return false;
    return std::ranges::none_of(doors_, [&](const Door& door) {
      return door.axis == axis &&
             std::abs(door.center[axis] - across) < 0.5 * door.width_m + 0.05 &&
             door.center[along] > low[along] - 0.01 && door.center[along] < high[along] + 0.01;
    });
  }

  void add_wall(int along, double from, double to, double across, double width_m) {
    const double door = between(random_, from + 0.5 * width_m, to - 0.5 * width_m);
    doors_.push_back({along, on_axes(along, door, across), width_m});
    const auto add = [&](double begin, double end) {
      begin = std::max(begin, plan_.low[along] + kEdge_m);
      end = std::min(end, plan_.high[along] - kEdge_m);
      if (end - begin >= kLeastWall_m) walls_.push_back(wall_along(along, begin, end, across));
    };
    add(from, door - 0.5 * width_m);
    add(door + 0.5 * width_m, to);
  }

  struct Door {
    int axis;  // along which its wall lies
    sim::Vec2 center;
    double width_m;
  };

  const MapPlan& plan_;
  sim::RandomStream& random_;
  std::vector<Door> doors_;
  std::vector<Element> walls_;
};

}  // namespace

std::vector<Element> maze_walls(const MapPlan& plan, sim::RandomStream& random) {
  return Maze(plan, random).walls();
}

std::vector<Element> room_walls(const MapPlan& plan, sim::RandomStream& random) {
  return Rooms(plan, random).walls();
}

}  // namespace playpen::fuzz
