// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "testing/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/world/outline.h"

namespace playpen::testing {
namespace {

using sim::Polygon;
using sim::Vec2;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  return c_side * d_side < 0.0 && a_side * b_side < 0.0;
}

double segments_apart_m(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (segments_cross(a, b, c, d)) return 0.0;
  return std::min({sim::distance_to_segment_m(a, c, d), sim::distance_to_segment_m(b, c, d),
                   sim::distance_to_segment_m(c, a, b), sim::distance_to_segment_m(d, a, b)});
}

/// The body of a robot, and the nearest solid so far.
class Search {
 public:
  Search(const sim::RobotModel& model, const sim::Pose& X_WB) : center_(X_WB.position()) {
    for (const Polygon& part : sim::body_parts(model)) {
      Polygon& outline = parts_.emplace_back();
      for (const Vec2& corner : part) {
        outline.push_back(X_WB * corner);
        radius_m_ = std::max(radius_m_, corner.norm());
      }
    }
  }

  void add_segment(const Vec2& a, const Vec2& b, int solid) {
    if (sim::distance_to_segment_m(center_, a, b) - radius_m_ >= nearest_.distance_m) return;
    for (const Polygon& part : parts_) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        note(segments_apart_m(part[i], part[(i + 1) % part.size()], a, b), solid);
      }
    }
  }

  /// @param closed  whether the inside is solid, too.
  void add_outline(const Polygon& outline, int solid, bool closed) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      add_segment(outline[i], outline[(i + 1) % outline.size()], solid);
    }
    if (!closed) return;
    for (const Polygon& part : parts_) {
      if (sim::is_inside(part, outline[0]) || sim::is_inside(outline, part[0])) note(0.0, solid);
    }
  }

  void add_circle(const Vec2& center, double radius_m, int solid) {
    if ((center - center_).norm() - radius_m - radius_m_ >= nearest_.distance_m) return;
    for (const Polygon& part : parts_) {
      if (sim::is_inside(part, center)) note(0.0, solid);
      for (std::size_t i = 0; i < part.size(); ++i) {
        const double apart_m =
            sim::distance_to_segment_m(center, part[i], part[(i + 1) % part.size()]);
        note(std::max(0.0, apart_m - radius_m), solid);
      }
    }
  }

  void add_obstacle(const sim::ObstacleDescription& obstacle, int solid) {
    const bool stands = obstacle.solid && obstacle.state == sim::ObstacleState::kExtended;
    if (!stands || obstacle.carried_by >= 0) return;
    if (obstacle.shape == sim::ObstacleShape::kCircle) {
      add_circle(obstacle.center, sim::radius_m(obstacle), solid);
    } else {
      add_outline(sim::corners_of(obstacle), solid, /*closed=*/true);
    }
  }

  [[nodiscard]] const NearestSolid& nearest() const { return nearest_; }
  [[nodiscard]] const std::vector<Polygon>& parts() const { return parts_; }

 private:
  void note(double distance_m, int solid) {
    if (distance_m < nearest_.distance_m) nearest_ = {distance_m, solid};
  }

  Vec2 center_;
  double radius_m_ = 0.0;
  std::vector<Polygon> parts_;
  NearestSolid nearest_{std::numeric_limits<double>::infinity(), -1};
};

// Solids have numbers: obstacles, separators of docks, the border, the walls of maps, robots.
struct Numbers {
  explicit Numbers(const sim::WorldDescription& world)
      : separators(static_cast<int>(world.arena.obstacles.size())),
        border(separators + static_cast<int>(world.arena.dock_separators.size())),
        wall(border + 1),
        robots(wall + 1) {}
  int separators, border, wall, robots;
};

}  // namespace

NearestSolid nearest_solid(const sim::Simulation& simulation, int robot) {
  const sim::WorldDescription& world = simulation.world();
  const sim::ArenaDescription& arena = world.arena;
  const Numbers numbers(world);
  Search search(simulation.model(robot), simulation.body(robot).X_WB);
  if (!simulation.model(robot).solid) return search.nearest();
  int solid = 0;
  for (const auto& obstacle : arena.obstacles) search.add_obstacle(obstacle, solid++);
  for (const auto& separator : arena.dock_separators) search.add_obstacle(separator, solid++);
  if (arena.border) {
    const Vec2 low = arena.origin;
    const Vec2 high = low + arena.size;
    search.add_outline({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, numbers.border,
                       /*closed=*/false);
  }
  for (const sim::WallLoop& loop : arena.walls) {
    if (loop.solid) search.add_outline(loop.vertices, numbers.wall, /*closed=*/false);
  }
  for (int other = 0; other < simulation.robot_count(); ++other) {
    if (other == robot || !simulation.model(other).solid) continue;
    const Search body(simulation.model(other), simulation.body(other).X_WB);
    for (const Polygon& part : body.parts()) {
      search.add_outline(part, numbers.robots + other, /*closed=*/true);
    }
  }
  return search.nearest();
}

std::string solid_name(const sim::Simulation& simulation, int solid) {
  const sim::WorldDescription& world = simulation.world();
  const Numbers numbers(world);
  const auto index = static_cast<std::size_t>(solid);
  if (solid < 0) return "nothing";
  if (solid < numbers.separators) return world.arena.obstacles[index].name;
  const auto from = [&](int first) { return static_cast<std::size_t>(solid - first); };
  if (solid < numbers.border) return world.arena.dock_separators[from(numbers.separators)].name;
  if (solid == numbers.border) return "border";
  if (solid == numbers.wall) return "wall";
  if (from(numbers.robots) < world.robots.size()) return world.robots[from(numbers.robots)].name;
  return "nothing";
}

}  // namespace playpen::testing
