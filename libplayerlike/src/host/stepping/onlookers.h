// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "playerlike/host/host.h"
#include "sim/core/log.h"

namespace playerlike {

/// Ports of Player's protocol at a simulation that a program in this process drives. Other
/// programs, such as viewers, connect to them and look on (docs/player_wire.md). Lockstep time
/// neither waits for them nor advances for them. The destructor closes ports and connections.
class Onlookers {
 public:
  Onlookers() = default;
  Onlookers(const Onlookers&) = delete;
  Onlookers& operator=(const Onlookers&) = delete;
  virtual ~Onlookers() = default;
};

/// Opens the ports on this machine's loopback address and logs them (kInfo).
///
/// The server implements this function. It stands above the layers that embed simulations in
/// programs, so these know only the declaration.
/// @param player_port  see RunSettings::player_port.
/// @param log  also receives warnings; called from any thread.
/// @throws sim::ConfigError server/port-taken, server/port-not-allowed, server/port-range.
[[nodiscard]] std::unique_ptr<Onlookers> open_onlookers(std::shared_ptr<Host> host, int player_port,
                                                        sim::LogHook log);

}  // namespace playerlike
