// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <future>
#include <sstream>
#include <thread>

#include "fake_session.h"
#include "libplayerc++/playerc++.h"

namespace {

using PlayerCc::ClientProxy;
using PlayerCc::LaserProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using PlayerCc::Position2dProxy;
using test::error_code_of;
using test::fake_session;
using test::FakeWorld;
using test::kLaser;
using test::kMotion;
using test::kOdometry;
using test::kPose;
using test::make_fake_world;
using test::pose_reading;
using test::scan;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

class Proxies : public testing::Test {
 protected:
  /// The twist that was sent last.
  sim::Twist last_twist() const {
    if (world->sent.empty() || !(world->sent.back().first == kMotion) ||
        !std::holds_alternative<sim::TwistCommand>(world->sent.back().second)) {
      ADD_FAILURE() << "the last command is no twist for the motors";
      return {kNan, kNan, kNan};
    }
    return std::get<sim::TwistCommand>(world->sent.back().second).twist;
  }

  std::shared_ptr<FakeWorld> world = make_fake_world();
  PlayerClient client{fake_session(world)};
};

// --- PlayerClient

TEST_F(Proxies, Client_ReportsHostPortAndInterfaces) {
  EXPECT_TRUE(client.Connected());
  EXPECT_EQ(client.GetPort(), 6665U);
  EXPECT_EQ(client.LookupCode("laser"), PLAYER_LASER_CODE);
  EXPECT_EQ(client.LookupCode("teapot"), -1);
  EXPECT_EQ(client.LookupName(PLAYER_POSITION2D_CODE), "position2d");
  EXPECT_EQ(client.LookupName(9999), "unknown");
  EXPECT_EQ(client.GetOverflowCount(), 3U);
}

// The interface of boost::mutex, with which Player's programs lock their clients.
struct ForeignMutex {
  typedef pthread_mutex_t* native_handle_type;
  void lock() { pthread_mutex_lock(&handle); }
  void unlock() { pthread_mutex_unlock(&handle); }
  pthread_mutex_t handle;
};

TEST_F(Proxies, ClientMutex_SharedWithOtherLibraries) {
  const auto is_free = [this] {
    return std::async(std::launch::async,
                      [this] {
                        const std::unique_lock<PlayerClient::mutex_t> lock(client.mMutex,
                                                                           std::try_to_lock);
                        return lock.owns_lock();
                      })
        .get();
  };
  {
    const std::unique_lock<ForeignMutex> lock(client.mMutex);
    EXPECT_FALSE(is_free());
  }
  EXPECT_TRUE(is_free());
  static_assert(!std::is_convertible<PlayerClient::mutex_t&, std::string&>::value, "");
}

TEST_F(Proxies, ClientCopies_AreOneClient) {
  auto first = std::make_unique<PlayerClient>(fake_session(world));
  LaserProxy laser(first.get(), 0);
  PlayerClient second = *first;
  EXPECT_EQ(second.GetPort(), first->GetPort());
  world->add_round({{kLaser, scan(0.1, {1.0, 2.0, 3.0})}});
  second.Read();
  EXPECT_EQ(laser.GetRange(1), 2.0);
  first.reset();
  EXPECT_TRUE(second.Connected());
  world->add_round({{kLaser, scan(0.2, {4.0, 5.0, 6.0})}});
  second.Read();
  EXPECT_EQ(laser.GetRange(1), 5.0);
}

// Player's proxies could be copied if it was built without Boost.
TEST_F(Proxies, ProxyCopy_Independent) {
  auto laser = std::make_unique<LaserProxy>(&client, 0);
  auto position = std::make_unique<Position2dProxy>(&client, 0);
  world->add_round({{kLaser, scan(0.1, {1.0, 2.0, 3.0})}, {kPose, pose_reading(0.1, {1, 2, 0.5})}});
  client.Read();
  int calls = 0;
  laser->ConnectReadSignal([&calls] { ++calls; });
  const LaserProxy other_laser = *laser;
  Position2dProxy positions[] = {*position, *position};
  EXPECT_EQ(other_laser.GetCount(), 3U);
  EXPECT_EQ(other_laser.GetRange(2), 3.0);
  EXPECT_EQ(other_laser.GetDataTime(), 0.1);
  EXPECT_EQ(other_laser.GetInterfaceStr(), "laser");
  EXPECT_EQ(other_laser.GetPlayerClient(), &client);
  EXPECT_TRUE(other_laser.IsFresh());
  EXPECT_EQ(positions[1].GetYPos(), 2.0);
  positions[0].NotFresh();
  EXPECT_TRUE(positions[1].IsFresh());

  laser.reset();
  position.reset();
  world->add_round({{kLaser, scan(0.2, {4.0, 5.0})}, {kPose, pose_reading(0.2, {3, 4, 0.5})}});
  client.Read();
  EXPECT_EQ(calls, 0) << "its subscriber is gone with the first";
  EXPECT_EQ(other_laser.GetCount(), 2U);
  EXPECT_EQ(positions[0].GetXPos(), 3.0);
  EXPECT_EQ(positions[1].GetXPos(), 3.0);
  positions[1].SetSpeed(0.25, 0.5);
  EXPECT_EQ(last_twist().v_mps, 0.25);
}

TEST_F(Proxies, ProxyCopyWithoutClient_Refused) {
  auto brief = std::make_unique<PlayerClient>(fake_session(world));
  const LaserProxy laser(brief.get(), 0);
  brief.reset();
  EXPECT_EQ(error_code_of([&] { const LaserProxy copy = laser; }), PlayerError::kDisconnected);
}

TEST_F(Proxies, DeviceList_EmptyUntilRequested) {
  EXPECT_TRUE(client.GetDeviceList().empty());
  client.RequestDeviceList();
  const std::list<playerc_device_info_t> list = client.GetDeviceList();
  // The robot's pen, laser, pose (twice) and odometry, the laser again as a ranger, and the devices
  // of the world.
  std::vector<std::string> found;
  for (const playerc_device_info_t& info : list) {
    found.push_back(client.LookupName(info.addr.interf) + ':' + std::to_string(info.addr.index) +
                    ' ' + info.drivername);
  }
  EXPECT_THAT(
      found, ElementsAre("graphics2d:0 pen", "laser:0 laser", "localize:0 pose",
                         "position2d:0 pose", "position2d:1 odometry", "ranger:0 laser",
                         "blackboard:0 world", "log:0 world", "map:0 world", "simulation:0 world"));
}

TEST_F(Proxies, RetrySettings_Kept) {
  client.SetRetryLimit(5);
  client.SetRetryTime(2.5);
  client.SetRequestTimeout(3);
  EXPECT_EQ(client.GetRetryLimit(), 5);
  EXPECT_DOUBLE_EQ(client.GetRetryTime(), 2.5);
}

TEST_F(Proxies, DataMode_PullOrPushOnly) {
  client.SetDataMode(PLAYER_DATAMODE_PULL);
  client.SetDataMode(PLAYER_DATAMODE_PUSH);
  EXPECT_EQ(error_code_of([&] { client.SetDataMode(17); }), PlayerError::kBadArgument);
}

TEST_F(Proxies, ReplaceRules_ReachSession) {
  client.SetReplaceRule(false);
  EXPECT_EQ(world->replace.at(-1), false);
  client.SetReplaceRule(true, PLAYER_MSGTYPE_DATA, -1, PLAYER_LASER_CODE);
  EXPECT_EQ(world->replace.at(kLaser.device), true);
  // Commands never wait, so a rule for them changes nothing.
  client.SetReplaceRule(false, PLAYER_MSGTYPE_CMD, -1, PLAYER_LASER_CODE);
  EXPECT_EQ(world->replace.at(kLaser.device), true);
  // A rule for an interface also holds for proxies that are created later.
  world->replace.clear();
  LaserProxy laser(&client, 0);
  EXPECT_EQ(world->replace.at(kLaser.device), true);
  laser.SetReplaceRule(false);
  EXPECT_EQ(world->replace.at(kLaser.device), false);
}

TEST_F(Proxies, EndOfRun_ReadThrows) {
  try {
    client.Read();
    FAIL() << "Read() returned";
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorStr(), "the simulated run is over");
    EXPECT_EQ(e.GetErrorFun(), "PlayerClient::Read");
    EXPECT_EQ(e.GetErrorCode(), PlayerError::kRunIsOver);
  }
}

