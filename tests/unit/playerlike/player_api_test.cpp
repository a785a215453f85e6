// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Properties that programs for Player 2 and 3 rely on in addition to the devices: proxies without a
// device in the world, subclasses, signals, old names, printing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "fake_session.h"
#include "libplayerc++/playerc++.h"
#include "player-2.1/libplayerc++/playerc++.h"
#include "playerlike/host/host.h"
#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace {

using namespace PlayerCc;  // as programs do; NOLINT(google-build-using-namespace)
using test::error_code_of;
using test::fake_session;
using test::FakeWorld;
using test::kPose;
using test::make_fake_world;
using test::pose_reading;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

template <typename T>
std::string printed(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

class PlayerApi : public testing::Test {
 protected:
  std::shared_ptr<FakeWorld> world = make_fake_world();
  PlayerClient client{fake_session(world)};
};

// --- Proxies without a device

/// The error of a proxy's constructor; index 0 by default.
template <typename Proxy>
PlayerError refusal(PlayerClient& client, uint32_t index = 0) {
  try {
    Proxy proxy(&client, index);
  } catch (PlayerError error) {  // by value, as half of the programs do; NOLINT
    return error;
  }
  ADD_FAILURE() << "the proxy was made";
  return {};
}

TEST_F(PlayerApi, MissingDevice_ErrorListsExistingAndOtherWorlds) {
  const PlayerError error = refusal<StereoProxy>(client);
  EXPECT_EQ(error.GetErrorCode(), PlayerError::kNoSuchDevice);
  EXPECT_EQ(error.GetErrorFun(), "StereoProxy::StereoProxy");
  EXPECT_EQ(
      error.GetErrorStr(),
      "there is no device stereo:0 on port 6665; this world has there: graphics2d:0 (r1.pen), "
      "laser:0 (r1.laser), localize:0 (r1.pose), position2d:0 (r1.pose), position2d:1 "
      "(r1.odometry), ranger:0 (r1.laser), blackboard:0 (the world), log:0 (the world), map:0 (the "
      "world), simulation:0 (the world); no world that comes with Playpen has a device for stereo");
}

TEST_F(PlayerApi, UnavailableProxy_RefusedInItsOwnName) {
  const std::vector<PlayerError> errors = {
      refusal<AudioProxy>(client),        refusal<BlobfinderProxy>(client),
      refusal<CameraProxy>(client),       refusal<CoopObjectProxy>(client),
      refusal<Graphics3dProxy>(client),   refusal<HealthProxy>(client),
      refusal<LimbProxy>(client),         refusal<LinuxjoystickProxy>(client),
      refusal<Pointcloud3dProxy>(client), refusal<Position1dProxy>(client),
      refusal<Position3dProxy>(client),   refusal<PtzProxy>(client),
      refusal<RFIDProxy>(client),         refusal<SpeechRecognitionProxy>(client),
      refusal<StereoProxy>(client),       refusal<VectorMapProxy>(client),
      refusal<WSNProxy>(client)};
  const std::vector<std::string> interfaces = {
      "audio", "blobfinder",         "camera",       "coopobject", "graphics3d", "health",
      "limb",  "joystick",           "pointcloud3d", "position1d", "position3d", "ptz",
      "rfid",  "speech_recognition", "stereo",       "vectormap",  "wsn"};
  ASSERT_EQ(errors.size(), interfaces.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(errors[i].GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_THAT(errors[i].GetErrorStr(), HasSubstr("no device " + interfaces[i] + ":0 on port"));
  }
}

TEST(MissingDevice, Error_NamesWorldWithDevice) {
  const auto host = playerlike::Host::create(sim::load_world_text(
      R"({"arena": {"size": [2, 2]},
          "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"laser": false}}]})"));
  PlayerClient client(host->connect(6665));
  const std::string text = refusal<LaserProxy>(client).GetErrorStr();
  EXPECT_THAT(text, HasSubstr("; of the worlds that come with Playpen, worlds/devices/laser.json "
                              "has one"));
}

TEST(MissingDevice, InterfaceOfPort_ErrorNamesNoOtherWorld) {
  const auto world = make_fake_world();
  PlayerClient client(fake_session(world));
  EXPECT_THAT(refusal<LaserProxy>(client, 7).GetErrorStr(), Not(HasSubstr("come with Playpen")));
  EXPECT_THAT(refusal<MapProxy>(client, 7).GetErrorStr(), Not(HasSubstr("come with Playpen")));
}

TEST_F(PlayerApi, ExampleWorlds_HaveTheirInterfaces) {
  int count = 0;
  for (int code = 1; code <= PLAYER_COOPOBJECT_CODE; ++code) {
    const std::string interface = client.LookupName(code);
    const std::string file = playerlike::example_world(interface);
    if (file.empty()) continue;
    ++count;
    const std::filesystem::path path = std::filesystem::path(PLAYPEN_SOURCE_DIR) / "worlds" / file;
    const sim::Simulation simulation(sim::load_world(path.string()));
    const auto robots = playerlike::describe_robots(simulation);
    bool found = false;
    for (const auto& robot : robots) {
      for (const auto& address : playerlike::list_interfaces(robots, robot.port)) {
        found = found || address.interface == interface;
      }
    }
    EXPECT_TRUE(found) << interface << " in " << file;
  }
  EXPECT_GE(count, 3);  // at least laser, position2d and graphics2d
}

// --- The page of all proxies

std::string content(const std::string& file) {
  return test_support::read_bytes(std::filesystem::path(PLAYPEN_SOURCE_DIR) / file);
}

TEST(PageOfProxies, HasEveryClassOfTables) {
  const std::string page = content("docs/player_api.md");
  const std::string tables = content("tests/compat/player-api/proxies.md");
  static const std::regex kClass("\n## (\\w+Proxy) ");
  int count = 0;
  for (std::sregex_iterator it(tables.begin(), tables.end(), kClass), end; it != end;
       ++it, ++count) {
    EXPECT_THAT(page, HasSubstr('`' + (*it)[1].str() + '`'));
  }
  EXPECT_GE(count, 40);
}

TEST(PageOfProxies, States_WhatWorksInWhichWorld) {
  std::istringstream lines(content("docs/player_api.md"));
  // | proxy | interface | device | `devices/NAME.json`... |, and rows of proxies that only compile
  static const std::regex kWorks(R"(\| `\w+` \| `(\w+)` \| .* \| `(devices/\w+\.json)`.*)");
  static const std::regex kName("`(\\w+)`");
  bool compiles_only = false;
  int works = 0;
  int refused = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) compiles_only = line == "## Proxies that only compile";
    std::smatch row;
    if (std::regex_match(line, row, kWorks)) {
      ++works;
      const std::string world = playerlike::example_world(row[1].str());
      if (!world.empty()) {
        EXPECT_EQ(world, row[2]) << line;
      }
    } else if (compiles_only && line.rfind("| `", 0) == 0) {
      // The second cell has the interfaces.
      const auto begin = line.find('|', 1);
      const std::string cell = line.substr(begin, line.find('|', begin + 1) - begin);
      for (std::sregex_iterator it(cell.begin(), cell.end(), kName), end; it != end; ++it) {
        ++refused;
        EXPECT_EQ(playerlike::example_world((*it)[1].str()), "") << line;
      }
    }
  }
  EXPECT_GE(works, 10);
  EXPECT_EQ(refused, 14);
}

