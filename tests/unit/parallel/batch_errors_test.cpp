// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wrong calls of sim::Batch get an error that says what was expected and what was found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "batches.h"
#include "sim/core/error.h"
#include "sim/core/state_archive.h"

namespace sim {
namespace {

using test::Arrays;
using test::error_of;
using test::kRoom;
using testing::HasSubstr;

std::string options_error(const BatchOptions& options) {
  return error_of([&] { const Batch batch(load_world_text(kRoom), options); });
}

TEST(BatchErrors, Options) {
  EXPECT_EQ(options_error({.simulations = 0}),
            "simulations: expected a number from 1 to 1000000, found 0");
  EXPECT_EQ(options_error({.threads = -1}), "threads: expected a number from 0 to 1024, found -1");
  EXPECT_EQ(options_error({.beams = 9000}), "beams: expected a number from 0 to 8192, found 9000");
  EXPECT_EQ(options_error({.simulations = 3, .seeds = {1, 2}}),
            "seeds: expected one for each of 3 simulations, found 2");
  EXPECT_EQ(options_error({.robots = {"a", "z"}}),
            "robots: expected names of robots of the world (a, b, post), found \"z\"");
  EXPECT_EQ(options_error({.robots = {"a", "a"}}),
            "robots: expected each name once, found \"a\" twice");
  EXPECT_EQ(options_error({.robots = {"post"}}),
            "robots: expected robots with a motion device, found \"post\"");
}

TEST(BatchErrors, WorldWithoutMotors) {
  const auto make = [](const char* text) {
    return error_of([&] { const Batch batch(load_world_text(text), {}); });
  };
  EXPECT_EQ(make(R"({"arena": {"size": [2, 2]}, "robots": []})"),
            "robots: expected a world with a robot that has a motion device");
  WorldDescription world = load_world_text(kRoom);
  world.robots[0].pose.x_m = 100.0;
  EXPECT_THROW(Batch(world, {}), ConfigError);
}

TEST(BatchErrors, ActionNotFinite_NothingChanges) {
  Batch batch(load_world_text(kRoom), {.simulations = 2, .threads = 2});
  Arrays arrays(batch);
  std::vector<double> actions(8, 0.1);
  actions[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
      error_of([&] { batch.step({actions}, 5, arrays.out()); }),
      "actions: expected finite numbers, found NaN as the turn rate of simulation 1, robot 1");
  actions[7] = 0.0;
  actions[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of([&] { batch.step({actions}, 5, arrays.out()); }),
            "actions: expected finite numbers, found an infinite one as the speed of simulation 0, "
            "robot 1");
  EXPECT_EQ(batch.simulation(0).steps(), 0U);
}

TEST(BatchErrors, Sizes) {
  Batch batch(load_world_text(kRoom), {.simulations = 2, .threads = 1});
  std::vector<double> numbers(11);
  std::vector<float> scans(159);
  std::vector<std::uint8_t> bytes(3);
  const auto observe = [&](const BatchObservations& out) {
    return error_of([&] { batch.observe(out); });
  };
  EXPECT_EQ(observe({.poses = {numbers}}),
            "poses: expected 12 elements for 2 x 2 x 3 (simulations x robots x numbers), found 11");
  EXPECT_EQ(observe({.scans = {scans}}),
            "scans: expected 160 elements for 2 x 2 x 40 (simulations x robots x numbers), found "
            "159");
  EXPECT_EQ(observe({.done = {bytes}}),
            "done: expected 2 elements for 2 x 1 x 1 (simulations x robots x numbers), found 3");
  EXPECT_EQ(observe({.poses = {numbers, 3, 6}}),
            "poses: expected at least 12 elements for 2 x 2 x 3 (simulations x robots x numbers), "
            "found 11");
  EXPECT_EQ(observe({.poses = {numbers, -3, 6}}),
            "poses: expected strides of 0 to 2^31 elements, found -3");
  EXPECT_THAT(observe({.poses = {numbers, 3, 4}}),
              HasSubstr("overlap, found the strides 3 of simulations and 4 of robots"));
  EXPECT_EQ(
      error_of([&] { batch.step({numbers}, 1, {}); }),
      "actions: expected 8 elements for 2 x 2 x 2 (simulations x robots x numbers), found 11");
  EXPECT_EQ(error_of([&] { batch.step({}, -1, {}); }),
            "steps: expected a number from 0 to 1000000, found -1");
  EXPECT_EQ(error_of([&] { batch.reset({.mask = bytes}); }),
            "mask: expected one for each of 2 simulations, found 3");
  EXPECT_EQ(error_of([&] { static_cast<void>(batch.save(2)); }),
            "simulation: expected a number from 0 to 1, found 2");
  EXPECT_EQ(error_of([&] { static_cast<void>(batch.robot_name(2)); }),
            "robot: expected a number from 0 to 1, found 2");
}

TEST(BatchErrors, ScansWithoutLaser) {
  const WorldDescription world = load_world_text(R"({"arena": {"size": [2, 2]}, "robots": [
    {"name": "a", "pose": {"x": 1, "y": 1}, "devices": {"laser": null}}]})");
  Batch batch(world, {});
  EXPECT_EQ(batch.beams(), 0);
  std::vector<float> scans(682);
  EXPECT_EQ(error_of([&] { batch.observe({.scans = {scans}}); }),
            "scans: expected no array: no robot has a laser");
}

TEST(BatchErrors, DamagedState_NothingChanges) {
  Batch batch(load_world_text(kRoom), {.simulations = 2, .threads = 2});
  Snapshot state = batch.save(0);
  batch.step({}, 10, {});
  state[state.size() / 2] ^= 1U;
  EXPECT_THROW(batch.restore({}, state), SnapshotError);
  EXPECT_THROW(batch.restore({}, std::vector<std::uint8_t>(5)), SnapshotError);
  EXPECT_THROW(batch.restore({}, std::vector<std::uint8_t>(500)), SnapshotError);
  EXPECT_EQ(batch.simulation(0).steps(), 10U);
}

TEST(BatchErrors, MotorsSwitchedOff) {
  Simulation single(load_world_text(kRoom));
  const int motion = single.find_device(1, "motion").value();
  single.set_active({1, motion}, false);
  Batch batch(load_world_text(kRoom), {.simulations = 2, .threads = 2});
  batch.restore(std::vector<std::uint8_t>{0, 1}, single.save());
  EXPECT_THAT(error_of([&] { batch.step({std::vector<double>(8, 0.1)}, 5, {}); }),
              HasSubstr("actions: simulation 1: device b.motion is switched off"));
  EXPECT_EQ(batch.simulation(0).steps(), 5U);
  EXPECT_EQ(batch.simulation(1).steps(), 5U);
}

}  // namespace
}  // namespace sim
