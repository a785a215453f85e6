// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Blocks that rise and sink, and the state of the arena controller: reset, snapshots, forks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/hash.h"
#include "sim/core/number_text.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"
#include "simulation_runs.h"

namespace sim {
namespace {

using test::drive;
using test::events_of;
using test::run;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A robot that looks along x from (1, 2), and a block 0.2 m high whose front is at x = 2. It takes
// 0.5 s to rise.
WorldDescription block_room(const std::string& settings, const std::string& more = "") {
  return load_world_text(R"({"arena": {"size": [4, 4], "obstacles": [
      {"name": "b", "center": [2.25, 2], "size": [0.5, 0.5], "height": 0.2, "type": "dynamic",
       "state": "retracted", )" +
                         settings + R"(}]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}}])" +
                         more + "}");
}

constexpr const char* kSlow = R"("rise_speed": 0.4)";

// What the laser measures straight ahead.
double ahead_m(const Simulation& simulation) {
  const int laser = simulation.find_device(0, "laser").value();
  const auto& device = dynamic_cast<const Laser&>(simulation.device(0, laser));
  return device.reading().ranges_m[device.reading().ranges_m.size() / 2];
}

ObstacleState state_of(const Simulation& simulation) {
  return simulation.world().arena.obstacles[0].state;
}

TEST(RisingBlock, Height_CurrentValue) {
  Simulation simulation(block_room(kSlow));
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  EXPECT_EQ(state_of(simulation), ObstacleState::kExtended);
  run(simulation, 0.3);
  ASSERT_EQ(simulation.moving_blocks().size(), 1U);
  EXPECT_EQ(simulation.moving_blocks()[0].phase, BlockPhase::kRising);
  EXPECT_NEAR(simulation.moving_blocks()[0].height_m, 0.12, 1e-12);
  EXPECT_NEAR(simulation.snapshot().moving_blocks.at(0).height_m, 0.12, 1e-12);
  // The laser is 0.125 m above the floor and sees the border, 3 m from the robot.
  EXPECT_GT(ahead_m(simulation), 2.9);
  run(simulation, 0.1);  // 0.16 m
  EXPECT_LT(ahead_m(simulation), 1.0);
  run(simulation, 0.2);
  EXPECT_THAT(simulation.moving_blocks(), IsEmpty());
  EXPECT_THAT(events_of(simulation),
              ElementsAre("0.00 block b is rising", "0.50 block b is extended"));

  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
  run(simulation, 0.3);  // 0.08 m
  EXPECT_GT(ahead_m(simulation), 2.9);
  EXPECT_EQ(simulation.moving_blocks().at(0).phase, BlockPhase::kSinking);
  EXPECT_EQ(state_of(simulation), ObstacleState::kExtended);
  run(simulation, 0.2);
  EXPECT_EQ(state_of(simulation), ObstacleState::kRetracted);
  EXPECT_EQ(events_of(simulation).back(), "1.10 block b is retracted");
}

TEST(RisingBlock, Shapes_AllRise) {
  for (
      const char* shape :
      {R"("shape": "circle", "radius": 0.3)",
       R"("shape": "polygon", "outline": [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]])",
       // Not convex.
       R"("shape": "polygon", "outline": [[-0.3, -0.3], [0.3, -0.3], [0, 0], [0.3, 0.3], [-0.3, 0.3]])"}) {
    SCOPED_TRACE(shape);
    const WorldDescription world = load_world_text(
        R"({"arena": {"size": [4, 4], "obstacles": [{"name": "b", "center": [2.3, 2], "height": 0.2,
          "type": "dynamic", "state": "retracted", "rise_speed": 0.4, )" +
        std::string(shape) + R"(}]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}}]})");
    Simulation simulation(world);
    ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
    run(simulation, 0.3);  // 0.12 m
    EXPECT_GT(ahead_m(simulation), 2.9);
    run(simulation, 0.1);  // 0.16 m; the laser is 0.035 m before the robot's middle
    EXPECT_NEAR(ahead_m(simulation), 1.0 - 0.035, 1e-3);
    Simulation fork = simulation.fork();
    run(fork, 0.2);
    run(simulation, 0.2);
    EXPECT_EQ(fork.state_hash(), simulation.state_hash());
    ASSERT_FALSE(simulation.place_object("r1", {1.0, 1.0, 0.0}));
    ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
    run(simulation, 0.51);
    ASSERT_FALSE(simulation.place_object("r1", {2.1, 2.0, 0.0}));
    EXPECT_THAT(simulation.set_obstacle_state("b", ObstacleState::kExtended).value_or(""),
                HasSubstr("a robot stands on it"));
  }
}

TEST(RisingBlock, SinkingBlock_BlocksRobotsUntilDown) {
  Simulation simulation(block_room(R"("rise_speed": 0.01)"));  // 20 s
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  drive(simulation, 0.5);
  run(simulation, 3.0);
  // The robot extends 0.087 m to the front.
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.0 - 0.087, 0.003);
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
  run(simulation, 2.9);  // it has risen for 3 s, so it sinks for 3 s
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.0 - 0.087, 0.003);
  run(simulation, 1.0);
  EXPECT_GT(simulation.body(0).X_WB.x_m, 2.2);
}

