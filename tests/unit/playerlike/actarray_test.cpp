// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The arm in client programs: libplayerc++ over all transports, and the C library.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "libplayerc++/playerc++.h"
#include "libplayerc/playerc.h"
#include "player_errors.h"
#include "playerlike/connect/open_session.h"
#include "reachable_host.h"
#include "temporary_folder.h"

namespace {

using namespace PlayerCc;
using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr float kFloat = 1e-6F;  // resolution of the client's numbers

constexpr const char* kWorld = R"({
  "name": "arm",
  "arena": {"size": [2, 2]},
  "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"laser": null, "actarray": {
    "pose": {"x": 0.05, "y": 0.01, "yaw_deg": 90}, "height": 0.2, "pitch_deg": -30, "roll_deg": 10,
    "joints": [
      {"length": 0.3, "axis": "-y", "yaw_deg": 20, "min_deg": -90, "max_deg": 120, "home_deg": 30,
       "speed_deg": 30, "speed_max_deg": 60, "brake": true},
      {"type": "linear", "length": 0.05, "axis": "x", "max": 0.2, "home": 0.02}]}}}]})";

/// The output on standard error during an action that throws nothing.
template <typename Action>
std::string warning_of(Action action) {
  testing::internal::CaptureStderr();
  EXPECT_NO_THROW(action());
  return testing::internal::GetCapturedStderr();
}

class Arm : public testing::TestWithParam<test::Transport> {
 protected:
  Arm()
      : host_(playerlike::Host::create(sim::load_world_text(kWorld)), GetParam()),
        client_(host_.connect(6665)),
        arm_(&client_, 0) {}

  void read(int rounds) {
    for (int i = 0; i < rounds; ++i) client_.Read();
  }

  test::ReachableHost host_;
  PlayerClient client_;
  ActArrayProxy arm_;
};
INSTANTIATE_TEST_SUITE_P(Each, Arm,
                         testing::Values(test::Transport::kInProcess, test::Transport::kCbor,
                                         test::Transport::kJson),
                         [](const auto& it) { return test::transport_name(it.param); });

TEST_P(Arm, Geometry_KnownFromStart) {
  EXPECT_EQ(arm_.GetCount(), 0U);
  EXPECT_FALSE(arm_.IsPowered());
  arm_.RequestGeometry();
  const player_actarray_actuatorgeom_t first = arm_.GetActuatorGeom(0);
  EXPECT_EQ(first.type, PLAYER_ACTARRAY_TYPE_ROTARY);
  EXPECT_NEAR(first.length, 0.3, kFloat);
  EXPECT_NEAR(first.orientation.pyaw, kPi / 9, 1e-12);
  EXPECT_EQ(first.orientation.proll, 0.0);
  EXPECT_EQ(first.axis.px, 0.0);
  EXPECT_EQ(first.axis.py, -1.0);
  EXPECT_EQ(first.axis.pz, 0.0);
  EXPECT_NEAR(first.min, -kPi / 2, kFloat);
  EXPECT_NEAR(first.max, 2 * kPi / 3, kFloat);
  EXPECT_NEAR(first.centre, kPi / 12, kFloat);
  EXPECT_NEAR(first.home, kPi / 6, kFloat);
  EXPECT_NEAR(first.config_speed, kPi / 6, kFloat);
  EXPECT_EQ(first.hasbrakes, 1);
  const player_actarray_actuatorgeom_t second = arm_.GetActuatorGeom(1);
  EXPECT_EQ(second.type, PLAYER_ACTARRAY_TYPE_LINEAR);
  EXPECT_EQ(second.axis.px, 1.0);
  EXPECT_NEAR(second.max, 0.2, kFloat);
  EXPECT_EQ(second.hasbrakes, 0);
  EXPECT_EQ(arm_.GetBasePos().px, 0.05);
  EXPECT_EQ(arm_.GetBasePos().pz, 0.2);
  EXPECT_NEAR(arm_.GetBaseOrientation().pyaw, kPi / 2, 1e-12);
  EXPECT_NEAR(arm_.GetBaseOrientation().ppitch, -kPi / 6, 1e-12);
  EXPECT_NEAR(arm_.GetBaseOrientation().proll, kPi / 18, 1e-12);
}

