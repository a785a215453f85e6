// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Many simulations at once: equal to simulations one by one, with any number of threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "batches.h"
#include "sim/core/pose.h"
#include "sim/devices/laser.h"

namespace sim {
namespace {

using test::Arrays;
using test::kRoom;
using test::varied_actions;
using testing::Each;
using testing::ElementsAre;
using testing::IsNan;

WorldDescription room() { return load_world_text(kRoom); }

// What a batch observes in 12 calls of 5 steps, with a reset of every third simulation in between.
std::vector<Arrays> observed(int threads) {
  constexpr int kCount = 11;
  Batch batch(room(), {.simulations = kCount, .threads = threads});
  std::vector<std::uint8_t> mask(kCount, 0);
  for (std::size_t i = 0; i < kCount; i += 3) mask[i] = 1;
  std::vector<Arrays> all;
  for (int call = 0; call < 12; ++call) {
    if (call == 8) batch.reset({.mask = mask});
    Arrays& arrays = all.emplace_back(batch);
    batch.step({varied_actions(kCount, batch.robots(), call)}, 5, arrays.out());
  }
  return all;
}

TEST(Batch, AnyNumberOfThreads_EqualBytes) {
  const std::vector<Arrays> one = observed(1);
  for (const int threads : {2, 3, 7}) EXPECT_TRUE(observed(threads) == one) << threads;
  // The simulations differ, and they move.
  EXPECT_NE(one.back().poses[0], one.back().poses[6]);
  EXPECT_NE(one.back().poses[0], one.front().poses[0]);
}

TEST(Batch, Simulations_EqualSingleOnes) {
  constexpr int kCount = 5;
  Batch batch(room(), {.simulations = kCount, .threads = 2, .readings = true});
  std::vector<Simulation> singles;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    WorldDescription world = room();
    world.simulation.seed = 7 + i;
    singles.emplace_back(world);
  }
  Arrays arrays(batch);
  for (int call = 0; call < 15; ++call) {
    const std::vector<double> actions = varied_actions(kCount, 2, call);
    batch.step({actions}, 5, arrays.out());
    for (std::size_t i = 0; i < kCount; ++i) {
      Simulation& single = singles[i];
      for (std::size_t r = 0; r < 2; ++r) {
        const double* const action = actions.data() + 2 * (2 * i + r);
        const int robot = static_cast<int>(r);
        single.apply({robot, single.find_device(robot, "motion").value()},
                     TwistCommand{{action[0], action[1], 0.0}});
      }
      for (int k = 0; k < 5; ++k) single.step();
      for (std::size_t r = 0; r < 2; ++r) {
        const int robot = static_cast<int>(r);
        const std::size_t row = 2 * i + r;
        const Pose& X_WB = single.body(robot).X_WB;
        EXPECT_EQ(arrays.poses[3 * row], X_WB.x_m);
        EXPECT_EQ(arrays.poses[3 * row + 1], X_WB.y_m);
        EXPECT_EQ(arrays.poses[3 * row + 2], X_WB.yaw_rad);
        EXPECT_EQ(arrays.twists[3 * row], single.body(robot).twist.v_mps);
        EXPECT_EQ(arrays.twists[3 * row + 1], single.body(robot).twist.omega_radps);
        EXPECT_EQ(arrays.clearances[row], single.statistics(robot).least_clearance_m);
        EXPECT_EQ(arrays.collisions[row], single.statistics(robot).collisions);
        const LaserReading scan =
            single.ideal_scan({robot, single.find_device(robot, "laser").value()}).value();
        for (std::size_t beam = 0; beam < 40; ++beam) {
          ASSERT_EQ(arrays.scans[40 * row + beam], static_cast<float>(scan.ranges_m[beam]));
        }
      }
      EXPECT_EQ(arrays.times[i], to_seconds(single.now_ns()));
      ASSERT_EQ(batch.simulation(static_cast<int>(i)).state_hash(), single.state_hash());
    }
  }
}

TEST(Batch, WithoutReadings_MovesInTheSameWay) {
  Batch quiet(room(), {.simulations = 3, .threads = 1});
  Batch full(room(), {.simulations = 3, .threads = 1, .readings = true});
  Arrays a(quiet);
  Arrays b(full);
  for (int call = 0; call < 10; ++call) {
    quiet.step({varied_actions(3, 2, call)}, 7, a.out());
    full.step({varied_actions(3, 2, call)}, 7, b.out());
    ASSERT_TRUE(a == b) << call;
  }
  const auto scans_of = [](const Batch& batch) {
    const auto& laser = dynamic_cast<const Laser&>(
        batch.simulation(0).device(0, batch.simulation(0).find_device(0, "laser").value()));
    return laser.reading().sequence;
  };
  EXPECT_EQ(scans_of(quiet), 0U);
  EXPECT_GT(scans_of(full), 0U);
}

TEST(Batch, Done_StandsStillUntilReset) {
  Batch batch(room(), {.simulations = 2, .threads = 2});
  Arrays arrays(batch);
  const std::vector<double> ahead = {0.2, 0, 0.2, 0, 0.2, 0, 0.2, 0};
  batch.step({ahead}, 99, arrays.out());
  EXPECT_THAT(arrays.done, ElementsAre(0, 0));
  batch.step({ahead}, 50, arrays.out());  // 1 s is over after the first of these
  EXPECT_THAT(arrays.done, ElementsAre(1, 1));
  EXPECT_THAT(arrays.times, ElementsAre(1.0, 1.0));
  const std::vector<double> before = arrays.poses;
  batch.reset({.mask = std::vector<std::uint8_t>{1, 0}});
  batch.step({ahead}, 10, arrays.out());
  EXPECT_THAT(arrays.done, ElementsAre(0, 1));
  EXPECT_THAT(arrays.times, ElementsAre(0.1, 1.0));
  EXPECT_TRUE(std::equal(before.begin() + 6, before.end(), arrays.poses.begin() + 6));
}

TEST(Batch, Reset_WithSeedsAndPoses) {
  Batch batch(room(), {.simulations = 3, .threads = 2, .seeds = {5, 5, 5}});
  Arrays arrays(batch);
  const std::vector<double> ahead(12, 0.3);
  batch.step({ahead}, 20, arrays.out());
  EXPECT_EQ(arrays.poses[0], arrays.poses[6]);  // equal seeds slip equally
  // The robots of the first simulation change places.
  const std::vector<double> poses = {3.2, 0.6, 0.1, 0.6, 1.5, 0.2, 1,   1,   1,
                                     NAN, 1,   1,   1,   1,   0,   1.1, 1.9, 7};
  const std::vector<std::uint64_t> seeds = {6, 1, 6};
  EXPECT_THROW(batch.reset({.seeds = seeds, .poses = {poses}}), BatchError);
  const std::vector<std::uint8_t> mask = {1, 0, 1};
  batch.reset({.mask = mask, .seeds = seeds, .poses = {poses}});
  batch.observe(arrays.out());
  EXPECT_EQ(arrays.poses[0], 3.2);
  EXPECT_EQ(arrays.poses[3], 0.6);
  EXPECT_EQ(arrays.poses[12], 1.0);
  EXPECT_DOUBLE_EQ(arrays.poses[17], normalize_angle(7.0));
  EXPECT_THAT(arrays.times, ElementsAre(0.0, 0.2, 0.0));
  // Clearance begins at the new place: the octagon reaches 0.087 m ahead, 0.4 m from the border.
  EXPECT_LT(arrays.clearances[0], 0.72);
  EXPECT_GT(arrays.clearances[0], 0.3);
  EXPECT_EQ(batch.simulation(0).world().simulation.seed, 6U);
  EXPECT_EQ(batch.simulation(1).world().simulation.seed, 5U);
}

TEST(Batch, PlaceTaken_NamesFirstSimulation) {
  Batch batch(room(), {.simulations = 3, .threads = 2, .robots = {"a"}});
  const std::vector<double> poses = {0.7, 1.5, 0, 2, 1.5, 0, 2, 1.4, 0};
  EXPECT_THAT(test::error_of([&] { batch.reset({.poses = {poses}}); }),
              testing::AllOf(testing::HasSubstr("poses: simulation 1: robot a cannot be put there"),
                             testing::HasSubstr("pillar")));
  Arrays arrays(batch);
  batch.observe(arrays.out());
  EXPECT_EQ(arrays.poses[0], 0.7);
  EXPECT_EQ(arrays.poses[3], 0.6);  // the world's start
}

TEST(Batch, Restore_ContinuesWithEqualBits) {
  Batch batch(room(), {.simulations = 4, .threads = 3});
  Arrays arrays(batch);
  batch.step({varied_actions(4, 2, 0)}, 30, arrays.out());
  const Snapshot state = batch.save(1);
  batch.step({varied_actions(4, 2, 1)}, 30, arrays.out());
  const Arrays before = arrays;
  batch.restore(std::vector<std::uint8_t>{0, 1, 0, 1}, state);
  batch.observe(arrays.out());
  EXPECT_THAT(arrays.times, ElementsAre(0.6, 0.3, 0.6, 0.3));
  std::vector<double> actions = varied_actions(4, 2, 1);
  std::copy_n(actions.begin() + 4, 4, actions.begin() + 12);
  batch.step({actions}, 30, arrays.out());
  for (std::size_t k = 6; k < 12; ++k) {
    EXPECT_EQ(arrays.poses[k], before.poses[k]);
    EXPECT_EQ(arrays.poses[k + 12], before.poses[k]);  // the state has its seed
  }
}

TEST(Batch, Restore_StateOfPlainSimulation) {
  Simulation single(room());
  for (int i = 0; i < 20; ++i) single.step();
  Batch batch(room(), {.simulations = 2, .threads = 2, .readings = true});
  batch.restore({}, single.save());
  EXPECT_EQ(batch.simulation(0).state_hash(), single.state_hash());
  EXPECT_EQ(batch.simulation(1).state_hash(), single.state_hash());
}

TEST(Batch, Strides_OtherOrderAndGaps) {
  Batch batch(room(), {.simulations = 3, .threads = 2});
  Arrays arrays(batch);
  batch.step({varied_actions(3, 2, 4)}, 40, arrays.out());
  // [robot][simulation][3], and rows of 50 floats for 40 beams.
  std::vector<double> poses(18);
  std::vector<float> scans(299, -1.0F);
  batch.observe({.poses = {poses, 3, 9}, .scans = {scans, 100, 50}});
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t r = 0; r < 2; ++r) {
      EXPECT_EQ(poses[9 * r + 3 * i + 1], arrays.poses[3 * (2 * i + r) + 1]);
      EXPECT_EQ(scans[100 * i + 50 * r + 39], arrays.scans[40 * (2 * i + r) + 39]);
      if (100 * i + 50 * r + 40 < scans.size()) {
        EXPECT_EQ(scans[100 * i + 50 * r + 40], -1.0F);
      }
    }
  }
}

