// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Messages of any bytes between robots, or back to the sender: docs/devices/opaque.md tells who
/// hears whom. The newest message stays until the next one arrives; the proxy is fresh only when
/// one has.
class OpaqueProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port the robot's devices of type "opaque", counted from 0; on
  /// port
  ///                4000 the robot.
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  OpaqueProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~OpaqueProxy() override;

  /// Length of the newest message [bytes]; 0 before the first.
  uint32_t GetCount() const;
  /// Copies the newest message.
  /// @param aDest  room for GetCount() bytes.
  /// @throws PlayerError kBadArgument for a null pointer, unless there is nothing to copy.
  void GetData(uint8_t* aDest) const;
  /// Sends a message of at most 65536 bytes, in the next step. An empty one is not sent.
  /// @throws PlayerError kBadArgument for a longer one, and null pointers.
  void SendCmd(player_opaque_data_t* aData);
  /// The same. What answers it, if anything does, arrives as other messages do.
  /// @return 0
  int SendReq(player_opaque_data_t* aRequest);

 protected:
  void HandleReading() override;
  void HandleRound() override;

 private:
  void Send(const char* aFun, const player_opaque_data_t* aData);

  // Guarded by the client's mutex.
  std::vector<uint8_t> mData;
  bool mWasFresh = false;
  bool mArrived = false;
  bool mInRound = false;
};

}  // namespace PlayerCc

namespace std {
/// Prints the length of the newest message and its bytes, in hexadecimal.
std::ostream& operator<<(std::ostream& os, const PlayerCc::OpaqueProxy& c);
}  // namespace std
