// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/realism.h"

#include <algorithm>
#include <any>
#include <cstddef>
#include <vector>

#include "sim/core/assert.h"
#include "sim/core/degrees.h"
#include "sim/core/fields.h"
#include "sim/devices/builtin.h"

namespace sim {
namespace {

void apply(Realism level, const DeviceKind& kind, DeviceDescription& device) {
  const std::any defaults = kind.defaults();
  if (!device.params.has_value()) device.params = defaults;
  // The settings themselves are not constant: they are inside device.params.
  void* const settings = const_cast<void*>(kind.settings_in(device.params));
  SIM_ASSERT(settings != nullptr);
  std::vector<double> default_values;
  for_each_field(*kind.settings, kind.settings_in(defaults),
                 [&](const Field& field, const void* owner) {
                   if (!field.realism) return;
                   SIM_ASSERT(field.type == FieldType::kNumber);
                   default_values.push_back(*static_cast<const double*>(field.get(owner)));
                 });
  std::size_t next = 0;
  for_each_field(*kind.settings, settings, [&](const Field& field, void* owner) {
    if (!field.realism) return;
    const double default_value = default_values[next++];
    const double unit = field.is_angle ? kDegrees : 1.0;
    auto& value = *static_cast<double*>(field.set(owner));
    if (level == Realism::kIdeal) {
      value = field.realism->ideal * unit;
    } else if (value == default_value && !std::ranges::binary_search(device.given, field.name)) {
      value = field.realism->real * unit;
    }
  });
}

}  // namespace

void apply_realism(WorldDescription& world) {
  const Realism level = world.simulation.realism;
  if (level == Realism::kCourse) return;
  for (RobotDescription& robot : world.robots) {
    for (DeviceDescription& device : robot.devices) {
      if (const DeviceKind* kind = find_device_kind(device.type)) apply(level, *kind, device);
    }
  }
}

}  // namespace sim
