// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A robot's speech output. Pictures show the text above the robot for some seconds; the run's log
/// and report contain it too (docs/devices/speech.md).
class SpeechProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port, index among its devices of type "speech";
  ///                on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  SpeechProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~SpeechProxy() override;

  /// Says a text, from the next step on.
  /// @param aStr  the text; only the first 255 bytes are used. Bytes that are not UTF-8 and
  ///              characters that are not printable are replaced by '?'. An empty text ends the
  ///              speech.
  void Say(std::string aStr);
};

}  // namespace PlayerCc

namespace std {
/// Prints interface, index and flags, like every proxy.
std::ostream& operator<<(std::ostream& os, const PlayerCc::SpeechProxy& c);
}  // namespace std
