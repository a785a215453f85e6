// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_records.h"

#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "sim/core/degrees.h"
#include "sim/devices/air_sensors.h"
#include "sim/devices/posture.h"
#include "sim/devices/semantic_camera.h"
#include "sim/devices/space_sensors.h"

namespace playerlike::server {
namespace {

using nlohmann::json;

// Days from 1970 as a civil date; H. Hinnant, "chrono-compatible low-level date algorithms", 2013.
std::array<int, 3> civil_date(long days) {
  const long shifted = days + 719468;
  const long era = shifted / 146097;
  const long of_era = shifted - era * 146097;
  const long year_of_era = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  const long of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const long month = (5 * of_year + 2) / 153;
  const long day = of_year - (153 * month + 2) / 5 + 1;
  const long civil_month = month < 10 ? month + 3 : month - 9;
  return {static_cast<int>(year_of_era + era * 400 + (civil_month <= 2 ? 1 : 0)),
          static_cast<int>(civil_month), static_cast<int>(day)};
}

std::string two_digits(long value) {
  return {static_cast<char>('0' + value / 10 % 10), static_cast<char>('0' + value % 10)};
}

// Date and time of a moment of simulated time, as DDMMYY and HHMMSS; time 0 is 1970-01-01.
void put_date(json& object, sim::SimTime time_ns) {
  const long seconds = static_cast<long>(time_ns / sim::kNanosecondsPerSecond);
  const auto [year, month, day] = civil_date(seconds / 86400);
  object["date"] = two_digits(day) + two_digits(month) + two_digits(year % 100);
  object["time"] =
      two_digits(seconds / 3600 % 24) + two_digits(seconds / 60 % 60) + two_digits(seconds % 60);
}

void put_gps(json& object, const sim::GpsReading& gps, const StreamFormat& format) {
  if (format.gps == sim::GpsLevel::kSimple) {
    const Eigen::Vector3d p =
        to_message(format.coordinates, {gps.position_m[0], gps.position_m[1], gps.position_m[2]});
    object["x"] = p.x();
    object["y"] = p.y();
    object["z"] = p.z();
    return;
  }
  object["latitude"] = gps.latitude_rad / sim::kDegrees;
  object["longitude"] = gps.longitude_rad / sim::kDegrees;
  object["altitude"] = gps.altitude_m;
  object["velocity"] = gps.velocity_mps;
  if (format.gps == sim::GpsLevel::kRaw) return;
  put_date(object, gps.time_ns);
  // MORSE's is infinite at rest, which JSON cannot express.
  object["heading"] = gps.heading_rad / sim::kDegrees;
}

void put_posture(json& object, const sim::PostureReading& posture) {
  for (std::size_t i = 0; i < posture.joints.size() && i < posture.positions.size(); ++i) {
    // MORSE's tilt is positive downwards.
    object[posture.joints[i]] =
        posture.joints[i] == "tilt" ? -posture.positions[i] : posture.positions[i];
  }
}

json seen(const sim::SemanticCameraReading& reading) {
  json all = json::array();
  for (const auto& object : reading.objects) {
    all.push_back({{"name", object.name},
                   {"description", ""},
                   {"type", object.type},
                   {"position", object.position_m},
                   {"orientation",
                    {{"x", object.vector[0]},
                     {"y", object.vector[1]},
                     {"z", object.vector[2]},
                     {"w", object.scalar}}}});
  }
  return all;
}

}  // namespace

bool put_space_record(json& object, const sim::Reading& reading, const StreamFormat& format) {
  if (const auto* gps = dynamic_cast<const sim::GpsReading*>(&reading)) {
    put_gps(object, *gps, format);
  } else if (const auto* velocity = dynamic_cast<const sim::VelocityReading*>(&reading)) {
    object["linear_velocity"] = velocity->linear_mps;
    object["angular_velocity"] = velocity->angular_radps;
    object["world_linear_velocity"] = velocity->world_mps;
  } else if (const auto* motion = dynamic_cast<const sim::AccelerometerReading*>(&reading)) {
    object["distance"] = motion->distance_m;
    object["velocity"] = motion->velocity_mps;
    object["acceleration"] = motion->acceleration_mps2;
    object["angular_acceleration"] = motion->angular_radps2;
  } else if (const auto* gyroscope = dynamic_cast<const sim::GyroscopeReading*>(&reading)) {
    object["yaw"] = gyroscope->yaw_rad;
    object["pitch"] = gyroscope->pitch_rad;
    object["roll"] = gyroscope->roll_rad;
  } else if (const auto* attitude = dynamic_cast<const sim::AttitudeReading*>(&reading)) {
    object["rotation"] = {
        {"yaw", attitude->yaw_rad}, {"pitch", attitude->pitch_rad}, {"roll", attitude->roll_rad}};
    object["angular_velocity"] = attitude->rate_radps;
  } else if (const auto* barometer = dynamic_cast<const sim::BarometerReading*>(&reading)) {
    object["pressure"] = barometer->pressure_pa;
  } else if (const auto* airspeed = dynamic_cast<const sim::AirspeedReading*>(&reading)) {
    object["diff_pressure"] = airspeed->pressure_pa;
  } else if (const auto* altimeter = dynamic_cast<const sim::AltimeterReading*>(&reading)) {
    object["z"] =
        altimeter->in_range ? altimeter->height_m : std::numeric_limits<double>::infinity();
  } else if (const auto* thermometer = dynamic_cast<const sim::ThermometerReading*>(&reading)) {
    object["temperature"] = thermometer->temperature_c;
  } else if (const auto* posture = dynamic_cast<const sim::PostureReading*>(&reading)) {
    put_posture(object, *posture);
  } else if (const auto* camera = dynamic_cast<const sim::SemanticCameraReading*>(&reading)) {
    object["visible_objects"] = seen(*camera);
  } else {
    return dynamic_cast<const sim::ClockReading*>(&reading) != nullptr;
  }
  return true;
}

}  // namespace playerlike::server
