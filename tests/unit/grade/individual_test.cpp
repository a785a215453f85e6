// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/individual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "grade/evaluation.h"
#include "grade/map_score.h"
#include "grade/shortest_path.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

Task shipped(const std::string& name) {
  return read_task(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/tasks/" + name + ".task.json");
}

std::size_t judged_robot(const Task& task, const sim::WorldDescription& world) {
  if (task.robot.empty()) return 0;
  const auto found = std::ranges::find(world.robots, task.robot, &sim::RobotDescription::name);
  return static_cast<std::size_t>(found - world.robots.begin());
}

/// Area that the judged robot's centre can reach from its start [cells].
double reachable_area(const sim::WorldDescription& world, std::size_t robot) {
  const sim::Polygon& outline = sim::find_robot_model(world, world.robots[robot].model)->footprint;
  const std::vector<std::uint8_t> cells =
      reachable_cells(inflate(make_truth(world.arena), inscribed_radius(outline)),
                      world.robots[robot].pose.position());
  return static_cast<double>(std::ranges::count(cells, 1));
}

/// Least distance of the judged robot's outline from solids at the start [m].
double start_clearance_m(const sim::WorldDescription& world, std::size_t robot) {
  const sim::Simulation simulation(world);
  return simulation.statistics(static_cast<int>(robot)).least_clearance_m;
}

/// A world of a task, and what it describes.
struct Original {
  explicit Original(const std::string& name, std::size_t index = 0)
      : task(shipped(name)),
        task_world(task.worlds.at(index)),
        world(sim::load_world(task_world.file)),
        robot(judged_robot(task, world)),
        reference(make_reference(task, task_world, world)),
        area(reachable_area(world, robot)) {}

  Task task;
  TaskWorld task_world;
  sim::WorldDescription world;
  std::size_t robot;
  Reference reference;
  double area;  ///< see reachable_area()
};

/// A derived world with the start and the blocks of the original.
sim::WorldDescription undone(sim::WorldDescription derived, const sim::WorldDescription& original,
                             std::size_t robot) {
  derived.robots.at(robot).pose = original.robots.at(robot).pose;
  for (std::size_t i = 0; i < original.arena.obstacles.size(); ++i) {
    derived.arena.obstacles.at(i).state = original.arena.obstacles[i].state;
  }
  return derived;
}

std::size_t extended_blocks(const sim::WorldDescription& world) {
  return static_cast<std::size_t>(
      std::ranges::count_if(world.arena.obstacles, [](const sim::ObstacleDescription& o) {
        return o.type == sim::ObstacleType::kDynamic && o.state == sim::ObstacleState::kExtended;
      }));
}

void expect_equal_difficulty(const Original& original, const std::string& student) {
  SCOPED_TRACE(original.task_world.file + ' ' + student);
  const IndividualWorld own = individual_world(original.task, original.task_world, student);
  EXPECT_TRUE(own.has_own_start);
  const sim::WorldDescription world = sim::load_world_text(own.text, "elsewhere/world.json");
  EXPECT_EQ(world.robots.at(original.robot).pose, own.start);
  // Nothing else has changed.
  EXPECT_EQ(sim::world_hash(undone(world, original.world, original.robot)),
            sim::world_hash(original.world));
  EXPECT_EQ(extended_blocks(world), extended_blocks(original.world));
  const Reference& before = original.reference;
  const Reference after = make_reference(original.task, original.task_world, world);
  ASSERT_EQ(after.shortest_path_m.has_value(), before.shortest_path_m.has_value());
  if (before.shortest_path_m) {
    EXPECT_NEAR(*after.shortest_path_m, *before.shortest_path_m, 0.1 * *before.shortest_path_m);
  }
  EXPECT_NEAR(reachable_area(world, original.robot), original.area, 0.02 * original.area);
  // The starts of all these tasks have more room than that. Cells are larger than their solids.
  EXPECT_GE(start_clearance_m(world, original.robot), 0.05);
}

TEST(IndividualWorld, ShippedTasks_EqualDifficultyForFiftyStudents) {
  int students = 0;
  for (const char* name :
       {"par_intro", "par_planning", "par_exploration", "par_exploration_changing", "par_traps",
        "par_chase", "par_localization"}) {
    for (std::size_t i = 0; i < shipped(name).worlds.size(); ++i) {
      const Original original(name, i);
      for (int k = 0; k < 5; ++k) {
        expect_equal_difficulty(original, "student" + std::to_string(students++));
      }
    }
  }
  EXPECT_GE(students, 50);
}

TEST(IndividualWorld, SameStudent_SameBytes) {
  const Original original("par_planning");
  const IndividualWorld a = individual_world(original.task, original.task_world, "novak");
  const IndividualWorld b = individual_world(original.task, original.task_world, "novak");
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.sentence, b.sentence);
}

