// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <ostream>

#include "devices/errors.h"
#include "libplayerc++/position2dproxy.h"
#include "proxies/goal_driver.h"
#include "proxies/link.h"
#include "sim/devices/localization.h"

namespace PlayerCc {

using playerlike::require_finite;
using playerlike::SessionError;
using playerlike::translated;

namespace {

// Speed for each metre (or radian) that is missing. A command holds for a whole period of the
// readings, so the gain is kept below kGainPerPeriod a period: then what is missing at least
// halves... and never changes its sign.
constexpr double kGain_per_s = 2.0;
constexpr double kGainPerPeriod = 0.5;
// Headings further off than this are turned to on the spot before driving on.
constexpr double kTurnOnSpot_rad = 0.5;
constexpr double kArrived_m = 0.01;
constexpr double kAligned_rad = 0.01;
// A robot that was pushed away from its goal by more than this drives there again.
constexpr double kLost_m = 3.0 * kArrived_m;

}  // namespace

// Speed control that this library does for the robot, a step for each reading.
struct Position2dProxy::Control {
  enum class Mode { kNone, kHeading, kGoTo };
  Mode mode = Mode::kNone;
  bool has_reading = false;
  double gain_per_s = kGain_per_s;
  double robot_speed_mps = 0.0;  // the robot's own limits
  double robot_turn_rate_radps = 0.0;
  double length_m = 0.0;
  // kHeading
  double forward_mps = 0.0;
  // kGoTo
  player_pose2d_t goal = {0.0, 0.0, 0.0};
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  bool aligning = false;  // arrived, turning to the goal's heading

  // Of an index that a driver offers: who takes the goals. What else the program commands ends
  // its pursuit.
  std::shared_ptr<playerlike::GoalDriver> driver;

  void stop_pursuit() {
    mode = Mode::kNone;
    if (driver != nullptr) driver->cancel();
  }

  [[nodiscard]] double turn(double error_rad, double limit_radps) const {
    return std::clamp(gain_per_s * error_rad, -limit_radps, limit_radps);
  }

  // Speeds (forward, turning) for where the robot is; ends the mode when the goal is reached.
  [[nodiscard]] sim::Twist step(const player_pose2d_t& at) {
    if (mode == Mode::kHeading) {
      return {forward_mps, turn(sim::normalize_angle(goal.pa - at.pa), robot_turn_rate_radps)};
    }
    const double dx_m = goal.px - at.px;
    const double dy_m = goal.py - at.py;
    const double distance_m = std::hypot(dx_m, dy_m);
    aligning = distance_m <= (aligning ? kLost_m : kArrived_m);
    if (aligning) {
      const double error_rad = sim::normalize_angle(goal.pa - at.pa);
      if (std::abs(error_rad) > kAligned_rad) return {0.0, turn(error_rad, turn_rate_radps)};
      mode = Mode::kNone;
      return {};
    }
    const double bearing_rad = sim::normalize_angle(std::atan2(dy_m, dx_m) - at.pa);
    const double turning_radps = turn(bearing_rad, turn_rate_radps);
    if (std::abs(bearing_rad) > kTurnOnSpot_rad) return {0.0, turning_radps};
    return {std::min(speed_mps, gain_per_s * distance_m * std::cos(bearing_rad)), turning_radps};
  }
};

Position2dProxy::Position2dProxy(PlayerClient* aPc, uint32_t aIndex)
    : ClientProxy(aPc, aIndex), mData(), mControl(std::make_unique<Control>()) {
  Position2dProxy::Subscribe(aIndex);
}

Position2dProxy::~Position2dProxy() { Position2dProxy::Unsubscribe(); }

void Position2dProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "Position2dProxy::Position2dProxy";
  Attach(PLAYER_POSITION2D_CODE, aIndex, fun);
  if (mLink->binding.driver != nullptr) {
    mControl->driver = translated(
        fun, [&] { return playerlike::share_driver(mLink->core->session(), mLink->binding); });
  }
  const scoped_lock_t lock(LockData(fun));
  const playerlike::RobotInfo& robot = mLink->robot();
  mControl->length_m = robot.length_m;
  mControl->robot_speed_mps = robot.max_speed_mps;
  mControl->robot_turn_rate_radps = robot.max_turn_rate_radps;
  if (mLink->binding.motion) {
    const auto& limits = mLink->core->info_of(*mLink->binding.motion).properties;
    const auto tighten = [&](const char* name, double& value) {
      const auto it = limits.find(name);
      if (it != limits.end()) value = std::min(value, it->second);
    };
    tighten("max_speed", mControl->robot_speed_mps);
    tighten("max_turn_rate", mControl->robot_turn_rate_radps);
  }
  mControl->gain_per_s = std::min(kGain_per_s, kGainPerPeriod * mLink->property("frequency", 1.0));
}

