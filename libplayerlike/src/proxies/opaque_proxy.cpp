// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/opaqueproxy.h"
#include "proxies/link.h"
#include "sim/devices/opaque.h"

namespace PlayerCc {

OpaqueProxy::OpaqueProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_OPAQUE_CODE, aIndex, "OpaqueProxy::OpaqueProxy");
}

OpaqueProxy::~OpaqueProxy() { ClientProxy::Unsubscribe(); }

void OpaqueProxy::HandleReading(const playerlike::NewReading& aNew) {
  const auto* reading = playerlike::reading_as<sim::OpaqueReading>(*aNew.reading);
  if (reading == nullptr) return;
  if (!mInRound) {
    mInRound = true;
    mArrived = false;
    mWasFresh = mFresh;
  }
  if (reading->data.empty()) return;
  mData = reading->data;
  mArrived = true;
}

// A reading without a message does not make the proxy fresh.
void OpaqueProxy::HandleRound() {
  mInRound = false;
  if (!mArrived) mFresh = mWasFresh;
}

uint32_t OpaqueProxy::GetCount() const {
  const scoped_lock_t lock(LockData("OpaqueProxy::GetCount"));
  return static_cast<uint32_t>(mData.size());
}

void OpaqueProxy::GetData(uint8_t* aDest) const {
  const char* fun = "OpaqueProxy::GetData";
  const scoped_lock_t lock(LockData(fun));
  if (mData.empty()) return;
  if (aDest == nullptr) {
    playerlike::refuse(
        fun, "needs room for " + std::to_string(mData.size()) + " bytes, but got a null pointer");
  }
  std::copy(mData.begin(), mData.end(), aDest);
}

void OpaqueProxy::Send(const char* aFun, const player_opaque_data_t* aData) {
  const scoped_lock_t lock(mLink->lock_for_command(aFun));
  const bool null = aData == nullptr || (aData->data == nullptr && aData->data_count > 0);
  if (null || aData->data_count > sim::kMaxOpaque) {
    playerlike::refuse(aFun, null
                                 ? std::string("got a null pointer")
                                 : "a message has at most " + std::to_string(sim::kMaxOpaque) +
                                       " bytes, but this has " + std::to_string(aData->data_count));
  }
  if (aData->data_count == 0) return;
  mLink->send(aFun, sim::OpaqueCommand{{aData->data, aData->data + aData->data_count}});
}

void OpaqueProxy::SendCmd(player_opaque_data_t* aData) { Send("OpaqueProxy::SendCmd", aData); }

int OpaqueProxy::SendReq(player_opaque_data_t* aRequest) {
  Send("OpaqueProxy::SendReq", aRequest);
  return 0;
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::OpaqueProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#bytes\n" << c.GetCount();
  std::vector<uint8_t> data(c.GetCount());
  c.GetData(data.data());
  for (const uint8_t byte : data) {
    std::array<char, 4> text{};
    std::snprintf(text.data(), text.size(), " %02x", byte);
    os << text.data();
  }
  return os << '\n';
}

}  // namespace std
