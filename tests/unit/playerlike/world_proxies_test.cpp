// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The proxies of the world itself (simulation, map in tiles, log), and of speech, lights, lines and
// messages of robots, over all transports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "libCCMorse/CCMorse.h"
#include "libplayerc++/playerc++.h"
#include "player_errors.h"
#include "playerlike/host/run_settings.h"
#include "reachable_host.h"
#include "temporary_folder.h"
#include "token_server.h"

namespace {

using namespace PlayerCc;
using test::error_of;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* kWorld = R"({
  "name": "small",
  "arena": {"size": [4, 2], "obstacles": [
    {"name": "b", "center": [3, 1.5], "size": [0.2, 0.4]},
    {"name": "d", "center": [3, 0.5], "size": [0.2, 0.2], "type": "dynamic"}]},
  "robots": [
    {"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {
      "speech": {}, "blinkenlight": {}, "fiducial": {}, "opaque": {"from": ["r2"]},
      "dio": {"inputs": ["r2.dio.0", true], "outputs": 4},
      "aio": {"inputs": [5, "aio.1"], "outputs": 2}}},
    {"name": "r2", "pose": {"x": 2, "y": 1}, "devices": {"dio": {}, "opaque": {}}}]})";

/// The output on standard error during an action that throws nothing.
template <typename Action>
std::string warning_of(Action action) {
  testing::internal::CaptureStderr();
  EXPECT_NO_THROW(action());
  return testing::internal::GetCapturedStderr();
}

class WorldProxies : public testing::TestWithParam<test::Transport> {
 protected:
  WorldProxies() {
    settings_.output_folder = folder_.path().string();
    host_ = std::make_unique<test::ReachableHost>(
        playerlike::Host::create(sim::load_world_text(kWorld), settings_), GetParam());
  }
  [[nodiscard]] std::unique_ptr<PlayerClient> client(int port = 6665) const {
    return std::make_unique<PlayerClient>(host_->connect(port));
  }

  test_support::TemporaryFolder folder_;
  playerlike::RunSettings settings_;
  std::unique_ptr<test::ReachableHost> host_;
};

INSTANTIATE_TEST_SUITE_P(Transports, WorldProxies,
                         testing::Values(test::Transport::kInProcess, test::Transport::kCbor,
                                         test::Transport::kJson),
                         [](const auto& instance) { return transport_name(instance.param); });

// --- simulation

TEST_P(WorldProxies, RobotsAndObstacles_Placed) {
  const auto robot = client();
  SimulationProxy simulation(robot.get(), 0);
  Position2dProxy position(robot.get(), 0);
  EXPECT_EQ(simulation.GetInterfaceStr(), "simulation");
  char name[] = "r1";  // as old programs have it
  double x = 0.0;
  double y = 0.0;
  double a = 0.0;
  simulation.GetPose2d(name, x, y, a);
  EXPECT_EQ(x, 1.0);
  EXPECT_EQ(y, 1.0);
  EXPECT_EQ(a, 0.0);
  simulation.SetPose2d(name, 0.5, 0.6, 7.0);
  simulation.GetPose2d("r1", x, y, a);
  EXPECT_EQ(x, 0.5);
  EXPECT_EQ(y, 0.6);
  EXPECT_NEAR(a, 7.0 - 2.0 * M_PI, 1e-12);
  EXPECT_EQ(host_->time().steps, 0U);  // at once
  robot->Read();
  EXPECT_NEAR(position.GetXPos(), 0.5, 1e-9);

  double z = 1.0;
  double roll = 1.0;
  double pitch = 1.0;
  double time = -1.0;
  simulation.SetPose3d("b", 3.5, 1.0, 9.0, 9.0, 9.0, 0.25);
  simulation.GetPose3d("b", x, y, z, roll, pitch, a, time);
  EXPECT_EQ(x, 3.5);
  EXPECT_EQ(y, 1.0);
  EXPECT_EQ(a, 0.25);
  EXPECT_EQ(z, 0.0);
  EXPECT_EQ(roll, 0.0);
  EXPECT_EQ(pitch, 0.0);
  EXPECT_DOUBLE_EQ(time, 0.1);
}

TEST_P(WorldProxies, MovingObstacle_FollowedAndPlaced) {
  const test::ReachableHost host(playerlike::Host::create(sim::load_world_text(R"({
      "arena": {"size": [4, 2], "obstacles": [{"name": "cart", "center": [1, 0.5],
        "motion": {"type": "path", "speed": 0.5, "points": [[3, 0.5]]}}]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 1.5}}]})"),
                                                          settings_),
                                 GetParam());
  PlayerClient robot(host.connect(6665));
  SimulationProxy simulation(&robot, 0);
  double x = 0.0;
  double y = 0.0;
  double a = 0.0;
  const Position2dProxy position(&robot, 0);
  const auto at = [&](int time_s) {
    while (host.time().steps < 100U * static_cast<unsigned>(time_s)) robot.Read();
    simulation.GetPose2d("cart", x, y, a);
  };
  at(1);
  EXPECT_NEAR(x, 1.5, 1e-9);
  EXPECT_NEAR(y, 0.5, 1e-9);
  // 0.6 m above its goal, which it now approaches from there.
  simulation.SetPose2d("cart", 3.0, 1.1, 0.0);
  at(2);
  EXPECT_NEAR(x, 3.0, 1e-9);
  EXPECT_NEAR(y, 0.6, 1e-9);
  EXPECT_THAT(warning_of([&] { simulation.SetPose2d("cart", 1.0, 1.5, 0.0); }),
              HasSubstr("robot r1 stands there"));
}

