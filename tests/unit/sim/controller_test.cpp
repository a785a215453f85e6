// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The arena controller: timers, traps, conditions and actions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"
#include "simulation_runs.h"

namespace sim {
namespace {

using test::drive;
using test::run;
using testing::AllOf;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Le;
using testing::SizeIs;

// Two robots that face along x at (1, 2) and (1, 3) in a room of 4 x 4 m with two dynamic blocks
// and a box. A step takes 0.01 s.
WorldDescription room(const std::string& controller, const std::string& more = "") {
  return load_world_text(R"({"arena": {"size": [4, 4], "obstacles": [
      {"name": "d1", "center": [3, 1], "type": "dynamic", "state": "retracted"},
      {"name": "d2", "center": [3, 0.5], "type": "dynamic"},
      {"name": "puck", "center": [0.5, 0.5], "fiducial": 7, "portable": true}]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}, "devices": {"battery": {}, "fiducial": {}}},
               {"name": "r2", "pose": {"x": 1, "y": 3}}],
    "controller": {)" + controller +
                         "}" + more + "}");
}

WorldDescription timer_room(const std::string& timer) {
  return room(R"("timers": [{"name": "t", )" + timer + "}]");
}

WorldDescription trap_room(const std::string& trap) {
  return room(R"("traps": [{"name": "p", )" + trap + "}]");
}