TEST(Batch, Beams_SpanTheLasersField) {
  const Batch own(room(), {.robots = {"b", "a"}});
  EXPECT_EQ(own.robot_name(0), "b");
  EXPECT_EQ(own.beams(), 40);
  Batch batch(room(), {.simulations = 2, .threads = 1, .beams = 3});
  EXPECT_EQ(batch.robots(), 2);
  const scan::ScanGeometry geometry = batch.scan_geometry(0).value();
  EXPECT_DOUBLE_EQ(geometry.angle_min_rad(), own.scan_geometry(1)->angle_min_rad());
  EXPECT_EQ(geometry.beam_count, 3);
  Arrays arrays(batch);
  batch.observe(arrays.out());
  // From x = 0.6 + 0.035 to the pillar's face at x = 1.8.
  EXPECT_NEAR(arrays.scans[1], 1.165, 1e-6);
}

TEST(Batch, RobotsOfDifferentLasers_RestIsNan) {
  const WorldDescription world = load_world_text(R"({"arena": {"size": [4, 3]}, "robots": [
    {"name": "a", "pose": {"x": 1, "y": 1}, "devices": {"laser": {"beams": 5}}},
    {"name": "b", "pose": {"x": 2, "y": 1}, "devices": {"laser": {"beams": 2}}},
    {"name": "c", "pose": {"x": 3, "y": 1}, "devices": {"laser": null}}]})");
  Batch batch(world, {.threads = 1});
  Arrays arrays(batch);
  batch.observe(arrays.out());
  const auto row = [&](std::size_t r) {
    return std::vector<float>(arrays.scans.begin() + static_cast<std::ptrdiff_t>(5 * r),
                              arrays.scans.begin() + static_cast<std::ptrdiff_t>(5 * r + 5));
  };
  EXPECT_THAT(row(0), Each(testing::Not(IsNan())));
  EXPECT_FALSE(std::isnan(row(1)[1]));
  EXPECT_THAT(row(1)[2], IsNan());
  EXPECT_THAT(row(2), Each(IsNan()));
  EXPECT_FALSE(batch.scan_geometry(2));
}

// A moving obstacle and blocks that change are not shared among simulations.
TEST(Batch, LivingArena_EqualSingleOnes) {
  const WorldDescription world =
      load_world(PLAYPEN_SOURCE_DIR "/worlds/examples/living_arena.json");
  Batch batch(world, {.simulations = 3, .threads = 3, .seeds = {1, 1, 2}, .readings = true});
  WorldDescription own = world;
  own.simulation.seed = 1;
  Simulation single(own);
  Arrays arrays(batch);
  for (int call = 0; call < 10; ++call) {
    batch.step({}, 100, arrays.out());
    for (int k = 0; k < 100; ++k) single.step();
    ASSERT_EQ(batch.simulation(1).state_hash(), single.state_hash()) << call;
  }
}

}  // namespace
}  // namespace sim