TEST_P(WorldProxies, InvalidPose_Explained) {
  const auto robot = client(6666);
  SimulationProxy simulation(robot.get(), 0);
  const auto warning = [&](const char* name, double x, double y) {
    return warning_of([&] { simulation.SetPose2d(name, x, y, 0.0); });
  };
  EXPECT_THAT(warning("r1", 3.0, 1.5),
              AllOf(HasSubstr("SimulationProxy::SetPose2d"), HasSubstr("obstacle b")));
  EXPECT_EQ(warning("r1", 3.0, 1.5), "") << "it has been told";
  EXPECT_THAT(warning("r1", 2.0, 1.0), HasSubstr("robot r2"));
  EXPECT_THAT(warning("r1", 9.0, 1.0), HasSubstr("right side"));
  EXPECT_THAT(warning("b", 1.0, 1.0), HasSubstr("robot r1"));
  EXPECT_THAT(warning("r1", 1e300, 1.0), HasSubstr("finite"));
  double x = 0.25;
  EXPECT_THAT(warning_of([&] { simulation.GetPose2d("zz", x, x, x); }),
              AllOf(HasSubstr("\"zz\""), HasSubstr("r1, r2, b, d, border")));
  EXPECT_EQ(x, 0.25) << "what is not known stays as it is";
  const auto code = [&](auto action) { return error_of(action).GetErrorCode(); };
  EXPECT_EQ(code([&] { simulation.SetPose2d("r1", NAN, 1.0, 0.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { simulation.GetPose2d(static_cast<char*>(nullptr), x, x, x); }),
            PlayerError::kBadArgument);
  for (int i = 0; i < 100; ++i) {
    const std::string name = std::string("z").append(std::to_string(i));
    const std::string told = warning(name.c_str(), 1.0, 1.0);
    if (i > 20) {
      EXPECT_EQ(told, "") << "it is not told for ever";
    }
  }
  EXPECT_EQ(error_of([&] { const SimulationProxy other(robot.get(), 1); }).GetErrorCode(),
            PlayerError::kNoSuchDevice);
  simulation.GetPose2d("r1", x, x, x);
  EXPECT_EQ(x, 0.0);  // the heading is checked last: r1 did not move
}

TEST_P(WorldProxies, Properties_ReadAndChanged) {
  const auto robot = client();
  SimulationProxy simulation(robot.get(), 0);
  std::uint32_t green = 0xff00;
  simulation.SetProperty((char*)"r1", (char*)"_mp_color", &green, sizeof green);
  std::uint32_t packed = 0;
  simulation.GetProperty("r1", "color", &packed, sizeof packed);
  EXPECT_EQ(packed, 0xff00ff00U);
  // Whichever of the names is a literal, the call is unambiguous; so are pointers to members.
  char object[] = "r1";
  char colour[] = "color";
  simulation.GetProperty(object, "color", static_cast<void*>(&packed), sizeof packed);
  simulation.GetProperty("r1", colour, static_cast<void*>(&packed), sizeof packed);
  simulation.SetProperty(object, "color", static_cast<void*>(&packed), sizeof packed);
  void (SimulationProxy::*member)(char*, char*, void*, std::size_t) = &SimulationProxy::SetProperty;
  (simulation.*member)(object, colour, &green, sizeof green);
  double rgba[4] = {1.0, 0.5, 0.0, 1.0};
  simulation.SetProperty("b", "colour", rgba, sizeof rgba);
  char text[32];
  simulation.GetProperty("b", "colour", text, 20);
  EXPECT_STREQ(text, "#ff8000");
  float floats[4];
  simulation.GetProperty("b", "colour", floats, sizeof floats);
  EXPECT_FLOAT_EQ(floats[1], 128.0F / 255.0F);

  double pose[6] = {};
  simulation.GetProperty("r2", "pose", pose, 3 * sizeof(double));
  EXPECT_EQ(pose[0], 2.0);
  const double stage[4] = {2.5, 1.0, 0.0, 0.5};
  simulation.SetProperty("r2", "pose", stage, sizeof stage);
  simulation.GetProperty("r2", "pose", pose, sizeof pose);
  EXPECT_EQ(pose[0], 2.5);
  EXPECT_EQ(pose[5], 0.5);

  double size[3] = {};
  simulation.GetProperty("r1", "size", size, sizeof size);
  EXPECT_NEAR(size[0], 0.174, 1e-12);
  EXPECT_NEAR(size[1], 0.162, 1e-12);
  EXPECT_NEAR(size[2], 0.18, 1e-12);
  const double wide[2] = {0.3, 0.3};
  simulation.SetProperty("b", "size", wide, sizeof wide);
  simulation.GetProperty("b", "size", size, sizeof size);
  EXPECT_EQ(size[0], 0.3);
  EXPECT_EQ(size[2], 0.16);  // unchanged

  std::int32_t extended = 7;
  simulation.GetProperty("d", "state", &extended, sizeof extended);
  EXPECT_EQ(extended, 1);
  extended = 0;
  simulation.SetProperty("d", "state", &extended, sizeof extended);
  simulation.GetProperty("d", "state", text, sizeof text);
  EXPECT_STREQ(text, "retracted");
  simulation.SetProperty("d", "state", "extended", 9);
  bool on = false;
  simulation.GetProperty("d", "state", &on, sizeof on);
  EXPECT_TRUE(on);
  simulation.GetProperty("r1", "model", text, sizeof text);
  EXPECT_STREQ(text, "s1r");
  simulation.GetProperty("border", "kind", text, sizeof text);
  EXPECT_STREQ(text, "border");
  on = false;
  simulation.SetProperty("r1", "dynamics", &on, sizeof on);
  double dynamics = 1.0;
  simulation.GetProperty("r1", "dynamics", &dynamics, sizeof dynamics);
  EXPECT_EQ(dynamics, 0.0);
}

TEST_P(WorldProxies, FiducialNumbers_SetForFinders) {
  const auto robot = client();
  SimulationProxy simulation(robot.get(), 0);
  FiducialProxy finder(robot.get(), 0);
  robot->Read();
  EXPECT_EQ(finder.GetCount(), 0U);
  std::int32_t number = 7;
  simulation.GetProperty("b", "fiducial_return", &number, sizeof number);
  EXPECT_EQ(number, 0);
  number = 300;
  simulation.SetProperty("b", "fiducial_return", &number, sizeof number);
  number = 4;
  simulation.SetProperty("r2", "_mp_fiducial_return", &number, sizeof number);
  double same = 0.0;
  simulation.GetProperty("b", "fiducial_return", &same, sizeof same);
  EXPECT_EQ(same, 300.0);
  robot->Read();
  ASSERT_EQ(finder.GetCount(), 2U);  // nearest first; both are visible to r1
  EXPECT_EQ(finder.GetFiducialItem(0).id, 4);
  EXPECT_EQ(finder.GetFiducialItem(1).id, 300);
  number = 0;
  simulation.SetProperty("r2", "fiducial_return", &number, sizeof number);
  robot->Read();
  ASSERT_EQ(finder.GetCount(), 1U);
  EXPECT_EQ(finder.GetFiducialItem(0).id, 300);
}

TEST_P(WorldProxies, UnknownProperty_ErrorListsExistingWithLengths) {
  const auto robot = client();
  SimulationProxy simulation(robot.get(), 0);
  char value[64] = {};
  const auto get = [&](const char* object, const char* property, std::size_t length) {
    return warning_of([&] { simulation.GetProperty(object, property, value, length); });
  };
  const auto set = [&](const char* object, const char* property, std::size_t length) {
    return warning_of([&] { simulation.SetProperty(object, property, value, length); });
  };
  EXPECT_THAT(get("r1", "wings", 4),
              HasSubstr("colour, dynamics, fiducial_return, kind, model, pose, size, stalled, "
                        "velocity"));
  EXPECT_THAT(get("border", "state", 4), HasSubstr("it has: kind, pose, size"));
  EXPECT_THAT(get("zz", "pose", 24), HasSubstr("\"zz\""));
  EXPECT_THAT(get("r1", "pose", 5), AllOf(HasSubstr("24 bytes"), HasSubstr("value_len is 5")));
  EXPECT_THAT(get("r1", "model", 3), HasSubstr("needs 4 bytes"));
  EXPECT_THAT(get("r1", "colour", 3), HasSubstr("needs 8 bytes"));
  std::int32_t number = 300;
  simulation.SetProperty("b", "fiducial_return", &number, sizeof number);
  EXPECT_THAT(get("b", "fiducial_return", 1), HasSubstr("4 or 8 bytes"));
  EXPECT_THAT(get("b", "fiducial_return", 3), HasSubstr("value_len is 3"));
  const auto set_number = [&](double x) {
    return warning_of([&] { simulation.SetProperty("b", "fiducial_return", &x, sizeof x); });
  };
  EXPECT_THAT(set_number(-1.0), HasSubstr("whole number"));
  for (const double x : {0.5, 3e9}) set_number(x);  // one warning
  number = 0;
  simulation.GetProperty("b", "fiducial_return", &number, sizeof number);
  EXPECT_EQ(number, 300);
  EXPECT_THAT(get("border", "fiducial_return", 4), HasSubstr("it has: kind, pose, size"));
  EXPECT_THAT(set("r1", "size", 16), HasSubstr("keeps its size"));
  EXPECT_THAT(set("r1", "model", 4), HasSubstr("cannot be changed"));
  EXPECT_THAT(set("b", "state", 4), HasSubstr("static"));
  EXPECT_THAT(set("b", "colour", 8), HasSubstr("#rrggbb"));
  EXPECT_THAT(set("b", "size", 16), HasSubstr("0.001"));
  EXPECT_THAT(set("b", "pose", 7), HasSubstr("value_len is 7"));
  EXPECT_EQ(error_of([&] {
              simulation.GetProperty("r1", "pose", static_cast<void*>(nullptr), 24);
            }).GetErrorCode(),
            PlayerError::kBadArgument);
}

TEST_P(WorldProxies, RestoredWorld_TimeContinues) {
  const auto robot = client();
  SimulationProxy simulation(robot.get(), 0);
  PlayerCc::Position2dProxy motors(robot.get(), 0);
  motors.SetSpeed(0.2, 0.0);
  for (int i = 0; i < 3; ++i) robot->Read();
  double x = 0.0;
  double y = 0.0;
  double a = 0.0;
  simulation.GetPose2d("r1", x, y, a);
  simulation.SaveState("before");
  std::uint32_t green = 0xff00ff00;
  simulation.SetProperty("r1", "color", &green, sizeof green);
  // The same drive twice, from the same pose.
  std::vector<double> ends;
  for (int attempt = 0; attempt < 2; ++attempt) {
    for (int i = 0; i < 5; ++i) robot->Read();
    double end = 0.0;
    simulation.GetPose2d("r1", end, y, a);
    EXPECT_GT(end, x + 0.05);
    ends.push_back(end);
    const double data_time = motors.GetDataTime();
    simulation.RestoreState("before");
    double now = 0.0;
    simulation.GetPose2d("r1", now, y, a);
    EXPECT_EQ(now, x);
    robot->Read();
    EXPECT_GT(motors.GetDataTime(), data_time);
    simulation.RestoreState("before");
  }
  EXPECT_EQ(ends[0], ends[1]);
  std::uint32_t colour = 0;
  simulation.GetProperty("r1", "color", &colour, sizeof colour);
  EXPECT_NE(colour, green);
  EXPECT_THAT(warning_of([&] { simulation.RestoreState("later"); }),
              HasSubstr("no state was saved as \"later\"; there are: before"));
  EXPECT_THAT(warning_of([&] { simulation.SaveState("two\nlines"); }),
              HasSubstr("1 to 64 printable bytes"));
  for (int i = 1; i < 64; ++i) simulation.SaveState(std::to_string(i));
  simulation.SaveState("before");  // overwrites the existing one
  EXPECT_THAT(warning_of([&] { simulation.SaveState("64"); }), HasSubstr("64 states are saved"));
}

TEST_P(WorldProxies, LockedWorld_ReadOnly) {
  const test::ReachableHost locked(
      playerlike::Host::create(sim::load_world_text(
          R"({"simulation": {"lock_objects": true}, "robots": [{"name": "r1"}]})")),
      GetParam());
  PlayerClient robot(locked.connect(6665));
  SimulationProxy simulation(&robot, 0);
  double x = 0.0;
  simulation.GetPose2d("r1", x, x, x);
  EXPECT_THAT(warning_of([&] { simulation.SetPose2d("r1", 0.9, 0.5, 0.0); }),
              HasSubstr("SetPose2d does nothing: "));
  double now = 0.0;
  simulation.GetPose2d("r1", now, x, x);
  EXPECT_NE(now, 0.9);
  EXPECT_THAT(warning_of([&] { simulation.SaveState("s"); }), HasSubstr("lock_objects"));
  EXPECT_THAT(warning_of([&] { simulation.RestoreState("s"); }), HasSubstr("lock_objects"));
  std::int32_t on = 0;
  EXPECT_THAT(warning_of([&] { simulation.SetProperty("d1", "state", &on, 4); }),
              HasSubstr("lock_objects"));
}

// With tokens, only a client that may command a robot may move it, and only a client that may
// command all robots may move what belongs to no robot.
TEST(WorldProxiesOfAServer, Changes_NeedTokens) {
  const test::TokenServer server(kWorld);
  const auto refused = [](auto action) {
    EXPECT_THAT(warning_of(action), AnyOf(HasSubstr("token"), HasSubstr("all robots")));
  };
  const auto some = server.client(test::TokenServer::kServerToken);
  SimulationProxy simulation(some.get(), 0);
  simulation.SetPose2d("r1", 0.5, 0.5, 0.0);
  refused([&] { simulation.SetPose2d("r2", 0.5, 1.5, 0.0); });
  refused([&] { simulation.SetPose2d("b", 3.5, 1.0, 0.0); });
  refused([&] { simulation.SaveState("s"); });
  refused([&] { simulation.RestoreState("s"); });
  std::int32_t off = 0;
  refused([&] { simulation.SetProperty("d", "state", &off, sizeof off); });
  double x = 0.0;
  double y = 0.0;
  double a = 0.0;
  simulation.GetPose2d("r2", x, y, a);
  EXPECT_EQ(x, 2.0);
  const auto other = server.client(test::TokenServer::kTokenOfR2);
  LogProxy log(other.get(), 0);
  log.QueryState();
  EXPECT_THAT(error_of([&] { log.SetWriteState(1); }).GetErrorStr(),  // r1's
              AnyOf(HasSubstr("token"), HasSubstr("all robots")));
  const auto all = server.client(test::TokenServer::kBothTokens);
  SimulationProxy(all.get(), 0).SetPose2d("b", 3.5, 1.0, 0.0);
}

// --- the map in tiles

TEST_P(WorldProxies, LargeMaps_FetchedInTiles) {
  const test::ReachableHost host(playerlike::Host::create(sim::load_world_text(R"({
        "arena": {"origin": [-1, 2], "size": [12.9, 10.4], "obstacles": [
          {"name": "b", "center": [5.5, 8], "size": [9, 0.4], "yaw_deg": 30}]},
        "canvas": {"cell_size": 0.01}, "robots": [{"pose": {"x": 0, "y": 3}}]})")),
                                 GetParam());
  const auto session = host.connect(6665);
  const sim::OccupancyMap map =
      session->request(playerlike::WorldMapRequest{0.01}).map;  // 1290 x 1040 cells
  const sim::OccupancyMap whole =
      host.host().connect(6665)->request(playerlike::WorldMapRequest{0.01}).map;
  EXPECT_EQ(map.width, 1290);
  EXPECT_EQ(map.height, 1040);
  EXPECT_EQ(map.origin, whole.origin);
  EXPECT_EQ(map.cell_size_m, whole.cell_size_m);
  EXPECT_TRUE(map.cells == whole.cells);

  PlayerClient client(host.connect(6665));
  MapProxy proxy(&client, 0);
  proxy.RequestMap();
  ASSERT_EQ(proxy.GetWidth(), 1290U);
  ASSERT_EQ(proxy.GetHeight(), 1040U);
  std::vector<std::int8_t> cells(whole.cells.size());
  proxy.GetMap(cells.data());
  int different = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // The proxy's rows begin at the bottom, and its cells are 1 or -1.
    const float cell = whole.cells[(1039 - i / 1290) * 1290 + i % 1290];
    different += cells[i] != (cell > 0.5F ? 1 : -1);
  }
  EXPECT_EQ(different, 0);
}

// --- voices, lights, lines, messages

TEST_P(WorldProxies, Speech_Spoken) {
  const auto robot = client();
  SpeechProxy speech(robot.get(), 0);
  EXPECT_EQ(speech.GetInterfaceStr(), "speech");
  speech.Say("here\n\xc5\x99 \xff!");
  speech.Say(std::string(254, 'x') + "\xc5\x99");  // there is no room for the last character
  robot->Read();
  std::vector<std::string> said;
  host_->host().with_simulation([&](const sim::Simulation& simulation) {
    for (const sim::SpokenText& u : simulation.spoken_texts()) said.push_back(u.text);
  });
  EXPECT_THAT(said, testing::ElementsAre("here \xc5\x99 ?!", std::string(254, 'x')));
  host_->host().finish();
  std::ifstream report(folder_.path() / "report.json");
  std::ostringstream text;
  text << report.rdbuf();
  EXPECT_THAT(text.str(), AllOf(HasSubstr("\"said\""), HasSubstr("here \xc5\x99 ?!"),
                                HasSubstr("\"robot\": \"r1\"")));
}

TEST_P(WorldProxies, Lines_ReadAndSet) {
  const auto first = client();
  const auto second = client(6666);
  DioProxy dio(first.get(), 0);
  DioProxy other(second.get(), 0);
  AioProxy aio(first.get(), 0);
  EXPECT_EQ(dio.GetCount(), 0U);
  EXPECT_EQ(aio.GetCount(), 0U);
  EXPECT_FALSE(dio.GetInput(0));
  EXPECT_EQ(aio.GetVoltage(0), 0.0);
  other.SetOutput(1, 1);
  aio.SetVoltage(1, -0.5);
  first->Read();
  second->Read();
  first->Read();
  EXPECT_EQ(dio.GetCount(), 2U);
  EXPECT_EQ(dio.GetDigin(), 3U);
  EXPECT_TRUE(dio.GetInput(0));
  EXPECT_EQ(dio[1], 1U);
  EXPECT_EQ(aio.GetCount(), 2U);
  EXPECT_EQ(aio.GetVoltage(0), 5.0);
  EXPECT_EQ(aio[1], -0.5);
  EXPECT_THAT(error_of([&] { aio.SetVoltage(0, INFINITY); }).GetErrorStr(), HasSubstr("inf"));
  std::ostringstream text;
  text << dio << aio;
  EXPECT_THAT(text.str(), AllOf(HasSubstr("\n11\n"), HasSubstr("5\t-0.5")));
}

// The front of r1 is at x = 1.087 and its paddles reach 1.187. The can covers x = 1.11 to 1.15, and
// 0.04 m of 0.08 m across.
constexpr const char* kCanWorld = R"({
  "arena": {"size": [4, 2], "obstacles": [
    {"name": "can", "center": [1.13, 1], "size": [0.04, 0.04], "portable": true}]},
  "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"gripper": {
    "length": 0.1, "opening": 0.08, "thickness": 0.01, "travel_time": 0.6, "capacity": 1}}}]})";

