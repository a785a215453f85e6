// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Clients of Player servers: proxies read what recorded servers sent, and send what recorded
// clients did.
#include "remote/player_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libplayerc++/playerc++.h"
#include "libplayerc/playerc.h"
#include "own_loopback.h"
#include "patient_host.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/server/server.h"
#include "raw_client.h"
#include "remote/socket_session.h"
#include "scripted_player_server.h"

namespace playerlike {
namespace {

using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using playpen::test::player_recording;
using test::ScriptedPlayerServer;
using test::WireMessage;
using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Script = ScriptedPlayerServer::Script;
using Key = ScriptedPlayerServer::Key;

constexpr int kIndex = 5;  // of the recordings' devices

/// A recorded server, and a client of it.
struct Recorded {
  explicit Recorded(const std::string& name)
      : recording(player_recording(name)),
        server(ScriptedPlayerServer::script_of(recording)),
        client(server.host(), 6665) {}

  /// The first report of the real client's devices with this name.
  [[nodiscard]] nlohmann::json report(const std::string& what) const {
    for (const auto& report : recording.described.at("proxy_reports")) {
      if (report.at("what") == what && report.at("v").size() > 1) return report.at("v");
    }
    return recording.described.at("proxy_reports");
  }

  playpen::test::PlayerRecording recording;
  ScriptedPlayerServer server;
  PlayerClient client;
};

/// The payloads of a client's messages to a device, by type and subtype.
std::vector<std::string> payloads(const std::vector<WireMessage>& messages, unsigned interface,
                                  unsigned type, unsigned subtype) {
  std::vector<std::string> found;
  for (const WireMessage& message : messages) {
    const player::Msghdr& header = message.header;
    if (header.addr.interf == interface && header.type == type && header.subtype == subtype) {
      found.push_back(message.payload);
    }
  }
  return found;
}

/// The client's messages of a recording.
std::vector<WireMessage> recorded_messages(const playpen::test::PlayerRecording& recording) {
  std::vector<WireMessage> messages;
  for (const auto& message : recording.described.at("messages")) {
    if (message.at("direction") != "client") continue;
    const auto parsed = player::parse_message(recording.bytes_of(message));
    messages.push_back({parsed.header, std::string(parsed.payload)});
  }
  return messages;
}

/// Waits until the server has received a message after those of the caller so far.
void settle(PlayerClient& client) {
  // Commands have no answers; the answer to this request follows them.
  client.SetReplaceRule(true);
}

/// Expects that our client's messages of this kind are byte for byte those of the recorded one.
void expect_same(Recorded& recorded, unsigned interface, unsigned type, unsigned subtype) {
  settle(recorded.client);
  const auto wanted = payloads(recorded_messages(recorded.recording), interface, type, subtype);
  EXPECT_FALSE(wanted.empty());
  EXPECT_EQ(payloads(recorded.server.received(), interface, type, subtype), wanted)
      << interface << ' ' << type << ' ' << subtype;
}

Script with_laser() {
  Script script;
  script.devices = {{0, 6665, PLAYER_LASER_CODE, 0}, {0, 6665, PLAYER_POSITION2D_CODE, 0}};
  return script;
}

player::LaserData scan() {
  player::LaserData data;
  data.min_angle = -1.0F;
  data.max_angle = 1.0F;
  data.resolution = 1.0F;
  data.max_range = 8.0F;
  data.ranges = {1.0F, 2.0F, 3.0F};
  return data;
}

template <typename Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const PlayerError& e) {
    return e.GetErrorStr();
  } catch (const SessionError& e) {
    return e.what();
  }
  return "no error";
}

// --- The beginning of a connection

TEST(PlayerSession, Greets) {
  Recorded recorded("position2d_fixture");
  {
    const PlayerCc::Position2dProxy position(&recorded.client, kIndex);
    EXPECT_EQ(position.GetDriverName(), "fixture");
  }
  expect_same(recorded, PLAYER_PLAYER_CODE, PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_REQ_DEV);
  const auto messages = recorded.server.received();
  const auto wanted = recorded_messages(recorded.recording);
  // The first message, all but its time.
  EXPECT_EQ(messages.front().payload, wanted.front().payload);
  EXPECT_EQ(messages.front().header.subtype, wanted.front().header.subtype);
  EXPECT_EQ(messages.front().header.type, wanted.front().header.type);
  EXPECT_EQ(messages.front().header.seq, 0U);
  EXPECT_EQ(messages.front().header.addr.host, 0U);
  EXPECT_EQ(messages.front().header.addr.robot, 0U);
}

// --- Readings

TEST(PlayerSession, Positions_Read) {
  Recorded recorded("position2d_fixture");
  PlayerCc::Position2dProxy position(&recorded.client, kIndex);
  recorded.client.Read();
  const auto report = recorded.report("position2d");
  EXPECT_DOUBLE_EQ(position.GetXPos(), report.at("px"));
  EXPECT_DOUBLE_EQ(position.GetYPos(), report.at("py"));
  EXPECT_DOUBLE_EQ(position.GetYaw(), report.at("pa"));
  EXPECT_DOUBLE_EQ(position.GetXSpeed(), report.at("vx"));
  EXPECT_DOUBLE_EQ(position.GetYawSpeed(), report.at("va"));
  EXPECT_FALSE(position.GetStall());
  EXPECT_DOUBLE_EQ(position.GetDataTime(), report.at("datatime"));
  EXPECT_TRUE(position.IsFresh());
  recorded.client.Read();
  EXPECT_DOUBLE_EQ(position.GetXPos(), 2.42);
  EXPECT_TRUE(position.GetStall());
  position.RequestGeom();
  EXPECT_DOUBLE_EQ(position.GetSize().sl, 0.44);
  EXPECT_DOUBLE_EQ(position.GetSize().sw, 0.38);
  EXPECT_DOUBLE_EQ(position.GetOffset().px, 1.1);
}

TEST(PlayerSession, Scans_Read) {
  Recorded recorded("laser_fixture");
  PlayerCc::LaserProxy laser(&recorded.client, kIndex);
  recorded.client.Read();
  const auto report = recorded.report("laser");
  ASSERT_EQ(laser.GetCount(), 7U);
  for (uint32_t i = 0; i < 7; ++i) EXPECT_DOUBLE_EQ(laser.GetRange(i), report.at("ranges")[i]);
  EXPECT_DOUBLE_EQ(laser.GetMinAngle(), report.at("scan_start"));
  EXPECT_DOUBLE_EQ(laser.GetMaxAngle(), 1.5);
  EXPECT_DOUBLE_EQ(laser.GetScanRes(), report.at("scan_res"));
  EXPECT_DOUBLE_EQ(laser.GetMaxRange(), report.at("max_range"));
  EXPECT_DOUBLE_EQ(laser.GetScanningFrequency(), 10.0);
  EXPECT_DOUBLE_EQ(laser.GetPose().px, 0.15000000000000002);
  EXPECT_DOUBLE_EQ(laser.GetSize().sl, 0.16);
}

