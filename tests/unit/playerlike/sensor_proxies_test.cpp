// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Player's proxies of rangers, bumpers, batteries, fiducials, gps, imu and wifi, over a host in
// this process, by function calls and by messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "playerlike/host/host.h"
#include "reachable_host.h"
#include "sim/core/error.h"
#include "sim/devices/wifi.h"

namespace {

using PlayerCc::BlobfinderProxy;
using PlayerCc::BumperProxy;
using PlayerCc::CameraProxy;
using PlayerCc::FiducialProxy;
using PlayerCc::GpsProxy;
using PlayerCc::ImuProxy;
using PlayerCc::IrProxy;
using PlayerCc::LaserProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using PlayerCc::Position2dProxy;
using PlayerCc::PowerProxy;
using PlayerCc::PtzProxy;
using PlayerCc::RangerProxy;
using PlayerCc::SonarProxy;
using PlayerCc::WiFiProxy;
using playerlike::Host;
using test::error_code_of;
using test::ReachableHost;
using test::Transport;
using testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;

// A room of 4 x 4 m with a marked block in the middle of its right part. The robot stands in the
// middle of the left part and faces the block.
std::string room(const std::string& devices, const std::string& more = "") {
  return R"({"arena": {"size": [4, 4],
               "obstacles": [{"center": [3, 2], "size": [0.4, 0.4], "fiducial": 7,
                              "colour": "#ff8000"}],
               "docks": [{"pose": {"x": 1, "y": 2}}]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}, "devices": )" +
         devices + more + R"(},
               {"name": "r2", "pose": {"x": 1, "y": 3}, "devices": {"wifi": {}}}]})";
}

struct SensorProxies : testing::TestWithParam<Transport> {
  std::shared_ptr<PlayerClient> open(const std::string& text) {
    host = std::make_unique<ReachableHost>(Host::create(sim::load_world_text(text)), GetParam());
    return std::make_shared<PlayerClient>(host->connect(6665));
  }
  std::unique_ptr<ReachableHost> host;
};

INSTANTIATE_TEST_SUITE_P(Transports, SensorProxies,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

// Prints a proxy as programs do, and returns the number of lines.
template <typename Proxy>
std::string printed(const Proxy& proxy) {
  std::ostringstream out;
  out << proxy;
  return out.str();
}

TEST_P(SensorProxies, Sonar_ReadsRangesInOrderOfMounts) {
  const auto client = open(room(
      R"({"sonar": {"mounts": [{"x": 0.1}, {"y": 0.05, "yaw_deg": 90}], "range_max": 5,
          "field_of_view_deg": 15, "height": 0.12}})"));
  SonarProxy sonar(client.get(), 0);
  EXPECT_EQ(sonar.GetCount(), 0U);
  EXPECT_EQ(sonar.GetScan(0), -1.0);  // as in Player
  EXPECT_EQ(sonar[3], -1.0);
  sonar.RequestGeom();
  ASSERT_EQ(sonar.GetPoseCount(), 2U);
  EXPECT_NEAR(sonar.GetPose(0).px, 0.1, 1e-12);
  EXPECT_NEAR(sonar.GetPose(1).py, 0.05, 1e-12);
  EXPECT_NEAR(sonar.GetPose(1).pz, 0.12, 1e-12);
  EXPECT_NEAR(sonar.GetPose(1).pyaw, 0.5 * kPi, 1e-12);
  client->Read();
  ASSERT_EQ(sonar.GetCount(), 2U);
  EXPECT_NEAR(sonar[0], 1.7, 1e-6);  // from 1.1 to the block's face at 2.8
  EXPECT_EQ(sonar.GetScan(0), sonar[0]);
  // r2 stands straight above, 8.1 cm nearer; its side is flat and parallel to the x axis.
  EXPECT_NEAR(sonar[1], 1.0 - 0.05 - 0.081, 1e-6);
  EXPECT_EQ(sonar[2], -1.0);
  EXPECT_TRUE(sonar.IsFresh());
  EXPECT_EQ(sonar.GetInterfaceStr(), "sonar");
  EXPECT_EQ(sonar.HasCapability(PLAYER_MSGTYPE_DATA, PLAYER_SONAR_DATA_RANGES), 1);
  EXPECT_THAT(printed(sonar), HasSubstr("1.7\n"));
}

