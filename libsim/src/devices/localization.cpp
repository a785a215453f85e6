// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/localization.h"

#include <cmath>

#include "devices/device_kind.h"
#include "devices/modifiers.h"
#include "sim/core/degrees.h"
#include "sim/core/math.h"
#include "sim/devices/motion.h"

namespace sim {
namespace {

void add_noise(RandomStream& noise, double length_m, double angle_rad, Elevation& elevation) {
  elevation.z_m += noise.gaussian(length_m);
  elevation.roll_rad = normalize_angle(elevation.roll_rad + noise.gaussian(angle_rad));
  elevation.pitch_rad = normalize_angle(elevation.pitch_rad + noise.gaussian(angle_rad));
}

double sinc(double x) { return std::abs(x) < 1e-8 ? 1.0 : math::sin(x) / x; }

}  // namespace

PoseSensor::PoseSensor(std::string name, const PoseParams& params, const Pose& X_WB_start,
                       RandomStream noise)
    : SensorOf(std::move(name), "pose", params.frequency_hz, params.latency_s),
      params_(params),
      mounting_(params),
      noise_(std::move(noise)),
      X_WB_(X_WB_start) {}

std::optional<std::string> PoseSensor::connect(std::string_view robot,
                                               const DeviceDirectory& devices) {
  return mounting_.connect(robot, devices);
}

std::optional<std::string> PoseSensor::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  if (auto fault = fault_of(*set)) return fault;
  X_FW_ = set->pose * X_WB_.inverse();
  return std::nullopt;
}

void PoseSensor::integrate(const StepContext& context) { X_WB_ = context.body.X_WB; }

void PoseSensor::measure(const StepContext& context) {
  auto& reading = next(context);
  // While the frame has not been set, the true pose passes unchanged, to the bit.
  Pose X_WS = X_WB_;
  reading.elevation = context.body.elevation;
  if (!mounting_.is_trivial()) {
    const Eigen::Isometry3d place = mounting_.in_world(context.body);
    const EulerAngles angles = euler_angles_of(place.linear());
    X_WS = {place.translation().x(), place.translation().y(), angles.yaw_rad};
    reading.elevation = {place.translation().z(), angles.roll_rad, angles.pitch_rad};
  }
  reading.pose = X_FW_ == Pose{} ? X_WS : X_FW_ * X_WS;
  if (params_.noise_m > 0.0) {
    reading.pose.x_m += noise_.gaussian(params_.noise_m);
    reading.pose.y_m += noise_.gaussian(params_.noise_m);
  }
  if (params_.noise_yaw_rad > 0.0) {
    reading.pose.yaw_rad =
        normalize_angle(reading.pose.yaw_rad + noise_.gaussian(params_.noise_yaw_rad));
  }
  if (params_.noise_in_space) {
    add_noise(noise_, params_.noise_m, params_.noise_yaw_rad, reading.elevation);
  }
  reading.twist = context.body.twist;
  reading.stalled = context.body.stalled;
}

void PoseSensor::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_, X_WB_, X_FW_);
}

Odometry::Odometry(std::string name, const OdometryParams& params, double wheel_separation_m,
                   bool omnidirectional, std::string motors, RandomStream noise)
    : SensorOf(std::move(name), "odometry", params.frequency_hz, params.latency_s),
      params_(params),
      wheel_separation_m_(wheel_separation_m),
      omnidirectional_(omnidirectional),
      has_errors_(params.noise > 0.0 || params.wheel_ratio != 1.0 ||
                  params.wheelbase_ratio != 1.0 || params.scale != 1.0 ||
                  params.side_scale != 1.0 || params.heading_drift_radps != 0.0 ||
                  params.scale_noise > 0.0 || params.heading_noise_rad > 0.0),
      motors_(std::move(motors)),
      X_SB_(params.start),
      noise_(std::move(noise)),
      X_SR_(params.start) {
  draw_scale();
}

void Odometry::draw_scale() {
  present_scale_ = params_.scale + noise_.gaussian(params_.scale_noise);
}

std::optional<std::string> Odometry::connect(std::string_view robot,
                                             const DeviceDirectory& devices) {
  if (motors_.empty()) return std::nullopt;
  const auto* motors = dynamic_cast<const Motion*>(devices.find(robot, motors_));
  slipping_motors_ = motors != nullptr && motors->slips() ? motors : nullptr;
  return std::nullopt;
}

std::optional<std::string> Odometry::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  if (auto fault = fault_of(*set)) return fault;
  const Pose X_BR = X_SB_.inverse() * X_SR_;
  X_SB_ = set->pose;
  X_SB_.yaw_rad = normalize_angle(X_SB_.yaw_rad);
  X_SR_ = X_SB_ * X_BR;
  return std::nullopt;
}