TEST_P(WorldProxies, Gripper_GripsAndCarries) {
  test::ReachableHost host(playerlike::Host::create(sim::load_world_text(kCanWorld)), GetParam());
  PlayerClient robot(host.connect(6665));
  GripperProxy gripper(&robot, 0);
  Position2dProxy position(&robot, 0);
  SimulationProxy simulation(&robot, 0);
  const auto read = [&robot](int rounds) {
    for (int i = 0; i < rounds; ++i) robot.Read();
  };
  EXPECT_EQ(gripper.GetState(), 0U);
  gripper.RequestGeometry();
  EXPECT_NEAR(gripper.GetPose().px, 0.087, 1e-12);
  EXPECT_NEAR(gripper.GetInnerSize().sw, 0.08, 1e-12);
  EXPECT_NEAR(gripper.GetOuterSize().sw, 0.10, 1e-12);
  EXPECT_NEAR(gripper.GetOuterSize().sl, 0.1, 1e-12);
  EXPECT_EQ(gripper.GetNumBeams(), 2U);
  EXPECT_EQ(gripper.GetCapacity(), 1U);
  read(1);
  EXPECT_EQ(gripper.GetState(), static_cast<uint32_t>(PLAYER_GRIPPER_STATE_OPEN));
  // The inner beam is at 1.112, the outer one at 1.162.
  EXPECT_EQ(gripper.GetBeams(), 0x08U);
  EXPECT_EQ(gripper.GetInnerBreakBeam(), 1U);
  EXPECT_EQ(gripper.GetOuterBreakBeam(), 0U);
  EXPECT_EQ(gripper.GetPaddlesOpen(), 1U);
  gripper.Close();
  read(2);
  EXPECT_EQ(gripper.GetState(), static_cast<uint32_t>(PLAYER_GRIPPER_STATE_MOVING));
  EXPECT_EQ(gripper.GetPaddlesMoving(), 1U);
  read(2);  // 0.6 (1 - 0.04 / 0.08) = 0.3 s and a step
  EXPECT_EQ(gripper.GetState(), static_cast<uint32_t>(PLAYER_GRIPPER_STATE_CLOSED));
  EXPECT_EQ(gripper.GetPaddlesClosed(), 1U);
  EXPECT_EQ(gripper.GetPaddlesOpen(), 0U);
  EXPECT_EQ(gripper.GetGripperError(), 0U);
  position.SetSpeed(0.2, 0.0);
  read(10);
  position.SetSpeed(0.0, 0.0);
  read(2);
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  simulation.GetPose2d("can", x, y, yaw);
  EXPECT_NEAR(x, position.GetXPos() + 0.13, 1e-6);
  EXPECT_GT(x, 1.3);
  gripper.Store();
  read(1);
  EXPECT_EQ(gripper.GetStored(), 1U);
  gripper.SetGrip(8);  // retrieve
  read(1);
  EXPECT_EQ(gripper.GetStored(), 0U);
  std::ostringstream text;
  text << gripper;
  EXPECT_THAT(text.str(), HasSubstr("closed\t0\t1\t0"));
  gripper.Open();
  read(8);
  EXPECT_EQ(gripper.GetPaddlesOpen(), 1U);
  EXPECT_EQ(error_of([&] { gripper.SetGrip(4); }).GetErrorCode(), PlayerError::kNotAvailable);
  EXPECT_EQ(error_of([&] { gripper.SetGrip(99); }).GetErrorCode(), PlayerError::kBadArgument);
}