// Each event as "time kind what who text value", without what is empty.
std::vector<std::string> events_of(const Simulation& simulation) {
  std::vector<std::string> lines;
  for (const ArenaEvent& event : simulation.arena_events().newest) {
    std::string line = fixed_text(to_seconds(event.time_ns), 2) + ' ';
    line += to_string(event.kind);
    for (const std::string& word : {event.what, event.who, event.text}) {
      if (!word.empty()) line += ' ' + word;
    }
    if (event.value != 0.0) line += ' ' + shortest_text(event.value);
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> events_after(WorldDescription world, double duration_s) {
  Simulation simulation(std::move(world));
  run(simulation, duration_s);
  return events_of(simulation);
}

// Times of the events of one kind [s].
std::vector<double> times_of(const Simulation& simulation, ArenaEventKind kind) {
  std::vector<double> times;
  for (const ArenaEvent& event : simulation.arena_events().newest) {
    if (event.kind == kind) times.push_back(to_seconds(event.time_ns));
  }
  return times;
}

SceneObject block(const Simulation& simulation, const std::string& name) {
  return simulation.find_object(name).value();
}

// --- Timers

TEST(ArenaTimer, ActsOnceAtItsTime) {
  EXPECT_THAT(events_after(timer_room(R"("at": 0.5, "do": [{"message": "now"}])"), 2.0),
              ElementsAre("0.50 timer t", "0.50 message t now"));
}

TEST(ArenaTimer, NoTime_ActsAtStart) {
  EXPECT_THAT(events_after(timer_room(R"("do": [])"), 0.01), ElementsAre("0.00 timer t"));
}

TEST(ArenaTimer, ActsPeriodically) {
  EXPECT_THAT(events_after(timer_room(R"("every": 0.5)"), 1.6),
              ElementsAre("0.50 timer t", "1.00 timer t", "1.50 timer t"));
  EXPECT_THAT(events_after(timer_room(R"("at": 0.2, "every": 0.5, "times": 2)"), 3.0),
              ElementsAre("0.20 timer t", "0.70 timer t"));
}

TEST(ArenaTimer, LongStep_ActsSeveralTimes) {
  EXPECT_THAT(events_after(timer_room(R"("at": 0.001, "every": 0.005)"), 0.01), SizeIs(2));
}

TEST(ArenaTimer, Jitter_ShiftsTimes) {
  Simulation simulation(timer_room(R"("every": 1, "jitter": 0.4)"));
  run(simulation, 400.0);
  const std::vector<double> times = times_of(simulation, ArenaEventKind::kTimer);
  ASSERT_GE(times.size(), 399U);
  double sum_s = 0.0;
  double least_s = 1.0;
  double most_s = -1.0;
  for (std::size_t i = 0; i < 399; ++i) {
    const double shift_s = times[i] - static_cast<double>(i + 1);
    sum_s += shift_s;
    least_s = std::min(least_s, shift_s);
    most_s = std::max(most_s, shift_s);
  }
  // Uniform in [-0.4, 0.4), then up to the end of the step: the mean is half a step. Four standard
  // errors of a mean are 4 * 0.8 / sqrt(12 * 399) = 0.046 s.
  EXPECT_NEAR(sum_s / 399.0, 0.005, 0.046);
  EXPECT_THAT(least_s, AllOf(Ge(-0.4), Le(-0.36)));
  EXPECT_THAT(most_s, AllOf(Ge(0.36), Le(0.411)));
}

TEST(ArenaTimer, RandomTime_FromSeed) {
  const auto first = [](const char* seed) {
    Simulation simulation(room(R"("timers": [{"name": "t", "within": [1, 9]}])",
                               R"(, "simulation": {"seed": )" + std::string(seed) + "}"));
    run(simulation, 9.02);
    const std::vector<double> times = times_of(simulation, ArenaEventKind::kTimer);
    EXPECT_THAT(times, ElementsAre(AllOf(Ge(1.0), Le(9.01))));
    return times.at(0);
  };
  EXPECT_EQ(first("1"), first("1"));
  EXPECT_NE(first("1"), first("2"));
}

TEST(ArenaTimer, Enabled_TimesCountFromThen) {
  Simulation simulation(timer_room(R"("at": 0.5, "enabled": false)"));
  run(simulation, 1.0);
  EXPECT_THAT(events_of(simulation), IsEmpty());
  EXPECT_EQ(simulation.timer_or_trap_enabled("t"), false);
  EXPECT_FALSE(simulation.set_timer_enabled("t", true));
  EXPECT_FALSE(simulation.set_timer_enabled("t", true));  // nothing changes
  run(simulation, 1.0);
  EXPECT_THAT(events_of(simulation), ElementsAre("1.00 enabled t", "1.50 timer t"));
  EXPECT_EQ(simulation.timer_or_trap_enabled("t"), false);  // its last time is over
  EXPECT_FALSE(simulation.set_timer_enabled("t", true));
  EXPECT_FALSE(simulation.set_timer_enabled("t", false));
  run(simulation, 1.0);
  EXPECT_EQ(times_of(simulation, ArenaEventKind::kTimer), std::vector<double>{1.5});
}

TEST(ArenaTimer, FalseCondition_SkipsAction) {
  // It acts at the first second after 2.5 s, and then no more.
  EXPECT_THAT(
      events_after(timer_room(R"("every": 1, "times": 1, "if": [{"time": {"from": 2.5}}])"), 6.0),
      ElementsAre("3.00 timer t"));
}

TEST(ArenaTimer, MayEnableItselfAgain) {
  EXPECT_THAT(events_after(timer_room(R"("at": 0.2, "do": [{"enable": ["t"]}])"), 0.45),
              ElementsAre("0.20 timer t", "0.20 enabled t", "0.40 timer t", "0.40 enabled t"));
  // Once in a step, even without a delay.
  EXPECT_THAT(events_after(timer_room(R"("do": [{"enable": ["t"]}])"), 0.02), SizeIs(6));
}

// --- Traps

// A robot at 0.5 m/s from x = 1 reaches x = 1.5 after 1 s, and a little later because it speeds up
// within a step.
constexpr const char* kBox = R"("region": {"box": {"center": [1.75, 2], "size": [0.5, 0.5]}})";

TEST(ArenaTrap, RobotEntersOrLeaves_Springs) {
  for (const auto& [on, least_s] : {std::pair("enter", 1.0), std::pair("leave", 2.0)}) {
    Simulation simulation(trap_room(std::string(kBox) + R"(, "on": ")" + on + '"'));
    drive(simulation, 0.5);
    run(simulation, 3.0);
    EXPECT_THAT(times_of(simulation, ArenaEventKind::kTrap),
                ElementsAre(AllOf(Ge(least_s), Le(least_s + 0.05))));
    EXPECT_EQ(simulation.arena_events().newest.front().who, "r1");
    EXPECT_EQ(simulation.arena_events().newest.front().text, on);
  }
}

TEST(ArenaTrap, Stay_SpringsOnce) {
  Simulation simulation(trap_room(std::string(kBox) + R"(, "on": "stay", "for": 0.5)"));
  drive(simulation, 0.5);
  run(simulation, 4.0);
  EXPECT_THAT(times_of(simulation, ArenaEventKind::kTrap), ElementsAre(AllOf(Ge(1.5), Le(1.55))));
  drive(simulation, -0.5);
  run(simulation, 4.0);
  EXPECT_THAT(simulation.arena_events().newest, SizeIs(2));
}

TEST(ArenaTrap, Stay_SpringsWhenConditionsHold) {
  Simulation simulation(trap_room(
      std::string(kBox) + R"(, "on": "stay", "for": 0.2, "if": [{"speed": {"at_most": 0.01}}])"));
  drive(simulation, 0.5);
  run(simulation, 1.5);
  EXPECT_THAT(events_of(simulation), IsEmpty());
  drive(simulation, 0.0);
  run(simulation, 1.0);
  EXPECT_THAT(events_of(simulation), ElementsAre(HasSubstr("trap p r1 stay")));
}

TEST(ArenaTrap, RobotInsideAtStart_CountsAsEntering) {
  const std::string here = R"("region": {"circle": {"center": [1, 2], "radius": 0.1}})";
  EXPECT_THAT(events_after(trap_room(here), 0.1), ElementsAre("0.00 trap p r1 enter"));
  EXPECT_THAT(events_after(trap_room(here + R"(, "on": "leave")"), 0.1), IsEmpty());
  EXPECT_THAT(events_after(trap_room(here + R"(, "on": "stay", "for": 0.05)"), 0.1),
              ElementsAre("0.05 trap p r1 stay"));
}

TEST(ArenaTrap, Shapes_All) {
  // r1 drives along y = 2 and meets each region at x = 1.5; a polygon is not convex here, and r1
  // crosses its two arms.
  const std::vector<std::pair<const char*, int>> shapes = {
      {R"("region": {"circle": {"center": [1.7, 2], "radius": 0.2}})", 1},
      {R"("region": {"box": {"center": [2, 2], "size": [0.70710678, 0.70710678], "yaw_deg": 45}})",
       1},
      {R"("region": {"polygon": [[1.5, 1.5], [1.5, 2.5], [1.6, 2.5], [1.6, 1.7], [1.8, 1.7],
           [1.8, 2.5], [1.9, 2.5], [1.9, 1.5]]})",
       2},
      {R"("near": {"place": [2, 2], "distance": 0.5})", 1}};
  for (const auto& [shape, entries] : shapes) {
    Simulation simulation(trap_room(shape));
    drive(simulation, 0.5);
    run(simulation, 3.0);
    const std::vector<double> times = times_of(simulation, ArenaEventKind::kTrap);
    ASSERT_EQ(times.size(), static_cast<std::size_t>(entries)) << shape;
    EXPECT_THAT(times.front(), AllOf(Ge(1.0), Le(1.05))) << shape;
  }
}

