// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices in Player's protocol. Their data are compared with those of the proxies in another
// simulation of the same world; simulations are deterministic. Where both use the same function
// (session/player_values/), the expected numbers are derived by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libCCMorse/CCMorse.h"
#include "libplayerc++/playerc++.h"
#include "playerlike/host/host.h"
#include "protocol/player_xdr.h"
#include "temporary_folder.h"
#include "wire/player_device.h"

namespace {

using namespace PlayerCc;
namespace wire = playerlike::wire;
namespace player = playerlike::player;
using playerlike::Host;
using playerlike::SessionError;
using playerlike::protocol::ProtocolError;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

sim::WorldDescription world(const std::string& name) {
  return sim::load_world(std::string(PLAYPEN_SOURCE_DIR "/worlds/") + name);
}

/// A client's device, with the messages that it has sent.
class WireDevice final : wire::DataSink, playerlike::ReadingSink {
 public:
  struct Sent {
    int subtype;
    std::string payload;
  };

  WireDevice(playerlike::Session& session, int port, const std::string& interface, int index = 0)
      : session_(session), device_(wire::make_player_device(session, port, interface, index)) {
    if (device_ == nullptr) throw std::runtime_error(interface + " is not offered");
    for (const playerlike::DeviceId source : device_->sources()) {
      session_.request(playerlike::SubscribeRequest{source});
    }
  }

  /// Lets time pass until there are new readings, as PlayerClient::Read() does.
  void read(int rounds = 1) {
    for (int i = 0; i < rounds; ++i) {
      session_.wait();
      sent_.clear();
      session_.take(*this);
      device_->on_round(*this);
    }
  }

  [[nodiscard]] const std::vector<Sent>& sent() const { return sent_; }
  /// The last message of the newest round.
  template <typename Payload>
  [[nodiscard]] Payload data(int subtype = 1) const {
    for (auto it = sent_.rbegin(); it != sent_.rend(); ++it) {
      if (it->subtype == subtype) return player::decode<Payload>(it->payload);
    }
    ADD_FAILURE() << "no message of subtype " << subtype;
    return {};
  }

  template <typename Payload>
  void command(int subtype, const Payload& payload) {
    device_->command(static_cast<std::uint8_t>(subtype), player::encode(payload));
  }
  /// The answer to a request.
  template <typename Answer, typename Payload>
  Answer request(int subtype, const Payload& payload) {
    const auto answer =
        device_->request(static_cast<std::uint8_t>(subtype), player::encode(payload));
    EXPECT_TRUE(answer.has_value()) << "request " << subtype << " was refused";
    return answer ? player::decode<Answer>(*answer) : Answer{};
  }
  template <typename Answer>
  Answer request(int subtype) {
    return request<Answer>(subtype, player::Empty{});
  }
  template <typename Payload>
  [[nodiscard]] bool accepts(int subtype, const Payload& payload) {
    return device_->request(static_cast<std::uint8_t>(subtype), player::encode(payload))
        .has_value();
  }
  [[nodiscard]] bool accepts(int subtype) { return accepts(subtype, player::Empty{}); }

  [[nodiscard]] wire::PlayerDevice& device() { return *device_; }

 private:
  void data(std::uint8_t subtype, std::string payload) override {
    sent_.push_back({subtype, std::move(payload)});
  }
  void on_reading(playerlike::DeviceId device, const sim::SharedReading& reading) override {
    device_->on_reading(device, *reading, *this);
  }

  playerlike::Session& session_;
  std::unique_ptr<wire::PlayerDevice> device_;
  std::vector<Sent> sent_;
};

/// Two simulations of a world: one for the proxies, one for Player's protocol.
struct Twins {
  explicit Twins(const sim::WorldDescription& description, int the_port = 6665)
      : port(the_port),
        embedded(Host::create(description)),
        served(Host::create(description)),
        client(embedded->connect(the_port)),
        session(served->connect(the_port)) {}
  explicit Twins(const std::string& name, int the_port = 6665) : Twins(world(name), the_port) {}

  [[nodiscard]] WireDevice open(const std::string& interface, int index = 0) {
    return {*session, port, interface, index};
  }
  void read(WireDevice& device, int rounds = 1) {
    for (int i = 0; i < rounds; ++i) client.Read();
    device.read(rounds);
  }

  int port;
  std::shared_ptr<Host> embedded;
  std::shared_ptr<Host> served;
  PlayerClient client;
  std::unique_ptr<playerlike::Session> session;
};

void expect_equal(const player_pose3d_t& of_proxy, const player::Pose3d& of_wire) {
  EXPECT_EQ(of_proxy.px, of_wire.px);
  EXPECT_EQ(of_proxy.py, of_wire.py);
  EXPECT_EQ(of_proxy.pz, of_wire.pz);
  EXPECT_EQ(of_proxy.proll, of_wire.proll);
  EXPECT_EQ(of_proxy.ppitch, of_wire.ppitch);
  EXPECT_EQ(of_proxy.pyaw, of_wire.pyaw);
}

void expect_equal(const player_bbox3d_t& of_proxy, const player::Bbox3d& of_wire) {
  EXPECT_EQ(of_proxy.sw, of_wire.sw);
  EXPECT_EQ(of_proxy.sl, of_wire.sl);
  EXPECT_EQ(of_proxy.sh, of_wire.sh);
}

/// Many values of the protocol are single-precision numbers.
float single(double value) { return static_cast<float>(value); }

// --- Driving

void expect_equal(const Position2dProxy& proxy, const player::Position2dData& data) {
  EXPECT_EQ(proxy.GetXPos(), data.pos.px);
  EXPECT_EQ(proxy.GetYPos(), data.pos.py);
  EXPECT_EQ(proxy.GetYaw(), data.pos.pa);
  EXPECT_EQ(proxy.GetXSpeed(), data.vel.px);
  EXPECT_EQ(proxy.GetYSpeed(), data.vel.py);
  EXPECT_EQ(proxy.GetYawSpeed(), data.vel.pa);
  EXPECT_EQ(proxy.GetStall(), data.stall != 0);
}

TEST(WirePosition2d, Commands_DriveLikeProxy) {
  Twins twins("cave.json");
  Position2dProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("position2d");
  EXPECT_EQ(device.device().driver(), proxy.GetDriverName());
  const auto expect_same = [&](const char* what) {
    SCOPED_TRACE(what);
    twins.read(device, 5);
    expect_equal(proxy, device.data<player::Position2dData>());
  };
  expect_same("at rest");
  proxy.SetSpeed(0.2, 0.0, 0.4);
  device.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{{0.2, 0.0, 0.4}, 1});
  expect_same("at a speed");
  EXPECT_GT(proxy.GetXSpeed(), 0.05);
  proxy.SetCarlike(0.2, -0.3);
  device.command(PLAYER_POSITION2D_CMD_CAR, player::Position2dCmdCar{0.2, -0.3});
  expect_same("like a car");
  proxy.SetVelHead(0.1, 7.0);
  device.command(PLAYER_POSITION2D_CMD_VEL_HEAD, player::Position2dCmdVelHead{0.1, 7.0});
  expect_same("at a heading");
  const double x = proxy.GetXPos() + 0.3;
  const double y = proxy.GetYPos();
  proxy.GoTo({x, y, 1.0}, {0.3, 0.0, 0.5});
  device.command(PLAYER_POSITION2D_CMD_POS,
                 player::Position2dCmdPos{{x, y, 1.0}, {0.3, 0.0, 0.5}, 1});
  expect_same("to a goal");
  proxy.SetMotorEnable(false);
  EXPECT_TRUE(device.accepts(PLAYER_POSITION2D_REQ_MOTOR_POWER, player::Position2dPowerConfig{0}));
  expect_same("without motors");
  EXPECT_EQ(proxy.GetXSpeed(), 0.0);
}

TEST(WirePosition2d, Odometry_Set) {
  Twins twins("devices/odometry.json");
  Position2dProxy proxy(&twins.client, 1);
  WireDevice device = twins.open("position2d", 1);
  EXPECT_EQ(device.device().driver(), "odometry");
  proxy.SetOdometry(1.0, 2.0, 7.0);
  EXPECT_TRUE(device.accepts(PLAYER_POSITION2D_REQ_SET_ODOM,
                             player::Position2dSetOdomReq{{1.0, 2.0, 7.0}}));
  twins.read(device);
  expect_equal(proxy, device.data<player::Position2dData>());
  EXPECT_NEAR(proxy.GetXPos(), 1.0, 0.1);
  EXPECT_TRUE(device.accepts(PLAYER_POSITION2D_REQ_RESET_ODOM));
  proxy.ResetOdometry();
  twins.read(device);
  expect_equal(proxy, device.data<player::Position2dData>());
  EXPECT_NEAR(proxy.GetXPos(), 0.0, 0.1);
}

TEST(WirePosition2d, Geometry_SentAndControlSettingsRefused) {
  Twins twins("cave.json");
  Position2dProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("position2d");
  const auto geometry = device.request<player::Position2dGeom>(PLAYER_POSITION2D_REQ_GET_GEOM);
  expect_equal(proxy.GetOffset(), geometry.pose);
  expect_equal(proxy.GetSize(), geometry.size);
  EXPECT_GT(geometry.size.sl, 0.1);
  EXPECT_FALSE(device.accepts(PLAYER_POSITION2D_REQ_VELOCITY_MODE, player::Uint32{1}));
  EXPECT_FALSE(device.accepts(PLAYER_POSITION2D_REQ_POSITION_MODE, player::Uint32{1}));
  EXPECT_FALSE(device.accepts(PLAYER_POSITION2D_REQ_SPEED_PID, player::Position2dSpeedPidReq{}));
  EXPECT_FALSE(
      device.accepts(PLAYER_POSITION2D_REQ_POSITION_PID, player::Position2dPositionPidReq{}));
  EXPECT_FALSE(device.accepts(PLAYER_POSITION2D_REQ_SPEED_PROF, player::Position2dSpeedProfReq{}));
}