TEST(PlayerSession, Intensities_Read) {
  Recorded recorded("laser_fixture");
  PlayerCc::LaserProxy laser(&recorded.client, kIndex);
  EXPECT_FALSE(laser.IntensityOn());
  recorded.client.Read();
  EXPECT_TRUE(laser.IntensityOn());
  const std::vector<int> intensities = {0, 1, 2, 3, 4, 5, 255};
  for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(laser.GetIntensity(i), intensities[i]);
  // Each second beam from -1 rad on: beams 1, 3 and 5.
  laser.Configure(-1.0, 1.0, 5730, 0, true, 10.0);
  ASSERT_EQ(laser.GetCount(), 3U);
  for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(laser.GetIntensity(i), 2 * static_cast<int>(i) + 1);
}

TEST(PlayerSession, ZeroIntensities_Ignored) {
  Script script = with_laser();
  player::LaserData data = scan();
  data.intensity = {0, 0, 0};
  script.rounds = {test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, data)};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  client.Read();
  ASSERT_EQ(laser.GetCount(), 3U);
  EXPECT_FALSE(laser.IntensityOn());
  EXPECT_EQ(laser.GetIntensity(1), 0);
}

TEST(PlayerSession, Rangers_ReadAsRings) {
  Recorded recorded("ranger_fixture");  // two elements
  PlayerCc::RangerProxy ranger(&recorded.client, kIndex);
  do {
    recorded.client.Read();
  } while (ranger.GetRangeCount() == 0);
  const std::vector<double> ranges = {1.0, 1.5, 2.0, 2.5, 8.0};
  for (uint32_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(ranger.GetRange(i), ranges[i]);
  ASSERT_EQ(ranger.GetElementCount(), 2U);
  EXPECT_DOUBLE_EQ(ranger.GetElementPose(1).px, 0.30000000000000004);
  EXPECT_DOUBLE_EQ(ranger.GetMaxRange(), 8.0);
  // They come in a message of their own.
  while (ranger.GetIntensityCount() == 0) recorded.client.Read();
  ASSERT_EQ(ranger.GetIntensityCount(), 5U);
  EXPECT_EQ(ranger.GetRangeCount(), 5U);
  for (uint32_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(ranger.GetIntensity(i), 0.25 * i);
}

TEST(PlayerSession, Rangers_ReadAsScans) {
  Recorded recorded("ranger_stage_laser");
  const auto devices = recorded.server.script.devices;
  PlayerCc::RangerProxy ranger(&recorded.client, devices.front().index);
  recorded.client.Read();
  ASSERT_EQ(ranger.GetRangeCount(), 37U);
  EXPECT_DOUBLE_EQ(ranger.GetRange(0), 3.129099349832011);
  EXPECT_DOUBLE_EQ(ranger.GetMinAngle(), -1.5707963267948966);
  EXPECT_DOUBLE_EQ(ranger.GetAngularRes(), 0.08490790955648089);
  while (ranger.GetIntensityCount() == 0) recorded.client.Read();
  ASSERT_EQ(ranger.GetIntensityCount(), 37U);
  EXPECT_DOUBLE_EQ(ranger.GetIntensity(36), 1.0);
  EXPECT_EQ(ranger.GetRangeCount(), 37U);
}

TEST(PlayerSession, SonarsAndInfrared_Read) {
  Recorded sonars("sonar_fixture");
  PlayerCc::SonarProxy sonar(&sonars.client, kIndex);
  sonars.client.Read();
  ASSERT_EQ(sonar.GetCount(), 4U);
  EXPECT_DOUBLE_EQ(sonar.GetScan(1), 2.25);
  EXPECT_GT(sonar.GetPoseCount(), 0U);

  Recorded infrared("ir");
  PlayerCc::IrProxy ir(&infrared.client, kIndex);
  infrared.client.Read();
  ASSERT_EQ(ir.GetCount(), 3U);
  EXPECT_DOUBLE_EQ(ir.GetRange(2), 0.5);
  for (uint32_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(ir.GetVoltage(i), 1.0 + i);
  EXPECT_EQ(ir.GetPoseCount(), 3U);
  EXPECT_DOUBLE_EQ(ir.GetPose(1).px, 1.1);
}

TEST(PlayerSession, GpsAndPower_Read) {
  Recorded receiver("gps");
  PlayerCc::GpsProxy gps(&receiver.client, kIndex);
  receiver.client.Read();
  const auto report = receiver.report("gps");
  EXPECT_NEAR(gps.GetLatitude(), report.at("lat"), 1e-12);
  EXPECT_NEAR(gps.GetLongitude(), report.at("lon"), 1e-12);
  EXPECT_DOUBLE_EQ(gps.GetAltitude(), report.at("alt"));
  EXPECT_NEAR(gps.GetUtmEasting(), report.at("utm_e"), 1e-9);
  EXPECT_NEAR(gps.GetUtmNorthing(), report.at("utm_n"), 1e-9);
  EXPECT_DOUBLE_EQ(gps.GetSpeed(), report.at("speed"));
  EXPECT_DOUBLE_EQ(gps.GetCourse(), report.at("course"));
  EXPECT_EQ(gps.GetSatellites(), 9U);
  EXPECT_EQ(gps.GetQuality(), 1U);
  EXPECT_DOUBLE_EQ(gps.GetErrHorizontal(), 2.5);
  EXPECT_DOUBLE_EQ(gps.GetErrVertical(), 4.5);
  EXPECT_DOUBLE_EQ(gps.GetHdop(), 1.2);
  EXPECT_DOUBLE_EQ(gps.GetVdop(), 1.5);

  Recorded battery("power");
  PlayerCc::PowerProxy power(&battery.client, kIndex);
  battery.client.Read();
  EXPECT_DOUBLE_EQ(power.GetCharge(), 12.5);
  EXPECT_DOUBLE_EQ(power.GetPercent(), 87.5);
  EXPECT_DOUBLE_EQ(power.GetJoules(), 36000.0);
  EXPECT_DOUBLE_EQ(power.GetWatts(), -24.0);
}

TEST(PlayerSession, Imus_Read) {
  Recorded recorded("imu");
  PlayerCc::ImuProxy imu(&recorded.client, kIndex);
  recorded.client.Read();
  EXPECT_DOUBLE_EQ(imu.GetPose().pyaw, 0.03);
  EXPECT_FLOAT_EQ(imu.GetZAccel(), 9.81F);
  EXPECT_FLOAT_EQ(imu.GetYGyro(), 0.02F);
  EXPECT_FLOAT_EQ(imu.GetXMagn(), 0.4F);
}

TEST(PlayerSession, Cameras_Read) {
  Recorded marks("fiducial_fixture");
  PlayerCc::FiducialProxy fiducial(&marks.client, kIndex);
  marks.client.Read();
  ASSERT_EQ(fiducial.GetCount(), 2U);
  EXPECT_EQ(fiducial.GetFiducialItem(0).id, 42);
  EXPECT_DOUBLE_EQ(fiducial.GetFiducialItem(0).pose.py, -1.2);
  EXPECT_EQ(fiducial.GetFiducialItem(1).id, -1);
  EXPECT_DOUBLE_EQ(fiducial.GetFiducialItem(1).pose.pyaw, 0.06);

  Recorded colours("blobfinder_fixture");
  PlayerCc::BlobfinderProxy blobs(&colours.client, kIndex);
  colours.client.Read();
  ASSERT_EQ(blobs.GetCount(), 2U);
  EXPECT_EQ(blobs.GetWidth(), 80U);
  EXPECT_EQ(blobs.GetBlob(1).color, 65280U);
  EXPECT_EQ(blobs.GetBlob(0).area, 120U);
  EXPECT_FLOAT_EQ(blobs.GetBlob(1).range, 1.25F);

  Recorded images("camera");
  PlayerCc::CameraProxy camera(&images.client, kIndex);
  images.client.Read();
  ASSERT_EQ(camera.GetWidth(), 4U);
  ASSERT_EQ(camera.GetHeight(), 3U);
  std::vector<uint8_t> image(camera.GetImageSize());
  camera.GetImage(image.data());
  EXPECT_EQ(image, images.report("camera").at("image").get<std::vector<uint8_t>>());
}

TEST(PlayerSession, Bodies_Read) {
  Recorded bumpers("bumper_fixture");
  PlayerCc::BumperProxy bumper(&bumpers.client, kIndex);
  bumpers.client.Read();
  ASSERT_EQ(bumper.GetCount(), 5U);
  EXPECT_EQ(bumper.IsBumped(1), 1U);
  EXPECT_EQ(bumper.IsBumped(2), 0U);
  EXPECT_TRUE(bumper.IsAnyBumped());
  EXPECT_GT(bumper.GetPoseCount(), 0U);

  Recorded heads("ptz");
  PlayerCc::PtzProxy ptz(&heads.client, kIndex);
  heads.client.Read();
  EXPECT_DOUBLE_EQ(ptz.GetPan(), 0.25);
  EXPECT_DOUBLE_EQ(ptz.GetTilt(), -0.125);
  EXPECT_DOUBLE_EQ(ptz.GetZoom(), 0.5);

  Recorded grippers("gripper_fixture");
  PlayerCc::GripperProxy gripper(&grippers.client, kIndex);
  grippers.client.Read();
  EXPECT_EQ(gripper.GetState(), 1U);
  EXPECT_EQ(gripper.GetStored(), 1U);
  EXPECT_DOUBLE_EQ(gripper.GetInnerSize().sw, 0.25);
  EXPECT_DOUBLE_EQ(gripper.GetPose().px, 0.30000000000000004);
  EXPECT_EQ(gripper.GetCapacity(), 3U);

  Recorded arms("actarray");
  PlayerCc::ActArrayProxy arm(&arms.client, kIndex);
  arms.client.Read();
  ASSERT_EQ(arm.GetCount(), 2U);
  EXPECT_FLOAT_EQ(arm.GetActuatorData(0).position, 0.5F);
  EXPECT_FLOAT_EQ(arm.GetActuatorData(0).speed, 0.1F);
  EXPECT_EQ(arm.GetActuatorData(1).state, 2);
  EXPECT_FLOAT_EQ(arm.GetActuatorGeom(0).home, 0.1F);
  EXPECT_TRUE(arm.IsPowered());
}

TEST(PlayerSession, Signals_Read) {
  Recorded analog("aio");
  PlayerCc::AioProxy aio(&analog.client, kIndex);
  analog.client.Read();
  ASSERT_EQ(aio.GetCount(), 4U);
  EXPECT_DOUBLE_EQ(aio.GetVoltage(1), -2.25);

  Recorded digital("dio");
  PlayerCc::DioProxy dio(&digital.client, kIndex);
  digital.client.Read();
  EXPECT_EQ(dio.GetCount(), 16U);
  EXPECT_EQ(dio.GetDigin(), 42435U);

  Recorded radio("wifi");
  PlayerCc::WiFiProxy wifi(&radio.client, kIndex);
  radio.client.Read();
  ASSERT_EQ(wifi.GetLinkCount(), 2);
  EXPECT_STREQ(wifi.GetLinkMAC(0), "00:11:22:33:44:55");
  EXPECT_STREQ(wifi.GetLinkESSID(0), "playernet");
  EXPECT_EQ(wifi.GetLinkLevel(0), 40);

  Recorded lights("blinkenlight");
  PlayerCc::BlinkenLightProxy light(&lights.client, kIndex);
  lights.client.Read();
  EXPECT_TRUE(light.GetEnable());
  EXPECT_DOUBLE_EQ(light.GetPeriod(), 1.5);
  EXPECT_EQ(light.GetBlue(), 30);

  Recorded bytes("opaque");
  PlayerCc::OpaqueProxy opaque(&bytes.client, kIndex);
  bytes.client.Read();
  std::vector<uint8_t> data(opaque.GetCount());
  opaque.GetData(data.data());
  EXPECT_THAT(data, ElementsAre(0, 1, 2, 254, 104));
}

TEST(PlayerSession, Hypotheses_SortedByLikelihood) {
  Recorded recorded("localize_fixture");
  PlayerCc::LocalizeProxy localize(&recorded.client, kIndex);
  recorded.client.Read();
  ASSERT_EQ(localize.GetHypothCount(), 2U);
  EXPECT_GE(localize.GetHypoth(0).alpha, localize.GetHypoth(1).alpha);
  EXPECT_DOUBLE_EQ(localize.GetHypoth(0).mean.px, 1.0);
  EXPECT_DOUBLE_EQ(localize.GetHypoth(0).mean.py, -1.0);
}

// --- The world

TEST(PlayerSession, Maps_Fetched) {
  Recorded recorded("map_tiny");
  PlayerCc::MapProxy map(&recorded.client, recorded.server.script.devices.front().index);
  map.RequestMap();
  ASSERT_EQ(map.GetWidth(), 6U);
  ASSERT_EQ(map.GetHeight(), 4U);
  EXPECT_DOUBLE_EQ(map.GetResolution(), 0.5);
  EXPECT_DOUBLE_EQ(map.GetOriginX(), -1.5);
  std::vector<int8_t> cells(24);
  map.GetMap(cells.data());
  EXPECT_EQ(cells, recorded.report("map").at("cells").get<std::vector<int8_t>>());
  expect_same(recorded, PLAYER_MAP_CODE, PLAYER_MSGTYPE_REQ, PLAYER_MAP_REQ_GET_DATA);
}

TEST(PlayerSession, Maps_FetchedInTiles) {
  Recorded recorded("map_mapfile");
  PlayerCc::MapProxy map(&recorded.client, recorded.server.script.devices.front().index);
  map.RequestMap();
  EXPECT_EQ(map.GetWidth(), 80U);
  EXPECT_EQ(map.GetHeight(), 60U);
}

TEST(PlayerSession, SimulationObjects_Moved) {
  Recorded recorded("simulation_stage");
  PlayerCc::SimulationProxy simulation(&recorded.client, 0);
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  std::string robot = "r0";
  simulation.GetPose2d(robot.data(), x, y, yaw);
  EXPECT_DOUBLE_EQ(x, -0.4184464058344466);
  simulation.SetPose2d(robot.data(), -1.5, 0.5, 0.25);
  simulation.SetPose2d(robot.data(), -1.0, 0.0, 0.0);
  expect_same(recorded, PLAYER_SIMULATION_CODE, PLAYER_MSGTYPE_REQ,
              PLAYER_SIMULATION_REQ_SET_POSE2D);
  simulation.GetPose2d(robot.data(), x, y, yaw);
  EXPECT_DOUBLE_EQ(yaw, 0.25);
}

TEST(PlayerSession, Logs_Written) {
  Recorded recorded("log");
  PlayerCc::LogProxy log(&recorded.client, 0);
  log.QueryState();
  EXPECT_EQ(log.GetType(), PLAYER_LOG_TYPE_WRITE);
  EXPECT_EQ(log.GetState(), 0);
  log.SetWriteState(1);
  EXPECT_EQ(log.GetState(), 1);
}

TEST(PlayerSession, Blackboard_ReadAndSet) {
  Script script;
  script.devices = {{0, 6665, PLAYER_BLACKBOARD_CODE, 0}};
  player::BlackboardEntry entry;
  entry.group = player::text_bytes("grp");
  entry.key = player::text_bytes("answer");
  entry.type = 1;
  entry.subtype = 2;
  entry.data = {42, 0, 0, 0};
  script.replies[{PLAYER_BLACKBOARD_CODE, 0, PLAYER_BLACKBOARD_REQ_GET_ENTRY}] = {
      player::encode(entry)};
  script.replies[{PLAYER_BLACKBOARD_CODE, 0, PLAYER_BLACKBOARD_REQ_SET_ENTRY}] = {""};
  script.replies[{PLAYER_BLACKBOARD_CODE, 0, PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_GROUP}] = {""};
  entry.data = {43, 0, 0, 0};
  entry.timestamp_sec = 7;
  script.rounds = {
      test::data_message(PLAYER_BLACKBOARD_CODE, 0, PLAYER_BLACKBOARD_DATA_UPDATE, 7.0, entry)};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::BlackBoardProxy board(&client, 0);
  auto* const found = board.SubscribeToKey("answer", "grp");
  ASSERT_EQ(found->data_count, 4U);
  EXPECT_EQ(found->data[0], 42);
  std::free(found->key);
  std::free(found->group);
  std::free(found->data);
  std::free(found);
  std::vector<int> values;
  board.SetEventFunction([&](const player_blackboard_entry_t& e) { values.push_back(e.data[0]); });
  for (int i = 0; i < 50 && values.empty(); ++i) client.Read();
  EXPECT_THAT(values, ElementsAre(43));
}

// --- Commands

TEST(PlayerSession, DrivingCommands_Sent) {
  Recorded recorded("position2d_fixture");
  PlayerCc::Position2dProxy position(&recorded.client, kIndex);
  position.SetMotorEnable(true);
  position.SetSpeed(0.2, 0.1);
  position.SetCarlike(0.1, 0.05);
  position.SetVelHead(0.1, 0.3);
  position.GoTo(0.5, 0.25, 0.1);
  position.GoTo({0.5, 0.25, 0.1}, {0.3, 0.0, 0.2});
  position.SetSpeed(0.0, 0.0);
  position.SetOdometry(2.5, -1.5, 1.25);
  position.SetMotorEnable(false);
  const auto code = PLAYER_POSITION2D_CODE;
  expect_same(recorded, code, PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL);
  expect_same(recorded, code, PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_CAR);
  expect_same(recorded, code, PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_VEL_HEAD);
  expect_same(recorded, code, PLAYER_MSGTYPE_CMD, PLAYER_POSITION2D_CMD_POS);
  expect_same(recorded, code, PLAYER_MSGTYPE_REQ, PLAYER_POSITION2D_REQ_MOTOR_POWER);
  expect_same(recorded, code, PLAYER_MSGTYPE_REQ, PLAYER_POSITION2D_REQ_SET_ODOM);
  expect_same(recorded, code, PLAYER_MSGTYPE_REQ, PLAYER_POSITION2D_REQ_GET_GEOM);
}

TEST(PlayerSession, ArmCommands_Sent) {
  Recorded recorded("actarray");
  PlayerCc::ActArrayProxy arm(&recorded.client, kIndex);
  arm.SetPowerConfig(true);
  arm.SetBrakesConfig(false);
  arm.MoveTo(1, 0.5F);
  arm.MoveToMulti({0.25F, -0.25F});
  arm.MoveAtSpeed(0, 0.125F);
  arm.MoveAtSpeedMulti({0.25F, -0.25F});
  arm.MoveHome(-1);
  arm.SetActuatorCurrent(0, 1.5F);
  arm.SetSpeedConfig(0, 0.5F);
  arm.SetAccelerationConfig(0, 0.5F);
  const auto code = PLAYER_ACTARRAY_CODE;
  for (unsigned subtype = PLAYER_ACTARRAY_CMD_POS; subtype <= PLAYER_ACTARRAY_CMD_CURRENT;
       ++subtype) {
    expect_same(recorded, code, PLAYER_MSGTYPE_CMD, subtype);
  }
  for (unsigned subtype = PLAYER_ACTARRAY_REQ_POWER; subtype <= PLAYER_ACTARRAY_REQ_ACCEL;
       ++subtype) {
    expect_same(recorded, code, PLAYER_MSGTYPE_REQ, subtype);
  }
}

TEST(PlayerSession, OtherCommands_Sent) {
  Recorded heads("ptz");
  PlayerCc::PtzProxy ptz(&heads.client, kIndex);
  ptz.SetCam(0.5, -0.25, 0.75);
  settle(heads.client);
  EXPECT_EQ(
      payloads(heads.server.received(), PLAYER_PTZ_CODE, PLAYER_MSGTYPE_CMD, 1).at(0),
      payloads(recorded_messages(heads.recording), PLAYER_PTZ_CODE, PLAYER_MSGTYPE_CMD, 1).at(0));

  Recorded grippers("gripper_fixture");
  PlayerCc::GripperProxy gripper(&grippers.client, kIndex);
  gripper.Close();
  gripper.Open();
  gripper.Stop();
  gripper.Store();
  gripper.Retrieve();
  for (unsigned subtype = 1; subtype <= 5; ++subtype) {
    expect_same(grippers, PLAYER_GRIPPER_CODE, PLAYER_MSGTYPE_CMD, subtype);
  }

  Recorded lights("blinkenlight");
  PlayerCc::BlinkenLightProxy light(&lights.client, kIndex);
  light.SetEnable(true);
  light.SetPeriod(0.5);
  light.SetDutyCycle(0.25);
  expect_same(lights, PLAYER_BLINKENLIGHT_CODE, PLAYER_MSGTYPE_CMD, PLAYER_BLINKENLIGHT_CMD_POWER);
  const auto flashes = payloads(lights.server.received(), PLAYER_BLINKENLIGHT_CODE,
                                PLAYER_MSGTYPE_CMD, PLAYER_BLINKENLIGHT_CMD_FLASH);
  const auto flash = player::decode<player::BlinkenlightCmdFlash>(flashes.back());
  EXPECT_FLOAT_EQ(flash.period, 0.5F);
  EXPECT_FLOAT_EQ(flash.dutycycle, 0.25F);

  Recorded localizers("localize_fixture");
  PlayerCc::LocalizeProxy localize(&localizers.client, kIndex);
  double pose[3] = {-1.0, 0.0, 0.0};
  double cov[6] = {};
  localize.SetPose(pose, cov);
  const auto poses = payloads(localizers.server.received(), PLAYER_LOCALIZE_CODE,
                              PLAYER_MSGTYPE_REQ, PLAYER_LOCALIZE_REQ_SET_POSE);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_DOUBLE_EQ(player::decode<player::LocalizeSetPose>(poses.front()).mean.px, -1.0);
}

TEST(PlayerSession, Signals_Sent) {
  Recorded analog("aio");
  PlayerCc::AioProxy aio(&analog.client, kIndex);
  aio.SetVoltage(2, -7.5);
  expect_same(analog, PLAYER_AIO_CODE, PLAYER_MSGTYPE_CMD, PLAYER_AIO_CMD_STATE);
  Recorded digital("dio");
  PlayerCc::DioProxy dio(&digital.client, kIndex);
  const auto command = player::decode<player::DioCmd>(
      payloads(recorded_messages(digital.recording), PLAYER_DIO_CODE, PLAYER_MSGTYPE_CMD, 1).at(0));
  dio.SetOutput(command.count, command.digout);
  expect_same(digital, PLAYER_DIO_CODE, PLAYER_MSGTYPE_CMD, PLAYER_DIO_CMD_VALUES);
}

TEST(PlayerSession, Drawings_Sent) {
  Recorded recorded("graphics2d_stage");
  PlayerCc::Graphics2dProxy sheet(&recorded.client, recorded.server.script.devices.front().index);
  player_point_2d_t points[] = {{0.0, 0.0}, {1.0, 0.5}, {2.0, -0.25}, {-1.0, 1.0}};
  const player_color_t fill = {128, 200, 100, 50};
  sheet.Color(10, 20, 30, 255);
  sheet.DrawPoints(points, 4);
  sheet.DrawPolyline(points, 3);
  sheet.DrawMultiline(points, 4);
  sheet.DrawPolygon(points, 4, true, fill);
  sheet.DrawPolygon(points, 3, false, fill);
  sheet.Clear();
  for (unsigned subtype = PLAYER_GRAPHICS2D_CMD_CLEAR; subtype <= PLAYER_GRAPHICS2D_CMD_MULTILINE;
       ++subtype) {
    expect_same(recorded, PLAYER_GRAPHICS2D_CODE, PLAYER_MSGTYPE_CMD, subtype);
  }
  EXPECT_THAT(error_of([&] { sheet.DrawPoints(nullptr, 1); }), HasSubstr("null pointer"));
  points[1].px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] { sheet.DrawPolyline(points, 4); }), HasSubstr("a point's x"));
}

