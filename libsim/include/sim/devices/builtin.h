// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "sim/core/fields.h"
#include "sim/devices/device.h"
#include "sim/io/world_io.h"
#include "sim/world/robot_model.h"

namespace sim {

/// The type of reading of a device kind; null pointers for a kind that makes no readings.
struct ReadingKind {
  const FieldTable* fields = nullptr;
  const std::type_info* type = nullptr;
  std::unique_ptr<Reading> (*make)() = nullptr;

  /// Pointer to the reading for functions that take a FieldTable.
  /// @throws std::bad_cast if the reading has another type.
  [[nodiscard]] const void* object(const Reading& reading) const;
  [[nodiscard]] void* object(Reading& reading) const;
};

/// An interface (named as in Player) under which clients find devices of a kind.
struct ProvidedInterface {
  const char* name;
  int rank = 0;  ///< among the kinds with this interface, the least rank has index 0
};

/// A row of the table of device kinds: its settings, its readings, and its factory function.
struct DeviceKind : io::DeviceType {
  const FieldTable* settings = nullptr;
  /// Pointer to the struct that `settings` describes, inside the result of parse() or defaults().
  const void* (*settings_in)(const std::any& params) = nullptr;
  ReadingKind reading;
  std::vector<ProvidedInterface> interfaces;
  /// Creates a device.
  /// @param world_seed  seed of the run, for the device's noise stream.
  std::unique_ptr<Device> (*create)(const DeviceDescription&, const RobotDescription&,
                                    const RobotModel&, std::uint64_t world_seed) = nullptr;
  /// Properties that also depend on the robot's model; they replace those of properties(). nullptr
  /// for kinds without such properties.
  std::map<std::string, double> (*model_properties)(const std::any& params,
                                                    const RobotModel& model) = nullptr;

  /// The numeric settings as clients see them, in SI units and radians.
  [[nodiscard]] std::map<std::string, double> properties(const std::any& params) const;
};

/// All kinds of devices in libsim.
[[nodiscard]] const std::vector<DeviceKind>& device_kinds();
/// The kind of that name; nullptr if there is none.
[[nodiscard]] const DeviceKind* find_device_kind(std::string_view name);

/// All kinds of devices in the form that io needs.
[[nodiscard]] std::vector<io::DeviceType> device_types();

/// All kinds of commands, in the order of Command.
[[nodiscard]] std::span<const AlternativeKind<Command>> command_kinds();

}  // namespace sim
