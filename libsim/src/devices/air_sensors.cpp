// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/air_sensors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "physics/physics_world.h"
#include "sim/core/math.h"
#include "sim/world/description.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

bool covers(const ObstacleDescription& o, const Vec2& p_W) {
  if (o.shape == ObstacleShape::kCircle) return (p_W - o.center).norm() <= radius_m(o);
  return is_inside(corners_of(o), p_W);
}

}  // namespace

// --- barometer

double pressure_at_pa(double reference_pa, double height_m) {
  constexpr double kMolarMass_kgpmol = 0.0289644;
  constexpr double kGas = 8.31447;  // [J/(mol K)]
  constexpr double kLapse_kpm = 0.0065;
  constexpr double kSeaLevel_k = 288.15;
  constexpr double kWeight_mps2 = 9.81;  // Blender's gravity
  const double exponent = kWeight_mps2 * kMolarMass_kgpmol / (kGas * kLapse_kpm);
  return reference_pa *
         math::pow(std::max(0.0, 1.0 - kLapse_kpm * height_m / kSeaLevel_k), exponent);
}

Barometer::Barometer(std::string name, const BarometerParams& params, double start_m,
                     RandomStream noise)
    : NoisySensor(std::move(name), "barometer", params, std::move(noise)), start_m_(start_m) {}

void Barometer::measure(const StepContext& context) {
  next(context).pressure_pa =
      pressure_at_pa(params().reference_pa, context.body.elevation.z_m - start_m_) +
      noise().gaussian(params().noise_pa);
}

constexpr Field kBarometerSettings[] = {
    frequency_field<&BarometerParams::frequency_hz>(),
    field<&BarometerParams::reference_pa>("reference", "Pa",
                                          "pressure at the robot's height at the start")
        .above(0.0, 1e6),
    field<&BarometerParams::noise_pa>("noise", "Pa", "standard deviation of the pressure")
        .within(0.0, 1e6)
        .with_realism(0.0, 3.0),
    latency_field<&BarometerParams::latency_s>(),
};
SIM_FIELDS(BarometerParams, kBarometerSettings)

constexpr Field kBarometerReading[] = {
    field<&BarometerReading::pressure_pa>("pressure", "Pa", "pressure of the air"),
};
SIM_FIELDS(BarometerReading, kBarometerReading)

DeviceKind barometer_kind() {
  return device_kind<BarometerParams, BarometerReading>(
      "barometer", {}, [](const DeviceConstruction& construction, const BarometerParams& params) {
        return std::make_unique<Barometer>(construction.name(), params,
                                           construction.robot.elevation.z_m, construction.noise());
      });
}

// --- airspeed

void Airspeed::measure(const StepContext& context) {
  const Twist& twist = context.body.twist;
  const Eigen::Vector3d along = mounting().in_body().linear().col(0);
  const double speed = along.x() * twist.v_mps + along.y() * twist.lateral_mps;
  next(context).pressure_pa =
      0.5 * kAirDensity_kgpm3 * speed * speed + noise().gaussian(params().noise_pa);
}

constexpr Field kAirspeedSettings[] = {
    frequency_field<&AirspeedParams::frequency_hz>(),
    field<&AirspeedParams::noise_pa>("noise", "Pa", "standard deviation of the pressure")
        .within(0.0, 1e6)
        .with_realism(0.0, 0.1),
    latency_field<&AirspeedParams::latency_s>(),
    include<AirspeedParams, SensorMount>(),
};
SIM_FIELDS(AirspeedParams, kAirspeedSettings)

constexpr Field kAirspeedReading[] = {
    field<&AirspeedReading::pressure_pa>("pressure", "Pa",
                                         "dynamic pressure along the sensor's x axis"),
};
SIM_FIELDS(AirspeedReading, kAirspeedReading)

DeviceKind airspeed_kind() {
  return device_kind<Airspeed, AirspeedParams, AirspeedReading>("airspeed", {});
}

// --- altimeter

void Altimeter::measure(const StepContext& context) {
  auto& reading = next(context);
  const Vec2 p_WB = context.body.X_WB.position();
  const double z_m = context.body.elevation.z_m;
  double ground_m = 0.0;
  for (const ObstacleDescription& o : context.world.arena.obstacles) {
    if (o.state != ObstacleState::kExtended || o.carried_by == context.robot) continue;
    const double top_m = standing_height_m(o);
    if (top_m <= z_m && top_m > ground_m && covers(o, p_WB)) ground_m = top_m;
  }
  reading.in_range = z_m - ground_m <= params().range_m;
  reading.height_m = z_m - ground_m + noise().gaussian(params().noise_m);
}

