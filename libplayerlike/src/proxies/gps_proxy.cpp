// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/gpsproxy.h"
#include "libplayerc++/utility.h"
#include "proxies/link.h"
#include "sim/devices/gps.h"

namespace PlayerCc {

GpsProxy::GpsProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  GpsProxy::Subscribe(aIndex);
}

GpsProxy::~GpsProxy() { GpsProxy::Unsubscribe(); }

void GpsProxy::Subscribe(uint32_t aIndex) { Attach(PLAYER_GPS_CODE, aIndex, "GpsProxy::GpsProxy"); }

void GpsProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void GpsProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::GpsReading*>(&aReading.measured);
  if (reading == nullptr) return;
  mLatitude = rtod(reading->latitude_rad);
  mLongitude = rtod(reading->longitude_rad);
  mAltitude = reading->altitude_m;
  mSpeed = reading->speed_mps;
  mCourse = reading->course_rad;
  mEasting = reading->utm_easting_m;
  mNorthing = reading->utm_northing_m;
  mTime = sim::to_seconds(reading->time_ns);
  mSatellites = static_cast<uint32_t>(reading->satellites);
  mQuality = static_cast<uint32_t>(reading->quality);
  mErrHorizontal = mQuality > 0 ? mLink->property("noise", 0.0) : 0.0;
  mErrVertical = mQuality > 0 ? mLink->property("noise_vertical", 0.0) : 0.0;
}

bool GpsProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_GPS_DATA_STATE;
}

double GpsProxy::GetLatitude() const { return GetVar(mLatitude); }
double GpsProxy::GetLongitude() const { return GetVar(mLongitude); }
double GpsProxy::GetAltitude() const { return GetVar(mAltitude); }
double GpsProxy::GetSpeed() const { return GetVar(mSpeed); }
double GpsProxy::GetCourse() const { return GetVar(mCourse); }
uint32_t GpsProxy::GetSatellites() const { return GetVar(mSatellites); }
uint32_t GpsProxy::GetQuality() const { return GetVar(mQuality); }
double GpsProxy::GetHdop() const { return GetVar(mQuality) > 0 ? 1.0 : 0.0; }
double GpsProxy::GetVdop() const { return GetVar(mQuality) > 0 ? 1.0 : 0.0; }
double GpsProxy::GetUtmEasting() const { return GetVar(mEasting); }
double GpsProxy::GetUtmNorthing() const { return GetVar(mNorthing); }
double GpsProxy::GetTime() const { return GetVar(mTime); }
double GpsProxy::GetErrHorizontal() const { return GetVar(mErrHorizontal); }
double GpsProxy::GetErrVertical() const { return GetVar(mErrVertical); }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::GpsProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#latitude [deg]\tlongitude [deg]\taltitude [m]\teasting [m]\tnorthing [m]\t"
               "satellites\tquality\n"
            << c.GetLatitude() << '\t' << c.GetLongitude() << '\t' << c.GetAltitude() << '\t'
            << c.GetUtmEasting() << '\t' << c.GetUtmNorthing() << '\t' << c.GetSatellites() << '\t'
            << c.GetQuality() << '\n';
}

}  // namespace std
