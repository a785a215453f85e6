// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// What the proxies have in common whose interface no device of Playpen carries. Programs that use
/// them compile, and get the same error from their constructors as Player gives for a device that
/// its configuration lacks: PlayerError kNoSuchDevice, which says what there is instead. So there
/// is never an object whose other members could be called.
class ProxyWithoutDevice : public ClientProxy {
 protected:
  /// Stands for the result of any member, of whatever type.
  struct NoResult {
    /// Throws PlayerError kNotAvailable.
    template <typename T>
    operator T() const {
      Refuse();
    }
  };

  /// @throws PlayerError kNoSuchDevice, in the name of aFun.
  ProxyWithoutDevice(PlayerClient* aPc, uint32_t aIndex, uint32_t aInterface, const char* aFun);

  /// @throws PlayerError kNotAvailable.
  static NoResult NoDevice() { Refuse(); }

 private:
  [[noreturn]] static void Refuse();
};

}  // namespace PlayerCc
