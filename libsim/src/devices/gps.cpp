// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/gps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "devices/device_kind.h"
#include "devices/modifiers.h"
#include "sim/core/degrees.h"
#include "sim/core/math.h"

namespace sim {
namespace {

constexpr double kUtmScale = 0.9996;
constexpr int kLeastSatellites = 4;  // three coordinates and the receiver's clock

}  // namespace

GeoPoint shifted(const GeoPoint& from, double east_m, double north_m, double altitude_m,
                 const Ellipsoid& ellipsoid) {
  const double a = ellipsoid.semi_major_axis_m;
  const double e2 = ellipsoid.flattening * (2.0 - ellipsoid.flattening);
  const double s = math::sin(from.latitude_rad);
  const double w2 = 1.0 - e2 * s * s;
  const double across_m = a / std::sqrt(w2);                     // N, radius along the parallel
  const double along_m = a * (1.0 - e2) / (w2 * std::sqrt(w2));  // M, along the meridian
  return {from.latitude_rad + north_m / (along_m + altitude_m),
          normalize_angle(from.longitude_rad +
                          east_m / ((across_m + altitude_m) * math::cos(from.latitude_rad)))};
}

Vec2 transverse_mercator_m(const GeoPoint& point, double central_rad, double scale,
                           const Ellipsoid& ellipsoid) {
  const double a = ellipsoid.semi_major_axis_m;
  const double e2 = ellipsoid.flattening * (2.0 - ellipsoid.flattening);
  const double e4 = e2 * e2;
  const double e6 = e4 * e2;
  const double second_e2 = e2 / (1.0 - e2);
  const double latitude = point.latitude_rad;
  const auto [s, c] = math::sin_cos(latitude);
  const double t = (s / c) * (s / c);  // T, C, A and M in Snyder's notation
  const double cc = second_e2 * c * c;
  const double x = normalize_angle(point.longitude_rad - central_rad) * c;
  const double n = a / std::sqrt(1.0 - e2 * s * s);
  const double meridian_m =
      a * ((1.0 - e2 / 4.0 - 3.0 * e4 / 64.0 - 5.0 * e6 / 256.0) * latitude -
           (3.0 * e2 / 8.0 + 3.0 * e4 / 32.0 + 45.0 * e6 / 1024.0) * math::sin(2.0 * latitude) +
           (15.0 * e4 / 256.0 + 45.0 * e6 / 1024.0) * math::sin(4.0 * latitude) -
           (35.0 * e6 / 3072.0) * math::sin(6.0 * latitude));
  const double x2 = x * x;
  const double east =
      n * x *
      (1.0 + x2 * ((1.0 - t + cc) / 6.0 +
                   x2 * (5.0 - 18.0 * t + t * t + 72.0 * cc - 58.0 * second_e2) / 120.0));
  const double north =
      meridian_m +
      n * (s / c) * x2 *
          (0.5 + x2 * ((5.0 - t + 9.0 * cc + 4.0 * cc * cc) / 24.0 +
                       x2 * (61.0 - 58.0 * t + t * t + 600.0 * cc - 330.0 * second_e2) / 720.0));
  return {scale * east, scale * north};
}

int utm_zone(double longitude_rad) {
  const int zone =
      static_cast<int>(std::floor((normalize_angle(longitude_rad) / kDegrees + 180.0) / 6.0)) + 1;
  return std::clamp(zone, 1, 60);
}

Vec2 utm_m(const GeoPoint& point, int zone) {
  const double central_rad = (6.0 * zone - 183.0) * kDegrees;
  const Vec2 p = transverse_mercator_m(point, central_rad, kUtmScale);
  return p + Vec2(500'000.0, point.latitude_rad < 0.0 ? 10'000'000.0 : 0.0);
}

Gps::Gps(std::string name, const GpsParams& params, RandomStream noise)
    : SensorOf(std::move(name), "gps", params.frequency_hz, params.latency_s),
      params_(params),
      noise_(std::move(noise)),
      zone_(utm_zone(params.longitude_rad)) {}

void Gps::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.satellites = params_.satellites;
  if (params_.satellites < kLeastSatellites) return;
  reading.quality = 1;
  const Pose& X_WB = context.body.X_WB;
  const auto [s, c] = math::sin_cos(params_.north_rad);
  const double north_m = c * X_WB.x_m + s * X_WB.y_m + noise_.gaussian(params_.noise_m);
  const double east_m = s * X_WB.x_m - c * X_WB.y_m + noise_.gaussian(params_.noise_m);
  const GeoPoint place =
      shifted({params_.latitude_rad, params_.longitude_rad}, east_m, north_m, params_.altitude_m);
  reading.latitude_rad = place.latitude_rad;
  reading.longitude_rad = place.longitude_rad;
  reading.altitude_m =
      params_.altitude_m + context.body.elevation.z_m + noise_.gaussian(params_.noise_vertical_m);
  const Vec2 utm = utm_m(place, zone_);
  reading.utm_easting_m = utm.x();
  reading.utm_northing_m = utm.y();

  reading.position_m = {c * north_m + s * east_m, s * north_m - c * east_m,
                        reading.altitude_m - params_.altitude_m};
  const double heading_rad = normalize_angle(params_.north_rad - X_WB.yaw_rad);
  reading.heading_rad = heading_rad < 0.0 ? heading_rad + 2.0 * std::numbers::pi : heading_rad;

  const Twist& twist = context.body.twist;
  reading.speed_mps = math::hypot(twist.v_mps, twist.lateral_mps);
  reading.course_rad = 0.0;
  if (reading.speed_mps > 0.0) {
    const double heading = X_WB.yaw_rad + math::atan2(twist.lateral_mps, twist.v_mps);
    const double course = normalize_angle(params_.north_rad - heading);
    reading.course_rad = course < 0.0 ? course + 2.0 * std::numbers::pi : course;
  }
  reading.velocity_mps = {reading.speed_mps * math::sin(reading.course_rad),
                          reading.speed_mps * math::cos(reading.course_rad), 0.0};
}

void Gps::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_);
}

