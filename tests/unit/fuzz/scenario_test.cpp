// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "fuzz/situations.h"
#include "temporary_folder.h"

namespace playpen::fuzz {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;

constexpr const char* kIntroWorld = PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json";

class ScenarioTest : public testing::Test {
 protected:
  // A scenario with one of everything.
  static Scenario full() {
    Scenario scenario;
    scenario.seed = 7;
    scenario.start = grade::StartPose{0.63, 0.72, 30};
    Element box;
    box.center = {2.93, 3.31};
    box.size = {0.13, 0.07};
    box.yaw_deg = 20;
    Element door;
    door.shape = Element::Shape::kDoor;
    door.center = {1.2, 2.4};
    door.size = {0.9, 0.05};
    door.opening_m = 0.4;
    Element mover;
    mover.shape = Element::Shape::kCircle;
    mover.center = {1.2, 3.5};
    mover.size = {0.1, 0.1};
    mover.moves = true;
    mover.goes_to = {1.5, 3.5};
    mover.speed_mps = 0.2;
    Element corridor;
    corridor.shape = Element::Shape::kCorridor;
    corridor.center = {1.8, 0.6};
    corridor.size = {0.5, 0.05};
    corridor.opening_m = 0.32;
    scenario.elements = {box, door, mover, corridor};
    scenario.faults = {
        {.kind = DeviceFault::Kind::kDead, .device = "laser", .at_s = 12.3},
        {.kind = DeviceFault::Kind::kGap, .device = "laser", .at_s = 4.0, .for_s = 1.5},
        {.kind = DeviceFault::Kind::kJump, .device = "odometry", .x_m = 0.2, .yaw_deg = 30},
        {.kind = DeviceFault::Kind::kDrift, .device = "odometry", .scale = 1.13}};
    scenario.extended = {{"d1"}};
    scenario.real = true;
    scenario.latency_s = 0.15;
    scenario.dropouts = 0.05;
    return scenario;
  }

  const Base base{kIntroWorld, ""};
};

TEST_F(ScenarioTest, World_HasWhatTheScenarioAdds) {
  const auto made = base.world_of(full());
  ASSERT_TRUE(made);
  const sim::WorldDescription& world = made->description;
  EXPECT_EQ(world.simulation.seed, 7U);
  EXPECT_EQ(world.simulation.realism, sim::Realism::kReal);
  EXPECT_EQ(world.robots[0].pose.x_m, 0.63);
  // A box, two parts of a door, a circle, two walls of a corridor, after those of the arena.
  const std::size_t before = base.world().arena.obstacles.size();
  ASSERT_THAT(world.arena.obstacles, SizeIs(before + 6));
  EXPECT_TRUE(world.arena.obstacles[before + 3].motion);
  // The corridor is free from 0.44 m to 0.76 m.
  EXPECT_NEAR(world.arena.obstacles[before + 4].center.y(), 0.44 - 0.025, 0.006);
  EXPECT_NEAR(world.arena.obstacles[before + 5].center.y(), 0.76 + 0.025, 0.006);
  ASSERT_THAT(world.controller.timers, SizeIs(4));
  const auto& gap = std::get<sim::FaultAction>(world.controller.timers[2].actions.at(0));
  EXPECT_EQ(gap.kind, sim::FaultAction::Kind::kNone);
  EXPECT_EQ(world.controller.timers[2].at_s, 5.5);
  const auto text = nlohmann::json::parse(made->text);
  EXPECT_EQ(text["robots"][0]["devices"]["laser"]["latency"], 0.15);
  EXPECT_EQ(text["robots"][0]["devices"]["odometry"]["scale"], 1.13);
  // The other settings of the laser are as before.
  EXPECT_EQ(text["robots"][0]["devices"]["laser"]["frequency"], 10);
}

TEST_F(ScenarioTest, PlainScenario_IsTheWorld) {
  const auto made = base.world_of({});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->description.arena.obstacles.size(), base.world().arena.obstacles.size());
  EXPECT_EQ(made->description.robots[0].pose, base.world().robots[0].pose);
}

TEST_F(ScenarioTest, StartInOrAtAnObstacle_NoWorld) {
  Scenario scenario;
  scenario.start = grade::StartPose{0.12, 0.5, 0};  // 2 cm from the border
  EXPECT_FALSE(base.world_of(scenario));
  scenario.start.reset();
  Element box;
  box.center = base.world().robots[0].pose.position();
  scenario.elements = {box};
  EXPECT_FALSE(base.world_of(scenario));
}