TEST(WirePosition2d, NonFiniteNumbers_Refused) {
  Twins twins("cave.json");
  WireDevice device = twins.open("position2d");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(device.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{{nan, 0, 0}, 1}),
               SessionError);
  EXPECT_THROW(device.command(PLAYER_POSITION2D_CMD_CAR, player::Position2dCmdCar{0.1, inf}),
               SessionError);
  EXPECT_THROW(device.command(PLAYER_POSITION2D_CMD_VEL_HEAD, player::Position2dCmdVelHead{0, nan}),
               SessionError);
  EXPECT_THROW(
      device.command(PLAYER_POSITION2D_CMD_POS, player::Position2dCmdPos{{0, inf, 0}, {}, 1}),
      SessionError);
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_POSITION2D_REQ_SET_ODOM,
                                                player::Position2dSetOdomReq{{0, 0, nan}})),
               SessionError);
  device.read(3);
  EXPECT_EQ(device.data<player::Position2dData>().vel.px, 0.0);
}

TEST(WirePosition2d, Driver_PursuesGoals) {
  Twins twins("examples/snd_driver.json");
  Position2dProxy proxy(&twins.client, 2);
  WireDevice device = twins.open("position2d", 2);
  EXPECT_EQ(device.device().driver(), "snd");
  twins.read(device);
  proxy.GoTo({0.5, 0.9, 1.5}, {0.0, 0.0, 0.0});
  device.command(PLAYER_POSITION2D_CMD_POS, player::Position2dCmdPos{{0.5, 0.9, 1.5}, {}, 1});
  twins.read(device, 30);
  expect_equal(proxy, device.data<player::Position2dData>());
  EXPECT_GT(proxy.GetYPos(), 0.5);
  // Other commands cancel the goal.
  device.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{{}, 1});
  device.read(20);
  EXPECT_EQ(device.data<player::Position2dData>().vel.px, 0.0);
}

TEST(WirePosition2d, RobotWithoutMotors_CommandsRefused) {
  Twins twins(sim::load_world_text(
      R"({"arena": {"size": [2, 2]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1},
          "devices": {"motion": null, "pen": null}}]})"));
  WireDevice device = twins.open("position2d");
  EXPECT_THROW(device.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{}), SessionError);
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_POSITION2D_REQ_MOTOR_POWER,
                                                player::Position2dPowerConfig{1})),
               SessionError);
  EXPECT_FALSE(
      device.accepts(PLAYER_CAPABILITIES_REQ,
                     player::CapabilitiesReq{PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL}));
}

TEST(WireLocalize, Hypothesis_MatchesProxy) {
  Twins twins("devices/pose.json");
  LocalizeProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("localize");
  EXPECT_FALSE(device.accepts(PLAYER_LOCALIZE_REQ_GET_PARTICLES));  // before the first reading
  twins.read(device, 2);
  const auto data = device.data<player::LocalizeData>();
  ASSERT_THAT(data.hypoths, SizeIs(1));
  const player_localize_hypoth_t expected = proxy.GetHypoth(0);
  EXPECT_EQ(data.hypoths[0].mean.px, expected.mean.px);
  EXPECT_EQ(data.hypoths[0].mean.pa, expected.mean.pa);
  EXPECT_EQ(data.hypoths[0].cov[1], expected.cov[1]);
  // The pose is measured within 1 cm and 1 degree; 4 deviations are allowed.
  EXPECT_NEAR(data.hypoths[0].mean.px, 1.0, 0.04);
  EXPECT_NEAR(data.hypoths[0].mean.py, 1.0, 0.04);
  EXPECT_NEAR(data.hypoths[0].mean.pa, 0.0, 4.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(data.hypoths[0].cov[0], 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(data.hypoths[0].cov[1], 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(data.hypoths[0].cov[2], std::pow(std::numbers::pi / 180.0, 2), 1e-12);
  EXPECT_EQ(data.hypoths[0].alpha, 1.0);
  const auto particles =
      device.request<player::LocalizeGetParticles>(PLAYER_LOCALIZE_REQ_GET_PARTICLES);
  ASSERT_THAT(particles.particles, SizeIs(1));
  EXPECT_EQ(particles.particles[0].pose.py, expected.mean.py);
  EXPECT_TRUE(device.accepts(PLAYER_LOCALIZE_REQ_SET_POSE, player::LocalizeSetPose{{1, 2, 3}, {}}));
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_LOCALIZE_REQ_SET_POSE,
                                                player::LocalizeSetPose{{NAN, 2, 3}, {}})),
               SessionError);
}

// --- Ranging

void expect_equal(const LaserProxy& proxy, const player::LaserData& data) {
  ASSERT_EQ(data.ranges.size(), proxy.GetCount());
  ASSERT_EQ(data.intensity.size(), data.ranges.size());
  for (std::uint32_t i = 0; i < proxy.GetCount(); ++i) {
    ASSERT_EQ(data.ranges[i], single(proxy.GetRange(i))) << i;
    ASSERT_EQ(data.intensity[i], 0);
  }
  EXPECT_EQ(data.min_angle, single(proxy.GetMinAngle()));
  EXPECT_FLOAT_EQ(data.max_angle, single(proxy.GetMaxAngle()));
  EXPECT_EQ(data.resolution, single(proxy.GetScanRes()));
  EXPECT_EQ(data.max_range, single(proxy.GetMaxRange()));
}

TEST(WireLaser, ScanAndConfigure_MatchProxy) {
  Twins twins("cave.json");
  LaserProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("laser");
  twins.read(device, 2);
  expect_equal(proxy, device.data<player::LaserData>());
  const auto id = device.data<player::LaserData>().id;
  const auto geometry = device.request<player::LaserGeom>(PLAYER_LASER_REQ_GET_GEOM);
  expect_equal(proxy.GetPose(), geometry.pose);
  expect_equal(proxy.GetSize(), geometry.size);

  player::LaserConfig wish;
  wish.min_angle = -0.5F;
  wish.max_angle = 0.75F;
  wish.resolution = static_cast<float>(100 * 0.01 * M_PI / 180.0);
  wish.max_range = NAN;  // clients leave it undefined
  wish.range_res = 0.01F;
  proxy.Configure(-0.5, 0.75, 100, 10, false, 10.0);
  const auto answer = device.request<player::LaserConfig>(PLAYER_LASER_REQ_SET_CONFIG, wish);
  EXPECT_EQ(answer.min_angle, single(proxy.GetConfMinAngle()));
  EXPECT_FLOAT_EQ(answer.max_angle, single(proxy.GetConfMaxAngle()));
  EXPECT_EQ(answer.range_res, 0.01F);
  twins.read(device);
  const auto data = device.data<player::LaserData>();
  EXPECT_EQ(data.id, id + 1);
  ASSERT_EQ(data.ranges.size(), proxy.GetCount());
  EXPECT_LT(data.ranges.size(), 100U);
  for (std::uint32_t i = 0; i < proxy.GetCount(); ++i) {
    EXPECT_NEAR(data.ranges[i], proxy.GetRange(i), 1e-6);
  }
  const auto config = device.request<player::LaserConfig>(PLAYER_LASER_REQ_GET_CONFIG);
  EXPECT_EQ(config.resolution, single(proxy.GetScanRes()));
  EXPECT_EQ(config.scanning_frequency, single(proxy.GetScanningFrequency()));

  // LaserProxy of Player's library sends 0.01 degrees and millimetres.
  wish.resolution = 100.0F;
  wish.range_res = 10.0F;
  EXPECT_EQ(device.request<player::LaserConfig>(PLAYER_LASER_REQ_SET_CONFIG, wish).resolution,
            config.resolution);
  wish.min_angle = 4.0F;
  wish.max_angle = 5.0F;
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_LASER_REQ_SET_CONFIG, wish)), SessionError);
  wish.max_angle = NAN;
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_LASER_REQ_SET_CONFIG, wish)), SessionError);
  EXPECT_TRUE(device.accepts(PLAYER_LASER_REQ_POWER, player::LaserPowerConfig{0}));
  EXPECT_EQ(device.request<player::LaserGetIdConfig>(PLAYER_LASER_REQ_GET_ID).serial_number, 0U);
  EXPECT_FALSE(device.accepts(PLAYER_LASER_REQ_SET_FILTER, player::LaserSetFilterConfig{}));
}

void expect_ranger_equal(const std::string& world_name) {
  SCOPED_TRACE(world_name);
  Twins twins(world_name);
  RangerProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("ranger");
  const auto expect_same = [&] {
    twins.read(device, 2);
    const auto data = device.data<player::RangerDataRange>(PLAYER_RANGER_DATA_RANGE);
    ASSERT_EQ(data.ranges.size(), proxy.GetRangeCount());
    for (std::uint32_t i = 0; i < proxy.GetRangeCount(); ++i) {
      ASSERT_EQ(data.ranges[i], proxy.GetRange(i)) << i;
    }
    if (proxy.GetIntensityCount() == 0) return;  // only devices/sonar.json has any
    const auto strengths = device.data<player::RangerDataIntns>(PLAYER_RANGER_DATA_INTNS);
    ASSERT_EQ(strengths.intensities.size(), proxy.GetIntensityCount());
    for (std::uint32_t i = 0; i < proxy.GetIntensityCount(); ++i) {
      ASSERT_EQ(strengths.intensities[i], proxy.GetIntensity(i)) << i;
    }
  };
  expect_same();
  const auto geometry = device.request<player::RangerGeom>(PLAYER_RANGER_REQ_GET_GEOM);
  expect_equal(proxy.GetDevicePose(), geometry.pose);
  expect_equal(proxy.GetDeviceSize(), geometry.size);
  ASSERT_EQ(geometry.element_poses.size(), proxy.GetElementCount());
  ASSERT_EQ(geometry.element_sizes.size(), proxy.GetElementCount());
  for (std::uint32_t i = 0; i < proxy.GetElementCount(); ++i) {
    expect_equal(proxy.GetElementPose(i), geometry.element_poses[i]);
    expect_equal(proxy.GetElementSize(i), geometry.element_sizes[i]);
  }
  player::RangerConfig wish{-0.5, 0.5, 0.0, 0.2, 1.5, 0.01, 10.0};
  proxy.Configure(-0.5, 0.5, 0.0, 0.2, 1.5, 0.01, 10.0);
  const auto answer = device.request<player::RangerConfig>(PLAYER_RANGER_REQ_SET_CONFIG, wish);
  const auto config = device.request<player::RangerConfig>(PLAYER_RANGER_REQ_GET_CONFIG);
  EXPECT_EQ(answer.min_angle, config.min_angle);
  EXPECT_EQ(config.min_angle, proxy.GetMinAngle());
  EXPECT_NEAR(config.max_angle, proxy.GetMaxAngle(), 1e-12);
  EXPECT_EQ(config.angular_res, proxy.GetAngularRes());
  EXPECT_EQ(config.min_range, proxy.GetMinRange());
  EXPECT_EQ(config.max_range, proxy.GetMaxRange());
  EXPECT_EQ(config.range_res, proxy.GetRangeRes());
  EXPECT_EQ(config.frequency, proxy.GetFrequency());
  expect_same();
  wish.max_range = -1.0;
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_RANGER_REQ_SET_CONFIG, wish)), SessionError);
  EXPECT_TRUE(device.accepts(PLAYER_RANGER_REQ_POWER, player::RangerPowerConfig{1}));
  EXPECT_TRUE(device.accepts(PLAYER_RANGER_REQ_INTNS, player::RangerIntnsConfig{1}));
}

