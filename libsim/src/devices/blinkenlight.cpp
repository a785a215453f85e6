// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/blinkenlight.h"

#include <algorithm>
#include <utility>

#include "devices/device_kind.h"
#include "sim/devices/robot_snapshot.h"

namespace sim {

bool is_lit(double period_s, double duty_cycle, SimTime time_ns) {
  if (period_s <= 0.0) return true;
  // Integers, so that rounding cannot move a transition to another step.
  const SimTime period_ns = std::max<SimTime>(from_seconds(period_s), 1);
  return static_cast<double>(time_ns % period_ns) < duty_cycle * static_cast<double>(period_ns);
}

Blinkenlight::Blinkenlight(std::string name, const BlinkenlightParams& params)
    : SensorOf(std::move(name), "blinkenlight", params.frequency_hz),
      params_(params),
      now_(params) {}

std::optional<std::string> Blinkenlight::apply(const Command& command) {
  const auto* change = std::get_if<LightCommand>(&command);
  if (change == nullptr) return Sensor::apply(command);
  constexpr double kLongest_s = 1e6;
  if (change->period_s && !(*change->period_s >= 0.0 && *change->period_s <= kLongest_s)) {
    return "the period of light " + name() + " is a number in 0..1e6 s";
  }
  if (change->duty_cycle && !(*change->duty_cycle >= 0.0 && *change->duty_cycle <= 1.0)) {
    return "the duty cycle of light " + name() + " is a number in 0..1";
  }
  now_.enabled = change->enabled.value_or(now_.enabled);
  now_.colour = change->colour.value_or(now_.colour);
  now_.period_s = change->period_s.value_or(now_.period_s);
  now_.duty_cycle = change->duty_cycle.value_or(now_.duty_cycle);
  return std::nullopt;
}

void Blinkenlight::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.enabled = now_.enabled;
  reading.colour = now_.colour;
  reading.period_s = now_.period_s;
  reading.duty_cycle = now_.duty_cycle;
  reading.lit = lit(context.now_ns);
}

void Blinkenlight::show(SimTime now_ns, RobotSnapshot& shot) const {
  shot.lights.push_back({params_.p_BL, now_.colour, lit(now_ns) && active()});
}

void Blinkenlight::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(now_.enabled, now_.colour, now_.period_s, now_.duty_cycle);
}

constexpr Field kBlinkenlightSettings[] = {
    frequency_field<&BlinkenlightParams::frequency_hz>(),
    field<&BlinkenlightParams::colour>("colour", "", "`#RGB` or `#RRGGBB`"),
    field<&BlinkenlightParams::enabled>("enabled", "", "whether it is on at the start"),
    field<&BlinkenlightParams::period_s>("period", "s", "of one blink; 0: it does not blink")
        .within(0.0, 1e6),
    field<&BlinkenlightParams::duty_cycle>("duty_cycle", "",
                                           "fraction of the period in which it is lit")
        .within(0.0, 1.0),
    field<&BlinkenlightParams::p_BL>("position", "m", "position on the robot, in the robot's frame")
        .within(-100.0, 100.0)
        .property_name(""),
};
SIM_FIELDS(BlinkenlightParams, kBlinkenlightSettings)

constexpr Field kBlinkenlightReading[] = {
    field<&BlinkenlightReading::enabled>("on", "", "whether it is on"),
    field<&BlinkenlightReading::colour>("colour", "", "`\"#rrggbb\"`"),
    field<&BlinkenlightReading::period_s>("period", "s", "of its blinking"),
    field<&BlinkenlightReading::duty_cycle>("duty_cycle", "",
                                            "part of the period in which it is lit, 0 to 1"),
    field<&BlinkenlightReading::lit>("lit", "", "whether it is lit at this moment"),
};
SIM_FIELDS(BlinkenlightReading, kBlinkenlightReading)

DeviceKind blinkenlight_kind() {
  return device_kind<Blinkenlight, BlinkenlightParams, BlinkenlightReading>("blinkenlight",
                                                                            {{"blinkenlight"}});
}

}  // namespace sim
