// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/speechproxy.h"
#include "proxies/link.h"
#include "session/player_values/speech.h"

namespace PlayerCc {

SpeechProxy::SpeechProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_SPEECH_CODE, aIndex, "SpeechProxy::SpeechProxy", false);
}

SpeechProxy::~SpeechProxy() { ClientProxy::Unsubscribe(); }

void SpeechProxy::Say(std::string aStr) {
  const char* fun = "SpeechProxy::Say";
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  mLink->send(fun, sim::SayCommand{playerlike::sayable(aStr)});
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::SpeechProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << '\n';
}

}  // namespace std
