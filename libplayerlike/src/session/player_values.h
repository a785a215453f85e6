// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libplayerinterface/player_constants.h"
#include "playerlike/messages/requests.h"
#include "session/range_settings.h"
#include "sim/core/pose.h"
#include "sim/devices/actarray.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/device.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gripper.h"
#include "sim/devices/imu.h"
#include "sim/devices/localization.h"
#include "sim/navigation/particles.h"
#include "sim/world/occupancy_map.h"

/// Readings and settings in Player's form. The templates fill the structs of Player's C headers
/// (player_gripper_geom_t) as well as those of its wire protocol (player::GripperGeom), which have
/// the same fields.
namespace playerlike {

/// A text property of a device by its name: "name" and "type" of the device, and "robot", the name
/// of its robot. @return nothing for other names.
[[nodiscard]] std::optional<std::string> text_property(const RobotInfo& robot,
                                                       const DeviceInfo& device,
                                                       std::string_view name);

/// Properties of position2d by which a mirror takes charge of a robot of a Playpen server, see
/// TakeChargeRequest: a number of seconds, and a truth value that must be set before.
inline constexpr const char* kWatchdogProperty = "watchdog";
inline constexpr const char* kTakeOverProperty = "take_over";

/// A number of a message, which is unsigned; readings count with int.
[[nodiscard]] constexpr int as_int(std::uint32_t value) {
  return static_cast<int>(value < 0x7fffffffU ? value : 0x7fffffffU);
}

/// @name Gripper
/// @{
/// Bits of broken beams, as Player's drivers for Pioneers set them.
inline constexpr std::uint32_t kOuterBeam = 0x04;
inline constexpr std::uint32_t kInnerBeam = 0x08;

[[nodiscard]] std::uint8_t gripper_state_code(sim::GripperState state) noexcept;
/// The state of a code PLAYER_GRIPPER_STATE_...; kError if there is none.
[[nodiscard]] sim::GripperState gripper_state(int code) noexcept;
/// The action of a command PLAYER_GRIPPER_CMD_...; nullopt if there is none.
[[nodiscard]] std::optional<sim::GripCommand::Action> grip_action(int command) noexcept;
[[nodiscard]] std::uint8_t grip_command(sim::GripCommand::Action action) noexcept;
[[nodiscard]] inline std::uint32_t broken_beams(const sim::GripperReading& reading) {
  return (reading.outer_beam ? kOuterBeam : 0) | (reading.inner_beam ? kInnerBeam : 0);
}

template <typename Data>
[[nodiscard]] sim::GripperReading gripper_reading(const Data& data) {
  sim::GripperReading reading;
  reading.state = gripper_state(data.state);
  reading.outer_beam = (data.beams & kOuterBeam) != 0;
  reading.inner_beam = (data.beams & kInnerBeam) != 0;
  reading.stored = data.stored;
  return reading;
}

template <typename Geometry>
[[nodiscard]] Geometry gripper_geometry(const DeviceSettings& settings) {
  const double length = setting_of(settings, "length");
  const double opening = setting_of(settings, "opening");
  const double height = setting_of(settings, "height");
  const Mounting mounting = mounting_of(settings);
  const double capacity = setting_of(settings, "capacity");
  Geometry geometry = {};
  geometry.pose = {mounting.x_m, mounting.y_m, 0.0, 0.0, 0.0, mounting.yaw_rad};
  geometry.outer_size = {opening + 2.0 * setting_of(settings, "thickness"), length, height};
  geometry.inner_size = {opening, length, height};
  geometry.num_beams = 2;
  geometry.capacity =
      static_cast<std::uint8_t>(capacity > 0.0 ? (capacity < 255.0 ? capacity : 255.0) : 0.0);
  return geometry;
}
/// @}

/// @name Array of joints
/// @{
/// A joint's setting, e.g. "min" of joint 2 is the property min_2.
[[nodiscard]] double joint_setting(const DeviceSettings& settings, const char* name,
                                   std::size_t joint);
[[nodiscard]] std::uint8_t joint_state_code(sim::JointState state) noexcept;
/// The state of a code PLAYER_ACTARRAY_ACTSTATE_...; kIdle if there is none.
[[nodiscard]] sim::JointState joint_state(int code) noexcept;
/// The unit vector along a joint's axis. @param axis  the setting, a sim::JointAxis.
struct AxisVector {
  double x, y, z;
};
[[nodiscard]] AxisVector axis_vector(double axis);

template <typename Actuator>
[[nodiscard]] Actuator actuator_of(const sim::JointReading& joint) {
  Actuator actuator = {};
  actuator.position = static_cast<float>(joint.position);
  actuator.speed = static_cast<float>(joint.speed);
  actuator.acceleration = static_cast<float>(joint.acceleration);
  actuator.current = static_cast<float>(joint.current_a);
  actuator.state = joint_state_code(joint.state);
  return actuator;
}

/// @param now  the newest reading of the joint; null before the first one.
template <typename Geometry>
[[nodiscard]] Geometry actuator_geometry(const DeviceSettings& settings, std::size_t joint,
                                         const sim::JointReading* now) {
  const auto value = [&](const char* name) { return joint_setting(settings, name, joint); };
  const auto single = [&](const char* name) { return static_cast<float>(value(name)); };
  const bool is_linear = value("type") == static_cast<double>(sim::JointType::kLinear);
  const AxisVector axis = axis_vector(value("axis"));
  Geometry geometry = {};
  geometry.type = is_linear ? PLAYER_ACTARRAY_TYPE_LINEAR : PLAYER_ACTARRAY_TYPE_ROTARY;
  geometry.length = single("length");
  geometry.orientation = {value("roll"), value("pitch"), value("yaw")};
  geometry.axis = {axis.x, axis.y, axis.z};
  geometry.min = single("min");
  geometry.centre = single("centre");
  geometry.max = single("max");
  geometry.home = single("home");
  geometry.config_speed = now != nullptr ? static_cast<float>(now->speed_setting) : single("speed");
  geometry.hasbrakes = value("brake") != 0.0 ? 1 : 0;
  return geometry;
}
/// @}

/// @name Sensors
/// @{
template <typename Item>
[[nodiscard]] Item fiducial_item(const sim::FiducialReading::Mark& mark,
                                 const DeviceSettings& settings) {
  const sim::Pose& X_ST = mark.X_ST;
  Item item = {};
  item.id = mark.id;
  item.pose = {X_ST.x_m, X_ST.y_m, 0.0, 0.0, 0.0, X_ST.yaw_rad};
  // The distance is uncertain along the line of sight, the bearing across it.
  const double along = setting_of(settings, "noise");
  const double across = setting_of(settings, "noise_bearing") * std::hypot(X_ST.x_m, X_ST.y_m);
  const double bearing = std::atan2(X_ST.y_m, X_ST.x_m);
  item.upose.px = std::hypot(along * std::cos(bearing), across * std::sin(bearing));
  item.upose.py = std::hypot(along * std::sin(bearing), across * std::cos(bearing));
  item.upose.pyaw = setting_of(settings, "noise_yaw");
  return item;
}

template <typename Item>
[[nodiscard]] sim::FiducialReading::Mark mark_of(const Item& item) {
  return {item.id, {item.pose.px, item.pose.py, item.pose.pyaw}};
}

template <typename Blob>
[[nodiscard]] Blob blob_of(const sim::BlobfinderReading::Blob& seen) {
  Blob blob = {};
  blob.color = static_cast<std::uint32_t>(seen.colour.r << 16 | seen.colour.g << 8 | seen.colour.b);
  blob.area = static_cast<std::uint32_t>(seen.area);
  blob.x = static_cast<std::uint32_t>(seen.x);
  blob.y = static_cast<std::uint32_t>(seen.y);
  blob.left = static_cast<std::uint32_t>(seen.left);
  blob.right = static_cast<std::uint32_t>(seen.right);
  blob.top = static_cast<std::uint32_t>(seen.top);
  blob.bottom = static_cast<std::uint32_t>(seen.bottom);
  blob.range = static_cast<float>(seen.range_m);
  return blob;
}
template <typename Blob>
[[nodiscard]] sim::BlobfinderReading::Blob seen_blob(const Blob& blob) {
  sim::BlobfinderReading::Blob seen;
  seen.colour = {static_cast<std::uint8_t>(blob.color >> 16U),
                 static_cast<std::uint8_t>(blob.color >> 8U), static_cast<std::uint8_t>(blob.color),
                 255};
  seen.area = as_int(blob.area);
  seen.x = as_int(blob.x);
  seen.y = as_int(blob.y);
  seen.left = as_int(blob.left);
  seen.right = as_int(blob.right);
  seen.top = as_int(blob.top);
  seen.bottom = as_int(blob.bottom);
  seen.range_m = static_cast<double>(blob.range);
  return seen;
}

/// Acceleration, turning rate and magnetic field of an inertial unit.
template <typename Calibrated>
[[nodiscard]] Calibrated imu_values(const sim::ImuReading& reading) {
  const auto& a = reading.acceleration_mps2;
  const auto& w = reading.rate_radps;
  const auto& b = reading.field_ut;
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2]),
          static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2]),
          static_cast<float>(b[0]), static_cast<float>(b[1]), static_cast<float>(b[2])};
}
template <typename Calibrated>
void set_imu_values(const Calibrated& data, sim::ImuReading& reading) {
  reading.acceleration_mps2 = {double{data.accel_x}, double{data.accel_y}, double{data.accel_z}};
  reading.rate_radps = {double{data.gyro_x}, double{data.gyro_y}, double{data.gyro_z}};
  reading.field_ut = {double{data.magn_x}, double{data.magn_y}, double{data.magn_z}};
}

