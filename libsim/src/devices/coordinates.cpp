// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/coordinates.h"

#include <cmath>
#include <utility>

#include "sim/core/degrees.h"
#include "sim/core/math.h"
#include "sim/devices/gps.h"

namespace sim {
namespace {

constexpr double kFeet = 3.2808399;  // a metre in feet, as in MORSE's feet.py

double eccentricity2() {
  const Ellipsoid e;
  return e.flattening * (2.0 - e.flattening);
}

// The rotation from W to east, north, up.
Eigen::Matrix3d east_north_up(double north_deg) {
  const double turn = (90.0 - north_deg) * kDegrees;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << math::cos(turn), -math::sin(turn), math::sin(turn), math::cos(turn);
  return R;
}

// The rotation from east, north, up at a point of the Earth to the Earth's axes.
Eigen::Matrix3d earth_axes(double latitude_rad, double longitude_rad) {
  const auto [so, co] = math::sin_cos(longitude_rad);
  const auto [sa, ca] = math::sin_cos(latitude_rad);
  Eigen::Matrix3d R;
  R << -so, -co * sa, ca * co, co, -sa * so, ca * so, 0.0, ca, sa;
  return R;
}

struct Origin {
  Eigen::Vector3d p_m;
  Eigen::Matrix3d R;  // from W to the Earth's axes
};

Origin origin_of(const CoordinateParams& params) {
  const double latitude = params.latitude_deg * kDegrees;
  const double longitude = params.longitude_deg * kDegrees;
  return {ecef_of(latitude, longitude, params.altitude_m),
          earth_axes(latitude, longitude) * east_north_up(params.north_deg)};
}

}  // namespace

Eigen::Vector3d ecef_of(double latitude_rad, double longitude_rad, double altitude_m) {
  const auto [s, c] = math::sin_cos(latitude_rad);
  const double e2 = eccentricity2();
  const double n = Ellipsoid{}.semi_major_axis_m / std::sqrt(1.0 - e2 * s * s);
  return {(n + altitude_m) * c * math::cos(longitude_rad),
          (n + altitude_m) * c * math::sin(longitude_rad), (n * (1.0 - e2) + altitude_m) * s};
}

Eigen::Vector3d geodetic_of(const Eigen::Vector3d& ecef_m) {
  // The names are those of the paper.
  const double a = Ellipsoid{}.semi_major_axis_m;
  const double e2 = eccentricity2();
  const double e4 = e2 * e2;
  const double across_m = math::hypot(ecef_m.x(), ecef_m.y());
  const double p = across_m * across_m / (a * a);
  const double q = (1.0 - e2) / (a * a) * ecef_m.z() * ecef_m.z();
  const double r = (p + q - e4) / 6.0;
  const double s = e4 * p * q / (4.0 * r * r * r);
  const double t = math::cbrt(1.0 + s + std::sqrt(s * (2.0 + s)));
  const double u = r * (1.0 + t + 1.0 / t);
  const double v = std::sqrt(u * u + e4 * q);
  const double w = e2 * (u + v - q) / (2.0 * v);
  const double k = std::sqrt(u + v + w * w) - w;
  const double d = k * across_m / (k + e2);
  const double far = math::hypot(d, ecef_m.z());
  return {math::atan2(ecef_m.y(), ecef_m.x()), 2.0 * math::atan2(ecef_m.z(), d + far),
          (k + e2 - 1.0) / k * far};
}

Eigen::Vector3d to_message(const CoordinateParams& params, const Eigen::Vector3d& p_W) {
  Eigen::Vector3d p = p_W;
  if (params.ecef || params.geodetic) {
    const Origin origin = origin_of(params);
    p = origin.p_m + origin.R * p;
    if (params.geodetic) {
      p = geodetic_of(p);
      p.head<2>() /= kDegrees;
    }
  }
  if (params.utm) p += params.utm_offset_m;
  if (params.ned) p = {p.y(), p.x(), -p.z()};
  if (params.feet) p *= kFeet;
  return p;
}

Eigen::Vector3d from_message(const CoordinateParams& params, const Eigen::Vector3d& message) {
  Eigen::Vector3d p = message;
  if (params.feet) p /= kFeet;
  if (params.ned) p = {p.y(), p.x(), -p.z()};
  if (params.utm) p -= params.utm_offset_m;
  if (params.ecef || params.geodetic) {
    const Origin origin = origin_of(params);
    if (params.geodetic) p = ecef_of(p.y() * kDegrees, p.x() * kDegrees, p.z());
    p = origin.R.transpose() * (p - origin.p_m);
  }
  return p;
}

}  // namespace sim
