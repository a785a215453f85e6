// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "playerlike/host/event_client.h"
#include "server/peer.h"
#include "server/watch_hub.h"

namespace playerlike::server {

/// State that the connections in Playpen's own protocol share, see Hub::native_state.
struct NativeState {
  /// An open session, as others need it: its followers, and the other sessions of its process.
  struct OpenSession {
    std::uint64_t number = 0;
    int port = 0;
    std::vector<bool> command;            ///< as in Rights
    std::string process;                  ///< see Hub::thread_id()
    const EventClient* client = nullptr;  ///< valid as long as the session is open
  };

  explicit NativeState(Hub& hub) : watching(hub) {}

  std::string simulation;                   ///< identifies this simulation uniquely
  std::uint64_t sessions = 0;               ///< number of sessions opened so far
  std::map<std::string, OpenSession> open;  ///< open sessions by key
  WatchHub watching;
};

}  // namespace playerlike::server