TEST_P(WorldProxies, MorseGripper_Grips) {
  test::ReachableHost host(playerlike::Host::create(sim::load_world_text(kCanWorld)), GetParam());
  CCMorse::MorseClient client(host.connect(4000));
  CCMorse::MorseGripper gripper(client.GetRobot("r1"));
  EXPECT_EQ(gripper.GetStatus(), "");
  EXPECT_EQ(gripper.GetCapacity(), 1);
  EXPECT_EQ(gripper.GetOpening(), 0.08);
  gripper.Close();
  const auto read = [&client](int rounds) {
    for (int i = 0; i < rounds; ++i) client.Read();
  };
  read(1);
  EXPECT_EQ(gripper.GetStatus(), "moving");
  EXPECT_TRUE(gripper.IsInnerBeamBroken());
  EXPECT_FALSE(gripper.IsOuterBeamBroken());
  EXPECT_FALSE(gripper.IsHolding());
  read(3);
  EXPECT_EQ(gripper.GetStatus(), "closed");
  EXPECT_TRUE(gripper.IsHolding());
  EXPECT_NEAR(gripper.GetGap(), 0.04, 1e-9);
  gripper.Store();
  gripper.Stop();
  read(1);
  EXPECT_EQ(gripper.GetStored(), 1);
  EXPECT_EQ(gripper.GetStatus(), "open");  // stopped midway
  gripper.Retrieve();
  read(1);
  EXPECT_EQ(gripper.GetStored(), 0);
  EXPECT_TRUE(gripper.IsHolding());
  gripper.Open();
  read(1);
  EXPECT_FALSE(gripper.IsHolding());
  EXPECT_EQ(gripper.GetStatus(), "moving");
}

