// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace sim {

/// In which coordinates a device's messages in MORSE's protocol are: MORSE's modifiers UTM, NED,
/// ECEF, geodetic and feet. A device's readings and commands themselves are always in W.
struct CoordinateParams {
  bool ned = false;       ///< x north, y east, z down; W has x east, y north, z up
  bool feet = false;      ///< lengths in feet
  bool utm = false;       ///< adds utm_offset_m
  bool ecef = false;      ///< earth-centred, earth-fixed
  bool geodetic = false;  ///< x longitude, y latitude [degrees], z altitude [m]
  Eigen::Vector3d utm_offset_m = Eigen::Vector3d::Zero();
  /// @name Of W's origin, for ECEF and geodetic
  /// @{
  double latitude_deg = 0.0;   ///< [degrees]
  double longitude_deg = 0.0;  ///< [degrees]
  double altitude_m = 0.0;     ///< over the ellipsoid [m]
  double north_deg = 90.0;     ///< direction of north in W, counter-clockwise from x [degrees]
  /// @}

  [[nodiscard]] bool any() const { return ned || feet || utm || ecef || geodetic; }
};

/// A position in W in the coordinates of the messages.
[[nodiscard]] Eigen::Vector3d to_message(const CoordinateParams& params,
                                         const Eigen::Vector3d& p_W);
/// The inverse of to_message().
[[nodiscard]] Eigen::Vector3d from_message(const CoordinateParams& params,
                                           const Eigen::Vector3d& p);

/// Earth-centred coordinates of a point over the WGS 84 ellipsoid [m]; angles in radians.
[[nodiscard]] Eigen::Vector3d ecef_of(double latitude_rad, double longitude_rad, double altitude_m);
/// Longitude and latitude [rad] and altitude [m] of a point, by H. Vermeille, "Direct
/// transformation from geocentric coordinates to geodetic coordinates", J. Geodesy 76, 2002.
[[nodiscard]] Eigen::Vector3d geodetic_of(const Eigen::Vector3d& ecef_m);

}  // namespace sim
