// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/check_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "io/check_ranges.h"
#include "io/controller_io.h"
#include "io/document.h"
#include "io/solid_limits.h"
#include "io/solids.h"
#include "sim/core/assert.h"
#include "sim/core/number_text.h"
#include "sim/core/pose.h"
#include "sim/io/world_io.h"
#include "sim/world/limits.h"
#include "sim/world/robot_model.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

std::string metres(double value) { return rounded_text(value, 3) + " m"; }

std::string place(const Vec2& p) {
  return '(' + fixed_text(p.x(), 2) + ", " + fixed_text(p.y(), 2) + ')';
}

std::string floor_text(const ArenaDescription& arena) {
  return "the floor, which goes from " + place(arena.origin) + " to " +
         place(arena.origin + arena.size);
}

struct NamedSolid {
  const ObstacleDescription* obstacle;
  bool separator;
  std::vector<Solid> parts;
};

/// All solids that a robot at rest must keep clear of, except other robots.
std::vector<NamedSolid> standing_solids(const ArenaDescription& arena) {
  std::vector<NamedSolid> solids;
  for (const ObstacleDescription& obstacle : arena.obstacles) {
    if (obstacle.solid && obstacle.state == ObstacleState::kExtended && obstacle.carried_by < 0) {
      solids.push_back({&obstacle, false, solids_of(obstacle)});
    }
  }
  for (const ObstacleDescription& separator : arena.dock_separators) {
    solids.push_back({&separator, true, solids_of(separator)});
  }
  return solids;
}

/// A robot's index and its current outline.
using StandingRobot = std::pair<std::size_t, std::vector<Solid>>;

/// One obstruction of a robot.
struct Blockage {
  enum class Kind { kOutside, kObstacle, kWall, kRobot };
  Kind kind;
  double depth_m = 0.0;               ///< penetration depth; not known for a wall
  const char* side = "";              ///< side of the floor
  const NamedSolid* solid = nullptr;  ///< the obstacle
  std::size_t robot = 0;              ///< the other robot
  Vec2 wall = Vec2::Zero();           ///< a point of the wall
};

/// All obstructions of a robot or an obstacle that consists of the solids `body`.
/// @param solid  false: only the edge of the floor obstructs it.
std::vector<Blockage> blockages(const ArenaDescription& arena,
                                const std::vector<NamedSolid>& solids,
                                const std::vector<StandingRobot>& robots,
                                const std::vector<Solid>& body, bool solid) {
  std::vector<Blockage> found;
  const auto note = [&found](Blockage::Kind kind, double depth_m) -> Blockage& {
    found.push_back({kind, depth_m});
    return found.back();
  };
  const auto [side, beyond_m] = beyond_floor(arena, body);
  if (beyond_m > 0.0) note(Blockage::Kind::kOutside, beyond_m).side = side;
  if (!solid) return found;
  for (const NamedSolid& other : solids) {
    const double depth_m = overlap_m(body, other.parts);
    if (depth_m > 0.0) note(Blockage::Kind::kObstacle, depth_m).solid = &other;
  }
  for (const Solid& part : body) {
    const std::optional<Vec2> wall = wall_within(arena.walls, part);
    if (!wall) continue;
    note(Blockage::Kind::kWall, 0.0).wall = *wall;
    break;
  }
  for (const auto& [index, other] : robots) {
    const double depth_m = overlap_m(body, other);
    if (depth_m > 0.0) note(Blockage::Kind::kRobot, depth_m).robot = index;
  }
  return found;
}

/// Collects issues of one world.
class Checker {
 public:
  Checker(const WorldDescription& world, const TrustedPart& trusted)
      : world_(world), trusted_(trusted) {
    if (world.arena.preset == "syrotek") preset_ = syrotek_arena();
  }

  std::vector<ConfigIssue> run() {
    check_names_and_ports();
    check_models();
    check_time();
    if (trusted_("/arena") && check_sizes()) {
      check_arena();
      check_robot_poses();
    }
    check_canvas();
    for (ConfigIssue& issue : check_controller(world_, trusted_)) {
      issues_.push_back(std::move(issue));
    }
    return std::move(issues_);
  }

 private:
  void add(const char* id, std::string pointer, std::string expected, std::string found,
           std::string hint = "") {
    issues_.push_back({id, world_.file, std::move(pointer), std::move(expected), std::move(found),
                       std::move(hint)});
  }

