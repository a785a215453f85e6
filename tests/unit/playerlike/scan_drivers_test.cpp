// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The world's drivers lasercspace and laserposeinterpolator, and those that change nothing:
// lasertoranger, rangertolaser and localbb.
#include "session/scan_drivers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "patient_host.h"
#include "protocol/player_structs.h"
#include "protocol/player_xdr.h"
#include "reachable_host.h"
#include "sim/core/error.h"
#include "wire/player_device.h"

namespace playerlike {
namespace {

using PlayerCc::LaserProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using PlayerCc::Position2dProxy;
using test::ReachableHost;
using test::Transport;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

sim::LaserReading scan_of(std::vector<double> ranges_m, double angle_min_rad,
                          double resolution_rad) {
  sim::LaserReading scan;
  scan.ranges_m = std::move(ranges_m);
  scan.angle_min_rad = angle_min_rad;
  scan.resolution_rad = resolution_rad;
  scan.range_max_m = 8.0;
  return scan;
}

// Three beams at -30, 0 and 30 degrees. The middle one is the shortest, so its end is the obstacle
// of the other two: it lies 2 cos 30 = 1.732 m along them and 2 sin 30 = 1 m beside them.
TEST(ConfigurationSpace, BeamEndsWhereDiscTouchesEndpoint) {
  const auto scan = scan_of({5.0, 2.0, 5.0}, -30 * kDegree, 30 * kDegree);
  // The disc touches when it is sqrt(1.25^2 - 1^2) = 0.75 m before the nearest point.
  const auto wide = configuration_space(scan, {1.25, 1});
  EXPECT_NEAR(wide->ranges_m[0], std::sqrt(3.0) - 0.75, 1e-12);
  EXPECT_NEAR(wide->ranges_m[1], 2.0 - 1.25, 1e-12);
  EXPECT_NEAR(wide->ranges_m[2], std::sqrt(3.0) - 0.75, 1e-12);
  // A disc of 0.9 m passes it, and is stopped by the ends of its own beam.
  const auto narrow = configuration_space(scan, {0.9, 1});
  EXPECT_NEAR(narrow->ranges_m[0], 5.0 - 0.9, 1e-12);
  EXPECT_NEAR(narrow->ranges_m[1], 2.0 - 0.9, 1e-12);
  EXPECT_EQ(narrow->angle_min_rad, scan.angle_min_rad);
  EXPECT_EQ(narrow->range_max_m, scan.range_max_m);
}

TEST(ConfigurationSpace, DiscTouchingAtStart_RangeZero) {
  const auto made = configuration_space(scan_of({0.3, 4.0}, 0.0, 90 * kDegree), {0.5, 1});
  EXPECT_EQ(made->ranges_m[0], 0.0);
  // The first end lies 0 m along the second beam and 0.3 m beside it.
  EXPECT_EQ(made->ranges_m[1], 0.0);
}

TEST(ConfigurationSpace, Step_UsesSomeBeamsOnly) {
  const auto scan = scan_of({5.0, 2.0, 5.0}, -30 * kDegree, 30 * kDegree);
  const auto made = configuration_space(scan, {1.25, 2});  // the ends of beams 0 and 2
  EXPECT_NEAR(made->ranges_m[0], 5.0 - 1.25, 1e-12);
  EXPECT_NEAR(made->ranges_m[1], 2.0 - 1.25, 1e-12);  // each range is shortened by the radius
}

TEST(ConfigurationSpace, EmptyScan_Accepted) {
  EXPECT_TRUE(configuration_space({}, {})->ranges_m.empty());
}

sim::PoseReading pose_at(double time_s, const sim::Pose& pose) {
  sim::PoseReading reading;
  reading.time_ns = sim::from_seconds(time_s);
  reading.pose = pose;
  return reading;
}

TEST(ScanPoses, InterpolatedBetweenReadings) {
  ScanPoses poses(true);
  EXPECT_FALSE(poses.at(0).has_value());
  EXPECT_FALSE(poses.knows(0));
  poses.add(pose_at(1.0, {1.0, 2.0, 3.0}));
  EXPECT_TRUE(poses.knows(sim::from_seconds(1.0)));
  EXPECT_FALSE(poses.knows(sim::from_seconds(1.05)));
  EXPECT_EQ(poses.at(sim::from_seconds(0.5))->x_m, 1.0);  // the only one
  poses.add(pose_at(1.1, {2.0, 0.0, -3.0}));
  EXPECT_TRUE(poses.knows(sim::from_seconds(1.05)));
  const sim::Pose between = *poses.at(sim::from_seconds(1.025));
  EXPECT_NEAR(between.x_m, 1.25, 1e-9);
  EXPECT_NEAR(between.y_m, 1.5, 1e-9);
  // From 3 to -3 the short way: by 2 pi - 6 = 0.2832, a quarter of it.
  EXPECT_NEAR(between.yaw_rad, 3.0 + 0.25 * (2.0 * std::numbers::pi - 6.0), 1e-9);
  EXPECT_EQ(poses.at(sim::from_seconds(5.0))->x_m, 2.0);
  EXPECT_EQ(poses.at(sim::from_seconds(0.5))->x_m, 1.0);
}

TEST(ScanPoses, NoInterpolation_NewestPose) {
  ScanPoses poses(false);
  poses.add(pose_at(1.0, {1.0, 2.0, 3.0}));
  poses.add(pose_at(1.1, {2.0, 0.0, -3.0}));
  EXPECT_TRUE(poses.knows(sim::from_seconds(9.0)));
  EXPECT_EQ(poses.at(sim::from_seconds(1.025))->x_m, 2.0);
}

// Scans come 150 ms late, after a pose of their time or a later one. Every second scan is half-way
// between two poses.
std::string world(const std::string& drivers) {
  return R"({"arena": {"size": [4, 3]}, "robots": [{"name": "r1",
    "pose": {"x": 0.8, "y": 1.5},
    "devices": {"laser": {"latency": 0.15}, "pose": {"frequency": 5}, "odometry": {}},
    "drivers": )" +
         drivers + "}]}";
}
constexpr const char* kDrivers = R"([
  {"type": "lasercspace", "radius": 0.2},
  {"type": "laserposeinterpolator", "position": 0, "index": 5},
  {"type": "lasertoranger"}, {"type": "rangertolaser"}, {"type": "localbb"}])";

