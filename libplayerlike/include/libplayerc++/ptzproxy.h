// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A pan-tilt-zoom head that carries a blobfinder or a camera (docs/devices/ptz.md). Pan is
/// positive to the left, tilt is positive upwards.
///
/// SetCam() and SetSpeed() work in both control modes; the last call wins.
class PtzProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  PtzProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~PtzProxy() override;

  /// Turns to a pan and tilt angle [rad] and zooms to a field of view [rad], at maximum speed and
  /// within the head's limits. A zoom of 0 or less keeps the field of view.
  /// @throws PlayerError kBadArgument for values that are not finite.
  void SetCam(double aPan, double aTilt, double aZoom);
  /// Extension to Player: SetCam() with given speeds of pan and tilt [rad/s]; 0 for the maximum
  /// speed.
  void SetCam(double aPan, double aTilt, double aZoom, double aPanSpeed, double aTiltSpeed);
  /// Turns and zooms at these speeds [rad/s], until the next command or a limit.
  /// @throws PlayerError kBadArgument for values that are not finite.
  void SetSpeed(double aPanSpeed = 0, double aTiltSpeed = 0, double aZoomSpeed = 0);
  /// Has no effect here.
  /// @param aMode  PLAYER_PTZ_POSITION_CONTROL or PLAYER_PTZ_VELOCITY_CONTROL.
  /// @throws PlayerError kBadArgument for any other mode.
  void SelectControlMode(uint32_t aMode);
  double GetPan() const;   ///< [rad]
  double GetTilt() const;  ///< [rad]
  double GetZoom() const;  ///< horizontal field of view [rad]
  int GetStatus();         ///< 1 while moving, 0 at rest

 private:
  struct State {
    double pan = 0.0;
    double tilt = 0.0;
    double zoom = 0.0;
    bool moving = false;
  };
};

}  // namespace PlayerCc

namespace std {
/// Prints the direction of the head.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PtzProxy& c);
}  // namespace std