  /// JSON pointer of a list element. The elements of the preset come first and are not in the file;
  /// their pointer is that of the list.
  static std::string element(const char* list, std::size_t index, std::size_t of_preset) {
    if (index < of_preset) return list;
    return std::string(list) + '/' + std::to_string(index - of_preset);
  }

  [[nodiscard]] std::string obstacle_pointer(std::size_t i) const {
    return element("/arena/obstacles", i, preset_.obstacles.size());
  }
  [[nodiscard]] std::string separator_pointer(std::size_t i) const {
    return element("/arena/dock_separators", i, preset_.dock_separators.size());
  }
  [[nodiscard]] std::string dock_pointer(std::size_t i) const {
    return element("/arena/docks", i, preset_.docks.size());
  }
  static std::string robot_pointer(std::size_t i) { return "/robots/" + std::to_string(i); }

  void unique(std::map<std::string, std::string>& seen, const std::string& name,
              const std::string& owner, const char* what) {
    if (!trusted_(owner + "/name")) return;
    const auto [first, added] = seen.emplace(name, owner);
    if (!added) {
      add("world/duplicate-name", owner + "/name",
          std::string("a name of its own for each ") + what,
          '"' + name + "\" a second time (first at " + first->second + ")",
          "rename one of the two");
    }
  }

  void check_names_and_ports() {
    std::map<std::string, std::string> blocks;
    for (std::size_t i = 0; i < world_.arena.obstacles.size(); ++i) {
      unique(blocks, world_.arena.obstacles[i].name, obstacle_pointer(i), "obstacle and separator");
    }
    for (std::size_t i = 0; i < world_.arena.dock_separators.size(); ++i) {
      unique(blocks, world_.arena.dock_separators[i].name, separator_pointer(i),
             "obstacle and separator");
    }
    std::map<std::string, std::string> docks;
    for (std::size_t i = 0; i < world_.arena.docks.size(); ++i) {
      unique(docks, world_.arena.docks[i].name, dock_pointer(i), "dock");
    }
    std::map<std::string, std::string> robots;
    std::map<int, std::size_t> ports;
    for (std::size_t i = 0; i < world_.robots.size(); ++i) {
      const RobotDescription& robot = world_.robots[i];
      unique(robots, robot.name, robot_pointer(i), "robot");
      if (find_robot_model(world_, robot.model) == nullptr) {
        add("world/unknown-model", robot_pointer(i) + "/model",
            "\"s1r\" or one of WorldDescription::models", '"' + robot.model + '"');
      }
      if (!trusted_(robot_pointer(i) + "/port") || robot.port == 0) continue;
      if (robot.port == world_.robots_on_port) continue;  // robots share it
      const auto [first, added] = ports.emplace(robot.port, i);
      if (!added) {
        add("world/duplicate-port", robot_pointer(i) + "/port", "a port of its own for each robot",
            std::to_string(robot.port) + " a second time (robot " +
                world_.robots[first->second].name + " has it)",
            "leave \"port\" out and each robot gets a free one");
      }
    }
  }

  static const char* place_hint(ObstacleShape shape) {
    switch (shape) {
      case ObstacleShape::kCircle:
        return "center is the middle of the circle, radius half its width";
      case ObstacleShape::kPolygon:
        return "center is the place of the outline's origin, [0, 0]";
      case ObstacleShape::kBox:
        break;
    }
    return "center is the middle of the box, size its full length and width";
  }

  void check_inside(const ObstacleDescription& obstacle, const std::string& pointer,
                    const char* what) {
    const auto [side, depth_m] = beyond_floor(world_.arena, solids_of(obstacle));
    if (depth_m == 0.0) return;
    add("world/obstacle-outside", pointer,
        std::string("a") + what + " on " + floor_text(world_.arena),
        obstacle.name + " sticking out " + metres(depth_m) + " beyond the " + side + " side",
        place_hint(obstacle.shape));
  }

  /// Records the error in the part at `pointer`, if there is one.
  /// @return whether there is none.
  bool passes(const std::optional<SolidError>& error, const std::string& pointer,
              const std::string& name = "") {
    if (!error) return true;
    add(error->id, pointer + error->key, error->expected,
        error->found + (name.empty() ? "" : " of " + name), error->hint);
    return false;
  }