/// The one hypothesis of a localisation: the measured pose, with the variances of its noise.
template <typename Hypothesis>
[[nodiscard]] Hypothesis hypothesis_of(const sim::PoseReading& reading,
                                       const DeviceSettings& settings) {
  const double noise_m = setting_of(settings, "noise");
  const double noise_yaw_rad = setting_of(settings, "noise_yaw");
  Hypothesis hypothesis = {};
  hypothesis.mean = {reading.pose.x_m, reading.pose.y_m, reading.pose.yaw_rad};
  hypothesis.cov[0] = noise_m * noise_m;
  hypothesis.cov[1] = noise_m * noise_m;
  hypothesis.cov[2] = noise_yaw_rad * noise_yaw_rad;
  hypothesis.alpha = 1.0;
  return hypothesis;
}
template <typename Hypothesis>
[[nodiscard]] Hypothesis hypothesis_of(const sim::PoseHypothesis& of) {
  Hypothesis hypothesis = {};
  hypothesis.mean = {of.mean.x_m, of.mean.y_m, of.mean.yaw_rad};
  for (std::size_t i = 0; i < 3; ++i) {
    hypothesis.cov[i] = of.covariance.variance[i];
    hypothesis.cov[i + 3] = of.covariance.covariance[i];
  }
  hypothesis.alpha = of.weight;
  return hypothesis;
}