// --- Errors

TEST(PlayerSession, DriverProperties_Set) {
  Script script = with_laser();
  script.replies[{PLAYER_LASER_CODE, 0, PLAYER_SET_STRPROP_REQ}] = {std::string()};
  player::StrpropReq mode;
  mode.key = player::text_bytes("mode");
  mode.value = "slow";  // without a zero byte at the end
  script.replies[{PLAYER_LASER_CODE, 0, PLAYER_GET_STRPROP_REQ}] = {player::encode(mode)};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  std::string key = "mode";
  std::string value = "fast";
  EXPECT_EQ(laser.SetStrProp(key.data(), value.data()), 0);
  EXPECT_EQ(laser.SetIntProp(key.data(), 3), -1);  // the server refuses it
  char* text = nullptr;
  ASSERT_EQ(laser.GetStrProp(key.data(), &text), 0);
  EXPECT_STREQ(text, "slow");
  std::free(text);
  const auto sent =
      payloads(server.received(), PLAYER_LASER_CODE, PLAYER_MSGTYPE_REQ, PLAYER_SET_STRPROP_REQ);
  ASSERT_EQ(sent.size(), 1U);
  const auto request = player::decode<player::StrpropReq>(sent.front());
  EXPECT_EQ(request.key, player::text_bytes("mode"));
  EXPECT_EQ(request.value, player::text_bytes("fast"));
}