  /// Whether the physics can build the arena; records each error.
  bool check_sizes() {
    const ArenaDescription& arena = world_.arena;
    bool all = passes(check_floor(arena), "/arena") && passes(check_walls(arena), "/arena");
    // Elements of a preset have no position in the file.
    for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
      const ObstacleDescription& obstacle = arena.obstacles[i];
      all &= passes(check_obstacle(obstacle), obstacle_pointer(i), obstacle.name) &&
             passes(check_movable(obstacle), obstacle_pointer(i), obstacle.name) &&
             passes(out_of_range(fields_of<ObstacleDescription>(), &obstacle,
                                 {"rise_speed", "motion", "mass", "friction"}),
                    obstacle_pointer(i), obstacle.name);
    }
    for (std::size_t i = 0; i < arena.dock_separators.size(); ++i) {
      const ObstacleDescription& separator = arena.dock_separators[i];
      all &= passes(check_box(separator), separator_pointer(i), separator.name);
    }
    for (std::size_t i = 0; i < arena.docks.size(); ++i) {
      const ObstacleDescription area = area_of(arena.docks[i]);
      all &= passes(check_box(area), dock_pointer(i), area.name);
    }
    return all;
  }

  void check_models() {
    std::set<std::string> checked;
    for (std::size_t i = 0; i < world_.robots.size(); ++i) {
      const std::string& name = world_.robots[i].model;
      const RobotModel* model = find_robot_model(world_, name);
      if (model == nullptr || !checked.insert(name).second) continue;
      if (passes(check_model(*model), robot_pointer(i) + "/model", "model " + name)) continue;
      bad_models_.insert(name);
    }
  }

  void check_time() {
    const SimulationDescription& simulation = world_.simulation;
    if (simulation.step_ns <= 0) {
      add("world/out-of-range", "/simulation/step", "a step longer than 0 s",
          number_text(to_seconds(simulation.step_ns)) + " s");
    }
    if (!(simulation.time_factor > 0.0 && std::isfinite(simulation.time_factor))) {
      add("world/out-of-range", "/simulation/time", "a factor greater than 0",
          number_text(simulation.time_factor));
    }
  }

  static ObstacleDescription area_of(const DockDescription& dock) {
    ObstacleDescription area;
    area.name = dock.name;
    area.center = dock.pose.position();
    area.size = dock.size;
    area.yaw_rad = dock.pose.yaw_rad;
    return area;
  }

  void check_arena() {
    const ArenaDescription& arena = world_.arena;
    for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
      check_inside(arena.obstacles[i], obstacle_pointer(i), "n obstacle");
    }
    check_movable_places();
    for (std::size_t i = 0; i < arena.dock_separators.size(); ++i) {
      check_inside(arena.dock_separators[i], separator_pointer(i), " separator");
    }
    for (std::size_t i = 0; i < arena.docks.size(); ++i) {
      check_inside(area_of(arena.docks[i]), dock_pointer(i), " dock");
    }
  }

  /// Obstacles that move or can be pushed must not overlap others: the physics would throw them
  /// apart.
  void check_movable_places() {
    const ArenaDescription& arena = world_.arena;
    if (std::none_of(arena.obstacles.begin(), arena.obstacles.end(), is_movable)) return;
    const std::vector<NamedSolid> solids = standing_solids(arena);
    for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
      const ObstacleDescription& obstacle = arena.obstacles[i];
      if (!is_movable(obstacle) || !obstacle.solid) continue;
      const std::vector<Solid> body = solids_of(obstacle);
      const auto add_overlap = [&](const std::string& expected, const std::string& found) {
        add("world/obstacles-overlap", obstacle_pointer(i) + "/center",
            "a place clear of " + expected + " for an obstacle that can move",
            obstacle.name + " at " + place(obstacle.center) + found, "move one of the two");
      };
      for (const NamedSolid& other : solids) {
        if (other.obstacle == &obstacle) continue;
        const double depth_m = overlap_m(body, other.parts);
        if (depth_m <= 0.0) continue;
        add_overlap((other.separator ? "separator " : "obstacle ") + other.obstacle->name,
                    " overlapping it by " + metres(depth_m));
        break;
      }
      for (const Solid& part : body) {
        if (!wall_within(arena.walls, part)) continue;
        add_overlap("the map's walls", " in a wall");
        break;
      }
    }
  }

  void check_robot_poses() {
    const std::vector<NamedSolid> solids = standing_solids(world_.arena);
    std::vector<StandingRobot> before;
    for (std::size_t i = 0; i < world_.robots.size(); ++i) {
      const RobotDescription& robot = world_.robots[i];
      const RobotModel* model = find_robot_model(world_, robot.model);
      const std::string pointer = robot_pointer(i) + "/pose";
      if (model == nullptr || !trusted_(pointer) || !trusted_(robot_pointer(i) + "/model") ||
          bad_models_.contains(robot.model)) {
        continue;
      }
      if (!is_valid_pose(robot.pose)) {
        add("world/out-of-range", pointer,
            "numbers from " + number_text(-kFarthest_m) + " to " + number_text(kFarthest_m) +
                " m for x and y, and a number for the angle",
            number_text(robot.pose.x_m) + ", " + number_text(robot.pose.y_m) + " and " +
                number_text(robot.pose.yaw_rad));
        continue;
      }
      const std::string who = "robot " + robot.name + " at " + place(robot.pose.position());
      std::vector<Solid> body = solids_of(*model, robot.pose);
      for (const Blockage& b : blockages(world_.arena, solids, before, body, model->solid)) {
        switch (b.kind) {
          case Blockage::Kind::kOutside:
            add("world/robot-outside", pointer, "a place on " + floor_text(world_.arena),
                who + " sticking out " + metres(b.depth_m) + " beyond the " + b.side + " side",
                "x and y are the middle of the robot; keep 0.1 m from the border");
            break;
          case Blockage::Kind::kObstacle: {
            const ObstacleDescription& obstacle = *b.solid->obstacle;
            const bool dynamic = obstacle.type == ObstacleType::kDynamic;
            add("world/robot-overlaps-obstacle", pointer,
                std::string("a place clear of ") +
                    (b.solid->separator ? "separator " : "obstacle ") + obstacle.name +
                    ", whose center is " + place(obstacle.center),
                who + " overlapping it by " + metres(b.depth_m),
                dynamic ? "move the robot, or leave " + obstacle.name + " retracted"
                        : "move the robot");
            break;
          }
          case Blockage::Kind::kWall:
            add("world/robot-overlaps-wall", pointer, "a place clear of the map's walls",
                who + " in a wall at " + place(b.wall),
                "move the robot to a light part of the map");
            break;
          case Blockage::Kind::kRobot:
            add("world/robots-overlap", pointer,
                "a place clear of robot " + world_.robots[b.robot].name + " at " +
                    place(world_.robots[b.robot].pose.position()),
                who + " overlapping it by " + metres(b.depth_m), "move one of the two");
            break;
        }
      }
      if (model->solid) before.emplace_back(i, std::move(body));
    }
  }

  void check_canvas() {
    const CanvasDescription& canvas = world_.canvas;
    if (canvas.width < 1 || canvas.width > kMaxCanvasSide || canvas.height < 1 ||
        canvas.height > kMaxCanvasSide) {
      add("world/out-of-range", "/canvas/size", "1 to 8192 cells along each side",
          std::to_string(canvas.width) + " x " + std::to_string(canvas.height));
    }
    if (!(canvas.cell_size_m > 0.0 && std::isfinite(canvas.cell_size_m))) {
      add("world/out-of-range", "/canvas/cell_size", "a number greater than 0 m",
          number_text(canvas.cell_size_m));
    }
    if (!canvas.origin.allFinite()) {
      add("world/out-of-range", "/canvas/origin", "two numbers",
          number_text(canvas.origin.x()) + " and " + number_text(canvas.origin.y()));
    }
  }

  const WorldDescription& world_;
  const TrustedPart& trusted_;
  ArenaDescription preset_;
  std::set<std::string> bad_models_;
  std::vector<ConfigIssue> issues_;
};

}  // namespace