struct ScanDrivers : testing::TestWithParam<Transport> {};

INSTANTIATE_TEST_SUITE_P(Transports, ScanDrivers,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(ScanDrivers, Lasercspace_ShortensScanOfLaser) {
  const ReachableHost host(test::patient_host(sim::load_world_text(world(kDrivers))), GetParam());
  PlayerClient client(host.connect(6665));
  LaserProxy laser(&client, 0);
  LaserProxy cspace(&client, 1);
  EXPECT_EQ(cspace.GetDriverName(), "lasercspace");
  EXPECT_EQ(cspace.GetPose().px, laser.GetPose().px);
  for (int i = 0; i < 3; ++i) client.Read();
  ASSERT_TRUE(cspace.IsFresh());
  ASSERT_EQ(cspace.GetCount(), laser.GetCount());
  sim::LaserReading scan = scan_of({}, laser.GetMinAngle(), laser.GetScanRes());
  for (uint32_t i = 0; i < laser.GetCount(); ++i) scan.ranges_m.push_back(laser.GetRange(i));
  const auto expected = configuration_space(scan, {0.2, 1});
  for (uint32_t i = 0; i < laser.GetCount(); ++i) {
    ASSERT_NEAR(cspace.GetRange(i), expected->ranges_m[i], 1e-12) << i;
    ASSERT_LE(cspace.GetRange(i), laser.GetRange(i));
  }
  // The wall ahead is 4 - 0.8 - 0.035 m away; the disc stops 0.2 m before it.
  EXPECT_NEAR(cspace.GetRange(laser.GetCount() / 2), 4.0 - 0.835 - 0.2, 1e-3);
  cspace.Configure(-0.5, 0.5, 100, 10, false, 10.0);
  EXPECT_LT(cspace.GetCount(), laser.GetCount());
}

TEST_P(ScanDrivers, Laserposeinterpolator_GivesPoseOfScan) {
  const ReachableHost host(test::patient_host(sim::load_world_text(world(kDrivers))), GetParam());
  PlayerClient client(host.connect(6665));
  LaserProxy stamped(&client, 5);
  Position2dProxy motors(&client, 1);
  EXPECT_EQ(stamped.GetDriverName(), "laserposeinterpolator");
  motors.SetSpeed(0.2, 0.0);
  int scans = 0;
  for (int i = 0; i < 90; ++i) {
    client.Read();
    if (!stamped.IsFresh() || stamped.GetDataTime() < 2.0) continue;  // its speed is constant now
    stamped.NotFresh();
    ++scans;
    // The range to the wall ahead says where the robot was when the scan was measured.
    const double seen_x_m = 4.0 - 0.035 - stamped.GetRange(stamped.GetCount() / 2);
    ASSERT_NEAR(stamped.GetRobotPose().px, seen_x_m, 1e-3) << stamped.GetDataTime();
  }
  EXPECT_GE(scans, 8);
}

TEST_P(ScanDrivers, ProxyCopies_HavePoses) {
  const ReachableHost host(test::patient_host(sim::load_world_text(world(kDrivers))), GetParam());
  PlayerClient client(host.connect(6665));
  auto original = std::make_unique<LaserProxy>(&client, 5);
  for (int i = 0; i < 10; ++i) client.Read();
  LaserProxy copy(*original);
  original.reset();
  for (int i = 0; i < 10; ++i) client.Read();
  EXPECT_NEAR(copy.GetRobotPose().px, 0.8, 1e-9);
}

// --- Player's protocol

struct Wire final : wire::DataSink, ReadingSink {
  Wire(Session& its_session, int index)
      : session(its_session), device(wire::make_player_device(its_session, 6665, "laser", index)) {
    for (const DeviceId source : device->sources()) session.request(SubscribeRequest{source});
  }
  void read() {
    session.wait();
    subtypes.clear();
    session.take(*this);
    device->on_round(*this);
  }
  void data(std::uint8_t subtype, std::string payload) override {
    subtypes.push_back(subtype);
    last = std::move(payload);
  }
  void on_reading(DeviceId from, const sim::SharedReading& reading) override {
    device->on_reading(from, *reading, *this);
  }

  Session& session;
  std::unique_ptr<wire::PlayerDevice> device;
  std::vector<int> subtypes;
  std::string last;
};

TEST(ScanDriversOnTheWire, Laserposeinterpolator_SendsScansWithPoses) {
  const auto host = test::patient_host(sim::load_world_text(world(kDrivers)));
  const auto session = host->connect(6665);
  Wire stamped(*session, 5);
  EXPECT_EQ(stamped.device->driver(), "laserposeinterpolator");
  int count = 0;
  for (int i = 0; i < 20; ++i) {
    stamped.read();
    for (const int subtype : stamped.subtypes) EXPECT_EQ(subtype, PLAYER_LASER_DATA_SCANPOSE);
    count += static_cast<int>(stamped.subtypes.size());
  }
  EXPECT_GE(count, 5);
  const auto message = player::decode<player::LaserDataScanpose>(stamped.last);
  EXPECT_NEAR(message.pose.px, 0.8, 1e-9);
  EXPECT_NEAR(message.pose.py, 1.5, 1e-9);
  EXPECT_EQ(message.scan.ranges.size(), 682U);
}

TEST(ScanDriversOnTheWire, Lasercspace_SendsScan) {
  const auto host = test::patient_host(sim::load_world_text(world(kDrivers)));
  const auto session = host->connect(6665);
  Wire cspace(*session, 1);
  EXPECT_EQ(cspace.device->driver(), "lasercspace");
  for (int i = 0; i < 3; ++i) cspace.read();
  ASSERT_FALSE(cspace.subtypes.empty());
  EXPECT_EQ(cspace.subtypes.back(), PLAYER_LASER_DATA_SCAN);
  const auto scan = player::decode<player::LaserData>(cspace.last);
  EXPECT_NEAR(scan.ranges[341], 4.0 - 0.835 - 0.2, 1e-3);
}

// --- Entries

std::string fault(const std::string& drivers, const std::string& devices = "{}") {
  try {
    check_drivers(sim::load_world_text(
        R"({"robots": [{"devices": )" + devices + R"(, "drivers": )" + drivers + "}]}", "w.json"));
  } catch (const sim::ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(ScanDriverEntries, Checked) {
  EXPECT_EQ(fault(kDrivers), "");
  EXPECT_THAT(fault(R"([{"type": "lasercspace", "radius": 0}])"),
              AllOf(HasSubstr("world/out-of-range"), HasSubstr("/robots/0/drivers/0/radius")));
  EXPECT_THAT(fault(R"([{"type": "lasercspace", "radius_m": 0.1}])"),
              AllOf(HasSubstr("world/unknown-key"), HasSubstr("did you mean \"radius\"")));
  EXPECT_THAT(fault(R"([{"type": "lasercspace", "laser": 1}])"), HasSubstr("world/driver-device"));
  EXPECT_THAT(fault(R"([{"type": "lasercspace", "index": 0}])"), HasSubstr("world/driver-index"));
  EXPECT_THAT(fault(R"([{"type": "laserposeinterpolator", "position": 7}])"),
              HasSubstr("world/driver-device"));
  EXPECT_THAT(fault(R"([{"type": "lasertoranger"}])", R"({"laser": null})"),
              HasSubstr("a robot with a laser"));
  EXPECT_THAT(fault(R"([{"type": "localbb", "laser": 0}])"), HasSubstr("world/unknown-key"));
}

TEST(ScanDriverEntries, ConvertersWithoutEffect_AddNoDevice) {
  const auto host = test::patient_host(sim::load_world_text(
      world(R"([{"type": "lasertoranger"}, {"type": "rangertolaser"}, {"type": "localbb"}])")));
  PlayerClient client(host->connect(6665));
  PlayerCc::RangerProxy ranger(&client, 0);
  PlayerCc::BlackBoardProxy board(&client, 0);
  EXPECT_EQ(test::error_code_of([&] { LaserProxy second(&client, 1); }),
            PlayerError::kNoSuchDevice);
}

}  // namespace
}  // namespace playerlike