TEST(PageOfProxies, States_DevicesOfPioneers) {
  std::vector<std::string> interfaces;
  std::vector<std::string> only_of_the_first;
  std::istringstream lines(content("docs/player_api.md"));
  static const std::regex kPioneers(R"(\| `\w+` \| `(\w+)` \| .*\bPioneer\b.*)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch row;
    if (!std::regex_match(line, row, kPioneers)) continue;
    const bool first = line.find("the first Pioneer") != std::string::npos;
    (first ? only_of_the_first : interfaces).push_back(row[1]);
  }
  EXPECT_GE(interfaces.size(), 17U);
  for (const char* world : {"cave.json", "office.json"}) {
    const sim::Simulation simulation(
        sim::load_world(std::string(PLAYPEN_SOURCE_DIR "/worlds/") + world));
    const auto robots = playerlike::describe_robots(simulation);
    for (const auto& robot : robots) {
      for (const std::string& interface : interfaces) {
        EXPECT_NO_THROW(
            static_cast<void>(playerlike::find_interface(robots, robot.port, interface, 0)));
      }
    }
    for (const std::string& interface : only_of_the_first) {
      EXPECT_NO_THROW(
          static_cast<void>(playerlike::find_interface(robots, robots.front().port, interface, 0)));
    }
  }
}

