// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fuzz/situations.h"

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
    scenario.elements = {box, door, mover};
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
  // A box, two parts of a door, a circle, after those of the arena.
  EXPECT_THAT(world.arena.obstacles, SizeIs(base.world().arena.obstacles.size() + 4));
  EXPECT_TRUE(world.arena.obstacles.back().motion);
  const auto text = nlohmann::json::parse(made->text);
  EXPECT_EQ(text["robots"][0]["devices"]["laser"]["latency"], 0.15);
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
  for (int i = 0; i < 40; ++i) {
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
