// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The C library, within a process and over a network.
#include "libplayerc/playerc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "libplayerc++/playerc++.h"
#include "libplayercore/playercore.h"
#include "playerlike/connect/open_session.h"
#include "reachable_host.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A room of 4 x 3 m. r1 faces along x from (1, 1.5): its laser, 0.035 m ahead of its axle, is 2.965
// m from the wall. r2 faces along y.
constexpr const char* kWorld = R"({
  "name": "room",
  "arena": {"size": [4, 3], "obstacles": [{"name": "b", "center": [3.5, 0.5], "size": [0.4, 0.4]}]},
  "canvas": {"size": [40, 30], "cell_size": 0.1},
  "simulation": {"duration": 20},
  "robots": [{"name": "r1", "pose": {"x": 1, "y": 1.5},
              "devices": {"sonar": {}, "infrared": {}, "bumper": {}, "battery": {}, "imu": {},
                          "fiducial": {"field_of_view_deg": 180}, "wifi": {},
                          "gps": {"latitude_deg": 50, "longitude_deg": 14},
                          "dio": {"inputs": [true, "contact", "dio.0"], "outputs": 2},
                          "aio": {"inputs": [5, "aio.0"], "outputs": 1}, "speech": {},
                          "blinkenlight": {}, "opaque": {}}},
             {"name": "r2", "fiducial": 3, "pose": {"x": 2, "y": 0.5, "yaw_deg": 90},
              "devices": {"wifi": {}, "ptz": {}, "blobfinder": {"ptz": "ptz"},
                          "camera": {"ptz": "ptz"}}}]})";

