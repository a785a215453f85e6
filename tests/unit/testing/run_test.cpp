// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libCCMorse/CCMorse.h>
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "playerlike/testing/testing.h"

namespace {

using playpen::testing::Error;
using playpen::testing::TestRun;
using playpen::testing::World;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

World room() { return World().Room(4, 3).Robot("r1", {1, 1.5, 0}); }

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

/// Drives straight ahead.
struct Driver {
  Driver(const std::string& host, double speed_mps, unsigned port = 6665)
      : client(host, port), position(&client, 0) {
    position.SetSpeed(speed_mps, 0.0);
  }
  void read(int times) {
    for (int i = 0; i < times; ++i) client.Read();
  }

  PlayerCc::PlayerClient client;
  PlayerCc::Position2dProxy position;
};

TEST(TestRun, ReadByClient_LetsTimePass) {
  TestRun run(room());
  EXPECT_EQ(run.time_s(), 0.0);
  Driver driver(run.host(), 0.2);
  driver.read(10);
  EXPECT_NEAR(run.time_s(), 1.0, 1e-9);
  EXPECT_NEAR(run.pose().x_m, 1.2, 0.01);
  EXPECT_NEAR(run.speed_mps(), 0.2, 1e-6);
  EXPECT_NEAR(run.path_length_m(), run.pose().x_m - 1.0, 1e-9);
}

TEST(TestRun, Advance_PassesWithAndWithoutClients) {
  TestRun run(room());
  run.Advance(0.5);
  EXPECT_NEAR(run.time_s(), 0.5, 1e-9);
  Driver driver(run.host(), 0.2);
  driver.read(1);
  const double before_s = run.time_s();
  run.Advance(0.3);
  EXPECT_NEAR(run.time_s(), before_s + 0.3, 1e-9);
  EXPECT_GT(run.pose().x_m, 1.05);
}

TEST(TestRun, TwoRuns_AreIndependent) {
  TestRun one(room());
  TestRun other(room());
  EXPECT_NE(one.host(), other.host());
  Driver driver(one.host(), 0.2);
  driver.read(5);
  EXPECT_EQ(other.time_s(), 0.0);
  EXPECT_DOUBLE_EQ(other.pose().x_m, 1.0);
}

TEST(TestRun, AsLocalhost_IsFoundByProgramsThatNameIt) {
  {
    TestRun run(room());
    run.AsLocalhost();
    Driver driver("localhost", 0.2);
    driver.read(10);
    EXPECT_NEAR(run.pose().x_m, 1.2, 0.01);
    TestRun other(room());
    EXPECT_THAT(error_of([&] { other.AsLocalhost(); }), HasSubstr("another run is localhost"));
  }
  TestRun next(room());
  EXPECT_EQ(error_of([&] { next.AsLocalhost(); }), "no error");
}

TEST(TestRun, EndedRun_EndsReadOfItsClients) {
  auto run = std::make_unique<TestRun>(room());
  const std::string host = run->host();
  Driver driver(host, 0.2);
  driver.read(1);
  run.reset();
  EXPECT_THROW(driver.read(3), PlayerCc::PlayerError);
  EXPECT_THROW(Driver(host, 0.1), PlayerCc::PlayerError);
}

TEST(TestRun, ClientOfUnknownRun_GetsAnErrorThatSaysSo) {
  try {
    PlayerCc::PlayerClient client("test:0", 6665);
    ADD_FAILURE() << "no error";
  } catch (PlayerCc::PlayerError& e) {
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("no run of a test with the name \"test:0\""));
  }
}

TEST(TestRun, Collision_IsRecordedWithPlaceAndPartner) {
  TestRun run(room().Box({1.6, 1.5, 0}, {0.2, 0.2}, "crate"));  // 0.413 m ahead of the nose
  Driver driver(run.host(), 0.4);
  driver.read(20);
  ASSERT_THAT(run.collisions(), SizeIs(1));
  const playpen::testing::Collision hit = run.collisions("r1")[0];
  EXPECT_EQ(hit.partner, "crate");
  EXPECT_NEAR(hit.place.x_m, 1.5, 0.01);
  EXPECT_NEAR(hit.time_s, 0.413 / 0.4, 0.1);
  EXPECT_EQ(run.least_clearance_m(), 0.0);
  EXPECT_TRUE(run.stalled());
}

// The clearances of the record and of the simulation are computed independently.
TEST(TestRun, LeastClearance_EqualsTheOneOfTheReport) {
  TestRun run(World().File("par_intro"));
  Driver driver(run.host(), 0.3);
  for (int i = 0; i < 60 && run.clearance_m() > 0.2; ++i) driver.read(1);
  EXPECT_LT(run.least_clearance_m(), 0.25);
  EXPECT_GT(run.least_clearance_m(), 0.0);
  EXPECT_THAT(run.collisions(), IsEmpty());
  EXPECT_NE(run.solid_name(run.path().back().nearest), "nothing");
}

TEST(TestRun, Path_HasOneSampleForEachStepAndTheStart) {
  TestRun run(room());
  run.Advance(0.1);  // steps of 10 ms
  EXPECT_THAT(run.path(), SizeIs(11));
  EXPECT_EQ(run.path()[0].time_s, 0.0);
  EXPECT_NEAR(run.path()[10].time_s, 0.1, 1e-9);
}

TEST(TestRun, Ranges_AreEmptyBeforeTheFirstReading) {
  TestRun run(room());
  EXPECT_THAT(run.ranges_m("r1.laser"), IsEmpty());
  run.Advance(0.2);
  const auto ranges = run.ranges_m("laser");
  ASSERT_THAT(ranges, SizeIs(682));
  // The laser is at x 1.035, the border at x 0 behind it and 1.5 m to the sides.
  EXPECT_NEAR(*std::min_element(ranges.begin(), ranges.end()), 1.035, 0.6);
}