TEST_P(SensorProxies, Ir_ReadsRangesAndVoltages) {
  const auto client =
      open(room(R"({"infrared": {"mounts": [{"x": 0.1}], "range_max": 3, "noise": 0.01}})"));
  IrProxy ir(client.get(), 0);
  EXPECT_EQ(ir.GetCount(), 0U);
  EXPECT_EQ(ir[0], 0.0);  // each reads 0 before the first reading
  EXPECT_EQ(ir.GetVoltage(9), 0.0);
  ir.RequestGeom();
  EXPECT_EQ(ir.GetPoseCount(), 1U);
  EXPECT_NEAR(ir.GetPose(0).px, 0.1, 1e-12);
  client->Read();
  ASSERT_EQ(ir.GetCount(), 1U);
  EXPECT_NEAR(ir[0], 1.7, 0.05);
  EXPECT_NE(ir[0], 1.7);
  EXPECT_NEAR(ir.GetVoltage(0), 0.336 / (ir.GetRange(0) + 0.04), 1e-12);
  EXPECT_THAT(printed(ir), HasSubstr("voltage"));
}

TEST_P(SensorProxies, LaserRanger_OneElementWithManyRanges) {
  const auto client = open(room(
      R"({"laser": {"beams": 181, "resolution_deg": 1, "range_max": 8, "pose": {"x": 0.1},
                    "size": [0.156, 0.155], "size_height": 0.21}})"));
  RangerProxy ranger(client.get());
  LaserProxy laser(client.get());
  EXPECT_EQ(ranger.GetRangeCount(), 0U);
  EXPECT_EQ(ranger[0], 0.0);
  ranger.RequestGeom();
  ranger.RequestConfigure();
  EXPECT_EQ(ranger.GetElementCount(), 1U);
  EXPECT_EQ(ranger.GetSensorCount(), 1U);
  EXPECT_NEAR(ranger.GetDevicePose().px, 0.1, 1e-12);
  EXPECT_EQ(ranger.GetElementPose(0).px, 0.0);
  for (const player_bbox3d_t& size :
       {ranger.GetDeviceSize(), ranger.GetElementSize(0), laser.GetSize()}) {
    EXPECT_NEAR(size.sl, 0.156, 1e-12);
    EXPECT_NEAR(size.sw, 0.155, 1e-12);
    EXPECT_NEAR(size.sh, 0.21, 1e-12);
  }
  EXPECT_NEAR(ranger.GetMinAngle(), -0.5 * kPi, 1e-12);
  EXPECT_NEAR(ranger.GetMaxAngle(), 0.5 * kPi, 1e-12);
  EXPECT_NEAR(ranger.GetAngularRes(), kPi / 180.0, 1e-12);
  EXPECT_EQ(ranger.GetMinRange(), 0.0);
  EXPECT_EQ(ranger.GetMaxRange(), 8.0);
  EXPECT_EQ(ranger.GetFrequency(), 10.0);
  client->Read();
  ASSERT_EQ(ranger.GetRangeCount(), 181U);
  ASSERT_EQ(laser.GetCount(), 181U);
  for (uint32_t i = 0; i < 181; ++i) EXPECT_EQ(ranger[i], laser[i]) << i;
  EXPECT_NEAR(ranger[90], 1.7, 1e-5);
  ASSERT_EQ(ranger.GetPointCount(), 181U);
  EXPECT_NEAR(ranger.GetPoint(90).px, 1.7, 1e-5);
  EXPECT_NEAR(ranger.GetPoint(0).py, -ranger[0], 1e-9);
  EXPECT_EQ(ranger.GetIntensityCount(), 0U);
  EXPECT_THAT(printed(ranger), HasSubstr("range [m]"));
}

// As a ranger of Stage states them: -fov / 2 to fov / 2, the least range, which does not change the
// ranges, and an intensity for each range: that of echoes, and 0 without one.
TEST_P(SensorProxies, Ranger_ReportsLeastRangeViewAndIntensities) {
  const auto client = open(room(
      R"({"laser": {"beams": 3, "resolution_deg": 90, "range_max": 1.8, "pose": {"x": 0.1},
                    "range_min": 1.75, "intensity": 1},
          "sonar": {"mounts": [{"x": 0.1}], "field_of_view_deg": 60, "single_ray": true,
                    "range_min": 0.5, "range_max": 1.5, "intensity": 0.5}})"));
  RangerProxy laser(client.get());
  RangerProxy sonar(client.get(), 1);
  client->Read();
  EXPECT_EQ(laser.GetMinRange(), 1.75);
  EXPECT_NEAR(laser[1], 1.7, 1e-5);
  ASSERT_EQ(laser.GetIntensityCount(), 3U);
  EXPECT_EQ(laser.GetIntensity(0), 0.0);  // the border is 2 m away
  EXPECT_EQ(laser.GetIntensity(1), 1.0);
  EXPECT_EQ(sonar.GetMinRange(), 0.5);
  EXPECT_NEAR(sonar.GetMinAngle(), -kPi / 6.0, 1e-12);
  EXPECT_NEAR(sonar.GetMaxAngle(), kPi / 6.0, 1e-12);
  ASSERT_EQ(sonar.GetIntensityCount(), 1U);
  EXPECT_EQ(sonar.GetIntensity(0), 0.0);  // the block is 1.7 m away
}

