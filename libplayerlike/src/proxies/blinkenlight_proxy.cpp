// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/blinkenlightproxy.h"
#include "proxies/link.h"
#include "session/player_values/blinkenlight.h"

namespace PlayerCc {

using sim::BlinkenlightReading;

BlinkenLightProxy::BlinkenLightProxy(PlayerClient* aPc, uint32_t aIndex)
    : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_BLINKENLIGHT_CODE, aIndex, "BlinkenLightProxy::BlinkenLightProxy");
}

BlinkenLightProxy::~BlinkenLightProxy() { ClientProxy::Unsubscribe(); }

bool BlinkenLightProxy::GetEnable() const { return Look(&BlinkenlightReading::enabled); }
bool BlinkenLightProxy::IsLit() const { return Look(&BlinkenlightReading::lit); }
double BlinkenLightProxy::GetPeriod() const { return Look(&BlinkenlightReading::period_s); }
double BlinkenLightProxy::GetDutyCycle() const { return Look(&BlinkenlightReading::duty_cycle); }
uint8_t BlinkenLightProxy::GetRed() const { return Look(&BlinkenlightReading::colour).r; }
uint8_t BlinkenLightProxy::GetGreen() const { return Look(&BlinkenlightReading::colour).g; }
uint8_t BlinkenLightProxy::GetBlue() const { return Look(&BlinkenlightReading::colour).b; }

void BlinkenLightProxy::SetEnable(bool aSet) {
  const char* fun = "BlinkenLightProxy::SetEnable";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  sim::LightCommand command;
  command.enabled = aSet;
  mLink->send(fun, command);
}

void BlinkenLightProxy::SetPeriod(double aPeriod) {
  const char* fun = "BlinkenLightProxy::SetPeriod";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  sim::LightCommand command;
  command.period_s = aPeriod;
  if (const auto fault = playerlike::flashing_fault(command)) playerlike::refuse(fun, *fault);
  mLink->send(fun, command);
}

void BlinkenLightProxy::SetDutyCycle(double aDutyCycle) {
  const char* fun = "BlinkenLightProxy::SetDutyCycle";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  sim::LightCommand command;
  command.duty_cycle = aDutyCycle;
  if (const auto fault = playerlike::flashing_fault(command)) playerlike::refuse(fun, *fault);
  mLink->send(fun, command);
}

void BlinkenLightProxy::SetColor(uint8_t aRed, uint8_t aGreen, uint8_t aBlue) {
  const char* fun = "BlinkenLightProxy::SetColor";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  sim::LightCommand command;
  command.colour = sim::Colour{aRed, aGreen, aBlue, 255};
  mLink->send(fun, command);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::BlinkenLightProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#on\tlit\tperiod [s]\tduty cycle\tred\tgreen\tblue\n"
            << c.GetEnable() << '\t' << c.IsLit() << '\t' << c.GetPeriod() << '\t'
            << c.GetDutyCycle() << '\t' << int{c.GetRed()} << '\t' << int{c.GetGreen()} << '\t'
            << int{c.GetBlue()} << '\n';
}

}  // namespace std