TEST_P(WorldProxies, PortableObjects_StoredAndReleased) {
  test::ReachableHost host(playerlike::Host::create(sim::load_world_text(kCanWorld)), GetParam());
  PlayerClient robot(host.connect(6665));
  GripperProxy gripper(&robot, 0);
  SimulationProxy simulation(&robot, 0);
  gripper.Close();
  for (int i = 0; i < 5; ++i) robot.Read();
  EXPECT_EQ(gripper.GetPaddlesClosed(), 1U);
  simulation.SetPose2d("can", -10.0, -10.0, 0.0);
  robot.Read();
  robot.Read();
  EXPECT_EQ(gripper.GetBeams(), 0U);
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  simulation.GetPose2d("can", x, y, yaw);
  EXPECT_EQ(x, -10.0);
}

TEST_P(WorldProxies, Lights_Switched) {
  const auto robot = client();
  BlinkenLightProxy light(robot.get(), 0);
  robot->Read();
  EXPECT_FALSE(light.GetEnable());
  EXPECT_EQ(light.GetPeriod(), 1.0);
  EXPECT_EQ(light.GetDutyCycle(), 0.5);
  EXPECT_EQ(light.GetRed(), 0xff);
  light.SetColor(1, 2, 3);
  light.SetPeriod(0.3);
  light.SetDutyCycle(0.5);
  light.SetEnable(true);
  robot->Read();  // 0.2 s: 0.2 mod 0.3 >= 0.15
  EXPECT_TRUE(light.GetEnable());
  EXPECT_EQ(light.GetGreen(), 2);
  EXPECT_FALSE(light.IsLit());
  robot->Read();
  EXPECT_TRUE(light.IsLit());
  EXPECT_EQ(error_of([&] { light.SetPeriod(-1.0); }).GetErrorCode(), PlayerError::kBadArgument);
  EXPECT_EQ(error_of([&] { light.SetDutyCycle(NAN); }).GetErrorCode(), PlayerError::kBadArgument);

  CCMorse::MorseClient morse(host_->connect(4000));
  CCMorse::MorseLight same(morse.GetRobot("r1"));
  same.SetColour(9, 9, 9);
  same.SetBlinking(0.0);
  same.SetOn(true);
  EXPECT_EQ(error_of([&] { same.SetBlinking(0.1, 2.0); }).GetErrorCode(),
            PlayerError::kBadArgument);
}