TEST_P(Arm, Joints_Read) {
  EXPECT_EQ(arm_.GetActuatorData(0).state, 0);
  read(1);
  ASSERT_EQ(arm_.GetCount(), 2U);
  EXPECT_TRUE(arm_.IsPowered());
  EXPECT_NEAR(arm_[0].position, kPi / 6, kFloat);
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
  EXPECT_NEAR(arm_.GetActuatorData(1).position, 0.02, kFloat);
  std::ostringstream text;
  text << arm_;
  EXPECT_THAT(text.str(), HasSubstr("0.523599\t0\t1\n0.02\t0\t1\n"));
}

TEST_P(Arm, PositionCommandsAndHome_Move) {
  arm_.MoveTo(0, 1.0F);
  read(5);
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_MOVING);
  EXPECT_GT(arm_[0].speed, 0.0F);
  EXPECT_EQ(arm_[1].state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
  arm_.MoveToMulti({-0.5F, 0.1F});
  read(100);
  EXPECT_NEAR(arm_[0].position, -0.5, kFloat);
  EXPECT_NEAR(arm_[1].position, 0.1, kFloat);
  arm_.MoveHome(1);
  read(100);
  EXPECT_NEAR(arm_[0].position, -0.5, kFloat);
  EXPECT_NEAR(arm_[1].position, 0.02, kFloat);
  arm_.MoveHome(-1);
  read(100);
  EXPECT_NEAR(arm_[0].position, kPi / 6, kFloat);
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
  arm_.MoveTo(static_cast<uint32_t>(-1), 0.1F);  // all joints
  read(100);
  EXPECT_NEAR(arm_[0].position, 0.1, kFloat);
  EXPECT_NEAR(arm_[1].position, 0.1, kFloat);
}

TEST_P(Arm, SpeedCommand_MovesUntilStall) {
  arm_.MoveAtSpeedMulti({0.3F, -0.05F});
  read(10);
  EXPECT_NEAR(arm_[0].speed, 0.3, kFloat);
  arm_.MoveAtSpeed(0, 0.0F);
  read(10);
  EXPECT_EQ(arm_[0].speed, 0.0F);
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
  EXPECT_EQ(arm_[1].position, 0.0F);
  EXPECT_EQ(arm_[1].state, PLAYER_ACTARRAY_ACTSTATE_STALLED);
}

TEST_P(Arm, CurrentCommand_Pushes) {
  arm_.SetActuatorCurrent(0, 0.5F);
  read(100);
  EXPECT_NEAR(arm_[0].current, 0.5, kFloat);
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_STALLED);
  arm_.SetActuatorCurrentMulti({-0.25F, 0.5F});
  read(2);
  EXPECT_LT(arm_[0].speed, 0.0F);
  EXPECT_GT(arm_[1].speed, 0.0F);
}

TEST_P(Arm, Settings_Accepted) {
  arm_.SetSpeedConfig(0, 0.1F);
  arm_.SetAccelerationConfig(0, 0.2F);
  arm_.MoveTo(0, 2.0F);
  read(5);  // 0.1 rad/s is reached after 0.5 s
  EXPECT_NEAR(arm_[0].acceleration, 0.2, 1e-5);
  read(1);
  EXPECT_NEAR(arm_[0].speed, 0.1, kFloat);
  EXPECT_NEAR(arm_.GetActuatorGeom(0).config_speed, 0.1, kFloat);
  arm_.SetSpeedConfig(static_cast<uint32_t>(-1), 0.05F);
  read(1);
  EXPECT_NEAR(arm_.GetActuatorGeom(1).config_speed, 0.05, kFloat);
}