Odometry::WheelPath Odometry::turned(const BodyState& body) const {
  WheelPath path{body.travel_m, omnidirectional_ ? body.side_m : 0.0, body.turn_rad};
  if (slipping_motors_ == nullptr) return path;
  const WheelSlip slip = slipping_motors_->slip();
  const double half_m = 0.5 * wheel_separation_m_;
  const double left_m = (path.ds_m - half_m * path.dyaw_rad) / (1.0 - slip.left);
  const double right_m = (path.ds_m + half_m * path.dyaw_rad) / (1.0 - slip.right);
  return {0.5 * (left_m + right_m), path.side_m / (1.0 - slip.side),
          (right_m - left_m) / wheel_separation_m_};
}

void Odometry::add_errors(double dt_s, WheelPath& path) {
  const double half_m = 0.5 * wheel_separation_m_;
  double left_m = (path.ds_m - half_m * path.dyaw_rad) * (0.5 * (params_.wheel_ratio + 1.0));
  double right_m = (path.ds_m + half_m * path.dyaw_rad) * (0.5 * (1.0 / params_.wheel_ratio + 1.0));
  left_m += noise_.gaussian(params_.noise * std::sqrt(std::abs(left_m)));
  right_m += noise_.gaussian(params_.noise * std::sqrt(std::abs(right_m)));
  path.ds_m = 0.5 * (left_m + right_m) * present_scale_;
  path.dyaw_rad = (right_m - left_m) / wheel_separation_m_ * params_.wheelbase_ratio;
  if (omnidirectional_) {
    path.side_m += noise_.gaussian(params_.noise * std::sqrt(std::abs(path.side_m)));
    path.side_m *= present_scale_ * params_.side_scale;
  }
  path.dyaw_rad += params_.heading_drift_radps * dt_s;
  path.dyaw_rad += noise_.gaussian(params_.heading_noise_rad * std::sqrt(dt_s));
}

void Odometry::integrate(const StepContext& context) {
  WheelPath path = turned(context.body);
  if (has_errors_) add_errors(to_seconds(context.world.simulation.step_ns), path);
  const auto& [ds_m, side_m, dyaw_rad] = path;
  if (ds_m == 0.0 && dyaw_rad == 0.0 && side_m == 0.0) return;
  const auto [s, c] = math::sin_cos(X_SB_.yaw_rad + 0.5 * dyaw_rad);
  const double chord_m = ds_m * sinc(0.5 * dyaw_rad);
  const double side_chord_m = side_m * sinc(0.5 * dyaw_rad);
  X_SB_ = {X_SB_.x_m + chord_m * c - side_chord_m * s, X_SB_.y_m + chord_m * s + side_chord_m * c,
           normalize_angle(X_SB_.yaw_rad + dyaw_rad)};
  path_length_m_ += side_m == 0.0 ? std::abs(ds_m) : math::hypot(ds_m, side_m);
}

void Odometry::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.pose = X_SB_;
  if (params_.noise_pose_m > 0.0 || params_.noise_pose_yaw_rad > 0.0) {
    reading.pose.x_m += noise_.gaussian(params_.noise_pose_m);
    reading.pose.y_m += noise_.gaussian(params_.noise_pose_m);
    reading.pose.yaw_rad =
        normalize_angle(reading.pose.yaw_rad + noise_.gaussian(params_.noise_pose_yaw_rad));
  }
  reading.elevation = {};
  if (params_.noise_in_space) {
    add_noise(noise_, params_.noise_pose_m, params_.noise_pose_yaw_rad, reading.elevation);
  }
  reading.twist = context.body.twist;
  if (slipping_motors_ != nullptr) {
    const WheelPath path = turned(context.body);
    const double dt_s = to_seconds(context.world.simulation.step_ns);
    reading.twist = {path.ds_m / dt_s, path.dyaw_rad / dt_s, path.side_m / dt_s};
  }
  if (!omnidirectional_) reading.twist.lateral_mps = 0.0;  // the wheels do not measure it
  reading.stalled = context.body.stalled;
  // For a robot at rest the increment is exactly zero.
  reading.increment = X_SR_ == X_SB_ ? Pose{} : X_SR_.inverse() * X_SB_;
  reading.path_length_m = path_length_m_;
  X_SR_ = X_SB_;
  path_length_m_ = 0.0;
  if (params_.scale_noise > 0.0) draw_scale();
}

void Odometry::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_, X_SB_, X_SR_, path_length_m_);
  if (params_.scale_noise > 0.0) archive(present_scale_);
}