/// The command for a pose and Player's covariance: xx, yy, yaw yaw, xy, y yaw, x yaw.
[[nodiscard]] inline sim::SetPoseCommand set_pose_command(const sim::Pose& pose,
                                                          const std::array<double, 6>& cov) {
  return {pose, {{cov[0], cov[1], cov[2]}}, {{cov[3], cov[4], cov[5]}}};
}

/// Mean of particles, and the mean of the variances of x and y: what Player's GET_PARTICLES tells
/// besides the particles. 0 without particles.
struct ParticleMoments {
  sim::Pose mean;
  double variance_m2 = 0.0;
};
[[nodiscard]] ParticleMoments moments_of(const std::vector<LocalizationParticle>& particles);
/// @}

/// Greatest absolute value of cells of Player's maps.
inline constexpr std::int8_t kMapDataRange = 1;

/// The cells of a map in Player's form: row-major from the bottom row; -kMapDataRange: free, 0:
/// unknown, kMapDataRange: occupied.
[[nodiscard]] std::vector<std::int8_t> map_cells(const sim::OccupancyMap& map);

/// A text without characters that cannot be said: white space becomes ' ', other control characters
/// and invalid UTF-8 become '?'.
/// @return at most sim::kMaxSpeech bytes.
[[nodiscard]] std::string sayable(std::string_view text);

}  // namespace playerlike
