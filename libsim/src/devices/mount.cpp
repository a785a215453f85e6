// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/mount.h"

#include "devices/device_kind.h"
#include "sim/core/elevation.h"
#include "sim/devices/actarray.h"
#include "sim/devices/ptz.h"

namespace sim {

Eigen::Isometry3d MountPose::transform() const {
  return in_space({x_m, y_m, yaw_rad}, {z_m, roll_rad, pitch_rad});
}

std::optional<std::string> Mounting::connect(std::string_view robot,
                                             const DeviceDirectory& devices) {
  if (mount_.on.empty()) return std::nullopt;
  const Device* carrier = devices.find(robot, mount_.on);
  head_ = dynamic_cast<const Ptz*>(carrier);
  arm_ = dynamic_cast<const ActArray*>(carrier);
  if (head_ != nullptr || arm_ != nullptr) return std::nullopt;
  return "a ptz or actarray of the same robot with the name \"" + mount_.on + "\" (\"on\")";
}

Eigen::Isometry3d Mounting::in_body() const {
  if (head_ != nullptr) return head_->head_in_body() * mount_.transform();
  if (arm_ != nullptr) return arm_->end_in_body() * mount_.transform();
  return mount_.transform();
}

constexpr Field kMountPose[] = {
    field<&MountPose::x_m>("x", "m", "position on its carrier, forward")
        .within(-100.0, 100.0)
        .unlisted(0.0),
    field<&MountPose::y_m>("y", "m", "to the left").within(-100.0, 100.0).unlisted(0.0),
    field<&MountPose::z_m>("z", "m", "upwards").within(-100.0, 100.0).unlisted(0.0),
    field<&MountPose::yaw_rad>("yaw_deg", "degrees", "turn about z")
        .within(-360.0, 360.0)
        .unlisted(0.0),
    field<&MountPose::pitch_rad>("pitch_deg", "degrees",
                                 "then about the moved y axis; positive: downwards")
        .within(-360.0, 360.0)
        .unlisted(0.0),
    field<&MountPose::roll_rad>("roll_deg", "degrees", "then about the moved x axis")
        .within(-360.0, 360.0)
        .unlisted(0.0),
};
SIM_FIELDS(MountPose, kMountPose)

constexpr Field kSensorMount[] = {
    include<SensorMount, MountPose>(),
    field<&SensorMount::on>("on", "",
                            "name of the `ptz` or `actarray` that carries it; `\"\"`: the body"),
};
SIM_FIELDS(SensorMount, kSensorMount)

}  // namespace sim