TEST(WireRanger, RangesAndConfigure_MatchProxy) {
  expect_ranger_equal("cave.json");
  expect_ranger_equal("devices/sonar.json");
  expect_ranger_equal("devices/infrared.json");
}

TEST(WireSonar, Ranges_MatchProxy) {
  Twins twins("devices/sonar.json");
  SonarProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("sonar");
  twins.read(device, 2);
  const auto data = device.data<player::SonarData>();
  ASSERT_EQ(data.ranges.size(), proxy.GetCount());
  for (std::uint32_t i = 0; i < proxy.GetCount(); ++i) {
    EXPECT_EQ(data.ranges[i], single(proxy.GetScan(i)));
  }
  const auto geometry = device.request<player::SonarGeom>(PLAYER_SONAR_REQ_GET_GEOM);
  ASSERT_EQ(geometry.poses.size(), proxy.GetPoseCount());
  for (std::uint32_t i = 0; i < proxy.GetPoseCount(); ++i) {
    expect_equal(proxy.GetPose(i), geometry.poses[i]);
  }
  EXPECT_DOUBLE_EQ(geometry.poses.at(0).px, -0.08);  // at the back, in the world
  EXPECT_DOUBLE_EQ(geometry.poses.at(0).pyaw, M_PI);
  EXPECT_TRUE(device.accepts(PLAYER_SONAR_REQ_POWER, player::SonarPowerConfig{1}));
}

TEST(WireIr, Ranges_MatchProxy) {
  Twins twins("devices/infrared.json", 6666);
  IrProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("ir");
  twins.read(device, 2);
  const auto data = device.data<player::IrData>();
  ASSERT_EQ(data.ranges.size(), proxy.GetCount());
  ASSERT_EQ(data.voltages.size(), proxy.GetCount());
  for (std::uint32_t i = 0; i < proxy.GetCount(); ++i) {
    EXPECT_EQ(data.ranges[i], single(proxy.GetRange(i)));
    EXPECT_EQ(data.voltages[i], single(proxy.GetVoltage(i)));
  }
  const auto geometry = device.request<player::IrPose>(PLAYER_IR_REQ_POSE);
  ASSERT_EQ(geometry.poses.size(), proxy.GetPoseCount());
  expect_equal(proxy.GetPose(1), geometry.poses[1]);
  EXPECT_TRUE(device.accepts(PLAYER_IR_REQ_POWER, player::IrPowerReq{1}));
}

// --- Sensing

TEST(WireBumper, Segments_MatchProxy) {
  Twins twins("devices/bumper.json");
  BumperProxy proxy(&twins.client, 0);
  Position2dProxy motors(&twins.client, 0);
  WireDevice device = twins.open("bumper");
  WireDevice wheels = twins.open("position2d");
  motors.SetSpeed(0.3, 0.0);
  wheels.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{{0.3, 0.0, 0.0}, 1});
  bool has_bumped = false;
  for (int i = 0; i < 60; ++i) {
    twins.client.Read();
    device.read();
    const auto data = device.data<player::BumperData>();
    ASSERT_EQ(data.bumpers.size(), proxy.GetCount());
    for (std::uint32_t j = 0; j < proxy.GetCount(); ++j) {
      ASSERT_EQ(data.bumpers[j], proxy.IsBumped(j));
    }
    has_bumped = has_bumped || proxy.IsAnyBumped();
  }
  EXPECT_TRUE(has_bumped);
  const auto geometry = device.request<player::BumperGeom>(PLAYER_BUMPER_REQ_GET_GEOM);
  ASSERT_EQ(geometry.bumper_def.size(), proxy.GetPoseCount());
  // The right one of the two in the world.
  const player::BumperDefine& right = geometry.bumper_def.at(1);
  EXPECT_DOUBLE_EQ(right.pose.px, 0.078);
  EXPECT_DOUBLE_EQ(right.pose.py, -0.045);
  EXPECT_DOUBLE_EQ(right.pose.pyaw, -M_PI / 6.0);
  EXPECT_EQ(right.length, 0.094F);
  EXPECT_EQ(right.radius, 0.09F);
  for (std::uint32_t i = 0; i < proxy.GetPoseCount(); ++i) {
    expect_equal(proxy.GetPose(i).pose, geometry.bumper_def[i].pose);
    EXPECT_EQ(proxy.GetPose(i).length, geometry.bumper_def[i].length);
    EXPECT_EQ(proxy.GetPose(i).radius, geometry.bumper_def[i].radius);
  }
}

/// Compares an item of the proxy or of the protocol with numbers.
template <typename Item>
void expect_item(const Item& item, int id, const sim::Pose& X_ST, const sim::Pose& deviation) {
  EXPECT_EQ(item.id, id);
  // The errors of the measurement are within 1e-5.
  EXPECT_NEAR(item.pose.px, X_ST.x_m, 1e-4);
  EXPECT_NEAR(item.pose.py, X_ST.y_m, 1e-4);
  EXPECT_NEAR(item.pose.pyaw, X_ST.yaw_rad, 1e-3);
  for (const double zero : {item.pose.pz, item.pose.proll, item.pose.ppitch}) EXPECT_EQ(zero, 0.0);
  EXPECT_NEAR(item.upose.px, deviation.x_m, 1e-11);
  EXPECT_NEAR(item.upose.py, deviation.y_m, 1e-11);
  EXPECT_NEAR(item.upose.pyaw, deviation.yaw_rad, 1e-12);
  for (const double zero : {item.upose.pz, item.upose.proll, item.upose.ppitch}) {
    EXPECT_EQ(zero, 0.0);
  }
}

TEST(WireFiducial, Items_HaveExpectedNumbers) {
  Twins twins(sim::load_world_text(R"({"arena": {"size": [6, 6], "obstacles": [
      {"name": "post", "center": [1.1, 3.3], "size": [0.2, 0.2], "yaw_deg": 120, "fiducial": 7}]},
      "robots": [{"name": "finder", "pose": {"x": 2, "y": 2, "yaw_deg": 90}, "devices": {
        "fiducial": {"pose": {"x": 0.1}, "height": 0.05, "range_max": 6, "field_of_view_deg": 120,
                     "noise": 1e-6, "noise_bearing_deg": 1e-4, "noise_yaw_deg": 1e-3}}},
      {"name": "fox", "fiducial": 1, "pose": {"x": 2, "y": 4.1, "yaw_deg": 90}}]})"));
  FiducialProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("fiducial");
  twins.read(device);
  const auto data = device.data<player::FiducialData>();
  ASSERT_THAT(data.fiducials, SizeIs(2));
  ASSERT_EQ(proxy.GetCount(), 2U);
  // The sensor is at (2, 2.1) and looks along y. The post is 1.2 m ahead and 0.9 m to the left, so
  // 1.5 m away, in a direction with the cosine 0.8 and the sine 0.6. The fox is 2 m ahead.
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double along_m = 1e-6;
  const double across_m = 1.5 * 1e-4 * kDegree;
  const sim::Pose of_post{std::hypot(0.8 * along_m, 0.6 * across_m),
                          std::hypot(0.6 * along_m, 0.8 * across_m), 1e-3 * kDegree};
  const sim::Pose of_fox{along_m, 2.0 * 1e-4 * kDegree, 1e-3 * kDegree};
  expect_item(data.fiducials[0], 7, {1.2, 0.9, 30 * kDegree}, of_post);
  expect_item(data.fiducials[1], 1, {2.0, 0.0, 0.0}, of_fox);
  expect_item(proxy[0], 7, {1.2, 0.9, 30 * kDegree}, of_post);
  expect_item(proxy[1], 1, {2.0, 0.0, 0.0}, of_fox);
  const auto geometry = device.request<player::FiducialGeom>(PLAYER_FIDUCIAL_REQ_GET_GEOM);
  EXPECT_EQ(geometry.pose.px, 0.1);
  EXPECT_EQ(geometry.pose.py, 0.0);
  EXPECT_EQ(geometry.pose.pz, 0.05);
  EXPECT_EQ(geometry.pose.pyaw, 0.0);
  expect_equal(proxy.GetSensorPose(), geometry.pose);
  const auto view = device.request<player::FiducialFov>(PLAYER_FIDUCIAL_REQ_GET_FOV);
  EXPECT_EQ(view.max_range, 6.0F);
  EXPECT_FLOAT_EQ(view.view_angle, single(120 * kDegree));
  EXPECT_FALSE(device.accepts(PLAYER_FIDUCIAL_REQ_SET_FOV, view));
  EXPECT_FALSE(device.accepts(PLAYER_FIDUCIAL_REQ_GET_ID));
}

/// Compares a blob of the proxy or of the protocol with numbers.
template <typename Blob>
void expect_blob(const Blob& blob) {
  EXPECT_EQ(blob.color, 0xff8000U);
  EXPECT_EQ(blob.left, 33U);
  EXPECT_EQ(blob.right, 46U);
  EXPECT_EQ(blob.top, 23U);
  EXPECT_EQ(blob.bottom, 32U);
  EXPECT_EQ(blob.area, 14U * 10U);
  EXPECT_EQ(blob.x, 40U);
  EXPECT_EQ(blob.y, 28U);
  EXPECT_NEAR(blob.range, 2.0F, 0.01F);  // the mean over the columns; the edges are farther
}

