// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Position2dProxy on robots with every drive, in a complete simulation.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "libplayerc++/playerc++.h"
#include "playerlike/host/host.h"
#include "sim/simulation/simulation.h"

namespace {

using PlayerCc::PlayerClient;
using PlayerCc::Position2dProxy;

constexpr double kPi = 3.14159265358979323846;

/// A robot of a model at the centre of a room of 20 x 20 m, facing along y.
class OnRobot : public testing::Test {
 protected:
  void start(const std::string& model) {
    host = playerlike::Host::create(
        sim::load_world_text(R"({"arena": {"size": [20, 20]}, "robots": [{"model": ")" + model +
                             R"(", "pose": {"x": 10, "y": 10, "yaw_deg": 90}}]})"));
    client = std::make_unique<PlayerClient>(host->connect(6665));
    position = std::make_unique<Position2dProxy>(client.get(), 0);
    truth = std::make_unique<Position2dProxy>(client.get(), 1);
  }
  void read(int times) {
    for (int i = 0; i < times; ++i) client->Read();
  }
  void expect_at(double x_m, double y_m, double yaw_rad, double tolerance) const {
    EXPECT_NEAR(position->GetXPos(), x_m, tolerance);
    EXPECT_NEAR(position->GetYPos(), y_m, tolerance);
    EXPECT_NEAR(std::remainder(position->GetYaw() - yaw_rad, 2.0 * kPi), 0.0, tolerance);
  }

  std::shared_ptr<playerlike::Host> host;
  std::unique_ptr<PlayerClient> client;
  std::unique_ptr<Position2dProxy> position;
  std::unique_ptr<Position2dProxy> truth;
};

TEST_F(OnRobot, Pioneer_IndexZeroStartsAtZero) {
  start("pioneer2dx");
  read(1);
  expect_at(0.0, 0.0, 0.0, 1e-12);
  EXPECT_NEAR(truth->GetXPos(), 10.0, 1e-12);
  EXPECT_NEAR(truth->GetYaw(), kPi / 2.0, 1e-12);
  position->SetSpeed(0.5, 0.0);
  read(20);  // 2 s
  expect_at(1.0, 0.0, 0.0, 1e-9);
  EXPECT_NEAR(truth->GetYPos(), 11.0, 1e-9);
  EXPECT_NEAR(position->GetXSpeed(), 0.5, 1e-9);
  EXPECT_FALSE(position->GetStall());
}

