// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/posture.h"

#include <utility>

#include "devices/device_kind.h"
#include "sim/devices/actarray.h"
#include "sim/devices/ptz.h"

namespace sim {

Posture::Posture(std::string name, const PostureParams& params)
    : SensorOf(std::move(name), "posture", params.frequency_hz), params_(params) {}

std::optional<std::string> Posture::connect(std::string_view robot,
                                            const DeviceDirectory& devices) {
  if (params_.of.empty()) return std::nullopt;
  const Device* device = devices.find(robot, params_.of);
  head_ = dynamic_cast<const Ptz*>(device);
  arm_ = dynamic_cast<const ActArray*>(device);
  if (head_ != nullptr || arm_ != nullptr) return std::nullopt;
  return "a ptz or actarray of the same robot with the name \"" + params_.of + "\" (\"of\")";
}

std::vector<double> Posture::lengths_m() const {
  std::vector<double> lengths;
  if (arm_ == nullptr) return lengths;
  for (const JointParams& joint : arm_->params().joints) lengths.push_back(joint.length_m);
  return lengths;
}

std::vector<std::string> Posture::joints() const {
  if (head_ != nullptr) return {"pan", "tilt"};
  return arm_ != nullptr ? arm_->joint_names() : std::vector<std::string>();
}

std::vector<double> Posture::positions() const {
  if (head_ != nullptr) return {head_->pan_rad(), head_->tilt_rad()};
  return arm_ != nullptr ? arm_->positions() : std::vector<double>();
}

void Posture::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.joints = joints();
  reading.positions = positions();
}

constexpr Field kPostureSettings[] = {
    frequency_field<&PostureParams::frequency_hz>(),
    field<&PostureParams::of>("of", "",
                              "name of the robot's `ptz` or `actarray`; `\"\"`: no joints"),
};
SIM_FIELDS(PostureParams, kPostureSettings)

constexpr Field kPostureReading[] = {
    field<&PostureReading::joints>("joints", "", "names of the joints"),
    field<&PostureReading::positions>("positions", "m or rad", "of the joints"),
};
SIM_FIELDS(PostureReading, kPostureReading)

DeviceKind posture_kind() {
  return device_kind<Posture, PostureParams, PostureReading>("posture", {});
}

}  // namespace sim
