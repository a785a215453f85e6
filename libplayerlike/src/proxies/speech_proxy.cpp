// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>

#include "devices/errors.h"
#include "libplayerc++/speechproxy.h"
#include "proxies/link.h"
#include "sim/core/utf8.h"

namespace PlayerCc {
namespace {

// Removes the characters of a text that cannot be said (control characters, invalid UTF-8).
std::string sayable(std::string_view text) {
  std::string said;
  while (!text.empty()) {
    const std::size_t length = sim::utf8_length(text);
    const auto first = static_cast<unsigned char>(text.front());
    const bool printable = length > 1 || (length == 1 && first >= 0x20 && first != 0x7f);
    const bool space = first == '\n' || first == '\t' || first == '\r';
    const std::string_view next = printable ? text.substr(0, length) : space ? " " : "?";
    if (said.size() + next.size() > sim::kMaxSpeech) break;
    said += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return said;
}

}  // namespace

SpeechProxy::SpeechProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_SPEECH_CODE, aIndex, "SpeechProxy::SpeechProxy", false);
}

SpeechProxy::~SpeechProxy() { ClientProxy::Unsubscribe(); }

void SpeechProxy::Say(std::string aStr) {
  const char* fun = "SpeechProxy::Say";
  const scoped_lock_t lock(LockData(fun));
  mLink->send(fun, sim::SayCommand{sayable(aStr)});
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::SpeechProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << '\n';
}

}  // namespace std