// --- Localisation

// Reads the position like the programs of a course, 20 of which do so.
player_pose2d_t read_position(LocalizeProxy& lp) {
  player_localize_hypoth_t hypothesis;
  player_pose2d_t pose = {0.0, 0.0, 0.0};
  uint32_t count = lp.GetHypothCount();
  if (count > 0) {
    hypothesis = lp.GetHypoth(0);
    pose = hypothesis.mean;
  }
  return pose;
}

TEST_F(PlayerApi, Localization_OneHypothesisAfterFirstReading) {
  LocalizeProxy localize(&client, 0);
  EXPECT_EQ(localize.GetHypothCount(), 0U);
  EXPECT_EQ(localize.GetParticles(), -1);
  EXPECT_EQ(localize.GetHypoth(0).alpha, 0.0);
  EXPECT_EQ(read_position(localize).px, 0.0);
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  client.Read();
  EXPECT_TRUE(localize.IsFresh());
  EXPECT_EQ(localize.GetHypothCount(), 1U);
  EXPECT_EQ(localize.GetNumHypoths(), 1U);
  EXPECT_EQ(printed(read_position(localize)), "1, 2, 0.5");
  EXPECT_DOUBLE_EQ(localize.GetHypoth(0).alpha, 1.0);
  EXPECT_EQ(localize.GetPendingCount(), 0U);
  EXPECT_EQ(localize.GetMapSizeX() + localize.GetMapSizeY(), 0U);
  EXPECT_THAT(printed(localize), HasSubstr("localize:0 valid, fresh\n"));
  EXPECT_THAT(printed(localize), HasSubstr("\n1\t1\t2\t0.5\n"));
  EXPECT_EQ(localize.HasCapability(PLAYER_MSGTYPE_DATA, PLAYER_LOCALIZE_DATA_HYPOTHS), 1);
  EXPECT_EQ(localize.HasCapability(PLAYER_MSGTYPE_CMD, 1), 0);
}

TEST_F(PlayerApi, Localization_ParticleIsHypothesis) {
  LocalizeProxy localize(&client, 0);
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  client.Read();
  EXPECT_EQ(localize.GetNumParticles(), 0U);
  EXPECT_EQ(localize.GetParticlePose(0).py, 0.0);
  EXPECT_EQ(localize.GetParticles(), 0);
  ASSERT_EQ(localize.GetNumParticles(), 1U);
  EXPECT_DOUBLE_EQ(localize.GetParticlePose(0).py, 2.0);
}

TEST_F(PlayerApi, Localization_SetPoseDoesNotReplaceReading) {
  LocalizeProxy localize(&client, 0);
  double pose[3] = {7.0, 8.0, 0.0};
  double covariance[3] = {0.2, 0.2, 0.1};  // as Player 2.1 has it: nothing behind may be looked at
  localize.SetPose(pose, covariance);
  EXPECT_TRUE(world->sent.empty());
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  client.Read();
  EXPECT_DOUBLE_EQ(localize.GetHypoth(0).mean.px, 1.0);
  pose[1] = std::nan("");
  EXPECT_EQ(error_code_of([&] { localize.SetPose(pose, covariance); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { localize.SetPose(nullptr, covariance); }),
            PlayerError::kBadArgument);
}

TEST(Localization, ReportsCovarianceOfNoise) {
  const auto host = playerlike::Host::create(sim::load_world_text(
      R"({"arena": {"size": [2, 2]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1},
          "devices": {"pose": {"noise": 0.02, "noise_yaw_deg": 3}}}]})"));
  PlayerClient client(host->connect(6665));
  LocalizeProxy localize(&client);
  client.Read();
  const player_localize_hypoth_t hypoth = localize.GetHypoth(0);
  EXPECT_NEAR(hypoth.mean.px, 1.0, 5.0 * 0.02);  // five standard deviations
  EXPECT_DOUBLE_EQ(hypoth.cov[0], 0.0004);
  EXPECT_DOUBLE_EQ(hypoth.cov[1], 0.0004);
  EXPECT_NEAR(hypoth.cov[2], dtor(3.0) * dtor(3.0), 1e-12);
  EXPECT_EQ(hypoth.cov[3], 0.0);
  EXPECT_EQ(hypoth.cov[4], 0.0);
  EXPECT_EQ(hypoth.cov[5], 0.0);
}

