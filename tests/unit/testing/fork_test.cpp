// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libCCMorse/CCMorse.h>
#include <libplayerc++/playerc++.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/testing/testing.h"

namespace {

using playpen::testing::Moment;
using playpen::testing::TestRun;
using playpen::testing::World;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A controller whose speeds depend on noisy ranges.
class Wanderer {
 public:
  explicit Wanderer(const std::string& host)
      : client_(host, 6665), position_(&client_, 0), laser_(&client_, 0) {}

  void step() {
    client_.Read();
    const double left = laser_.GetMinLeft();
    const double right = laser_.GetMinRight();
    position_.SetSpeed(0.3, left - right);
  }

 private:
  PlayerCc::PlayerClient client_;
  PlayerCc::Position2dProxy position_;
  PlayerCc::LaserProxy laser_;
};

World noisy_world() {
  return World()
      .Realism("real")
      .Room(4, 3)
      .Robot("r1", {1, 1, 0.3})
      .MovingCircle({{2, 2}, {3, 2}}, 0.1, 0.3);
}

TEST(TestFork, CommandedTheSame_ContinuesBitEqual) {
  TestRun run(noisy_world());
  Wanderer wanderer(run.host());
  for (int i = 0; i < 7; ++i) wanderer.step();
  TestRun fork = run.Fork();
  EXPECT_EQ(fork.time_s(), run.time_s());
  Wanderer other(fork.host());
  // The controller has no state, and the fork has the command that waits for the next step.
  for (int i = 0; i < 20; ++i) {
    wanderer.step();
    other.step();
    ASSERT_EQ(fork.time_s(), run.time_s());
    ASSERT_EQ(fork.state_hash(), run.state_hash()) << "after " << i << " steps";
  }
}

TEST(TestFork, CommandedDifferently_LeavesTheOriginalAlone) {
  TestRun run(noisy_world());
  run.Advance(0.5);
  const std::uint64_t before = run.state_hash();
  TestRun fork = run.Fork();
  EXPECT_EQ(fork.state_hash(), before);
  Wanderer wanderer(fork.host());
  for (int i = 0; i < 5; ++i) wanderer.step();
  EXPECT_NE(fork.state_hash(), before);
  EXPECT_EQ(run.state_hash(), before);
}

TEST(TestFork, OfMoment_GivesAnyNumberOfEqualFutures) {
  std::optional<Moment> moment;
  {
    TestRun run(noisy_world());
    Wanderer wanderer(run.host());
    for (int i = 0; i < 5; ++i) wanderer.step();
    moment = run.Save();
  }
  EXPECT_GT(moment->time_s(), 0.4);
  std::vector<std::uint64_t> ends;
  for (int i = 0; i < 3; ++i) {
    TestRun future(*moment);
    EXPECT_EQ(future.time_s(), moment->time_s());
    Wanderer wanderer(future.host());
    for (int k = 0; k < 5; ++k) wanderer.step();
    ends.push_back(future.state_hash());
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(ends[0], ends[2]);
}

TEST(TestFork, OfFork_HasTheSameState) {
  TestRun run(noisy_world());
  run.Advance(0.3);
  TestRun fork = run.Fork();
  fork.Advance(0.3);
  EXPECT_EQ(fork.Fork().state_hash(), fork.state_hash());
}

TEST(TestFork, Record_BeginsAtTheFork) {
  TestRun run(World().Room(4, 3).Robot("r1", {1, 1, 0}).Box({1.2, 1, 0}, {0.1, 0.1}));
  PlayerCc::PlayerClient client(run.host(), 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  position.SetSpeed(0.4, 0.0);
  for (int i = 0; i < 10; ++i) client.Read();
  ASSERT_THAT(run.collisions(), SizeIs(1));
  TestRun fork = run.Fork();
  EXPECT_THAT(fork.collisions(), IsEmpty());
  EXPECT_THAT(fork.path(), SizeIs(1));
  EXPECT_EQ(fork.path_length_m(), 0.0);
}

TEST(TestFork, GoalsReachedBefore_Count) {
  TestRun run(World().Room(4, 3).Robot("r1", {1, 1, 0}).Goal("r1", {1, 1}).Goal("r1", {3, 1}));
  TestRun fork = run.Fork();
  EXPECT_EQ(fork.goals_reached(), (std::vector<bool>{true, false}));
  fork.MoveTo("r1", {3, 1, 0});
  fork.Advance(0.01);
  EXPECT_EQ(fork.goals_reached(), (std::vector<bool>{true, true}));
  EXPECT_EQ(run.goals_reached(), (std::vector<bool>{true, false}));
}

// A client that connects anew and makes its layers again replaces those of the original's client.
TEST(TestFork, LayersOfClients_AreReplacedByNewClients) {
  TestRun run(World().Room(4, 3).Robot("r1", {1, 1, 0}));
  const auto draw = [](TestRun& where, int red) {
    CCMorse::PlayerClient client(where.host(), 6665);
    CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, 40, 30);
    window.CreateLayer("map").SetPixel(window.GetX(1.0), window.GetY(2.0), red, 0, 0);
    EXPECT_EQ(where.cell("map", {1, 2}).red, red);
    delete &window;
  };
  draw(run, 200);
  TestRun fork = run.Fork();
  EXPECT_EQ(fork.cell("map", {1, 2}).red, 200);
  draw(fork, 100);
  EXPECT_EQ(run.cell("map", {1, 2}).red, 200);
  fork.SavePicture(::testing::TempDir() + "layers.png");
}

}  // namespace
