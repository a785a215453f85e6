// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/aioproxy.h"
#include "proxies/link.h"
#include "session/player_values/aio.h"

namespace PlayerCc {

AioProxy::AioProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_AIO_CODE, aIndex, "AioProxy::AioProxy");
}

AioProxy::~AioProxy() { ClientProxy::Unsubscribe(); }

uint32_t AioProxy::GetCount() const {
  return static_cast<uint32_t>(Look(&sim::AioReading::inputs_v, "AioProxy::GetCount").size());
}

double AioProxy::GetVoltage(uint32_t aIndex) const {
  const char* fun = "AioProxy::GetVoltage";
  const scoped_lock_t lock(LockData(fun));
  return mLink->element_or_zero(fun, {"analog input", "inputs"}, aIndex,
                                mLink->newest.as<sim::AioReading>().inputs_v);
}

void AioProxy::SetVoltage(uint32_t aIndex, double aVoltage) {
  const char* fun = "AioProxy::SetVoltage";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  const auto count = static_cast<uint32_t>(std::clamp<double>(
      mLink->property("outputs", sim::AioParams::kMaxLines), 0.0, sim::AioParams::kMaxLines));
  if (!playerlike::is_line_voltage(aVoltage)) {
    playerlike::refuse(fun, playerlike::output_fault(aIndex, aVoltage, count));
  }
  if (aIndex >= count) {
    return mLink->warn_once(fun, "there is no analog output " + std::to_string(aIndex) +
                                     ": there are " + std::to_string(count) +
                                     ", counted from 0; setting it has no effect");
  }
  mLink->send(fun, sim::AnalogOutputCommand{static_cast<int>(aIndex), aVoltage});
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::AioProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#voltages [V]\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) os << (i == 0 ? "" : "\t") << c.GetVoltage(i);
  return os << '\n';
}

}  // namespace std