TEST_P(WorldProxies, Messages_Sent) {
  const auto first = client();
  const auto second = client(6666);
  OpaqueProxy hears(first.get(), 0);
  OpaqueProxy sends(second.get(), 0);
  EXPECT_EQ(hears.GetCount(), 0U);
  hears.GetData(nullptr);  // nothing to copy
  std::vector<std::uint8_t> bytes = {0, 255, 10, 13, 128};
  player_opaque_data_t message = {static_cast<std::uint32_t>(bytes.size()), bytes.data()};
  sends.SendCmd(&message);
  second->ReadIfWaiting();
  first->Read();
  ASSERT_EQ(hears.GetCount(), 5U);
  EXPECT_TRUE(hears.IsFresh());
  std::vector<std::uint8_t> heard(5);
  hears.GetData(heard.data());
  EXPECT_EQ(heard, bytes);
  EXPECT_EQ(error_of([&] { hears.GetData(nullptr); }).GetErrorCode(), PlayerError::kBadArgument);
  hears.NotFresh();
  EXPECT_EQ(sends.SendReq(&message), 0);
  second->Read();  // its own echo
  EXPECT_EQ(sends.GetCount(), 5U);
  std::ostringstream text;
  text << sends;
  EXPECT_THAT(text.str(), HasSubstr("5 00 ff 0a 0d 80"));

  std::vector<std::uint8_t> longer(65537);
  player_opaque_data_t too_long = {65537, longer.data()};
  EXPECT_THAT(error_of([&] { sends.SendCmd(&too_long); }).GetErrorStr(), HasSubstr("65536"));
  EXPECT_EQ(error_of([&] { sends.SendCmd(nullptr); }).GetErrorCode(), PlayerError::kBadArgument);
}