// --- Programs' own proxies

/// Derives from ClientProxy like a client program: it counts readings that it creates.
class CountingProxy : public ClientProxy {
 public:
  CountingProxy(PlayerClient* aPc, uint32_t aIndex = 0) : ClientProxy(aPc, aIndex) {
    Subscribe(aIndex);
  }
  ~CountingProxy() override { Unsubscribe(); }

  void Count() {
    scoped_lock_t lock(mPc->mMutex);
    ++mCount;
    mFresh = true;
  }
  int GetCount() const { return GetVar(mCount); }
  std::vector<int> GetAll() const {
    std::vector<int> all(1);
    GetVarByRef(&mCount, &mCount + 1, all.begin());
    return all;
  }
  bool HasInfo() const { return mInfo != nullptr; }

 protected:
  void Subscribe(uint32_t aIndex) override { mSubscribed = static_cast<int>(aIndex); }
  void Unsubscribe() override { mSubscribed = -1; }

 private:
  int mCount = 0;
  int mSubscribed = -1;
};

TEST_F(PlayerApi, ClientProxySubclass_UsesProtectedMembers) {
  CountingProxy proxy(&client, 3);
  EXPECT_FALSE(proxy.IsFresh());
  proxy.Count();
  EXPECT_TRUE(proxy.IsFresh());
  EXPECT_EQ(proxy.GetCount(), 1);
  EXPECT_THAT(proxy.GetAll(), ElementsAre(1));
  EXPECT_TRUE(proxy.HasInfo());
  EXPECT_EQ(proxy.GetPlayerClient(), &client);
}

// --- Signals and locks

int calls_of_function = 0;
void read_callback() { ++calls_of_function; }

struct Watcher {
  void look() { ++looks; }
  void look_at(Position2dProxy* position) { x_m = position->GetXPos(); }
  int looks = 0;
  double x_m = 0.0;
};

TEST_F(PlayerApi, ReadSignal_CallsFunctorsUntilDisconnected) {
  Position2dProxy position(&client, 0);
  Watcher watcher;
  int calls_of_lambda = 0;
  calls_of_function = 0;
  ClientProxy::connection_t function = position.ConnectReadSignal(&read_callback);
  const ClientProxy::connection_t member =
      position.ConnectReadSignal(boost::bind(&Watcher::look, &watcher));
  position.ConnectReadSignal(boost::bind(&Watcher::look_at, boost::ref(watcher), &position));
  position.ConnectReadSignal([&] { ++calls_of_lambda; });
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  world->add_round({{kPose, pose_reading(0.2, {3.0, 2.0, 0.5})}});
  client.Read();
  EXPECT_DOUBLE_EQ(watcher.x_m, 1.0);
  function.disconnect();
  position.DisconnectReadSignal(member);
  client.Read();
  EXPECT_EQ(calls_of_function, 1);
  EXPECT_EQ(watcher.looks, 1);
  EXPECT_EQ(calls_of_lambda, 2);
  EXPECT_DOUBLE_EQ(watcher.x_m, 3.0);
}

TEST_F(PlayerApi, ClientMutex_LockedUnderAllNames) {
  {
    PlayerClient::mutex_t::scoped_lock lock(client.mMutex);
    EXPECT_FALSE(client.mMutex.try_lock());
  }
  {
    boost::mutex::scoped_lock lock(client.mMutex);
    EXPECT_FALSE(client.mMutex.try_lock());
  }
  ClientProxy::scoped_lock_t lock(client.mMutex);
  EXPECT_FALSE(client.mMutex.try_lock());
}

TEST(BoostNames, DetachedThread_Continues) {
  std::atomic<int> done{0};
  {
    boost::thread forgotten([&done] { done = 1; });
    boost::thread moved;
    moved = std::move(forgotten);
    EXPECT_TRUE(moved.joinable());
  }  // otherwise std::thread would terminate the program here
  while (done == 0) std::this_thread::yield();
  boost::thread joined(boost::bind([&done](int value) { done = value; }, 2));
  joined.join();
  EXPECT_EQ(done, 2);
}

