// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/individual.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "grade/evaluation.h"
#include "grade/map_score.h"
#include "grade/shortest_path.h"
#include "grade/text.h"
#include "grade/world_patch.h"
#include "sim/core/degrees.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/core/random_stream.h"
#include "sim/io/world_io.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace playpen::grade {
namespace {

using Limits = DifficultyLimits;

constexpr int kMostFloors = 40;                 ///< choices of blocks that are tried
constexpr int kStartsOnFloor = 40;              ///< starts that are tried for each of them
constexpr int kHeadings = 24;                   ///< of a start, in equal steps
constexpr double kStartGrid_m = 0.01;           ///< starts have two decimals
constexpr double kSlip_m = 2.0 * kTruthCell_m;  ///< as of make_reference()
constexpr double kRounding_m = 1e-9;
constexpr std::uint64_t kGreatestSeed = 999'999'999;

/// Uniform from 0 to count - 1.
std::size_t drawn_below(sim::RandomStream& random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

sim::RandomStream random_for(const Task& task, const std::string& what, std::string_view student) {
  return {0, "individual/" + task.name + '/' + what + '/' + std::string(student)};
}

/// Distance of a point from the nearest solid cell [m].
double distance_to_solids_m(const sim::OccupancyMap& truth, const sim::Vec2& p_W) {
  double least_m = std::numeric_limits<double>::infinity();
  for (int row = 0; row < truth.height; ++row) {
    for (int column = 0; column < truth.width; ++column) {
      if (cell_state(truth.at(column, row)) != CellState::kSolid) continue;
      const sim::Vec2 corner =
          truth.origin + truth.cell_size_m * sim::Vec2(column, truth.height - 1 - row);
      const sim::Vec2 nearest =
          p_W.cwiseMax(corner).cwiseMin(corner + sim::Vec2::Constant(truth.cell_size_m));
      least_m = std::min(least_m, (p_W - nearest).norm());
    }
  }
  return least_m;
}

/// Radius of the circle around the origin that an outline needs to turn on the spot [m].
double turning_radius_m(const sim::Polygon& outline) {
  double radius_m = 0.0;
  for (const sim::Vec2& corner : outline) radius_m = std::max(radius_m, corner.norm());
  return radius_m;
}

/// Whether a point is in the region of a trap.
bool is_in(const sim::TrapRegion& region, const sim::WorldDescription& world,
           const sim::Vec2& p_W) {
  if (const auto* box = std::get_if<sim::BoxRegion>(&region)) {
    const sim::Vec2 p_R = sim::Pose{box->center.x(), box->center.y(), box->yaw_rad}.inverse() * p_W;
    return std::abs(p_R.x()) <= 0.5 * box->size.x() && std::abs(p_R.y()) <= 0.5 * box->size.y();
  }
  if (const auto* circle = std::get_if<sim::CircleRegion>(&region)) {
    return (p_W - circle->center).norm() <= circle->radius_m;
  }
  if (const auto* polygon = std::get_if<sim::PolygonRegion>(&region)) {
    return sim::is_inside(polygon->corners, p_W);
  }
  const auto& near = std::get<sim::NearRegion>(region);
  const auto is_near = [&](const auto& object, const sim::Vec2& middle) {
    return object.name == near.object && (p_W - middle).norm() <= near.distance_m;
  };
  return std::ranges::any_of(world.robots,
                             [&](const auto& r) { return is_near(r, r.pose.position()); }) ||
         std::ranges::any_of(world.arena.obstacles,
                             [&](const auto& o) { return is_near(o, o.center); });
}

/// The names of the dynamic obstacles, and of those that are extended.
struct DynamicBlocks {
  std::vector<std::string> all;
  std::set<std::string> extended;
};

DynamicBlocks blocks_of(const sim::ArenaDescription& arena) {
  DynamicBlocks blocks;
  for (const sim::ObstacleDescription& obstacle : arena.obstacles) {
    if (obstacle.type != sim::ObstacleType::kDynamic) continue;
    blocks.all.push_back(obstacle.name);
    if (obstacle.state == sim::ObstacleState::kExtended) blocks.extended.insert(obstacle.name);
  }
  return blocks;
}

sim::ArenaDescription with_extended(sim::ArenaDescription arena,
                                    const std::set<std::string>& extended) {
  for (sim::ObstacleDescription& obstacle : arena.obstacles) {
    if (obstacle.type != sim::ObstacleType::kDynamic) continue;
    obstacle.state = extended.contains(obstacle.name) ? sim::ObstacleState::kExtended
                                                      : sim::ObstacleState::kRetracted;
  }
  return arena;
}

/// A choice of `count` names, each choice equally likely.
std::set<std::string> chosen(std::vector<std::string> names, std::size_t count,
                             sim::RandomStream& random) {
  std::set<std::string> result;
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(names[i], names[i + drawn_below(random, names.size() - i)]);
    result.insert(names[i]);
  }
  return result;
}

/// The middles of the free cells of a map that satisfy a condition.
template <typename Condition>
std::vector<sim::Vec2> free_middles(const sim::OccupancyMap& map, Condition holds) {
  std::vector<sim::Vec2> middles;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                         static_cast<std::size_t>(column);
      if (cell_state(map.cells[index]) != CellState::kFree || !holds(index)) continue;
      middles.push_back(map.origin +
                        map.cell_size_m * sim::Vec2(column + 0.5, map.height - row - 0.5));
    }
  }
  return middles;
}