std::vector<ConfigIssue> check_world_parts(const WorldDescription& world,
                                           const TrustedPart& trusted) {
  return Checker(world, trusted).run();
}

std::vector<ConfigIssue> check_world(const WorldDescription& world) {
  return check_world_parts(world, [](const std::string&) { return true; });
}

namespace {

/// The first obstruction of solids, in words, where the robot itself does not count.
std::optional<std::string> first_blockage(const WorldDescription& world,
                                          const std::vector<Pose>& poses, std::size_t robot,
                                          const std::vector<Solid>& body, bool solid) {
  std::vector<StandingRobot> others;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const RobotModel* model = find_robot_model(world, world.robots[i].model);
    if (i == robot || model == nullptr || !model->solid) continue;
    others.emplace_back(i, solids_of(*model, poses.at(i)));
  }
  const std::vector<NamedSolid> solids = standing_solids(world.arena);
  const std::vector<Blockage> found = blockages(world.arena, solids, others, body, solid);
  if (found.empty()) return std::nullopt;
  const Blockage& first = found.front();
  switch (first.kind) {
    case Blockage::Kind::kOutside:
      return "it would stick out " + metres(first.depth_m) + " beyond the " + first.side +
             " side of " + floor_text(world.arena);
    case Blockage::Kind::kObstacle:
      return std::string(first.solid->separator ? "separator " : "obstacle ") +
             first.solid->obstacle->name + " stands there, at " +
             place(first.solid->obstacle->center);
    case Blockage::Kind::kWall:
      return "a wall of the map stands there, at " + place(first.wall);
    case Blockage::Kind::kRobot:
      break;
  }
  return "robot " + world.robots[first.robot].name + " stands there, at " +
         place(poses[first.robot].position());
}

}  // namespace