namespace {

// The angles of a flat world: of MORSE's x, y, z, roll, pitch and yaw, it has x, y and yaw.
constexpr NumberRange kNoiseLength{0.0, 100.0, false, "m"};
constexpr NumberRange kNoiseAngle{0.0, 6.28, false, "rad"};
constexpr double kMorseRotation_rad = 5.0 * kDegrees;

constexpr const char* kPoseNoiseNames[] = {"PoseNoise", "Noise"};
constexpr ModifierParameter kPoseNoise[] = {
    {"pos_std", 0.05, kNoiseLength, "noise",
     [](void* params, double value) { static_cast<PoseParams*>(params)->noise_m = value; }},
    {"rot_std", kMorseRotation_rad, kNoiseAngle, "noise_yaw_deg",
     [](void* params, double value) { static_cast<PoseParams*>(params)->noise_yaw_rad = value; }},
};
constexpr Modifier kPoseModifiers[] = {
    {kPoseNoiseNames, kPoseNoise, nullptr,
     [](void* params) { static_cast<PoseParams*>(params)->noise_in_space = true; }},
    kUtmModifier<PoseParams>,
    kNedModifier<PoseParams>,
    kFeetModifier<PoseParams>,
    kEcefModifier<PoseParams>,
    kGeodeticModifier<PoseParams>};

OdometryParams& odometry(void* params) { return *static_cast<OdometryParams*>(params); }

constexpr ModifierParameter kOdometryPoseNoise[] = {
    {"pos_std", 0.05, kNoiseLength, "noise_pose",
     [](void* params, double value) { odometry(params).noise_pose_m = value; }},
    {"rot_std", kMorseRotation_rad, kNoiseAngle, "noise_pose_yaw_deg",
     [](void* params, double value) { odometry(params).noise_pose_yaw_rad = value; }},
};
// MORSE's drift is per tick, which is a reading of the sensor.
constexpr const char* kOdometryNoiseNames[] = {"OdometryNoise"};
constexpr ModifierParameter kOdometryNoise[] = {
    {"factor",
     1.05,
     {0.0, 10.0, false, ""},
     "scale",
     [](void* params, double value) { odometry(params).scale = value; }},
    {"factor_sigma",
     0.0,
     {0.0, 1.0, false, ""},
     "scale_noise",
     [](void* params, double value) { odometry(params).scale_noise = value; }},
    {"gyro_drift",
     0.0,
     {-1.0, 1.0, false, "rad"},
     "heading_drift_deg",
     [](void* params, double value) {
       odometry(params).heading_drift_radps = value * odometry(params).frequency_hz;
     }},
    {"gyro_drift_sigma",
     0.0,
     {0.0, 1.0, false, "rad"},
     "heading_noise_deg",
     [](void* params, double value) {
       odometry(params).heading_noise_rad = value * std::sqrt(odometry(params).frequency_hz);
     }},
};
constexpr Modifier kOdometryModifiers[] = {
    {kOdometryNoiseNames, kOdometryNoise},
    {kPoseNoiseNames, kOdometryPoseNoise, nullptr,
     [](void* params) { odometry(params).noise_in_space = true; }}};

}  // namespace

constexpr const char* kLevels[] = {"integrated", "differential", "raw"};

constexpr Field kPoseSettings[] = {
    frequency_field<&PoseParams::frequency_hz>(),
    noise_field<&PoseParams::noise_m>("standard deviation of x and of y").with_realism(0.0, 0.005),
    field<&PoseParams::noise_yaw_rad>("noise_yaw_deg", "degrees",
                                      "standard deviation of the heading")
        .within(0.0, 360.0)
        .with_realism(0.0, 0.5),
    latency_field<&PoseParams::latency_s>(),
    include<PoseParams, SensorMount>(),
    modifiers_field<kPoseModifiers>(),
};
SIM_FIELDS(PoseParams, kPoseSettings)