TEST_F(Proxies, ReadIfWaiting_ReadsQueuedDataOnly) {
  world->over_when_empty = false;
  Position2dProxy position(&client, 0);
  EXPECT_FALSE(client.Peek(0));
  client.ReadIfWaiting();
  EXPECT_FALSE(position.IsFresh());
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  EXPECT_TRUE(client.Peek(0));
  client.ReadIfWaiting();
  EXPECT_TRUE(position.IsFresh());
}

TEST(PlayerClientErrors, NameFault) {
  EXPECT_EQ(error_code_of([] { PlayerClient client(std::unique_ptr<playerlike::Session>{}); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([] { PlayerClient client("localhost", 6665, 99); }),
            PlayerError::kBadArgument);
  try {
    PlayerClient client("sim:no/such/world.json");
    FAIL() << "a world that does not exist was loaded";
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorFun(), "PlayerClient::PlayerClient");
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("no/such/world.json"));
  }
}

// --- ClientProxy

TEST_F(Proxies, MissingDevice_ErrorListsExisting) {
  try {
    LaserProxy laser(&client, 3);
    FAIL() << "laser:3 exists";
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_EQ(e.GetErrorFun(), "LaserProxy::LaserProxy");
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("laser:3"));
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("laser:0"));
  }
  EXPECT_EQ(error_code_of([&] { LaserProxy laser(&client, 4294967295U); }),
            PlayerError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([] { LaserProxy laser(nullptr); }), PlayerError::kBadArgument);
}

