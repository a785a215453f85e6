// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "playerlike/host/host.h"
#include "playerlike/server/server_settings.h"
#include "sim/core/log.h"

namespace playerlike {

/// Offers a simulation over TCP: MORSE's protocol and Playpen's own on one port (docs/protocol.md).
///
/// One thread of its own does all input and output; in lockstep it also steps the simulation. The
/// simulation never waits for a socket.
class Server {
 public:
  /// Listens and starts the thread.
  /// @param host  whose robots must be those that settings.access names.
  /// @param log   told of connections (kInfo) and of what goes wrong; called from the thread.
  /// @throws sim::ConfigError server/port-taken, server/address, server/token-needed,
  ///         access/unknown-robot.
  Server(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log = {});
  /// Throws what the constructor would throw for these settings and robots, and leaves nothing
  /// behind: for those who have something to tidy up before a simulation can be made.
  static void check(const ServerSettings& settings, const std::vector<std::string>& robots);
  /// As stop().
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The TCP port that it listens on.
  [[nodiscard]] int port() const noexcept;
  /// Of the clock synchronisation; 0 without.
  [[nodiscard]] int sync_port() const noexcept;
  [[nodiscard]] std::size_t connections() const noexcept;
  /// Whether a client has asked for the end (MORSE's `quit`), or the run is over and all clients
  /// have gone.
  [[nodiscard]] bool done() const noexcept;

  /// Tells all clients good-bye, sends what is due to them for a moment, closes everything and
  /// ends the thread. The host goes on; call Host::finish() first to have clients told of the end.
  void stop() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace playerlike