TEST_F(ScenarioTest, ThingBesideTheWorldsOwnStart_NoWorld) {
  const sim::Vec2 start = base.robot_description().pose.position();
  Scenario scenario;
  scenario.elements = {{.size = {0.1, 0.1}}};
  const double touching_m = base.robot_radius_m() + 0.05;
  scenario.elements[0].center = {start.x() + touching_m + 0.05, start.y()};
  EXPECT_FALSE(base.world_of(scenario));
  scenario.elements[0].center.x() += 0.1;
  EXPECT_TRUE(base.world_of(scenario));
}

TEST_F(ScenarioTest, Random_DependsOnTheStreamOnlyAndMostAreWorlds) {
  int worlds = 0;
  for (int i = 0; i < 50; ++i) {
    sim::RandomStream one(3, std::to_string(i));
    sim::RandomStream other(3, std::to_string(i));
    const Scenario scenario = base.random(one);
    EXPECT_EQ(description_of(scenario), description_of(base.random(other)));
    worlds += base.world_of(scenario) ? 1 : 0;
    EXPECT_EQ(description_of(base.mutated(scenario, one)),
              description_of(base.mutated(scenario, other)));
  }
  EXPECT_GT(worlds, 10);
}

TEST_F(ScenarioTest, Freedom_LimitsWhatChanges) {
  const Base still(kIntroWorld, "r1",
                   {.starts = false, .moving = false, .blocks = false, .noise = false});
  sim::RandomStream random(1, "");
  for (int i = 0; i < 100; ++i) {
    const Scenario scenario = still.mutated(still.random(random), random);
    EXPECT_FALSE(scenario.start || scenario.extended || scenario.real);
    EXPECT_EQ(scenario.latency_s, 0.0);
    EXPECT_TRUE(std::ranges::none_of(scenario.elements, &Element::moves));
  }
}

TEST_F(ScenarioTest, Simpler_EachRemovesOrRoundsOneThing) {
  const Scenario scenario = full();
  const std::vector<Scenario> all = simpler(scenario);
  EXPECT_GT(all.size(), 12U);
  for (const Scenario& one : all) {
    EXPECT_LE(weight_of(one), weight_of(scenario)) << description_of(one);
  }
  EXPECT_TRUE(std::ranges::any_of(all, [](const Scenario& s) { return s.elements.empty(); }));
  // Step by step everything goes.
  Scenario now = scenario;
  for (int i = 0; i < 60; ++i) {
    const std::vector<Scenario> next = simpler(now);
    if (next.empty()) break;
    now = *std::ranges::min_element(next, {}, weight_of);
  }
  EXPECT_EQ(weight_of(now), 0U);
  EXPECT_EQ(description_of(now), "the world as it is");
}

TEST_F(ScenarioTest, Description_NamesEverything) {
  EXPECT_THAT(description_of(full()),
              AllOf(HasSubstr("a box of 0.13 m x 0.07 m at (2.93, 3.31)"),
                    HasSubstr("a wall of 0.9 m with a door of 0.4 m at (1.2, 2.4)"),
                    HasSubstr("a round obstacle of 0.1 m at (1.2, 3.5) that moves to (1.5, 3.5) "
                              "and back at 0.2 m/s"),
                    HasSubstr("the start (0.63, 0.72), 30 degrees"), HasSubstr("raised blocks d1"),
                    HasSubstr("a corridor of 0.5 m that is 0.32 m wide at (1.8, 0.6)"),
                    HasSubstr("the device laser dead from 12.3 s on"),
                    HasSubstr("the device laser without readings for 1.5 s from 4 s on"),
                    HasSubstr("the device odometry that jumps by 0.2 m and 30 degrees at 1 s"),
                    HasSubstr("the device odometry that measures 1.13 times the distance"),
                    HasSubstr("late by 0.15 s"), HasSubstr("loses 5 % of its beams"),
                    HasSubstr(" and seed 7")));
}

TEST_F(ScenarioTest, Situations_CountNewOnesOnce) {
  const auto world = base.world_of({});
  ASSERT_TRUE(world);
  RunResult result;
  result.trajectories = {{.robot = "r1",
                          .time_s = {0.0, 0.1, 1.0},
                          .X_WB = {{0.5, 0.4, 0.0}, {0.5, 0.4, 0.0}, {1.2, 0.4, 1.57}},
                          .v_mps = {0.0, 0.0, 0.2},
                          .omega_radps = {0.0, 0.0, 0.0}}};
  Situations situations;
  const std::vector<Situations::Id> two = Situations::of(result, base, *world);
  EXPECT_EQ(situations.add(two), 2U);
  EXPECT_EQ(situations.add(two), 0U);
  EXPECT_EQ(situations.count(), 2U);
}

TEST_F(ScenarioTest, ManyElements_AreLeftOutInHalves) {
  Scenario scenario;
  scenario.elements.resize(8);
  std::set<std::size_t> sizes;
  for (const Scenario& one : simpler(scenario)) sizes.insert(one.elements.size());
  // Without all, four, two and one of them.
  EXPECT_EQ(sizes, (std::set<std::size_t>{0, 4, 6, 7}));
}