TEST(PlayerErrors, UnknownDevice_ListsExisting) {
  ScriptedPlayerServer server(with_laser());
  PlayerClient client(server.host(), 6665);
  EXPECT_THAT(error_of([&] { PlayerCc::SonarProxy(&client, 0); }),
              HasSubstr("no device sonar:0 on port " + std::to_string(server.port()) +
                        "; the Player server has there: laser:0, position2d:0"));
  EXPECT_THAT(error_of([&] { PlayerCc::MapProxy(&client, 0); }), HasSubstr("no device map:0"));
  EXPECT_THAT(error_of([&] { PlayerCc::LaserProxy(&client, 1); }), HasSubstr("no device laser:1"));
}

TEST(PlayerErrors, UnopenedDevice_Named) {
  Script script = with_laser();
  player::DeviceReq refusal;
  refusal.access = PLAYER_ERROR_MODE;
  script.replies[{PLAYER_PLAYER_CODE, 0, PLAYER_PLAYER_REQ_DEV}] = {std::nullopt};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  EXPECT_THAT(error_of([&] { PlayerCc::LaserProxy(&client, 0); }),
              HasSubstr("does not open laser:0: its driver failed to start"));
}

TEST(PlayerErrors, RefusedRequest_Named) {
  ScriptedPlayerServer server(with_laser());
  PlayerClient client(server.host(), 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  EXPECT_THAT(error_of([&] { position.SetMotorEnable(true); }),
              HasSubstr("refuses request 2 of position2d:0: its driver does not support it"));
  EXPECT_TRUE(client.Connected());
}

TEST(PlayerErrors, UnansweredRequest_Named) {
  Script script = with_laser();
  script.silent = {{PLAYER_POSITION2D_CODE, 0, PLAYER_POSITION2D_REQ_MOTOR_POWER}};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  client.SetRequestTimeout(1);
  EXPECT_THAT(error_of([&] { position.SetMotorEnable(true); }),
              HasSubstr("has not answered request 2 of position2d:0 for 1 s"));
  EXPECT_TRUE(client.Connected());
}

TEST(PlayerErrors, MissingServer_Named) {
  int port = 0;
  {
    const test::ListeningSocket closed;
    port = closed.port();
  }
  EXPECT_THAT(error_of([&] { PlayerClient("player://127.0.0.1:" + std::to_string(port), 6665); }),
              HasSubstr("connection refused: is a Player server running there?"));
}

TEST(PlayerErrors, OtherServer_Named) {
  Script script;
  script.banner = "SSH-2.0-OpenSSH_9.2p1 Debian-2+deb12u3";
  ScriptedPlayerServer other(std::move(script));
  EXPECT_THAT(error_of([&] { PlayerClient(other.host(), 6665); }),
              HasSubstr("no Player server at 127.0.0.1:" + std::to_string(other.port()) +
                        ": it greets with \"SSH-2.0-OpenSSH"));

  Script old;
  old.banner = "Player v.2.1.3";
  old.banner.resize(player::kBannerBytes);
  ScriptedPlayerServer ancient(std::move(old));
  EXPECT_THAT(error_of([&] { PlayerClient(ancient.host(), 6665); }),
              HasSubstr("is Player 2.1.3, whose messages differ"));
}

TEST(PlayerErrors, MissingGreeting_Named) {
  const test::ListeningSocket silent;
  PlayerSettings settings;
  settings.server = {"127.0.0.1", silent.port()};
  settings.banner_timeout_s = 0.05;
  EXPECT_THAT(error_of([&] { PlayerSession session(settings); }), HasSubstr("it does not greet"));
}

TEST(PlayerErrors, LostConnection_Named) {
  Script script = with_laser();
  script.rounds = {test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, scan())};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  client.Read();
  server.drop();
  EXPECT_THAT(error_of([&] {
                for (;;) client.Read();
              }),
              HasSubstr("127.0.0.1"));
}