constexpr Field kAltimeterSettings[] = {
    frequency_field<&AltimeterParams::frequency_hz>(),
    field<&AltimeterParams::range_m>("range", "m", "greatest height that it measures")
        .above(0.0, 1e5),
    noise_field<&AltimeterParams::noise_m>("standard deviation of the height")
        .with_realism(0.0, 0.05),
    latency_field<&AltimeterParams::latency_s>(),
};
SIM_FIELDS(AltimeterParams, kAltimeterSettings)

constexpr Field kAltimeterReading[] = {
    field<&AltimeterReading::height_m>("height", "m", "above the floor or an obstacle"),
    field<&AltimeterReading::in_range>("in_range", "",
                                       "whether the height is within the sensor's range"),
};
SIM_FIELDS(AltimeterReading, kAltimeterReading)

DeviceKind altimeter_kind() {
  return device_kind<Altimeter, AltimeterParams, AltimeterReading>("altimeter", {});
}

// --- thermometer

void Thermometer::measure(const StepContext& context) {
  const Vec2 p_WB = context.body.X_WB.position();
  double temperature_c = params().air_c;
  const auto feel = [&](const std::vector<std::string>& tags, const Vec2& p_W) {
    if (!std::ranges::binary_search(tags, params().tag)) return;
    const double distance_m = (p_W - p_WB).norm();
    if (distance_m > params().range_m) return;
    temperature_c += params().fire_c * math::exp(-params().attenuation_1pm * distance_m);
  };
  for (int i = 0; i < context.physics.robot_count(); ++i) {
    if (i == context.robot) continue;
    feel(context.world.robots[static_cast<std::size_t>(i)].tags,
         context.physics.body(i).X_WB.position());
  }
  for (const ObstacleDescription& o : context.world.arena.obstacles) {
    if (o.state == ObstacleState::kExtended) feel(o.tags, o.center);
  }
  next(context).temperature_c = temperature_c + noise().gaussian(params().noise_c);
}

constexpr Field kThermometerSettings[] = {
    frequency_field<&ThermometerParams::frequency_hz>(),
    field<&ThermometerParams::air_c>("air", "degrees C", "temperature far from all fires")
        .within(-273.15, 1e4),
    field<&ThermometerParams::fire_c>("fire", "degrees C", "what a fire adds at its place")
        .within(0.0, 1e4),
    field<&ThermometerParams::attenuation_1pm>("attenuation", "1/m",
                                               "rate of its decrease with the distance")
        .within(0.0, 1000.0),
    field<&ThermometerParams::range_m>("range", "m", "fires farther away add nothing")
        .above(0.0, 1e6),
    field<&ThermometerParams::tag>("tag", "", "robots and obstacles with this tag are fires"),
    field<&ThermometerParams::noise_c>("noise", "degrees C",
                                       "standard deviation of the temperature")
        .within(0.0, 1e4)
        .with_realism(0.0, 0.1),
    latency_field<&ThermometerParams::latency_s>(),
};
SIM_FIELDS(ThermometerParams, kThermometerSettings)

constexpr Field kThermometerReading[] = {
    field<&ThermometerReading::temperature_c>("temperature", "degrees C", "temperature of the air"),
};
SIM_FIELDS(ThermometerReading, kThermometerReading)

DeviceKind thermometer_kind() {
  return device_kind<Thermometer, ThermometerParams, ThermometerReading>("thermometer", {});
}

// --- clock

ClockSensor::ClockSensor(std::string name, const ClockParams& params)
    : SensorOf(std::move(name), "clock", params.frequency_hz) {}

void ClockSensor::measure(const StepContext& context) { static_cast<void>(next(context)); }

constexpr Field kClockSettings[] = {
    frequency_field<&ClockParams::frequency_hz>(),
};
SIM_FIELDS(ClockParams, kClockSettings)
SIM_FIELDS(ClockReading, {})

DeviceKind clock_kind() { return device_kind<ClockSensor, ClockParams, ClockReading>("clock", {}); }

}  // namespace sim