TEST(RisingBlock, Motion_Reversible) {
  Simulation simulation(block_room(kSlow));
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  run(simulation, 0.3);
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
  run(simulation, 0.1);
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  EXPECT_NEAR(simulation.moving_blocks().at(0).height_m, 0.08, 1e-12);
  run(simulation, 0.31);
  EXPECT_THAT(events_of(simulation),
              ElementsAre("0.00 block b is rising", "0.30 block b is sinking",
                          "0.40 block b is rising", "0.70 block b is extended"));
}

TEST(RisingBlock, MovedBlock_KeepsHeight) {
  Simulation simulation(block_room(kSlow));
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  run(simulation, 0.3);
  ASSERT_FALSE(simulation.place_object("b", {2.0, 2.0, 0.0}));
  EXPECT_NEAR(simulation.moving_blocks().at(0).height_m, 0.12, 1e-12);
  simulation.step();
  EXPECT_GT(ahead_m(simulation), 2.9);
  ASSERT_FALSE(simulation.set_block_size("b", {0.5, 0.5}, 0.1));
  EXPECT_NEAR(simulation.moving_blocks().at(0).height_m, 0.1, 1e-12);
  simulation.step();
  EXPECT_THAT(simulation.moving_blocks(), IsEmpty());
}

TEST(BlockUnderARobot, Default_Refused) {
  Simulation simulation(block_room(kSlow));
  ASSERT_FALSE(simulation.place_object("r1", {2.2, 2.0, 0.0}));
  EXPECT_EQ(simulation.set_obstacle_state("b", ObstacleState::kExtended).value_or(""),
            "obstacle \"b\" cannot be extended: a robot stands on it");
  EXPECT_THAT(events_of(simulation),
              ElementsAre("0.00 refused: obstacle \"b\" cannot be extended: a robot stands on it"));
}

TEST(BlockUnderARobot, Waiting_UntilRobotLeaves) {
  Simulation simulation(block_room(R"("when_blocked": "wait")"));
  ASSERT_FALSE(simulation.place_object("r1", {2.2, 2.0, 0.0}));
  EXPECT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  EXPECT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  run(simulation, 0.5);
  EXPECT_EQ(state_of(simulation), ObstacleState::kRetracted);
  EXPECT_EQ(simulation.moving_blocks().at(0).phase, BlockPhase::kRetracted);
  EXPECT_THAT(events_of(simulation),
              ElementsAre("0.00 b waits: obstacle \"b\" cannot be extended: a robot stands on it"));
  drive(simulation, 0.5);
  run(simulation, 1.5);  // its back leaves the block at x = 2.5 + 0.087, after 0.774 s
  EXPECT_EQ(state_of(simulation), ObstacleState::kExtended);
  EXPECT_THAT(events_of(simulation), Contains("1.28 block b is extended"));
  EXPECT_THAT(simulation.moving_blocks(), IsEmpty());
}

TEST(BlockUnderARobot, Waiting_EndsOnRetraction) {
  Simulation simulation(block_room(R"("when_blocked": "wait")"));
  ASSERT_FALSE(simulation.place_object("r1", {2.2, 2.0, 0.0}));
  EXPECT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  EXPECT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kRetracted));
  ASSERT_FALSE(simulation.place_object("r1", {1.0, 2.0, 0.0}));
  run(simulation, 0.1);
  EXPECT_EQ(state_of(simulation), ObstacleState::kRetracted);
}

