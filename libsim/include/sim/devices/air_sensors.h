// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "sim/devices/noisy_sensor.h"

/// @file
/// Sensors of air and height, as MORSE has them: barometer, airspeed, altimeter, thermometer; and
/// MORSE's clock.
namespace sim {

/// Settings of a barometer.
struct BarometerParams {
  double frequency_hz = 10.0;      ///< [Hz]
  double reference_pa = 101325.0;  ///< pressure at the robot's height at the start [Pa]
  double noise_pa = 0.0;           ///< standard deviation [Pa]
  double latency_s = 0.0;          ///< [s]
};

/// A reading of a barometer.
struct BarometerReading final : Reading {
  double pressure_pa = 0.0;  ///< [Pa]
};

/// Pressure of the standard atmosphere at a height, for the troposphere (ICAO Doc 7488/3, 1993,
/// with the constants of MORSE 1.4's barometer.py).
/// @param reference_pa  pressure at height 0 [Pa].
/// @param height_m      < 44 330 m.
[[nodiscard]] double pressure_at_pa(double reference_pa, double height_m);

/// Measures the pressure of the air.
class Barometer final : public NoisySensor<BarometerParams, BarometerReading> {
 public:
  /// @param start_m  height of the robot at the start.
  Barometer(std::string name, const BarometerParams& params, double start_m, RandomStream noise);

 protected:
  void measure(const StepContext& context) override;

 private:
  double start_m_;
};

/// Settings of an airspeed sensor.
struct AirspeedParams : SensorMount {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_pa = 0.0;       ///< standard deviation [Pa]
  double latency_s = 0.0;      ///< [s]
};

/// A reading of an airspeed sensor.
struct AirspeedReading final : Reading {
  double pressure_pa = 0.0;  ///< dynamic pressure along the sensor's x axis [Pa]
};

/// Density of air at sea level, 15 degrees C (ICAO Doc 7488/3) [kg/m^3].
inline constexpr double kAirDensity_kgpm3 = 1.225;

/// A pitot tube in still air: half the density times the square of the speed along its axis.
class Airspeed final : public MountedSensor<AirspeedParams, AirspeedReading> {
 public:
  Airspeed(std::string name, const AirspeedParams& params, RandomStream noise)
      : MountedSensor(std::move(name), "airspeed", params, std::move(noise)) {}

 protected:
  void measure(const StepContext& context) override;
};

/// Settings of an altimeter.
struct AltimeterParams {
  double frequency_hz = 10.0;  ///< [Hz]
  double range_m = 30.0;       ///< [m]
  double noise_m = 0.0;        ///< standard deviation [m]
  double latency_s = 0.0;      ///< [s]
};

/// A reading of an altimeter.
struct AltimeterReading final : Reading {
  double height_m = 0.0;  ///< over the floor or what stands there [m]; meaningless out of range
  bool in_range = false;
};

/// Measures the robot's height over the floor, or over the extended obstacle under its centre
/// (MORSE's RadarAltimeter).
class Altimeter final : public NoisySensor<AltimeterParams, AltimeterReading> {
 public:
  Altimeter(std::string name, const AltimeterParams& params, RandomStream noise)
      : NoisySensor(std::move(name), "altimeter", params, std::move(noise)) {}

 protected:
  void measure(const StepContext& context) override;
};

/// Settings of a thermometer.
struct ThermometerParams {
  double frequency_hz = 10.0;    ///< [Hz]
  double air_c = 15.0;           ///< temperature far from all fires [degrees C]
  double fire_c = 200.0;         ///< what a fire adds at its place [degrees C]
  double attenuation_1pm = 0.2;  ///< of the temperature with the distance [1/m]
  double range_m = 1000.0;       ///< farther fires are not felt [m]
  std::string tag = "Fire";      ///< obstacles and robots with this tag are fires
  double noise_c = 0.0;          ///< standard deviation [degrees C]
  double latency_s = 0.0;        ///< [s]
};

/// A reading of a thermometer.
struct ThermometerReading final : Reading {
  double temperature_c = 0.0;  ///< [degrees C]
};

/// Measures the temperature of the air: air + sum over all fires of fire exp(-attenuation distance)
/// (MORSE's Thermometer).
class Thermometer final : public NoisySensor<ThermometerParams, ThermometerReading> {
 public:
  Thermometer(std::string name, const ThermometerParams& params, RandomStream noise)
      : NoisySensor(std::move(name), "thermometer", params, std::move(noise)) {}

 protected:
  void measure(const StepContext& context) override;
};

/// Settings of a clock.
struct ClockParams {
  double frequency_hz = 10.0;  ///< [Hz]
};

/// A reading of a clock: its time stamp.
struct ClockReading final : Reading {};

/// A sensor whose readings have a time and nothing else (MORSE's Clock).
class ClockSensor final : public SensorOf<ClockReading> {
 public:
  ClockSensor(std::string name, const ClockParams& params);

 protected:
  void measure(const StepContext& context) override;
};

}  // namespace sim
