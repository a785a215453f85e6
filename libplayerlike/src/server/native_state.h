// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "server/peer.h"
#include "server/watch_hub.h"

namespace playerlike::server {

/// State that the connections in Playpen's own protocol share, see Hub::native_state.
struct NativeState {
  /// The data of a session that its followers need.
  struct Leader {
    int port = 0;
    std::vector<bool> command;  ///< as in Rights
  };

  explicit NativeState(Hub& hub) : watching(hub) {}

  std::string simulation;                 ///< identifies this simulation uniquely
  std::uint64_t sessions = 0;             ///< number of sessions opened so far
  std::map<std::string, Leader> leaders;  ///< open sessions by key
  WatchHub watching;
};

}  // namespace playerlike::server
