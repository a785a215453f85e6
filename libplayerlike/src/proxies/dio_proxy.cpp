// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <string>

#include "devices/errors.h"
#include "libplayerc++/dioproxy.h"
#include "proxies/link.h"
#include "sim/devices/dio.h"

namespace PlayerCc {

DioProxy::DioProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  DioProxy::Subscribe(aIndex);
}

DioProxy::~DioProxy() { DioProxy::Unsubscribe(); }

void DioProxy::Subscribe(uint32_t aIndex) { Attach(PLAYER_DIO_CODE, aIndex, "DioProxy::DioProxy"); }

void DioProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

bool DioProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return (aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_DIO_DATA_VALUES) ||
         (aType == PLAYER_MSGTYPE_CMD && aSubtype == PLAYER_DIO_CMD_VALUES);
}

void DioProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::DioReading*>(&aReading.measured);
  if (reading == nullptr) return;
  mCount = static_cast<uint32_t>(reading->input_count);
  mDigin = reading->inputs;
}

uint32_t DioProxy::GetCount() const { return GetVar(mCount); }
uint32_t DioProxy::GetDigin() const { return GetVar(mDigin); }

bool DioProxy::GetInput(uint32_t aIndex) const {
  const char* fun = "DioProxy::GetInput";
  const scoped_lock_t lock(LockData(fun));
  if (aIndex < mCount) return ((mDigin >> aIndex) & 1U) != 0;
  throw PlayerError(fun,
                    "there is no digital input " + std::to_string(aIndex) +
                        ": the newest reading has " + std::to_string(mCount) + ", counted from 0",
                    PlayerError::kBadArgument);
}

void DioProxy::SetOutput(uint32_t aCount, uint32_t aDigout) {
  const char* fun = "DioProxy::SetOutput";
  const scoped_lock_t lock(LockData(fun));
  const double count = std::clamp<double>(mLink->property("outputs", sim::DioParams::kMaxLines),
                                          0.0, sim::DioParams::kMaxLines);
  if (!(aCount <= count)) {
    throw PlayerError(fun,
                      std::to_string(aCount) + " outputs are to be set, but there are " +
                          std::to_string(static_cast<int>(count)),
                      PlayerError::kBadArgument);
  }
  playerlike::translated(fun, [&] {
    mLink->core->session().send(mLink->binding.reading,
                                sim::DigitalOutputCommand{static_cast<int>(aCount), aDigout});
  });
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::DioProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#inputs\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) os << (c.GetInput(i) ? '1' : '0');
  return os << '\n';
}

}  // namespace std