TEST_F(ScenarioTest, MapOfManyWalls_IsOnePhrase) {
  Scenario scenario;
  Element wall;
  wall.of_map = true;
  scenario.elements.assign(5, wall);
  EXPECT_THAT(description_of(scenario), HasSubstr("a wall of 0.1 m x 0.1 m at (0, 0), a wall"));
  scenario.elements.push_back(wall);
  EXPECT_EQ(description_of(scenario), "a map of 6 walls");
}

/// A world file with a section "fuzz".
class FuzzSection : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& section) const {
    std::ofstream(folder_ / "world.json")
        << R"({"arena": {"size": [6, 4]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1},
             "devices": {"laser": {}}}], "fuzz": )"
        << section << '}';
    return folder_ / "world.json";
  }
  const test_support::TemporaryFolder folder_;
};

TEST_F(FuzzSection, BoundsHoldInAllScenarios) {
  const Base base(file(R"({
      "without": ["starts"], "with": ["faults"],
      "area": {"center": [3, 2], "size": [2, 1]},
      "obstacles": {"most": 2, "size": [0.05, 0.2], "shapes": ["circle", "corridor"]},
      "corridors": {"width": [0.4, 0.5]},
      "moving": {"speed": [0.1, 0.15]},
      "noise": {"real": false, "latency": [0.01, 0.02], "dropouts": [0.5, 0.6]},
      "faults": {"most": 1, "kinds": ["gap"], "at": [3, 4]}})"),
                  "", {.maps = false});
  sim::RandomStream random(1, "");
  int faults = 0;
  for (int i = 0; i < 200; ++i) {
    const Scenario one = base.mutated(base.random(random), random);
    EXPECT_FALSE(one.start);
    EXPECT_LE(one.elements.size(), 2U);
    for (const Element& element : one.elements) {
      EXPECT_LE((element.center - sim::Vec2(3, 2)).cwiseAbs().x(), 1.001);
      EXPECT_LE((element.center - sim::Vec2(3, 2)).cwiseAbs().y(), 0.501);
      if (element.shape == Element::Shape::kCorridor) {
        EXPECT_FALSE(element.moves);
        EXPECT_GE(element.opening_m, 0.4);
        EXPECT_LE(element.opening_m, 0.5);
      } else {
        EXPECT_EQ(element.shape, Element::Shape::kCircle);
        EXPECT_GE(element.size.x(), 0.05);
        EXPECT_LE(element.size.x(), 0.2);
      }
      if (element.moves) {
        EXPECT_NEAR(element.speed_mps, 0.125, 0.026);
      }
    }
    EXPECT_FALSE(one.real);
    if (one.latency_s > 0.0) {
      EXPECT_NEAR(one.latency_s, 0.015, 0.006);
    }
    if (one.dropouts > 0.0) {
      EXPECT_NEAR(one.dropouts, 0.55, 0.06);
    }
    EXPECT_LE(one.faults.size(), 1U);
    for (const DeviceFault& fault : one.faults) {
      ++faults;
      EXPECT_EQ(fault.kind, DeviceFault::Kind::kGap);
      EXPECT_NEAR(fault.at_s, 3.5, 0.51);
    }
  }
  EXPECT_GT(faults, 20);
}

TEST_F(FuzzSection, SimplerScenario_StaysWithinBounds) {
  const Base base(file(R"({
      "without": ["moving"], "area": {"center": [3, 2], "size": [2, 1]},
      "obstacles": {"size": [0.1, 0.2], "shapes": ["box", "door"]},
      "doors": {"width": [0.42, 0.44]}})"),
                  "");
  Scenario scenario;
  scenario.start = grade::StartPose{3.0, 2.0, 0};
  Element box;
  box.center = {3.2, 2.2};
  Element door = box;
  door.shape = Element::Shape::kDoor;
  door.opening_m = 0.43;
  scenario.elements = {box, door};
  EXPECT_TRUE(base.allows(scenario));
  const auto expect_refused = [&](const auto& change) {
    Scenario other = scenario;
    change(other);
    EXPECT_FALSE(base.allows(other)) << description_of(other);
  };
  expect_refused([](Scenario& s) { s.start->x_m = 4.1; });
  expect_refused([](Scenario& s) { s.elements[0].center.y() = 2.6; });
  expect_refused([](Scenario& s) { s.elements[0].size.y() = 0.3; });
  expect_refused([](Scenario& s) { s.elements[0].shape = Element::Shape::kCircle; });
  expect_refused([](Scenario& s) { s.elements[0].moves = true; });
  expect_refused([](Scenario& s) { s.elements[1].opening_m = 0.4; });
}

