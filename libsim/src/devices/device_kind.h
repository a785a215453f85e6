// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>

#include "sim/core/degrees.h"
#include "sim/core/fields.h"
#include "sim/core/number_text.h"
#include "sim/devices/builtin.h"
#include "sim/io/field_reader.h"
#include "sim/world/limits.h"

/// Helpers for the source files of devices to define their row of the table of kinds.
namespace sim {

/// Everything that a device is constructed from.
struct DeviceConstruction {
  const DeviceDescription& device;
  const RobotDescription& robot;
  const RobotModel& model;
  std::uint64_t world_seed;

  [[nodiscard]] const std::string& name() const { return device.name; }
  /// The device's own random stream.
  [[nodiscard]] RandomStream noise() const { return {world_seed, robot.name + "/" + device.name}; }
};

/// The settings in a description; the defaults if it has none.
template <typename Params>
[[nodiscard]] Params params_in(const std::any& params) {
  return params.has_value() ? std::any_cast<const Params&>(params) : Params{};
}

/// Defines a row; fields_of<Params>() and fields_of<ReadingType>() describe settings and readings.
/// @tparam ReadingType  void for a device without readings.
/// @param interfaces  that the device provides; a name alone has rank 0.
/// @tparam Make  of a lambda without captures: creates the device from a DeviceConstruction and
///               Params. It is a type, because plain functions compile faster than std::function.
template <typename Params, typename ReadingType, typename Make>
[[nodiscard]] DeviceKind device_kind(const char* name, std::vector<ProvidedInterface> interfaces,
                                     Make /*make*/) {
  static_assert(std::is_empty_v<Make>, "give a lambda: the row makes one of its own");
  DeviceKind row;
  row.name = name;
  row.interfaces = std::move(interfaces);
  row.settings = &fields_of<Params>();
  row.parse = [](io::Reader& settings, const std::any& defaults) -> std::any {
    auto params = std::any_cast<const Params&>(defaults);
    io::read_fields(settings, fields_of<Params>(), &params);
    return params;
  };
  row.defaults = [] { return std::make_any<Params>(); };
  row.settings_in = [](const std::any& params) -> const void* {
    return std::any_cast<Params>(&params);
  };
  row.create = [](const DeviceDescription& device, const RobotDescription& robot,
                  const RobotModel& model, std::uint64_t seed) -> std::unique_ptr<Device> {
    return Make{}(DeviceConstruction{device, robot, model, seed}, params_in<Params>(device.params));
  };
  if constexpr (!std::is_void_v<ReadingType>) {
    row.reading = {&fields_of<ReadingType>(), &typeid(ReadingType),
                   []() -> std::unique_ptr<Reading> { return std::make_unique<ReadingType>(); }};
  }
  return row;
}

/// Defines the row of a device that is constructed from its name, its settings and optionally its
/// random stream.
template <typename Made, typename Params, typename ReadingType>
[[nodiscard]] DeviceKind device_kind(const char* name, std::vector<ProvidedInterface> interfaces) {
  return device_kind<Params, ReadingType>(
      name, std::move(interfaces),
      [](const DeviceConstruction& construction, const Params& params) {
        if constexpr (std::is_constructible_v<Made, std::string, const Params&, RandomStream>) {
          return std::make_unique<Made>(construction.name(), params, construction.noise());
        } else {
          return std::make_unique<Made>(construction.name(), params);
        }
      });
}

/// Adds properties that depend on the robot's model to a row.
/// @tparam Complete  of a lambda without captures, which fills Params with values from the model.
template <typename Params, typename Complete>
[[nodiscard]] DeviceKind with_model(DeviceKind row, Complete /*complete*/) {
  static_assert(std::is_empty_v<Complete>, "give a lambda: the row makes one of its own");
  row.model_properties = [](const std::any& params, const RobotModel& model) {
    auto completed = params_in<Params>(params);
    Complete{}(completed, model);
    std::map<std::string, double> properties;
    add_properties(fields_of<Params>(), &completed, properties);
    return properties;
  };
  return row;
}

/// Whether a mounting is so far within a part of the body that no solid reaches it; robots
/// penetrate solids by less than 2 mm.
[[nodiscard]] bool is_safely_inside(const RobotModel& model, const Pose& X_BL);

/// @name Fields common to many devices
/// @{
template <auto kMember>
[[nodiscard]] constexpr Field frequency_field(
    const char* meaning = "readings per simulated second") {
  return field<kMember>("frequency", "Hz", meaning).above(0.0, 1000.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field noise_field(const char* meaning) {
  return field<kMember>("noise", "m", meaning).within(0.0, 100.0);
}
/// Latency of sensors at the level "real" [s]: half the sweep of the S1R's laser, or a frame of a
/// camera with 25 Hz. It is the same for all sensors, so a client's Read() still returns readings
/// of one moment together.
inline constexpr double kRealLatency_s = 0.04;

template <auto kMember>
[[nodiscard]] constexpr Field latency_field() {
  return field<kMember>("latency", "s", "time from a measurement until clients get its reading")
      .within(0.0, 10.0)
      .with_realism(0.0, kRealLatency_s)
      .unlisted(0.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field dropout_field(double real) {
  return field<kMember>("dropouts", "", "probability that a range is lost and reads `range_max`")
      .within(0.0, 1.0)
      .with_realism(0.0, real)
      .unlisted(0.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field noise_share_field(double real) {
  return field<kMember>("noise_share", "",
                        "standard deviation of a range as a share of it, if that is over `noise`")
      .within(0.0, 1.0)
      .with_realism(0.0, real)
      .unlisted(0.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field range_max_field(
    const char* meaning = "farther objects are not seen") {
  return field<kMember>("range_max", "m", meaning).within(kLeastLength_m, 1000.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field range_min_field() {
  return field<kMember>("range_min", "m",
                        "least range; only for programs that ask, ranges are not changed")
      .within(0.0, 1000.0)
      .unlisted(0.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field intensity_field() {
  return field<kMember>("intensity", "",
                        "intensity of each echo that `RangerProxy` states; 0: none is measured")
      .within(0.0, 1e6)
      .unlisted(0.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field height_field(const char* meaning) {
  return field<kMember>("height", "m", meaning).within(0.0, 100.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field mount_field(const char* meaning) {
  return field<kMember>("pose", "m, degrees", meaning).property_name("mount");
}
template <auto kMember>
[[nodiscard]] constexpr Field north_field() {
  return field<kMember>("north_deg", "degrees",
                        "direction of north in the world, counter-clockwise from its x axis")
      .within(-360.0, 360.0);
}
/// @}

}  // namespace sim