// More traps than are tested while a robot is near others.
TEST(ArenaTrap, EachTrapOnPath_Springs) {
  constexpr int kTraps = 12;
  std::string traps;
  for (int i = 0; i < kTraps; ++i) {
    traps += std::string(i == 0 ? "" : ", ") + R"({"name": "p)" + std::to_string(i) +
             R"(", "region": {"circle": {"center": [)" + fixed_text(1.2 + 0.18 * i, 2) +
             R"(, 2], "radius": 0.05}}})";
  }
  Simulation simulation(room(R"("traps": [)" + traps + "]"));
  drive(simulation, 0.5);
  run(simulation, 5.0);  // 2.5 m; the last trap begins 2.13 m ahead
  const std::vector<double> times = times_of(simulation, ArenaEventKind::kTrap);
  ASSERT_THAT(times, SizeIs(kTraps));
  // From border to border a robot drives 0.18 m, in 0.36 s.
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_NEAR(times[i] - times[i - 1], 0.36, 0.011) << i;
  }
}

TEST(ArenaTrap, FollowsRobotOrObstacle) {
  // The robots are 1 m apart. r2 is near itself, but springs nothing.
  Simulation near_robot(trap_room(R"("near": {"object": "r2", "distance": 0.8})"));
  run(near_robot, 0.1);
  EXPECT_THAT(events_of(near_robot), IsEmpty());
  ASSERT_FALSE(near_robot.place_object("r2", {1.0, 2.7, 0.0}));
  run(near_robot, 0.1);
  EXPECT_THAT(events_of(near_robot), ElementsAre("0.11 trap p r1 enter"));

  Simulation near_block(trap_room(R"("near": {"object": "puck", "distance": 0.5})"));
  run(near_block, 0.1);
  EXPECT_THAT(events_of(near_block), IsEmpty());
  ASSERT_FALSE(near_block.place_object("puck", {1.4, 2.0, 0.0}));
  run(near_block, 0.1);
  EXPECT_THAT(events_of(near_block), ElementsAre("0.11 trap p r1 enter"));
}

TEST(ArenaTrap, SelectedRobotsOnly) {
  const std::string everywhere = R"("region": {"box": {"center": [2, 2], "size": [4, 4]}})";
  EXPECT_THAT(events_after(trap_room(everywhere + R"(, "robots": "any")"), 0.01), SizeIs(2));
  EXPECT_THAT(events_after(trap_room(everywhere + R"(, "robots": ["r2"])"), 0.01),
              ElementsAre("0.00 trap p r2 enter"));
  EXPECT_THAT(events_after(trap_room(everywhere + R"(, "model": "s1r")"), 0.01), SizeIs(2));
  WorldDescription world = trap_room(everywhere + R"(, "model": "s1r")");
  world.robots[0].model = "other";
  auto model = std::make_shared<RobotModel>(default_robot_model());
  model->name = "other";
  world.models.emplace("other", model);
  EXPECT_THAT(events_after(std::move(world), 0.01), ElementsAre("0.00 trap p r2 enter"));
}

