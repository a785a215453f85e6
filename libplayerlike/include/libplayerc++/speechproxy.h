// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A robot's voice: what it says stands over it in pictures for some seconds, and in the log and
/// the report of the run (docs/devices/speech.md).
class SpeechProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port the robot's devices of type "speech", counted from 0; on
  /// port
  ///                4000 the robot.
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  SpeechProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~SpeechProxy() override;

  /// Says something, from the next step on.
  /// @param aStr  of more than 255 bytes the first ones are said, and '?' for what is no UTF-8 or
  /// no
  ///              printable character. Empty: the robot is quiet at once.
  void Say(std::string aStr);
};

}  // namespace PlayerCc

namespace std {
/// Prints what every proxy prints.
std::ostream& operator<<(std::ostream& os, const PlayerCc::SpeechProxy& c);
}  // namespace std
