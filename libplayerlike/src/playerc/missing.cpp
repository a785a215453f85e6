// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that no world provides: programs can create their structs, but all their functions fail.
#include <string>
#include <type_traits>

#include "playerc/device.h"

namespace {

// Never constructed: an unsupported device cannot be subscribed to.
class NoProxy final : public PlayerCc::ClientProxy {
 public:
  NoProxy(PlayerCc::PlayerClient* client, uint32_t index) : ClientProxy(client, index) {}
};

template <typename CStruct>
class Missing final : public playerlike::clib::ProxyBacked<CStruct, NoProxy> {
  void attach(PlayerCc::PlayerClient& player) override {
    const player_devaddr_t& addr = this->info.addr;
    // The error names the kind of device at this address.
    playerlike::clib::refuse("the C library cannot use a device of the kind \"" +
                             playerlike::clib::driver_at(player, addr.interf, addr.index) + '"');
  }
};

// Result of an unsupported function: -1, or a value-initialized struct or pointer.
template <typename Result>
Result refused(const char* fun) {
  playerlike::clib::set_error(fun, "no world has such a device");
  if constexpr (std::is_same_v<Result, int>) return -1;
  return Result();
}

}  // namespace

#include "playerc/missing_functions.inc"  // generated from libplayerlike/player/playerc.txt
