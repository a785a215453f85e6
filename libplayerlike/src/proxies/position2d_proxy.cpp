// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <ostream>

#include "core/errors.h"
#include "libplayerc++/position2dproxy.h"
#include "proxies/goal_driver.h"
#include "proxies/link.h"
#include "session/player_values/position2d.h"

namespace PlayerCc {

using playerlike::require_finite;
using playerlike::translated;
using sim::PoseReading;

namespace {

// In the order of Position2dProxy::Numbers.
std::array<double, 8> numbers_of(const PoseReading& reading) {
  const sim::Pose& pose = reading.pose;
  const sim::Twist& twist = reading.twist;
  return {0.0,         pose.x_m,          pose.y_m,          pose.yaw_rad,
          twist.v_mps, twist.lateral_mps, twist.omega_radps, reading.stalled ? 1.0 : 0.0};
}

}  // namespace

struct Position2dProxy::Control {
  // Limits of the robot's motors, for drivers.
  double robot_speed_mps = 0.0;
  double robot_turn_rate_radps = 0.0;

  // The driver that pursues goals, if this index belongs to one. Other commands of the program
  // cancel its goal.
  std::shared_ptr<playerlike::GoalDriver> driver;

  // The caller holds the client's mutex.
  static void send(Position2dProxy& proxy, const sim::Command& command, const char* fun) {
    const auto& link = *proxy.mLink;
    translated(fun, [&] {
      const auto& motion = link.binding.motion;
      if (!motion) throw playerlike::no_motors(link.robot());
      link.core->send(fun, *motion, command);
    });
  }

  // The frame of the proxy's readings, as a command field.
  static int frame(const Position2dProxy& proxy) { return proxy.mLink->binding.reading.device; }