/// The floor of a world with some choice of blocks.
struct ReachableFloor {
  sim::OccupancyMap truth;
  sim::OccupancyMap space;  ///< inflated for the robot's centre

  ReachableFloor(const sim::ArenaDescription& arena, double radius_m)
      : truth(make_truth(arena)), space(inflate(truth, radius_m)) {}

  /// The cells of the space that the robot's centre can reach from a point, or that it can reach
  /// this point from; none if no cell of the space is within `slip_m` of it.
  [[nodiscard]] std::vector<std::uint8_t> reachable(const sim::Vec2& from, double slip_m) const {
    const std::vector<sim::Vec2> near =
        free_middles(space, [](std::size_t /*index*/) { return true; });
    const auto nearest = std::ranges::min_element(
        near, {}, [&from](const sim::Vec2& middle) { return (middle - from).norm(); });
    if (nearest == near.end() || (*nearest - from).norm() > slip_m) {
      return std::vector<std::uint8_t>(space.cells.size(), 0);
    }
    return reachable_cells(space, *nearest);
  }
};

std::size_t count_of(const std::vector<std::uint8_t>& marks) {
  return static_cast<std::size_t>(std::ranges::count(marks, 1));
}

bool is_within(double value, double reference, double relative) {
  return std::abs(value - reference) <= relative * reference;
}

/// Finds starts and blocks of equal difficulty.
class StartSearch {
 public:
  StartSearch(const Task& task, const TaskWorld& task_world, const sim::WorldDescription& world)
      : world_(world),
        reference_(make_reference(task, task_world, world)),
        blocks_(blocks_of(world.arena)) {
    const auto judged =
        std::ranges::find(world.robots, reference_.robot, &sim::RobotDescription::name);
    robot_ = static_cast<std::size_t>(judged - world.robots.begin());
    const sim::Polygon& outline = sim::find_robot_model(world, judged->model)->footprint;
    radius_m_ = inscribed_radius(outline);
    const ReachableFloor floor(world.arena, radius_m_);
    room_m_ = std::min(distance_to_solids_m(floor.truth, reference_.start),
                       turning_radius_m(outline) + Limits::kTurning_m);
    reachable_ = count_of(floor.reachable(reference_.start, kSlip_m));
  }

  [[nodiscard]] std::size_t robot() const noexcept { return robot_; }
  [[nodiscard]] const DynamicBlocks& blocks() const noexcept { return blocks_; }

  /// Whether there are other choices of as many blocks, and nothing depends on the task's.
  [[nodiscard]] bool can_choose_blocks() const {
    return world_.controller.empty() && !blocks_.extended.empty() &&
           blocks_.extended.size() < blocks_.all.size();
  }