TEST_P(Arm, PowerOffAndBrakes_Stop) {
  arm_.MoveToMulti({1.0F, 0.1F});
  read(3);
  arm_.SetBrakesConfig(true);
  read(1);
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_BRAKED);
  EXPECT_EQ(arm_[1].state, PLAYER_ACTARRAY_ACTSTATE_MOVING);
  arm_.SetBrakesConfig(false);
  arm_.SetPowerConfig(false);
  read(1);
  EXPECT_FALSE(arm_.IsPowered());
  EXPECT_EQ(arm_[0].state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
  const float position = arm_[1].position;
  EXPECT_EQ(warning_of([&] {
              arm_.MoveTo(1, 0.2F);
              arm_.MoveTo(1, 0.2F);
            }),
            "playpen: warning: ActArrayProxy::MoveTo: the motors are off, so no joint moves; "
            "SetPowerConfig(true) switches them on\n");
  read(10);
  EXPECT_EQ(arm_[1].position, position);
  arm_.SetPowerConfig(true);
  read(10);
  EXPECT_EQ(arm_[1].position, position);
  ActArrayProxy other(&client_, 0);
  arm_.SetPowerConfig(false);
  read(1);
  other.SetPowerConfig(true);
  EXPECT_EQ(warning_of([&] { other.MoveHome(-1); }), "");  // switched on before it moves
  arm_.MoveAtSpeedMulti({0.0F, 0.0F});
  arm_.MoveTo(1, 0.2F);
  read(60);
  EXPECT_NEAR(arm_[1].position, 0.2, kFloat);
}

TEST_P(Arm, JointBeyondEnd_WarnsOnce) {
  read(1);
  EXPECT_EQ(warning_of([&] {
              EXPECT_EQ(arm_.GetActuatorData(2).state, 0);
              EXPECT_EQ(arm_.GetActuatorGeom(7).length, 0.0F);
              arm_.MoveTo(2, 1.0F);
            }),
            "playpen: warning: ActArrayProxy::GetActuatorData: there is no joint 2: there are 2, "
            "counted from 0; "
            "joints beyond the last read 0\n");
  ActArrayProxy commanded(&client_, 0);
  EXPECT_THAT(warning_of([&] {
                commanded.MoveTo(2, 1.0F);
                commanded.MoveHome(9);
                commanded.MoveToMulti({0.1F, 0.1F, 0.1F});
                commanded.MoveToMulti({});
              }),
              testing::EndsWith("ActArrayProxy::MoveTo: there is no joint 2: there are 2, counted "
                                "from 0; commands to joints beyond have no effect\n"));
  read(100);
  EXPECT_NEAR(commanded[0].position, 0.1, kFloat);  // the joints that exist have moved
  EXPECT_NEAR(commanded[1].position, 0.1, kFloat);
}

