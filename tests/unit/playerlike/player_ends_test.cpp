// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Both ends of Player's protocol against each other: proxies of player:// drive the devices of a
// simulation that serves Player's protocol.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "libplayerc++/playerc++.h"
#include "libplayerc/playerc.h"
#include "own_loopback.h"
#include "patient_host.h"
#include "playerlike/server/server.h"

namespace playerlike {
namespace {

using PlayerCc::PlayerClient;

/// A simulation of a world of worlds/ with a Player server on free ports.
class Ends {
 public:
  explicit Ends(const std::string& world)
      : host_(test::patient_host(
            sim::load_world(std::string(PLAYPEN_SOURCE_DIR "/worlds/") + world))) {
    ServerSettings settings;
    settings.port = 0;
    settings.player_port = 0;
    server_ = std::make_unique<Server>(host_, settings);
  }
  [[nodiscard]] const Host& host() const { return *host_; }
  [[nodiscard]] std::string name(int robot_port = 6665) const {
    return "player://127.0.0.1:" + std::to_string(server_->player_ports().at(robot_port));
  }

 private:
  std::shared_ptr<Host> host_;
  std::unique_ptr<Server> server_;
};

/// Reads until done() is true. @return whether it was within many rounds.
template <typename Done>
[[nodiscard]] bool read_until(PlayerClient& client, Done done) {
  constexpr int kRounds = 5000;
  for (int i = 0; i < kRounds; ++i) {
    client.Read();
    if (done()) return true;
  }
  return false;
}

TEST(PlayerEnds, Planner_DrivesToGoal) {
  const Ends ends("examples/wavefront.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::PlannerProxy planner(&client, 0);
  EXPECT_EQ(planner.GetDriverName(), "wavefront");
  // The planner's own first reading may come after that of this client.
  ASSERT_TRUE(read_until(client, [&] { return std::abs(planner.GetPx() + 1.0) < 1e-3; }));
  EXPECT_EQ(planner.GetPathValid(), 0U);
  planner.SetGoalPose(1.5, -0.4, 0.0);
  EXPECT_DOUBLE_EQ(planner.GetGx(), 1.5);
  ASSERT_TRUE(read_until(client, [&] { return planner.GetPathValid() == 1; }));
  EXPECT_DOUBLE_EQ(planner.GetGx(), 1.5);
  EXPECT_EQ(planner.GetWaypointCount(), 1U);
  EXPECT_EQ(planner.GetCurrentWaypointId(), 0);
  planner.RequestWaypoints();
  ASSERT_EQ(planner.GetWaypointCount(), 1U);
  EXPECT_NEAR(planner.GetIx(0), 1.5, 0.05);        // a cell of the planner's map
  EXPECT_NEAR(planner.GetPathLength(), 2.5, 0.1);  // straight along the corridor
  ASSERT_TRUE(read_until(client, [&] { return planner.GetPathDone() == 1; }));
  EXPECT_NEAR(planner.GetPx(), 1.5, 0.35);  // the planner's tolerance is 0.3 m

  // The next goal is not done at once, and a planner that is switched off does not drive.
  planner.SetEnable(false);
  planner.SetGoalPose(-1.0, -0.4, 0.0);
  EXPECT_EQ(planner.GetPathDone(), 0U);
  const auto read_rounds = [&] {
    for (int i = 0; i < 50; ++i) client.Read();
  };
  read_rounds();  // it brakes
  const double stopped_m = planner.GetPx();
  read_rounds();
  EXPECT_NEAR(planner.GetPx(), stopped_m, 1e-3);
  EXPECT_EQ(planner.GetPathDone(), 0U);

  // A path from another place is only planned.
  planner.SetEnable(true);
  planner.SetStartPose(0.5, -0.4, 0.0);
  const auto fetched_length = [&] {
    planner.RequestWaypoints();
    return planner.GetPathLength();
  };
  ASSERT_TRUE(read_until(client, [&] { return std::abs(fetched_length() - 1.5) < 0.1; }));
}

TEST(PlayerEnds, Planner_ServesCLibrary) {
  const Ends ends("examples/wavefront.json");
  playerc_client_t* const client = playerc_client_create(nullptr, ends.name().c_str(), 6665);
  ASSERT_EQ(playerc_client_connect(client), 0) << playerc_error_str();
  playerc_planner_t* const planner = playerc_planner_create(client, 0);
  ASSERT_EQ(playerc_planner_subscribe(planner, PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  ASSERT_EQ(playerc_planner_set_cmd_pose(planner, 1.5, -0.4, 0.0), 0) << playerc_error_str();
  for (int i = 0; i < 1000 && planner->path_valid == 0; ++i) {
    ASSERT_NE(playerc_client_read(client), nullptr) << playerc_error_str();
  }
  EXPECT_EQ(planner->path_valid, 1);
  ASSERT_EQ(playerc_planner_get_waypoints(planner), 0) << playerc_error_str();
  ASSERT_EQ(planner->waypoint_count, 1);
  EXPECT_NEAR(planner->waypoints[0][0], 1.5, 0.05);
  EXPECT_EQ(playerc_planner_enable(planner, 0), 0) << playerc_error_str();
  playerc_planner_unsubscribe(planner);
  playerc_planner_destroy(planner);
  playerc_client_disconnect(client);
  playerc_client_destroy(client);
}

TEST(PlayerEnds, Properties_ReadByName) {
  const Ends ends("cave.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::LaserProxy laser(&client, 0);
  char beams[] = "beams", range_max[] = "range_max", noise[] = "noise", type[] = "type";
  std::int32_t count = 0;
  double range_m = 0.0;
  bool is_noisy = true;
  ASSERT_EQ(laser.GetIntProp(beams, &count), 0);
  EXPECT_EQ(count, 181);
  ASSERT_EQ(laser.GetDblProp(range_max, &range_m), 0);
  EXPECT_DOUBLE_EQ(range_m, 8.0);
  ASSERT_EQ(laser.GetBoolProp(noise, &is_noisy), 0);
  EXPECT_FALSE(is_noisy);
  char* text = nullptr;
  ASSERT_EQ(laser.GetStrProp(type, &text), 0);
  EXPECT_STREQ(text, "laser");
  std::free(text);
  EXPECT_EQ(laser.GetIntProp(type, &count), -1);
  EXPECT_EQ(laser.SetDblProp(range_max, 3.0), -1);
  EXPECT_EQ(laser.SetIntProp(beams, 3), -1);
  EXPECT_EQ(laser.SetBoolProp(noise, true), -1);
  EXPECT_EQ(laser.SetStrProp(type, beams), -1);
  client.Read();  // a refused request does not end the connection
  EXPECT_EQ(laser.GetCount(), 181U);
}

TEST(PlayerEnds, Arm_Moves) {
  const Ends ends("devices/actarray.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::ActArrayProxy arm(&client, 0);
  client.Read();
  ASSERT_GT(arm.GetCount(), 0U);
  EXPECT_NEAR(arm.GetActuatorGeom(0).length, 0.3, 1e-6);
  arm.MoveTo(0, 0.4F);
  ASSERT_TRUE(
      read_until(client, [&] { return std::abs(arm.GetActuatorData(0).position - 0.4F) < 0.01F; }));
  arm.SetPowerConfig(false);
  ASSERT_TRUE(read_until(client, [&] { return !arm.IsPowered(); }));
}

TEST(PlayerEnds, Light_Blinks) {
  const Ends ends("devices/blinkenlight.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::BlinkenLightProxy light(&client, 0);
  light.SetColor(10, 20, 30);
  light.SetPeriod(0.5);
  light.SetDutyCycle(0.25);
  ASSERT_TRUE(read_until(client, [&] { return light.GetDutyCycle() == 0.25; }));
  EXPECT_EQ(light.GetGreen(), 20);
  EXPECT_DOUBLE_EQ(light.GetPeriod(), 0.5);
  light.SetEnable(false);
  ASSERT_TRUE(read_until(client, [&] { return !light.GetEnable(); }));
}

TEST(PlayerEnds, Messages_Arrive) {
  const Ends ends("devices/opaque.json");
  PlayerClient client(ends.name(6665), 6665);
  PlayerClient other(ends.name(6666), 6666);
  PlayerCc::OpaqueProxy ada(&client, 0);
  PlayerCc::OpaqueProxy bob(&other, 0);
  std::vector<std::uint8_t> bytes = {1, 2, 0, 255};
  player_opaque_data_t data = {static_cast<uint32_t>(bytes.size()), bytes.data()};
  ada.SendCmd(&data);
  EXPECT_EQ(ada.SendReq(&data), 0);
  ASSERT_TRUE(read_until(other, [&] { return bob.GetCount() == 4; }));
  std::vector<std::uint8_t> received(4);
  bob.GetData(received.data());
  EXPECT_EQ(received, bytes);
}

TEST(PlayerEnds, Lines_ArriveAndSwitch) {
  const Ends ends("devices/dio.json");
  PlayerClient bell_client(ends.name(6665), 6665);
  PlayerClient keeper_client(ends.name(6666), 6666);
  PlayerCc::DioProxy bell(&bell_client, 0);
  PlayerCc::DioProxy keeper(&keeper_client, 0);
  bell.SetOutput(1, 1);
  ASSERT_TRUE(read_until(keeper_client, [&] { return keeper.GetCount() == 4 && keeper[3] == 1; }));

  const Ends analog("devices/aio.json");
  PlayerClient meter_client(analog.name(), 6665);
  PlayerCc::AioProxy meter(&meter_client, 0);
  meter.SetVoltage(0, 3.5);
  ASSERT_TRUE(read_until(meter_client, [&] {
    return meter.GetCount() == 6 && std::abs(meter.GetVoltage(5) - 3.5) < 0.1;
  }));
  EXPECT_NEAR(meter.GetVoltage(4), 5.0, 0.1);
}

TEST(PlayerEnds, Head_Turns) {
  const Ends ends("devices/ptz.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::PtzProxy head(&client, 0);
  PlayerCc::CameraProxy camera(&client, 0);
  head.SetCam(0.5, 0.1, 0.6);
  ASSERT_TRUE(read_until(client, [&] {
    return std::abs(head.GetPan() - 0.5) < 1e-3 && std::abs(head.GetZoom() - 0.6) < 1e-3;
  }));
  EXPECT_NEAR(head.GetTilt(), 0.1, 1e-3);
  head.SelectControlMode(PLAYER_PTZ_VELOCITY_CONTROL);
  head.SetSpeed(-0.3, 0.0);
  ASSERT_TRUE(read_until(client, [&] { return head.GetPan() < 0.2; }));
  ASSERT_TRUE(read_until(client, [&] { return camera.GetImageSize() > 0; }));
  EXPECT_EQ(camera.GetImageSize(), camera.GetWidth() * camera.GetHeight() * 3);
}

TEST(PlayerEnds, Gripper_Grips) {
  const Ends ends("devices/gripper.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::GripperProxy gripper(&client, 0);
  gripper.Close();
  ASSERT_TRUE(read_until(client, [&] { return gripper.GetPaddlesMoving() != 0; }));
  ASSERT_TRUE(read_until(client, [&] { return gripper.GetPaddlesMoving() == 0; }));
  EXPECT_EQ(gripper.GetCapacity(), 2U);
  gripper.Open();
  ASSERT_TRUE(read_until(client, [&] { return gripper.GetPaddlesOpen() != 0; }));
}

TEST(PlayerEnds, Wifi_HearsOthers) {
  const Ends ends("devices/wifi.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::WiFiProxy wifi(&client, 0);
  ASSERT_TRUE(read_until(client, [&] { return wifi.GetLinkCount() == 2; }));
  std::vector<std::string> names = {wifi.GetLinkESSID(0), wifi.GetLinkESSID(1)};
  EXPECT_THAT(names, testing::UnorderedElementsAre("talker", "hall"));
  EXPECT_LT(wifi.GetLinkLevel(0), -40);
}

// Clients without readings let time pass, too, so their commands take effect.
TEST(PlayerEnds, Robot_Speaks) {
  const Ends ends("devices/speech.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::SpeechProxy speech(&client, 0);
  speech.Say("hello");
  const auto said = [&] {
    return ends.host().with_simulation(
        [](const sim::Simulation& all) { return all.spoken_texts(); });
  };
  ASSERT_TRUE(read_until(client, [&] { return !said().empty(); }));
  EXPECT_EQ(said()[0].text, "hello");
  EXPECT_EQ(said()[0].robot, 0);
}

TEST(PlayerEnds, Robot_Draws) {
  const Ends ends("devices/pen.json");
  PlayerClient client(ends.name(), 6665);
  PlayerCc::Graphics2dProxy graphics(&client, 0);
  // Colours on the diagonal and beside it, on cells of 1 cm.
  const auto drawn = [&] {
    return ends.host().with_simulation([](const sim::Simulation& all) {
      const auto colour = [&](int x) {
        const int row = all.layers().description().height - 1 - 25;
        for (const sim::LayerInfo& layer : all.layers().layers()) {
          if (layer.id == sim::kBaseLayer) continue;
          return all.layers().cell(layer.id, x, row).value().colour();
        }
        return sim::Colour{};
      };
      return std::pair(colour(25), colour(35));
    });
  };
  player_point_2d_t points[] = {{0.0, 0.0}, {0.5, 0.5}, {0.5, 0.0}};
  graphics.Color(255, 0, 0, 0);
  graphics.DrawPolyline(points, 3);
  EXPECT_TRUE(read_until(client, [&] { return drawn().first == sim::Colour{255, 0, 0, 255}; }));
  EXPECT_EQ(drawn().second.a, 0);
  graphics.Clear();
  EXPECT_TRUE(read_until(client, [&] { return drawn().first.a == 0; }));
}

TEST(PlayerEnds, Localisation_ReportsParticles) {
  const Ends ends("devices/amcl.json");
  PlayerClient client(ends.name(6666), 6666);
  PlayerCc::LocalizeProxy localize(&client, 0);
  ASSERT_TRUE(read_until(client, [&] { return localize.GetHypothCount() > 0; }));
  localize.GetParticles();
  ASSERT_GE(localize.GetNumParticles(), 200U);
  EXPECT_NEAR(localize.GetParticlePose(0).px, 0.5, 0.6);  // within 6 standard deviations of 0.1 m
  double pose[3] = {1.0, 2.0, 0.5};
  double covariance[6] = {0.01, 0.01, 0.01, 0.0, 0.0, 0.0};
  localize.SetPose(pose, covariance);
  ASSERT_TRUE(
      read_until(client, [&] { return std::abs(localize.GetHypoth(0).mean.py - 2.0) < 0.2; }));
}

}  // namespace
}  // namespace playerlike
