// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A satellite navigation receiver. All values come from the newest reading. They are 0 before the
/// first reading and without a fix (GetQuality() is 0).
class GpsProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  GpsProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~GpsProxy() override;

  double GetLatitude() const;      ///< north positive [degrees]
  double GetLongitude() const;     ///< east positive [degrees]
  double GetAltitude() const;      ///< above the ellipsoid [m]
  double GetSpeed() const;         ///< speed over ground [m/s]
  double GetCourse() const;        ///< course over ground, clockwise from north, in [0, 2 pi) [rad]
  uint32_t GetSatellites() const;  ///< number of satellites in view
  uint32_t GetQuality() const;     ///< 1 with a fix, otherwise 0
  /// Horizontal dilution of precision. It is 1 with a fix, because the world file sets the
  /// receiver's noise directly. With a Player server, dilutions and errors are those of the
  /// receiver.
  double GetHdop() const;
  double GetVdop() const;           ///< vertical dilution of precision; see GetHdop()
  double GetUtmEasting() const;     ///< in the zone of the world's origin [m]
  double GetUtmNorthing() const;    ///< [m]
  double GetTime() const;           ///< simulated time of the reading [s]
  double GetErrHorizontal() const;  ///< standard deviation to the east and to the north [m]
  double GetErrVertical() const;    ///< standard deviation of the altitude [m]
};

}  // namespace PlayerCc

namespace std {
/// Prints position, UTM coordinates, satellites and quality.
std::ostream& operator<<(std::ostream& os, const PlayerCc::GpsProxy& c);
}  // namespace std
