// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Common base of the proxies whose interface no device of Playpen provides. Programs that use such
/// a proxy compile. The constructor always throws PlayerError kNoSuchDevice, like Player's does for
/// a device that is not in its configuration; the text names the existing devices. The other
/// members can therefore never be called.
class ProxyWithoutDevice : public ClientProxy {
 protected:
  /// Placeholder that converts to the return type of any member.
  struct NoResult {
    /// Throws PlayerError kNotAvailable.
    template <typename T>
    operator T() const {
      Refuse();
    }
  };

  /// @throws PlayerError kNoSuchDevice, with function name aFun.
  ProxyWithoutDevice(PlayerClient* aPc, uint32_t aIndex, uint32_t aInterface, const char* aFun);

  /// @throws PlayerError kNotAvailable.
  static NoResult NoDevice() { Refuse(); }

 private:
  [[noreturn]] static void Refuse();
};

}  // namespace PlayerCc
