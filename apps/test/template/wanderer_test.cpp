// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "wanderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <playerlike/testing/matchers.h>
#include <playerlike/testing/testing.h>

#include <vector>

using namespace playpen::testing;

// A room of 3 x 2 m with a robot that looks along it.
static World room() { return World().Room(3, 2).Robot("r1", {0.5, 1, 0}); }

static void drive(Wanderer& wanderer, const TestRun& run, double until_s) {
  while (run.time_s() < until_s) wanderer.step();
}

TEST(Wanderer, EmptyRoom_KeepsMoving) {
  TestRun run(room());
  Wanderer wanderer(run.host());
  drive(wanderer, run, 30);
  EXPECT_THAT(run, DoesNotCollide());
  EXPECT_GT(run.path_length_m(), 3.0);
}

TEST(Wanderer, BoxAhead_KeepsClear) {
  TestRun run(room().Box({1.5, 1, 0}, {0.2, 0.4}));
  Wanderer wanderer(run.host());
  drive(wanderer, run, 30);
  EXPECT_THAT(run, KeepsClearOf(0.1));
  EXPECT_THAT(run, NeverFasterThan(0.3));
}

TEST(Wanderer, LaserLosesBeams_DoesNotCollide) {
  TestRun run(room().Box({1.5, 1, 0}, {0.2, 0.4}).Set("r1.laser", "dropouts", 0.3));
  Wanderer wanderer(run.host());
  drive(wanderer, run, 30);
  EXPECT_THAT(run, DoesNotCollide());
}

TEST(Wanderer, LaserDies_Stops) {
  TestRun run(room());
  Wanderer wanderer(run.host());
  drive(wanderer, run, 1);
  run.Kill("laser");
  drive(wanderer, run, 2);
  EXPECT_EQ(run.speed_mps(), 0.0);
  run.Revive("laser");
  drive(wanderer, run, 3);
  EXPECT_GT(run.speed_mps(), 0.0);
}

// Several futures of one moment: a crate appears at other places.
TEST(Wanderer, CrateAppears_IsAvoidedWherever) {
  TestRun run(room().Box({2.5, 0.2, 0}, {0.1, 0.1}, "crate"));
  Wanderer wanderer(run.host());
  drive(wanderer, run, 1);
  std::vector<TestRun> futures;
  for (int i = 0; i < 5; ++i) {
    TestRun future = run.Fork();
    future.MoveTo("crate", {1.5, 0.9 + 0.05 * i, 0});
    Wanderer other(future.host());
    drive(other, future, 15);
    futures.push_back(std::move(future));
  }
  EXPECT_THAT(futures, ::testing::Each(DoesNotCollide()));
}
