// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>

#include "sim/core/elevation.h"
#include "sim/core/fields.h"
#include "sim/core/state_archive.h"
#include "sim/devices/device.h"

namespace sim {

/// Place of a device in space: on the robot's body, or on a head or an arm.
struct MountPose {
  double x_m = 0.0;        ///< forward [m]
  double y_m = 0.0;        ///< to the left [m]
  double z_m = 0.0;        ///< upwards [m]
  double yaw_rad = 0.0;    ///< first turn, about z [rad]
  double pitch_rad = 0.0;  ///< second turn, about the moved y axis; positive: downwards [rad]
  double roll_rad = 0.0;   ///< third turn, about the moved x axis [rad]

  [[nodiscard]] Eigen::Isometry3d transform() const;
  friend bool operator==(const MountPose&, const MountPose&) = default;
};

/// Where a sensor is mounted.
struct SensorMount : MountPose {
  std::string on;  ///< name of the robot's ptz or actarray that carries it; empty: the body
};

template <>
const FieldTable& fields_of<MountPose>();  ///< of a MountPose
template <>
const FieldTable& fields_of<SensorMount>();  ///< of a SensorMount

class ActArray;
class Ptz;

/// The mounting of a sensor, with the device that carries it.
class Mounting {
 public:
  explicit Mounting(const SensorMount& mount) : mount_(mount) {}

  /// As Device::connect().
  std::optional<std::string> connect(std::string_view robot, const DeviceDirectory& devices);
  [[nodiscard]] std::string_view carrier() const noexcept { return mount_.on; }
  /// Pose of the sensor in B.
  [[nodiscard]] Eigen::Isometry3d in_body() const;
  /// Pose of the sensor in W.
  [[nodiscard]] Eigen::Isometry3d in_world(const BodyState& body) const {
    return in_space(body.X_WB, body.elevation) * in_body();
  }
  /// Whether the sensor's frame is that of the body.
  [[nodiscard]] bool is_trivial() const {
    return mount_.on.empty() && static_cast<const MountPose&>(mount_) == MountPose{};
  }

 private:
  SensorMount mount_;
  const Ptz* head_ = nullptr;
  const ActArray* arm_ = nullptr;
};

}  // namespace sim