TEST(IndividualWorld, OtherStudents_OtherStartsAndBlocks) {
  const Original original("par_planning");
  std::set<std::string> texts;
  std::set<std::set<std::string>> blocks;
  for (const char* student : {"novak", "Novak", "novak2", "", "dvo\xc5\x99\xc3\xa1k", "a/b"}) {
    const IndividualWorld own = individual_world(original.task, original.task_world, student);
    texts.insert(own.text);
    blocks.insert(own.extended);
  }
  EXPECT_THAT(texts, SizeIs(6));
  EXPECT_GE(blocks.size(), 3U);
}

TEST(IndividualWorld, Sentence_SaysStartAndBlocks) {
  const Original original("par_planning");
  const IndividualWorld own = individual_world(original.task, original.task_world, "novak");
  EXPECT_THAT(own.sentence,
              testing::MatchesRegex("par_planning: start at \\([0-9]\\.[0-9][0-9], "
                                    "[0-9]\\.[0-9][0-9]\\), heading -?[0-9]+ degrees; extended "
                                    "blocks: d[1-7], d[1-7] and d[1-7]"));
}

TEST(IndividualWorld, Controller_KeepsBlocksAndStartsBesideOutsideTraps) {
  const Original original("par_traps");
  const sim::Vec2 start = original.world.robots.at(0).pose.position();
  for (int k = 0; k < 5; ++k) {
    const IndividualWorld own =
        individual_world(original.task, original.task_world, std::to_string(k));
    EXPECT_TRUE(own.has_own_start);
    EXPECT_FALSE(own.has_own_blocks);
    EXPECT_LE((own.start.position() - start).norm(), 0.3);
    EXPECT_THAT(own.sentence, Not(HasSubstr("blocks")));
  }
}

/// A task on the world w.json of a folder, with a goal at (2.5, 0.5) if `goal` is true.
Task task_in(const TemporaryFolder& folder, const std::string& world, bool goal = false) {
  Task task;
  task.name = "test";
  task.file = folder / "test.task.json";
  task.worlds = {{folder.write("w.json", world), {}, {}}};
  if (goal) task.goal = Goal{{2.5, 0.5}, std::nullopt};
  return task;
}

IndividualWorld first_world(const Task& task, const std::string& student = "novak") {
  return individual_world(task, task.worlds.front(), student);
}

TEST(IndividualWorld, StartInTrap_NotChosen) {
  const TemporaryFolder folder;
  // The traps leave a strip of 0.1 m around x = 1 free.
  const Task task = task_in(folder, R"({"arena": {"size": [2, 2]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}],
    "controller": {"traps": [
      {"name": "a", "region": {"box": {"center": [0.475, 1], "size": [0.95, 2]}}, "do": [{"message": "m"}]},
      {"name": "b", "region": {"polygon": [[1.05, 0], [2, 0], [2, 2], [1.05, 2]]}, "do": [{"message": "m"}]},
      {"name": "c", "region": {"circle": {"center": [1, 1.4], "radius": 0.3}}, "do": [{"message": "m"}]}]}})");
  for (int k = 0; k < 10; ++k) {
    const IndividualWorld own = first_world(task, std::to_string(k));
    EXPECT_TRUE(own.has_own_start);
    EXPECT_NEAR(own.start.x_m, 1.0, 0.05 + 1e-9);
    EXPECT_LT(own.start.y_m, 1.1);
  }
}