// In MORSE 1.4, GPS has the modifier PositionNoise under both names.
constexpr const char* kGpsNoiseNames[] = {"PoseNoise", "Noise"};
constexpr ModifierParameter kGpsNoise[] = {
    {"pos_std",
     0.05,
     {0.0, 100.0, false, "m"},
     "noise noise_vertical",
     [](void* params, double value) {
       auto& gps = *static_cast<GpsParams*>(params);
       gps.noise_m = gps.noise_vertical_m = value;
     }},
};
constexpr Modifier kGpsModifiers[] = {{kGpsNoiseNames, kGpsNoise}, kUtmModifier<GpsParams>,
                                      kNedModifier<GpsParams>,     kFeetModifier<GpsParams>,
                                      kEcefModifier<GpsParams>,    kGeodeticModifier<GpsParams>};
constexpr const char* kGpsLevels[] = {"simple", "raw", "extended"};

constexpr Field kGpsSettings[] = {
    frequency_field<&GpsParams::frequency_hz>(),
    // Snyder's series, like UTM, do not cover the poles.
    field<&GpsParams::latitude_rad>("latitude_deg", "degrees",
                                    "of the world's origin, north positive")
        .within(-84.0, 84.0),
    field<&GpsParams::longitude_rad>("longitude_deg", "degrees",
                                     "of the world's origin, east positive")
        .within(-180.0, 180.0),
    field<&GpsParams::altitude_m>("altitude", "m", "of the floor, over the ellipsoid")
        .within(-1000.0, 100'000.0),
    north_field<&GpsParams::north_rad>(),
    noise_field<&GpsParams::noise_m>("standard deviation to the east, and to the north")
        .with_realism(0.0, 2.12),
    field<&GpsParams::noise_vertical_m>("noise_vertical", "m", "standard deviation of the altitude")
        .within(0.0, 100.0)
        .with_realism(0.0, 4.24),
    field<&GpsParams::satellites>("satellites", "", "in view; with fewer than 4 there is no fix")
        .within(0, 64),
    field<&GpsParams::level>(
        "level", "", "form of MORSE's stream: `\"simple\"`, `\"raw\"` or `\"extended\"`, see below")
        .one_of(kGpsLevels),
    latency_field<&GpsParams::latency_s>(),
    modifiers_field<kGpsModifiers>(),
};
SIM_FIELDS(GpsParams, kGpsSettings)

constexpr Field kGpsReading[] = {
    field<&GpsReading::latitude_rad>("latitude", "rad", "north is positive"),
    field<&GpsReading::longitude_rad>("longitude", "rad", "east is positive"),
    field<&GpsReading::altitude_m>("altitude", "m", "over the ellipsoid"),
    field<&GpsReading::speed_mps>("speed", "m/s", "over ground"),
    field<&GpsReading::course_rad>("course", "rad", "over ground, clockwise from north"),
    field<&GpsReading::utm_easting_m>("utm_easting", "m", "in the zone of the world's origin"),
    field<&GpsReading::utm_northing_m>("utm_northing", "m", "in the zone of the world's origin"),
    field<&GpsReading::satellites>("satellites", "", "in view"),
    field<&GpsReading::quality>("quality", "", "1: a fix; 0: none, then all other numbers are 0"),
    field<&GpsReading::position_m>("position", "m", "in the world"),
    field<&GpsReading::velocity_mps>("velocity", "m/s", "to the east, to the north, upwards"),
    field<&GpsReading::heading_rad>("heading", "rad", "of the robot, clockwise from north"),
};
SIM_FIELDS(GpsReading, kGpsReading)

DeviceKind gps_kind() { return device_kind<Gps, GpsParams, GpsReading>("gps", {{"gps"}}); }

}  // namespace sim