TEST_P(SensorProxies, Ranger_CroppedByConfigure) {
  const auto client = open(room(
      R"({"laser": {"beams": 181, "resolution_deg": 1, "range_max": 8, "pose": {"x": 0.1}}})"));
  RangerProxy ranger(client.get());
  client->Read();
  const double ahead = ranger[90];
  ranger.Configure(-0.5, 0.5, 2.0 * kPi / 180.0, 0.0, 1.5, 0.01, 10.0);
  // 0.5 rad is 28.6 degrees: beams at -28, -26, ... 28.
  ASSERT_EQ(ranger.GetRangeCount(), 29U);
  EXPECT_NEAR(ranger.GetMinAngle(), -28.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(ranger.GetMaxAngle(), 28.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(ranger.GetAngularRes(), 2.0 * kPi / 180.0, 1e-12);
  EXPECT_EQ(ranger.GetMaxRange(), 1.5);
  EXPECT_EQ(ranger.GetRangeRes(), 0.01);
  EXPECT_EQ(ranger[14], 1.5);                            // straight ahead, 1.7 m
  ranger.Configure(-4.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0);  // all beams again
  ASSERT_EQ(ranger.GetRangeCount(), 181U);
  EXPECT_EQ(ranger[90], ahead);
  ranger.Configure(-4.0, 4.0, 0.0, 2.0, 0.0, 0.0, 0.0);
  EXPECT_EQ(ranger[90], 2.0);                        // nearer than its declared minimum
  ranger.Configure(-0.1, 0.1, 0.0, 8.0, 0.0, 10.0);  // as in Player 2.x
  EXPECT_EQ(ranger.GetRangeCount(), 11U);
  EXPECT_EQ(error_code_of([&] { ranger.Configure(2.0, 3.0, 0.0, 0.0, 8.0, 0.0, 10.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { ranger.Configure(-1.0, 1.0, 0.0, -1.0, 8.0, 0.0, 10.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { ranger.Configure(-1.0, NAN, 0.0, 0.0, 8.0, 0.0, 10.0); }),
            PlayerError::kBadArgument);
}

TEST_P(SensorProxies, Configure_SettingsApplyAtOnce) {
  const auto client = open(room(R"({"laser": {"beams": 181, "resolution_deg": 1}})"));
  RangerProxy ranger(client.get());
  LaserProxy laser(client.get());
  EXPECT_EQ(ranger.GetRangeRes(), 0.001);
  EXPECT_EQ(laser.GetRangeRes(), 0.001);
  // Configure() sets them before the first Read() and without a request for the settings.
  ranger.Configure(-0.5, 0.5, 2.0 * kPi / 180.0, 0.1, 1.5, 0.01, 10.0);
  EXPECT_EQ(ranger.GetRangeRes(), 0.01);
  EXPECT_EQ(ranger.GetMinRange(), 0.1);
  EXPECT_EQ(ranger.GetMaxRange(), 1.5);
  EXPECT_NEAR(ranger.GetMinAngle(), -28.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(ranger.GetMaxAngle(), 28.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(ranger.GetAngularRes(), 2.0 * kPi / 180.0, 1e-12);
  laser.Configure(-0.5, 0.5, 200, 10, false, 10.0);
  laser.RequestConfigure();
  EXPECT_EQ(laser.GetRangeRes(), 0.01);
  EXPECT_NEAR(laser.GetScanRes(), 2.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(laser.GetMinAngle(), -28.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(laser.GetMaxAngle(), 28.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(laser.GetConfMaxAngle(), 28.0 * kPi / 180.0, 1e-12);
}

constexpr const char* kThreeRangers =
    R"({"infrared": {}, "sonar": {"mounts": [{"x": 0.1, "yaw_deg": 30}, {"x": 0.2}]}})";

TEST_P(SensorProxies, Sonar_ShowsNewestReading) {
  const auto client = open(room(R"({"sonar": {"mounts": [{}], "range_max": 5}})"));
  SonarProxy sonar(client.get(), 0);
  Position2dProxy position(client.get(), 0);
  position.SetSpeed(0.2, 0.0);
  for (int i = 0; i < 10; ++i) {
    client->Read();
    EXPECT_NEAR(sonar[0], 2.8 - position.GetXPos(), 1e-5) << i;  // the block's face is at 2.8
  }
  EXPECT_LT(sonar[0], 1.65);  // 2 cm nearer with each reading
}

TEST_P(SensorProxies, RangerIndices_LaserSonarInfrared) {
  const auto client = open(room(kThreeRangers));
  EXPECT_EQ(RangerProxy(client.get(), 0).GetDriverName(), "laser");
  EXPECT_EQ(RangerProxy(client.get(), 1).GetDriverName(), "sonar");
  EXPECT_EQ(RangerProxy(client.get(), 2).GetDriverName(), "infrared");
  try {
    RangerProxy none(client.get(), 3);
    FAIL() << "there is a fourth ranger";
  } catch (const PlayerError& error) {
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_THAT(error.GetErrorStr(), HasSubstr("ranger:1 (r1.sonar)"));
  }
}

TEST_P(SensorProxies, RangerIndices_FollowWorld) {
  const auto client =
      open(room(kThreeRangers, R"(, "interfaces": {"ranger": ["sonar", "laser"]})"));
  RangerProxy ranger(client.get(), 0);
  EXPECT_EQ(ranger.GetDriverName(), "sonar");
  EXPECT_EQ(RangerProxy(client.get(), 1).GetDriverName(), "laser");
  EXPECT_EQ(RangerProxy(client.get(), 2).GetDriverName(), "infrared");
  EXPECT_EQ(LaserProxy(client.get(), 0).GetDriverName(), "laser");
  // An array: one element per range, with poses relative to the robot.
  EXPECT_EQ(ranger.GetElementCount(), 2U);
  EXPECT_EQ(ranger.GetDevicePose().px, 0.0);
  EXPECT_NEAR(ranger.GetElementPose(0).pyaw, kPi / 6.0, 1e-12);
  EXPECT_NEAR(ranger.GetSensorPose(1).px, 0.2, 1e-12);
  EXPECT_NEAR(ranger.GetMaxAngle(), kPi / 12.0, 1e-12);  // half the cone of 30 degrees
  client->Read();
  ASSERT_EQ(ranger.GetRangeCount(), 2U);
  EXPECT_NEAR(ranger[1], 1.6, 1e-6);
  EXPECT_NEAR(ranger.GetPoint(1).px, 1.8, 1e-6);
  EXPECT_NEAR(ranger.GetPoint(0).py, 0.5 * ranger[0], 1e-9);
  ranger.Configure(0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0);  // angles have no effect on an array
  EXPECT_EQ(ranger[1], 1.0);
}

TEST(InterfaceOrders, MissingInterface_Refused) {
  const auto issues = [](const std::string& interfaces) {
    try {
      static_cast<void>(
          Host::create(sim::load_world_text(room("{}", R"(, "interfaces": )" + interfaces))));
    } catch (const sim::ConfigError& error) {
      return error.issues().at(0).id + " " + error.issues().at(0).pointer + " " +
             error.issues().at(0).found;
    }
    return std::string("none");
  };
  EXPECT_EQ(issues(R"({"ranger": ["pen"]})"),
            "world/interface-device /robots/0/interfaces/ranger/0 \"pen\", of type pen");
  EXPECT_EQ(issues(R"({"rangers": ["laser"]})"),
            "world/interface-device /robots/0/interfaces/rangers \"rangers\"");
  EXPECT_EQ(issues(R"({"position2d": ["odometry"]})"), "none");
}

TEST_P(SensorProxies, Orders_ApplyToPositions) {
  const auto client = open(room("{}", R"(, "interfaces": {"position2d": ["odometry"]})"));
  EXPECT_EQ(Position2dProxy(client.get(), 0).GetDriverName(), "odometry");
  EXPECT_EQ(Position2dProxy(client.get(), 1).GetDriverName(), "pose");
}

TEST_P(SensorProxies, Bumper_ReportsPressedSegments) {
  const auto client = open(room(R"({"bumper": {"segments": [
      {"x": 0.087, "y": 0.03, "length": 0.06}, {"x": 0.087, "y": -0.03, "length": 0.06},
      {"x": -0.08, "yaw_deg": 180, "length": 0.1, "radius": 0.2}]}})"));
  BumperProxy bumper(client.get(), 0);
  Position2dProxy position(client.get(), 0);
  EXPECT_EQ(bumper.GetCount(), 0U);
  EXPECT_FALSE(bumper.IsAnyBumped());
  EXPECT_FALSE(bumper[0]);  // each reads 0 before the first reading
  bumper.RequestBumperConfig();
  ASSERT_EQ(bumper.GetPoseCount(), 3U);
  EXPECT_NEAR(bumper.GetPose(2).pose.px, -0.08, 1e-12);
  EXPECT_NEAR(bumper.GetPose(2).pose.pyaw, kPi, 1e-12);
  EXPECT_FLOAT_EQ(bumper.GetPose(2).length, 0.1F);
  EXPECT_FLOAT_EQ(bumper.GetPose(2).radius, 0.2F);
  client->Read();
  EXPECT_EQ(bumper.GetCount(), 3U);
  EXPECT_FALSE(bumper.IsAnyBumped());
  position.SetSpeed(0.5, 0.0);
  for (int i = 0; i < 60 && !bumper.IsAnyBumped(); ++i) client->Read();
  EXPECT_TRUE(bumper.IsAnyBumped());
  EXPECT_TRUE(bumper[0]);
  EXPECT_TRUE(bumper[1]);
  EXPECT_EQ(bumper.IsBumped(2), 0U);
  EXPECT_THAT(printed(bumper), HasSubstr("pressed"));
}

TEST_P(SensorProxies, DefaultBumper_HasSegmentPerSide) {
  const auto client = open(room(R"({"bumper": {}})"));
  BumperProxy bumper(client.get(), 0);
  ASSERT_EQ(bumper.GetPoseCount(), 8U);
  EXPECT_NEAR(bumper.GetPose(0).pose.px, 0.087, 1e-12);
  EXPECT_FLOAT_EQ(bumper.GetPose(0).length, 0.09F);
}

TEST_P(SensorProxies, Power_ReportsBattery) {
  const auto client = open(room(R"({"battery": {"initial_charge": 50, "capacity": 10}})"));
  PowerProxy power(client.get(), 0);
  Position2dProxy position(client.get(), 0);
  EXPECT_FALSE(power.IsValid());
  EXPECT_EQ(power.GetCharge(), 0.0);
  client->Read();  // in a dock
  EXPECT_TRUE(power.IsValid());
  EXPECT_TRUE(power.GetCharging());
  EXPECT_NEAR(power.GetWatts(), 40.0, 1e-3);
  EXPECT_NEAR(power.GetJoules(), 18000.0 + 4.0, 1e-6);  // half of 10 W h, and 40 W for 0.1 s
  EXPECT_NEAR(power.GetPercent(), 100.0 * 18004.0 / 36000.0, 1e-9);
  EXPECT_NEAR(power.GetCharge(), 9.0 + 3.6 * 18004.0 / 36000.0, 1e-9);
  position.SetSpeed(0.5, 0.0);
  for (int i = 0; i < 10; ++i) client->Read();
  EXPECT_FALSE(power.GetCharging());
  EXPECT_NEAR(power.GetWatts(), -10.0, 1e-3);  // 6 W at rest, 8 W for each m/s
  EXPECT_THAT(printed(power), HasSubstr("power [W]"));
}

TEST_P(SensorProxies, Fiducial_ReportsVisibleMarks) {
  const auto client =
      open(room(R"({"fiducial": {"pose": {"x": 0.1}, "noise": 1e-9, "noise_yaw_deg": 1e-9}})"));
  FiducialProxy finder(client.get(), 0);
  EXPECT_EQ(finder.GetCount(), 0U);
  EXPECT_EQ(finder[0].id, 0);
  finder.RequestGeometry();
  EXPECT_NEAR(finder.GetSensorPose().px, 0.1, 1e-12);
  EXPECT_EQ(finder.GetSensorSize().sl, 0.0);
  EXPECT_EQ(finder.GetFiducialSize().sl, 0.0);
  client->Read();
  ASSERT_EQ(finder.GetCount(), 1U);
  const player_fiducial_item_t item = finder.GetFiducialItem(0);
  EXPECT_EQ(item.id, 7);
  EXPECT_NEAR(item.pose.px, 1.9, 1e-6);
  EXPECT_NEAR(item.pose.py, 0.0, 1e-6);
  EXPECT_NEAR(item.upose.px, 1e-9, 1e-15);
  EXPECT_EQ(finder[0].id, 7);
  EXPECT_THAT(printed(finder), HasSubstr("\n7\t"));
}

TEST_P(SensorProxies, Blobfinder_ReportsVisibleBlobs) {
  const auto client = open(room(R"({"blobfinder": {"height": 0.1}})"));
  BlobfinderProxy finder(client.get(), 0);
  EXPECT_EQ(finder.GetCount(), 0U);
  EXPECT_EQ(finder[3].area, 0U);  // all are zero while there are none
  EXPECT_EQ(finder.GetWidth(), 80U);
  EXPECT_EQ(finder.GetHeight(), 60U);
  client->Read();
  ASSERT_EQ(finder.GetCount(), 1U);
  const playerc_blobfinder_blob_t blob = finder.GetBlob(0);
  EXPECT_EQ(blob.color, 0xff8000U);
  // A face 1.8 m away, 0.4 m wide, 0.16 m high; f = 69.28: columns 40 -+ 7.70, rows from 30 - 2.31
  // to 30 + 3.85.
  EXPECT_EQ(blob.left, 32U);
  EXPECT_EQ(blob.right, 47U);
  EXPECT_EQ(blob.top, 28U);
  EXPECT_EQ(blob.bottom, 33U);
  EXPECT_EQ(blob.area, 16U * 6U);
  EXPECT_EQ(blob.x, 40U);
  EXPECT_EQ(blob.y, 31U);
  EXPECT_NEAR(blob.range, 1.8, 0.01);
  EXPECT_EQ(finder[0].area, blob.area);
  EXPECT_EQ(finder.GetInterfaceStr(), "blobfinder");
  EXPECT_EQ(finder.HasCapability(PLAYER_MSGTYPE_DATA, PLAYER_BLOBFINDER_DATA_BLOBS), 1);
  EXPECT_THAT(printed(finder), HasSubstr("\n#ff8000\t96\t40\t31\t32\t47\t28\t33\t1.8"));
}

TEST_P(SensorProxies, Ptz_TurnsMountedDevice) {
  const auto client = open(room(R"({"ptz": {}, "blobfinder": {"height": 0.1, "ptz": "ptz"}})"));
  PtzProxy head(client.get(), 0);
  BlobfinderProxy finder(client.get(), 0);
  EXPECT_NEAR(head.GetZoom(), kPi / 3.0, 1e-9);
  head.SelectControlMode(PLAYER_PTZ_VELOCITY_CONTROL);
  EXPECT_EQ(error_code_of([&] { head.SelectControlMode(2); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { head.SetCam(std::nan(""), 0.0, 0.0); }), PlayerError::kBadArgument);
  head.SetCam(0.2, 0.1, kPi / 6.0);
  client->Read();
  // After 0.1 s, at 80, 50 and 30 degrees per second.
  EXPECT_NEAR(head.GetPan(), 8.0 * kPi / 180.0, 1e-6);
  EXPECT_NEAR(head.GetTilt(), 5.0 * kPi / 180.0, 1e-6);
  EXPECT_NEAR(head.GetZoom(), 57.0 * kPi / 180.0, 1e-6);
  EXPECT_EQ(head.GetStatus(), 1);
  for (int i = 0; i < 12; ++i) client->Read();
  EXPECT_EQ(head.GetPan(), 0.2);
  EXPECT_EQ(head.GetTilt(), 0.1);
  EXPECT_NEAR(head.GetZoom(), kPi / 6.0, 1e-12);
  EXPECT_EQ(head.GetStatus(), 0);
  // f = 40 / tan 15 = 149.28. The left end of the face, at atan(0.2 / 1.8) = 0.1107, is at 40 + f
  // tan(0.2 - 0.1107) = 53.4; the right end is outside the picture.
  ASSERT_EQ(finder.GetCount(), 1U);
  EXPECT_EQ(finder[0].left, 53U);
  EXPECT_EQ(finder[0].right, 79U);
  head.SetSpeed(0.5);
  client->Read();
  EXPECT_NEAR(head.GetPan(), 0.25, 1e-9);
  EXPECT_NEAR(head.GetZoom(), kPi / 6.0, 1e-12);
  EXPECT_EQ(head.GetInterfaceStr(), "ptz");
  EXPECT_THAT(printed(head), HasSubstr("\n0.25\t"));
}

TEST_P(SensorProxies, Camera_DeliversPictures) {
  const auto client = open(room(R"({"camera": {"height": 0.1, "image": [80, 40]}})"));
  CameraProxy camera(client.get(), 0);
  EXPECT_EQ(camera.GetWidth(), 80U);
  EXPECT_EQ(camera.GetHeight(), 40U);
  EXPECT_EQ(camera.GetDepth(), 24U);
  EXPECT_EQ(camera.GetFormat(), static_cast<uint32_t>(PLAYER_CAMERA_FORMAT_RGB888));
  EXPECT_EQ(camera.GetCompression(), static_cast<uint32_t>(PLAYER_CAMERA_COMPRESS_RAW));
  ASSERT_EQ(camera.GetImageSize(), 80U * 40U * 3U);
  std::vector<uint8_t> image(camera.GetImageSize(), 1);
  camera.GetImage(image.data());
  EXPECT_EQ(image[0], 0);  // black
  client->Read();
  camera.Decompress();
  camera.GetImage(image.data());
  EXPECT_EQ(error_code_of([&] { camera.GetImage(nullptr); }), PlayerError::kBadArgument);
  // The face 1.8 m away: 1 - 0.6 * 1.8 / 12 = 0.91 of (255, 128, 0).
  const std::size_t middle = 3 * (20 * 80 + 40);
  EXPECT_EQ(image[middle], 232);
  EXPECT_EQ(image[middle + 1], 116);
  EXPECT_EQ(image[middle + 2], 0);

  const std::string prefix = testing::TempDir() + "camera_" + transport_name(GetParam()) + "_";
  camera.SaveFrame(prefix);
  camera.SaveFrame(prefix, 2);
  for (const std::string& name : {prefix + "0000.ppm", prefix + "01.ppm"}) {
    std::ifstream file(name, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    EXPECT_EQ(content.str(), "P6\n80 40\n255\n" + std::string(image.begin(), image.end())) << name;
    std::remove(name.c_str());
  }
  EXPECT_EQ(error_code_of([&] { camera.SaveFrame("/no/such/folder/x"); }), PlayerError::kFailed);
  EXPECT_EQ(camera.GetInterfaceStr(), "camera");
  EXPECT_THAT(printed(camera), HasSubstr("\n80\t40\t24\t5\t0\t9600\n"));
}

TEST_P(SensorProxies, Gps_ReportsPosition) {
  const auto client = open(room(R"({"gps": {"noise_vertical": 1e-9, "satellites": 6}})"));
  GpsProxy gps(client.get(), 0);
  Position2dProxy position(client.get(), 0);
  EXPECT_EQ(gps.GetLatitude(), 0.0);
  EXPECT_EQ(gps.GetQuality(), 0U);
  position.SetSpeed(0.5, 0.0);
  client->Read();
  // 2 m north: 2 / 6 377 000 m, in degrees; 1.05 m east: 1.05 / (6 391 000 m cos 50.08).
  EXPECT_NEAR(gps.GetLatitude(), 50.0764 + 2.0 / 6372970.0 * 180.0 / kPi, 1e-7);
  EXPECT_NEAR(gps.GetLongitude(), 14.4178 + 1.05 / 4102000.0 * 180.0 / kPi, 1e-7);
  EXPECT_NEAR(gps.GetAltitude(), 200.0, 1e-7);
  EXPECT_NEAR(gps.GetSpeed(), 0.5, 1e-9);
  EXPECT_NEAR(gps.GetCourse(), 0.5 * kPi, 1e-9);
  EXPECT_EQ(gps.GetSatellites(), 6U);
  EXPECT_EQ(gps.GetQuality(), 1U);
  EXPECT_EQ(gps.GetHdop(), 1.0);
  EXPECT_EQ(gps.GetVdop(), 1.0);
  EXPECT_NEAR(gps.GetUtmEasting(), 458'300.0, 300.0);
  EXPECT_NEAR(gps.GetUtmNorthing(), 5'547'300.0, 500.0);
  EXPECT_NEAR(gps.GetTime(), 0.1, 1e-12);
  EXPECT_EQ(gps.GetErrHorizontal(), 0.0);
  EXPECT_EQ(gps.GetErrVertical(), 1e-9);
  EXPECT_THAT(printed(gps), HasSubstr("50.0764"));
}

TEST_P(SensorProxies, Imu_ReportsMotionAndOrientation) {
  const auto client = open(room(R"({"imu": {}})"));
  ImuProxy imu(client.get(), 0);
  Position2dProxy position(client.get(), 0);
  EXPECT_EQ(imu.GetZAccel(), 0.0F);
  position.SetSpeed(0.2, 0.5);
  for (int i = 0; i < 5; ++i) client->Read();
  EXPECT_FLOAT_EQ(imu.GetYAccel(), 0.1F);
  EXPECT_FLOAT_EQ(imu.GetZAccel(), 9.80665F);
  EXPECT_FLOAT_EQ(imu.GetZGyro(), 0.5F);
  EXPECT_EQ(imu.GetXGyro(), 0.0F);
  EXPECT_EQ(imu.GetYGyro(), 0.0F);
  EXPECT_NEAR(imu.GetXAccel(), 0.0F, 1e-6F);
  EXPECT_NEAR(imu.GetXMagn(), 20.0 * std::sin(0.25), 1e-5);  // north is 90 degrees minus the yaw
  EXPECT_NEAR(imu.GetYMagn(), 20.0 * std::cos(0.25), 1e-5);
  EXPECT_FLOAT_EQ(imu.GetZMagn(), -45.0F);
  EXPECT_EQ(imu.GetRawValues().gyro_z, imu.GetZGyro());
  EXPECT_NEAR(imu.GetPose().pyaw, 0.25, 1e-9);
  // The reset affects the device, so another client gets the same values.
  imu.ResetOrientation(0);
  PlayerClient second(host->connect(6665));
  ImuProxy same(&second, 0);
  const auto read_both = [&] {
    std::thread other([&] { second.Read(); });
    client->Read();
    other.join();
  };
  read_both();
  EXPECT_NEAR(imu.GetPose().pyaw, 0.05, 1e-9);
  EXPECT_EQ(same.GetPose().pyaw, imu.GetPose().pyaw);
  imu.ResetEuler(0.0F, 0.0F, 1.0F);
  read_both();
  EXPECT_NEAR(imu.GetPose().pyaw, 1.05, 1e-9);
  EXPECT_EQ(same.GetPose().pyaw, imu.GetPose().pyaw);
  imu.SetDatatype(PLAYER_IMU_DATA_EULER);
  EXPECT_EQ(error_code_of([&] { imu.SetDatatype(6); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { imu.ResetEuler(0.0F, 0.0F, NAN); }), PlayerError::kBadArgument);
  EXPECT_THAT(printed(imu), HasSubstr("9.80665"));
}

TEST_P(SensorProxies, MorseClasses_MatchPlayerProxies) {
  const auto client = open(room(R"({"gps": {}, "imu": {}})"));
  GpsProxy gps(client.get(), 0);
  ImuProxy imu(client.get(), 0);
  CCMorse::MorseClient morse(host->connect(4000));
  CCMorse::MorseGps morse_gps(morse.GetRobot("r1"));
  CCMorse::MorseImu morse_imu(morse.GetRobot("r1"));
  EXPECT_FALSE(morse_gps.HasFix());
  EXPECT_EQ(morse_gps.GetLatitude(), 0.0);
  EXPECT_EQ(morse_imu.GetLinearAcceleration()[2], 0.0);
  client->Read();
  morse.Read();
  EXPECT_TRUE(morse_gps.HasFix());
  EXPECT_DOUBLE_EQ(morse_gps.GetLatitude(), gps.GetLatitude());
  EXPECT_DOUBLE_EQ(morse_gps.GetLongitude(), gps.GetLongitude());
  EXPECT_EQ(morse_gps.GetAltitude(), 200.0);
  EXPECT_EQ(morse_gps.GetVelocity(), 0.0);
  EXPECT_EQ(morse_gps.GetHeading(), 0.0);
  EXPECT_EQ(morse_imu.GetLinearAcceleration()[2], 9.80665);
  EXPECT_EQ(morse_imu.GetAngularVelocity()[2], 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(morse_imu.GetMagneticField()[1]), imu.GetYMagn());
  EXPECT_EQ(morse_imu.GetYaw(), imu.GetPose().pyaw);
}

TEST_P(SensorProxies, Wifi_ReportsLinks) {
  const auto client =
      open(room(R"({"wifi": {"access_points": [{"name": "hall", "x": 1, "y": 2.5}]}})"));
  WiFiProxy wifi(client.get(), 0);
  EXPECT_EQ(wifi.GetLinkCount(), 0);
  EXPECT_EQ(wifi.GetLink(0), nullptr);
  EXPECT_STREQ(wifi.GetOwnIP(), "");
  client->Read();
  ASSERT_EQ(wifi.GetLinkCount(), 2);
  EXPECT_STREQ(wifi.GetOwnIP(), "10.0.0.1");
  EXPECT_STREQ(wifi.GetLinkESSID(0), "r2");
  EXPECT_STREQ(wifi.GetLinkIP(0), "10.0.0.2");
  EXPECT_EQ(wifi.GetLinkMAC(0), sim::mac_of("r2"));
  EXPECT_EQ(wifi.GetLinkMode(0), PLAYER_WIFI_MODE_ADHOC);
  EXPECT_EQ(wifi.GetLinkEncrypt(0), 0);
  EXPECT_EQ(wifi.GetLinkLevel(0), -40);  // 1 m
  EXPECT_EQ(wifi.GetLinkQuality(0), 100);
  EXPECT_EQ(wifi.GetLinkNoise(0), -95);
  EXPECT_EQ(wifi.GetLinkFreq(0), 2437.0);
  EXPECT_STREQ(wifi.GetLinkESSID(1), "hall");
  EXPECT_EQ(wifi.GetLinkMode(1), PLAYER_WIFI_MODE_MASTER);
  EXPECT_EQ(wifi.GetLinkLevel(1), -31);  // -40 + 30 log10(2)
  ASSERT_NE(wifi.GetLink(1), nullptr);
  EXPECT_EQ(wifi.GetLink(1)->level, -31);
  EXPECT_EQ(wifi.GetLink(2), nullptr);
  EXPECT_EQ(wifi.GetLink(-1), nullptr);
  EXPECT_THAT(printed(wifi), HasSubstr("hall\t10.1.0.1\t-31"));
}

TEST_P(SensorProxies, MissingDevice_ErrorListsExisting) {
  const auto client = open(room("{}"));
  try {
    SonarProxy sonar(client.get(), 0);
    FAIL() << "there is a sonar";
  } catch (const PlayerError& error) {
    EXPECT_EQ(error.GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_THAT(error.GetErrorStr(), HasSubstr("there is no device sonar:0 on port 6665"));
  }
}

}  // namespace