TEST(IndividualWorld, ShutRoom_KeepsStartOfTaskAndSaysSo) {
  const TemporaryFolder folder;
  // The robot can turn, but go nowhere: 0.02 m are left in each direction.
  const Task task = task_in(folder, R"({"arena": {"size": [0.2, 0.2]},
    "robots": [{"name": "r1", "pose": {"x": 0.1, "y": 0.1, "yaw_deg": 90}}]})");
  const IndividualWorld own = first_world(task);
  EXPECT_FALSE(own.has_own_start);
  EXPECT_FALSE(own.has_own_blocks);
  EXPECT_EQ(own.sentence,
            "w: start at (0.10, 0.10), heading 90 degrees, as in the task: no other start of equal "
            "difficulty was found");
  EXPECT_EQ(sim::world_hash(sim::load_world_text(own.text)),
            sim::world_hash(sim::load_world(task.worlds.front().file)));
}

TEST(IndividualWorld, OnlyBlockStandsOnRobot_NotExtended) {
  const TemporaryFolder folder;
  // Of two blocks one is extended; the other would stand on r2.
  const Task task = task_in(folder, R"({"arena": {"size": [3, 2], "obstacles": [
      {"name": "a", "center": [2.5, 1.8], "size": [0.1, 0.1], "type": "dynamic"},
      {"name": "b", "center": [2.5, 1.0], "size": [0.1, 0.1], "type": "dynamic", "state": "retracted"}]},
    "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 1}}, {"name": "r2", "pose": {"x": 2.5, "y": 1}}]})");
  for (int k = 0; k < 10; ++k) {
    const IndividualWorld own = first_world(task, std::to_string(k));
    EXPECT_TRUE(own.has_own_start);
    EXPECT_EQ(own.extended, std::set<std::string>{"a"});
    EXPECT_GE((own.start.position() - sim::Vec2(2.5, 1)).norm(), 0.5);
  }
}

TEST(IndividualWorld, OtherFiles_AbsoluteNames) {
  const TemporaryFolder folder;
  // A picture of 3 x 2 white pixels of 1 m.
  folder.write("sub/plan.pgm", "P2\n3 2\n255\n255 255 255\n255 255 255\n");
  folder.write(
      "models/cart.json",
      R"({"name": "cart", "footprint": [[0.1, -0.1], [0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1]]})");
  const Task task = task_in(folder, R"({
    "$schema": "../schema/world.schema.json",  // relative, too
    "arena": {"map": {"image": "sub/plan.pgm", "resolution": 1}},
    "robots": [{"name": "r1", "model": "models/cart.json", "pose": {"x": 1, "y": 1}},
               {"name": "r2", "model": "s1r"}]})",
                            true);
  const IndividualWorld own = first_world(task);
  EXPECT_TRUE(own.has_own_start);
  EXPECT_THAT(own.text, HasSubstr('"' + folder / "sub/plan.pgm" + '"'));
  EXPECT_THAT(own.text, HasSubstr('"' + folder / "models/cart.json" + '"'));
  EXPECT_THAT(own.text, HasSubstr("\"s1r\""));
  EXPECT_THAT(own.text, Not(HasSubstr("$schema")));
  const TemporaryFolder other;
  sim::WorldDescription world = sim::load_world(other.write("w.json", own.text));
  const sim::WorldDescription original = sim::load_world(task.worlds.front().file);
  EXPECT_EQ(world.robots.at(1).pose, original.robots.at(1).pose);
  // Apart from the model's name it is the same world.
  auto model = world.models.extract(folder / "models/cart.json");
  ASSERT_FALSE(model.empty());
  model.key() = world.robots.at(0).model = "models/cart.json";
  world.models.insert(std::move(model));
  EXPECT_EQ(sim::world_hash(undone(world, original, 0)), sim::world_hash(original));
}

