// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/testing/matchers.h"

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "playerlike/testing/testing.h"

namespace {

namespace fs = std::filesystem;
using playpen::testing::DoesNotCollide;
using playpen::testing::KeepsClearOf;
using playpen::testing::NeverFasterThan;
using playpen::testing::of;
using playpen::testing::Reaches;
using playpen::testing::ReachesGoals;
using playpen::testing::SeesWallWithin;
using playpen::testing::TestRun;
using playpen::testing::World;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StringMatchResultListener;

class Matchers : public ::testing::Test {
 protected:
  Matchers() {
    fs::remove_all(PLAYPEN_TESTING_OUT);
    setenv("PLAYPEN_TEST_OUT", PLAYPEN_TESTING_OUT, 1);
  }
  ~Matchers() override { unsetenv("PLAYPEN_TEST_OUT"); }

  /// What a failed expectation says.
  template <typename What, typename Matcher>
  std::string explanation(const What& what, const Matcher& matcher) {
    StringMatchResultListener listener;
    EXPECT_FALSE(::testing::ExplainMatchResult(matcher, what, &listener));
    return listener.str();
  }
};

/// Straight ahead from x 1 towards a crate, whose face is 0.413 m ahead of the robot's nose.
TestRun drive(double speed_mps, int reads) {
  TestRun run(World()
                  .Room(4, 3)
                  .Robot("r1", {1, 1.5, 0})
                  .Box({1.6, 1.5, 0}, {0.2, 0.2}, "crate")
                  .Goal("r1", {1.2, 1.5}, 0.05));
  PlayerCc::PlayerClient client(run.host(), 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  position.SetSpeed(speed_mps, 0.0);
  for (int i = 0; i < reads; ++i) client.Read();
  return run;
}

TEST_F(Matchers, GoodRun_MatchesAll) {
  const TestRun run = drive(0.2, 10);  // to about x 1.2
  EXPECT_THAT(run, KeepsClearOf(0.2));
  EXPECT_THAT(run, Reaches({1.2, 1.5}, 0.02));
  EXPECT_THAT(run, ReachesGoals());
  EXPECT_THAT(run, NeverFasterThan(0.2));
  EXPECT_THAT(run, SeesWallWithin(0.35));
  EXPECT_THAT(run, DoesNotCollide());
  EXPECT_THAT(of(run, "r1"), AllOf(DoesNotCollide(), NeverFasterThan(0.2)));
  EXPECT_FALSE(fs::exists(PLAYPEN_TESTING_OUT)) << "pictures are of failed expectations only";
}

TEST_F(Matchers, TooNear_NamesSolidTimeAndPlace) {
  const TestRun run = drive(0.2, 10);
  EXPECT_THAT(explanation(run, KeepsClearOf(0.3)),
              AllOf(HasSubstr("r1 came within 0.21"),
                    HasSubstr(" of crate at 1.00 s, x 1.20, y 1.50"), HasSubstr("picture: ")));
}

TEST_F(Matchers, NotThere_NamesTheNearestMoment) {
  const TestRun run = drive(0.2, 10);
  EXPECT_THAT(explanation(run, Reaches({1.5, 1.5}, 0.1)),
              AllOf(HasSubstr("r1 came no nearer than 0.3"), HasSubstr("at 1.00 s, x 1.20")));
  EXPECT_THAT(explanation(drive(0.2, 2), ReachesGoals()),
              AllOf(HasSubstr("goal at x 1.2, y 1.5, tolerance 0.05 m")));
}

TEST_F(Matchers, TooFast_NamesTheSpeed) {
  const TestRun run = drive(0.4, 5);
  EXPECT_THAT(explanation(run, NeverFasterThan(0.3)),
              AllOf(HasSubstr("r1 drove 0.400 m/s at 0."), HasSubstr(" s, x 1.")));
}

TEST_F(Matchers, NothingSeen_NamesRangeAndBearing) {
  EXPECT_THAT(explanation(drive(0.2, 10), SeesWallWithin(0.1)),
              AllOf(HasSubstr("r1.laser measured 0.2"), HasSubstr("bearing")));
  EXPECT_THAT(explanation(TestRun(World()), SeesWallWithin(0.1)), HasSubstr("made no scan yet"));
}

TEST_F(Matchers, Collision_NamesPartnerAndCount) {
  const TestRun run = drive(0.4, 20);
  EXPECT_THAT(explanation(run, DoesNotCollide()),
              AllOf(HasSubstr("r1 hit crate at 1."), HasSubstr("x 1.50, y ")));
  EXPECT_THAT(run, Not(DoesNotCollide()));
  EXPECT_THAT(run, Not(KeepsClearOf(0.001)));
}

TEST_F(Matchers, FailedExpectation_PrintsRunAndPicture) {
  static const TestRun* run = nullptr;
  const TestRun driven = drive(0.2, 10);
  run = &driven;
  EXPECT_NONFATAL_FAILURE(EXPECT_THAT(*run, KeepsClearOf(0.3)), "run of test at 1 s");
  const std::string file =
      std::string(PLAYPEN_TESTING_OUT) + "/Matchers.FailedExpectation_PrintsRunAndPicture.png";
  EXPECT_TRUE(fs::exists(file));
  EXPECT_NONFATAL_FAILURE(EXPECT_THAT(*run, KeepsClearOf(0.3)),
                          file.substr(0, file.size() - 4) + "_2.png");
}

TEST_F(Matchers, OfSeveralRobots_EachIsJudged) {
  TestRun run(World().Room(4, 3).Robot("r1", {1, 1, 0}).Robot("r2", {3, 1, 0}));
  EXPECT_THAT(of(run, "r1"), Reaches({1, 1}, 0.1));
  EXPECT_THAT(explanation(run, Reaches({1, 1}, 0.1)), HasSubstr("r2 came no nearer than 2.000 m"));
}

TEST_F(Matchers, OfForks_EachIsJudged) {
  const TestRun run = drive(0.2, 10);
  std::vector<TestRun> futures;
  for (int i = 0; i < 3; ++i) futures.push_back(run.Fork());
  EXPECT_THAT(futures, Each(DoesNotCollide()));
}

TEST_F(Matchers, WithoutGoalsOrLaser_ThrowAnError) {
  const TestRun run(World().Room(4, 3).Robot("r1", {1, 1, 0}, "epuck"));
  EXPECT_THROW(static_cast<void>(check_goals(run)), playpen::testing::Error);
  EXPECT_THROW(static_cast<void>(check_sees(run, 0.1)), playpen::testing::Error);
  EXPECT_THROW(static_cast<void>(check_clearance(of(run, "r2"), 0.1)), playpen::testing::Error);
}

TEST_F(Matchers, FolderThatCannotBeMade_IsToldInsteadOfThePicture) {
  setenv("PLAYPEN_TEST_OUT", "/dev/null/pictures", 1);
  EXPECT_THAT(explanation(drive(0.2, 10), KeepsClearOf(0.3)),
              AllOf(HasSubstr("r1 came within"), HasSubstr("no picture: ")));
}

}  // namespace