TEST(TestRun, Cell_ShowsWhatClientsDraw) {
  TestRun run(room());
  CCMorse::PlayerClient client(run.host(), 6665);
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, 40, 30);
  EXPECT_EQ(run.cell("canvas", {2, 1}).alpha, 0);
  window.SetPixel(window.GetX(2.0), window.GetY(1.0), 255, 0, 0);
  const playpen::testing::Cell cell = run.cell("canvas", {2, 1});
  EXPECT_EQ(cell.red, 255);
  EXPECT_EQ(cell.alpha, 255);
  EXPECT_THAT(error_of([&] {
                static_cast<void>(run.cell("map", {2, 1}));
              }),
              AllOf(HasSubstr("no layer \"map\""), HasSubstr("canvas")));
  EXPECT_THAT(error_of([&] {
                static_cast<void>(run.cell("canvas", {99, 1}));
              }),
              HasSubstr("outside the grid-map"));
  delete &window;
}

TEST(TestRunFaults, KilledLaser_IsSilentUntilRevived) {
  TestRun run(room());
  run.Advance(0.2);
  run.Kill("r1.laser");
  const auto before = run.ranges_m("laser");
  run.MoveTo("r1", {2, 1, 0});
  run.Advance(0.3);
  EXPECT_EQ(run.ranges_m("laser"), before);
  run.Revive("laser");
  run.Advance(0.3);
  EXPECT_NE(run.ranges_m("laser"), before);
}

TEST(TestRunFaults, KilledMotion_Stops) {
  TestRun run(room());
  Driver driver(run.host(), 0.3);
  driver.read(5);
  run.Kill("motion");
  run.Advance(0.5);
  EXPECT_EQ(run.speed_mps(), 0.0);
}

TEST(TestRunFaults, Blocks_ExtendAndRetract) {
  TestRun run(room().Block({2, 1.5, 0}, {0.2, 0.2}, "gate", /*extended=*/false));
  const double open_m = run.clearance_m();
  run.Extend("gate");
  EXPECT_LT(run.clearance_m(), open_m);
  run.Retract("gate");
  EXPECT_EQ(run.clearance_m(), open_m);
}

TEST(TestRunFaults, PushedObstacle_IsMovedAlong) {
  TestRun run(room().Crate({2, 1, 0}, {0.2, 0.2}, 1.0, "crate"));
  run.Push("crate", {0.5, 0.25});
  EXPECT_NEAR(run.object("crate").x_m, 2.5, 1e-6);
  EXPECT_NEAR(run.object("crate").y_m, 1.25, 1e-6);
}

TEST(TestRunErrors, UnknownNames_ListTheKnownOnes) {
  TestRun run(room().Robot("r2", {3, 1.5, 0}).Block({2, 1, 0}, {0.2, 0.2}, "gate"));
  EXPECT_THAT(error_of([&] { static_cast<void>(run.pose("r3")); }), HasSubstr("only r1, r2"));
  EXPECT_THAT(error_of([&] { static_cast<void>(run.pose()); }), HasSubstr("name the robot"));
  EXPECT_THAT(error_of([&] { run.Kill("r1.lasr"); }), HasSubstr("did you mean \"laser\"?"));
  EXPECT_THAT(error_of([&] { run.Kill("laser"); }), HasSubstr("name the robot"));
  EXPECT_THAT(error_of([&] { static_cast<void>(run.ranges_m("r1.motion")); }),
              HasSubstr("measures no ranges"));
  EXPECT_THAT(error_of([&] { static_cast<void>(run.object("door")); }), HasSubstr("gate"));
  EXPECT_THAT(error_of([&] { run.Extend("door"); }), HasSubstr("door"));
  EXPECT_THAT(error_of([&] { run.Push("door", {1, 1}); }), HasSubstr("gate"));
  EXPECT_THAT(error_of([&] { static_cast<void>(run.collisions("r3")); }), HasSubstr("only r1, r2"));
}

TEST(TestRunErrors, ImpossiblePlaces_AreRefused) {
  TestRun run(room().Box({3, 1.5, 0}, {0.4, 0.4}, "crate"));
  EXPECT_THAT(error_of([&] { run.MoveTo("r1", {3, 1.5, 0}); }), HasSubstr("crate"));
  EXPECT_DOUBLE_EQ(run.pose().x_m, 1.0);
}

TEST(TestRunErrors, AfterTheEnd_TimeDoesNotPass) {
  TestRun run(room().Duration(0.5));
  run.Advance(2.0);
  EXPECT_NEAR(run.time_s(), 0.5, 1e-9);
  EXPECT_TRUE(run.finished());
  EXPECT_THAT(error_of([&] { run.Advance(1.0); }), HasSubstr("over since 0.5 s"));
  EXPECT_THAT(error_of([&] { TestRun(room()).Advance(-1.0); }), HasSubstr("found -1"));
}

TEST(TestRunErrors, PictureInMissingFolder_SaysWhichFile) {
  const TestRun run(room());
  EXPECT_THAT(error_of([&] { run.SavePicture("/nowhere/at/all.png"); }),
              HasSubstr("/nowhere/at/all.png"));
  EXPECT_THAT(error_of([&] {
                run.SavePicture("unused.png", TestRun::Mark{"r9", {}, ""});
              }),
              HasSubstr("no robot \"r9\""));
  EXPECT_FALSE(std::filesystem::exists("unused.png"));
}

}  // namespace
