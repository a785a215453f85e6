// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/powerproxy.h"
#include "proxies/link.h"
#include "sim/devices/battery.h"

namespace PlayerCc {

using sim::BatteryReading;

PowerProxy::PowerProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_POWER_CODE, aIndex, "PowerProxy::PowerProxy");
}

PowerProxy::~PowerProxy() { ClientProxy::Unsubscribe(); }

double PowerProxy::GetCharge() const { return Look(&BatteryReading::voltage_v); }
double PowerProxy::GetPercent() const { return Look(&BatteryReading::charge_percent); }
double PowerProxy::GetJoules() const { return Look(&BatteryReading::energy_wh) * 3600.0; }
double PowerProxy::GetWatts() const { return Look(&BatteryReading::power_w); }
bool PowerProxy::GetCharging() const {
  return Look(&BatteryReading::status) == sim::BatteryStatus::kCharging;
}
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