  /// @return nullopt if no start of equal difficulty was found.
  [[nodiscard]] std::optional<WorldPatch> find(sim::RandomStream& random,
                                               bool choose_blocks) const {
    for (int i = 0; i < (choose_blocks ? kMostFloors : 1); ++i) {
      std::optional<std::set<std::string>> extended;
      if (choose_blocks) extended = chosen(blocks_.all, blocks_.extended.size(), random);
      const ReachableFloor floor(with_extended(world_.arena, extended.value_or(blocks_.extended)),
                                 radius_m_);
      const int tries = choose_blocks ? kStartsOnFloor : kMostFloors * kStartsOnFloor;
      if (const std::optional<StartPose> start = find_start(floor, tries, random)) {
        WorldPatch patch{robot_, start, std::move(extended)};
        if (is_valid(patch)) return patch;
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<StartPose> find_start(const ReachableFloor& floor, int tries,
                                                    sim::RandomStream& random) const {
    const std::vector<std::uint8_t> reachable =
        reference_.goal ? floor.reachable(reference_.goal->position, slip_of_goal_m())
                        : floor.reachable(reference_.start, kSlip_m);
    if (!is_within(static_cast<double>(count_of(reachable)), static_cast<double>(reachable_),
                   Limits::kFloor)) {
      return std::nullopt;
    }
    const std::vector<sim::Vec2> places = free_middles(
        inflate(floor.truth, room_m_), [&](std::size_t cell) { return reachable[cell] != 0; });
    for (int i = 0; i < tries && !places.empty(); ++i) {
      const sim::Vec2& place = places[drawn_below(random, places.size())];
      const int heading = static_cast<int>(drawn_below(random, kHeadings));
      StartPose start;
      start.x_m = std::round(place.x() / kStartGrid_m) / std::round(1.0 / kStartGrid_m);
      start.y_m = std::round(place.y() / kStartGrid_m) / std::round(1.0 / kStartGrid_m);
      start.yaw_deg = 360 / kHeadings * (heading + 1) - 180;
      if (fits(floor, start.position())) return start;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool fits(const ReachableFloor& floor, const sim::Vec2& start) const {
    return is_clear_of_robots(start) && (world_.controller.empty() || is_beside(floor, start)) &&
           distance_to_solids_m(floor.truth, start) >= room_m_ - kRounding_m &&
           (!reference_.goal || has_equal_path(floor, start));
  }

  [[nodiscard]] bool is_clear_of_robots(const sim::Vec2& start) const {
    for (std::size_t i = 0; i < world_.robots.size(); ++i) {
      if (i == robot_) continue;
      const sim::Vec2 other = world_.robots[i].pose.position();
      const double needed_m = std::min((reference_.start - other).norm(), Limits::kFromRobots_m);
      if ((start - other).norm() < needed_m) return false;
    }
    return true;
  }

  /// Whether the start is close to the task's, and in no trap that the task's is not in.
  [[nodiscard]] bool is_beside(const ReachableFloor& floor, const sim::Vec2& start) const {
    if ((start - reference_.start).norm() > Limits::kBesideStart_m) return false;
    const auto is_new = [&](const sim::TrapDescription& trap) {
      return is_in(trap.region, world_, start) && !is_in(trap.region, world_, reference_.start);
    };
    if (std::ranges::any_of(world_.controller.traps, is_new)) return false;
    const std::optional<Way> way = shortest_way(floor.space, reference_.start, start, kSlip_m);
    return way && way->length_m <= Limits::kBesideStart_m;
  }

  [[nodiscard]] double slip_of_goal_m() const {
    return std::max(kSlip_m, reference_.goal->tolerance_m);
  }

  [[nodiscard]] bool has_equal_path(const ReachableFloor& floor, const sim::Vec2& start) const {
    const sim::Vec2& goal = reference_.goal->position;
    const double length_m = *reference_.shortest_path_m;
    if ((start - goal).norm() > (1.0 + Limits::kPath) * length_m) return false;
    const std::optional<Way> way = shortest_way(floor.space, start, goal, slip_of_goal_m());
    return way && is_within(way->length_m, length_m, Limits::kPath);
  }

  /// Whether the world with these changes is one. A block may stand where another robot is.
  [[nodiscard]] bool is_valid(const WorldPatch& patch) const {
    sim::WorldDescription changed = world_;
    if (patch.extended) changed.arena = with_extended(changed.arena, *patch.extended);
    changed.robots[patch.robot].pose = {patch.start->x_m, patch.start->y_m,
                                        patch.start->yaw_deg * sim::kDegrees};
    return sim::io::check_world(changed).empty();
  }

  const sim::WorldDescription& world_;
  Reference reference_;
  DynamicBlocks blocks_;
  std::size_t robot_ = 0;
  double radius_m_ = 0.0;      ///< of the circle for paths
  double room_m_ = 0.0;        ///< needed distance of a start from solids
  std::size_t reachable_ = 0;  ///< cells that the centre can reach from the task's start
};

/// "a", "a and b", "a, b and c".
template <typename Items, typename ToText>
std::string listed(const Items& items, ToText to_text) {
  std::string text;
  std::size_t i = 0;
  for (const auto& item : items) {
    if (i > 0) text += i + 1 < items.size() ? ", " : " and ";
    text += to_text(item);
    ++i;
  }
  return text;
}

std::string sentence_of(const std::string& name, const IndividualWorld& world) {
  const double yaw_deg = world.start.yaw_rad / sim::kDegrees;
  std::string text = name + ": start at (" + sim::fixed_text(world.start.x_m, 2) + ", " +
                     sim::fixed_text(world.start.y_m, 2) + "), heading " +
                     sim::fixed_text(std::round(yaw_deg) + 0.0, 0) + " degrees";
  if (!world.has_own_start)
    text += ", as in the task: no other start of equal difficulty was found";
  if (world.has_own_blocks) {
    text += "; extended blocks: " +
            listed(world.extended, [](const std::string& block) { return block; });
  }
  return text;
}

}  // namespace

IndividualWorld individual_world(const Task& task, const TaskWorld& world,
                                 std::string_view student) {
  const auto [text, description] = read_json_world(world.file, "individual conditions");
  const std::string name = world_name(world.file);
  const StartSearch search(task, world, description);
  sim::RandomStream random = random_for(task, name, student);
  std::optional<WorldPatch> patch;
  if (search.can_choose_blocks()) patch = search.find(random, true);
  if (!patch) patch = search.find(random, false);
  IndividualWorld result;
  result.has_own_start = patch.has_value();
  if (!patch) patch.emplace();
  result.text = patched_world(text, description, *patch);
  const sim::WorldDescription derived = sim::load_world_text(result.text, world.file);
  result.start = derived.robots[search.robot()].pose;
  result.extended = blocks_of(derived.arena).extended;
  result.has_own_blocks = result.extended != search.blocks().extended;
  result.sentence = sentence_of(name, result);
  return result;
}

std::vector<std::uint64_t> individual_seeds(const Task& task, std::string_view student) {
  sim::RandomStream random = random_for(task, "seeds", student);
  std::set<std::uint64_t> taken;
  std::vector<std::uint64_t> seeds;
  while (seeds.size() < task.seeds.size()) {
    const std::uint64_t seed = 1 + drawn_below(random, kGreatestSeed);
    if (taken.insert(seed).second) seeds.push_back(seed);
  }
  return seeds;
}

IndividualTask individual_task(const Task& task, std::string_view student,
                               const std::string& folder) {
  IndividualTask result{task, {}};
  for (TaskWorld& world : result.task.worlds) {
    const IndividualWorld own = individual_world(task, world, student);
    const std::string file =
        (std::filesystem::path(folder) / (world_name(world.file) + ".json")).string();
    write_text_file(file, own.text);
    world.file = file;
    result.sentences.push_back(own.sentence);
  }
  result.task.seeds = individual_seeds(task, student);
  result.sentences.push_back(
      (result.task.seeds.size() == 1 ? "seed " : "seeds ") +
      listed(result.task.seeds, [](std::uint64_t seed) { return std::to_string(seed); }));
  return result;
}

}  // namespace playpen::grade