struct Free {
  void operator()(playerc_client_t* c) const { playerc_client_destroy(c); }
  void operator()(playerc_mclient_t* m) const { playerc_mclient_destroy(m); }
  void operator()(playerc_position2d_t* p) const { playerc_position2d_destroy(p); }
  void operator()(playerc_laser_t* l) const { playerc_laser_destroy(l); }
  void operator()(playerc_map_t* m) const { playerc_map_destroy(m); }
  void operator()(playerc_graphics2d_t* g) const { playerc_graphics2d_destroy(g); }
  void operator()(playerc_ranger_t* r) const { playerc_ranger_destroy(r); }
  void operator()(playerc_sonar_t* s) const { playerc_sonar_destroy(s); }
  void operator()(playerc_ir_t* i) const { playerc_ir_destroy(i); }
  void operator()(playerc_bumper_t* b) const { playerc_bumper_destroy(b); }
  void operator()(playerc_power_t* p) const { playerc_power_destroy(p); }
  void operator()(playerc_fiducial_t* d) const { playerc_fiducial_destroy(d); }
  void operator()(playerc_blobfinder_t* d) const { playerc_blobfinder_destroy(d); }
  void operator()(playerc_camera_t* d) const { playerc_camera_destroy(d); }
  void operator()(playerc_ptz_t* d) const { playerc_ptz_destroy(d); }
  void operator()(playerc_gps_t* d) const { playerc_gps_destroy(d); }
  void operator()(playerc_gripper_t* d) const { playerc_gripper_destroy(d); }
  void operator()(playerc_imu_t* d) const { playerc_imu_destroy(d); }
  void operator()(playerc_localize_t* d) const { playerc_localize_destroy(d); }
  void operator()(playerc_wifi_t* d) const { playerc_wifi_destroy(d); }
  void operator()(playerc_aio_t* d) const { playerc_aio_destroy(d); }
  void operator()(playerc_dio_t* d) const { playerc_dio_destroy(d); }
  void operator()(playerc_blinkenlight_t* d) const { playerc_blinkenlight_destroy(d); }
  void operator()(playerc_speech_t* d) const { playerc_speech_destroy(d); }
  void operator()(playerc_opaque_t* d) const { playerc_opaque_destroy(d); }
  void operator()(playerc_simulation_t* d) const { playerc_simulation_destroy(d); }
  void operator()(playerc_log_t* d) const { playerc_log_destroy(d); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

/// Tests that hold for every transport.
class PlayercBase {
 public:
  explicit PlayercBase(test::Transport transport) {
    if (transport == test::Transport::kInProcess) {
      name_ = "sim:" + folder_.write("room.json", kWorld);
      return;
    }
    setenv("PLAYPEN_ENCODING", transport == test::Transport::kJson ? "json" : "cbor", 1);
    host_ = std::make_unique<test::ReachableHost>(
        playerlike::Host::create(sim::load_world_text(kWorld)), transport);
    name_ = host_->name();
  }
  PlayercBase(const PlayercBase&) = delete;
  PlayercBase& operator=(const PlayercBase&) = delete;
  ~PlayercBase() { playerlike::close_embedded_hosts(); }

  [[nodiscard]] Owned<playerc_client_t> client(int port = 6665,
                                               playerc_mclient_t* group = nullptr) const {
    Owned<playerc_client_t> made(playerc_client_create(group, name_.c_str(), port));
    EXPECT_EQ(playerc_client_connect(made.get()), 0) << playerc_error_str();
    return made;
  }
  [[nodiscard]] static Owned<playerc_position2d_t> position(playerc_client_t* client,
                                                            int index = 0) {
    Owned<playerc_position2d_t> made(playerc_position2d_create(client, index));
    EXPECT_EQ(playerc_position2d_subscribe(made.get(), PLAYERC_OPEN_MODE), 0)
        << playerc_error_str();
    return made;
  }
  [[nodiscard]] static Owned<playerc_laser_t> laser(playerc_client_t* client) {
    Owned<playerc_laser_t> made(playerc_laser_create(client, 0));
    EXPECT_EQ(playerc_laser_subscribe(made.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
    return made;
  }

 protected:
  test_support::TemporaryFolder folder_;
  std::unique_ptr<test::ReachableHost> host_;
  std::string name_;
};

class PlayercEverywhere : public PlayercBase, public testing::TestWithParam<test::Transport> {
 protected:
  PlayercEverywhere() : PlayercBase(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Transports, PlayercEverywhere,
                         testing::Values(test::Transport::kInProcess, test::Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

class Playerc : public PlayercBase, public testing::Test {
 protected:
  Playerc() : PlayercBase(test::Transport::kInProcess) {}
};

/// Reads one round.
[[nodiscard]] bool reads(playerc_client_t* client) {
  return playerc_client_read(client) == client->id;
}

// --- Clients

TEST_P(PlayercEverywhere, Connect_ListsDevices) {
  const auto robot = client();
  EXPECT_EQ(robot->connected, 1);
  EXPECT_EQ(robot->port, 6665);
  EXPECT_EQ(robot->id, robot.get());
  ASSERT_EQ(playerc_client_get_devlist(robot.get()), 0) << playerc_error_str();
  bool has_laser = false;
  for (int i = 0; i < robot->devinfo_count; ++i) {
    const playerc_device_info_t& info = robot->devinfos[i];
    if (info.addr.interf != PLAYER_LASER_CODE) continue;
    has_laser = true;
    EXPECT_EQ(info.addr.index, 0);
    EXPECT_EQ(info.addr.robot, 6665U);
    EXPECT_STREQ(info.drivername, "laser");
  }
  EXPECT_TRUE(has_laser);
  EXPECT_EQ(playerc_client_disconnect(robot.get()), 0);
  EXPECT_EQ(robot->connected, 0);
  EXPECT_EQ(playerc_client_get_devlist(robot.get()), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("not connected"));
}

TEST_P(PlayercEverywhere, FailedConnectOrSubscribe_Explained) {
  const Owned<playerc_client_t> none(playerc_client_create(nullptr, name_.c_str(), 7000));
  EXPECT_EQ(playerc_client_connect(none.get()), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("7000"));
  EXPECT_EQ(none->connected, 0);
  const auto robot = client();
  const Owned<playerc_laser_t> laser(playerc_laser_create(robot.get(), 3));
  ASSERT_NE(laser, nullptr);
  EXPECT_EQ(playerc_laser_subscribe(laser.get(), PLAYERC_OPEN_MODE), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("playerc_laser_subscribe"));
  EXPECT_THAT(playerc_error_str(), HasSubstr("laser:3"));
  EXPECT_THAT(playerc_error_str(), HasSubstr("laser:0"));  // which there is
  EXPECT_EQ(laser->info.subscribed, 0);
  EXPECT_EQ(playerc_laser_get_geom(laser.get()), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("not subscribed"));
}

TEST_P(PlayercEverywhere, Read_DeliversRoundOrOneDevice) {
  const auto robot = client();
  EXPECT_EQ(robot->mode, PLAYERC_DATAMODE_PULL);
  const auto scanner = laser(robot.get());
  const auto base = position(robot.get());
  EXPECT_EQ(robot->device_count, 2);
  EXPECT_EQ(scanner->scan_count, 0);
  EXPECT_EQ(base->info.fresh, 0);
  ASSERT_EQ(playerc_client_requestdata(robot.get()), 0);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_EQ(scanner->info.fresh, 1);
  EXPECT_EQ(base->info.fresh, 1);
  EXPECT_EQ(robot->qlen, 0);
  EXPECT_NEAR(base->info.datatime, 0.1, 1e-9);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_NEAR(scanner->info.datatime, 0.2, 1e-9);
  EXPECT_NEAR(scanner->info.lasttime, 0.1, 1e-9);
  EXPECT_NEAR(robot->datatime, 0.2, 1e-9);

  ASSERT_EQ(playerc_client_datamode(robot.get(), PLAYERC_DATAMODE_PUSH), 0);
  base->info.fresh = 0;
  EXPECT_EQ(playerc_client_read(robot.get()), scanner.get());
  EXPECT_EQ(base->info.fresh, 0);  // its turn is next
  EXPECT_EQ(robot->qlen, 1);
  EXPECT_EQ(playerc_client_read(robot.get()), base.get());
  EXPECT_EQ(base->info.fresh, 1);
  EXPECT_EQ(playerc_client_read(robot.get()), scanner.get());  // of the next round
  EXPECT_NEAR(scanner->info.datatime, 0.4, 1e-9);
  EXPECT_EQ(playerc_client_datamode(robot.get(), 77), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("77"));

  // The rest of the round belongs to the next read in the mode PULL, which connecting sets again.
  ASSERT_EQ(playerc_client_datamode(robot.get(), PLAYERC_DATAMODE_PULL), 0);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_NEAR(base->info.datatime, 0.4, 1e-9);
  ASSERT_EQ(playerc_client_datamode(robot.get(), PLAYERC_DATAMODE_PUSH), 0);
  ASSERT_EQ(playerc_client_disconnect(robot.get()), 0);
  ASSERT_EQ(playerc_client_connect(robot.get()), 0);
  EXPECT_EQ(robot->mode, PLAYERC_DATAMODE_PULL);
}

TEST_P(PlayercEverywhere, Time_IndependentOfDevices) {
  const auto robot = client();
  const auto base = position(robot.get());
  const auto scanner = laser(robot.get());
  const Owned<playerc_sonar_t> sonar(playerc_sonar_create(robot.get(), 0));
  const Owned<playerc_power_t> power(playerc_power_create(robot.get(), 0));
  ASSERT_EQ(playerc_sonar_subscribe(sonar.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_power_subscribe(power.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_position2d_set_cmd_vel(base.get(), 0.2, 0.0, 0.0, 1), 0);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(reads(robot.get())) << playerc_error_str();
  EXPECT_NEAR(base->info.datatime, 2.0, 1e-9);
  EXPECT_NEAR(base->px, 1.0 + 2.0 * 0.2, 0.05);  // minus the loss by acceleration
}

TEST_P(PlayercEverywhere, Read_FillsArraysOfAllDevices) {
  const auto first = client();
  const auto robot = client(6666);
  const auto scanner = laser(first.get());
  const Owned<playerc_ranger_t> ranger(playerc_ranger_create(first.get(), 0));
  const Owned<playerc_sonar_t> sonar(playerc_sonar_create(first.get(), 0));
  const Owned<playerc_ir_t> infrared(playerc_ir_create(first.get(), 0));
  const Owned<playerc_bumper_t> bumper(playerc_bumper_create(first.get(), 0));
  const Owned<playerc_fiducial_t> finder(playerc_fiducial_create(first.get(), 0));
  const Owned<playerc_localize_t> localize(playerc_localize_create(first.get(), 0));
  const Owned<playerc_wifi_t> wifi(playerc_wifi_create(first.get(), 0));
  const Owned<playerc_aio_t> aio(playerc_aio_create(first.get(), 0));
  const Owned<playerc_blobfinder_t> blobs(playerc_blobfinder_create(robot.get(), 0));
  const Owned<playerc_camera_t> camera(playerc_camera_create(robot.get(), 0));
  EXPECT_NEAR(scanner->size[0], 0.15, 1e-12);  // Player's values before get_geom()
  EXPECT_NEAR(finder->fiducial_geom.size.sl, 0.1, 1e-12);
  for (playerc_device_t* device :
       {&ranger->info, &sonar->info, &infrared->info, &bumper->info, &finder->info, &localize->info,
        &wifi->info, &aio->info, &blobs->info, &camera->info}) {
    ASSERT_EQ(playerc_device_subscribe(device, PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  }
  ASSERT_TRUE(reads(first.get())) << playerc_error_str();
  ASSERT_TRUE(reads(robot.get())) << playerc_error_str();
  for (const void* array : std::initializer_list<const void*>{
           scanner->ranges, scanner->scan, scanner->point, scanner->intensity, ranger->ranges,
           ranger->intensities, ranger->bearings, ranger->points, sonar->scan,
           infrared->data.ranges, infrared->data.voltages, bumper->bumpers, finder->fiducials,
           localize->hypoths, wifi->links, aio->voltages, blobs->blobs, camera->image}) {
    EXPECT_NE(array, nullptr);
  }
  // r2 looks at the wall: no blob, and a program that reads the first one finds zeros.
  EXPECT_EQ(blobs->blobs_count, 0U);
  EXPECT_EQ(blobs->blobs[0].area, 0U);
}

TEST_P(PlayercEverywhere, NoDevices_TimeAdvances) {
  const auto robot = client();
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  const auto base = position(robot.get());
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_NEAR(base->info.datatime, 0.3, 1e-9);
}

TEST_P(PlayercEverywhere, PeekAndNonblockingRead_Work) {
  const auto robot = client();
  const auto base = position(robot.get());
  ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  int idle = 0;
  void* told = nullptr;
  while (playerc_client_read_nonblock_withproxy(robot.get(), &told) == 0) ++idle;
  EXPECT_EQ(told, robot->id);
  EXPECT_NEAR(base->info.datatime, 0.2, 1e-9);
  // The first call only looks, the next nine advance time by a step of 10 ms each, the tenth gets
  // data.
  EXPECT_EQ(idle, 10);
  EXPECT_EQ(playerc_client_peek(robot.get(), 50), 0);
  EXPECT_EQ(playerc_client_peek(robot.get(), -1), 1);
  EXPECT_EQ(playerc_client_internal_peek(robot.get(), 0), 1);
  EXPECT_EQ(playerc_client_read_nonblock(robot.get()), 1);
  EXPECT_NEAR(base->info.datatime, 0.3, 1e-9);
}

TEST_P(PlayercEverywhere, EndOfRun_Reported) {
  const auto robot = client();
  const auto base = position(robot.get());
  int readings = 0;
  while (playerc_client_read(robot.get()) != nullptr) ++readings;
  EXPECT_EQ(readings, 200);  // 20 s, 10 Hz
  EXPECT_THAT(playerc_error_str(), HasSubstr("the simulated run is over"));
  EXPECT_EQ(playerc_client_peek(robot.get(), -1), 1);  // there is something to be told
  EXPECT_EQ(playerc_client_read_nonblock(robot.get()), -1);
}

TEST_F(Playerc, Errors_KeptPerThread) {
  EXPECT_EQ(playerc_client_connect(nullptr), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("null pointer"));
  std::string others = "?";
  std::thread([&] { others = playerc_error_str(); }).join();
  EXPECT_THAT(others, IsEmpty());
}

TEST_F(Playerc, NullPointers_Refused) {
  EXPECT_EQ(playerc_laser_create(nullptr, -1), nullptr);
  EXPECT_EQ(playerc_laser_subscribe(nullptr, PLAYERC_OPEN_MODE), -1);
  EXPECT_EQ(playerc_client_read(nullptr), nullptr);
  EXPECT_EQ(playerc_client_adddevice(nullptr, nullptr), -1);
  EXPECT_EQ(playerc_client_addcallback(nullptr, nullptr, nullptr, nullptr), -1);
  EXPECT_EQ(playerc_device_subscribe(nullptr, PLAYERC_OPEN_MODE), -1);
  EXPECT_EQ(playerc_mclient_read(nullptr, 0), -1);
  EXPECT_EQ(playerc_position2d_set_cmd_vel(nullptr, 0.0, 0.0, 0.0, 1), -1);
  playerc_client_destroy(nullptr);
  playerc_laser_destroy(nullptr);
  playerc_mclient_destroy(nullptr);
  playerc_device_term(nullptr);
  // A device can be created without a client, but not used.
  const Owned<playerc_laser_t> laser(playerc_laser_create(nullptr, 0));
  ASSERT_NE(laser, nullptr);
  EXPECT_EQ(playerc_laser_subscribe(laser.get(), PLAYERC_OPEN_MODE), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("no client"));
}

TEST_F(Playerc, Destruction_AnyOrder) {
  auto robot = client();
  auto base = position(robot.get());
  auto scanner = laser(robot.get());
  const auto unused = Owned<playerc_laser_t>(playerc_laser_create(robot.get(), 0));
  ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  scanner.reset();  // while its data wait
  EXPECT_EQ(robot->device_count, 2);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  robot.reset();
  EXPECT_EQ(base->info.client, nullptr);
  EXPECT_EQ(base->info.subscribed, 0);
  EXPECT_EQ(playerc_position2d_set_cmd_vel(base.get(), 0.1, 0.0, 0.0, 1), -1);
  EXPECT_EQ(playerc_position2d_subscribe(base.get(), PLAYERC_OPEN_MODE), -1);
  EXPECT_NEAR(base->px, 1.0, 1e-9);  // what was read stays
}

TEST_F(Playerc, Reconnect_SubscribesAgain) {
  const auto robot = client();
  const auto base = position(robot.get());
  EXPECT_EQ(playerc_client_disconnect_retry(robot.get()), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("playerc_client_set_retry_limit"));
  EXPECT_EQ(playerc_client_read(robot.get()), nullptr);
  ASSERT_EQ(playerc_client_connect(robot.get()), 0);
  ASSERT_EQ(playerc_position2d_subscribe(base.get(), PLAYERC_OPEN_MODE), 0);
  playerc_client_set_retry_limit(robot.get(), 2);
  playerc_client_set_retry_time(robot.get(), 0.001);
  playerc_client_set_request_timeout(robot.get(), 5);
  ASSERT_EQ(playerc_client_disconnect_retry(robot.get()), 0) << playerc_error_str();
  EXPECT_EQ(base->info.subscribed, 1);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
}

TEST_F(Playerc, Callbacks_AtMostFour) {
  const auto robot = client();
  const auto base = position(robot.get());
  std::vector<int> calls;
  struct Call {
    std::vector<int>* calls;
    int number;
    static void note(void* data) {
      const auto* self = static_cast<Call*>(data);
      self->calls->push_back(self->number);
    }
  };
  Call all[5] = {{&calls, 0}, {&calls, 1}, {&calls, 2}, {&calls, 3}, {&calls, 4}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(playerc_client_addcallback(robot.get(), &base->info, Call::note, &all[i]), 0);
  }
  EXPECT_EQ(playerc_client_addcallback(robot.get(), &base->info, Call::note, &all[4]), -1);
  playerc_client_read(robot.get());
  EXPECT_THAT(calls, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(playerc_client_delcallback(robot.get(), &base->info, Call::note, &all[1]), 0);
  calls.clear();
  playerc_client_read(robot.get());
  EXPECT_THAT(calls, ElementsAre(0, 2, 3));
}

TEST_F(Playerc, ReplaceRules_AcceptedBeforeAndAfterConnect) {
  const Owned<playerc_client_t> robot(playerc_client_create(nullptr, name_.c_str(), 6665));
  EXPECT_EQ(playerc_client_set_replace_rule(robot.get(), -1, -1, PLAYER_MSGTYPE_DATA, -1, 0), 0);
  EXPECT_EQ(playerc_client_set_replace_rule(robot.get(), PLAYER_LASER_CODE, 0, -1, -1, 1), 0);
  ASSERT_EQ(playerc_client_connect(robot.get()), 0);
  const auto base = position(robot.get());
  const auto odometry = position(robot.get(), 1);
  EXPECT_EQ(playerc_client_set_replace_rule(robot.get(), 9999, -1, -1, -1, 1), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("9999"));
  // With any rule, a device is reported once per round, with its newest data.
  const auto other = client(6666);
  for (int i = 0; i < 3; ++i) playerc_client_read(other.get());
  ASSERT_EQ(playerc_client_datamode(robot.get(), PLAYERC_DATAMODE_PUSH), 0);
  EXPECT_EQ(playerc_client_read(robot.get()), base.get());
  EXPECT_EQ(playerc_client_read(robot.get()), odometry.get());
}

// --- Several clients

TEST_P(PlayercEverywhere, MultiClient_ReadsClientsTogether) {
  const Owned<playerc_mclient_t> group(playerc_mclient_create());
  EXPECT_EQ(playerc_mclient_read(group.get(), 0), -1);
  const auto one = client(6665, group.get());
  const auto two = client(6666, group.get());
  EXPECT_EQ(group->client_count, 2);
  const auto base1 = position(one.get());
  const auto base2 = position(two.get());
  EXPECT_EQ(playerc_mclient_peek(group.get(), 0), 0);
  EXPECT_EQ(playerc_mclient_read(group.get(), 50), 0);  // not that soon
  for (int i = 1; i <= 5; ++i) {
    EXPECT_EQ(playerc_mclient_read(group.get(), -1), 2) << playerc_error_str();
    EXPECT_NEAR(group->time, 0.1 * i, 1e-9);
    EXPECT_NEAR(base1->info.datatime, 0.1 * i, 1e-9);
    EXPECT_NEAR(base2->info.datatime, 0.1 * i, 1e-9);
  }
  EXPECT_NEAR(base2->pa, 0.5 * std::numbers::pi, 1e-9);
}

TEST_F(Playerc, MultiClient_ReadsSeveralWorlds) {
  const Owned<playerc_mclient_t> group(playerc_mclient_create());
  const auto one = client(6665, group.get());
  const std::string other = "sim:" + folder_.write("other.json", kWorld);
  auto two = Owned<playerc_client_t>(playerc_client_create(group.get(), other.c_str(), 6666));
  ASSERT_EQ(playerc_client_connect(two.get()), 0);
  const auto base1 = position(one.get());
  auto base2 = position(two.get());
  int readings1 = 0;
  int readings2 = 0;
  while (readings1 < 20 || readings2 < 20) {
    ASSERT_GT(playerc_mclient_read(group.get(), 1000), 0) << playerc_error_str();
    readings1 += std::exchange(base1->info.fresh, 0);
    readings2 += std::exchange(base2->info.fresh, 0);
  }
  EXPECT_NEAR(base1->info.datatime, 0.1 * readings1, 1e-9);
  EXPECT_NEAR(base2->info.datatime, 0.1 * readings2, 1e-9);
  EXPECT_LE(std::abs(readings1 - readings2), 2);  // both worlds go on
  two.reset();
  EXPECT_EQ(group->client_count, 1);
  EXPECT_EQ(playerc_mclient_read(group.get(), -1), 1);
  // To the end of the run.
  while (playerc_mclient_read(group.get(), -1) > 0) {
  }
  EXPECT_THAT(playerc_error_str(), HasSubstr("the simulated run is over"));
}

// The library must not access what a callback has destroyed; the sanitizer builds check this.
TEST_F(Playerc, Callback_MayDestroyClientAndList) {
  struct Told {
    playerc_mclient_t* group;
    playerc_client_t* client;
    playerc_position2d_t* base;
    bool list_too;
    int count = 0;
  };
  for (const bool list_too : {false, true}) {
    playerc_mclient_t* const group = playerc_mclient_create();
    playerc_client_t* const doomed = client(6665, group).release();
    const auto other = client(6666, group);
    playerc_position2d_t* const base = position(doomed).release();
    const auto base2 = position(other.get());
    Told told{group, doomed, base, list_too};
    const auto destroy = [](void* data) {
      auto& it = *static_cast<Told*>(data);
      ++it.count;
      playerc_position2d_destroy(it.base);
      playerc_client_destroy(it.client);
      if (it.list_too) playerc_mclient_destroy(it.group);
    };
    ASSERT_EQ(playerc_client_addcallback(doomed, &base->info, destroy, &told), 0);
    while (told.count == 0) ASSERT_GT(playerc_mclient_read(group, 1000), 0) << playerc_error_str();
    EXPECT_EQ(told.count, 1);
    if (list_too) continue;
    EXPECT_EQ(group->client_count, 1);
    EXPECT_EQ(playerc_mclient_read(group, -1), 1);
    EXPECT_NEAR(group->time, base2->info.datatime, 1e-9);
    playerc_mclient_destroy(group);
  }
}

TEST_F(Playerc, MultiClient_HoldsAtMost128Clients) {
  const Owned<playerc_mclient_t> group(playerc_mclient_create());
  std::vector<Owned<playerc_client_t>> clients;
  for (int i = 0; i < 128; ++i) {
    clients.emplace_back(playerc_client_create(group.get(), "localhost", 6665));
  }
  EXPECT_EQ(group->client_count, 128);
  const Owned<playerc_client_t> more(playerc_client_create(nullptr, "localhost", 6665));
  EXPECT_EQ(playerc_mclient_addclient(group.get(), more.get()), -1);
}

// --- Devices

TEST_F(Playerc, Devices_UsableByCommonPart) {
  const auto robot = client();
  const Owned<playerc_laser_t> laser(playerc_laser_create(robot.get(), 0));
  char driver[4];
  EXPECT_EQ(playerc_client_subscribe(robot.get(), PLAYER_LASER_CODE, 0, PLAYERC_OPEN_MODE, driver,
                                     sizeof driver),
            0);
  EXPECT_STREQ(driver, "las");  // what there is room for
  EXPECT_EQ(laser->info.subscribed, 1);
  EXPECT_STREQ(laser->info.drivername, "laser");
  EXPECT_EQ(laser->info.addr.robot, 6665U);
  EXPECT_EQ(
      playerc_device_hascapability(&laser->info, PLAYER_MSGTYPE_REQ, PLAYER_LASER_REQ_GET_GEOM), 1);
  EXPECT_EQ(playerc_device_hascapability(&laser->info, PLAYER_MSGTYPE_CMD, 77), 0);
  char name[] = "beams";
  int32_t beams = 0;
  double value = 0.0;
  BOOL truth = 5;
  EXPECT_EQ(playerc_device_get_intprop(&laser->info, name, &beams), 0);
  EXPECT_EQ(beams, 682);
  EXPECT_EQ(playerc_device_get_dblprop(&laser->info, name, &value), 0);
  EXPECT_EQ(value, 682.0);
  EXPECT_EQ(playerc_device_get_boolprop(&laser->info, name, &truth), -1);
  EXPECT_EQ(truth, 5);
  EXPECT_EQ(playerc_device_set_dblprop(&laser->info, name, 3.0), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("beams"));
  EXPECT_EQ(playerc_client_unsubscribe(robot.get(), PLAYER_LASER_CODE, 0), 0);
  EXPECT_EQ(laser->info.subscribed, 0);
  EXPECT_EQ(playerc_device_subscribe(&laser->info, PLAYERC_OPEN_MODE), 0);
  EXPECT_EQ(playerc_device_subscribe(&laser->info, PLAYERC_OPEN_MODE), 0);  // as before
  EXPECT_EQ(playerc_device_subscribe(&laser->info, PLAYERC_CLOSE_MODE), 0);
  EXPECT_EQ(laser->info.subscribed, 0);
  // If the client has no such device, it may only look.
  EXPECT_EQ(playerc_client_subscribe(robot.get(), PLAYER_POSITION2D_CODE, 0, PLAYERC_OPEN_MODE,
                                     nullptr, 0),
            0);
  EXPECT_EQ(
      playerc_client_subscribe(robot.get(), PLAYER_LASER_CODE, 5, PLAYERC_OPEN_MODE, nullptr, 0),
      -1);
}

TEST_F(Playerc, ProgramDevices_Untouched) {
  const auto robot = client();
  playerc_device_t own;
  playerc_device_init(&own, robot.get(), PLAYER_LASER_CODE, 0, nullptr);
  EXPECT_EQ(robot->device_count, 1);
  EXPECT_EQ(own.id, &own);
  EXPECT_EQ(playerc_device_subscribe(&own, PLAYERC_OPEN_MODE), -1);
  EXPECT_EQ(playerc_device_hascapability(&own, PLAYER_MSGTYPE_DATA, 1), 0);
  playerc_device_term(&own);
  EXPECT_EQ(robot->device_count, 0);
  EXPECT_EQ(playerc_client_deldevice(robot.get(), &own), -1);
  EXPECT_EQ(playerc_client_request(robot.get(), &own, 1, nullptr, nullptr), -1);
  EXPECT_EQ(playerc_client_write(robot.get(), &own, 1, nullptr, nullptr), -1);
  EXPECT_EQ(playerc_add_xdr_ftable(nullptr, 0), -1);
}

TEST_F(Playerc, UnavailableDevices_CreatedButRefused) {
  const auto robot = client();
  playerc_limb_t* const limb = playerc_limb_create(robot.get(), 0);
  ASSERT_NE(limb, nullptr);
  EXPECT_EQ(limb->info.addr.interf, PLAYER_LIMB_CODE);
  EXPECT_EQ(playerc_limb_subscribe(limb, PLAYERC_OPEN_MODE), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("limb:0"));
  EXPECT_EQ(playerc_limb_home_cmd(limb), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("no world has such a device"));
  EXPECT_EQ(playerc_limb_unsubscribe(limb), 0);
  playerc_limb_destroy(limb);
}

TEST_P(PlayercEverywhere, Base_Drives) {
  const auto robot = client();
  const auto base = position(robot.get());
  ASSERT_EQ(playerc_position2d_get_geom(base.get()), 0);
  EXPECT_NEAR(base->size[0], 0.174, 1e-9);  // the S1R's footprint
  EXPECT_NEAR(base->size[1], 0.162, 1e-9);
  EXPECT_EQ(base->info.freshgeom, 1);
  ASSERT_EQ(playerc_position2d_enable(base.get(), 1), 0);
  ASSERT_EQ(playerc_position2d_set_cmd_vel(base.get(), 0.2, 0.0, 0.0, 1), 0);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_NEAR(base->vx, 0.2, 1e-6);
  EXPECT_NEAR(base->px, 1.0 + 2.0 * 0.2, 0.05);  // minus the loss by acceleration
  EXPECT_NEAR(base->py, 1.5, 1e-9);
  ASSERT_EQ(playerc_position2d_set_cmd_vel(base.get(), 0.0, 0.0, 0.0, 1), 0);
  ASSERT_EQ(playerc_position2d_set_odom(base.get(), 0.0, 0.0, 0.0), 0);
  for (int i = 0; i < 10; ++i) ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  ASSERT_EQ(playerc_position2d_set_odom(base.get(), 0.0, 0.0, 0.0), 0);
  ASSERT_EQ(playerc_position2d_set_cmd_pose(base.get(), 0.3, 0.2, 1.0, 1), 0);
  for (int i = 0; i < 80; ++i) ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_NEAR(base->px, 0.3, 0.02);
  EXPECT_NEAR(base->py, 0.2, 0.02);
  EXPECT_NEAR(base->pa, 1.0, 0.02);
  ASSERT_EQ(playerc_position2d_set_cmd_vel_head(base.get(), 0.0, 0.0, 0.0, 1), 0);
  for (int i = 0; i < 40; ++i) ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_NEAR(base->pa, 0.0, 0.02);
  EXPECT_EQ(playerc_position2d_set_cmd_vel(base.get(), std::nan(""), 0.0, 0.0, 1), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("finite"));
}

TEST_P(PlayercEverywhere, Laser_Scans) {
  const auto robot = client();
  const auto scanner = laser(robot.get());
  ASSERT_EQ(playerc_laser_get_geom(scanner.get()), 0);
  EXPECT_NEAR(scanner->pose[0], 0.035, 1e-9);
  ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  ASSERT_EQ(scanner->scan_count, 682);
  EXPECT_EQ(scanner->scan_id, 1);
  EXPECT_EQ(scanner->intensity_on, 0);
  EXPECT_NEAR(scanner->max_range, 5.0, 1e-9);
  EXPECT_NEAR(scanner->scan_res, 0.39589 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(scanner->scan_start, -0.5 * 681 * scanner->scan_res, 1e-9);
  // Beams 340 and 341 point half a beam to the right and left of straight ahead, where the wall is
  // 2.965 m away.
  EXPECT_NEAR(scanner->ranges[340], 2.965 / std::cos(0.5 * scanner->scan_res), 1e-3);
  for (const int i : {0, 340, 681}) {
    const double bearing_rad = scanner->scan_start + i * scanner->scan_res;
    EXPECT_EQ(scanner->scan[i][0], scanner->ranges[i]);
    EXPECT_NEAR(scanner->scan[i][1], bearing_rad, 1e-9);
    EXPECT_NEAR(scanner->point[i].px, scanner->ranges[i] * std::cos(bearing_rad), 1e-9);
    EXPECT_NEAR(scanner->point[i].py, scanner->ranges[i] * std::sin(bearing_rad), 1e-9);
    EXPECT_EQ(scanner->intensity[i], 0);
  }
  EXPECT_EQ(scanner->min_left, *std::min_element(scanner->ranges + 341, scanner->ranges + 682));
  EXPECT_EQ(scanner->min_right, *std::min_element(scanner->ranges, scanner->ranges + 341));

  // A quarter of a turn to each side, every other beam.
  const double quarter_rad = 0.5 * std::numbers::pi;
  ASSERT_EQ(playerc_laser_set_config(scanner.get(), -quarter_rad, quarter_rad,
                                     2.0 * scanner->scan_res, 0.01, 0, 10.0),
            0)
      << playerc_error_str();
  double low = 0.0;
  double high = 0.0;
  double resolution = 0.0;
  double range_res = 0.0;
  unsigned char intensity = 9;
  ASSERT_EQ(playerc_laser_get_config(scanner.get(), &low, &high, &resolution, &range_res,
                                     &intensity, nullptr),
            0);
  EXPECT_NEAR(low, -quarter_rad, 0.007);
  EXPECT_NEAR(high, quarter_rad, 0.014);
  EXPECT_NEAR(resolution, 2.0 * 0.39589 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(range_res, 0.01, 1e-12);
  EXPECT_EQ(intensity, 0);
  ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  // On each side, beams are (k + 0.5) * 0.39589 degrees off; 227 of them are within 90 degrees.
  // Half of the 454 are reported.
  EXPECT_EQ(scanner->scan_count, 227);
  EXPECT_EQ(scanner->ranges[1023], 0.0) << "programs for a laser with more beams look there";
  EXPECT_EQ(scanner->scan[1023][0], 0.0);
  EXPECT_EQ(playerc_laser_set_config(scanner.get(), 0.0, 0.1, -1.0, 0.0, 0, 10.0), -1);
  EXPECT_EQ(playerc_laser_get_id(scanner.get()), 0);
}

TEST_P(PlayercEverywhere, Map_Fetched) {
  const auto robot = client();
  const Owned<playerc_map_t> map(playerc_map_create(robot.get(), 0));
  ASSERT_EQ(playerc_map_subscribe(map.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_map_get_map(map.get()), 0) << playerc_error_str();
  EXPECT_EQ(map->width, 40);
  EXPECT_EQ(map->height, 30);
  EXPECT_NEAR(map->resolution, 0.1, 1e-12);
  EXPECT_EQ(map->data_range, 1);
  EXPECT_EQ(map->cells[PLAYERC_MAP_INDEX(map, 35, 5)], 1);    // in the block
  EXPECT_EQ(map->cells[PLAYERC_MAP_INDEX(map, 20, 15)], -1);  // on the floor
  EXPECT_EQ(playerc_map_get_vector(map.get()), -1);
}

TEST_F(Playerc, Graphics_Draw) {
  const auto robot = client();
  const Owned<playerc_graphics2d_t> sheet(playerc_graphics2d_create(robot.get(), 0));
  EXPECT_EQ(playerc_graphics2d_clear(sheet.get()), -1);  // not subscribed yet
  ASSERT_EQ(playerc_graphics2d_subscribe(sheet.get(), PLAYERC_OPEN_MODE), 0);
  const player_color_t red = {255, 255, 0, 0};
  ASSERT_EQ(playerc_graphics2d_setcolor(sheet.get(), red), 0);
  EXPECT_EQ(sheet->color.red, 255);
  player_point_2d_t points[] = {{0.5, 0.5}, {0.9, 0.5}, {0.9, 0.9}};
  EXPECT_EQ(playerc_graphics2d_draw_points(sheet.get(), points, 3), 0);
  EXPECT_EQ(playerc_graphics2d_draw_polyline(sheet.get(), points, 3), 0);
  EXPECT_EQ(playerc_graphics2d_draw_multiline(sheet.get(), points, 2), 0);
  EXPECT_EQ(playerc_graphics2d_draw_polygon(sheet.get(), points, 3, 1, red), 0);
  EXPECT_EQ(playerc_graphics2d_draw_points(sheet.get(), nullptr, 3), -1);
  EXPECT_EQ(playerc_graphics2d_clear(sheet.get()), 0);
  EXPECT_EQ(playerc_graphics2d_unsubscribe(sheet.get()), 0);
}

// The range sensors, compared with the proxies of a client that reads the same data.
class PlayercSensors : public Playerc {
 protected:
  [[nodiscard]] static bool same(const player_pose3d_t& a, const player_pose3d_t& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
  void read() {
    ASSERT_NE(playerc_client_read(robot_.get()), nullptr) << playerc_error_str();
    other_.Read();
  }

  Owned<playerc_client_t> robot_{client()};
  PlayerCc::PlayerClient other_{name_, 6665};
};

TEST_F(PlayercSensors, LaserRanger_Reads) {
  const Owned<playerc_ranger_t> ranger(playerc_ranger_create(robot_.get(), 0));
  PlayerCc::RangerProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_ranger_subscribe(ranger.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_ranger_get_geom(ranger.get()), 0);
  ASSERT_EQ(ranger->element_count, 1U);
  EXPECT_NEAR(ranger->device_pose.px, 0.035, 1e-9);
  EXPECT_TRUE(same(ranger->element_poses[0], proxy.GetElementPose(0)));
  EXPECT_EQ(ranger->element_sizes[0].sw, proxy.GetElementSize(0).sw);
  double low = 0.0;
  double most = 0.0;
  ASSERT_EQ(playerc_ranger_get_config(ranger.get(), &low, nullptr, nullptr, nullptr, &most, nullptr,
                                      nullptr),
            0);
  EXPECT_EQ(low, proxy.GetMinAngle());
  EXPECT_EQ(most, 5.0);
  EXPECT_EQ(ranger->frequency, 10.0);
  read();
  ASSERT_EQ(ranger->ranges_count, 682U);
  ASSERT_EQ(ranger->points_count, 682U);
  ASSERT_EQ(ranger->bearings_count, 682U);
  EXPECT_EQ(ranger->intensities_count, 0U);
  EXPECT_NEAR(ranger->bearings[681], -low, 1e-9);
  for (const uint32_t i : {0U, 100U, 681U}) {
    EXPECT_EQ(ranger->ranges[i], proxy.GetRange(i));
    EXPECT_NEAR(ranger->points[i].px, ranger->ranges[i] * std::cos(ranger->bearings[i]), 1e-9);
    EXPECT_NEAR(ranger->points[i].py, ranger->ranges[i] * std::sin(ranger->bearings[i]), 1e-9);
  }
  ASSERT_EQ(playerc_ranger_set_config(ranger.get(), -1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 10.0), 0);
  EXPECT_EQ(ranger->max_range, 1.0);
  read();
  EXPECT_LT(ranger->ranges_count, 682U);
  EXPECT_EQ(*std::max_element(ranger->ranges, ranger->ranges + ranger->ranges_count), 1.0);
  EXPECT_EQ(playerc_ranger_power_config(ranger.get(), 1), 0);
  EXPECT_EQ(playerc_ranger_intns_config(ranger.get(), 1), 0);
}

TEST_F(PlayercSensors, SonarAndRanger_Read) {
  const Owned<playerc_sonar_t> sonar(playerc_sonar_create(robot_.get(), 0));
  const Owned<playerc_ranger_t> ranger(playerc_ranger_create(robot_.get(), 1));
  PlayerCc::SonarProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_sonar_subscribe(sonar.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_ranger_subscribe(ranger.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_sonar_get_geom(sonar.get()), 0);
  ASSERT_GT(sonar->pose_count, 0);
  ASSERT_EQ(static_cast<uint32_t>(sonar->pose_count), proxy.GetPoseCount());
  ASSERT_TRUE(reads(robot_.get()));
  other_.Read();
  ASSERT_EQ(sonar->scan_count, sonar->pose_count);
  ASSERT_EQ(ranger->ranges_count, static_cast<uint32_t>(sonar->scan_count));
  for (uint32_t i = 0; i < proxy.GetCount(); ++i) {
    EXPECT_TRUE(same(sonar->poses[i], proxy.GetPose(i)));
    EXPECT_EQ(sonar->scan[i], proxy.GetScan(i));
    EXPECT_EQ(ranger->ranges[i], proxy.GetScan(i));
    EXPECT_NEAR(ranger->bearings[i], sonar->poses[i].pyaw, 1e-12);
  }
}

TEST_F(PlayercSensors, Infrared_Reads) {
  const Owned<playerc_ir_t> infrared(playerc_ir_create(robot_.get(), 0));
  PlayerCc::IrProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_ir_subscribe(infrared.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_ir_get_geom(infrared.get()), 0);
  read();
  ASSERT_GT(proxy.GetCount(), 0U);
  ASSERT_EQ(infrared->poses.poses_count, proxy.GetPoseCount());
  ASSERT_EQ(infrared->data.ranges_count, proxy.GetCount());
  ASSERT_EQ(infrared->data.voltages_count, proxy.GetCount());
  for (uint32_t i = 0; i < proxy.GetCount(); ++i) {
    EXPECT_TRUE(same(infrared->poses.poses[i], proxy.GetPose(i)));
    EXPECT_FLOAT_EQ(infrared->data.ranges[i], static_cast<float>(proxy.GetRange(i)));
    EXPECT_FLOAT_EQ(infrared->data.voltages[i], static_cast<float>(proxy.GetVoltage(i)));
  }
}

TEST_F(PlayercSensors, Bumper_Reads) {
  const Owned<playerc_bumper_t> bumper(playerc_bumper_create(robot_.get(), 0));
  PlayerCc::BumperProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_bumper_subscribe(bumper.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_bumper_get_geom(bumper.get()), 0);
  const auto base = position(robot_.get());
  ASSERT_EQ(playerc_position2d_set_cmd_vel(base.get(), 0.5, 0.0, 0.0, 1), 0);
  bool bumped = false;
  for (int i = 0; i < 150 && !bumped; ++i) {
    ASSERT_TRUE(reads(robot_.get())) << playerc_error_str();
    other_.Read();
    ASSERT_GT(bumper->bumper_count, 0);
    ASSERT_EQ(static_cast<uint32_t>(bumper->bumper_count), proxy.GetCount());
    for (uint32_t k = 0; k < proxy.GetCount(); ++k) {
      EXPECT_EQ(bumper->bumpers[k], proxy.IsBumped(k));
      bumped = bumped || bumper->bumpers[k] != 0;
    }
  }
  EXPECT_TRUE(bumped);  // by the wall 2.9 m ahead
  ASSERT_EQ(static_cast<uint32_t>(bumper->pose_count), proxy.GetPoseCount());
  EXPECT_TRUE(same(bumper->poses[0].pose, proxy.GetPose(0).pose));
}

TEST_F(PlayercSensors, Battery_Reads) {
  const Owned<playerc_power_t> power(playerc_power_create(robot_.get(), 0));
  PlayerCc::PowerProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_power_subscribe(power.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  EXPECT_EQ(power->valid, 0);
  read();
  EXPECT_TRUE((power->valid & PLAYER_POWER_MASK_PERCENT) != 0);
  EXPECT_NEAR(power->percent, 100.0, 0.01);
  EXPECT_EQ(power->charge, proxy.GetCharge());
  EXPECT_EQ(power->joules, proxy.GetJoules());
  EXPECT_EQ(power->watts, proxy.GetWatts());
  EXPECT_EQ(power->charging, 0);
}

TEST_F(PlayercSensors, Fiducials_Read) {
  const Owned<playerc_fiducial_t> finder(playerc_fiducial_create(robot_.get(), 0));
  PlayerCc::FiducialProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_fiducial_subscribe(finder.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_fiducial_get_geom(finder.get()), 0);
  EXPECT_TRUE(same(finder->fiducial_geom.pose, proxy.GetSensorPose()));
  read();
  ASSERT_EQ(finder->fiducials_count, 1);
  ASSERT_EQ(proxy.GetCount(), 1U);
  EXPECT_EQ(finder->fiducials[0].id, 3);
  EXPECT_TRUE(same(finder->fiducials[0].pose, proxy.GetFiducialItem(0).pose));
}

TEST_P(PlayercEverywhere, BlobsPicturesAndPtz_Work) {
  const auto robot = client(6666);
  const Owned<playerc_ptz_t> head(playerc_ptz_create(robot.get(), 0));
  const Owned<playerc_blobfinder_t> finder(playerc_blobfinder_create(robot.get(), 0));
  const Owned<playerc_camera_t> camera(playerc_camera_create(robot.get(), 0));
  ASSERT_EQ(playerc_ptz_subscribe(head.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_blobfinder_subscribe(finder.get(), PLAYERC_OPEN_MODE), 0);
  ASSERT_EQ(playerc_camera_subscribe(camera.get(), PLAYERC_OPEN_MODE), 0);
  EXPECT_EQ(playerc_camera_get_image(camera.get()), -1);  // not yet
  const auto turn = [&](int rounds) {
    for (int i = 0; i < rounds; ++i) {
      ASSERT_TRUE(reads(robot.get())) << playerc_error_str();
    }
  };
  // r1 is at 45 degrees to the left.
  constexpr double kQuarter = 0.25 * std::numbers::pi;
  ASSERT_EQ(playerc_ptz_set(head.get(), kQuarter, 0.0, 0.0), 0) << playerc_error_str();
  turn(1);
  EXPECT_NEAR(head->pan, 8.0 * std::numbers::pi / 180.0, 1e-6);  // 80 degrees per second
  EXPECT_EQ(playerc_ptz_query_status(head.get()), 0);
  EXPECT_EQ(head->status, 1);
  turn(7);
  EXPECT_EQ(head->pan, kQuarter);
  EXPECT_EQ(head->tilt, 0.0);
  EXPECT_NEAR(head->zoom, std::numbers::pi / 3.0, 1e-9);
  EXPECT_EQ(head->status, 0);
  EXPECT_EQ(finder->width, 80U);
  EXPECT_EQ(finder->height, 60U);
  ASSERT_EQ(finder->blobs_count, 1U);
  EXPECT_EQ(finder->blobs[0].color, 0xff8800U);  // of the first robot
  EXPECT_NEAR(finder->blobs[0].x, 40.0, 2.0);
  EXPECT_NEAR(finder->blobs[0].range, std::sqrt(2.0) - 0.08, 0.03);

  ASSERT_EQ(playerc_camera_get_image(camera.get()), 0) << playerc_error_str();
  EXPECT_EQ(camera->width, 80);
  EXPECT_EQ(camera->height, 60);
  EXPECT_EQ(camera->bpp, 24);
  EXPECT_EQ(camera->format, PLAYER_CAMERA_FORMAT_RGB888);
  EXPECT_EQ(camera->compression, PLAYER_CAMERA_COMPRESS_RAW);
  ASSERT_EQ(camera->image_count, 80 * 60 * 3);
  const playerc_blobfinder_blob_t& blob = finder->blobs[0];
  const unsigned red = playerc_camera_get_pixel_component(camera.get(), blob.x, blob.y, 0);
  EXPECT_EQ(red, camera->image[3 * (blob.y * 80 + blob.x)]);
  EXPECT_GT(red, 100U);
  EXPECT_EQ(playerc_camera_get_pixel_component(camera.get(), blob.x, blob.y, 2), 0U);  // of ff8800
  EXPECT_EQ(playerc_camera_get_pixel_component(camera.get(), 80, 0, 0), 0U);
  EXPECT_THAT(playerc_error_str(), HasSubstr("no pixel 80, 0"));
  std::array<uint8_t, 6> copy = {};
  playerc_camera_copy_image(camera.get(), copy.data(), 5);
  EXPECT_TRUE(std::equal(copy.begin(), copy.begin() + 5, camera->image));
  EXPECT_EQ(copy[5], 0);
  EXPECT_EQ(playerc_camera_set_source(camera.get(), 0, "PAL"), -1);
  EXPECT_EQ(playerc_camera_get_source(camera.get()), -1);
  playerc_camera_decompress(camera.get());
  const std::string file = testing::TempDir() + "playerc_" + transport_name(GetParam()) + ".ppm";
  playerc_camera_save(camera.get(), file.c_str());
  EXPECT_EQ(std::filesystem::file_size(file), 13U + 14400U);  // "P6\n80 60\n255\n"
  std::filesystem::remove(file);

  // In position control the speeds limit the motion; in velocity control they command it.
  ASSERT_EQ(playerc_ptz_set_ws(head.get(), 0.0, 0.0, 0.0, 0.5, 0.0), 0) << playerc_error_str();
  turn(2);
  EXPECT_NEAR(head->pan, kQuarter - 0.1, 1e-6);
  EXPECT_EQ(playerc_ptz_set_control_mode(head.get(), 7), -1);
  ASSERT_EQ(playerc_ptz_set_control_mode(head.get(), PLAYER_PTZ_VELOCITY_CONTROL), 0);
  ASSERT_EQ(playerc_ptz_set_ws(head.get(), 0.0, 0.0, 0.0, -1.0, 0.25), 0);
  turn(2);
  EXPECT_NEAR(head->pan, kQuarter - 0.3, 1e-6);
  EXPECT_NEAR(head->tilt, 0.05, 1e-6);
}

TEST_F(PlayercSensors, GpsAndImu_Read) {
  const Owned<playerc_gps_t> gps(playerc_gps_create(robot_.get(), 0));
  const Owned<playerc_imu_t> imu(playerc_imu_create(robot_.get(), 0));
  PlayerCc::GpsProxy gps_proxy(&other_, 0);
  PlayerCc::ImuProxy imu_proxy(&other_, 0);
  ASSERT_EQ(playerc_gps_subscribe(gps.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_imu_subscribe(imu.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  const auto base = position(robot_.get());
  ASSERT_EQ(playerc_position2d_set_cmd_vel(base.get(), 0.0, 0.0, 1.0, 1), 0);
  for (int i = 0; i < 15; ++i) {
    ASSERT_TRUE(reads(robot_.get()));
    other_.Read();
  }
  EXPECT_NEAR(gps->lat, 50.0, 1e-3);
  EXPECT_NEAR(gps->lon, 14.0, 1e-3);
  EXPECT_EQ(gps->lat, gps_proxy.GetLatitude());
  EXPECT_EQ(gps->utm_e, gps_proxy.GetUtmEasting());
  EXPECT_EQ(gps->alt, gps_proxy.GetAltitude());
  EXPECT_EQ(gps->sat_count, static_cast<int>(gps_proxy.GetSatellites()));
  EXPECT_EQ(gps->quality, 1);
  EXPECT_NEAR(gps->utc_time, 1.5, 1e-9);
  EXPECT_TRUE(same(imu->pose, imu_proxy.GetPose()));
  EXPECT_NEAR(imu->vel.pyaw, 1.0, 1e-3);
  EXPECT_EQ(imu->acc.pz, imu_proxy.GetZAccel());
  EXPECT_EQ(imu->calib_data.gyro_z, imu_proxy.GetZGyro());
  // A rotation by yaw about z: cos(yaw / 2) + k sin(yaw / 2).
  EXPECT_GT(imu->pose.pyaw, 1.0);
  EXPECT_NEAR(imu->q0, std::cos(0.5 * imu->pose.pyaw), 1e-6);
  EXPECT_NEAR(imu->q1, 0.0, 1e-6);
  EXPECT_NEAR(imu->q2, 0.0, 1e-6);
  EXPECT_NEAR(imu->q3, std::sin(0.5 * imu->pose.pyaw), 1e-6);
  EXPECT_EQ(playerc_imu_datatype(imu.get(), PLAYER_IMU_DATA_STATE), 0);
  EXPECT_EQ(playerc_imu_datatype(imu.get(), 99), -1);
  EXPECT_EQ(playerc_imu_reset_orientation(imu.get(), 0), 0);
  EXPECT_EQ(playerc_imu_reset_euler(imu.get(), 0.0F, 0.0F, 0.5F), 0);
}

TEST_F(PlayercSensors, LocalizeAndWifi_Read) {
  const Owned<playerc_localize_t> localize(playerc_localize_create(robot_.get(), 0));
  const Owned<playerc_wifi_t> wifi(playerc_wifi_create(robot_.get(), 0));
  PlayerCc::WiFiProxy proxy(&other_, 0);
  ASSERT_EQ(playerc_localize_subscribe(localize.get(), PLAYERC_OPEN_MODE), 0)
      << playerc_error_str();
  ASSERT_EQ(playerc_wifi_subscribe(wifi.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  EXPECT_EQ(playerc_localize_get_particles(localize.get()), -1);  // nothing read yet
  ASSERT_TRUE(reads(robot_.get()));
  other_.Read();
  ASSERT_EQ(localize->hypoth_count, 1);
  EXPECT_NEAR(localize->hypoths[0].mean.px, 1.0, 1e-9);
  ASSERT_EQ(playerc_localize_get_particles(localize.get()), 0) << playerc_error_str();
  ASSERT_EQ(localize->num_particles, 1);
  EXPECT_NEAR(localize->mean[1], 1.5, 1e-9);
  EXPECT_NEAR(localize->particles[0].pose[1], 1.5, 1e-9);
  EXPECT_EQ(localize->particles[0].weight, 1.0);
  double pose[3] = {0.0, 0.0, 0.0};
  double cov[6] = {};
  EXPECT_EQ(playerc_localize_set_pose(localize.get(), pose, cov), 0);
  EXPECT_EQ(playerc_localize_set_pose(localize.get(), nullptr, cov), -1);

  ASSERT_EQ(wifi->link_count, 1);  // r2
  EXPECT_STREQ(wifi->ip, proxy.GetOwnIP());
  const playerc_wifi_link_t* const link = playerc_wifi_get_link(wifi.get(), 0);
  ASSERT_NE(link, nullptr);
  EXPECT_EQ(link->level, proxy.GetLinkLevel(0));
  EXPECT_EQ(playerc_wifi_get_link(wifi.get(), 1), nullptr);
}

// --- Other capabilities of worlds

TEST_F(Playerc, Gripper_Grips) {
  const std::string world = folder_.write("can.json", R"({
    "arena": {"size": [4, 3], "obstacles": [
      {"name": "can", "center": [1.14, 1], "size": [0.06, 0.04], "portable": true}]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 1},
                "devices": {"gripper": {"opening": 0.08, "travel_time": 0.4, "capacity": 1}}}]})");
  const Owned<playerc_client_t> robot(
      playerc_client_create(nullptr, ("sim:" + world).c_str(), 6665));
  ASSERT_EQ(playerc_client_connect(robot.get()), 0) << playerc_error_str();
  const Owned<playerc_gripper_t> gripper(playerc_gripper_create(robot.get(), 0));
  EXPECT_EQ(playerc_gripper_open_cmd(gripper.get()), -1);  // not subscribed yet
  ASSERT_EQ(playerc_gripper_subscribe(gripper.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_gripper_get_geom(gripper.get()), 0);
  EXPECT_NEAR(gripper->pose.px, 0.087, 1e-12);
  EXPECT_NEAR(gripper->inner_size.sw, 0.08, 1e-12);
  EXPECT_NEAR(gripper->outer_size.sw, 0.14, 1e-12);
  EXPECT_EQ(gripper->num_beams, 2);
  EXPECT_EQ(gripper->capacity, 1);
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(gripper->state, PLAYER_GRIPPER_STATE_OPEN);
  EXPECT_EQ(gripper->beams, 0x08U);  // 1.117 is in the can, from 1.11 to 1.17; 1.177 is not
  ASSERT_EQ(playerc_gripper_close_cmd(gripper.get()), 0);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(gripper->state, PLAYER_GRIPPER_STATE_CLOSED);
  ASSERT_EQ(playerc_gripper_store_cmd(gripper.get()), 0);
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(gripper->state, PLAYER_GRIPPER_STATE_MOVING);
  EXPECT_EQ(gripper->stored, 1);
  EXPECT_EQ(gripper->beams, 0U);
  ASSERT_EQ(playerc_gripper_stop_cmd(gripper.get()), 0);
  ASSERT_EQ(playerc_gripper_retrieve_cmd(gripper.get()), 0);
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(gripper->stored, 0);
  EXPECT_EQ(gripper->state, PLAYER_GRIPPER_STATE_CLOSED);
  testing::internal::CaptureStdout();
  playerc_gripper_printout(gripper.get(), "r1");
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("state 2, beams 0x08, 0 stored"));
  ASSERT_EQ(playerc_gripper_open_cmd(gripper.get()), 0);
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(gripper->state, PLAYER_GRIPPER_STATE_MOVING);
}

TEST_P(PlayercEverywhere, DioAndAio_ReadAndSet) {
  const auto robot = client();
  const Owned<playerc_dio_t> dio(playerc_dio_create(robot.get(), 0));
  const Owned<playerc_aio_t> aio(playerc_aio_create(robot.get(), 0));
  ASSERT_EQ(playerc_dio_subscribe(dio.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_aio_subscribe(aio.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  EXPECT_EQ(playerc_aio_get_data(aio.get(), 0), 0.0F);
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(dio->count, 3);
  EXPECT_EQ(dio->digin, 1U);
  ASSERT_EQ(aio->voltages_count, 2);
  EXPECT_EQ(playerc_aio_get_data(aio.get(), 0), 5.0F);
  EXPECT_EQ(playerc_aio_get_data(aio.get(), 1), 0.0F);
  EXPECT_EQ(playerc_aio_get_data(aio.get(), 2), 0.0F);  // there is none
  EXPECT_EQ(playerc_dio_set_output(dio.get(), 1, 1), 0);
  EXPECT_EQ(playerc_dio_set_output(dio.get(), 9, 1), 0);  // sets the existing outputs
  EXPECT_EQ(playerc_aio_set_output(aio.get(), 0, 2.5F), 0);
  EXPECT_EQ(playerc_aio_set_output(aio.get(), 1, 2.5F), 0);  // no effect: the output does not exist
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(dio->digin, 5U);  // its own output is its third input
  EXPECT_EQ(playerc_aio_get_data(aio.get(), 1), 2.5F);
}

TEST_P(PlayercEverywhere, LightsAndSpeech_Work) {
  const auto robot = client();
  const Owned<playerc_blinkenlight_t> light(playerc_blinkenlight_create(robot.get(), 0));
  const Owned<playerc_speech_t> speech(playerc_speech_create(robot.get(), 0));
  ASSERT_EQ(playerc_blinkenlight_subscribe(light.get(), PLAYERC_OPEN_MODE), 0)
      << playerc_error_str();
  ASSERT_EQ(playerc_speech_subscribe(speech.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  EXPECT_EQ(playerc_blinkenlight_enable(light.get(), 1), 0);
  EXPECT_EQ(playerc_blinkenlight_color(light.get(), 0, 10, 20, 30), 0);
  EXPECT_EQ(playerc_blinkenlight_blink(light.get(), 0, 0.5F, 0.25F), 0);
  EXPECT_EQ(playerc_blinkenlight_color(light.get(), 1, 10, 20, 30), -1);
  EXPECT_EQ(playerc_blinkenlight_blink(light.get(), 0, 0.5F, 2.0F), -1);
  char text[] = "hello";
  EXPECT_EQ(playerc_speech_say(speech.get(), text), 0);
  EXPECT_EQ(playerc_speech_say(speech.get(), nullptr), -1);
  ASSERT_TRUE(reads(robot.get()));
  EXPECT_EQ(light->enabled, 1U);
  EXPECT_EQ(light->red, 10);
  EXPECT_EQ(light->green, 20);
  EXPECT_EQ(light->blue, 30);
  EXPECT_NEAR(light->period, 0.5, 1e-9);
  EXPECT_NEAR(light->duty_cycle, 0.25, 1e-9);
}

TEST_P(PlayercEverywhere, OpaqueMessages_ReportedOnArrival) {
  const auto robot = client();
  const Owned<playerc_opaque_t> opaque(playerc_opaque_create(robot.get(), 0));
  ASSERT_EQ(playerc_opaque_subscribe(opaque.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);  // readings, but no message
  uint8_t bytes[] = {'h', 'i'};
  player_opaque_data_t message = {2, bytes};
  ASSERT_EQ(playerc_opaque_cmd(opaque.get(), &message), 0) << playerc_error_str();
  ASSERT_TRUE(reads(robot.get()));
  ASSERT_EQ(opaque->data_count, 2);
  EXPECT_EQ(std::memcmp(opaque->data, "hi", 2), 0);
  EXPECT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_EQ(opaque->data_count, 2);  // the newest stays
  EXPECT_EQ(playerc_opaque_req(opaque.get(), &message, nullptr), -1);
}

TEST_P(PlayercEverywhere, Simulation_MovesObjectsByName) {
  const auto robot = client();
  const Owned<playerc_simulation_t> simulation(playerc_simulation_create(robot.get(), 0));
  ASSERT_EQ(playerc_simulation_subscribe(simulation.get(), PLAYERC_OPEN_MODE), 0)
      << playerc_error_str();
  char r1[] = "r1";
  char nobody[] = "r2d2";
  double x = 0.0;
  double y = 0.0;
  double yaw = 1.0;
  ASSERT_EQ(playerc_simulation_get_pose2d(simulation.get(), r1, &x, &y, &yaw), 0)
      << playerc_error_str();
  EXPECT_EQ(x, 1.0);
  EXPECT_EQ(y, 1.5);
  EXPECT_EQ(yaw, 0.0);
  ASSERT_EQ(playerc_simulation_set_pose2d(simulation.get(), r1, 0.5, 2.0, 1.0), 0);
  double time = -1.0;
  ASSERT_EQ(playerc_simulation_get_pose3d(simulation.get(), r1, &x, &y, nullptr, nullptr, nullptr,
                                          &yaw, &time),
            0);
  EXPECT_EQ(x, 0.5);
  EXPECT_EQ(yaw, 1.0);
  EXPECT_EQ(time, 0.0);
  EXPECT_EQ(playerc_simulation_set_pose3d(simulation.get(), r1, 1.0, 2.0, 0.0, 0.0, 0.0, 0.0), 0);
  EXPECT_EQ(playerc_simulation_get_pose2d(simulation.get(), nobody, &x, &y, &yaw), -1);
  EXPECT_THAT(playerc_error_str(), HasSubstr("r2d2"));
  EXPECT_EQ(playerc_simulation_set_pose2d(simulation.get(), nullptr, 1.0, 1.0, 0.0), -1);
  char size[] = "size";
  double sides[2] = {0.0, 0.0};
  char block[] = "b";
  ASSERT_EQ(playerc_simulation_get_property(simulation.get(), block, size, sides, sizeof sides), 0)
      << playerc_error_str();
  EXPECT_NEAR(sides[0], 0.4, 1e-9);
  sides[0] = 0.6;
  EXPECT_EQ(playerc_simulation_set_property(simulation.get(), block, size, sides, sizeof sides), 0)
      << playerc_error_str();
  char fiducial[] = "fiducial_return";
  int32_t number = 12;
  EXPECT_EQ(
      playerc_simulation_set_property(simulation.get(), block, fiducial, &number, sizeof number), 0)
      << playerc_error_str();
  number = 0;
  EXPECT_EQ(
      playerc_simulation_get_property(simulation.get(), block, fiducial, &number, sizeof number), 0)
      << playerc_error_str();
  EXPECT_EQ(number, 12);
  EXPECT_EQ(playerc_simulation_pause(simulation.get()), -1);
  EXPECT_EQ(playerc_simulation_reset(simulation.get()), -1);
  EXPECT_EQ(playerc_simulation_save(simulation.get()), -1);
}

TEST(PlayercNames, Interfaces_NamesAndCodesMatch) {
  EXPECT_EQ(itable_init(), 0);
  EXPECT_STREQ(interf_to_str(PLAYER_LASER_CODE), "laser");
  EXPECT_STREQ(interf_to_str(60000), "unknown");
  EXPECT_EQ(str_to_interf("position2d"), PLAYER_POSITION2D_CODE);
  EXPECT_EQ(str_to_interf("lazer"), 0xFFFF);
  EXPECT_EQ(str_to_interf(nullptr), 0xFFFF);
  player_interface_t interface {};
  EXPECT_EQ(lookup_interface("sonar", &interface), 0);
  EXPECT_EQ(interface.interf, PLAYER_SONAR_CODE);
  EXPECT_STREQ(interface.name, "sonar");
  EXPECT_EQ(lookup_interface_code(PLAYER_MAP_CODE, &interface), 0);
  EXPECT_STREQ(interface.name, "map");
  EXPECT_EQ(lookup_interface_code(-1, &interface), -1);
  EXPECT_EQ(lookup_interface("lazer", &interface), -1);
  EXPECT_EQ(lookup_interface("sonar", nullptr), -1);
  EXPECT_STREQ(lookup_interface_name(0, PLAYER_GPS_CODE), "gps");
  EXPECT_EQ(lookup_interface_name(PLAYER_GPS_CODE + 1, PLAYER_GPS_CODE), nullptr);
  EXPECT_EQ(lookup_interface_name(0, -5), nullptr);
  itable_destroy();
  EXPECT_STREQ(interf_to_str(PLAYER_LASER_CODE), "laser") << "there is nothing to destroy";
}

TEST(PlayercNames, MessageKinds_NamesAndCodesMatch) {
  for (std::uint8_t code = PLAYER_MSGTYPE_DATA; code <= PLAYER_MSGTYPE_RESP_NACK; ++code) {
    EXPECT_EQ(str_to_msgtype(msgtype_to_str(code)), code);
  }
  EXPECT_STREQ(msgtype_to_str(PLAYER_MSGTYPE_CMD), "command");
  EXPECT_STREQ(msgtype_to_str(0), "unknown");
  EXPECT_STREQ(msgtype_to_str(7), "unknown");
  EXPECT_EQ(str_to_msgtype("letter"), 0xFF);
  EXPECT_EQ(str_to_msgtype(nullptr), 0xFF);
}

TEST(PlayercNames, HostAddresses_Text) {
  std::uint32_t address = 0;
  ASSERT_EQ(hostname_to_packedaddr(&address, "127.0.0.1"), 0);
  std::array<char, 16> text{};
  packedaddr_to_dottedip(text.data(), text.size(), address);
  EXPECT_STREQ(text.data(), "127.0.0.1");
  packedaddr_to_dottedip(text.data(), 4, address);
  EXPECT_STREQ(text.data(), "127");
  packedaddr_to_dottedip(nullptr, 4, address);
  packedaddr_to_dottedip(text.data(), 0, address);
  EXPECT_STREQ(text.data(), "127");
  EXPECT_EQ(hostname_to_packedaddr(&address, "no host.invalid"), -1);
  EXPECT_EQ(hostname_to_packedaddr(nullptr, "127.0.0.1"), -1);
  EXPECT_EQ(hostname_to_packedaddr(&address, nullptr), -1);
}

TEST_F(Playerc, Log_Written) {
  const std::string out = folder_ / "out";
  setenv("PLAYPEN_OUT", out.c_str(), 1);
  const auto robot = client();
  unsetenv("PLAYPEN_OUT");
  const Owned<playerc_log_t> log(playerc_log_create(robot.get(), 0));
  ASSERT_EQ(playerc_log_subscribe(log.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  const auto base = position(robot.get());
  EXPECT_EQ(playerc_log_set_filename(log.get(), nullptr), -1);
  ASSERT_EQ(playerc_log_set_filename(log.get(), "short"), 0) << playerc_error_str();
  ASSERT_EQ(playerc_log_set_write_state(log.get(), 1), 0) << playerc_error_str();
  for (int i = 0; i < 5; ++i) ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  ASSERT_EQ(playerc_log_get_state(log.get()), 0);
  EXPECT_EQ(log->type, PLAYER_LOG_TYPE_WRITE);
  EXPECT_EQ(log->state, 1);
  ASSERT_EQ(playerc_log_set_write_state(log.get(), 0), 0);
  EXPECT_EQ(log->state, 0);
  ASSERT_EQ(playerc_client_read(robot.get()), robot->id);
  EXPECT_THAT(test_support::read_bytes(out + "/short.jsonl"), HasSubstr("\"device\""));
  EXPECT_EQ(playerc_log_set_read_state(log.get(), 1), 0) << playerc_error_str();
  EXPECT_EQ(log->type, PLAYER_LOG_TYPE_READ);
  EXPECT_EQ(playerc_log_set_read_rewind(log.get()), 0) << playerc_error_str();
}

}  // namespace