TEST(PlayerErrors, DeadServer_Named) {
  Script script = with_laser();
  std::atomic<bool> dead{false};
  script.custom = [&](const WireMessage&, const auto&) { return dead.load(); };
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  client.SetRequestTimeout(1);
  dead = true;
  EXPECT_THAT(error_of([&] { client.Read(); }), HasSubstr("has not answered for 1 s"));
}

TEST(PlayerErrors, MissingCanvas_Named) {
  ScriptedPlayerServer server(with_laser());
  const auto session = open_session(server.host(), 6665);
  EXPECT_THAT(error_of([&] { session->request(LayersRequest{}); }),
              HasSubstr("a Player server has no canvas"));
  EXPECT_THAT(error_of([&] { session->request(FlushDrawingsRequest{}); }),
              HasSubstr("a Player server has no canvas"));
  EXPECT_EQ(session->request(CanvasInfoRequest{}).width, 0);
}

// --- Servers that cannot be trusted

/// Expects that a server whose answer to REQ DATA is these bytes loses its client.
void expect_refused(const std::string& bytes, const std::string& why) {
  Script script = with_laser();
  script.rounds = {bytes};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  EXPECT_THAT(error_of([&] { client.Read(); }), HasSubstr(why));
  EXPECT_FALSE(client.Connected());
}

