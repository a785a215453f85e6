// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_records.h"

#include <array>
#include <bit>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "sim/core/base64.h"
#include "sim/core/degrees.h"
#include "sim/devices/air_sensors.h"
#include "sim/devices/camera.h"
#include "sim/devices/depth_camera.h"
#include "sim/devices/hand.h"
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

// The matrix that projects a point of a camera's frame (x right, y down, z ahead) to pixels.
json intrinsic(double focal_px, int width, double centre_px) {
  return {{focal_px, 0.0, 0.5 * width}, {0.0, focal_px, centre_px}, {0.0, 0.0, 1.0}};
}

// Red, green, blue and alpha of each pixel, as MORSE's pictures have them.
std::vector<std::uint8_t> with_alpha(const std::vector<std::uint8_t>& rgb) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(rgb.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    rgba.insert(rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
  }
  return rgba;
}

void put_float(std::vector<std::uint8_t>& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
}

// x, y and z of each point as floats, row by row from the bottom, as MORSE's points come.
std::vector<std::uint8_t> points_of(const sim::DepthCameraReading& reading) {
  std::vector<std::uint8_t> bytes;
  const auto width = static_cast<std::size_t>(reading.width);
  for (std::size_t row = width == 0 ? 0 : reading.depths_m.size() / width; row-- > 0;) {
    for (std::size_t column = 0; column < width; ++column) {
      const double depth_m = reading.depths_m[row * width + column];
      if (depth_m <= 0.0) continue;
      const double per_px = depth_m / reading.focal_px;
      put_float(bytes, (static_cast<double>(column) + 0.5 - 0.5 * reading.width) * per_px);
      put_float(bytes, (static_cast<double>(row) + 0.5 - reading.centre_px) * per_px);
      put_float(bytes, depth_m);
    }
  }
  return bytes;
}

}  // namespace

bool put_picture_record(json& object, const sim::Reading& reading, const StreamFormat& format) {
  if (const auto* camera = dynamic_cast<const sim::CameraReading*>(&reading)) {
    const sim::PinholeView view{camera->width, camera->height, format.field_of_view_rad};
    object["height"] = camera->height;
    object["width"] = camera->width;
    object["image"] = sim::to_base64(with_alpha(camera->pixels));
    object["intrinsic_matrix"] = intrinsic(view.focal_px(), camera->width, 0.5 * camera->height);
  } else if (const auto* depth = dynamic_cast<const sim::DepthCameraReading*>(&reading)) {
    object["height"] = depth->height;
    object["width"] = depth->width;
    object["points"] = sim::to_base64(points_of(*depth));
    object["intrinsic_matrix"] = intrinsic(depth->focal_px, depth->width, depth->centre_px);
  } else if (const auto* hand = dynamic_cast<const sim::HandReading*>(&reading)) {
    object["held"] = hand->held;
    object["near"] = hand->near;
  } else {
    return false;
  }
  return true;
}

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