TEST_P(Arm, PositionBeyondLimit_ClampedWithOneWarning) {
  EXPECT_THAT(warning_of([&] {
                arm_.MoveTo(0, 2.0943952F);  // 120 degrees, rounded up
                arm_.MoveTo(1, 3.0F);
                arm_.MoveTo(0, 9.0F);
              }),
              testing::EndsWith("ActArrayProxy::MoveTo: joint 1 cannot move to 3, only from 0 to "
                                "0.2; it stops at the limit\n"));
  read(100);
  EXPECT_NEAR(arm_[0].position, 2 * kPi / 3, kFloat);
  EXPECT_NEAR(arm_[1].position, 0.2, kFloat);
  EXPECT_EQ(arm_[1].state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
}

TEST_P(Arm, InvalidValues_Refused) {
  EXPECT_EQ(error_of([&] { arm_.SetSpeedConfig(2, 0.1F); }).GetErrorCode(),
            PlayerError::kBadArgument);
  EXPECT_THAT(error_of([&] { arm_.SetAccelerationConfig(5, 0.1F); }).GetErrorStr(),
              HasSubstr("there is no joint 5: there are 2"));
  EXPECT_THAT(error_of([&] { arm_.SetSpeedConfig(0, 0.0F); }).GetErrorStr(),
              HasSubstr("the speed of a joint cannot be set to 0"));
  EXPECT_EQ(error_of([&] { arm_.MoveTo(0, NAN); }).GetErrorCode(), PlayerError::kBadArgument);
  EXPECT_EQ(error_of([&] { arm_.MoveAtSpeed(0, INFINITY); }).GetErrorCode(),
            PlayerError::kBadArgument);
}

TEST(ArmOfNoRobot, ErrorNamesWorldWithArm) {
  const auto host = playerlike::Host::create(sim::load_world_text(
      R"({"arena": {"size": [2, 2]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}]})"));
  PlayerClient client(host->connect(6665));
  EXPECT_THAT(error_of([&] { ActArrayProxy arm(&client, 0); }).GetErrorStr(),
              AllOf(HasSubstr("no device actarray:0"), HasSubstr("worlds/devices/actarray.json")));
}

// --- the C library

struct Free {
  void operator()(playerc_client_t* d) const { playerc_client_destroy(d); }
  void operator()(playerc_actarray_t* d) const { playerc_actarray_destroy(d); }
};

class CArm : public testing::Test {
 protected:
  CArm()
      : client_(playerc_client_create(nullptr, ("sim:" + folder_.write("arm.json", kWorld)).c_str(),
                                      6665)) {
    EXPECT_EQ(playerc_client_connect(client_.get()), 0) << playerc_error_str();
    arm_.reset(playerc_actarray_create(client_.get(), 0));
  }
  ~CArm() override {
    arm_.reset();
    client_.reset();
    playerlike::close_embedded_hosts();
  }
  CArm(const CArm&) = delete;
  CArm& operator=(const CArm&) = delete;

  void read(int rounds) {
    for (int i = 0; i < rounds; ++i) {
      ASSERT_NE(playerc_client_read(client_.get()), nullptr) << playerc_error_str();
    }
  }
  void subscribe() {
    ASSERT_EQ(playerc_actarray_subscribe(arm_.get(), PLAYERC_OPEN_MODE), 0) << playerc_error_str();
  }

  test_support::TemporaryFolder folder_;
  std::unique_ptr<playerc_client_t, Free> client_;
  std::unique_ptr<playerc_actarray_t, Free> arm_;
};

TEST_F(CArm, HasGeometryAndData) {
  EXPECT_EQ(playerc_actarray_home_cmd(arm_.get(), -1), -1);  // not subscribed yet
  subscribe();
  EXPECT_EQ(arm_->actuators_count, 0U);
  ASSERT_EQ(playerc_actarray_get_geom(arm_.get()), 0);
  ASSERT_EQ(arm_->actuators_geom_count, 2U);
  EXPECT_EQ(arm_->actuators_geom[1].type, PLAYER_ACTARRAY_TYPE_LINEAR);
  EXPECT_NEAR(playerc_actarray_get_actuator_geom(arm_.get(), 0).length, 0.3, kFloat);
  EXPECT_EQ(playerc_actarray_get_actuator_geom(arm_.get(), 2).length, 0.0F);
  EXPECT_EQ(arm_->base_pos.pz, 0.2);
  EXPECT_NEAR(arm_->base_orientation.pyaw, kPi / 2, 1e-12);
  read(1);
  ASSERT_EQ(arm_->actuators_count, 2U);
  EXPECT_EQ(arm_->motor_state, 1);
  EXPECT_NEAR(arm_->actuators_data[0].position, kPi / 6, kFloat);
  EXPECT_EQ(playerc_actarray_get_actuator_data(arm_.get(), 1).state, PLAYER_ACTARRAY_ACTSTATE_IDLE);
  EXPECT_EQ(playerc_actarray_get_actuator_data(arm_.get(), 2).state, 0);
  EXPECT_THAT(playerc_error_str(), HasSubstr("there is no joint 2: there are 2"));
}

TEST_F(CArm, TakesAllCommands) {
  subscribe();
  playerc_actarray_t* const arm = arm_.get();
  const auto position = [&](uint32_t joint) {
    return playerc_actarray_get_actuator_data(arm, joint).position;
  };
  EXPECT_EQ(playerc_actarray_power(arm, 1), 0);
  EXPECT_EQ(playerc_actarray_brakes(arm, 0), 0);
  EXPECT_EQ(playerc_actarray_position_cmd(arm, 0, 0.0F), 0);
  read(60);
  EXPECT_EQ(position(0), 0.0F);
  float positions[] = {0.2F, 0.1F};
  EXPECT_EQ(playerc_actarray_multi_position_cmd(arm, positions, 2), 0);
  read(60);
  EXPECT_NEAR(position(0), 0.2, kFloat);
  EXPECT_NEAR(position(1), 0.1, kFloat);
  EXPECT_EQ(playerc_actarray_speed_config(arm, -1, 0.05F), 0);
  EXPECT_EQ(playerc_actarray_accel_config(arm, 0, 1.0F), 0);
  EXPECT_EQ(playerc_actarray_speed_cmd(arm, 1, 0.02F), 0);
  read(10);
  EXPECT_NEAR(playerc_actarray_get_actuator_data(arm, 1).speed, 0.02, kFloat);
  float speeds[] = {-0.1F, 0.0F};
  EXPECT_EQ(playerc_actarray_multi_speed_cmd(arm, speeds, 2), 0);
  read(5);
  EXPECT_NEAR(playerc_actarray_get_actuator_data(arm, 0).speed, -0.1, kFloat);
  EXPECT_EQ(playerc_actarray_home_cmd(arm, -1), 0);
  read(200);
  EXPECT_NEAR(position(0), kPi / 6, kFloat);
  EXPECT_NEAR(position(1), 0.02, kFloat);
  EXPECT_EQ(playerc_actarray_current_cmd(arm, 1, 0.5F), 0);
  read(2);
  EXPECT_NEAR(playerc_actarray_get_actuator_data(arm, 1).current, 0.5, kFloat);
  float currents[] = {0.1F, -0.1F};
  EXPECT_EQ(playerc_actarray_multi_current_cmd(arm, currents, 2), 0);
  read(2);
  EXPECT_NEAR(playerc_actarray_get_actuator_data(arm, 0).current, 0.1, kFloat);
  EXPECT_EQ(playerc_actarray_brakes(arm, 1), 0);
  EXPECT_EQ(playerc_actarray_power(arm, 0), 0);
  read(1);
  EXPECT_EQ(playerc_actarray_get_actuator_data(arm, 0).state, PLAYER_ACTARRAY_ACTSTATE_BRAKED);
  EXPECT_EQ(arm->motor_state, 0);
}

TEST_F(CArm, Errors_Reported) {
  subscribe();
  EXPECT_EQ(playerc_actarray_speed_config(arm_.get(), 2, 0.1F), -1);
  EXPECT_EQ(playerc_actarray_accel_config(arm_.get(), 0, 0.0F), -1);
  EXPECT_EQ(playerc_actarray_multi_position_cmd(arm_.get(), nullptr, 2), -1);
  float none[] = {0.0F};
  EXPECT_EQ(playerc_actarray_multi_speed_cmd(arm_.get(), none, -1), -1);
  EXPECT_EQ(playerc_actarray_get_geom(nullptr), -1);
  EXPECT_EQ(playerc_actarray_get_actuator_data(nullptr, 0).state, 0);
  EXPECT_EQ(playerc_actarray_get_actuator_geom(nullptr, 0).type, 0);
  // As with the proxy, a command to a joint that does not exist has no effect.
  EXPECT_EQ(playerc_actarray_position_cmd(arm_.get(), 9, 0.1F), 0);
}

}  // namespace
