// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/battery.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "sim/core/assert.h"
#include "sim/core/math.h"

namespace sim {
namespace {

constexpr double kJoulesPerWh = 3600.0;

}  // namespace

double battery_load_w(const BatteryParams& params, const Twist& commanded,
                      double wheel_separation_m) {
  const double rim_mps = 0.5 * wheel_separation_m * commanded.omega_radps;
  const double v_mps = commanded.lateral_mps == 0.0
                           ? commanded.v_mps
                           : math::hypot(commanded.v_mps, commanded.lateral_mps);
  const double wheels_mps = 0.5 * (std::abs(v_mps - rim_mps) + std::abs(v_mps + rim_mps));
  return params.idle_power_w + params.drive_power_ws_per_m * wheels_mps;
}

double battery_voltage_v(const BatteryParams& params, double charge) {
  return params.empty_voltage_v + (params.full_voltage_v - params.empty_voltage_v) * charge;
}

bool is_on_dock(const DockDescription& dock, const Vec2& p_W) {
  // Most docks are far away and need no transformation into their frame.
  if ((p_W - dock.pose.position()).squaredNorm() > 0.25 * dock.size.squaredNorm()) return false;
  const Vec2 p_D = dock.pose.inverse() * p_W;
  return std::abs(p_D.x()) <= 0.5 * dock.size.x() && std::abs(p_D.y()) <= 0.5 * dock.size.y();
}

Battery::Battery(std::string name, const BatteryParams& params, double wheel_separation_m)
    : SensorOf(std::move(name), "battery", params.frequency_hz),
      params_(params),
      wheel_separation_m_(wheel_separation_m),
      energy_j_(params.capacity_wh * kJoulesPerWh * params.initial_charge_percent / 100.0) {
  SIM_ASSERT(params.capacity_wh > 0.0);
  edit().capacity_wh = params.capacity_wh;
}

void Battery::integrate(const StepContext& context) {
  const double dt_s = to_seconds(context.world.simulation.step_ns);
  const Vec2 p_WB = context.body.X_WB.position();
  const auto& docks = context.world.arena.docks;
  docked_ = std::any_of(docks.begin(), docks.end(),
                        [&](const DockDescription& dock) { return is_on_dock(dock, p_WB); });
  const double before_j = energy_j_;
  if (docked_) {
    energy_j_ =
        std::min(energy_j_ + params_.charging_power_w * dt_s, params_.capacity_wh * kJoulesPerWh);
  } else {
    const double load_w = battery_load_w(params_, context.body.commanded, wheel_separation_m_);
    energy_j_ = std::max(energy_j_ - load_w * dt_s, 0.0);
  }
  power_w_ = (energy_j_ - before_j) / dt_s;
}

void Battery::measure(const StepContext& context) {
  auto& reading = next(context);
  const double capacity_j = params_.capacity_wh * kJoulesPerWh;
  const double charge = energy_j_ / capacity_j;
  reading.charge_percent = 100.0 * charge;
  reading.voltage_v = battery_voltage_v(params_, charge);
  reading.energy_wh = energy_j_ / kJoulesPerWh;
  reading.power_w = power_w_;
  if (!docked_) {
    reading.status = BatteryStatus::kDischarging;
  } else {
    reading.status = energy_j_ >= capacity_j ? BatteryStatus::kCharged : BatteryStatus::kCharging;
  }
}

void Battery::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(energy_j_, power_w_, docked_);
}

namespace {

std::optional<FieldError> check_voltage(const void* object) {
  const auto& p = *static_cast<const BatteryParams*>(object);
  if (p.empty_voltage_v <= p.full_voltage_v) return std::nullopt;
  return FieldError{"device/battery-voltage", "an empty_voltage of at most full_voltage",
                    rounded_text(p.empty_voltage_v, 6) + " V empty, " +
                        rounded_text(p.full_voltage_v, 6) + " V full",
                    ""};
}

}  // namespace

constexpr const char* kBatteryWords[] = {"Charged", "Charging", "Discharging"};

constexpr Field kBatterySettings[] = {
    frequency_field<&BatteryParams::frequency_hz>(),
    field<&BatteryParams::capacity_wh>("capacity", "W h", "energy of a full battery")
        .above(0.0, 100000.0),
    field<&BatteryParams::initial_charge_percent>("initial_charge", "percent",
                                                  "of the capacity, at the start")
        .within(0.0, 100.0),
    field<&BatteryParams::idle_power_w>("idle_power", "W", "power that is drawn at all times")
        .within(0.0, 10000.0),
    field<&BatteryParams::drive_power_ws_per_m>(
        "drive_power", "W for each m/s", "additional power for each m/s of the wheels' speed")
        .within(0.0, 10000.0),
    field<&BatteryParams::charging_power_w>("charging_power", "W",
                                            "power from a dock into the battery")
        .within(0.0, 10000.0),
    field<&BatteryParams::full_voltage_v>("full_voltage", "V", "voltage at full charge")
        .above(0.0, 1000.0),
    field<&BatteryParams::empty_voltage_v>("empty_voltage", "V",
                                           "when empty; at most `full_voltage`")
        .above(0.0, 1000.0),
};
SIM_FIELDS(BatteryParams, kBatterySettings, check_voltage)

constexpr Field kBatteryReading[] = {
    field<&BatteryReading::charge_percent>("charge", "percent",
                                           "charge in percent of the capacity"),
    field<&BatteryReading::status>("status", "", "what it does").one_of(kBatteryWords),
    field<&BatteryReading::voltage_v>("voltage", "V", "voltage of its terminals"),
    field<&BatteryReading::energy_wh>("energy", "W h", "energy in it"),
    field<&BatteryReading::capacity_wh>("capacity", "W h", "its energy when full"),
    field<&BatteryReading::power_w>("power", "W", "into the battery; negative: out of it"),
};
SIM_FIELDS(BatteryReading, kBatteryReading)

std::string_view to_string(BatteryStatus status) {
  return kBatteryWords[static_cast<std::size_t>(status)];
}

DeviceKind battery_kind() {
  return device_kind<BatteryParams, BatteryReading>(
      "battery", {{"power"}},
      [](const DeviceConstruction& construction, const BatteryParams& params) {
        return std::make_unique<Battery>(construction.name(), params,
                                         construction.model.drive.wheel_separation_m);
      });
}

}  // namespace sim