TEST(HostilePlayerServers, Refused) {
  const std::string good =
      test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, scan());
  // A message of more than 8 MiB, by its header.
  std::string long_message = good.substr(0, player::kHeaderBytes);
  std::memcpy(long_message.data() + player::kHeaderBytes - 4, "\x00\x80\x00\x01", 4);
  expect_refused(long_message, "no message of Player 3.1");
  // A count that exceeds the payload: ranges_count is the fifth field of a scan.
  std::string lying = good;
  std::memcpy(lying.data() + player::kHeaderBytes + 16, "\x7f\xff\xff\xff", 4);
  expect_refused(lying, "data of laser:0");
  // A payload that ends too early.
  std::string cut =
      test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, player::Empty{});
  expect_refused(cut, "data of laser:0");
}

TEST(HostilePlayerServers, EndlessData_Refused) {
  Script script = with_laser();
  script.ends_rounds = false;
  script.custom = [](const WireMessage& message, const auto& send) {
    if (message.header.subtype != PLAYER_PLAYER_REQ_DATA || message.header.addr.interf != 1) {
      return false;
    }
    player::LaserData data = scan();
    data.ranges.resize(1U << 20U);
    const std::string bytes =
        test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, data);
    for (int i = 0; i < 100; ++i) send(bytes);
    return true;
  };
  ScriptedPlayerServer server(std::move(script));
  PlayerSettings settings;
  settings.server = {"127.0.0.1", server.port()};
  settings.request_timeout_s = 100.0;  // the limit of bytes comes first
  PlayerSession session(settings);
  session.request(SubscribeRequest{{0, 0}});
  EXPECT_THAT(error_of([&] { session.wait(); }), HasSubstr("sends data without end"));
}

TEST(HostilePlayerServers, UnrequestedData_Ignored) {
  Script script = with_laser();
  script.rounds = {
      test::data_message(PLAYER_SONAR_CODE, 7, PLAYER_SONAR_DATA_RANGES, 1.0, player::SonarData{}) +
      test::data_message(99, 0, 1, 1.0, player::Empty{}) +
      test::data_message(PLAYER_POSITION2D_CODE, 0, 1, 1.0, player::Empty{}) +
      test::data_message(PLAYER_LASER_CODE, 0, 200, 1.0, player::Empty{}) +
      test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN,
                         std::numeric_limits<double>::quiet_NaN(), scan())};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  client.Read();
  EXPECT_EQ(laser.GetCount(), 3U);
  EXPECT_EQ(laser.GetDataTime(), 0.0);
}

TEST(HostilePlayerServers, DriverRequests_StopAtFirstTimeout) {
  Script script;
  constexpr std::uint16_t kDevices = 100;
  for (std::uint16_t index = 0; index < kDevices; ++index) {
    script.devices.push_back({0, 6665, PLAYER_LASER_CODE, index});
  }
  script.silent = {{PLAYER_PLAYER_CODE, 0, PLAYER_PLAYER_REQ_DRIVERINFO}};
  ScriptedPlayerServer server(std::move(script));
  PlayerSettings settings;
  settings.server = {"127.0.0.1", server.port()};
  settings.request_timeout_s = 0.5;
  const PlayerSession session(settings);
  EXPECT_EQ(session.robots().front().addresses->size(), std::size_t{kDevices});
  EXPECT_EQ(session.robots().front().addresses->front().driver, "unknown");
  EXPECT_EQ(payloads(server.received(), PLAYER_PLAYER_CODE, PLAYER_MSGTYPE_REQ,
                     PLAYER_PLAYER_REQ_DRIVERINFO)
                .size(),
            1U);
}

TEST(HostilePlayerServers, HugeBlackboard_Limited) {
  Script script;
  script.devices = {{0, 6665, PLAYER_BLACKBOARD_CODE, 0}};
  script.replies[{PLAYER_BLACKBOARD_CODE, 0, PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_GROUP}] = {""};
  constexpr std::size_t kData = std::size_t{4} << 20U;
  constexpr std::size_t kEntries = 20;  // 80 MiB; 64 MiB are kept at most
  for (std::size_t i = 0; i < kEntries; ++i) {
    player::BlackboardEntry entry;
    entry.group = player::text_bytes("grp");
    entry.key = player::text_bytes("key" + std::to_string(i));
    entry.data.assign(kData, 1);
    script.rounds.push_back(
        test::data_message(PLAYER_BLACKBOARD_CODE, 0, PLAYER_BLACKBOARD_DATA_UPDATE, 1.0, entry));
  }
  ScriptedPlayerServer server(std::move(script));
  PlayerSettings settings;
  settings.server = {"127.0.0.1", server.port()};
  PlayerSession session(settings);
  const BlackboardRequest all{0, "grp"};
  EXPECT_THAT(session.request(all), IsEmpty());
  // When a round is requested, all earlier ones have arrived.
  const auto requested_rounds = [&] {
    return payloads(server.received(), PLAYER_PLAYER_CODE, PLAYER_MSGTYPE_REQ,
                    PLAYER_PLAYER_REQ_DATA)
        .size();
  };
  while (requested_rounds() <= kEntries) session.wait();
  EXPECT_EQ(session.request(all).size(), 15U);  // of 4 MiB and some bytes of names
}