TEST(ArenaTrap, MaySpringOnceOnly) {
  const std::string here = R"("region": {"circle": {"center": [1, 2.5], "radius": 1}}, "once": )";
  EXPECT_THAT(events_after(trap_room(here + "true"), 0.1), SizeIs(1));
  EXPECT_THAT(events_after(trap_room(here + "false"), 0.1), SizeIs(2));
}

TEST(ArenaTrap, Enabled_EmptyAtFirst) {
  Simulation simulation(
      trap_room(R"("enabled": false, "region": {"circle": {"center": [1, 2], "radius": 0.1}})"));
  run(simulation, 0.1);
  EXPECT_THAT(events_of(simulation), IsEmpty());
  EXPECT_EQ(simulation.timer_or_trap_enabled("p"), false);
  EXPECT_FALSE(simulation.set_trap_enabled("p", true));
  run(simulation, 0.1);
  EXPECT_FALSE(simulation.set_trap_enabled("p", false));
  EXPECT_FALSE(simulation.set_trap_enabled("p", true));
  run(simulation, 0.1);
  EXPECT_THAT(events_of(simulation),
              ElementsAre("0.10 enabled p", "0.11 trap p r1 enter", "0.20 disabled p",
                          "0.20 enabled p", "0.21 trap p r1 enter"));
}

// --- Conditions

// Whether a trap around r1, which stands still, springs at the start with this condition.
bool springs(const std::string& condition) {
  return !events_after(trap_room(R"("region": {"circle": {"center": [1, 2], "radius": 0.1}},
                                    "if": [)" +
                                 condition + "]"),
                       0.02)
              .empty();
}

TEST(ArenaCondition, ComparesNumbersOfTriggeringRobot) {
  EXPECT_TRUE(springs(R"({"speed": {"at_most": 0.1}})"));
  EXPECT_FALSE(springs(R"({"speed": {"at_least": 0.1}})"));
  EXPECT_TRUE(springs(R"({"collisions": {"at_most": 0}})"));
  EXPECT_FALSE(springs(R"({"collisions": {"robot": "r1", "at_least": 1}})"));
  EXPECT_TRUE(springs(R"({"score": {"at_least": 0}})"));
  EXPECT_FALSE(springs(R"({"score": {"at_least": 1}})"));
  EXPECT_TRUE(springs(R"({"block": {"name": "d1", "state": "retracted"}})"));
  EXPECT_FALSE(springs(R"({"block": {"name": "d1"}})"));
  EXPECT_TRUE(springs(R"({"block": {"name": "d2"}})"));
  EXPECT_TRUE(springs(R"({"count": {"of": "p", "at_most": 0}})"));
  EXPECT_FALSE(springs(R"({"count": {"of": "p", "at_least": 1}})"));
  EXPECT_TRUE(springs(R"({"time": {"to": 1}})"));
  EXPECT_FALSE(springs(R"({"time": {"from": 1}})"));
  // All must hold.
  EXPECT_FALSE(springs(R"({"time": {"to": 1}}, {"time": {"from": 1}})"));
}

TEST(ArenaCondition, UsesNewestReadings) {
  // Nothing has been measured at the start; the first readings come at 0.1 s.
  const std::string robots = R"("every": 0.05, "times": 1, "if": [)";
  EXPECT_THAT(
      events_after(timer_room(robots + R"({"battery": {"robot": "r1", "at_least": 90}}])"), 0.5),
      ElementsAre("0.10 timer t"));
  EXPECT_THAT(
      events_after(timer_room(robots + R"({"battery": {"robot": "r1", "at_most": 90}}])"), 0.5),
      IsEmpty());
  WorldDescription world = timer_room(robots + R"({"fiducial": {"robot": "r1", "number": 7}}])");
  EXPECT_THAT(events_after(world, 0.5), IsEmpty());  // the puck is behind r1
  world.arena.obstacles[2].center = {2.0, 2.0};
  EXPECT_THAT(events_after(world, 0.5), ElementsAre("0.10 timer t"));
}

TEST(ArenaCondition, CountsCollisionsAndActions) {
  Simulation simulation(room(R"("timers": [
      {"name": "a", "every": 1},
      {"name": "b", "every": 1, "if": [{"count": {"of": "a", "at_least": 3}}]},
      {"name": "hit", "every": 0.1, "times": 1,
       "if": [{"collisions": {"robot": "r1", "at_least": 1}}]}])"));
  drive(simulation, 0.5);
  run(simulation, 8.0);  // it hits the border after 5.8 s
  std::vector<std::string> lines = events_of(simulation);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "2.00 timer b"), 0);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "3.00 timer b"), 1);
  EXPECT_THAT(lines, testing::Contains("5.90 timer hit"));
}

// --- Actions

