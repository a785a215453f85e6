// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/builtin.h"

#include <map>
#include <string_view>

// The names of all kinds; NAME_kind() is defined in the device's own source file. The list is
// written by hand, since linkers drop self-registering objects from static libraries.
// clang-format off
#define SIM_DEVICE_KINDS(KIND) \
  KIND(accelerometer) KIND(actarray) KIND(aio) KIND(airspeed) KIND(altimeter) KIND(amcl) \
  KIND(attitude) KIND(barometer) KIND(battery) KIND(bumper) KIND(blinkenlight) \
  KIND(blobfinder) KIND(camera) KIND(clock) KIND(collision) KIND(compass) KIND(depth_camera) \
  KIND(destination) KIND(fiducial) KIND(gps) KIND(gripper) KIND(gyroscope) KIND(hand) KIND(imu) KIND(dio) KIND(infrared) KIND(laser) \
  KIND(motion) KIND(odometry) KIND(opaque) KIND(orientation) KIND(patrol) KIND(pen) KIND(pose) \
  KIND(posture) KIND(proximity) KIND(ptz) KIND(semantic_camera) KIND(sonar) KIND(speech) \
  KIND(teleport) KIND(thermometer) KIND(velocity) KIND(wander) \
  KIND(waypoint) KIND(wifi)
// clang-format on

namespace sim {

#define SIM_DECLARE_KIND(name) DeviceKind name##_kind();
SIM_DEVICE_KINDS(SIM_DECLARE_KIND)
#undef SIM_DECLARE_KIND

const void* ReadingKind::object(const Reading& reading) const {
  if (type == nullptr || typeid(reading) != *type) throw std::bad_cast();
  return dynamic_cast<const void*>(&reading);
}

void* ReadingKind::object(Reading& reading) const {
  if (type == nullptr || typeid(reading) != *type) throw std::bad_cast();
  return dynamic_cast<void*>(&reading);
}

std::map<std::string, double> DeviceKind::properties(const std::any& params) const {
  const std::any of_device = params.has_value() ? params : defaults();
  std::map<std::string, double> made;
  add_properties(*settings, settings_in(of_device), made);
  return made;
}

const std::vector<DeviceKind>& device_kinds() {
#define SIM_ADD_KIND(name) name##_kind(),
  // Never destroyed: a simulation may still be in use while the program exits.
  static const auto* const table = new std::vector<DeviceKind>{SIM_DEVICE_KINDS(SIM_ADD_KIND)};
#undef SIM_ADD_KIND
  return *table;
}

const DeviceKind* find_device_kind(std::string_view name) {
  static const auto* const by_name = [] {
    auto* index = new std::map<std::string_view, const DeviceKind*>();
    for (const DeviceKind& kind : device_kinds()) index->emplace(kind.name, &kind);
    return index;
  }();
  const auto found = by_name->find(name);
  return found == by_name->end() ? nullptr : found->second;
}

std::vector<io::DeviceType> device_types() {
  return {device_kinds().begin(), device_kinds().end()};
}

}  // namespace sim
