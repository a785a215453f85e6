// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The fields of all commands. A new command needs a table here and a name at the end.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/devices/actarray.h"
#include "sim/devices/aio.h"
#include "sim/devices/builtin.h"
#include "sim/devices/dio.h"
#include "sim/navigation/particles.h"

namespace sim {
namespace {

constexpr const char* kGripActions[] = {"open", "close", "stop", "store", "retrieve"};

constexpr const char* kJointModes[] = {"position", "speed", "current", "home", "place"};
constexpr const char* kJointSettings[] = {"power", "brakes", "speed", "acceleration"};

constexpr Field kTwist[] = {
    field<&TwistCommand::twist, &Twist::v_mps>("v", "m/s"),
    field<&TwistCommand::twist, &Twist::omega_radps>("omega", "rad/s"),
    field<&TwistCommand::twist, &Twist::lateral_mps>("lateral", "m/s").or_default(),
};
constexpr Field kMotorEnable[] = {
    field<&MotorEnableCommand::enabled>("on"),
};
constexpr Field kSetPose[] = {
    field<&SetPoseCommand::pose>("", "m, rad"),
    field<&SetPoseCommand::variance>("variance", "m^2, m^2, rad^2").or_default(),
    field<&SetPoseCommand::covariance>("covariance", "m^2, m rad, m rad").or_default(),
};
constexpr Field kGoto[] = {
    field<&GotoCommand::goal_m>("", "m"),
    field<&GotoCommand::tolerance_m>("tolerance", "m"),
    field<&GotoCommand::speed_mps>("speed", "m/s"),
    field<&GotoCommand::z_m>("z", "m"),
};
constexpr Field kPlace[] = {
    field<&PlaceCommand::pose>("", "m, rad"),
    field<&PlaceCommand::z_m>("z", "m"),
    field<&PlaceCommand::roll_rad>("roll", "rad"),
    field<&PlaceCommand::pitch_rad>("pitch", "rad"),
};
constexpr Field kTranslate[] = {
    field<&TranslateCommand::offset_m>("", "m"),
};
constexpr Field kRotate[] = {
    field<&RotateCommand::yaw_rad>("yaw", "rad"),
};
constexpr Field kOrient[] = {
    field<&OrientCommand::roll_rad>("roll", "rad"),
    field<&OrientCommand::pitch_rad>("pitch", "rad"),
    field<&OrientCommand::yaw_rad>("yaw", "rad"),
};
constexpr Field kTrack[] = {
    field<&TrackCommand::range_m>("range", "m"),
    field<&TrackCommand::tag>("tag"),
};
constexpr Field kHeading[] = {
    field<&HeadingCommand::v_mps>("v", "m/s"),
    field<&HeadingCommand::lateral_mps>("lateral", "m/s").or_default(),
    field<&HeadingCommand::yaw_rad>("yaw", "rad"),
    field<&HeadingCommand::frame>("frame"),
};
constexpr Field kPosition[] = {
    field<&PositionCommand::goal>("", "m, rad"),
    field<&PositionCommand::max_speed_mps>("max_speed", "m/s"),
    field<&PositionCommand::max_turn_rate_radps>("max_turn_rate", "rad/s"),
    field<&PositionCommand::frame>("frame"),
};
constexpr Field kCar[] = {
    field<&CarCommand::v_mps>("v", "m/s"),
    field<&CarCommand::steering_rad>("steering", "rad"),
};
constexpr Field kSay[] = {
    field<&SayCommand::text>("text"),
};
constexpr Field kDigitalOutput[] = {
    field<&DigitalOutputCommand::count>("count").within(0, DioParams::kMaxLines),
    field<&DigitalOutputCommand::bits>("outputs"),
};
constexpr Field kAnalogOutput[] = {
    field<&AnalogOutputCommand::channel>("output").within(0, AioParams::kMaxLines - 1),
    field<&AnalogOutputCommand::voltage_v>("voltage", "V"),
};
constexpr Field kLight[] = {
    field<&LightCommand::enabled>("on"),
    field<&LightCommand::colour>("colour"),
    field<&LightCommand::period_s>("period", "s"),
    field<&LightCommand::duty_cycle>("duty_cycle"),
};
constexpr Field kGrip[] = {
    field<&GripCommand::action>("action").one_of(kGripActions),
};
constexpr Field kOpaque[] = {
    field<&OpaqueCommand::data>("data"),
};
constexpr Field kPoint[] = {
    field<&PointCommand::pan_rad>("pan", "rad"),
    field<&PointCommand::tilt_rad>("tilt", "rad"),
    field<&PointCommand::view_rad>("view", "rad"),
    field<&PointCommand::pan_speed_radps>("pan_speed", "rad/s"),
    field<&PointCommand::tilt_speed_radps>("tilt_speed", "rad/s"),
};
constexpr Field kPan[] = {
    field<&PanCommand::pan_speed_radps>("pan_speed", "rad/s"),
    field<&PanCommand::tilt_speed_radps>("tilt_speed", "rad/s"),
    field<&PanCommand::zoom_speed_radps>("zoom_speed", "rad/s"),
};
constexpr Field kJoint[] = {
    field<&JointCommand::mode>("mode").one_of(kJointModes),
    field<&JointCommand::joint>("joint").within(-1, ActArrayParams::kMaxJoints - 1),
    field<&JointCommand::values>("values", "m or rad, per second, A"),
};
constexpr Field kJointSetting[] = {
    field<&JointSettingCommand::setting>("setting").one_of(kJointSettings),
    field<&JointSettingCommand::joint>("joint").within(-1, ActArrayParams::kMaxJoints - 1),
    field<&JointSettingCommand::value>("value"),
};
constexpr Field kTrajectory[] = {
    field<&TrajectoryCommand::start_s>("start", "s"),
    field<&TrajectoryCommand::times_s>("times", "s"),
    field<&TrajectoryCommand::positions>("positions", "m or rad"),
};

}  // namespace

std::optional<std::string> fault_of(const SetPoseCommand& command) {
  const Pose& pose = command.pose;
  const bool within_reach =
      std::abs(pose.x_m) <= kFarthestPose && std::abs(pose.y_m) <= kFarthestPose;
  if (!within_reach || !std::isfinite(pose.yaw_rad)) {
    return "a pose must have finite numbers, and x and y at most 1e9 m from 0";
  }
  if (!command.variance) return std::nullopt;
  const PoseCovariance covariance{*command.variance,
                                  command.covariance.value_or(std::array<double, 3>{})};
  const auto is_too_large = [](double number) { return number > kFarthestPose * kFarthestPose; };
  if (std::ranges::any_of(covariance.variance, is_too_large)) {
    return "a standard deviation of a pose must be at most 1e9 m or rad";
  }
  if (!is_valid(covariance)) return "a covariance must be finite and positive semidefinite";
  return std::nullopt;
}

SIM_FIELDS(TwistCommand, kTwist)
SIM_FIELDS(MotorEnableCommand, kMotorEnable)
SIM_FIELDS(SetPoseCommand, kSetPose)
SIM_FIELDS(GotoCommand, kGoto)
SIM_FIELDS(PlaceCommand, kPlace)
SIM_FIELDS(TranslateCommand, kTranslate)
SIM_FIELDS(RotateCommand, kRotate)
SIM_FIELDS(OrientCommand, kOrient)
SIM_FIELDS(TrackCommand, kTrack)
SIM_FIELDS(HeadingCommand, kHeading)
SIM_FIELDS(PositionCommand, kPosition)
SIM_FIELDS(CarCommand, kCar)
SIM_FIELDS(SayCommand, kSay)
SIM_FIELDS(DigitalOutputCommand, kDigitalOutput)
SIM_FIELDS(AnalogOutputCommand, kAnalogOutput)
SIM_FIELDS(LightCommand, kLight)
SIM_FIELDS(GripCommand, kGrip)
SIM_FIELDS(OpaqueCommand, kOpaque)
SIM_FIELDS(PointCommand, kPoint)
SIM_FIELDS(PanCommand, kPan)
SIM_FIELDS(JointCommand, kJoint)
SIM_FIELDS(JointSettingCommand, kJointSetting)
SIM_FIELDS(TrajectoryCommand, kTrajectory)
SIM_FIELDS(StopCommand, {})
SIM_FIELDS(ResumeCommand, {})

std::span<const AlternativeKind<Command>> command_kinds() {
  static constexpr auto kKinds = alternative_kinds<Command>(
      {"twist",         "motors", "set_pose", "goto",      "stop",  "resume", "place",
       "translate",     "rotate", "heading",  "position",  "car",   "say",    "digital",
       "analog",        "light",  "grip",     "opaque",    "point", "pan",    "joints",
       "joint_setting", "orient", "track",    "trajectory"});
  return kKinds;
}

}  // namespace sim
