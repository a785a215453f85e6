// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A head that turns and zooms what sits on it, a blobfinder or a camera (docs/devices/ptz.md).
/// Angles are to the left and upwards.
///
/// SetCam() and SetSpeed() work at any time, in either control mode; what was said last holds.
class PtzProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  PtzProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~PtzProxy() override;

  /// Turns to a pan and a tilt [rad] and zooms to a field of view [rad], as fast as the head can
  /// and as far as its limits let it. A zoom of 0 or less leaves the field of view as it is.
  /// @throws PlayerError kBadArgument for what is no finite number.
  void SetCam(double aPan, double aTilt, double aZoom);
  /// Not of Player: the same at speeds for pan and tilt [rad/s]; 0: as fast as it can.
  void SetCam(double aPan, double aTilt, double aZoom, double aPanSpeed, double aTiltSpeed);
  /// Turns and zooms at these speeds [rad/s] until told otherwise, or at a limit.
  /// @throws PlayerError kBadArgument for what is no finite number.
  void SetSpeed(double aPanSpeed = 0, double aTiltSpeed = 0, double aZoomSpeed = 0);
  /// Changes nothing here.
  /// @param aMode  PLAYER_PTZ_POSITION_CONTROL or PLAYER_PTZ_VELOCITY_CONTROL.
  /// @throws PlayerError kBadArgument for another one.
  void SelectControlMode(uint32_t aMode);
  double GetPan() const;   ///< [rad]
  double GetTilt() const;  ///< [rad]
  double GetZoom() const;  ///< field of view from side to side [rad]
  int GetStatus();         ///< 1: on its way, 0: at rest

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
/// Prints where the head points.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PtzProxy& c);
}  // namespace std
