// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <functional>
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

/// What a kind of device measures; empty pointers for a kind that makes no readings.
struct ReadingKind {
  const FieldTable* fields = nullptr;
  const std::type_info* type = nullptr;
  std::unique_ptr<Reading> (*make)() = nullptr;

  /// The reading as FieldTable's users want it.
  /// @throws std::bad_cast if it is of another kind.
  [[nodiscard]] const void* object(const Reading& reading) const;
  [[nodiscard]] void* object(Reading& reading) const;
};

/// An interface, by its name in Player, under which clients find devices of a kind.
struct CarriedInterface {
  const char* name;
  int rank = 0;  ///< of the kinds that carry it, the one of the least rank has index 0
};

/// A row of the table of device kinds: what its settings and readings are, and how it is made.
struct DeviceKind : io::DeviceType {
  const FieldTable* settings = nullptr;
  /// The struct that `settings` describes, in what parse() and defaults() give.
  const void* (*settings_in)(const std::any& params) = nullptr;
  ReadingKind reading;
  std::vector<CarriedInterface> interfaces;
  /// @param world_seed  seed of the run, for the device's noise stream.
  std::function<std::unique_ptr<Device>(const DeviceDescription&, const RobotDescription&,
                                        const RobotModel&, std::uint64_t world_seed)>
      create;
  /// Those of properties() that also depend on the robot's model, to take the place of the ones
  /// there; empty for kinds without such.
  std::function<std::map<std::string, double>(const std::any& params, const RobotModel& model)>
      model_properties;

  /// The numeric settings as clients are told of them, SI units and radians.
  [[nodiscard]] std::map<std::string, double> properties(const std::any& params) const;
};

/// All kinds of device that libsim has.
[[nodiscard]] const std::vector<DeviceKind>& device_kinds();
/// The kind of that name; nullptr if there is none.
[[nodiscard]] const DeviceKind* find_device_kind(std::string_view name);

/// The same as device_kinds(), as io wants it.
[[nodiscard]] std::vector<io::DeviceType> device_types();

/// The kinds of commands, in the order of Command.
[[nodiscard]] std::span<const AlternativeKind<Command>> command_kinds();

}  // namespace sim