TEST_F(Proxies, Proxies_SubscribedWhileAlive) {
  {
    LaserProxy laser(&client);
    Position2dProxy position(&client, 1);
    EXPECT_EQ(world->subscriptions.at(kLaser.device), 1);
    EXPECT_EQ(world->subscriptions.at(kOdometry.device), 1);
  }
  EXPECT_EQ(world->subscriptions.at(kLaser.device), 0);
  EXPECT_EQ(world->subscriptions.at(kOdometry.device), 0);
}

TEST_F(Proxies, Flags_FollowData) {
  Position2dProxy position(&client, 0);
  EXPECT_FALSE(position.IsValid());
  EXPECT_FALSE(position.IsFresh());
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  world->add_round({{kPose, pose_reading(0.25, {1.0, 2.0, 0.5})}});
  client.Read();
  EXPECT_TRUE(position.IsValid());
  EXPECT_TRUE(position.IsFresh());
  EXPECT_DOUBLE_EQ(position.GetDataTime(), 0.1);
  EXPECT_DOUBLE_EQ(position.GetElapsedTime(), 0.0);
  position.NotFresh();
  EXPECT_FALSE(position.IsFresh());
  EXPECT_TRUE(position.IsValid());
  client.Read();
  EXPECT_TRUE(position.IsFresh());
  EXPECT_DOUBLE_EQ(position.GetDataTime(), 0.25);
  EXPECT_DOUBLE_EQ(position.GetElapsedTime(), 0.25 - 0.1);
}

TEST_F(Proxies, Read_FillsAllProxiesOfDevice) {
  Position2dProxy first(&client, 0), second(&client, 0), odometry(&client, 1);
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  client.Read();
  EXPECT_TRUE(first.IsFresh());
  EXPECT_TRUE(second.IsFresh());
  EXPECT_FALSE(odometry.IsFresh());
}

TEST_F(Proxies, Proxies_ReportInterfaceAndDriver) {
  Position2dProxy odometry(&client, 1);
  EXPECT_EQ(odometry.GetIndex(), 1U);
  EXPECT_EQ(odometry.GetInterface(), static_cast<uint32_t>(PLAYER_POSITION2D_CODE));
  EXPECT_EQ(odometry.GetInterfaceStr(), "position2d");
  EXPECT_EQ(odometry.GetDriverName(), "odometry");
  EXPECT_EQ(odometry.GetPlayerClient(), &client);
  EXPECT_EQ(odometry.HasCapability(PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL), 1);
  EXPECT_EQ(odometry.HasCapability(PLAYER_MSGTYPE_REQ, PLAYER_POSITION2D_REQ_SPEED_PID), 0);
}

TEST_F(Proxies, Properties_AreDeviceSettings) {
  LaserProxy laser(&client);
  char range_max[] = "range_max", beams[] = "beams", noise[] = "noise", teapot[] = "teapot";
  double d = -1.0;
  int32_t i = -1;
  bool b = true;
  char* text = nullptr;
  EXPECT_EQ(laser.GetDblProp(range_max, &d), 0);
  EXPECT_DOUBLE_EQ(d, 5.0);
  EXPECT_EQ(laser.GetIntProp(beams, &i), 0);
  EXPECT_EQ(i, 5);
  EXPECT_EQ(laser.GetBoolProp(noise, &b), 0);
  EXPECT_FALSE(b);
  EXPECT_EQ(laser.GetDblProp(teapot, &d), -1);
  EXPECT_DOUBLE_EQ(d, 5.0);
  char resolution[] = "resolution";
  EXPECT_EQ(laser.GetIntProp(resolution, &i), -1);  // 0.5 is no whole number
  EXPECT_EQ(laser.GetBoolProp(beams, &b), -1);
  EXPECT_EQ(laser.GetStrProp(beams, &text), -1);
  char type[] = "type";
  ASSERT_EQ(laser.GetStrProp(type, &text), 0);
  EXPECT_STREQ(text, "laser");
  std::free(text);
  text = nullptr;
  EXPECT_EQ(laser.SetDblProp(range_max, 1.0), -1);
  EXPECT_EQ(laser.SetIntProp(beams, 1), -1);
  EXPECT_EQ(laser.SetBoolProp(noise, true), -1);
  EXPECT_EQ(laser.SetStrProp(beams, text), -1);
}

int free_function_calls = 0;
void free_function() { ++free_function_calls; }

TEST_F(Proxies, ReadSignal_CalledAfterNewData) {
  Position2dProxy position(&client, 0);
  LaserProxy laser(&client);
  double seen_x = 0.0;
  int laser_calls = 0;
  // Subscribers may call getters: the data is not locked during the call.
  const ClientProxy::connection_t c =
      position.ConnectReadSignal([&] { seen_x = position.GetXPos(); });
  laser.ConnectReadSignal(std::bind([](int* n) { ++*n; }, &laser_calls));
  free_function_calls = 0;
  position.ConnectReadSignal(&free_function);
  world->add_round({{kPose, pose_reading(0.1, {1.5, 0.0, 0.0})}});
  world->add_round({{kPose, pose_reading(0.2, {2.5, 0.0, 0.0})}});
  client.Read();
  EXPECT_DOUBLE_EQ(seen_x, 1.5);
  EXPECT_EQ(laser_calls, 0);
  EXPECT_TRUE(c.connected());
  position.DisconnectReadSignal(c);
  EXPECT_FALSE(c.connected());
  client.Read();
  EXPECT_DOUBLE_EQ(seen_x, 1.5);
  EXPECT_EQ(free_function_calls, 2);
}