TEST_P(WorldProxies, Freshness_SetByMessageOnly) {
  const auto robot = client(6666);  // hears itself
  OpaqueProxy opaque(robot.get(), 0);
  robot->Read();
  EXPECT_FALSE(opaque.IsFresh());
  std::uint8_t byte = 7;
  player_opaque_data_t message = {1, &byte};
  opaque.SendCmd(&message);
  robot->Read();
  EXPECT_TRUE(opaque.IsFresh());
  robot->Read();
  EXPECT_TRUE(opaque.IsFresh());  // nobody has reset the flag
  opaque.NotFresh();
  robot->Read();
  EXPECT_FALSE(opaque.IsFresh());
  EXPECT_EQ(opaque.GetCount(), 1U);  // the message stays
}

// --- the log

TEST_P(WorldProxies, Log_WrittenAndReplayed) {
  const auto robot = client();
  Position2dProxy position(robot.get(), 0);
  LaserProxy laser(robot.get(), 0);
  LogProxy log(robot.get(), 0);
  EXPECT_EQ(log.GetType(), 0);
  log.QueryState();
  EXPECT_EQ(log.GetType(), PLAYER_LOG_TYPE_WRITE);
  EXPECT_EQ(log.GetState(), 0);
  log.SetFilename("drive");
  log.SetWriteState(1);
  EXPECT_EQ(log.GetState(), 1);
  position.SetSpeed(0.2, 0.1);
  std::vector<double> xs;
  std::vector<double> ranges;
  for (int i = 0; i < 10; ++i) {
    robot->Read();
    xs.push_back(position.GetXPos());
    ranges.push_back(laser.GetRange(341));
  }
  log.SetWriteState(0);
  position.SetSpeed(-0.1, 0.0);
  for (int i = 0; i < 5; ++i) robot->Read();
  const double now = position.GetDataTime();

  log.SetReadState(1);
  EXPECT_EQ(log.GetType(), PLAYER_LOG_TYPE_READ);
  for (std::size_t i = 0; i < xs.size(); ++i) {
    robot->Read();
    EXPECT_EQ(position.GetXPos(), xs[i]) << i;  // to the bit
    EXPECT_EQ(laser.GetRange(341), ranges[i]) << i;
    EXPECT_NEAR(position.GetDataTime(), now + 0.1 * static_cast<double>(i + 1), 1e-9) << i;
  }
  log.QueryState();
  EXPECT_EQ(log.GetState(), 0);  // the end of the log
  robot->Read();
  EXPECT_LT(position.GetXPos(), xs.back() - 0.05);  // its real position
  log.SetState(1);                                  // again from the beginning
  robot->Read();
  EXPECT_EQ(position.GetXPos(), xs[0]);
  robot->Read();
  log.Rewind();
  robot->Read();
  EXPECT_EQ(position.GetXPos(), xs[0]);

  std::ifstream file(folder_.path() / "drive.jsonl");
  std::string head;
  std::getline(file, head);
  EXPECT_EQ(head, R"({"playpen_log":1,"port":6665,"t":0,"world":"small"})");
  std::string line;
  while (std::getline(file, line)) EXPECT_THAT(line, HasSubstr(R"("robot":"r1")"));
}