TEST(WireBlobfinder, Blobs_HaveExpectedNumbers) {
  // The example of docs/devices/blobfinder.md: a face 2 m away, 0.4 m wide and 0.3 m high, seen
  // from a height of 0.1 m with f = 69.28. Columns 40 -+ 6.93, rows from 30 - 6.93 to 30 + 3.46.
  Twins twins(sim::load_world_text(R"({"arena": {"size": [6, 4], "obstacles": [
      {"center": [3.2, 2], "size": [0.4, 0.4], "height": 0.3, "colour": "#ff8000"}]},
      "robots": [{"pose": {"x": 1, "y": 2, "yaw_deg": 0},
                  "devices": {"blobfinder": {"height": 0.1}}}]})"));
  BlobfinderProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("blobfinder");
  twins.read(device);
  const auto data = device.data<player::BlobfinderData>();
  EXPECT_EQ(data.width, 80U);
  EXPECT_EQ(data.height, 60U);
  EXPECT_EQ(proxy.GetWidth(), 80U);
  EXPECT_EQ(proxy.GetHeight(), 60U);
  ASSERT_THAT(data.blobs, SizeIs(1));
  ASSERT_EQ(proxy.GetCount(), 1U);
  expect_blob(data.blobs[0]);
  expect_blob(proxy[0]);
}

TEST(WireCamera, Picture_MatchesProxy) {
  Twins twins("devices/camera.json");
  CameraProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("camera");
  EXPECT_FALSE(device.accepts(PLAYER_CAMERA_REQ_GET_IMAGE));  // before the first picture
  twins.read(device, 2);
  const auto data = device.data<player::CameraData>();
  EXPECT_EQ(data.width, proxy.GetWidth());
  EXPECT_EQ(data.height, proxy.GetHeight());
  EXPECT_EQ(data.bpp, proxy.GetDepth());
  EXPECT_EQ(data.format, proxy.GetFormat());
  EXPECT_EQ(data.compression, proxy.GetCompression());
  std::vector<std::uint8_t> pixels(proxy.GetImageSize());
  proxy.GetImage(pixels.data());
  EXPECT_EQ(data.image, pixels);
  EXPECT_EQ(device.request<player::CameraData>(PLAYER_CAMERA_REQ_GET_IMAGE).image, pixels);
  EXPECT_FALSE(device.accepts(PLAYER_CAMERA_REQ_GET_SOURCE));
}

TEST(WireGps, Values_ConvertedToThoseOfProxy) {
  Twins twins("devices/gps.json");
  GpsProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("gps");
  twins.read(device, 3);
  const auto data = device.data<player::GpsData>();
  // As Player's client library converts them.
  EXPECT_NEAR(data.latitude / 1e7, proxy.GetLatitude(), 1e-7);
  EXPECT_NEAR(data.longitude / 1e7, proxy.GetLongitude(), 1e-7);
  EXPECT_NEAR(data.altitude / 1e3, proxy.GetAltitude(), 1e-3);
  EXPECT_NEAR(data.utm_e / 100.0, proxy.GetUtmEasting(), 1e-6);
  EXPECT_NEAR(data.utm_n / 100.0, proxy.GetUtmNorthing(), 1e-6);
  EXPECT_EQ(data.hdop / 10.0, proxy.GetHdop());
  EXPECT_EQ(data.vdop / 10.0, proxy.GetVdop());
  EXPECT_NEAR(data.time_sec + 1e-6 * data.time_usec, proxy.GetTime(), 1e-6);
  EXPECT_EQ(data.speed, proxy.GetSpeed());
  EXPECT_EQ(data.course, proxy.GetCourse());
  EXPECT_EQ(data.num_sats, proxy.GetSatellites());
  EXPECT_EQ(data.quality, proxy.GetQuality());
  EXPECT_EQ(data.err_horz, proxy.GetErrHorizontal());
  EXPECT_EQ(data.err_vert, proxy.GetErrVertical());
  EXPECT_LT(data.latitude, -330000000);
}

TEST(WireImu, DataTypes_HaveExpectedNumbers) {
  // A circle at 0.2 m/s and 0.5 rad/s: 0.05 rad in each round of 0.1 s.
  Twins twins(sim::load_world_text(R"({"arena": {"size": [6, 6]}, "robots": [
      {"pose": {"x": 3, "y": 2, "yaw_deg": 0}, "devices": {"imu": {}}}]})"));
  ImuProxy proxy(&twins.client, 0);
  Position2dProxy motors(&twins.client, 0);
  WireDevice device = twins.open("imu");
  WireDevice wheels = twins.open("position2d");
  motors.SetSpeed(0.2, 0.5);
  wheels.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{{0.2, 0.0, 0.5}, 1});
  const auto expect_yaw = [&](double yaw_rad, double of_wire_rad) {
    EXPECT_NEAR(of_wire_rad, yaw_rad, 1e-6);
    EXPECT_NEAR(proxy.GetPose().pyaw, yaw_rad, 1e-6);
  };
  // To the left v omega = 0.1 m/s^2; magnetic north lies at 90 degrees minus the yaw.
  const auto expect_values = [&](const player::ImuDataCalib& values, double yaw_rad) {
    const player_imu_data_calib_t of_proxy = proxy.GetRawValues();
    const double expected[] = {
        0.0,  0.1, 9.80665, 0.0, 0.0, 0.5, 20.0 * std::sin(yaw_rad), 20.0 * std::cos(yaw_rad),
        -45.0};
    const float of_wire[] = {values.accel_x, values.accel_y, values.accel_z,
                             values.gyro_x,  values.gyro_y,  values.gyro_z,
                             values.magn_x,  values.magn_y,  values.magn_z};
    const float of_client[] = {of_proxy.accel_x, of_proxy.accel_y, of_proxy.accel_z,
                               of_proxy.gyro_x,  of_proxy.gyro_y,  of_proxy.gyro_z,
                               of_proxy.magn_x,  of_proxy.magn_y,  of_proxy.magn_z};
    for (std::size_t i = 0; i < std::size(expected); ++i) {
      EXPECT_NEAR(of_wire[i], expected[i], 1e-5) << i;
      EXPECT_NEAR(of_client[i], expected[i], 1e-5) << i;
    }
  };
  twins.read(device, 5);
  ASSERT_THAT(device.sent(), SizeIs(2));
  expect_yaw(0.25, device.data<player::ImuDataState>(PLAYER_IMU_DATA_STATE).pose.pyaw);
  expect_values(device.data<player::ImuDataCalib>(PLAYER_IMU_DATA_CALIB), 0.25);
  const auto select = [&](std::uint8_t kind) {
    EXPECT_TRUE(device.accepts(PLAYER_IMU_REQ_SET_DATATYPE, player::ImuDatatypeConfig{kind}));
    twins.read(device);
    ASSERT_THAT(device.sent(), SizeIs(1));
    EXPECT_EQ(device.sent()[0].subtype, kind);
  };
  select(PLAYER_IMU_DATA_STATE);
  expect_yaw(0.30, device.data<player::ImuDataState>(PLAYER_IMU_DATA_STATE).pose.pyaw);
  select(PLAYER_IMU_DATA_CALIB);
  expect_values(device.data<player::ImuDataCalib>(PLAYER_IMU_DATA_CALIB), 0.35);
  select(PLAYER_IMU_DATA_QUAT);
  const auto quaternion = device.data<player::ImuDataQuat>(PLAYER_IMU_DATA_QUAT);
  expect_values(quaternion.calib_data, 0.40);
  EXPECT_NEAR(quaternion.q0, std::cos(0.20), 1e-6);
  EXPECT_EQ(quaternion.q1, 0.0F);
  EXPECT_EQ(quaternion.q2, 0.0F);
  EXPECT_NEAR(quaternion.q3, std::sin(0.20), 1e-6);
  select(PLAYER_IMU_DATA_EULER);
  const auto euler = device.data<player::ImuDataEuler>(PLAYER_IMU_DATA_EULER);
  expect_values(euler.calib_data, 0.45);
  expect_yaw(0.45, euler.orientation.pyaw);
  select(PLAYER_IMU_DATA_FULLSTATE);
  const auto full = device.data<player::ImuDataFullstate>(PLAYER_IMU_DATA_FULLSTATE);
  expect_yaw(0.50, full.pose.pyaw);
  EXPECT_NEAR(full.vel.pyaw, 0.5, 1e-6);
  EXPECT_NEAR(full.acc.py, 0.1, 1e-6);
  EXPECT_NEAR(full.acc.pz, 9.80665, 1e-6);
  EXPECT_FALSE(device.accepts(PLAYER_IMU_REQ_SET_DATATYPE, player::ImuDatatypeConfig{0}));
  EXPECT_FALSE(device.accepts(PLAYER_IMU_REQ_SET_DATATYPE, player::ImuDatatypeConfig{6}));

  proxy.ResetEuler(0.0F, 0.0F, 1.5F);
  EXPECT_TRUE(device.accepts(PLAYER_IMU_REQ_RESET_EULER,
                             player::ImuResetEulerConfig{{0.0, 0.0, 0.0, 0.0, 0.0, 1.5}}));
  twins.read(device);
  expect_yaw(1.55, device.data<player::ImuDataFullstate>(PLAYER_IMU_DATA_FULLSTATE).pose.pyaw);
  EXPECT_TRUE(device.accepts(PLAYER_IMU_REQ_RESET_ORIENTATION, player::Uint32{0}));
  EXPECT_THROW(
      static_cast<void>(device.accepts(
          PLAYER_IMU_REQ_RESET_EULER, player::ImuResetEulerConfig{{0.0, 0.0, 0.0, 0.0, 0.0, NAN}})),
      SessionError);
}

