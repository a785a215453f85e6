// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/devices/device.h"
#include "sim/world/description.h"

namespace sim {

/// Settings of a battery; the defaults last an S1R for about eight hours at rest.
struct BatteryParams {
  double frequency_hz = 10.0;             ///< (0, 1000]
  double capacity_wh = 50.0;              ///< energy of a full battery [W h], > 0
  double initial_charge_percent = 100.0;  ///< of the capacity, [0, 100]
  double idle_power_w = 6.0;              ///< drawn at all times [W], >= 0
  double drive_power_ws_per_m = 8.0;  ///< drawn for each m/s that the wheels are driven at, mean of
                                      ///< both [W s/m], >= 0
  double charging_power_w = 40.0;     ///< what a dock puts into the battery [W], >= 0
  double full_voltage_v = 12.6;       ///< at full charge [V], > 0
  double empty_voltage_v = 9.0;       ///< at none [V], > 0, at most full_voltage_v
};

/// What a battery is at.
enum class BatteryStatus {
  kCharged,      ///< full, in a dock
  kCharging,     ///< in a dock, not full yet
  kDischarging,  ///< in no dock, be it full or empty
};

/// MORSE's words: "Charged", "Charging" or "Discharging".
[[nodiscard]] std::string_view to_string(BatteryStatus status);

/// How full a battery is.
struct BatteryReading final : Reading {
  double charge_percent = 0.0;  ///< of the capacity, [0, 100]
  BatteryStatus status = BatteryStatus::kDischarging;
  double voltage_v = 0.0;    ///< see battery_voltage_v() [V]
  double energy_wh = 0.0;    ///< what is left [W h]
  double capacity_wh = 0.0;  ///< of a full battery, as set [W h]
  double power_w = 0.0;      ///< that goes into the battery; negative: that it gives [W]
};

/// Power that a robot draws: idle + drive (|v_left| + |v_right|) / 2, of its wheels' speeds
/// v -+ omega separation / 2; for v an omnidirectional drive's speed whichever way.
/// @param commanded           what the motors strive for, so that a stalled robot draws as much as
///                            one that drives, and one that is shoved no more than at rest.
/// @param wheel_separation_m  between the wheels' planes [m].
/// @return [W], >= 0.
[[nodiscard]] double battery_load_w(const BatteryParams& params, const Twist& commanded,
                                    double wheel_separation_m);

/// Voltage at a charge: linear from empty to full.
/// @param charge  share of the capacity, [0, 1].
/// @return [V]
[[nodiscard]] double battery_voltage_v(const BatteryParams& params, double charge);

/// Whether a point lies on a dock's area, its edges included.
/// @param p_W  [m], in W.
[[nodiscard]] bool is_on_dock(const DockDescription& dock, const Vec2& p_W);

/// A robot's battery: loses battery_load_w() in each step; while the middle of the axle is on a
/// dock of the arena the dock feeds the robot, and charging_power_w goes into the battery. The
/// robot's heading there does not matter. An empty battery only reads so: the robot drives on.
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
