// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// How long the simulation inside a program lasts.
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>
#include <libplayerc/playerc.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "playerlike/connect/open_session.h"
#include "temporary_folder.h"

namespace {

using PlayerCc::PlayerClient;
using PlayerCc::Position2dProxy;
using test_support::TemporaryFolder;

class EmbeddedWorlds : public testing::Test {
 protected:
  ~EmbeddedWorlds() override { playerlike::close_embedded_hosts(); }

  /// Drives ahead for ten rounds of 0.1 s.
  /// @return simulated time of the first one [s].
  static double drive(const std::string& host, double& end_x) {
    PlayerClient robot(host, 6665);
    Position2dProxy position(&robot, 0);
    robot.Read();
    const double begin_s = position.GetDataTime();
    position.SetSpeed(0.2, 0.0);
    for (int i = 0; i < 10; ++i) robot.Read();
    end_x = position.GetXPos();
    return begin_s;
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", R"({
    "arena": {"size": [4, 4]},
    "robots": [{"pose": {"x": 1, "y": 1}, "devices": {"motion": {}, "pose": {"frequency": 10}}}]})");
};

// As in a fixture of tests with a client of its own: each test begins at the start.
TEST_F(EmbeddedWorlds, NamedWorld_RestartsAfterLastClient) {
  double first_x = 0.0;
  double second_x = 0.0;
  const double first_s = drive("sim:" + world_, first_x);
  const double second_s = drive("sim:" + world_, second_x);
  EXPECT_EQ(first_s, second_s);
  EXPECT_GT(first_x, 1.15);  // about ten rounds of 0.02 m
  EXPECT_EQ(first_x, second_x);
}

TEST_F(EmbeddedWorlds, OpenClient_KeepsWorld) {
  PlayerClient holder("sim:" + world_, 6665);
  double first_x = 0.0;
  double second_x = 0.0;
  const double first_s = drive("sim:" + world_, first_x);
  EXPECT_GT(drive("sim:" + world_, second_x), first_s);
  EXPECT_GT(second_x, first_x + 0.1);
}

// As at a Player server, whose world goes on between two clients.
TEST_F(EmbeddedWorlds, Localhost_Continues) {
  setenv("PLAYPEN_WORLD", world_.c_str(), 1);
  double first_x = 0.0;
  double second_x = 0.0;
  const double first_s = drive("localhost", first_x);
  const double second_s = drive("localhost", second_x);
  unsetenv("PLAYPEN_WORLD");
  EXPECT_GT(second_s, first_s);
  EXPECT_GT(second_x, first_x + 0.1);
}

TEST_F(EmbeddedWorlds, ProxyAlone_DoesNotKeepWorld) {
  double x = 0.0;
  const double begin_s = drive("sim:" + world_, x);
  auto robot = std::make_unique<PlayerClient>("sim:" + world_, 6665);
  const Position2dProxy position(robot.get(), 0);
  robot.reset();
  double again_x = 0.0;
  EXPECT_EQ(drive("sim:" + world_, again_x), begin_s);
  EXPECT_EQ(again_x, x);
}

TEST_F(EmbeddedWorlds, CLibrary_RestartsAfterLastDisconnect) {
  playerc_client_t* const client = playerc_client_create(nullptr, ("sim:" + world_).c_str(), 6665);
  double times_s[2] = {-1.0, -2.0};
  for (double& time_s : times_s) {
    ASSERT_EQ(playerc_client_connect(client), 0);
    playerc_position2d_t* const position = playerc_position2d_create(client, 0);
    ASSERT_EQ(playerc_position2d_subscribe(position, PLAYER_OPEN_MODE), 0);
    playerc_client_read(client);
    time_s = position->info.datatime;
    for (int i = 0; i < 10; ++i) playerc_client_read(client);
    playerc_position2d_unsubscribe(position);
    playerc_position2d_destroy(position);
    ASSERT_EQ(playerc_client_disconnect(client), 0);
  }
  playerc_client_destroy(client);
  EXPECT_EQ(times_s[0], times_s[1]);
}

}  // namespace