TEST(WireImu, Compass_SendsHeading) {
  // Facing 30 degrees, with magnetic north along y, at 90 degrees.
  Twins twins(sim::load_world_text(R"({"arena": {"size": [6, 6]}, "robots": [
      {"pose": {"x": 3, "y": 3, "yaw_deg": 30}, "devices": {"compass": {"north_deg": 90}}}]})"));
  ImuProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("imu");
  twins.read(device);
  ASSERT_THAT(device.sent(), SizeIs(1));
  EXPECT_NEAR(device.data<player::ImuDataState>().pose.pyaw, -std::numbers::pi / 3.0, 1e-9);
  EXPECT_NEAR(proxy.GetPose().pyaw, -std::numbers::pi / 3.0, 1e-9);
}

TEST(WirePower, Charge_MatchesProxy) {
  for (const int port : {6665, 6666}) {
    Twins twins("devices/battery.json", port);
    PowerProxy proxy(&twins.client, 0);
    WireDevice device = twins.open("power");
    twins.read(device, 3);
    const auto data = device.data<player::PowerData>();
    EXPECT_EQ(data.valid, 31U);
    EXPECT_EQ(data.volts, single(proxy.GetCharge()));
    EXPECT_EQ(data.percent, single(proxy.GetPercent()));
    EXPECT_EQ(data.joules, single(proxy.GetJoules()));
    EXPECT_EQ(data.watts, single(proxy.GetWatts()));
    EXPECT_EQ(data.charging, proxy.GetCharging() ? 1 : 0);
    EXPECT_EQ(data.charging, port == 6666 ? 1 : 0);
  }
}

TEST(WireWifi, Links_MatchProxy) {
  Twins twins("devices/wifi.json");
  WiFiProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("wifi");
  twins.read(device, 2);
  const auto data = device.data<player::WifiData>();
  ASSERT_EQ(data.links.size(), static_cast<std::size_t>(proxy.GetLinkCount()));
  ASSERT_EQ(proxy.GetLinkCount(), 2);
  const auto text = [](const std::vector<std::uint8_t>& bytes) {
    EXPECT_EQ(bytes.back(), 0);
    return std::string(bytes.begin(), bytes.end() - 1);
  };
  for (int i = 0; i < proxy.GetLinkCount(); ++i) {
    const player::WifiLink& link = data.links[static_cast<std::size_t>(i)];
    EXPECT_EQ(text(link.mac), proxy.GetLinkMAC(i));
    EXPECT_EQ(text(link.ip), proxy.GetLinkIP(i));
    EXPECT_EQ(text(link.essid), proxy.GetLinkESSID(i));
    EXPECT_EQ(static_cast<int>(link.mode), proxy.GetLinkMode(i));
    EXPECT_EQ(link.freq, proxy.GetLinkFreq(i));
    EXPECT_EQ(static_cast<int>(link.qual), proxy.GetLinkQuality(i));
    EXPECT_EQ(static_cast<std::int32_t>(link.level), proxy.GetLinkLevel(i));
    EXPECT_EQ(static_cast<std::int32_t>(link.noise), proxy.GetLinkNoise(i));
  }
  const player::WifiLink& talker = data.links[0];
  EXPECT_EQ(text(talker.essid), "talker");
  EXPECT_EQ(talker.mode, unsigned{PLAYER_WIFI_MODE_ADHOC});
  EXPECT_EQ(talker.freq, 2437U);
  EXPECT_EQ(static_cast<std::int32_t>(talker.noise), -95);
  // At 4 m: -40 - 30 log10(4) = -58 dBm; 4 deviations of 2 dB are allowed.
  EXPECT_NEAR(static_cast<std::int32_t>(talker.level), -58, 8);
  EXPECT_EQ(text(data.links[1].essid), "hall");
  EXPECT_EQ(data.links[1].mode, unsigned{PLAYER_WIFI_MODE_MASTER});
}

// --- Acting

TEST(WirePtz, View_MatchesProxy) {
  Twins twins("devices/ptz.json");
  PtzProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("ptz");
  const auto expect_same = [&] {
    twins.read(device, 3);
    const auto data = device.data<player::PtzData>();
    EXPECT_EQ(data.pan, single(proxy.GetPan()));
    EXPECT_EQ(data.tilt, single(proxy.GetTilt()));
    EXPECT_EQ(data.zoom, single(proxy.GetZoom()));
    EXPECT_EQ(static_cast<int>(data.status), proxy.GetStatus());
    EXPECT_EQ(device.request<player::PtzReqStatus>(PLAYER_PTZ_REQ_STATUS).status, data.status);
  };
  expect_same();
  proxy.SetCam(0.5, -0.25, 0.5);
  device.command(PLAYER_PTZ_CMD_STATE, player::PtzCmd{0.5F, -0.25F, 0.5F, 0.0F, 0.0F});
  expect_same();
  EXPECT_GT(proxy.GetPan(), 0.1);
  EXPECT_TRUE(device.accepts(PLAYER_PTZ_REQ_CONTROL_MODE,
                             player::PtzReqControlMode{PLAYER_PTZ_VELOCITY_CONTROL}));
  proxy.SetSpeed(-0.25, 0.125);
  device.command(PLAYER_PTZ_CMD_STATE, player::PtzCmd{0.0F, 0.0F, 0.0F, -0.25F, 0.125F});
  expect_same();
  EXPECT_FALSE(device.accepts(PLAYER_PTZ_REQ_CONTROL_MODE, player::PtzReqControlMode{2}));
  EXPECT_TRUE(device.accepts(PLAYER_PTZ_REQ_GEOM));
  EXPECT_THROW(device.command(PLAYER_PTZ_CMD_STATE, player::PtzCmd{0, 0, 0, NAN, 0}), SessionError);
}

TEST(WireGripper, States_MatchProxyAndExpectedNumbers) {
  Twins twins("devices/gripper.json");
  GripperProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("gripper");
  const auto expect_both = [&](std::uint32_t state, std::uint32_t beams, std::uint8_t stored) {
    twins.read(device, 8);
    const auto data = device.data<player::GripperData>();
    EXPECT_EQ(data.state, state);
    EXPECT_EQ(data.beams, beams);
    EXPECT_EQ(data.stored, stored);
    EXPECT_EQ(proxy.GetState(), state);
    EXPECT_EQ(proxy.GetBeams(), beams);
    EXPECT_EQ(proxy.GetStored(), stored);
  };
  // The can reaches from 0.695 m to 0.745 m. After 0.08 m, the outer beam is at 0.587 m + 0.08 m +
  // 3/4 * 0.07 m = 0.7195 m, in the can, and the inner one at 0.6845 m, before it.
  constexpr std::uint32_t kOuterBeam = 0x04;
  const double speed_mps = 0.1;
  Position2dProxy motors(&twins.client, 0);
  motors.SetSpeed(speed_mps, 0.0);
  WireDevice wheels = twins.open("position2d");
  wheels.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{{speed_mps, 0.0, 0.0}, 1});
  expect_both(PLAYER_GRIPPER_STATE_OPEN, kOuterBeam, 0);
  motors.SetSpeed(0.0, 0.0);
  wheels.command(PLAYER_POSITION2D_CMD_VEL, player::Position2dCmdVel{});
  expect_both(PLAYER_GRIPPER_STATE_OPEN, kOuterBeam, 0);
  proxy.Close();
  device.command(PLAYER_GRIPPER_CMD_CLOSE, player::Empty{});
  expect_both(PLAYER_GRIPPER_STATE_CLOSED, kOuterBeam, 0);
  proxy.Store();
  device.command(PLAYER_GRIPPER_CMD_STORE, player::Empty{});
  expect_both(PLAYER_GRIPPER_STATE_OPEN, 0, 1);
  proxy.Retrieve();
  device.command(PLAYER_GRIPPER_CMD_RETRIEVE, player::Empty{});
  expect_both(PLAYER_GRIPPER_STATE_CLOSED, kOuterBeam, 0);
  proxy.Open();
  device.command(PLAYER_GRIPPER_CMD_OPEN, player::Empty{});
  expect_both(PLAYER_GRIPPER_STATE_OPEN, kOuterBeam, 0);
  const auto geometry = device.request<player::GripperGeom>(PLAYER_GRIPPER_REQ_GET_GEOM);
  expect_equal(proxy.GetPose(), geometry.pose);
  expect_equal(proxy.GetOuterSize(), geometry.outer_size);
  expect_equal(proxy.GetInnerSize(), geometry.inner_size);
  EXPECT_EQ(geometry.pose.px, 0.087);
  EXPECT_EQ(geometry.outer_size.sw, 0.12 + 2.0 * 0.015);
  EXPECT_EQ(geometry.outer_size.sl, 0.07);
  EXPECT_EQ(geometry.inner_size.sw, 0.12);
  EXPECT_EQ(geometry.inner_size.sh, 0.03);
  EXPECT_EQ(geometry.num_beams, 2);
  EXPECT_EQ(geometry.capacity, 2);
  EXPECT_THROW(device.command(PLAYER_GRIPPER_CMD_OPEN, player::Uint32{1}), ProtocolError);
}

