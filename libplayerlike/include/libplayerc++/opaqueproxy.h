// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Binary messages between robots, or back to the sender; docs/devices/opaque.md describes the
/// receivers. The newest message is kept until the next one arrives. The proxy becomes fresh only
/// when a message arrives.
class OpaqueProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port, index among its devices of type "opaque";
  ///                on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  OpaqueProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~OpaqueProxy() override;

  /// Length of the newest message [bytes]; 0 before the first.
  uint32_t GetCount() const;
  /// Copies the newest message.
  /// @param aDest  buffer for GetCount() bytes.
  /// @throws PlayerError kBadArgument for a null pointer, unless GetCount() is 0.
  void GetData(uint8_t* aDest) const;
  /// Sends a message of at most 65536 bytes in the next step. An empty message is not sent.
  /// @throws PlayerError kBadArgument for a longer message or a null pointer.
  void SendCmd(player_opaque_data_t* aData);
  /// Same as SendCmd(). An answer, if there is one, arrives like any other message.
  /// @return 0
  int SendReq(player_opaque_data_t* aRequest);

 protected:
  void HandleReading(const playerlike::NewReading& aNew) override;
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
/// Prints the length of the newest message and its bytes in hexadecimal.
std::ostream& operator<<(std::ostream& os, const PlayerCc::OpaqueProxy& c);
}  // namespace std