TEST(BlockOfOtherWorlds, WithoutController_ChangesAtOnceWithSameHash) {
  Simulation simulation(block_room(R"("rise_speed": 0)"));
  ASSERT_FALSE(simulation.set_obstacle_state("b", ObstacleState::kExtended));
  EXPECT_THAT(simulation.moving_blocks(), IsEmpty());
  EXPECT_FALSE(simulation.records_arena_events());
  EXPECT_EQ(world_hash(block_room(R"("rise_speed": 0, "when_blocked": "refuse")")),
            world_hash(block_room(R"("fiducial": 0)")));
  EXPECT_NE(world_hash(block_room(kSlow)), world_hash(block_room(R"("fiducial": 0)")));
  EXPECT_NE(world_hash(block_room(kSlow)),
            world_hash(block_room(kSlow, R"(, "controller": {"timers": [{}]})")));
}

// --- State

WorldDescription living_arena() {
  return load_world(PLAYPEN_SOURCE_DIR "/worlds/examples/living_arena.json");
}

// Drives both robots about, equally in each run. The runner goes from its start to the plate,
// stands there for 2 s, goes back and waits until 25 s are over. The chaser wanders.
void interfere(Simulation& simulation, int i) {
  if (i % 100 == 0) {
    constexpr double kSpeeds_mps[] = {0.5, 0.5, 0.0, 0.0, -0.5, -0.5};
    const int second = i / 100 % 25;
    drive(simulation, second < 6 ? kSpeeds_mps[second] : 0.0, 0);
  }
  if (i % 150 != 0) return;
  std::mt19937 random(static_cast<unsigned>(i));
  const int motion = simulation.find_device(1, "motion").value();
  const double turn = static_cast<double>(random() % 100) * 0.02 - 1.0;
  ASSERT_FALSE(simulation.apply({1, motion}, TwistCommand{{.v_mps = 0.4, .omega_radps = turn}}));
}

void go(Simulation& simulation, int from, int to) {
  for (int i = from; i < to; ++i) {
    interfere(simulation, i);
    simulation.step();
  }
}

TEST(LivingArena, TwoRuns_Equal) {
  Simulation a(living_arena());
  Simulation b(living_arena());
  test::expect_equal_runs(a, b, interfere, 4000);
  // Something of each kind has happened.
  const std::vector<std::string> events = events_of(a);
  for (const char* word :
       {"timer opening acts", "timer closing acts", "springs trap plate", "configuration open",
        "block gate is rising", "block gate is retracted", "gets 1 points"}) {
    EXPECT_THAT(events, Contains(HasSubstr(word))) << word;
  }
}

TEST(LivingArena, Seed_ChangesRun) {
  const auto events = [](std::uint64_t seed) {
    WorldDescription world = living_arena();
    world.simulation.seed = seed;
    Simulation simulation(std::move(world));
    run(simulation, 40.0);
    return events_of(simulation);
  };
  EXPECT_EQ(events(1), events(1));
  EXPECT_NE(events(1), events(2));
}

TEST(LivingArena, Snapshot_ContinuesFromAnyMoment) {
  int while_moving = 0;
  test::expect_equal_after_snapshots(living_arena(), interfere, 3000, 37,
                                     [&while_moving](const Simulation& simulation) {
                                       while_moving += simulation.moving_blocks().empty() ? 0 : 1;
                                     });
  EXPECT_GT(while_moving, 3);
}

TEST(LivingArena, Fork_DuringRiseWorks) {
  Simulation simulation(living_arena());
  for (int i = 0; simulation.moving_blocks().empty(); ++i) go(simulation, i, i + 1);
  simulation.step();
  Simulation fork = simulation.fork();
  const std::uint64_t before = simulation.state_hash();
  EXPECT_EQ(fork.state_hash(), before);
  EXPECT_EQ(fork.moving_blocks().at(0).height_m, simulation.moving_blocks().at(0).height_m);
  run(fork, 5.0);
  EXPECT_EQ(simulation.state_hash(), before);
  run(simulation, 5.0);
  EXPECT_EQ(simulation.state_hash(), fork.state_hash());
}

TEST(LivingArena, Reset_StartsAnew) {
  Simulation fresh(living_arena());
  run(fresh, 30.0);
  Simulation simulation(living_arena());
  run(simulation, 22.5);  // while texts are shown and blocks move
  const std::uint64_t before = simulation.arena_events().count;
  simulation.reset();
  EXPECT_THAT(simulation.moving_blocks(), IsEmpty());
  EXPECT_THAT(simulation.snapshot().texts, IsEmpty());
  run(simulation, 30.0);
  std::vector<std::string> events;  // since the reset, with times since then
  for (const ArenaEvent& event : simulation.arena_events().newest) {
    if (event.number <= before + 1) continue;
    events.push_back(fixed_text(to_seconds(event.time_ns) - 22.5, 2) + ' ' + description(event));
  }
  EXPECT_EQ(events, events_of(fresh));
  EXPECT_EQ(simulation.arena_events().newest[before].kind, ArenaEventKind::kReset);
}