TEST(ArenaAction, Configuration_Changes) {
  const std::string configurations = R"("configurations": {
      "open": {"extended": ["d1"], "retracted": ["d2"], "poses": {"puck": {"x": 2.5, "y": 2.5}}},
      "closed": {"others": "extended"},
      "empty": {"extended": ["d1"], "others": "retracted"}})";
  Simulation simulation(
      room(configurations + R"(, "timers": [{"name": "t", "do": [{"configuration": "open"}]}])"));
  simulation.step();
  EXPECT_TRUE(block(simulation, "d1").extended);
  EXPECT_FALSE(block(simulation, "d2").extended);
  EXPECT_EQ(block(simulation, "puck").pose, (Pose{2.5, 2.5, 0.0}));
  EXPECT_THAT(events_of(simulation),
              ElementsAre("0.00 timer t", "0.00 configuration open", "0.00 retracted d2",
                          "0.00 placed puck", "0.00 extended d1"));
  EXPECT_FALSE(simulation.set_configuration("closed"));
  EXPECT_TRUE(block(simulation, "d2").extended);
  EXPECT_FALSE(simulation.set_configuration("empty"));
  EXPECT_TRUE(block(simulation, "d1").extended);
  EXPECT_FALSE(block(simulation, "d2").extended);
  EXPECT_THAT(simulation.set_configuration("shut").value_or(""),
              HasSubstr("no configuration named \"shut\"; this world has: open, closed, empty"));
  // A robot stands where the puck is to stand; the blocks change nevertheless.
  ASSERT_FALSE(simulation.place_object("puck", {0.5, 0.5, 0.0}));
  ASSERT_FALSE(simulation.place_object("r1", {2.4, 2.5, 0.0}));
  EXPECT_FALSE(simulation.set_configuration("closed"));
  EXPECT_THAT(simulation.set_configuration("open").value_or(""),
              HasSubstr("robot r1 stands there"));
  EXPECT_FALSE(block(simulation, "d2").extended);
}

TEST(ArenaAction, Blocks_Change) {
  EXPECT_THAT(events_after(timer_room(R"("do": [{"extend": ["d1", "d2"]}, {"retract": ["d2"]},
                                                {"toggle": ["d1", "d2"]}])"),
                           0.01),
              ElementsAre("0.00 timer t", "0.00 extended d1", "0.00 retracted d2",
                          "0.00 retracted d1", "0.00 extended d2"));
}

TEST(ArenaAction, RefusedActions_Reported) {
  Simulation simulation(timer_room(R"("at": 0.1, "do": [{"extend": ["d1"]},
      {"place": {"obstacle": "puck", "pose": {"x": 1, "y": 2}}},
      {"place": {"obstacle": "puck", "pose": {"x": 2, "y": 2}}}])"));
  ASSERT_FALSE(simulation.place_object("r2", {3.0, 1.0, 0.0}));
  run(simulation, 0.1);
  EXPECT_THAT(
      events_of(simulation),
      ElementsAre("0.10 timer t",
                  "0.10 refused d1 r2 obstacle \"d1\" cannot be extended: a robot stands on it",
                  "0.10 refused puck obstacle puck cannot be put there: robot r1 stands there",
                  "0.10 placed puck"));
  EXPECT_EQ(block(simulation, "puck").pose, (Pose{2.0, 2.0, 0.0}));
}

TEST(ArenaAction, Texts_Shown) {
  Simulation simulation(timer_room(R"("do": [
      {"text": {"text": "Go!", "duration": 0.5, "colour": "#ff0000"}},
      {"text": {"text": "A", "place": [1, 1]}}, {"text": {"text": "B", "place": [1, 1]}},
      {"text": {"text": "C", "place": [3, 3]}}, {"text": {"text": "", "place": [3, 3]}}])"));
  run(simulation, 0.1);
  std::vector<SceneText> texts = simulation.snapshot().texts;
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0].text, "Go!");
  EXPECT_EQ(texts[0].place, Vec2(2.0, 2.0));  // the middle of the floor
  EXPECT_EQ(texts[0].colour, (Colour{0xff, 0, 0, 0xff}));
  EXPECT_NEAR(texts[0].time_left_s.value_or(0.0), 0.4, 1e-9);
  EXPECT_EQ(texts[1].text, "B");
  EXPECT_FALSE(texts[1].time_left_s);
  run(simulation, 0.4);
  EXPECT_THAT(simulation.snapshot().texts, SizeIs(1));
}

