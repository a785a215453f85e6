// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libplayerc++/powerproxy.h"
#include "playerc/device.h"

namespace {

class Power final : public playerlike::clib::ProxyBacked<playerc_power_t, PlayerCc::PowerProxy> {
  void refresh() override {
    valid = PLAYER_POWER_MASK_VOLTS | PLAYER_POWER_MASK_WATTS | PLAYER_POWER_MASK_JOULES |
            PLAYER_POWER_MASK_PERCENT | PLAYER_POWER_MASK_CHARGING;
    charge = proxy_or_throw().GetCharge();
    percent = proxy_or_throw().GetPercent();
    joules = proxy_or_throw().GetJoules();
    watts = proxy_or_throw().GetWatts();
    charging = proxy_or_throw().GetCharging() ? 1 : 0;
  }
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(power, Power, PLAYER_POWER_CODE)
