// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/powerproxy.h"
#include "proxies/link.h"
#include "sim/devices/battery.h"

namespace PlayerCc {

PowerProxy::PowerProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  PowerProxy::Subscribe(aIndex);
}

PowerProxy::~PowerProxy() { PowerProxy::Unsubscribe(); }

void PowerProxy::Subscribe(uint32_t aIndex) {
  Attach(PLAYER_POWER_CODE, aIndex, "PowerProxy::PowerProxy");
}

void PowerProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void PowerProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::BatteryReading*>(&aReading.measured);
  if (reading == nullptr) return;
  constexpr double kJoulesPerWh = 3600.0;
  mVoltage = reading->voltage_v;
  mPercent = reading->charge_percent;
  mJoules = reading->energy_wh * kJoulesPerWh;
  mWatts = reading->power_w;
  mCharging = reading->status == sim::BatteryStatus::kCharging;
}

bool PowerProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_POWER_DATA_STATE;
}

double PowerProxy::GetCharge() const { return GetVar(mVoltage); }
double PowerProxy::GetPercent() const { return GetVar(mPercent); }
double PowerProxy::GetJoules() const { return GetVar(mJoules); }
double PowerProxy::GetWatts() const { return GetVar(mWatts); }
bool PowerProxy::GetCharging() const { return GetVar(mCharging); }
bool PowerProxy::IsValid() const { return ClientProxy::IsValid(); }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::PowerProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#voltage [V]\tcharge [%]\tenergy [J]\tpower [W]\tcharging\n"
            << c.GetCharge() << '\t' << c.GetPercent() << '\t' << c.GetJoules() << '\t'
            << c.GetWatts() << '\t' << c.GetCharging() << '\n';
}

}  // namespace std