TEST(ArenaAction, Canvas_Changes) {
  // Cells of 0.02 m; a rectangle of 0.1 x 0.06 m around (1, 1) has 6 x 4 cells, because its left
  // and bottom sides are at borders of cells.
  Simulation simulation(room(R"("timers": [
      {"at": 0.1, "do": [{"canvas": {"colour": "#00ff00", "center": [1, 1], "size": [0.1, 0.06]}}]},
      {"at": 0.2, "do": [{"canvas": {"colour": "#0000ff"}}]},
      {"at": 0.3, "do": [{"canvas": {"center": [0.5, 0.5], "size": [0.1, 0.1]}}]},
      {"at": 0.4, "do": [{"canvas": {}}]}])"));
  const auto count = [&](Colour colour) {
    int cells = 0;
    for (int row = 0; row < simulation.canvas().height(); ++row) {
      for (int column = 0; column < simulation.canvas().width(); ++column) {
        cells += simulation.canvas().pixel(column, row) == colour ? 1 : 0;
      }
    }
    return cells;
  };
  run(simulation, 0.1);
  EXPECT_NEAR(count({0, 0xff, 0, 0xff}), 20, 10);
  EXPECT_EQ(
      simulation.canvas().pixel(simulation.canvas().column(1.0), simulation.canvas().row(1.0)),
      (Colour{0, 0xff, 0, 0xff}));
  run(simulation, 0.1);
  EXPECT_EQ(count({0, 0, 0xff, 0xff}), 200 * 200);
  run(simulation, 0.1);
  EXPECT_EQ(simulation.canvas().pixel(25, 174), (Colour{0, 0, 0, 0}));
  run(simulation, 0.1);
  EXPECT_EQ(count({0, 0, 0, 0}), 200 * 200);
}

TEST(ArenaAction, Restart_ReturnsRobotToStart) {
  Simulation simulation(trap_room(std::string(kBox) + R"(, "do": [{"restart": {}}])"));
  drive(simulation, 0.5);
  run(simulation, 1.1);
  EXPECT_THAT(events_of(simulation),
              ElementsAre(HasSubstr("trap p r1 enter"), HasSubstr("restart r1 r1")));
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{1.0, 2.0, 0.0}));  // its motors stand
  drive(simulation, 0.5);
  run(simulation, 1.1);
  EXPECT_THAT(events_of(simulation), SizeIs(4));
}

TEST(ArenaAction, Restart_RefusedOrWaitsIfPlaceTaken) {
  for (const bool waits : {false, true}) {
    const std::string how = waits ? R"(, "when_blocked": "wait")" : "";
    Simulation simulation(
        timer_room(R"("at": 0.1, "do": [{"restart": {"robot": "r1")" + how + "}}]"));
    ASSERT_FALSE(simulation.place_object("r1", {3.0, 3.0, 0.0}));
    ASSERT_FALSE(simulation.place_object("r2", {1.0, 2.0, 0.0}));
    run(simulation, 0.2);
    EXPECT_THAT(events_of(simulation),
                ElementsAre("0.10 timer t", std::string("0.10 ") + (waits ? "waiting" : "refused") +
                                                " r1 the start of robot r1 is taken"));
    ASSERT_FALSE(simulation.place_object("r2", {1.0, 3.0, 0.0}));
    run(simulation, 0.1);
    EXPECT_EQ(simulation.body(0).X_WB.x_m, waits ? 1.0 : 3.0);
    EXPECT_THAT(events_of(simulation), SizeIs(waits ? 3 : 2));
  }
}

TEST(ArenaAction, Points_Scored) {
  Simulation simulation(room(R"("timers": [
      {"name": "a", "every": 1, "times": 2, "do": [{"score": {"robot": "r2", "points": -0.5}}]}],
      "traps": [{"name": "p", "region": {"circle": {"center": [1, 2], "radius": 0.1}},
                 "do": [{"score": {}}]}])"));
  EXPECT_THAT(simulation.scores(), ElementsAre(0.0, 0.0));
  run(simulation, 2.5);
  EXPECT_THAT(simulation.scores(), ElementsAre(1.0, -1.0));
  EXPECT_EQ(events_of(simulation)[1], "0.00 score p r1 1");
  EXPECT_EQ(simulation.snapshot().scores, simulation.scores());
}

TEST(ArenaAction, TimersAndTraps_Switched) {
  EXPECT_THAT(events_after(room(R"("timers": [
      {"name": "a", "at": 0.2, "do": [{"enable": ["b"]}, {"disable": ["c", "p"]}]},
      {"name": "b", "at": 0.1, "enabled": false}, {"name": "c", "at": 0.3}],
      "traps": [{"name": "p", "on": "stay", "for": 0.25,
                 "region": {"circle": {"center": [1, 2], "radius": 0.1}}}])"),
                           1.0),
              ElementsAre("0.20 timer a", "0.20 enabled b", "0.20 disabled c", "0.20 disabled p",
                          "0.30 timer b"));
}