constexpr Field kOdometrySettings[] = {
    frequency_field<&OdometryParams::frequency_hz>(
        "readings per simulated second; the wheels are integrated in each step"),
    field<&OdometryParams::noise>(
        "noise", "m after 1 m",
        "standard deviation of a wheel's path after 1 m of it; grows with the root of the path")
        .within(0.0, 10.0)
        .with_realism(0.0, 0.001),
    field<&OdometryParams::level>(
        "level", "",
        "form of MORSE's stream: `\"integrated\"`, `\"differential\"` or `\"raw\"`, see below")
        .one_of(kLevels),
    field<&OdometryParams::start>("start", "m, degrees",
                                  "the pose that it reads before the robot has moved")
        .not_property(),
    field<&OdometryParams::wheel_ratio>("wheel_ratio", "",
                                        "E_d: diameter of the right wheel over that of the left")
        .within(0.5, 2.0)
        .with_realism(1.0, 1.001)
        .unlisted(1.0),
    field<&OdometryParams::wheelbase_ratio>("wheelbase_ratio", "",
                                            "E_b: the true wheelbase over the assumed one")
        .within(0.5, 2.0)
        .with_realism(1.0, 1.005)
        .unlisted(1.0),
    field<&OdometryParams::scale>("scale", "", "factor of all distances")
        .within(0.0, 10.0)
        .with_realism(1.0, 1.0)
        .unlisted(1.0),
    field<&OdometryParams::side_scale>(
        "side_scale", "", "further factor of distances sideways, of omnidirectional robots")
        .within(0.0, 1000.0)
        .with_realism(1.0, 1.0)
        .unlisted(1.0),
    field<&OdometryParams::scale_noise>("scale_noise", "",
                                        "standard deviation of that factor, new for each reading")
        .within(0.0, 1.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    field<&OdometryParams::heading_drift_radps>("heading_drift_deg", "degrees/s",
                                                "drift of the heading, also at rest")
        .within(-3600.0, 3600.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    field<&OdometryParams::heading_noise_rad>(
        "heading_noise_deg", "degrees",
        "standard deviation of the heading after 1 s; grows with the root of time, also at rest")
        .within(0.0, 3600.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    field<&OdometryParams::noise_pose_m>(
        "noise_pose", "m", "standard deviation of x and of y of a reading; not integrated")
        .within(0.0, 100.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    field<&OdometryParams::noise_pose_yaw_rad>(
        "noise_pose_yaw_deg", "degrees",
        "standard deviation of the heading of a reading; not integrated")
        .within(0.0, 360.0)
        .with_realism(0.0, 0.0)
        .unlisted(0.0),
    latency_field<&OdometryParams::latency_s>(),
    modifiers_field<kOdometryModifiers>(),
};
SIM_FIELDS(OdometryParams, kOdometrySettings)

constexpr Field kPoseReading[] = {
    field<&PoseReading::pose>("", "m, rad", "in the world; odometry: from the robot's start"),
    field<&PoseReading::twist, &Twist::v_mps>("v", "m/s", "forward, in the robot's frame"),
    field<&PoseReading::twist, &Twist::omega_radps>("omega", "rad/s", "counter-clockwise"),
    field<&PoseReading::twist, &Twist::lateral_mps>("lateral", "m/s",
                                                    "to the left, in the robot's frame"),
    field<&PoseReading::stalled>("stalled", "", "whether something blocks the robot"),
    field<&PoseReading::path_length_m>(
        "path_length", "m", "path length of the axle's middle since the last reading; `pose`: 0"),
    field<&PoseReading::increment>("increment", "m, rad",
                                   "pose relative to the last reading; `pose`: 0"),
    field<&PoseReading::elevation, &Elevation::z_m>("z", "m",
                                                    "height; odometry: 0 except for noise"),
    field<&PoseReading::elevation, &Elevation::roll_rad>("roll", "rad",
                                                         "odometry: 0 except for noise"),
    field<&PoseReading::elevation, &Elevation::pitch_rad>("pitch", "rad",
                                                          "odometry: 0 except for noise"),
};
SIM_FIELDS(PoseReading, kPoseReading)

namespace {

// Name of the device that moves a robot, if its wheels slip; otherwise "".
std::string slipping_motors(const RobotDescription& robot) {
  for (const DeviceDescription& device : robot.devices) {
    if (device.type != "motion") continue;
    return params_in<MotionParams>(device.params).slip > 0.0 ? device.name : "";
  }
  return "";
}

}  // namespace

DeviceKind odometry_kind() {
  return device_kind<OdometryParams, PoseReading>(
      "odometry", {{"position2d", 1}},
      [](const DeviceConstruction& construction, const OdometryParams& params) {
        const DriveDescription& drive = construction.model.drive;
        return std::make_unique<Odometry>(construction.name(), params, drive.wheel_separation_m,
                                          drive.kind == DriveKind::kOmnidirectional,
                                          slipping_motors(construction.robot),
                                          construction.noise());
      });
}

DeviceKind pose_kind() {
  return device_kind<PoseParams, PoseReading>(
      "pose", {{"localize"}, {"position2d"}},
      [](const DeviceConstruction& construction, const PoseParams& params) {
        return std::make_unique<PoseSensor>(construction.name(), params, construction.robot.pose,
                                            construction.noise());
      });
}

}  // namespace sim