TEST_F(Proxies, ReadSignal_SubscriberMayDisconnectItself) {
  Position2dProxy position(&client, 0);
  int calls = 0;
  ClientProxy::connection_t c;
  c = position.ConnectReadSignal([&] {
    ++calls;
    position.DisconnectReadSignal(c);
  });
  world->add_round({{kPose, pose_reading(0.1, {})}});
  world->add_round({{kPose, pose_reading(0.2, {})}});
  client.Read();
  client.Read();
  EXPECT_EQ(calls, 1);
}

TEST_F(Proxies, Mutex_WorksAsInBoost) {
  Position2dProxy position(&client, 0);
  std::future<double> other;
  {
    PlayerClient::mutex_t::scoped_lock lock(client.mMutex);
    EXPECT_FALSE(client.mMutex.try_lock());
    other = std::async(std::launch::async, [&] { return position.GetXPos(); });
    lock.unlock();
  }
  EXPECT_DOUBLE_EQ(other.get(), 0.0);  // would never return if the lock were still held
}

TEST(ProxyLifetimes, ProxiesSurviveTheirClient) {
  auto world = make_fake_world();
  auto client = std::make_unique<PlayerClient>(fake_session(world));
  Position2dProxy position(client.get(), 0);
  LaserProxy laser(client.get());
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  client->Read();
  client.reset();
  EXPECT_TRUE(world->has_closed);
  EXPECT_FALSE(position.IsValid());
  EXPECT_EQ(position.GetPlayerClient(), nullptr);
  EXPECT_EQ(position.GetIndex(), 0U);
  EXPECT_EQ(error_code_of([&] { position.SetSpeed(0.1, 0.0); }), PlayerError::kDisconnected);
  EXPECT_EQ(error_code_of([&] { static_cast<void>(position.GetXPos()); }),
            PlayerError::kDisconnected);
  EXPECT_EQ(error_code_of([&] { static_cast<void>(laser[0]); }), PlayerError::kDisconnected);
  position.NotFresh();
  EXPECT_FALSE(position.IsFresh());
}

/// A program's own proxy, in the style of two existing programs.
class OwnProxy : public ClientProxy {
 public:
  explicit OwnProxy(PlayerClient* aPc, uint32_t aIndex = 0) : ClientProxy(aPc, aIndex) {
    Subscribe(aIndex);
  }
  ~OwnProxy() override { Unsubscribe(); }
  bool HasClient() const { return GetVar(mPc) != nullptr; }
  double InfoTime() const { return GetVar(mInfo->datatime); }
  std::vector<int> Copy() const {
    std::vector<int> out(mValues.size());
    GetVarByRef(mValues.begin(), mValues.end(), out.begin());
    return out;
  }
  void Raise() {
    scoped_lock_t lock(mPc->mMutex);
    mFresh = true;
  }

 private:
  std::vector<int> mValues = {1, 2, 3};
};

TEST_F(Proxies, Subclasses_ReachProtectedMembers) {
  OwnProxy own(&client, 2);
  EXPECT_TRUE(own.HasClient());
  EXPECT_DOUBLE_EQ(own.InfoTime(), 0.0);
  EXPECT_THAT(own.Copy(), ElementsAre(1, 2, 3));
  EXPECT_EQ(own.GetIndex(), 2U);
  own.Raise();
  EXPECT_TRUE(own.IsFresh());
  EXPECT_EQ(own.GetDriverName(), "");
  EXPECT_EQ(own.HasCapability(PLAYER_MSGTYPE_DATA, 1), 0);
}

// --- Threads

TEST_F(Proxies, Thread_ReadsInBackground) {
  world->over_when_empty = false;
  Position2dProxy position(&client, 0);
  std::promise<void> first, second;
  std::atomic<int> calls{0};
  position.ConnectReadSignal([&] {
    if (calls++ == 0) {
      first.set_value();
    } else {
      second.set_value();
    }
  });
  client.StartThread();
  client.StartThread();  // it already runs
  EXPECT_EQ(world->real_time_reasons.size(), 1U);
  world->add_round({{kPose, pose_reading(0.1, {1.0, 0.0, 0.0})}});
  first.get_future().wait();
  EXPECT_DOUBLE_EQ(position.GetXPos(), 1.0);
  client.StopThread();
  world->add_round({{kPose, pose_reading(0.2, {2.0, 0.0, 0.0})}});
  EXPECT_DOUBLE_EQ(position.GetXPos(), 1.0);
  client.StartThread();
  second.get_future().wait();
  EXPECT_DOUBLE_EQ(position.GetXPos(), 2.0);
  // The destructor ends the thread.
}