TEST(WireActArray, Arm_MatchesProxy) {
  Twins twins("devices/actarray.json");
  ActArrayProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("actarray");
  const auto expect_same = [&](const char* what) {
    SCOPED_TRACE(what);
    twins.read(device, 4);
    const auto data = device.data<player::ActarrayData>();
    EXPECT_EQ(data.motor_state != 0, proxy.IsPowered());
    ASSERT_EQ(data.actuators.size(), proxy.GetCount());
    for (std::uint32_t i = 0; i < proxy.GetCount(); ++i) {
      const player_actarray_actuator_t joint = proxy.GetActuatorData(i);
      EXPECT_EQ(data.actuators[i].position, joint.position);
      EXPECT_EQ(data.actuators[i].speed, joint.speed);
      EXPECT_EQ(data.actuators[i].current, joint.current);
      EXPECT_EQ(data.actuators[i].state, joint.state);
    }
  };
  expect_same("at rest");
  proxy.MoveTo(0, 0.5F);
  device.command(PLAYER_ACTARRAY_CMD_POS, player::ActarrayPositionCmd{0, 0.5F});
  expect_same("one position");
  proxy.MoveToMulti({0.25F, 0.125F});
  // Positions of joints that do not exist have no effect.
  device.command(PLAYER_ACTARRAY_CMD_MULTI_POS,
                 player::ActarrayMultiPositionCmd{{0.25F, 0.125F, 9.0F}});
  expect_same("positions");
  proxy.SetSpeedConfig(1, 0.02F);
  EXPECT_TRUE(device.accepts(PLAYER_ACTARRAY_REQ_SPEED, player::ActarraySpeedConfig{1, 0.02F}));
  proxy.SetAccelerationConfig(0, 0.5F);
  EXPECT_TRUE(device.accepts(PLAYER_ACTARRAY_REQ_ACCEL, player::ActarrayAccelConfig{0, 0.5F}));
  proxy.MoveAtSpeed(0, -0.25F);
  device.command(PLAYER_ACTARRAY_CMD_SPEED, player::ActarraySpeedCmd{0, -0.25F});
  expect_same("one speed");
  proxy.MoveAtSpeedMulti({0.25F, 0.01F});
  device.command(PLAYER_ACTARRAY_CMD_MULTI_SPEED, player::ActarrayMultiSpeedCmd{{0.25F, 0.01F}});
  expect_same("speeds");
  proxy.SetActuatorCurrent(0, 1.0F);
  device.command(PLAYER_ACTARRAY_CMD_CURRENT, player::ActarrayCurrentCmd{0, 1.0F});
  expect_same("one current");
  proxy.SetActuatorCurrentMulti({-1.0F, 1.0F});
  device.command(PLAYER_ACTARRAY_CMD_MULTI_CURRENT, player::ActarrayMultiCurrentCmd{{-1.0F, 1.0F}});
  expect_same("currents");
  proxy.MoveHome(-1);
  device.command(PLAYER_ACTARRAY_CMD_HOME, player::ActarrayHomeCmd{-1});
  expect_same("home");
  proxy.SetBrakesConfig(true);
  EXPECT_TRUE(device.accepts(PLAYER_ACTARRAY_REQ_BRAKES, player::ActarrayBrakesConfig{1}));
  expect_same("brakes");
  proxy.SetPowerConfig(false);
  EXPECT_TRUE(device.accepts(PLAYER_ACTARRAY_REQ_POWER, player::ActarrayPowerConfig{0}));
  expect_same("off");

  const auto geometry = device.request<player::ActarrayGeom>(PLAYER_ACTARRAY_REQ_GET_GEOM);
  ASSERT_EQ(geometry.actuators.size(), 2U);
  EXPECT_EQ(geometry.base_pos.pz, proxy.GetBasePos().pz);
  EXPECT_EQ(geometry.base_orientation.pyaw, proxy.GetBaseOrientation().pyaw);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const player_actarray_actuatorgeom_t expected = proxy.GetActuatorGeom(i);
    const player::ActarrayActuatorgeom& joint = geometry.actuators[i];
    EXPECT_EQ(joint.type, expected.type);
    EXPECT_EQ(joint.length, expected.length);
    EXPECT_EQ(joint.axis.pz, expected.axis.pz);
    EXPECT_EQ(joint.min, expected.min);
    EXPECT_EQ(joint.centre, expected.centre);
    EXPECT_EQ(joint.max, expected.max);
    EXPECT_EQ(joint.home, expected.home);
    EXPECT_EQ(joint.config_speed, expected.config_speed);
    EXPECT_EQ(joint.hasbrakes, expected.hasbrakes);
  }
  constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;
  const auto& shoulder = geometry.actuators[0];
  EXPECT_EQ(shoulder.type, PLAYER_ACTARRAY_TYPE_ROTARY);
  EXPECT_EQ(shoulder.length, 0.3F);
  EXPECT_EQ(shoulder.axis.pz, 1.0);
  EXPECT_FLOAT_EQ(shoulder.min, -150 * kDegree);
  EXPECT_FLOAT_EQ(shoulder.max, 150 * kDegree);
  EXPECT_FLOAT_EQ(shoulder.home, 30 * kDegree);
  EXPECT_FLOAT_EQ(shoulder.config_speed, 45 * kDegree);
  EXPECT_EQ(shoulder.hasbrakes, 1);
  const auto& slide = geometry.actuators[1];
  EXPECT_EQ(slide.type, PLAYER_ACTARRAY_TYPE_LINEAR);
  EXPECT_EQ(slide.axis.px, 1.0);
  EXPECT_EQ(slide.centre, 0.1F);
  EXPECT_EQ(slide.max, 0.2F);
  EXPECT_EQ(slide.config_speed, 0.02F);  // as set above
  EXPECT_EQ(slide.hasbrakes, 0);
  EXPECT_THROW(device.command(PLAYER_ACTARRAY_CMD_POS, player::ActarrayPositionCmd{2, 0.0F}),
               SessionError);
  EXPECT_THROW(device.command(PLAYER_ACTARRAY_CMD_HOME, player::ActarrayHomeCmd{-2}), SessionError);
  EXPECT_THROW(static_cast<void>(
                   device.accepts(PLAYER_ACTARRAY_REQ_SPEED, player::ActarraySpeedConfig{0, 0.0F})),
               SessionError);
}

TEST(WireAio, Voltages_MatchProxy) {
  Twins twins("devices/aio.json");
  AioProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("aio");
  proxy.SetVoltage(0, 2.5);
  device.command(PLAYER_AIO_CMD_STATE, player::AioCmd{0, 2.5F});
  twins.read(device, 3);
  const auto data = device.data<player::AioData>();
  ASSERT_EQ(data.voltages.size(), proxy.GetCount());
  for (std::uint32_t i = 0; i < proxy.GetCount(); ++i) {
    EXPECT_EQ(data.voltages[i], single(proxy.GetVoltage(i)));
  }
  EXPECT_NEAR(proxy.GetVoltage(5), 2.5, 0.1);
  EXPECT_THROW(device.command(PLAYER_AIO_CMD_STATE, player::AioCmd{2, 1.0F}), SessionError);
  EXPECT_THROW(device.command(PLAYER_AIO_CMD_STATE, player::AioCmd{0, NAN}), SessionError);
  EXPECT_THROW(device.command(PLAYER_AIO_CMD_STATE, player::AioCmd{0, 1e30F}), SessionError);
}

TEST(WireDio, Bits_MatchProxy) {
  Twins twins("devices/dio.json", 6666);
  DioProxy proxy(&twins.client, 0);
  PlayerClient other(twins.embedded->connect(6665));
  const auto bell = twins.served->connect(6665);
  WireDevice device = twins.open("dio");
  DioProxy(&other, 0).SetOutput(1, 1);
  WireDevice(*bell, 6665, "dio").command(PLAYER_DIO_CMD_VALUES, player::DioCmd{32, 1});
  twins.read(device, 3);
  const auto data = device.data<player::DioData>();
  EXPECT_EQ(data.count, proxy.GetCount());
  EXPECT_EQ(data.bits, proxy.GetDigin());
  EXPECT_TRUE(proxy.GetInput(3));
}

TEST(WireBlinkenlight, Light_MatchesProxy) {
  Twins twins("devices/blinkenlight.json");
  BlinkenLightProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("blinkenlight");
  const auto expect_same = [&] {
    twins.read(device, 2);
    const auto data = device.data<player::BlinkenlightData>();
    EXPECT_EQ(data.enable != 0, proxy.GetEnable());
    EXPECT_EQ(data.period, single(proxy.GetPeriod()));
    EXPECT_EQ(data.dutycycle, single(proxy.GetDutyCycle()));
    EXPECT_EQ(data.color.red, proxy.GetRed());
    EXPECT_EQ(data.color.green, proxy.GetGreen());
    EXPECT_EQ(data.color.blue, proxy.GetBlue());
  };
  expect_same();
  proxy.SetEnable(true);
  device.command(PLAYER_BLINKENLIGHT_CMD_POWER, player::BlinkenlightCmdPower{0, 1});
  proxy.SetColor(1, 2, 3);
  device.command(PLAYER_BLINKENLIGHT_CMD_COLOR, player::BlinkenlightCmdColor{0, {0, 1, 2, 3}});
  proxy.SetPeriod(2.0);
  proxy.SetDutyCycle(0.25);
  device.command(PLAYER_BLINKENLIGHT_CMD_FLASH, player::BlinkenlightCmdFlash{0, 2.0F, 0.25F});
  expect_same();
  EXPECT_EQ(proxy.GetBlue(), 3);
  proxy.SetEnable(false);
  proxy.SetColor(9, 8, 7);
  device.command(PLAYER_BLINKENLIGHT_CMD_STATE,
                 player::BlinkenlightCmd{0, 0, 2.0F, 0.25F, {255, 9, 8, 7}});
  expect_same();
  EXPECT_THROW(
      device.command(PLAYER_BLINKENLIGHT_CMD_FLASH, player::BlinkenlightCmdFlash{0, -1.0F, 0.5F}),
      SessionError);
  EXPECT_THROW(
      device.command(PLAYER_BLINKENLIGHT_CMD_FLASH, player::BlinkenlightCmdFlash{0, 1.0F, NAN}),
      SessionError);
}

TEST(WireOpaque, Messages_Delivered) {
  Twins twins("devices/opaque.json", 6667);  // hears itself
  WireDevice device = twins.open("opaque");
  device.read();
  EXPECT_THAT(device.sent(), IsEmpty());  // no message has arrived
  device.command(PLAYER_OPAQUE_CMD_DATA, player::OpaqueData{{1, 2, 255}});
  device.read();
  EXPECT_EQ(device.data<player::OpaqueData>().data, (std::vector<std::uint8_t>{1, 2, 255}));
  EXPECT_THAT(
      device.request<player::OpaqueData>(PLAYER_OPAQUE_REQ_DATA, player::OpaqueData{{7}}).data,
      IsEmpty());
  device.read();
  EXPECT_EQ(device.data<player::OpaqueData>().data, (std::vector<std::uint8_t>{7}));
  EXPECT_THROW(device.command(PLAYER_OPAQUE_CMD_DATA,
                              player::OpaqueData{std::vector<std::uint8_t>(sim::kMaxOpaque + 1)}),
               SessionError);
}