TEST(IndividualWorld, ListOfMaps_AbsoluteNames) {
  const TemporaryFolder folder;
  folder.write("plan.pgm", "P2\n3 2\n255\n255 255 255\n255 255 255\n");
  const Task task = task_in(folder, R"({"arena": {"map": [
    {"image": "plan.pgm", "resolution": 1}, {"image": "plan.pgm", "resolution": 1}]}})");
  EXPECT_NO_THROW(static_cast<void>(sim::load_world_text(first_world(task).text, "x/w.json")));
}

TEST(IndividualWorld, DefaultWorld_Supported) {
  Task task;
  task.name = "test";
  task.worlds = {{"", {}, {}}};
  const IndividualWorld own = first_world(task);
  EXPECT_TRUE(own.has_own_start);
  const sim::WorldDescription original = sim::load_world("");
  EXPECT_EQ(sim::world_hash(undone(sim::load_world_text(own.text), original, 0)),
            sim::world_hash(original));
}

TEST(IndividualWorld, UnusableWorlds_Refused) {
  const TemporaryFolder folder;
  const auto id_of = [](const Task& task) {
    try {
      static_cast<void>(first_world(task));
    } catch (const sim::ConfigError& error) {
      return error.issues().front().id;
    }
    return std::string("none");
  };
  EXPECT_EQ(id_of(task_in(folder, "{\"robots\": [}")), "json/syntax");
  EXPECT_EQ(id_of(task_in(folder, "{\"robotz\": []}")), "world/unknown-key");
  EXPECT_EQ(id_of(task_in(folder, "{\"robots\": []}")), "task/unknown-robot");
  Task stage = task_in(folder, "{}");
  stage.worlds = {
      {folder.write("simple.world", "size [4 4]\nposition(name \"r1\" pose [0 0 0 0])\n"), {}, {}}};
  EXPECT_EQ(id_of(stage), "task/world-of-stage");
  stage.worlds = {{folder / "none.json", {}, {}}};
  EXPECT_EQ(id_of(stage), "file/missing");
}

TEST(IndividualSeeds, DifferentAndRepeatable) {
  Task task;
  task.name = "test";
  task.seeds.assign(100, 0);
  const std::vector<std::uint64_t> seeds = individual_seeds(task, "novak");
  EXPECT_EQ(seeds, individual_seeds(task, "novak"));
  EXPECT_NE(seeds, individual_seeds(task, "svoboda"));
  EXPECT_EQ(std::set<std::uint64_t>(seeds.begin(), seeds.end()).size(), 100U);
  EXPECT_GE(*std::ranges::min_element(seeds), 1U);
  EXPECT_LE(*std::ranges::max_element(seeds), 999'999'999U);
}

TEST(IndividualTask, WritesWorldsOfStudent) {
  const TemporaryFolder folder;
  const Task task = shipped("par_planning");
  const IndividualTask own = individual_task(task, "novak", folder / "a/b");
  ASSERT_THAT(own.task.worlds, SizeIs(2));
  ASSERT_THAT(own.sentences, SizeIs(3));
  for (std::size_t i = 0; i < 2; ++i) {
    const TaskWorld& world = own.task.worlds[i];
    EXPECT_EQ(world_name(world.file), world_name(task.worlds[i].file));
    EXPECT_EQ(world.arguments, task.worlds[i].arguments);
    EXPECT_TRUE(world.goal);
    const IndividualWorld expected = individual_world(task, task.worlds[i], "novak");
    EXPECT_EQ(test_support::read_bytes(world.file), expected.text);
    EXPECT_EQ(own.sentences[i], expected.sentence);
  }
  EXPECT_EQ(own.task.seeds, individual_seeds(task, "novak"));
  EXPECT_THAT(own.sentences[2], HasSubstr("seeds " + std::to_string(own.task.seeds[0]) + ", "));
  EXPECT_THAT(own.sentences[2], HasSubstr(" and " + std::to_string(own.task.seeds[4])));
}

TEST(IndividualTask, FolderIsFile_Throws) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  EXPECT_THROW(static_cast<void>(individual_task(shipped("par_intro"), "novak", file)),
               std::runtime_error);
}

}  // namespace
}  // namespace playpen::grade