TEST_F(Proxies, Read_ReturnsWhenOtherThreadTakesRound) {
  Position2dProxy position(&client, 0);
  for (int i = 0; i < 3; ++i) world->add_round({});  // as if it had
  world->add_round({{kPose, pose_reading(0.1, {1.0, 0.0, 0.0})}});
  client.Read();
  EXPECT_DOUBLE_EQ(position.GetXPos(), 0.0);
  client.Read();
  EXPECT_DOUBLE_EQ(position.GetXPos(), 1.0);
}

TEST_F(Proxies, EndOfRun_ReachesBackgroundReaders) {
  Position2dProxy position(&client, 0);
  client.StartThread();  // reaches the end at once
  while (error_code_of([&] { static_cast<void>(position.GetXPos()); }) != PlayerError::kRunIsOver) {
    std::this_thread::yield();
  }
  EXPECT_EQ(error_code_of([&] { position.SetSpeed(0.1, 0.0); }), PlayerError::kRunIsOver);
  client.StopThread();
  position.SetSpeed(0.0, 0.0);  // tidying up afterwards is fine
  EXPECT_DOUBLE_EQ(position.GetXPos(), 0.0);
}

TEST_F(Proxies, Subscriber_MayStopThreadAndRun) {
  world->over_when_empty = false;
  Position2dProxy position(&client, 0);
  std::promise<void> stopped;
  const auto c = position.ConnectReadSignal([&] {
    client.StopThread();
    stopped.set_value();
  });
  world->add_round({{kPose, pose_reading(0.1, {})}});
  client.StartThread();
  stopped.get_future().wait();
  position.DisconnectReadSignal(c);
  int rounds = 0;
  position.ConnectReadSignal([&] {
    if (++rounds == 2) client.Stop();
  });
  world->add_round({{kPose, pose_reading(0.2, {})}});
  world->add_round({{kPose, pose_reading(0.3, {})}});
  client.Run(1);
  EXPECT_EQ(rounds, 2);
}

TEST_F(Proxies, Run_EndsWithRun) {
  Position2dProxy position(&client, 0);
  world->add_round({{kPose, pose_reading(0.1, {})}});
  EXPECT_EQ(error_code_of([&] { client.Run(); }), PlayerError::kRunIsOver);
  EXPECT_TRUE(position.IsValid());
}

TEST_F(Proxies, Commands_AllowedDuringReadOfOtherThread) {
  Position2dProxy position(&client, 0);
  constexpr int kRounds = 200;
  for (int i = 1; i <= kRounds; ++i) {
    world->add_round({{kPose, pose_reading(0.1 * i, {0.01 * i, 0.0, 0.0})}});
  }
  std::thread driver([&] {
    for (int i = 0; i < kRounds; ++i) position.SetSpeed(0.1, 0.0);
  });
  for (int i = 0; i < kRounds; ++i) client.Read();
  driver.join();
  EXPECT_EQ(world->sent.size(), static_cast<std::size_t>(kRounds));
  EXPECT_DOUBLE_EQ(position.GetXPos(), 0.01 * kRounds);
}

// --- Position2dProxy

TEST_F(Proxies, Position_ShowsReading) {
  Position2dProxy position(&client, 0);
  EXPECT_DOUBLE_EQ(position.GetXPos(), 0.0);
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5}, {0.3, -0.2, 0.01}, true)}});
  client.Read();
  EXPECT_DOUBLE_EQ(position.GetXPos(), 1.0);
  EXPECT_DOUBLE_EQ(position.GetYPos(), 2.0);
  EXPECT_DOUBLE_EQ(position.GetYaw(), 0.5);
  EXPECT_DOUBLE_EQ(position.GetXSpeed(), 0.3);
  EXPECT_DOUBLE_EQ(position.GetYSpeed(), 0.01);
  EXPECT_DOUBLE_EQ(position.GetYawSpeed(), -0.2);
  EXPECT_TRUE(position.GetStall());
}

TEST_F(Proxies, SpeedOverloads_DriveMotors) {
  Position2dProxy position(&client, 0);
  position.SetSpeed(0.1, 0.2);
  EXPECT_EQ(last_twist(), (sim::Twist{0.1, 0.2, 0.0}));
  position.SetSpeed(0.2, 9.0, 0.3);  // to the side: up to the drive
  EXPECT_EQ(last_twist(), (sim::Twist{0.2, 0.3, 9.0}));
  const player_pose2d_t speed = {0.3, 0.0, -0.4};
  position.SetSpeed(speed);
  EXPECT_EQ(last_twist(), (sim::Twist{0.3, -0.4, 0.0}));
}

TEST_F(Proxies, Commands_AreNoAccessesToReadings) {
  Position2dProxy position(&client, 0);
  // The library reports 1024 accesses at once.
  constexpr int kMany = 2000;
  for (int i = 0; i < kMany; ++i) position.SetSpeed(0.1, 0.2);
  EXPECT_EQ(world->looks, 0);
  for (int i = 0; i < kMany; ++i) static_cast<void>(position.GetXPos());
  EXPECT_EQ(world->looks, 1024);
}