TEST_F(FuzzSection, CommandNarrowsIt) {
  const std::string name = file(R"({"with": ["faults"], "without": ["maps"]})");
  EXPECT_TRUE(*Base(name, "").freedom().faults);
  const Base narrow(name, "", {.blocks = false, .faults = false});
  EXPECT_FALSE(*narrow.freedom().faults);
  EXPECT_FALSE(narrow.freedom().blocks);
  EXPECT_FALSE(narrow.freedom().maps);
  EXPECT_TRUE(narrow.freedom().starts);
  EXPECT_FALSE(*Base(file("{}"), "").freedom().faults);
}

TEST_F(FuzzSection, TaskReplacesKeys) {
  std::ofstream(folder_ / "own.task.json")
      << R"({"worlds": ["world.json"], "fuzz": {"without": ["noise"]}})";
  const Base base(file(R"({"without": ["starts"]})"), "", {.task_file = folder_ / "own.task.json"});
  EXPECT_TRUE(base.freedom().starts);
  EXPECT_FALSE(base.freedom().noise);
}

TEST_F(FuzzSection, AreaWithoutPlace_Error) {
  const std::string name = file(R"({"area": {"center": [9, 2], "size": [2, 1]}})");
  EXPECT_THAT([&] { Base(name, ""); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no place for the robot")));
}

TEST_F(FuzzSection, OnlyOpenWorldsGetMaps) {
  const Base open(file("{}"), "");
  EXPECT_TRUE(open.freedom().maps);
  int maps = 0;
  for (int i = 0; i < 60; ++i) {
    sim::RandomStream random(1, std::to_string(i));
    const Scenario one = open.random(random);
    const bool has_map = std::ranges::any_of(one.elements, &Element::of_map);
    maps += has_map && open.world_of(one) ? 1 : 0;
  }
  EXPECT_GT(maps, 3);
  EXPECT_FALSE(Base(kIntroWorld, "").freedom().maps);
  std::ofstream(folder_ / "full.json")
      << R"({"arena": {"size": [2, 2], "obstacles": [{"center": [1.25, 1], "size": [1.5, 2]}]},
             "robots": [{"pose": {"x": 0.2, "y": 1}}]})";
  EXPECT_FALSE(Base(folder_ / "full.json", "").freedom().maps);
}

TEST(FuzzBase, UnknownRobot_Error) {
  EXPECT_THAT([] { Base(kIntroWorld, "r9"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no robot 'r9'")));
}

}  // namespace

TEST_F(ScenarioTest, Situations_CountRunsOfPrintedPairs) {
  const auto world = base.world_of({});
  ASSERT_TRUE(world);
  const auto printed = [&](const std::string& text) {
    RunResult result;
    result.printed = text;
    return Situations::of(result, base, *world);
  };
  // The first line follows on nothing. Numbers do not matter.
  EXPECT_EQ(printed("left 0.25\n"), printed("left -1.5\n"));
  EXPECT_EQ(printed("left\nright\n").size(), 2U);
  // nothing-left, left-right and right-left: once, twice or three times, twice or three times
  EXPECT_EQ(printed("left\nright\nleft\nright\nleft\nright\n").size(), 1U + 2U + 2U);
  Situations situations;
  const std::vector<Situations::Id> often = printed("left\n");
  const std::vector<Situations::Id> rare = printed("left\nright\n");
  EXPECT_EQ(situations.runs_of_rarest(often), 0U);
  situations.add(often);
  situations.add(often);
  situations.add(rare);
  EXPECT_EQ(situations.runs_of_rarest(often), 3U);
  EXPECT_EQ(situations.runs_of_rarest(rare), 1U);
}

TEST_F(ScenarioTest, TimeToContact_IsLeastWhereRobotDrivesTowardsWall) {
  const auto world = base.world_of({});
  ASSERT_TRUE(world);
  RunResult result;
  result.trajectories = {{.robot = "r1",
                          .time_s = {0.0, 0.1},
                          .X_WB = {{0.5, 0.4, 0.0}, {0.5, 0.4, std::numbers::pi}},
                          .v_mps = {0.0, 0.0},
                          .omega_radps = {0.0, 0.0}}};
  EXPECT_TRUE(std::isinf(least_time_to_contact_s(result, base, *world)));
  // Towards the arena's edge at x = 0. The distances are those of a grid of 2 cm.
  result.trajectories[0].v_mps[1] = 0.2;
  const double expected_s = (0.5 - base.robot_radius_m()) / 0.2;
  EXPECT_NEAR(least_time_to_contact_s(result, base, *world), expected_s, 0.04 / 0.2);
}

}  // namespace playpen::fuzz
