// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/logproxy.h"
#include "proxies/link.h"

namespace PlayerCc {

/// The changes to make.
struct LogProxy::Change : playerlike::LogRequest {};

LogProxy::LogProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_LOG_CODE, aIndex, "LogProxy::LogProxy", false);
}

LogProxy::~LogProxy() { ClientProxy::Unsubscribe(); }

void LogProxy::Control(const char* aFun, const Change& aChange) {
  const scoped_lock_t lock(LockData(aFun));
  playerlike::translated(aFun, [&] {
    playerlike::Session& session = mLink->core->session();
    const playerlike::LogStatus now = session.request<playerlike::LogRequest>(aChange);
    mType = now.replay ? PLAYER_LOG_TYPE_READ : PLAYER_LOG_TYPE_WRITE;
    mState = now.running ? 1 : 0;
    mLink->refresh(sim::to_seconds(session.request(playerlike::TimeRequest{}).sim_time_ns));
    mFresh = true;
  });
}

int LogProxy::GetType() const { return GetVar(mType); }
int LogProxy::GetState() const { return GetVar(mState); }
void LogProxy::QueryState() { Control("LogProxy::QueryState", {}); }

void LogProxy::SetState(int aState) {
  Change change;
  change.running = aState != 0;
  Control("LogProxy::SetState", change);
}

void LogProxy::SetWriteState(int aState) {
  Change change;
  change.replay = false;
  change.running = aState != 0;
  Control("LogProxy::SetWriteState", change);
}

void LogProxy::SetReadState(int aState) {
  Change change;
  change.replay = true;
  change.running = aState != 0;
  Control("LogProxy::SetReadState", change);
}

void LogProxy::Rewind() {
  Change change;
  change.rewind = true;
  Control("LogProxy::Rewind", change);
}

void LogProxy::SetFilename(const std::string aFilename) {
  Change change;
  change.file = aFilename;
  Control("LogProxy::SetFilename", change);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::LogProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#type\tstate\n"
            << (c.GetType() == PLAYER_LOG_TYPE_READ    ? "read"
                : c.GetType() == PLAYER_LOG_TYPE_WRITE ? "write"
                                                       : "unknown")
            << '\t' << c.GetState() << '\n';
}

}  // namespace std