TEST_F(Proxies, NotANumber_Refused) {
  Position2dProxy position(&client, 0);
  const auto refused = [&](auto action) {
    EXPECT_EQ(error_code_of(action), PlayerError::kBadArgument);
  };
  refused([&] { position.SetSpeed(kNan, 0.0); });
  refused([&] { position.SetSpeed(0.0, kInf); });
  refused([&] { position.SetSpeed(0.0, kNan, 0.0); });
  refused([&] { position.SetVelHead(0.1, kNan); });
  refused([&] { position.GoTo(kInf, 0.0, 0.0); });
  refused([&] { position.SetCarlike(0.1, kNan); });
  refused([&] { position.SetOdometry(0.0, kNan, 0.0); });
  EXPECT_TRUE(world->sent.empty());
}

TEST_F(Proxies, SideSpeedAndSteering_SentToMotors) {
  Position2dProxy position(&client, 0);
  position.SetSpeed(0.2, -0.1, 0.3);
  EXPECT_EQ(last_twist(), (sim::Twist{0.2, 0.3, -0.1}));
  position.SetCarlike(0.2, 0.3);
  const auto car = std::get<sim::CarCommand>(world->sent.back().second);
  EXPECT_DOUBLE_EQ(car.v_mps, 0.2);
  EXPECT_DOUBLE_EQ(car.steering_rad, 0.3);
}

TEST_F(Proxies, PositionCommands_NameFrameOfIndex) {
  Position2dProxy odometry(&client, 1);
  odometry.SetVelHead(0.2, 4.0);
  const auto heading = std::get<sim::HeadingCommand>(world->sent.back().second);
  EXPECT_EQ(world->sent.back().first, kMotion);
  EXPECT_DOUBLE_EQ(heading.v_mps, 0.2);
  EXPECT_DOUBLE_EQ(heading.lateral_mps, 0.0);
  EXPECT_DOUBLE_EQ(heading.yaw_rad, sim::normalize_angle(4.0));
  EXPECT_EQ(heading.frame, kOdometry.device);
  odometry.SetVelHead(0.2, -0.1, 1.0);
  EXPECT_DOUBLE_EQ(std::get<sim::HeadingCommand>(world->sent.back().second).lateral_mps, -0.1);

  Position2dProxy position(&client, 0);
  position.GoTo(1.5, 1.0, -2.0);
  auto goal = std::get<sim::PositionCommand>(world->sent.back().second);
  EXPECT_EQ(goal.goal, (sim::Pose{1.5, 1.0, -2.0}));
  EXPECT_DOUBLE_EQ(goal.max_speed_mps, 0.0);  // the motors' own limit
  EXPECT_DOUBLE_EQ(goal.max_turn_rate_radps, 0.0);
  EXPECT_EQ(goal.frame, kPose.device);
  position.GoTo(player_pose2d_t{1.0, 0.4, 1.0}, player_pose2d_t{-0.3, 0.4, -0.5});
  goal = std::get<sim::PositionCommand>(world->sent.back().second);
  EXPECT_DOUBLE_EQ(goal.max_speed_mps, 0.5);  // of the vector (0.3, 0.4)
  EXPECT_DOUBLE_EQ(goal.max_turn_rate_radps, 0.5);
}

TEST_F(Proxies, Motors_Switched) {
  Position2dProxy position(&client, 0);
  position.SetMotorEnable(true);
  ASSERT_EQ(world->sent.size(), 1U);
  EXPECT_TRUE(std::get<sim::MotorEnableCommand>(world->sent.back().second).enabled);
  position.SetMotorEnable(false);
  ASSERT_EQ(world->sent.size(), 2U);
  EXPECT_FALSE(std::get<sim::MotorEnableCommand>(world->sent.back().second).enabled);
}

TEST_F(Proxies, Odometry_SetOnDeviceThatIsRead) {
  Position2dProxy odometry(&client, 1);
  odometry.SetOdometry(1.0, 2.0, 4.0);
  EXPECT_EQ(world->sent.back().first, kOdometry);
  const auto& pose = std::get<sim::SetPoseCommand>(world->sent.back().second).pose;
  EXPECT_EQ(pose, (sim::Pose{1.0, 2.0, sim::normalize_angle(4.0)}));
  odometry.ResetOdometry();
  EXPECT_EQ(std::get<sim::SetPoseCommand>(world->sent.back().second).pose, sim::Pose{});
}

TEST_F(Proxies, Position_ReportsGeometry) {
  Position2dProxy position(&client, 0);
  position.RequestGeom();
  EXPECT_DOUBLE_EQ(position.GetSize().sl, 0.174);
  EXPECT_DOUBLE_EQ(position.GetSize().sw, 0.162);
  EXPECT_DOUBLE_EQ(position.GetSize().sh, 0.18);
  EXPECT_DOUBLE_EQ(position.GetOffset().px, 0.0);
  world->robots[0].center_m = {-0.04, 0.01};
  EXPECT_DOUBLE_EQ(position.GetOffset().px, -0.04);
  EXPECT_DOUBLE_EQ(position.GetPose().py, 0.01);  // its name in Player 2.0
}