TEST(LivingArena, RestoredWorld_TimeContinues) {
  Simulation simulation(living_arena());
  run(simulation, 15.0);
  const Snapshot snapshot = simulation.save();
  Simulation other = simulation.fork();
  run(other, 20.0);
  run(simulation, 3.0);
  const std::uint64_t before = simulation.arena_events().count;
  simulation.restore(snapshot, RestoreScope::kWorld);
  run(simulation, 20.0);
  std::vector<std::string> again;
  for (const ArenaEvent& event : simulation.arena_events().newest) {
    if (event.number <= before + 1) continue;
    again.push_back(fixed_text(to_seconds(event.time_ns) - 3.0, 2) + ' ' + description(event));
  }
  std::vector<std::string> first;
  for (const ArenaEvent& event : other.arena_events().newest) {
    if (event.time_ns <= from_seconds(15.0)) continue;
    first.push_back(fixed_text(to_seconds(event.time_ns), 2) + ' ' + description(event));
  }
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(again, first);
}

TEST(LivingArena, Snapshot_KeepsScoresAndVerdict) {
  Simulation simulation(living_arena());
  run(simulation, 1.0);
  ASSERT_FALSE(simulation.place_object("runner", {3.6, 1.5, 0.0}));
  simulation.step();
  ASSERT_TRUE(simulation.verdict());
  EXPECT_TRUE(simulation.verdict()->passed);
  Simulation fork = simulation.fork();
  ASSERT_TRUE(fork.verdict());
  EXPECT_EQ(fork.verdict()->reason, "the runner is at the goal");
  EXPECT_EQ(fork.scores(), simulation.scores());
  EXPECT_TRUE(fork.finished());
  fork.reset();
  EXPECT_TRUE(fork.finished());
}

TEST(LivingArena, Snapshot_KeepsReportedState) {
  Simulation simulation(living_arena());
  ArenaState state = simulation.arena_state();
  EXPECT_EQ(state.configuration, "");
  ASSERT_EQ(state.timers.size(), 2U);
  EXPECT_EQ(state.timers[0].name, "opening");
  EXPECT_TRUE(state.timers[0].enabled);
  EXPECT_FALSE(state.timers[0].time_left_s) << "it counts from the first step on";
  EXPECT_FALSE(state.timers[1].enabled);
  ASSERT_EQ(state.traps.size(), 3U);
  EXPECT_EQ(state.traps[2].name, "goal");
  EXPECT_TRUE(state.traps[2].enabled);
  run(simulation, 1.0);
  EXPECT_NEAR(simulation.arena_state().timers[0].time_left_s.value(), 19.0, 3.0);  // jitter
  run(simulation, 24.0);
  Simulation fork(living_arena());
  const std::uint64_t before = fork.state_hash();
  ASSERT_FALSE(fork.set_configuration("closed"));
  EXPECT_NE(fork.state_hash(), before);
  fork.restore(simulation.save());
  state = fork.arena_state();
  EXPECT_EQ(state.configuration, "open");
  EXPECT_EQ(state.timers[0].count, 1U);
  EXPECT_TRUE(state.timers[1].enabled);
  EXPECT_EQ(state.timers[1].time_left_s, simulation.arena_state().timers[1].time_left_s);
  fork.reset();
  EXPECT_EQ(fork.arena_state().configuration, "");
  EXPECT_EQ(fork.arena_state().timers[0].count, 0U);
}

TEST(LivingArena, DamagedSnapshot_Refused) {
  Simulation simulation(living_arena());
  for (int i = 0; simulation.moving_blocks().empty(); ++i) go(simulation, i, i + 1);
  const Snapshot good = simulation.save();
  constexpr std::size_t kHeader = 56;
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    Snapshot bad = good;
    // The arena's part is near the end of the state.
    const std::size_t at = good.size() - 1 - random() % 2000;
    bad[at] = static_cast<std::uint8_t>(random() % 256);
    StateHash hash;
    hash.add_bytes(bad.data() + kHeader, bad.size() - kHeader);
    const std::uint64_t value = hash.value();
    std::memcpy(bad.data() + kHeader - sizeof value, &value, sizeof value);
    Simulation other(living_arena());
    try {
      other.restore(bad);
    } catch (const SnapshotError&) {
      continue;
    }
    run(other, 0.1);
    static_cast<void>(other.snapshot());
  }
}

}  // namespace
}  // namespace sim