TEST(WireSpeech, Texts_Spoken) {
  Twins twins("devices/speech.json");
  WireDevice device = twins.open("speech");
  EXPECT_THAT(device.device().sources(), IsEmpty());
  const auto said = [&](const std::string& text) {
    device.command(PLAYER_SPEECH_CMD_SAY, player::SpeechCmd{text});
    device.read();
    std::string shown;
    twins.served->with_simulation(
        [&](const sim::Simulation& simulation) { shown = simulation.snapshot().robots[0].says; });
    return shown;
  };
  EXPECT_EQ(said(player::text_bytes("he\x01llo\xff")), "he?llo?");
  EXPECT_EQ(said(std::string(1000, 'x')), std::string(sim::kMaxSpeech, 'x'));
}

// --- Drawing

TEST(WireGraphics2d, Drawings_MatchProxy) {
  Twins twins("devices/pen.json", 6666);
  WireDevice device = twins.open("graphics2d");
  Graphics2dProxy proxy(&twins.client, 0);
  player_point_2d_t points[] = {{0.5, 0.5}, {1.5, 0.7}, {1.0, 1.5}, {0.4, 1.4}};
  const std::vector<player::Point2d> same = {{0.5, 0.5}, {1.5, 0.7}, {1.0, 1.5}, {0.4, 1.4}};
  const player_color_t fill = {128, 0, 200, 0};
  const player::Color red{0, 255, 0, 0};
  const auto picture = [](playerlike::Session& session) {
    return session.request(playerlike::CanvasImageRequest{}).rgba;
  };
  const auto other = twins.embedded->connect(6665);
  const std::vector<std::uint8_t> blank = picture(*twins.session);
  const auto expect_same = [&](const char* what) {
    SCOPED_TRACE(what);
    twins.client.Read();  // the proxy's drawings are executed before the next step
    twins.session->wait();
    const std::vector<std::uint8_t> drawn = picture(*twins.session);
    EXPECT_TRUE(drawn != blank);
    EXPECT_TRUE(drawn == picture(*other));
  };
  proxy.Color(255, 0, 0, 0);
  proxy.DrawPoints(points, 4);
  device.command(PLAYER_GRAPHICS2D_CMD_POINTS, player::Graphics2dCmdPoints{same, red});
  expect_same("points");
  proxy.DrawPolyline(points, 4);
  device.command(PLAYER_GRAPHICS2D_CMD_POLYLINE, player::Graphics2dCmdPolyline{same, red});
  expect_same("polyline");
  proxy.DrawPolygon(points, 4, true, fill);
  device.command(PLAYER_GRAPHICS2D_CMD_POLYGON,
                 player::Graphics2dCmdPolygon{same, red, {128, 0, 200, 0}, 1});
  expect_same("polygon");
  proxy.Clear();
  device.command(PLAYER_GRAPHICS2D_CMD_CLEAR, player::Empty{});
  proxy.DrawMultiline(points, 4);
  device.command(PLAYER_GRAPHICS2D_CMD_MULTILINE, player::Graphics2dCmdMultiline{same, red});
  expect_same("lines");
  // A device that is opened again begins with an empty layer.
  const WireDevice again = twins.open("graphics2d");
  twins.session->wait();
  EXPECT_TRUE(picture(*twins.session) == blank);
}

TEST(WireGraphics2d, InvalidDrawings_Refused) {
  Twins twins("devices/pen.json", 6666);
  WireDevice device = twins.open("graphics2d");
  EXPECT_THROW(
      device.command(PLAYER_GRAPHICS2D_CMD_POINTS, player::Graphics2dCmdPoints{{{NAN, 0.0}}, {}}),
      SessionError);
  EXPECT_THROW(
      device.command(PLAYER_GRAPHICS2D_CMD_POLYGON,
                     player::Graphics2dCmdPolygon{std::vector<player::Point2d>(10001), {}, {}, 1}),
      SessionError);
  device.command(PLAYER_GRAPHICS2D_CMD_POLYLINE,
                 player::Graphics2dCmdPolyline{{{-1e300, 1e300}, {1e300, -1e300}}, {}});
  device.command(PLAYER_GRAPHICS2D_CMD_POLYGON, player::Graphics2dCmdPolygon{{}, {}, {}, 1});
  device.command(PLAYER_GRAPHICS2D_CMD_MULTILINE, player::Graphics2dCmdMultiline{{{1, 1}}, {}});
  EXPECT_NO_THROW(twins.session->wait());
}

// --- The world

std::vector<std::int8_t> uncompressed(const player::MapData& tile) {
  std::vector<std::int8_t> cells(static_cast<std::size_t>(tile.width) * tile.height);
  uLongf length = static_cast<uLongf>(cells.size());
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(cells.data()), &length,
                       reinterpret_cast<const Bytef*>(tile.data.data()),
                       static_cast<uLong>(tile.data.size())),
            Z_OK);
  EXPECT_EQ(length, cells.size());
  return cells;
}

TEST(WireMap, Tiles_MatchProxy) {
  Twins twins("office.json");
  MapProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("map");
  proxy.RequestMap();
  const auto info = device.request<player::MapInfo>(PLAYER_MAP_REQ_GET_INFO);
  EXPECT_EQ(info.scale, single(proxy.GetResolution()));
  EXPECT_EQ(info.width, proxy.GetWidth());
  EXPECT_EQ(info.height, proxy.GetHeight());
  EXPECT_EQ(info.origin.px, proxy.GetOriginX());
  EXPECT_EQ(info.origin.py, proxy.GetOriginY());
  ASSERT_GT(info.width, 100U);
  ASSERT_GT(info.height, 100U);
  const auto expect_tile = [&](std::uint32_t col, std::uint32_t row, std::uint32_t width,
                               std::uint32_t height) {
    const auto tile = device.request<player::MapData>(
        PLAYER_MAP_REQ_GET_DATA, player::MapData{col, row, width, height, 0, {}});
    EXPECT_EQ(tile.col, col);
    EXPECT_EQ(tile.row, row);
    EXPECT_EQ(tile.data_range, proxy.GetDataRange());
    const std::vector<std::int8_t> cells = uncompressed(tile);
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(width) * height);
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        ASSERT_EQ(cells[y * width + x],
                  proxy.GetCell(static_cast<int>(col + x), static_cast<int>(row + y)))
            << x << ' ' << y;
      }
    }
  };
  expect_tile(0, 0, info.width, info.height);
  expect_tile(10, 3, 50, 70);
  expect_tile(info.width - 1, info.height - 1, 1, 1);
  const auto refused = [&](const player::MapData& wish) {
    return !device.accepts(PLAYER_MAP_REQ_GET_DATA, wish);
  };
  EXPECT_TRUE(refused({0, 0, 0, 5, 0, {}}));
  EXPECT_TRUE(refused({info.width, 0, 1, 1, 0, {}}));
  EXPECT_TRUE(refused({1, 0, info.width, 1, 0, {}}));
  EXPECT_TRUE(refused({0, 1, 1, 0xffffffffU, 0, {}}));
  EXPECT_FALSE(device.accepts(PLAYER_MAP_REQ_GET_VECTOR));
}

TEST(WireSimulation, PosesAndProperties_ReadAndSet) {
  Twins twins("cave.json");
  WireDevice device = twins.open("simulation");
  const std::string r1 = player::text_bytes(twins.session->robots().front().name);
  SimulationProxy proxy(&twins.client, 0);
  std::string name = twins.session->robots().front().name;
  double x = 0.0;
  double y = 0.0;
  double a = 0.0;
  proxy.GetPose2d(name.data(), x, y, a);
  auto pose = device.request<player::SimulationPose2dReq>(PLAYER_SIMULATION_REQ_GET_POSE2D,
                                                          player::SimulationPose2dReq{r1, {}});
  EXPECT_EQ(pose.name, r1);
  EXPECT_EQ(pose.pose.px, x);
  EXPECT_EQ(pose.pose.py, y);
  EXPECT_EQ(pose.pose.pa, a);
  pose.pose.pa = 1.25;
  EXPECT_TRUE(device.accepts(PLAYER_SIMULATION_REQ_SET_POSE2D, pose));
  auto space = device.request<player::SimulationPose3dReq>(
      PLAYER_SIMULATION_REQ_GET_POSE3D, player::SimulationPose3dReq{r1, {}, 0.0});
  EXPECT_NEAR(space.pose.pyaw, 1.25, 1e-12);
  space.pose.pyaw = -0.5;
  EXPECT_TRUE(device.accepts(PLAYER_SIMULATION_REQ_SET_POSE3D, space));
  EXPECT_NEAR(device
                  .request<player::SimulationPose2dReq>(PLAYER_SIMULATION_REQ_GET_POSE2D,
                                                        player::SimulationPose2dReq{r1, {}})
                  .pose.pa,
              -0.5, 1e-12);

  const std::string color = player::text_bytes("_mp_color");
  const float shares[] = {0.0F, 1.0F, 0.0F, 1.0F};
  std::string value(sizeof shares, '\0');
  std::memcpy(value.data(), shares, sizeof shares);
  EXPECT_TRUE(device.accepts(PLAYER_SIMULATION_REQ_SET_PROPERTY,
                             player::SimulationPropertyReq{r1, color, 0, value}));
  const auto property = device.request<player::SimulationPropertyReq>(
      PLAYER_SIMULATION_REQ_GET_PROPERTY,
      player::SimulationPropertyReq{r1, color, 0, std::string(sizeof shares, '\0')});
  EXPECT_EQ(property.value, value);
  EXPECT_EQ(property.prop, color);

  EXPECT_THROW(static_cast<void>(
                   device.accepts(PLAYER_SIMULATION_REQ_GET_POSE2D,
                                  player::SimulationPose2dReq{player::text_bytes("nobody"), {}})),
               SessionError);
  EXPECT_THROW(static_cast<void>(
                   device.accepts(PLAYER_SIMULATION_REQ_GET_POSE2D,
                                  player::SimulationPose2dReq{player::text_bytes("\x1b[2J"), {}})),
               SessionError);
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_SIMULATION_REQ_SET_POSE2D,
                                                player::SimulationPose2dReq{r1, {NAN, 0, 0}})),
               SessionError);
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_SIMULATION_REQ_GET_PROPERTY,
                                                player::SimulationPropertyReq{r1, color, 0, ""})),
               SessionError);
}