TEST(PlayerSession, ClosedDevice_ReleasesBytes) {
  Script script;
  script.devices = {{0, 6665, PLAYER_CAMERA_CODE, 0}};
  player::CameraData image;
  image.width = 2000;
  image.height = 2000;
  image.format = PLAYER_CAMERA_FORMAT_MONO8;
  image.compression = PLAYER_CAMERA_COMPRESS_RAW;
  image.image.assign(std::size_t{2000} * 2000, 7);
  const std::string one =
      test::data_message(PLAYER_CAMERA_CODE, 0, PLAYER_CAMERA_DATA_STATE, 1.0, image);
  std::string round;
  for (int i = 0; i < 20; ++i) round += one;  // 80 MB, more than the client queues
  script.rounds = {round, one};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  client.SetReplaceRule(false);
  {
    const PlayerCc::CameraProxy camera(&client, 0);
    ASSERT_TRUE(client.Peek(60'000));
  }
  const PlayerCc::CameraProxy camera(&client, 0);
  ASSERT_TRUE(client.Peek(10'000));
  client.Read();
  EXPECT_EQ(camera.GetWidth(), 2000U);
}

TEST(HostilePlayerServers, AnnouncedWaypoints_Checked) {
  Script script;
  script.devices = {{0, 6665, PLAYER_PLANNER_CODE, 0}};
  player::PlannerData data;
  data.valid = 1;
  data.waypoint_idx = -7;
  data.waypoints_count = 0xffffffffU;
  script.rounds = {
      test::data_message(PLAYER_PLANNER_CODE, 0, PLAYER_PLANNER_DATA_STATE, 1.0, data)};
  // A length, and two counts without an element.
  const std::string path = std::string(8, '\0') + std::string(8, '\xff');
  script.replies[{PLAYER_PLANNER_CODE, 0, PLAYER_PLANNER_REQ_GET_WAYPOINTS}] = {path};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  PlayerCc::PlannerProxy planner(&client, 0);
  client.Read();
  EXPECT_EQ(planner.GetPathValid(), 1U);
  EXPECT_EQ(planner.GetWaypointCount(), 0xffffffffU);  // what the planner says, nothing more
  EXPECT_DOUBLE_EQ(planner.GetIx(5), 0.0);
  EXPECT_THAT(error_of([&] { planner.RequestWaypoints(); }), HasSubstr("the payload ends in"));
  EXPECT_FALSE(client.Connected());
}

TEST(HostilePlayerServers, HugeMap_Refused) {
  const auto error_for = [](const player::MapInfo& info, const std::optional<std::string>& tile) {
    Script script;
    script.devices = {{0, 6665, PLAYER_MAP_CODE, 0}};
    script.replies[{PLAYER_MAP_CODE, 0, PLAYER_MAP_REQ_GET_INFO}] = {player::encode(info)};
    script.replies[{PLAYER_MAP_CODE, 0, PLAYER_MAP_REQ_GET_DATA}] = {tile};
    ScriptedPlayerServer server(std::move(script));
    PlayerClient client(server.host(), 6665);
    PlayerCc::MapProxy map(&client, 0);
    return error_of([&] { map.RequestMap(); });
  };
  player::MapInfo info;
  info.scale = 0.1F;
  info.width = 4'000'000'000U;
  info.height = 2;
  EXPECT_THAT(error_for(info, std::nullopt), HasSubstr("map is invalid: 4000000000 x 2 cells"));
  info.width = 2;
  player::MapData tile;
  tile.width = 2;
  tile.height = 2;
  tile.data = {1, 2, 3};
  EXPECT_THAT(error_for(info, player::encode(tile)), HasSubstr("cannot be decompressed"));
  tile.width = 3;
  EXPECT_THAT(error_for(info, player::encode(tile)), HasSubstr("another tile"));
}

// --- Connections

TEST(PlayerSession, Reconnect_ReadsOn) {
  Script script = with_laser();
  script.rounds = {test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, scan())};
  ScriptedPlayerServer server(std::move(script));
  PlayerClient client(server.host(), 6665);
  client.SetRetryTime(0.01);
  client.SetRetryLimit(100);
  PlayerCc::LaserProxy laser(&client, 0);
  client.Read();
  server.drop();
  for (int i = 0; i < 1000 && server.connections() < 2; ++i) client.Read();
  laser.NotFresh();
  client.Read();
  EXPECT_TRUE(laser.IsFresh());
  EXPECT_EQ(server.connections(), 2);
}

TEST(PlayerSession, MissingRoundEnd_RoundEnds) {
  Script script = with_laser();
  script.ends_rounds = false;
  script.rounds = {test::data_message(PLAYER_LASER_CODE, 0, PLAYER_LASER_DATA_SCAN, 1.0, scan())};
  ScriptedPlayerServer server(std::move(script));
  PlayerSettings settings;
  settings.server = {"127.0.0.1", server.port()};
  settings.request_timeout_s = 0.2;
  PlayerSession session(settings);
  session.request(SubscribeRequest{{0, 0}});
  struct Count : ReadingSink {
    void on_reading(DeviceId /*device*/, const sim::SharedReading& /*reading*/) override { ++n; }
    int n = 0;
  } count;
  session.wait();
  session.take(count);
  EXPECT_EQ(count.n, 1);
}

TEST(PlayerSession, Drivers_UseSecondSession) {
  ScriptedPlayerServer first(with_laser());
  const auto session = open_session(first.host(), 6665);
  EXPECT_EQ(session->port(), first.port());
  EXPECT_EQ(session->simulation(), session->simulation());
  session->close();
  EXPECT_THAT(error_of([&] { session->wait(); }), HasSubstr("the connection is closed"));
}

// --- Host names

/// Sets PLAYPEN_WORLD for a scope.
class WorldVariable {
 public:
  explicit WorldVariable(const std::string& world) { setenv("PLAYPEN_WORLD", world.c_str(), 1); }
  WorldVariable(const WorldVariable&) = delete;
  WorldVariable& operator=(const WorldVariable&) = delete;
  ~WorldVariable() { unsetenv("PLAYPEN_WORLD"); }
};

TEST(PlayerHosts, NoPrefix_GreetingSelectsPlayerProtocol) {
  unsetenv("PLAYPEN_WORLD");
  ScriptedPlayerServer server(with_laser());
  // Another name of this machine stands for a robot's.
  PlayerClient client("127.1", static_cast<uint32_t>(server.port()));
  EXPECT_NO_THROW(PlayerCc::LaserProxy(&client, 0));
  EXPECT_EQ(client.GetPort(), static_cast<uint32_t>(server.port()));
}

TEST(PlayerHosts, WorldVariable_SetsServerOfLocalhost) {
  ScriptedPlayerServer server(with_laser());
  const WorldVariable world(server.host());
  PlayerClient client("localhost", 6665);
  EXPECT_NO_THROW(PlayerCc::LaserProxy(&client, 0));
}

TEST(PlayerHosts, PlayerPrefix_OverridesWorld) {
  ScriptedPlayerServer server(with_laser());
  const WorldVariable world("no_such_world.json");
  PlayerClient client(server.host(), 6665);
  EXPECT_NO_THROW(PlayerCc::LaserProxy(&client, 0));
}

TEST(PlayerHosts, DefaultPort_FromClient) {
  EXPECT_EQ(parse_server_address("player://robot", 6666).text(), "robot:6666");
  EXPECT_EQ(parse_server_address("player://robot:7000", 6666).text(), "robot:7000");
  EXPECT_EQ(parse_server_address("player://[::1]:7000", 6666).text(), "[::1]:7000");
  EXPECT_THAT(error_of([] { static_cast<void>(parse_server_address("player://", 6665)); }),
              HasSubstr("the host is missing"));
}

// --- Both our ends

sim::WorldDescription room() {
  return sim::load_world_text(R"({"name": "room", "arena": {"size": [20, 4]}, "robots": [
      {"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"infrared": {}, "battery": {}}}]})");
}

/// A simulation with a Player server on any free port.
struct Served {
  Served() : host(test::patient_host(room())) {
    ServerSettings settings;
    settings.port = 0;
    settings.player_port = 0;
    server = std::make_unique<Server>(host, settings);
  }
  [[nodiscard]] std::string name() const {
    return "player://127.0.0.1:" + std::to_string(server->player_ports().at(6665));
  }

  std::shared_ptr<Host> host;
  std::unique_ptr<Server> server;
};

TEST(PlayerSession, PlaypenServer_DrivesRobot) {
  const Served served;
  EXPECT_EQ(error_of([&] {
              PlayerClient client(served.name(), 6665);
              PlayerCc::Position2dProxy position(&client, 0);
              PlayerCc::LaserProxy laser(&client, 0);
              PlayerCc::PowerProxy power(&client, 0);
              do {
                client.Read();
              } while (!laser.IsFresh() || !power.IsFresh());
              EXPECT_EQ(laser.GetCount(), 682U);
              EXPECT_GT(power.GetCharge(), 0.0);
              EXPECT_GT(position.GetSize().sl, 0.1);
              const double start_m = position.GetXPos();
              position.SetMotorEnable(true);
              position.SetSpeed(0.3, 0.0);
              for (int i = 0; i < 1000 && position.GetXPos() < start_m + 0.2; ++i) client.Read();
              EXPECT_GE(position.GetXPos(), start_m + 0.2);
              EXPECT_NEAR(position.GetXSpeed(), 0.3, 0.05);
            }),
            "no error");
}

TEST(PlayerSession, DroppedReadings_Counted) {
  const Served served;
  EXPECT_EQ(error_of([&] {
              PlayerClient client(served.name(), 6665);
              client.SetReplaceRule(false);
              PlayerCc::LaserProxy laser(&client, 0);
              {
                const auto other = served.host->connect(6665);
                other->request(SleepRequest{123.4});  // 1234 scans, and the queue holds 1000
              }
              EXPECT_EQ(client.GetOverflowCount(), 0U);
              while (!laser.IsFresh()) client.Read();
              EXPECT_EQ(client.GetOverflowCount(), 234U);
            }),
            "no error");
}

// --- Hosts without a protocol

/// A simulation on an address of its own: Playpen's protocol on its port 4000, where a host without
/// a protocol is expected to have it.
struct ServedOnPort4000 {
  ServedOnPort4000() : host(test::patient_host(room())) {
    ServerSettings settings;
    settings.bind = address;
    settings.player_port = 0;
    server = std::make_unique<Server>(host, settings);
  }
  [[nodiscard]] int player_port() const { return server->player_ports().at(6665); }

  const std::string address = test_support::own_loopback();
  std::shared_ptr<Host> host;
  std::unique_ptr<Server> server;
};

TEST(PlayerHosts, NoPrefix_PlayerServerIfItGreets) {
  unsetenv("PLAYPEN_WORLD");
  const ServedOnPort4000 served;
  const auto session = open_session(served.address, served.player_port());
  EXPECT_NE(dynamic_cast<PlayerSession*>(session.get()), nullptr);
  EXPECT_EQ(session->robots().size(), 1U);
}

// Nobody listens on the port, or somebody who says nothing.
TEST(PlayerHosts, NoPrefix_PlaypenServerOnPort4000) {
  unsetenv("PLAYPEN_WORLD");
  const ServedOnPort4000 served;
  const auto refused = open_session(served.address, 6665);
  EXPECT_NE(dynamic_cast<SocketSession*>(refused.get()), nullptr);
  EXPECT_EQ(refused->robots().at(0).name, "r1");

  const test_support::RawClient silent{test_support::RawClient::Unconnected{}};
  sockaddr_in place{};
  place.sin_family = AF_INET;
  ASSERT_EQ(inet_pton(AF_INET, served.address.c_str(), &place.sin_addr), 1);
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  ASSERT_EQ(bind(silent.descriptor(), generic, size), 0);
  ASSERT_EQ(listen(silent.descriptor(), 8), 0);
  ASSERT_EQ(getsockname(silent.descriptor(), generic, &size), 0);
  const int port = ntohs(place.sin_port);
  EXPECT_THAT(error_of([&] { PlayerClient client(served.address, static_cast<uint32_t>(port)); }),
              HasSubstr("no robot of this world has port " + std::to_string(port)))
      << "the Playpen server answers, and it knows robots by their ports in the world";

  // MORSE's port is that of Playpen servers at once.
  EXPECT_NE(dynamic_cast<SocketSession*>(open_session(served.address, 4000).get()), nullptr);
}

TEST(PlayerHosts, NoServer_ErrorNamesBothPorts) {
  unsetenv("PLAYPEN_WORLD");
  const std::string address = test_support::own_loopback();
  EXPECT_THAT(error_of([&] { PlayerClient client(address, 6665); }),
              testing::AllOf(HasSubstr(address + ":6665"), HasSubstr(address + ":4000"),
                             HasSubstr("as a Playpen server")));
}

TEST(PlayerSession, PlaypenServer_WorldReached) {
  const Served served;
  EXPECT_EQ(error_of([&] {
              PlayerClient client(served.name(), 6665);
              PlayerCc::SimulationProxy simulation(&client, 0);
              std::string name = "r1";
              double x = 0.0;
              double y = 0.0;
              double yaw = 0.0;
              simulation.GetPose2d(name.data(), x, y, yaw);
              EXPECT_DOUBLE_EQ(x, 1.0);
              simulation.SetPose2d(name.data(), 3.0, 2.0, 0.5);
              simulation.GetPose2d(name.data(), x, y, yaw);
              EXPECT_DOUBLE_EQ(x, 3.0);
              EXPECT_DOUBLE_EQ(yaw, 0.5);
              std::string property = "color";
              float colour[4] = {0.0F, 0.0F, 1.0F, 1.0F};
              simulation.SetProperty(name.data(), property.data(), colour, sizeof colour);
              float now[4] = {};
              simulation.GetProperty(name.data(), property.data(), now, sizeof now);
              EXPECT_FLOAT_EQ(now[2], 1.0F);
              EXPECT_FLOAT_EQ(now[0], 0.0F);
              PlayerCc::MapProxy map(&client, 0);
              map.RequestMap();
              EXPECT_NEAR(map.GetWidth() * map.GetResolution(), 20.0, map.GetResolution());
              EXPECT_EQ(map.GetCell(5, 5), -1);  // free
              PlayerCc::BlackBoardProxy board(&client, 0);
            }),
            "no error");
}

TEST(PlayerSession, CLibrary_Works) {
  const Served served;
  playerc_client_t* const client = playerc_client_create(nullptr, served.name().c_str(), 6665);
  ASSERT_EQ(playerc_client_connect(client), 0) << playerc_error_str();
  playerc_laser_t* const laser = playerc_laser_create(client, 0);
  ASSERT_EQ(playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_NE(playerc_client_read(client), nullptr) << playerc_error_str();
  EXPECT_EQ(laser->scan_count, 682);
  playerc_laser_unsubscribe(laser);
  playerc_laser_destroy(laser);
  playerc_client_disconnect(client);
  playerc_client_destroy(client);
}

TEST(PlayerSession, PlaypenServer_MissingDeviceNamed) {
  const Served served;
  EXPECT_THAT(error_of([&] {
                PlayerClient client(served.name(), 6665);
                const PlayerCc::GripperProxy gripper(&client, 0);
              }),
              HasSubstr("there is no device gripper:0"));
}

}  // namespace
}  // namespace playerlike
