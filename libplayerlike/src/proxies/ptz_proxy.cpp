// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/ptzproxy.h"
#include "proxies/link.h"
#include "sim/devices/ptz.h"

namespace PlayerCc {

using sim::PtzReading;

PtzProxy::PtzProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "PtzProxy::PtzProxy";
  Attach(PLAYER_PTZ_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  const auto announced = std::make_shared<PtzReading>();
  announced->view_rad = mLink->property("field_of_view_max", 0.0);
  mLink->show(announced);
}

PtzProxy::~PtzProxy() { ClientProxy::Unsubscribe(); }

void PtzProxy::SetCam(double aPan, double aTilt, double aZoom) {
  SetCam(aPan, aTilt, aZoom, 0.0, 0.0);
}

void PtzProxy::SetCam(double aPan, double aTilt, double aZoom, double aPanSpeed,
                      double aTiltSpeed) {
  const char* fun = "PtzProxy::SetCam";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  mLink->send(fun, sim::PointCommand{aPan, aTilt, aZoom, aPanSpeed, aTiltSpeed});
}

void PtzProxy::SetSpeed(double aPanSpeed, double aTiltSpeed, double aZoomSpeed) {
  const char* fun = "PtzProxy::SetSpeed";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  mLink->send(fun, sim::PanCommand{aPanSpeed, aTiltSpeed, aZoomSpeed});
}

void PtzProxy::SelectControlMode(uint32_t aMode) {
  const char* fun = "PtzProxy::SelectControlMode";
  const scoped_lock_t lock(LockData(fun));
  if (aMode == PLAYER_PTZ_POSITION_CONTROL || aMode == PLAYER_PTZ_VELOCITY_CONTROL) return;
  playerlike::refuse(fun,
                     "a control mode is PLAYER_PTZ_POSITION_CONTROL or PLAYER_PTZ_VELOCITY_CONTROL,"
                     " but is " +
                         std::to_string(aMode));
}

double PtzProxy::GetPan() const { return Look(&PtzReading::pan_rad); }
double PtzProxy::GetTilt() const { return Look(&PtzReading::tilt_rad); }
double PtzProxy::GetZoom() const { return Look(&PtzReading::view_rad); }
int PtzProxy::GetStatus() { return Look(&PtzReading::moving) ? 1 : 0; }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::PtzProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#pan [rad]\ttilt [rad]\tzoom [rad]\n"
            << c.GetPan() << '\t' << c.GetTilt() << '\t' << c.GetZoom() << '\n';
}

}  // namespace std