// The function with as many parameters as there are arguments, as Boost's bind chooses.
struct Overloaded {
  int of() { return 0; }
  int of(int a) { return a; }
  [[nodiscard]] int of(int a, int b) const { return a + b; }
};

TEST(BoostNames, Bind_SelectsOverloadByArity) {
  Overloaded it;
  EXPECT_EQ(boost::bind(&Overloaded::of, &it)(), 0);
  EXPECT_EQ(boost::bind(&Overloaded::of, &it, 3)(), 3);
  EXPECT_EQ(boost::bind(&Overloaded::of, boost::ref(it), 3, std::placeholders::_1)(4), 7);
}

// --- Old names

TEST_F(PlayerApi, DataModesOfPlayer16To21_Accepted) {
  for (const int mode :
       {PLAYER_DATAMODE_PUSH_ALL, PLAYER_DATAMODE_PUSH_NEW, PLAYER_DATAMODE_PUSH_ASYNC,
        PLAYER_DATAMODE_PULL_ALL, PLAYER_DATAMODE_PULL_NEW, PLAYERC_DATAMODE_PULL}) {
    EXPECT_NO_THROW(client.SetDataMode(static_cast<uint32_t>(mode)));
  }
  EXPECT_NO_THROW(client.SetFrequency(10));
}

TEST_F(PlayerApi, LaserConfigureWithoutFrequency_AsInPlayer20) {
  LaserProxy laser(&client, 0);
  const double frequency_hz = laser.GetScanningFrequency();
  laser.Configure(-0.5, 0.5, 100, 1, false);
  EXPECT_DOUBLE_EQ(laser.GetScanningFrequency(), frequency_hz);
  EXPECT_NEAR(laser.GetConfMinAngle(), -0.5, laser.GetScanRes());
}

TEST(OldTypes, PoseAndBoxOfPlayer20_MatchSuccessors) {
  static_assert(std::is_same<player_pose_t, player_pose2d_t>::value, "");
  static_assert(std::is_same<player_bbox_t, player_bbox2d_t>::value, "");
  const player_pose_t pose = {1.0, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(pose.pa, 3.0);
}

// --- Printing

TEST_F(PlayerApi, DataTypes_PrintFields) {
  EXPECT_EQ(printed(player_point_2d_t{1.0, 2.5}), "1, 2.5");
  EXPECT_EQ(printed(player_point_3d_t{1.0, 2.0, 3.0}), "1, 2, 3");
  EXPECT_EQ(printed(player_orientation_3d_t{1.0, 2.0, 3.0}), "1, 2, 3");
  EXPECT_EQ(printed(player_pose2d_t{1.0, 2.0, -0.5}), "1, 2, -0.5");
  EXPECT_EQ(printed(player_pose3d_t{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}), "1, 2, 3, 4, 5, 6");
  EXPECT_EQ(printed(player_bbox2d_t{1.0, 2.0}), "1, 2");
  EXPECT_EQ(printed(player_bbox3d_t{1.0, 2.0, 3.0}), "1, 2, 3");
  EXPECT_EQ(printed(player_segment_t{1.0, 2.0, 3.0, 4.0}), "1, 2, 3, 4");
  EXPECT_EQ(printed(player_extent2d_t{1.0, 2.0, 3.0, 4.0}), "1, 2, 3, 4");
  client.RequestDeviceList();
  EXPECT_EQ(printed(client.GetDeviceList().front()), "graphics2d:0 (pen)");
  playerc_device_info_t info = {};
  info.addr.interf = 9999;
  EXPECT_EQ(printed(info), "unknown:0 ()");
}

TEST(Messages, Print) {
  testing::internal::CaptureStderr();
  PLAYER_ERROR("it failed");
  PLAYER_WARN2("%d of %s", 3, "them");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "error   : it failed\nwarning : 3 of them\n");
  testing::internal::CaptureStdout();
  PLAYER_MSG1(1, "at %d", 4);
  PLAYER_MSG0(2, "for those who look for faults");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "at 4\n");
}

}  // namespace
