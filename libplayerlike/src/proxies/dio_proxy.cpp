// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>

#include "libplayerc++/dioproxy.h"
#include "proxies/link.h"
#include "sim/devices/dio.h"

namespace PlayerCc {

using sim::DioReading;

DioProxy::DioProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_DIO_CODE, aIndex, "DioProxy::DioProxy");
}

DioProxy::~DioProxy() { ClientProxy::Unsubscribe(); }

uint32_t DioProxy::GetCount() const {
  return static_cast<uint32_t>(Look(&DioReading::input_count));
}
uint32_t DioProxy::GetDigin() const { return Look(&DioReading::inputs); }

bool DioProxy::GetInput(uint32_t aIndex) const {
  const char* fun = "DioProxy::GetInput";
  const scoped_lock_t lock(LockData(fun));
  const auto& newest = mLink->newest.as<DioReading>();
  const auto count = static_cast<std::size_t>(newest.input_count);
  if (!mLink->has_element(fun, {"digital input", "inputs"}, aIndex, count)) return false;
  return ((newest.inputs >> aIndex) & 1U) != 0;
}

void DioProxy::SetOutput(uint32_t aCount, uint32_t aDigout) {
  const char* fun = "DioProxy::SetOutput";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  const auto outputs = static_cast<uint32_t>(std::clamp<double>(
      mLink->property("outputs", sim::DioParams::kMaxLines), 0.0, sim::DioParams::kMaxLines));
  if (aCount > outputs) {
    mLink->warn_once(fun, std::to_string(aCount) + " outputs are to be set, but there are " +
                              std::to_string(outputs) + "; the others have no effect");
  }
  mLink->send(fun, sim::DigitalOutputCommand{static_cast<int>(std::min(aCount, outputs)), aDigout});
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::DioProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#inputs\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) os << (c.GetInput(i) ? '1' : '0');
  return os << '\n';
}

}  // namespace std