TEST_P(WorldProxies, InvalidLog_Refused) {
  const auto robot = client();
  LogProxy log(robot.get(), 0);
  const auto code = [](auto action) { return error_of(action).GetErrorCode(); };
  for (const char* name : {"", "../up", "/etc/passwd", "a/b", ".hidden", "x\ny"}) {
    EXPECT_EQ(code([&] { log.SetFilename(name); }), PlayerError::kBadArgument) << name;
  }
  log.SetFilename("none");
  EXPECT_EQ(code([&] { log.SetReadState(1); }), PlayerError::kNotAvailable);
  const auto try_file = [&](const std::string& content) {
    std::ofstream(folder_.path() / "bad.jsonl") << content;
    log.SetFilename("bad.jsonl");
    const PlayerError error = error_of([&] { log.SetReadState(1); });
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kBadArgument);
    return error.GetErrorStr();
  };
  const std::string head = "{\"playpen_log\": 1, \"t\": 0}\n";
  EXPECT_THAT(try_file("hello\n"), HasSubstr("bad.jsonl:1"));
  EXPECT_THAT(try_file("{\"playpen_log\": 2, \"t\": 0}\n"), HasSubstr("playpen_log"));
  EXPECT_THAT(try_file(head + "{}\n"), AllOf(HasSubstr("bad.jsonl:2"), HasSubstr("robot")));
  EXPECT_THAT(try_file(head), HasSubstr("no reading"));
  EXPECT_THAT(
      try_file(head + R"({"robot": "r1", "device": "pose", "type": "pose", "seq": 1, "t": 5})"),
      HasSubstr("\"x\""));
  log.SetWriteState(1);
  EXPECT_EQ(code([&] { log.SetFilename("other"); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { log.SetReadState(1); }), PlayerError::kBadArgument);
  EXPECT_EQ(code([&] { log.Rewind(); }), PlayerError::kBadArgument);
  std::ostringstream text;
  log.QueryState();
  text << log;
  EXPECT_THAT(text.str(), HasSubstr("write\t1"));

  const test::ReachableHost without(playerlike::Host::create(sim::load_world_text(kWorld)),
                                    GetParam());
  PlayerClient other(without.connect(6665));
  LogProxy nowhere(&other, 0);
  const PlayerError error = error_of([&] { nowhere.SetWriteState(1); });
  EXPECT_EQ(error.GetErrorCode(), PlayerError::kNotAvailable);
  EXPECT_THAT(error.GetErrorStr(), HasSubstr("PLAYPEN_OUT"));
}

}  // namespace
