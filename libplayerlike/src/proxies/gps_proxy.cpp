// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/gpsproxy.h"
#include "libplayerc++/utility.h"
#include "proxies/link.h"
#include "sim/devices/gps.h"

namespace PlayerCc {

using sim::GpsReading;

GpsProxy::GpsProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_GPS_CODE, aIndex, "GpsProxy::GpsProxy");
}

GpsProxy::~GpsProxy() { ClientProxy::Unsubscribe(); }

double GpsProxy::GetLatitude() const { return rtod(Look(&GpsReading::latitude_rad)); }
double GpsProxy::GetLongitude() const { return rtod(Look(&GpsReading::longitude_rad)); }
double GpsProxy::GetAltitude() const { return Look(&GpsReading::altitude_m); }
double GpsProxy::GetSpeed() const { return Look(&GpsReading::speed_mps); }
double GpsProxy::GetCourse() const { return Look(&GpsReading::course_rad); }
uint32_t GpsProxy::GetSatellites() const {
  return static_cast<uint32_t>(Look(&GpsReading::satellites));
}
uint32_t GpsProxy::GetQuality() const { return static_cast<uint32_t>(Look(&GpsReading::quality)); }
double GpsProxy::GetHdop() const {
  return Look<GpsReading>([](const GpsReading& fix) {
    return fix.accuracy ? fix.accuracy->horizontal_dilution : fix.quality > 0 ? 1.0 : 0.0;
  });
}
double GpsProxy::GetVdop() const {
  return Look<GpsReading>([](const GpsReading& fix) {
    return fix.accuracy ? fix.accuracy->vertical_dilution : fix.quality > 0 ? 1.0 : 0.0;
  });
}
double GpsProxy::GetUtmEasting() const { return Look(&GpsReading::utm_easting_m); }
double GpsProxy::GetUtmNorthing() const { return Look(&GpsReading::utm_northing_m); }
double GpsProxy::GetTime() const {
  return sim::to_seconds(Look<GpsReading>([](const auto& r) { return r.time_ns; }));
}
double GpsProxy::GetErrHorizontal() const {
  return Look<GpsReading>([this](const GpsReading& fix) {
    if (fix.accuracy) return fix.accuracy->horizontal_m;
    return fix.quality > 0 ? mLink->property("noise", 0.0) : 0.0;
  });
}
double GpsProxy::GetErrVertical() const {
  return Look<GpsReading>([this](const GpsReading& fix) {
    if (fix.accuracy) return fix.accuracy->vertical_m;
    return fix.quality > 0 ? mLink->property("noise_vertical", 0.0) : 0.0;
  });
}

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