TEST(WireBlackboard, SubscribedChanges_Reported) {
  const auto host = Host::create(world("cave.json"));
  const auto session = host->connect(6665);
  WireDevice device(*session, 6665, "blackboard");
  const auto entry = [](const std::string& key, const std::string& group,
                        std::vector<std::uint8_t> data = {}) {
    return player::BlackboardEntry{
        player::text_bytes(key), player::text_bytes(group), 1, 2, std::move(data), 0, 0};
  };
  using Entry = player::BlackboardEntry;
  // Player's answer for an entry that was never set has no key; that of a subscription has one.
  EXPECT_EQ(device.request<Entry>(PLAYER_BLACKBOARD_REQ_GET_ENTRY, entry("k", "g")).key,
            player::text_bytes(""));
  EXPECT_EQ(device.request<Entry>(PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_KEY, entry("k", "g")).key,
            player::text_bytes("k"));
  device.read();
  EXPECT_THAT(device.sent(), IsEmpty());
  EXPECT_TRUE(device.accepts(PLAYER_BLACKBOARD_REQ_SET_ENTRY, entry("k", "g", {42, 0, 0, 0})));
  EXPECT_TRUE(device.accepts(PLAYER_BLACKBOARD_REQ_SET_ENTRY, entry("other", "g", {1})));
  device.read();
  ASSERT_THAT(device.sent(), SizeIs(1));
  const auto changed = device.data<Entry>(PLAYER_BLACKBOARD_DATA_UPDATE);
  EXPECT_EQ(changed.key, player::text_bytes("k"));
  EXPECT_EQ(changed.group, player::text_bytes("g"));
  EXPECT_EQ(changed.type, 1);
  EXPECT_EQ(changed.subtype, 2);
  EXPECT_EQ(changed.data, (std::vector<std::uint8_t>{42, 0, 0, 0}));
  device.read();
  EXPECT_THAT(device.sent(), IsEmpty());
  EXPECT_TRUE(device.accepts(PLAYER_BLACKBOARD_REQ_UNSUBSCRIBE_FROM_KEY, entry("k", "g")));
  EXPECT_TRUE(device.accepts(PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_GROUP, entry("", "g")));
  device.read();
  EXPECT_THAT(device.sent(), SizeIs(2));  // the entries that the group has
  EXPECT_TRUE(device.accepts(PLAYER_BLACKBOARD_REQ_UNSUBSCRIBE_FROM_GROUP, entry("", "g")));
  EXPECT_TRUE(device.accepts(PLAYER_BLACKBOARD_REQ_SET_ENTRY, entry("k", "g", {7})));
  device.read();
  EXPECT_THAT(device.sent(), IsEmpty());
  EXPECT_EQ(device.request<Entry>(PLAYER_BLACKBOARD_REQ_GET_ENTRY, entry("k", "g")).data,
            (std::vector<std::uint8_t>{7}));
  EXPECT_THROW(static_cast<void>(device.accepts(PLAYER_BLACKBOARD_REQ_SET_ENTRY, entry("", "g"))),
               SessionError);
  EXPECT_THROW(
      static_cast<void>(device.accepts(PLAYER_BLACKBOARD_REQ_SET_ENTRY, entry("a\nb", "g"))),
      SessionError);
}

TEST(WireLog, Log_WrittenAndReplayed) {
  const test_support::TemporaryFolder folder;
  playerlike::RunSettings settings;
  settings.output_folder = folder.path().string();
  const auto host = Host::create(world("cave.json"), settings);
  const auto session = host->connect(6665);
  WireDevice device(*session, 6665, "log");
  const auto state = [&] { return device.request<player::LogGetState>(PLAYER_LOG_REQ_GET_STATE); };
  EXPECT_EQ(state().type, PLAYER_LOG_TYPE_WRITE);
  EXPECT_EQ(state().state, 0);
  EXPECT_TRUE(device.accepts(PLAYER_LOG_REQ_SET_FILENAME, player::LogSetFilename{"x.jsonl"}));
  EXPECT_TRUE(device.accepts(PLAYER_LOG_REQ_SET_WRITE_STATE, player::LogSetWriteState{1}));
  EXPECT_EQ(state().state, 1);
  device.read(3);
  EXPECT_TRUE(device.accepts(PLAYER_LOG_REQ_SET_WRITE_STATE, player::LogSetWriteState{0}));
  EXPECT_TRUE(device.accepts(PLAYER_LOG_REQ_SET_READ_STATE, player::LogSetReadState{1}));
  EXPECT_EQ(state().type, PLAYER_LOG_TYPE_READ);
  EXPECT_TRUE(device.accepts(PLAYER_LOG_REQ_SET_READ_REWIND));
  EXPECT_THROW(static_cast<void>(
                   device.accepts(PLAYER_LOG_REQ_SET_FILENAME, player::LogSetFilename{"../x"})),
               SessionError);
}

// --- All interfaces

TEST(WireDevices, AllInterfaces_Offered) {
  std::vector<std::string> worlds;
  for (const std::string_view name : playerlike::interface_names()) {
    const auto host = Host::create(world(playerlike::example_world(name)));
    bool found = false;
    for (const playerlike::RobotInfo& robot : host->robots()) {
      for (const auto& address : playerlike::list_interfaces(host->robots(), robot.port)) {
        if (address.interface != name) continue;
        const auto session = host->connect(robot.port);
        EXPECT_NE(wire::make_player_device(*session, robot.port, name, address.index), nullptr)
            << name;
        found = true;
      }
    }
    EXPECT_TRUE(found) << name;
  }
  const auto host = Host::create(world("cave.json"));
  const auto session = host->connect(6665);
  EXPECT_EQ(wire::make_player_device(*session, 6665, "nonsense", 0), nullptr);
  EXPECT_THROW(static_cast<void>(wire::make_player_device(*session, 6665, "laser", 9)),
               SessionError);
  EXPECT_THROW(static_cast<void>(wire::make_player_device(*session, 6665, "audio", 0)),
               SessionError);
}

TEST(WireDevices, PropertiesAndCapabilities_MatchProxies) {
  Twins twins("cave.json");
  LaserProxy proxy(&twins.client, 0);
  WireDevice device = twins.open("laser");
  char key[] = "beams";
  std::int32_t count = 0;
  ASSERT_EQ(proxy.GetIntProp(key, &count), 0);
  const std::string beams = player::text_bytes(key);
  EXPECT_EQ(device.request<player::IntpropReq>(PLAYER_GET_INTPROP_REQ, player::IntpropReq{beams, 0})
                .value,
            count);
  EXPECT_EQ(
      device.request<player::DblpropReq>(PLAYER_GET_DBLPROP_REQ, player::DblpropReq{beams, 0.0})
          .value,
      count);
  EXPECT_FALSE(device.accepts(PLAYER_GET_BOOLPROP_REQ, player::BoolpropReq{beams, 0}));
  EXPECT_FALSE(device.accepts(PLAYER_GET_STRPROP_REQ, player::StrpropReq{beams, ""}));
  // Texts.
  const auto text = [&](const char* name) {
    return player::text_of(
        device
            .request<player::StrpropReq>(
                PLAYER_GET_STRPROP_REQ, player::StrpropReq{player::text_bytes(name), std::string()})
            .value);
  };
  EXPECT_EQ(text("type"), "laser");
  EXPECT_EQ(text("name"), "laser");
  EXPECT_EQ(text("robot"), "pioneer1");
  // None can be set; the server's log says why.
  const auto why = [&](int subtype, const auto& payload) {
    try {
      return std::string(device.accepts(subtype, payload) ? "accepted" : "refused");
    } catch (const SessionError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_THAT(why(PLAYER_SET_INTPROP_REQ, player::IntpropReq{beams, 5}),
              HasSubstr("\"beams\" cannot be set"));
  EXPECT_THAT(why(PLAYER_SET_STRPROP_REQ, player::StrpropReq{std::string(10'000'000, '\n'), "x"}),
              HasSubstr("\"?\" cannot be set"));
  EXPECT_FALSE(device.accepts(PLAYER_GET_INTPROP_REQ,
                              player::IntpropReq{player::text_bytes("resolution"), 0}));
  EXPECT_FALSE(device.accepts(PLAYER_GET_DBLPROP_REQ,
                              player::DblpropReq{player::text_bytes("no such"), 0.0}));
  for (std::uint32_t type = 0; type < 8; ++type) {
    for (std::uint32_t subtype = 0; subtype < 256; ++subtype) {
      EXPECT_EQ(device.accepts(PLAYER_CAPABILITIES_REQ, player::CapabilitiesReq{type, subtype}),
                proxy.HasCapability(type, subtype) != 0);
    }
  }
  WireDevice map = twins.open("map");
  EXPECT_FALSE(map.accepts(PLAYER_GET_INTPROP_REQ, player::IntpropReq{beams, 0}));
}

// Nothing but ProtocolError and SessionError leaves a device, whatever a client sends.
TEST(WireDevices, InvalidPayloads_Refused) {
  const std::string zeros(200, '\0');
  const std::string huge = std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8) + zeros;
  std::vector<std::string> payloads = {"",    "abc", std::string(4, '\0'), std::string(400, '\xff'),
                                       zeros, huge,  zeros.substr(0, 24)};
  for (int size = 4; size <= 80; size += 4) payloads.emplace_back(size, '\x7f');
  int refused = 0;
  for (std::string_view name : playerlike::interface_names()) {
    const auto host = Host::create(world(playerlike::example_world(name)));
    for (const playerlike::RobotInfo& robot : host->robots()) {
      const auto session = host->connect(robot.port);
      for (const auto& address : playerlike::list_interfaces(host->robots(), robot.port)) {
        if (address.interface != name && !address.robot.empty()) continue;
        const auto device =
            wire::make_player_device(*session, robot.port, address.interface, address.index);
        for (int subtype = 0; subtype < 256; subtype += subtype < 16 ? 1 : 30) {
          for (const std::string& payload : payloads) {
            try {
              device->command(static_cast<std::uint8_t>(subtype), payload);
            } catch (const ProtocolError&) {
              ++refused;
            } catch (const SessionError&) {
              ++refused;
            }
            try {
              static_cast<void>(device->request(static_cast<std::uint8_t>(subtype), payload));
            } catch (const ProtocolError&) {
              ++refused;
            } catch (const SessionError&) {
              ++refused;
            }
          }
        }
      }
      session->wait();
      break;  // the first robot will do
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
