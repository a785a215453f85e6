// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "sim/devices/coordinates.h"
#include "sim/devices/device.h"

namespace sim {

/// Which part of its data a gps device shows to clients that use MORSE's protocol, by MORSE's
/// names.
enum class GpsLevel {
  kSimple,    ///< x, y, z in W
  kRaw,       ///< latitude, longitude, altitude and velocity
  kExtended,  ///< the same, and date, time and heading
};

/// Settings of a satellite receiver. The origin of W has a latitude and a longitude on the Earth,
/// by default in Prague.
struct GpsParams : CoordinateParams {
  double frequency_hz = 10.0;                                 ///< [Hz]
  double latitude_rad = 50.0764 * std::numbers::pi / 180.0;   ///< of W's origin, north > 0
  double longitude_rad = 14.4178 * std::numbers::pi / 180.0;  ///< of W's origin, east > 0
  double altitude_m = 200.0;                  ///< of the floor, above the ellipsoid [m]
  double north_rad = 0.5 * std::numbers::pi;  ///< direction of north in W, counter-clockwise from x
  double noise_m = 0.0;           ///< standard deviation to the east and to the north [m]
  double noise_vertical_m = 0.0;  ///< standard deviation of the altitude [m]
  int satellites = 8;             ///< in view, 0 to 64; below 4 there is no fix
  double latency_s = 0.0;         ///< [s]
  GpsLevel level = GpsLevel::kExtended;
};

/// Statement of a receiver about the errors of its position.
struct GpsAccuracy {
  double horizontal_m = 0.0;
  double vertical_m = 0.0;
  double horizontal_dilution = 0.0;  ///< of precision (HDOP)
  double vertical_dilution = 0.0;    ///< VDOP
};

/// Position of a receiver. Without a fix (quality 0), all numbers except time and satellites are 0.
struct GpsReading final : Reading {
  double latitude_rad = 0.0;   ///< north > 0
  double longitude_rad = 0.0;  ///< east > 0, (-pi, pi]
  double altitude_m = 0.0;     ///< above the ellipsoid [m]
  double speed_mps = 0.0;      ///< over ground [m/s]
  double course_rad = 0.0;     ///< of motion, clockwise from north, [0, 2 pi); 0 at rest
  double utm_easting_m = 0.0;  ///< in the zone of W's origin [m]
  double utm_northing_m = 0.0;
  int satellites = 0;
  int quality = 0;                       ///< 1: a fix, 0: none
  std::array<double, 3> position_m{};    ///< in W, with the same errors [m]
  std::array<double, 3> velocity_mps{};  ///< to the east, to the north, upwards [m/s]
  double heading_rad = 0.0;              ///< of the robot, clockwise from north, [0, 2 pi)
  /// What a real receiver states about its errors; nothing: the device's settings tell, as of all
  /// simulated receivers.
  std::optional<GpsAccuracy> accuracy;
};

/// A point on an ellipsoid of revolution.
struct GeoPoint {
  double latitude_rad;   ///< geodetic, north > 0
  double longitude_rad;  ///< east > 0
};

/// An ellipsoid of revolution; the defaults are WGS 84 (NIMA TR8350.2, 3rd ed., 2000, table 3.1).
struct Ellipsoid {
  double semi_major_axis_m = 6378137.0;
  double flattening = 1.0 / 298.257223563;
};

/// The point that is east and north of another one by the given distances, measured on the plane
/// that touches the ellipsoid there. The distances are divided by the radii of curvature along the
/// parallel and the meridian at the floor's altitude (Snyder, Map Projections - A Working Manual,
/// USGS Professional Paper 1395, 1987, eq. 4-18 and 4-20). Against the curved Earth the error is
/// about e n tan(latitude) / radius for the distances e and n: 0.2 m for 1 km each.
[[nodiscard]] GeoPoint shifted(const GeoPoint& from, double east_m, double north_m,
                               double altitude_m, const Ellipsoid& ellipsoid = {});

/// Transverse Mercator projection, computed by its series (Snyder, eq. 3-21, 8-9 and 8-10).
/// @param central_rad  longitude of the central meridian.
/// @param scale        scale factor along it, 0.9996 in UTM.
/// @return [m] east of the central meridian and north of the equator; accurate to a millimetre
///     within 4 degrees of the meridian.
[[nodiscard]] Vec2 transverse_mercator_m(const GeoPoint& point, double central_rad, double scale,
                                         const Ellipsoid& ellipsoid = {});

/// Number of the UTM zone of a longitude, 1 to 60. The exceptions for Norway and Spitsbergen are
/// not implemented.
[[nodiscard]] int utm_zone(double longitude_rad);

/// UTM coordinates [m]: easting with 500 km at the zone's central meridian, northing from the
/// equator, with 10 000 km added south of it.
[[nodiscard]] Vec2 utm_m(const GeoPoint& point, int zone);

/// A satellite receiver at the centre of the axle: the true position with Gaussian noise, drawn
/// independently for each reading (the errors of real receivers drift). Speed and course are exact.
class Gps final : public SensorOf<GpsReading> {
 public:
  Gps(std::string name, const GpsParams& params, RandomStream noise);

  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  GpsParams params_;
  RandomStream noise_;
  int zone_;
};

}  // namespace sim