std::optional<std::string> blocked_by(const WorldDescription& world, const std::vector<Pose>& poses,
                                      std::size_t robot, const Pose& X_WB) {
  const RobotModel* own = find_robot_model(world, world.robots.at(robot).model);
  SIM_ASSERT(own != nullptr);
  return first_blockage(world, poses, robot, solids_of(*own, X_WB), own->solid);
}

std::optional<std::string> put_down_blocked_by(const WorldDescription& world,
                                               const std::vector<Pose>& poses, std::size_t robot,
                                               const ObstacleDescription& obstacle) {
  return first_blockage(world, poses, robot, solids_of(obstacle), obstacle.solid);
}

std::optional<std::string> outside_floor(const ArenaDescription& arena,
                                         const ObstacleDescription& obstacle) {
  const auto [side, depth_m] = beyond_floor(arena, solids_of(obstacle));
  if (depth_m == 0.0) return std::nullopt;
  return "stick out " + metres(depth_m) + " beyond the " + side + " side of " + floor_text(arena);
}

std::optional<Pose> find_free_pose(const WorldDescription& world, const Polygon& footprint,
                                   std::size_t& places_tried) {
  constexpr double kMargin = 1.3;  // of the footprint: 2 to 3 cm for an S1R
  constexpr double kSpacing_m = 0.1;
  constexpr int kMostSteps = 40;
  constexpr double kStep_m = 0.1;
  constexpr double kFarEnough_m = 2.0;

  const ArenaDescription& arena = world.arena;
  const std::vector<NamedSolid> solids = standing_solids(arena);
  std::vector<Solid> robots;
  for (const RobotDescription& robot : world.robots) {
    const RobotModel* model = find_robot_model(world, robot.model);
    if (model != nullptr && model->solid) {
      robots.emplace_back(placed(model->footprint, robot.pose));
    }
  }
  const auto is_free = [&](const Pose& X_WB) {
    const std::vector<Solid> body{Solid(placed(footprint, X_WB, kMargin))};
    return beyond_floor(arena, body).second == 0.0 &&
           std::none_of(solids.begin(), solids.end(),
                        [&](const NamedSolid& s) { return overlap_m(body, s.parts) > 0.0; }) &&
           overlap_m(body, robots) == 0.0 && !wall_within(arena.walls, body.front());
  };

  if (arena.preset == "syrotek" && is_free(syrotek_start_pose())) return syrotek_start_pose();

  const double spacing_m = std::max(kSpacing_m, arena.size.maxCoeff() / kMostSteps);
  const int columns = static_cast<int>(arena.size.x() / spacing_m);
  const int rows = static_cast<int>(arena.size.y() / spacing_m);
  const Vec2 middle = arena.origin + 0.5 * arena.size;
  const int middle_column = columns / 2;
  const int middle_row = rows / 2;
  std::vector<Vec2> places;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      places.emplace_back(middle.x() + (column - middle_column) * spacing_m,
                          middle.y() + (row - middle_row) * spacing_m);
    }
  }
  std::stable_sort(places.begin(), places.end(), [&middle](const Vec2& a, const Vec2& b) {
    return (a - middle).squaredNorm() < (b - middle).squaredNorm();
  });
  for (; places_tried < places.size(); ++places_tried) {
    const Vec2& p = places[places_tried];
    std::optional<Pose> best;
    double farthest_m = -1.0;
    for (const double yaw_rad :
         {0.0, std::numbers::pi / 2.0, std::numbers::pi, -std::numbers::pi / 2.0}) {
      double free_m = -1.0;
      for (int k = 0; k * kStep_m <= kFarEnough_m; ++k) {
        const Vec2 ahead = p + k * kStep_m * unit_vector(yaw_rad);
        if (!is_free({ahead.x(), ahead.y(), yaw_rad})) break;
        free_m = k * kStep_m;
      }
      if (free_m > farthest_m) {
        farthest_m = free_m;
        best = Pose{p.x(), p.y(), yaw_rad};
      }
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace sim::io
