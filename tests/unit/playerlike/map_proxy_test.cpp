// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "libCCMorse/CCMorse.h"
#include "libplayerc++/playerc++.h"
#include "par_common/text_map.h"
#include "player_errors.h"
#include "reachable_host.h"

namespace {

using PlayerCc::MapProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

// A floor of 1.0 x 0.6 m with its bottom left corner at (-0.5, 1.0), in 10 x 6 cells of 0.1 m. The
// block covers (-0.2, 1.1) to (0.0, 1.2): columns 3 and 4 of row 1 from the bottom.
constexpr const char* kWorld = R"({
  "name": "small",
  "arena": {"origin": [-0.5, 1.0], "size": [1.0, 0.6],
            "obstacles": [{"name": "b", "center": [-0.1, 1.15], "size": [0.2, 0.1]}]},
  "canvas": {"size": [20, 20], "cell_size": 0.1},
  "robots": [{"name": "r1", "pose": {"x": 0.3, "y": 1.4}},
             {"name": "r2", "pose": {"x": -0.3, "y": 1.4}}]})";

class MapProxyTest : public testing::TestWithParam<test::Transport> {
 protected:
  [[nodiscard]] std::unique_ptr<PlayerClient> client(std::uint32_t port = 6665) const {
    return std::make_unique<PlayerClient>(host_.connect(static_cast<int>(port)));
  }

  test::ReachableHost host_{playerlike::Host::create(sim::load_world_text(kWorld)), GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Transports, MapProxyTest,
                         testing::Values(test::Transport::kInProcess, test::Transport::kCbor,
                                         test::Transport::kJson),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(MapProxyTest, EmptyUntilRequested) {
  const auto robot = client();
  MapProxy map(robot.get());
  EXPECT_FALSE(map.IsValid());
  EXPECT_FALSE(map.IsFresh());
  EXPECT_EQ(map.GetWidth(), 0U);
  EXPECT_EQ(map.GetHeight(), 0U);
  EXPECT_EQ(map.GetResolution(), 0.0);
  EXPECT_EQ(map.GetDataRange(), 1);
  testing::internal::CaptureStderr();
  EXPECT_EQ(map.GetCell(0, 0), 0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("RequestMap"));
  map.GetMap(nullptr);  // no cells: nothing to copy
}

TEST_P(MapProxyTest, WorldMap_InPlayerOrder) {
  const auto robot = client();
  MapProxy map(robot.get());
  map.RequestMap();
  EXPECT_TRUE(map.IsValid());
  EXPECT_TRUE(map.IsFresh());
  map.NotFresh();
  EXPECT_FALSE(map.IsFresh());
  ASSERT_EQ(map.GetWidth(), 10U);
  ASSERT_EQ(map.GetHeight(), 6U);
  EXPECT_DOUBLE_EQ(map.GetResolution(), 0.1);
  EXPECT_DOUBLE_EQ(map.GetOriginX(), -0.5);
  EXPECT_DOUBLE_EQ(map.GetOriginY(), 1.0);
  std::vector<int8_t> cells(60, 7);
  map.GetMap(cells.data());
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 10; ++x) {
      const int expected = y == 1 && (x == 3 || x == 4) ? 1 : -1;
      EXPECT_EQ(map.GetCell(x, y), expected) << x << ' ' << y;
      EXPECT_EQ(map.GetCellIndex(x, y), y * 10 + x);
      EXPECT_EQ(cells[static_cast<std::size_t>(map.GetCellIndex(x, y))], expected);
    }
  }
}

TEST_P(MapProxyTest, CellsOutside_Unknown) {
  const auto robot = client();
  MapProxy map(robot.get());
  map.RequestMap();
  for (const std::pair<int, int>& cell : {std::pair{-1, 0}, {0, -1}, {10, 0}, {0, 6}}) {
    EXPECT_EQ(map.GetCell(cell.first, cell.second), 0);
  }
  EXPECT_EQ(error_of([&] { map.GetMap(nullptr); }).GetErrorCode(), PlayerError::kBadArgument);
}