TEST(ArenaAction, End_SetsVerdict) {
  Simulation simulation(room(R"("timers": [
      {"name": "t", "at": 0.5, "do": [{"end": {"verdict": "failed", "reason": "too slow"}},
                                      {"message": "not said"}]},
      {"name": "later", "at": 0.6}])"));
  run(simulation, 0.49);
  EXPECT_FALSE(simulation.finished());
  EXPECT_FALSE(simulation.verdict());
  simulation.step();
  EXPECT_TRUE(simulation.finished());
  ASSERT_TRUE(simulation.verdict());
  EXPECT_FALSE(simulation.verdict()->passed);
  EXPECT_EQ(simulation.verdict()->reason, "too slow");
  EXPECT_EQ(simulation.verdict()->time_ns, from_seconds(0.5));
  run(simulation, 0.5);  // steps go on, the controller does not
  EXPECT_THAT(events_of(simulation), ElementsAre("0.50 timer t", "0.50 end t too slow"));
}

// --- Events

TEST(ArenaEvents, CountedAndNewestKept) {
  Simulation simulation(timer_room(R"("every": 0.01)"));
  run(simulation, 20.0);
  const ArenaEvents& events = simulation.arena_events();
  EXPECT_EQ(events.count, 2000U);
  ASSERT_EQ(events.newest.size(), kKeptArenaEvents);
  EXPECT_EQ(events.newest.back().number, 2000U);
  EXPECT_EQ(events.newest.front().number, 2000U - kKeptArenaEvents + 1);
}

TEST(ArenaEvents, Logged) {
  std::vector<std::string> lines;
  Simulation simulation(trap_room(R"("region": {"circle": {"center": [1, 2], "radius": 0.1}},
                                     "do": [{"score": {}}, {"end": {"verdict": "passed"}}])"),
                        [&](LogLevel, std::string_view text) { lines.emplace_back(text); });
  simulation.step();
  EXPECT_THAT(lines,
              ElementsAre("arena, 0.00 s: robot r1 springs trap p (enter)",
                          "arena, 0.00 s: robot r1 gets 1 points from p", "arena, 0.00 s: passed"));
}

TEST(ArenaEvents, NoController_NotRecorded) {
  Simulation simulation(load_world_text("{}"));
  EXPECT_FALSE(simulation.records_arena_events());
  ASSERT_FALSE(simulation.set_obstacle_state("d1", ObstacleState::kExtended));
  simulation.reset();
  simulation.step();
  EXPECT_EQ(simulation.arena_events().count, 0U);
  EXPECT_THAT(simulation.scores(), IsEmpty());
  EXPECT_THAT(simulation.set_configuration("a").value_or(""), HasSubstr("this world has none"));
  EXPECT_THAT(simulation.set_timer_enabled("a", true).value_or(""), HasSubstr("no timer"));
  EXPECT_THAT(simulation.set_trap_enabled("a", true).value_or(""), HasSubstr("no trap"));
}

TEST(ArenaEvents, ClientChanges_Included) {
  Simulation simulation(trap_room(kBox));
  ASSERT_FALSE(simulation.set_obstacle_state("d1", ObstacleState::kExtended));
  EXPECT_THAT(events_of(simulation), ElementsAre("0.00 extended d1"));
  EXPECT_THAT(simulation.set_timer_enabled("q", true).value_or(""),
              HasSubstr("no timer named \"q\"; this world has none"));
  EXPECT_THAT(simulation.set_trap_enabled("q", true).value_or(""), HasSubstr("this world has: p"));
}

TEST(ArenaScene, ShowsTrapsAndTimers) {
  Simulation simulation(room(R"("timers": [{"name": "t", "at": 2}, {"name": "u", "at": 0}],
      "traps": [{"name": "a", )" +
                             std::string(kBox) + R"(}, {"name": "b", "enabled": false,
        "near": {"object": "puck", "distance": 0.3}},
        {"name": "c", "region": {"circle": {"center": [1, 2], "radius": 0.1}}}])"));
  run(simulation, 0.5);
  const SceneSnapshot scene = simulation.snapshot();
  ASSERT_EQ(scene.traps.size(), 3U);
  EXPECT_EQ(scene.traps[0].name, "a");
  EXPECT_THAT(scene.traps[0].outline, SizeIs(4));
  EXPECT_FALSE(scene.traps[1].enabled);
  EXPECT_EQ(scene.traps[1].center, Vec2(0.5, 0.5));
  EXPECT_EQ(scene.traps[1].radius_m, 0.3);
  EXPECT_THAT(scene.traps[2].robots, ElementsAre(0));
  ASSERT_EQ(scene.timers.size(), 2U);
  EXPECT_NEAR(scene.timers[0].time_left_s.value_or(0.0), 1.5, 1e-9);
  EXPECT_FALSE(scene.timers[1].time_left_s);
}