  // Sends a command that moves the robot; cancels the driver's goal.
  static void drive(Position2dProxy& proxy, const sim::Command& command, const char* fun) {
    const scoped_lock_t lock(proxy.mLink->lock_for_command(fun));
    if (proxy.mControl->driver != nullptr) proxy.mControl->driver->cancel();
    send(proxy, command, fun);
  }
};

Position2dProxy::Position2dProxy(PlayerClient* aPc, uint32_t aIndex)
    : ClientProxy(aPc, aIndex), mControl(std::make_unique<Control>()) {
  const char* fun = "Position2dProxy::Position2dProxy";
  Attach(PLAYER_POSITION2D_CODE, aIndex, fun);
  if (mLink->binding.driver != nullptr) {
    mControl->driver = translated(
        fun, [&] { return playerlike::share_driver(mLink->core->session(), mLink->binding); });
  }
  const scoped_lock_t lock(LockData(fun));
  const playerlike::RobotInfo& robot = mLink->robot();
  const auto limits = mLink->binding.motion ? mLink->core->speed_limits(*mLink->binding.motion)
                                            : playerlike::ClientCore::SpeedLimits{
                                                  robot.max_speed_mps, robot.max_turn_rate_radps};
  mControl->robot_speed_mps = limits.speed_mps;
  mControl->robot_turn_rate_radps = limits.turn_rate_radps;
}

Position2dProxy::Position2dProxy(const Position2dProxy& aOther)
    : ClientProxy(aOther), mControl(std::make_unique<Control>(*aOther.mControl)) {
  const scoped_lock_t lock(mLink->core->mutex());
  ShowNumbers();
}

Position2dProxy::~Position2dProxy() { ClientProxy::Unsubscribe(); }

void Position2dProxy::HandleReading(const playerlike::NewReading& aNew) {
  const auto* reading = playerlike::reading_as<PoseReading>(*aNew.reading);
  if (reading == nullptr) return;
  mLink->core->note_pose(mLink->binding.robot, reading->pose, mLink->info().type == "pose");
  mLink->newest.reading = aNew.reading;
  ShowNumbers();
}

// The caller holds the client's mutex.
void Position2dProxy::ShowNumbers() {
  const auto* reading = mLink->newest.find<PoseReading>();
  const std::size_t view = mElements.ViewToShow();
  if (reading == nullptr || view == detail::Elements::kViews) return;
  const auto numbers = numbers_of(*reading);
  static_assert(numbers.size() == kNumberCount);
  std::ranges::copy(numbers, mNumbers[view]);
  mElements.Show(nullptr, mNumbers[view], kNumberCount);
}

void Position2dProxy::SetSpeed(double aXSpeed, double aYSpeed, double aYawSpeed) {
  const char* fun = "Position2dProxy::SetSpeed";
  require_finite(fun, {{"the forward speed", aXSpeed},
                       {"the sideways speed", aYSpeed},
                       {"the turn rate", aYawSpeed}});
  Control::drive(
      *this,
      sim::TwistCommand{{.v_mps = aXSpeed, .omega_radps = aYawSpeed, .lateral_mps = aYSpeed}}, fun);
}

void Position2dProxy::SetSpeed(double aXSpeed, double aYawSpeed) {
  SetSpeed(aXSpeed, 0.0, aYawSpeed);
}

void Position2dProxy::SetSpeed(player_pose2d_t vel) { SetSpeed(vel.px, vel.py, vel.pa); }

void Position2dProxy::SetVelHead(double aXSpeed, double aYSpeed, double aYawHead) {
  const char* fun = "Position2dProxy::SetVelHead";
  require_finite(
      fun,
      {{"the forward speed", aXSpeed}, {"the sideways speed", aYSpeed}, {"the heading", aYawHead}});
  Control::drive(
      *this,
      sim::HeadingCommand{aXSpeed, aYSpeed, sim::normalize_angle(aYawHead), Control::frame(*this)},
      fun);
}

void Position2dProxy::SetVelHead(double aXSpeed, double aYawHead) {
  SetVelHead(aXSpeed, 0.0, aYawHead);
}

void Position2dProxy::GoTo(player_pose2d_t pos, player_pose2d_t vel) {
  const char* fun = "Position2dProxy::GoTo";
  require_finite(fun, {{"the goal's x", pos.px},
                       {"the goal's y", pos.py},
                       {"the goal's heading", pos.pa},
                       {"the forward speed", vel.px},
                       {"the sideways speed", vel.py},
                       {"the turn rate", vel.pa}});
  if (mControl->driver != nullptr) {
    const scoped_lock_t lock(LockData(fun));
    return mControl->driver->go_to(playerlike::driver_goal(pos, vel, mControl->robot_speed_mps,
                                                           mControl->robot_turn_rate_radps));
  }
  Control::drive(*this, playerlike::position_command(pos, vel, Control::frame(*this)), fun);
}

void Position2dProxy::GoTo(player_pose2d_t pos) { GoTo(pos, {0.0, 0.0, 0.0}); }

void Position2dProxy::GoTo(double aX, double aY, double aYaw) {
  GoTo({aX, aY, aYaw}, {0.0, 0.0, 0.0});
}

void Position2dProxy::SetCarlike(double aXSpeed, double aDriveAngle) {
  const char* fun = "Position2dProxy::SetCarlike";
  require_finite(fun, {{"the forward speed", aXSpeed}, {"the steering angle", aDriveAngle}});
  Control::drive(*this, sim::CarCommand{aXSpeed, aDriveAngle}, fun);
}

void Position2dProxy::RequestGeom() {
  const scoped_lock_t lock(LockData("Position2dProxy::RequestGeom"));
}

player_pose3d_t Position2dProxy::GetOffset() {
  const scoped_lock_t lock(LockData("Position2dProxy::GetOffset"));
  return playerlike::center_of<player_pose3d_t>(mLink->robot());
}

player_pose3d_t Position2dProxy::GetPose() { return GetOffset(); }

player_bbox3d_t Position2dProxy::GetSize() {
  const scoped_lock_t lock(LockData("Position2dProxy::GetSize"));
  return playerlike::to_players<player_bbox3d_t>(mLink->robot());
}

void Position2dProxy::SetMotorEnable(bool enable) {
  const char* fun = "Position2dProxy::SetMotorEnable";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  if (!enable && mControl->driver != nullptr) {
    mControl->driver->cancel();
    // Otherwise the driver's last speeds would apply again if the motors are re-enabled before the
    // next step.
    Control::send(*this, sim::TwistCommand{}, fun);
  }
  Control::send(*this, sim::MotorEnableCommand{enable}, fun);
}

void Position2dProxy::ResetOdometry() { SetOdometry(0.0, 0.0, 0.0); }

void Position2dProxy::SetOdometry(double aX, double aY, double aYaw) {
  const char* fun = "Position2dProxy::SetOdometry";
  require_finite(fun, {{"x", aX}, {"y", aY}, {"the heading", aYaw}});
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  mLink->send(fun, sim::SetPoseCommand{{aX, aY, sim::normalize_angle(aYaw)}});
}

double Position2dProxy::LockedNumber(Numbers aNumber) const {
  const scoped_lock_t lock(mLink->lock_element("ClientProxy"));
  return numbers_of(mLink->newest.as<PoseReading>())[aNumber];
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::Position2dProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#x [m]\ty [m]\tyaw [rad]\tvx [m/s]\tvy [m/s]\tvyaw [rad/s]\tstall\n"
            << c.GetXPos() << '\t' << c.GetYPos() << '\t' << c.GetYaw() << '\t' << c.GetXSpeed()
            << '\t' << c.GetYSpeed() << '\t' << c.GetYawSpeed() << '\t' << c.GetStall() << '\n';
}

}  // namespace std