void Position2dProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void Position2dProxy::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::PoseReading*>(&aReading);
  if (reading == nullptr) return;
  mData.pos = {reading->pose.x_m, reading->pose.y_m, reading->pose.yaw_rad};
  mData.vel = {reading->twist.v_mps, reading->twist.lateral_mps, reading->twist.omega_radps};
  mData.stall = reading->stalled ? 1 : 0;
  mControl->has_reading = true;
  mLink->core->note_pose(mLink->binding.robot, reading->pose, mLink->info().type == "pose");
}

void Position2dProxy::HandleRound() {
  if (mControl->mode == Control::Mode::kNone) return;
  const sim::Twist twist = mControl->step(mData.pos);
  Send(twist.v_mps, twist.omega_radps, "Position2dProxy::HandleRound");
}

bool Position2dProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  switch (aType) {
    case PLAYER_MSGTYPE_DATA:
      return aSubtype == PLAYER_POSITION2D_DATA_STATE;
    case PLAYER_MSGTYPE_CMD:
      return mLink->binding.motion.has_value() &&
             (aSubtype == PLAYER_POSITION2D_CMD_VEL || aSubtype == PLAYER_POSITION2D_CMD_POS ||
              aSubtype == PLAYER_POSITION2D_CMD_CAR || aSubtype == PLAYER_POSITION2D_CMD_VEL_HEAD);
    case PLAYER_MSGTYPE_REQ:
      return aSubtype == PLAYER_POSITION2D_REQ_GET_GEOM ||
             aSubtype == PLAYER_POSITION2D_REQ_SET_ODOM ||
             aSubtype == PLAYER_POSITION2D_REQ_RESET_ODOM ||
             (aSubtype == PLAYER_POSITION2D_REQ_MOTOR_POWER && mLink->binding.motion.has_value());
    default:
      return false;
  }
}

// With the client's mutex held.
void Position2dProxy::Send(double aXSpeed, double aYawSpeed, const char* aFun) {
  translated(aFun, [&] {
    const auto& motion = mLink->binding.motion;
    if (!motion) {
      throw SessionError(SessionError::Code::kNotAvailable,
                         "robot " + mLink->robot().name +
                             " has no motors (a device of type \"motion\") in this world");
    }
    mLink->core->session().send(*motion, sim::TwistCommand{{aXSpeed, aYawSpeed}});
  });
}

void Position2dProxy::Drive(double aXSpeed, double aYawSpeed, const char* aFun) {
  const scoped_lock_t lock(LockData(aFun));
  mControl->stop_pursuit();
  Send(aXSpeed, aYawSpeed, aFun);
}

void Position2dProxy::SetSpeed(double aXSpeed, double aYSpeed, double aYawSpeed) {
  const char* fun = "Position2dProxy::SetSpeed";
  require_finite(fun, {{"the forward speed", aXSpeed},
                       {"the sideways speed", aYSpeed},
                       {"the turn rate", aYawSpeed}});
  Drive(aXSpeed, aYawSpeed, fun);
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
  const scoped_lock_t lock(LockData(fun));
  mControl->stop_pursuit();
  mControl->mode = Control::Mode::kHeading;
  mControl->forward_mps = aXSpeed;
  mControl->goal = {0.0, 0.0, sim::normalize_angle(aYawHead)};
  // Without a reading the heading is not known yet: the first one sets the robot going.
  if (mControl->has_reading) HandleRound();
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
  const scoped_lock_t lock(LockData(fun));
  const auto limited = [](double wish, double robot) {
    return wish == 0.0 ? robot : std::min(std::abs(wish), robot);
  };
  mControl->goal = {pos.px, pos.py, sim::normalize_angle(pos.pa)};
  mControl->speed_mps = limited(vel.px, mControl->robot_speed_mps);
  mControl->turn_rate_radps = limited(vel.pa, mControl->robot_turn_rate_radps);
  if (mControl->driver != nullptr) {
    mControl->mode = Control::Mode::kNone;
    mControl->driver->go_to(
        {{pos.px, pos.py}, mControl->goal.pa, mControl->speed_mps, mControl->turn_rate_radps});
    return;
  }
  mControl->mode = Control::Mode::kGoTo;
  mControl->aligning = false;
  if (mControl->has_reading) HandleRound();
}

