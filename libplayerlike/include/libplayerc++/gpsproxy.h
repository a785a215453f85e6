// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A satellite receiver. All values are of the newest reading; before the first, and without a fix
/// (GetQuality() is 0), they are 0.
class GpsProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  GpsProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~GpsProxy() override;

  double GetLatitude() const;      ///< north positive [degrees]
  double GetLongitude() const;     ///< east positive [degrees]
  double GetAltitude() const;      ///< over the ellipsoid [m]
  double GetSpeed() const;         ///< over ground [m/s]
  double GetCourse() const;        ///< of motion, clockwise from north, [0, 2 pi) [rad]
  uint32_t GetSatellites() const;  ///< in view
  uint32_t GetQuality() const;     ///< 1: a fix, 0: none
  /// Dilution of precision: 1 with a fix, as the simulated receiver's noise is what the world says.
  double GetHdop() const;
  double GetVdop() const;           ///< the same of the altitude
  double GetUtmEasting() const;     ///< in the zone of the world's origin [m]
  double GetUtmNorthing() const;    ///< [m]
  double GetTime() const;           ///< simulated time of the reading [s]
  double GetErrHorizontal() const;  ///< standard deviation to the east, and to the north [m]
  double GetErrVertical() const;    ///< standard deviation of the altitude [m]
};

}  // namespace PlayerCc

namespace std {
/// Prints place, UTM coordinates, satellites and quality.
std::ostream& operator<<(std::ostream& os, const PlayerCc::GpsProxy& c);
}  // namespace std
