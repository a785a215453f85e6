// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libplayerc++/proxywithoutdevice.h"

namespace PlayerCc {

ProxyWithoutDevice::ProxyWithoutDevice(PlayerClient* aPc, uint32_t aIndex, uint32_t aInterface,
                                       const char* aFun)
    : ClientProxy(aPc, aIndex) {
  Attach(aInterface, aIndex, aFun);
}

void ProxyWithoutDevice::Refuse() {
  throw PlayerError("ProxyWithoutDevice", "this library cannot do anything with such a device",
                    PlayerError::kNotAvailable);
}

}  // namespace PlayerCc