void Position2dProxy::GoTo(player_pose2d_t pos) { GoTo(pos, {0.0, 0.0, 0.0}); }

void Position2dProxy::GoTo(double aX, double aY, double aYaw) {
  GoTo({aX, aY, aYaw}, {0.0, 0.0, 0.0});
}

void Position2dProxy::SetCarlike(double aXSpeed, double aDriveAngle) {
  const char* fun = "Position2dProxy::SetCarlike";
  require_finite(fun, {{"the forward speed", aXSpeed}, {"the steering angle", aDriveAngle}});
  if (!(std::abs(aDriveAngle) < M_PI / 2.0)) {
    throw PlayerError(
        fun,
        "the steering angle must be between -pi/2 and pi/2, but is " + std::to_string(aDriveAngle),
        PlayerError::kBadArgument);
  }
  // Kinematics of a bicycle: a wheelbase L that steers by d turns at v tan(d) / L.
  Drive(aXSpeed, aXSpeed * std::tan(aDriveAngle) / mControl->length_m, fun);
}

void Position2dProxy::RequestGeom() {
  const scoped_lock_t lock(LockData("Position2dProxy::RequestGeom"));
}

player_pose3d_t Position2dProxy::GetOffset() {
  const scoped_lock_t lock(LockData("Position2dProxy::GetOffset"));
  return {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
}

player_bbox3d_t Position2dProxy::GetSize() {
  const scoped_lock_t lock(LockData("Position2dProxy::GetSize"));
  const playerlike::RobotInfo& robot = mLink->robot();
  return {robot.width_m, robot.length_m, robot.height_m};
}

void Position2dProxy::SetMotorEnable(bool enable) {
  const char* fun = "Position2dProxy::SetMotorEnable";
  const scoped_lock_t lock(LockData(fun));
  if (!enable) {
    mControl->stop_pursuit();
    // Else the driver's last speeds would go on when the motors are on again before the next step.
    if (mControl->driver != nullptr) Send(0.0, 0.0, fun);
  }
  translated(fun, [&] {
    const auto& motion = mLink->binding.motion;
    if (!motion) {
      throw SessionError(SessionError::Code::kNotAvailable,
                         "robot " + mLink->robot().name +
                             " has no motors (a device of type \"motion\") in this world");
    }
    mLink->core->session().send(*motion, sim::MotorEnableCommand{enable});
  });
}

void Position2dProxy::ResetOdometry() { SetOdometry(0.0, 0.0, 0.0); }

void Position2dProxy::SetOdometry(double aX, double aY, double aYaw) {
  const char* fun = "Position2dProxy::SetOdometry";
  require_finite(fun, {{"x", aX}, {"y", aY}, {"the heading", aYaw}});
  const scoped_lock_t lock(LockData(fun));
  translated(fun, [&] {
    mLink->core->session().send(mLink->binding.reading,
                                sim::SetPoseCommand{{aX, aY, sim::normalize_angle(aYaw)}});
  });
}

double Position2dProxy::GetXPos() const { return GetVar(mData.pos.px); }
double Position2dProxy::GetYPos() const { return GetVar(mData.pos.py); }
double Position2dProxy::GetYaw() const { return GetVar(mData.pos.pa); }
double Position2dProxy::GetXSpeed() const { return GetVar(mData.vel.px); }
double Position2dProxy::GetYSpeed() const { return GetVar(mData.vel.py); }
double Position2dProxy::GetYawSpeed() const { return GetVar(mData.vel.pa); }
bool Position2dProxy::GetStall() const { return GetVar(mData.stall) != 0; }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::Position2dProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#x [m]\ty [m]\tyaw [rad]\tvx [m/s]\tvy [m/s]\tvyaw [rad/s]\tstall\n"
            << c.GetXPos() << '\t' << c.GetYPos() << '\t' << c.GetYaw() << '\t' << c.GetXSpeed()
            << '\t' << c.GetYSpeed() << '\t' << c.GetYawSpeed() << '\t' << c.GetStall() << '\n';
}

}  // namespace std