TEST_F(OnRobot, SpeedBeyondLimit_WarnsOnce) {
  start("s1r_full");
  testing::internal::CaptureStderr();
  position->SetSpeed(0.5, 3.0);  // the limits
  position->SetSpeed(-0.5, -3.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  for (int i = 0; i < 3; ++i) {
    position->SetSpeed(2.0, 0.0);
    position->SetSpeed(0.0, 4.0);
    position->SetCarlike(-2.0, 0.0);
    read(1);
  }
  EXPECT_EQ(
      testing::internal::GetCapturedStderr(),
      "playpen: warning: Position2dProxy::SetSpeed: robot r1 drives at most 0.5 m/s, so 2 m/s "
      "is clamped to that (reported once)\n");
}

TEST_F(OnRobot, TurnRateBeyondLimit_WarnsOnce) {
  start("s1r_full");
  testing::internal::CaptureStderr();
  for (int i = 0; i < 3; ++i) position->SetSpeed(0.1, -4.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "playpen: warning: Position2dProxy::SetSpeed: robot r1 turns at most 3 rad/s, so -4 "
            "rad/s is clamped to that (reported once)\n");
}

TEST_F(OnRobot, Pioneer_ReportsGeometry) {
  start("pioneer2dx");
  position->RequestGeom();
  EXPECT_DOUBLE_EQ(position->GetSize().sl, 0.44);
  EXPECT_DOUBLE_EQ(position->GetSize().sw, 0.38);
  EXPECT_NEAR(position->GetOffset().px, -0.04, 1e-12);  // the axle is ahead of the centre
}

TEST_F(OnRobot, GoTo_EndsAtPoseInFrameOfIndex) {
  start("pioneer2dx");
  position->GoTo(2.0, -1.0, kPi);
  read(150);
  expect_at(2.0, -1.0, kPi, 0.011);
  EXPECT_EQ(position->GetXSpeed(), 0.0);
  EXPECT_EQ(position->GetYawSpeed(), 0.0);
  // At the start the odometry's x axis is W's y axis: 2 m ahead and 1 m to the right.
  EXPECT_NEAR(truth->GetXPos(), 11.0, 0.02);
  EXPECT_NEAR(truth->GetYPos(), 12.0, 0.02);
  truth->GoTo(player_pose2d_t{9.0, 9.0, 0.0});
  read(200);
  EXPECT_NEAR(truth->GetXPos(), 9.0, 0.011);
  EXPECT_NEAR(truth->GetYPos(), 9.0, 0.011);
  EXPECT_NEAR(truth->GetYaw(), 0.0, 0.011);
}

TEST_F(OnRobot, GoTo_KeepsSpeedsUntilSpeedCommand) {
  start("pioneer2dx");
  position->GoTo(player_pose2d_t{5.0, 0.0, 0.0}, player_pose2d_t{0.2, 0.0, 0.1});
  read(20);
  expect_at(0.4, 0.0, 0.0, 1e-9);
  position->SetSpeed(0.0, 0.3);
  read(10);
  EXPECT_EQ(position->GetXSpeed(), 0.0);
  EXPECT_NEAR(position->GetYawSpeed(), 0.3, 1e-9);
}

TEST_F(OnRobot, GoTo_UsesSetOdometry) {
  start("pioneer2dx");
  position->SetOdometry(3.0, 4.0, 0.0);
  position->GoTo(3.5, 4.0, 0.0);
  read(100);
  expect_at(3.5, 4.0, 0.0, 0.011);
  EXPECT_NEAR(truth->GetYPos(), 10.5, 0.011);
}

TEST_F(OnRobot, VelHead_HoldsHeadingWhileDriving) {
  start("pioneer2dx");
  position->SetVelHead(0.3, kPi / 2.0);
  read(100);
  EXPECT_NEAR(position->GetYaw(), kPi / 2.0, 1e-6);
  EXPECT_NEAR(position->GetXSpeed(), 0.3, 1e-9);
  EXPECT_GT(position->GetYPos(), 2.0);
}

TEST_F(OnRobot, OmnidirectionalBase_MovesSideways) {
  start("omni");
  position->SetSpeed(0.0, 0.4, 0.0);
  read(20);
  EXPECT_NEAR(position->GetYSpeed(), 0.4, 1e-9);
  // 2 m/s^2 up to 0.4 m/s lose 0.04 m. The ramp is discrete, which reduces the loss by half a step.
  expect_at(0.0, 0.8 - 0.04, 0.0, 0.003);
  EXPECT_NEAR(truth->GetXPos(), 10.0 - position->GetYPos(), 1e-9);
  position->SetSpeed(player_pose2d_t{0.0, -0.4, 0.0});
  read(40);
  EXPECT_NEAR(position->GetYSpeed(), -0.4, 1e-9);
  position->GoTo(-1.0, 1.0, 1.0);
  read(150);
  expect_at(-1.0, 1.0, 1.0, 0.011);
}

TEST_F(OnRobot, Car_DrivesOnSteeringCircle) {
  start("car");
  position->SetCarlike(0.5, 0.4);
  read(20);  // the wheels are turned by now
  const double radius = 0.5 / std::tan(0.4);
  EXPECT_NEAR(position->GetXSpeed(), 0.5, 1e-9);
  EXPECT_NEAR(position->GetYawSpeed(), 0.5 / radius, 1e-9);
  position->SetCarlike(0.5, 9.0);  // as far as possible: 30 degrees
  read(20);
  EXPECT_NEAR(position->GetYawSpeed(), 0.5 * std::tan(kPi / 6.0) / 0.5, 1e-9);
  position->GoTo(0.0, 0.0, 0.0);
  read(400);
  EXPECT_NEAR(std::hypot(position->GetXPos(), position->GetYPos()), 0.0, 0.051);
}

}  // namespace
