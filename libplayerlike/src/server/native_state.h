// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "server/peer.h"
#include "server/watch_hub.h"

namespace playerlike::server {

/// What the connections in Playpen's own protocol share, see Hub::native_state.
struct NativeState {
  /// Of a session, what matters to those who follow it.
  struct Leader {
    int port = 0;
    std::vector<bool> command;  ///< as Rights
  };

  explicit NativeState(Hub& hub) : watching(hub) {}

  std::string simulation;                 ///< a name that no other simulation has
  std::uint64_t sessions = 0;             ///< opened so far
  std::map<std::string, Leader> leaders;  ///< sessions that are open, by their keys
  WatchHub watching;
};

}  // namespace playerlike::server