TEST(ProxiesOfOddRobots, RobotWithoutMotors_CommandsRefused) {
  auto world = make_fake_world();
  std::erase_if(world->robots[0].devices, [](const auto& d) { return d.type == "motion"; });
  PlayerClient client(fake_session(world));
  Position2dProxy position(&client, 0);
  EXPECT_EQ(error_code_of([&] { position.SetSpeed(0.1, 0.0); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { position.SetMotorEnable(true); }), PlayerError::kNotAvailable);
  EXPECT_EQ(position.HasCapability(PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL), 0);
}

// --- LaserProxy

TEST_F(Proxies, Laser_SettingsKnownBeforeFirstScan) {
  LaserProxy laser(&client);
  laser.RequestConfigure();
  laser.RequestGeom();
  laser.RequestID();
  EXPECT_EQ(laser.GetCount(), 0U);
  EXPECT_DOUBLE_EQ(laser.GetMaxRange(), 5.0);
  EXPECT_DOUBLE_EQ(laser.GetScanRes(), 0.5);
  EXPECT_DOUBLE_EQ(laser.GetScanningFrequency(), 10.0);
  EXPECT_DOUBLE_EQ(laser.GetConfMinAngle(), -1.0);  // 5 beams, 0.5 rad apart
  EXPECT_DOUBLE_EQ(laser.GetConfMaxAngle(), 1.0);
  EXPECT_GT(laser.GetRangeRes(), 0.0);
  EXPECT_FALSE(laser.IntensityOn());
  EXPECT_EQ(laser.GetID(), 0);
  EXPECT_DOUBLE_EQ(laser.GetPose().px, 0.035);
  EXPECT_DOUBLE_EQ(laser.GetPose().py, 0.01);
  EXPECT_DOUBLE_EQ(laser.GetPose().pz, 0.125);
  EXPECT_DOUBLE_EQ(laser.GetPose().pyaw, 0.1);
  EXPECT_DOUBLE_EQ(laser.GetSize().sl, 0.05);
  EXPECT_DOUBLE_EQ(laser.GetSize().sw, 0.06);
  EXPECT_DOUBLE_EQ(laser.GetSize().sh, 0.07);
  EXPECT_DOUBLE_EQ(laser.GetMinLeft(), 5.0);
  // Programs that read values before their first Read() get zeros.
  EXPECT_EQ(laser.GetRange(0), 0.0);
  EXPECT_EQ(laser[90], 0.0);
  EXPECT_EQ(laser.GetBearing(2), 0.0);
  EXPECT_EQ(laser.GetPoint(2).px, 0.0);
  EXPECT_EQ(laser.GetIntensity(2), 0);
}

TEST_F(Proxies, Laser_MembersConsistent) {
  LaserProxy laser(&client);
  world->add_round({{kLaser, scan(0.1, {2.0, 1.0, 5.0, 4.0, 0.5})}});
  client.Read();
  ASSERT_EQ(laser.GetCount(), 5U);
  EXPECT_DOUBLE_EQ(laser.GetMinAngle(), -1.0);
  EXPECT_DOUBLE_EQ(laser.GetMaxAngle(), 1.0);
  for (uint32_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(laser.GetBearing(i), laser.GetMinAngle() + i * laser.GetScanRes());
    EXPECT_DOUBLE_EQ(laser[i], laser.GetRange(i));
    const player_point_2d_t p = laser.GetPoint(i);
    EXPECT_NEAR(std::hypot(p.px, p.py), laser.GetRange(i), 1e-12);
    EXPECT_NEAR(std::atan2(p.py, p.px), laser.GetBearing(i), 1e-12);
    EXPECT_EQ(laser.GetIntensity(i), 0);
  }
  EXPECT_DOUBLE_EQ(laser[0], 2.0);
  EXPECT_DOUBLE_EQ(laser.GetBearing(4), laser.GetMaxAngle());
  // Of 5 beams, the first 2 are the right half; the middle one belongs to the left.
  EXPECT_DOUBLE_EQ(laser.GetMinRight(), 1.0);
  EXPECT_DOUBLE_EQ(laser.GetMinLeft(), 0.5);
  EXPECT_DOUBLE_EQ(laser.MinRight(), 1.0);
  EXPECT_DOUBLE_EQ(laser.MinLeft(), 0.5);
}

TEST_F(Proxies, BeamsBeyondEnd_ReadZeroWithOneWarning) {
  LaserProxy laser(&client);
  world->add_round({{kLaser, scan(0.1, {2.0, 1.0, 5.0, 4.0, 0.5})}});
  client.Read();
  testing::internal::CaptureStderr();
  EXPECT_EQ(laser[5], 0.0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("LaserProxy::"), HasSubstr("beam 5"), HasSubstr("has 5")));
  testing::internal::CaptureStderr();
  EXPECT_EQ(laser.GetRange(4000000000U), 0.0);
  EXPECT_EQ(laser.GetBearing(5), 0.0);
  EXPECT_EQ(laser.GetPoint(6).px, 0.0);
  EXPECT_EQ(laser.GetIntensity(7), 0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Proxies, Configure_CropsAndThinsScan) {
  LaserProxy laser(&client);
  world->add_round({{kLaser, scan(0.1, {2.0, 1.0, 5.0, 4.0, 0.5004})}});
  client.Read();
  laser.Configure(-0.6, 1.0, 0, 0, false, 10.0);  // beams at -0.5, 0, 0.5 and 1
  ASSERT_EQ(laser.GetCount(), 4U);
  EXPECT_DOUBLE_EQ(laser[0], 1.0);
  EXPECT_DOUBLE_EQ(laser.GetMinAngle(), -0.5);
  EXPECT_DOUBLE_EQ(laser.GetConfMinAngle(), -0.5);
  EXPECT_DOUBLE_EQ(laser.GetMaxAngle(), 1.0);
  // Every second beam: 1 rad is 5730 hundredths of a degree. Ranges to 1 cm.
  laser.Configure(-1.0, 1.0, 5730, 10, true, 99.0);
  ASSERT_EQ(laser.GetCount(), 3U);
  EXPECT_DOUBLE_EQ(laser.GetScanRes(), 1.0);
  EXPECT_DOUBLE_EQ(laser.GetRangeRes(), 0.01);
  EXPECT_DOUBLE_EQ(laser[1], 5.0);
  EXPECT_NEAR(laser[2], 0.50, 1e-12);
  EXPECT_DOUBLE_EQ(laser.GetBearing(2), 1.0);
  EXPECT_FALSE(laser.IntensityOn());
  EXPECT_DOUBLE_EQ(laser.GetScanningFrequency(), 10.0);
  // The setting also holds for the next scan.
  world->add_round({{kLaser, scan(0.2, {0.1, 0.2, 0.3, 0.4, 0.5})}});
  client.Read();
  ASSERT_EQ(laser.GetCount(), 3U);
  EXPECT_NEAR(laser[1], 0.3, 1e-12);
  EXPECT_EQ(error_code_of([&] { laser.Configure(2.0, 3.0, 0, 0, false, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { laser.Configure(kNan, 3.0, 0, 0, false, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(laser.GetCount(), 3U);
}

TEST_F(Proxies, ConfigureBeforeFirstScan_Applies) {
  LaserProxy laser(&client);
  laser.Configure(0.0, 0.5, 0, 0, false, 10.0);
  EXPECT_EQ(laser.GetCount(), 0U);
  world->add_round({{kLaser, scan(0.1, {2.0, 1.0, 5.0, 4.0, 0.5})}});
  client.Read();
  ASSERT_EQ(laser.GetCount(), 2U);
  EXPECT_DOUBLE_EQ(laser[0], 5.0);
  EXPECT_DOUBLE_EQ(laser[1], 4.0);
}

TEST_F(Proxies, RobotPose_LastReadByClient) {
  LaserProxy laser(&client);
  Position2dProxy position(&client, 0), odometry(&client, 1);
  EXPECT_DOUBLE_EQ(laser.GetRobotPose().px, 0.0);
  world->add_round({{kOdometry, pose_reading(0.1, {9.0, 9.0, 0.9})},
                    {kPose, pose_reading(0.1, {1.0, 2.0, 0.5})}});
  world->add_round({{kOdometry, pose_reading(0.2, {9.0, 9.0, 0.9})}});
  client.Read();
  client.Read();  // a newer reading of the odometry does not replace the localisation's
  EXPECT_DOUBLE_EQ(laser.GetRobotPose().px, 1.0);
  EXPECT_DOUBLE_EQ(laser.GetRobotPose().py, 2.0);
  EXPECT_DOUBLE_EQ(laser.GetRobotPose().pyaw, 0.5);
}

// --- operator<<

TEST_F(Proxies, Proxies_PrintReadableTables) {
  Position2dProxy position(&client, 0);
  LaserProxy laser(&client);
  world->add_round({{kPose, pose_reading(0.1, {1.25, 2.5, 0.5})},
                    {kLaser, scan(0.1, {2.0, 1.0, 5.0, 4.0, 0.75})}});
  client.Read();
  std::ostringstream out;
  out << position;
  EXPECT_THAT(out.str(), HasSubstr("position2d:0 valid, fresh"));
  EXPECT_THAT(out.str(), HasSubstr("1.25\t2.5\t0.5"));
  out.str("");
  out << laser;
  EXPECT_THAT(out.str(), HasSubstr("-1\t1\t0.5\t5\t5"));
  EXPECT_THAT(out.str(), HasSubstr("\n1\t0.75\t"));
  out.str("");
  out << client;
  EXPECT_THAT(out.str(), HasSubstr("6665\tyes"));
  EXPECT_THAT(out.str(), HasSubstr("position2d\t1\tr1\todometry"));
  out.str("");
  out << static_cast<const ClientProxy&>(laser);
  EXPECT_EQ(out.str(), "laser:0 valid, fresh");
}

}  // namespace
