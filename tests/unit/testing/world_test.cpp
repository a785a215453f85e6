// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>

#include "playerlike/testing/testing.h"

namespace {

using playpen::testing::Degrees;
using playpen::testing::Error;
using playpen::testing::Pose;
using playpen::testing::TestRun;
using playpen::testing::Value;
using playpen::testing::World;
using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(TestWorld, WithoutCalls_IsTheDefaultWorld) {
  const TestRun run{World()};
  EXPECT_THAT(run.robots(), ElementsAre("r1"));
  EXPECT_EQ(run.world_name(), "test");
}

TEST(TestWorld, RobotInRoom_StandsThere) {
  const TestRun run(World().Name("yard").Room(4, 3).Robot("anna", {1, 2, Degrees(90)}));
  EXPECT_THAT(run.robots(), ElementsAre("anna"));
  EXPECT_EQ(run.world_name(), "yard");
  const Pose pose = run.pose("anna");
  EXPECT_DOUBLE_EQ(pose.x_m, 1.0);
  EXPECT_DOUBLE_EQ(pose.y_m, 2.0);
  EXPECT_DOUBLE_EQ(pose.yaw_rad, Degrees(90));
}

TEST(TestWorld, RobotTwice_IsMoved) {
  const TestRun run(World().Room(4, 3).Robot("r1", {1, 2, 0}).Robot("r1", {2, 1, 0}));
  EXPECT_THAT(run.robots(), ElementsAre("r1"));
  EXPECT_DOUBLE_EQ(run.pose().x_m, 2.0);
}

// Clearances ahead of an S1R at x = 1, whose nose is at x = 1.087.
TEST(TestWorld, EachObstacle_StandsWhereItShould) {
  const World room = World().Room(8, 8).Robot("r1", {1, 4, 0});
  EXPECT_NEAR(TestRun(World(room).Wall({2, 3.5}, {2, 4.5}, 0.1)).clearance_m(), 0.863, 1e-9);
  EXPECT_NEAR(TestRun(World(room).Box({1.6, 4, Degrees(90)}, {0.2, 0.4})).clearance_m(), 0.313,
              1e-9);
  EXPECT_NEAR(TestRun(World(room).Circle({1.6, 4}, 0.2)).clearance_m(), 0.313, 1e-9);
  EXPECT_NEAR(TestRun(World(room).Block({1.6, 4, 0}, {0.2, 0.2})).clearance_m(), 0.413, 1e-9);
  EXPECT_NEAR(TestRun(World(room).Crate({1.6, 4, 0}, {0.2, 0.2}, 0.5)).clearance_m(), 0.413, 1e-9);
  // To the border on the left: 1 - 0.087.
  EXPECT_NEAR(TestRun(room).clearance_m(), 0.913, 2e-3);
}

TEST(TestWorld, RetractedBlock_IsNoSolid) {
  const TestRun run(World()
                        .Room(4, 3)
                        .Robot("r1", {2, 1.5, 0})
                        .Block({2.5, 1.5, 0}, {0.2, 0.2}, "b",
                               /*extended=*/false));
  EXPECT_EQ(run.solid_name(run.path()[0].nearest), "border");
}

TEST(TestWorld, MovingCircle_Moves) {
  TestRun run(
      World().Room(4, 3).Robot("r1", {0.5, 0.5, 0}).MovingCircle({{1, 2}, {3, 2}}, 0.1, 0.5));
  EXPECT_DOUBLE_EQ(run.object("moving1").x_m, 1.0);
  run.Advance(2.0);
  EXPECT_GT(run.object("moving1").x_m, 1.5);
}

TEST(TestWorld, UnnamedObstacles_AreNumberedByKind) {
  const TestRun run(World()
                        .Room(4, 3)
                        .Robot("r1", {1, 1, 0})
                        .Box({3, 1, 0}, {0.1, 0.1})
                        .Circle({3, 2}, 0.1)
                        .Box({2, 2, 0}, {0.1, 0.1}));
  EXPECT_DOUBLE_EQ(run.object("box2").x_m, 2.0);
  EXPECT_DOUBLE_EQ(run.object("circle1").y_m, 2.0);
}

TEST(TestWorld, ShippedName_IsTheShippedWorld) {
  for (const char* name : {"par_intro", "tasks/par_intro", "tasks/par_intro.json"}) {
    EXPECT_EQ(TestRun(World().File(name)).world_name(), "par_intro") << name;
  }
}

TEST(TestWorld, FileWithAdditions_HasBoth) {
  const TestRun run(World()
                        .File("examples/empty_room")
                        .Robot("r1", {3, 2, 0})
                        .Robot("r2", {1, 1, 0})
                        .Box({2, 2, 0}, {0.2, 0.2}, "crate"));
  EXPECT_THAT(run.robots(), ElementsAre("r1", "r2"));  // r1 has no name in the file
  EXPECT_DOUBLE_EQ(run.pose("r1").x_m, 3.0);
  EXPECT_DOUBLE_EQ(run.object("crate").x_m, 2.0);
}

TEST(TestWorld, SetPointer_ChangesTheFile) {
  const TestRun run(World().Room(4, 3).Robot("r1", {1, 1, 0}).Set("/arena/border", false));
  EXPECT_TRUE(std::isinf(run.clearance_m()));
}

TEST(TestWorld, SetDropouts_LosesBeams) {
  TestRun run(World().Room(4, 3).Robot("r1", {2, 1.5, 0}).Set("r1.laser", "dropouts", 1.0));
  run.Advance(0.2);
  EXPECT_THAT(run.ranges_m("laser"), ::testing::Each(5.0));  // the laser's range
}

TEST(TestWorld, SetJson_TakesLists) {
  const TestRun run(
      World().Room(4, 3).Robot("r1", {1, 1, 0}).Set("/arena/size", Value::Json("[2, 2]")));
  EXPECT_NEAR(run.clearance_m(), 0.913, 2e-3);
}

TEST(TestWorld, NoiseWithSeeds_DiffersBySeed) {
  const World noisy = World().Room(4, 3).Robot("r1", {2, 1.5, 0}).Set("r1.laser", "noise", 0.05);
  const auto scan = [&](unsigned seed) {
    TestRun run(World(noisy).Seed(seed));
    run.Advance(0.2);
    return run.ranges_m("r1.laser");
  };
  EXPECT_EQ(scan(1), scan(1));
  EXPECT_NE(scan(1), scan(2));
}

TEST(TestWorld, CopiedWorld_IsIndependent) {
  const World one = World().Room(4, 3).Robot("r1", {1, 1, 0});
  World other = one;
  other.Robot("r1", {2, 1, 0});
  EXPECT_DOUBLE_EQ(TestRun(one).pose().x_m, 1.0);
}

TEST(TestWorldErrors, WrongWorld_NamesPlaceAndReason) {
  EXPECT_THAT(error_of([] {
                TestRun(World().Room(4, 3).Robot("r1", {9, 9, 0}));
              }),
              AllOf(HasSubstr("<world of the test>"), HasSubstr("/robots/0/pose")));
  EXPECT_THAT(error_of([] { TestRun(World().Room(-4, 3)); }), HasSubstr("/arena/size"));
  EXPECT_THAT(error_of([] {
                TestRun(World().Robot("r1", {1, 1, 0}, "s2r"));
              }),
              HasSubstr("/robots/0/model"));
  EXPECT_THAT(error_of([] { TestRun(World().Realism("dream")); }),
              HasSubstr("/simulation/realism"));
  EXPECT_THAT(error_of([] {
                TestRun(World().Room(4, 3).Robot("r1", {1, 1, 0}).Set("r1.laser", "nois", 1));
              }),
              AllOf(HasSubstr("nois"), HasSubstr("did you mean")));
  EXPECT_THAT(
      error_of([] {
        TestRun(World().Room(4, 3).Robot("r1", {1, 1, 0}).Set("r1.laser", "noise", std::nan("")));
      }),
      HasSubstr("/robots/0/devices/laser/noise"));
}

TEST(TestWorldErrors, WrongCalls_SayWhatWasExpected) {
  EXPECT_THAT(error_of([] { World().File("par_intr"); }), HasSubstr("did you mean \"par_intro\"?"));
  EXPECT_THAT(error_of([] { World().File("par_intro", ""); }), HasSubstr("playpen::testing"));
  EXPECT_THAT(error_of([] { World().Room(4, 3).File("par_intro"); }), HasSubstr("call it first"));
  EXPECT_THAT(error_of([] { World().MovingCircle({{1, 1}}, 0.1, 0.1); }), HasSubstr("two points"));
  EXPECT_THAT(error_of([] { World().Set("r1.laser", "noise", 0.1); }),
              HasSubstr("no robot \"r1\""));
  EXPECT_THAT(error_of([] { World().Set("laser", "noise", 0.1); }), HasSubstr("ROBOT.DEVICE"));
  EXPECT_THAT(error_of([] { World().Set("arena", 1); }), HasSubstr("JSON pointer"));
  EXPECT_THAT(error_of([] { World().Set("/arena", 1).Room(1, 1); }), HasSubstr("/arena"));
  EXPECT_THAT(error_of([] { World().Goal("r1", {1, 1}, 0.0); }), HasSubstr("tolerance"));
  EXPECT_THAT(error_of([] { TestRun(World().Goal("r2", {1, 1})); }), HasSubstr("no robot \"r2\""));
  EXPECT_THAT(error_of([] { static_cast<void>(Value::Json("{")); }), HasSubstr("no JSON"));
}

TEST(TestWorldErrors, BrokenFile_NamesTheLine) {
  const std::string file = ::testing::TempDir() + "broken_world.json";
  std::ofstream(file) << "{\n\"robots\": [,]}\n";
  EXPECT_THAT(error_of([&] { World().File(file); }), HasSubstr("broken_world.json:2"));
  const std::string stage = ::testing::TempDir() + "stage.world";
  std::ofstream(stage) << "position ( )\n";
  EXPECT_THAT(error_of([&] { World().File(stage); }), HasSubstr("playpen import"));
}

}  // namespace