TEST(ArenaScene, HasEventsOfLastSecond) {
  Simulation simulation(room(R"("timers": [{"name": "t", "at": 0.5, "every": 0.4}])"));
  run(simulation, 2.0);
  std::vector<double> times_s;
  for (const ArenaEvent& event : simulation.snapshot().events) {
    EXPECT_EQ(event.kind, ArenaEventKind::kTimer);
    times_s.push_back(to_seconds(event.time_ns));
  }
  EXPECT_THAT(times_s, ElementsAre(1.3, 1.7));
}

// --- The work of a step

// The only issue of a world; its id and place.
ConfigIssue issue_of(const std::string& controller, const std::string& more) {
  try {
    static_cast<void>(room(controller, more));
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.issues(), SizeIs(1));
    return error.issues().front();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

// A regression: 5.7 kB of such actions took minutes for each step, in which nobody was answered.
TEST(ControllerWork, TimerWithTooMuchWorkPerStep_Refused) {
  std::string fills;
  for (int i = 0; i < 90; ++i)
    fills += std::string(i == 0 ? "" : ",") + R"({"canvas": {"colour": "#ff0000"}})";
  const std::string canvas = R"(, "canvas": {"size": [8192, 8192], "cell_size": 0.001})";
  const ConfigIssue one = issue_of(R"("timers": [{"every": 0.001, "do": [)" + fills + "]}]",
                                   R"(, "simulation": {"step": 0.1})" + canvas);
  EXPECT_EQ(one.id, "world/too-much-work");
  EXPECT_EQ(one.pointer, "/controller/timers/0");
  // 8192^2 cells are 524 288 operations, and one more for each of the 90 actions and the
  // conditions. A step of 0.1 s has 101 times of a timer that acts every millisecond.
  EXPECT_THAT(one.found, HasSubstr("101 times 47186011 operations"));
  EXPECT_EQ(
      issue_of(R"("traps": [{"near": {"place": [1, 2]}, "do": [)" + fills + "]}]", canvas).pointer,
      "/controller/traps/0");
  // To clear the canvas costs a 128th, and a small canvas little.
  static_cast<void>(room(R"("timers": [{"every": 0.1, "do": [{"canvas": {}}]}])", canvas));
  static_cast<void>(room(R"("timers": [{"every": 0.02, "do": [)" + fills + "]}]",
                         R"(, "canvas": {"size": [100, 100]})"));
}

TEST(ControllerWork, HugeConfiguration_Refused) {
  std::string blocks;
  std::string names;
  for (int i = 0; i < 1000; ++i) {
    const std::string name = "b" + std::to_string(i);
    blocks += R"(,{"name": ")" + name +
              R"(", "type": "dynamic", "center": [3.5, 3.5], "size": [0.01, 0.01]})";
    names += (i == 0 ? "\"" : ",\"") + name + '"';
  }
  const auto world = [&](const std::string& controller) {
    return load_world_text(
        R"({"arena": {"size": [4, 4], "obstacles": [{"name": "d", "center": [3, 1]})" + blocks +
        R"(]}, "controller": {)" + controller + "}}");
  };
  // A block is found among 1001: 4 + 1001 / 64 = 19 operations. 1000 of them are 19 001.
  const std::string open = R"("configurations": {"open": {"retracted": [)" + names + "]}}";
  static_cast<void>(world(open));
  try {
    static_cast<void>(world(open + R"(, "timers": [{"do": [{"configuration": "open"},
                                                           {"configuration": "open"}]}])"));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "world/too-much-work");
    EXPECT_THAT(error.issues().front().found, HasSubstr("38003"));
  }
}

TEST(ControllerWork, TimersWithTooMuchWorkTogether_EndRun) {
  // Each of 16 timers colours 1500 x 1500 cells, 17 579 operations: the second is too much.
  std::string timers;
  for (int i = 0; i < 16; ++i) {
    timers += std::string(i == 0 ? "" : ",") + R"({"name": "t)" + std::to_string(i) +
              R"(", "at": 0.05, "do": [{"canvas": {"colour": "#00ff00"}}]})";
  }
  Simulation simulation(room("\"timers\": [" + timers + "]",
                             R"(, "canvas": {"size": [1500, 1500], "cell_size": 0.003})"));
  run(simulation, 0.1);
  EXPECT_TRUE(simulation.finished());
  ASSERT_TRUE(simulation.verdict());
  EXPECT_FALSE(simulation.verdict()->passed);
  EXPECT_THAT(simulation.verdict()->reason,
              AllOf(HasSubstr("more than 20000 operations in one step"), HasSubstr("\"t1\"")));
  EXPECT_THAT(times_of(simulation, ArenaEventKind::kCanvas), SizeIs(1));
  // The canvas may not become so large that one of them does too much.
  EXPECT_EQ(simulation.canvas_refusal(1550, 1550), std::nullopt);
  EXPECT_THAT(simulation.canvas_refusal(8192, 8192).value_or(""),
              HasSubstr("\"t0\" would do 524290"));
}

}  // namespace
}  // namespace sim
