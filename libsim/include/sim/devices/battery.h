// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/devices/device.h"
#include "sim/world/description.h"

namespace sim {

/// Settings of a battery. With the defaults, an S1R at rest runs for about eight hours.
struct BatteryParams {
  double frequency_hz = 10.0;             ///< [Hz]
  double capacity_wh = 50.0;              ///< energy of a full battery [W h]
  double initial_charge_percent = 100.0;  ///< of the capacity
  double idle_power_w = 6.0;              ///< constant consumption [W]
  double drive_power_ws_per_m = 8.0;  ///< consumption per m/s of wheel speed, averaged over both
                                      ///< wheels [W s/m]
  double charging_power_w = 40.0;     ///< power that a dock supplies to the battery [W]
  double full_voltage_v = 12.6;       ///< at full charge [V]
  double empty_voltage_v = 9.0;       ///< when empty [V], at most full_voltage_v
};

/// Charging state of a battery.
enum class BatteryStatus {
  kCharged,      ///< in a dock and full
  kCharging,     ///< in a dock and not full
  kDischarging,  ///< not in a dock, whatever the charge
};

/// MORSE's names: "Charged", "Charging" or "Discharging".
[[nodiscard]] std::string_view to_string(BatteryStatus status);

/// State of a battery.
struct BatteryReading final : Reading {
  double charge_percent = 0.0;  ///< of the capacity, [0, 100]
  BatteryStatus status = BatteryStatus::kDischarging;
  double voltage_v = 0.0;    ///< see battery_voltage_v() [V]
  double energy_wh = 0.0;    ///< remaining energy [W h]
  double capacity_wh = 0.0;  ///< energy of a full battery, as configured [W h]
  double power_w = 0.0;      ///< power into the battery [W]; negative if it is drawn from
};

/// Power that a robot consumes: idle + drive (|v_left| + |v_right|) / 2, with the wheel speeds v -+
/// omega separation / 2. For an omnidirectional drive, v is the magnitude of its velocity.
/// @param commanded           target velocity of the motors. So a stalled robot consumes as much as
///     a driving one, and a robot that is pushed no more than at rest.
/// @param wheel_separation_m  between the wheels' planes [m].
/// @return [W], >= 0.
[[nodiscard]] double battery_load_w(const BatteryParams& params, const Twist& commanded,
                                    double wheel_separation_m);

/// Voltage at a charge; linear between empty and full.
/// @param charge  fraction of the capacity, [0, 1].
/// @return [V]
[[nodiscard]] double battery_voltage_v(const BatteryParams& params, double charge);

/// Whether a point lies on a dock's area, including its edges.
/// @param p_W  position in W [m].
[[nodiscard]] bool is_on_dock(const DockDescription& dock, const Vec2& p_W);

/// A robot's battery. Each step draws battery_load_w() from it. While the centre of the axle is on
/// a dock of the arena, the dock powers the robot and charges the battery with charging_power_w;
/// the robot's heading does not matter. An empty battery has no effect on the robot.
class Battery final : public SensorOf<BatteryReading> {
 public:
  /// @param wheel_separation_m  of the robot's model [m].
  Battery(std::string name, const BatteryParams& params, double wheel_separation_m);

  void integrate(const StepContext& context) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  BatteryParams params_;
  double wheel_separation_m_;
  double energy_j_;
  double power_w_ = 0.0;  ///< in the last step, see BatteryReading
  bool docked_ = false;
};

}  // namespace sim