TEST_P(MapProxyTest, SameMapOnEveryPortAtIndexZero) {
  for (const std::uint32_t port : {6665U, 6666U, 4000U}) {
    const auto robot = client(port);
    CCMorse::MapProxy map(robot.get(), 0);
    map.RequestMap();
    EXPECT_EQ(map.GetWidth(), 10U);
    EXPECT_EQ(map.GetInterfaceStr(), "map");
    EXPECT_EQ(map.GetDriverName(), "world");
    const PlayerError error = error_of([&] { const MapProxy other(robot.get(), 1); });
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_THAT(error.GetErrorStr(), AllOf(HasSubstr("map:1"), HasSubstr("map:0 (the world)")));

    robot->RequestDeviceList();
    int maps = 0;
    for (const auto& device : robot->GetDeviceList()) {
      if (device.addr.interf != PLAYER_MAP_CODE) continue;
      ++maps;
      EXPECT_EQ(device.addr.index, 0);
      EXPECT_STREQ(device.drivername, "world");
    }
    EXPECT_EQ(maps, 1);
    robot->SetReplaceRule(false, PLAYER_MSGTYPE_DATA, -1, PLAYER_MAP_CODE);  // no readings: nothing
  }
}

TEST_P(MapProxyTest, Capabilities_ListRequests) {
  const auto robot = client();
  MapProxy map(robot.get());
  EXPECT_NE(map.HasCapability(PLAYER_MSGTYPE_REQ, PLAYER_MAP_REQ_GET_DATA), 0);
  EXPECT_EQ(map.HasCapability(PLAYER_MSGTYPE_REQ, PLAYER_MAP_REQ_GET_VECTOR), 0);
  EXPECT_EQ(map.HasCapability(PLAYER_MSGTYPE_DATA, PLAYER_MAP_DATA_INFO), 0);
}

TEST_P(MapProxyTest, Print_TopRowFirst) {
  const auto robot = client();
  MapProxy map(robot.get());
  map.RequestMap();
  std::ostringstream out;
  out << map;
  EXPECT_THAT(out.str(), HasSubstr("..........\n...##.....\n..........\n"));
}

TEST_P(MapProxyTest, Time_OfRequest) {
  const auto robot = client();
  MapProxy map(robot.get());
  const PlayerCc::Position2dProxy position(robot.get());
  robot->Read();
  map.RequestMap();
  EXPECT_DOUBLE_EQ(map.GetDataTime(), position.GetDataTime());
}

TEST_P(MapProxyTest, ClosedClient_Throws) {
  auto robot = client();
  MapProxy map(robot.get());
  robot.reset();
  EXPECT_EQ(error_of([&] { map.RequestMap(); }).GetErrorCode(), PlayerError::kDisconnected);
  EXPECT_EQ(error_of([&] { static_cast<void>(map.GetWidth()); }).GetErrorCode(),
            PlayerError::kDisconnected);
}

TEST(ShippedMaps, ParPlanning_EqualsTrueMapOfWorld) {
  const par::Mask file = par::load_text_map(PLAYPEN_SOURCE_DIR "/worlds/maps/par_planning.txt");
  PlayerClient client("sim:" PLAYPEN_SOURCE_DIR "/worlds/tasks/par_planning.json", 6665);
  MapProxy map(&client);
  map.RequestMap();
  // The map has the size of the canvas, which is a column wider than the floor. The border is
  // there.
  ASSERT_EQ(file.width(), 172);
  ASSERT_EQ(file.height(), 186);
  ASSERT_EQ(map.GetWidth(), 171U);
  ASSERT_EQ(map.GetHeight(), 186U);
  for (int row = 0; row < 186; ++row) {
    for (int column = 0; column < 172; ++column) {
      const bool wall = column == 171 || map.GetCell(column, 185 - row) > 0;
      ASSERT_EQ((file[{column, row}] != 0), wall) << column << ' ' << row;
    }
  }
}

TEST(ShippedMaps, TwoRooms_HasClosedWalls) {
  const par::Mask map = par::load_text_map(PLAYPEN_SOURCE_DIR "/worlds/maps/two_rooms.txt");
  EXPECT_EQ(map.width(), 32);
  EXPECT_EQ(map.height(), 24);
  for (int column = 0; column < map.width(); ++column) {
    EXPECT_EQ((map[{column, 0}]), 1);
    EXPECT_EQ((map[{column, map.height() - 1}]), 1);
  }
  EXPECT_GT(count(map), 0U);
}

}  // namespace
