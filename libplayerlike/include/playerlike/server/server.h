// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "playerlike/host/host.h"
#include "playerlike/server/server_settings.h"
#include "sim/core/log.h"
#include "sim/world/description.h"

namespace playerlike {

/// An address and a port as one text, such as "127.0.0.1:4000" or "[::1]:4000".
[[nodiscard]] std::string address_text(const std::string& address, int port);

/// Serves a simulation over TCP and over a Unix socket, with MORSE's protocol and Playpen's
/// protocol on one port (docs/protocol.md), and with Player's protocol on a port for each robot
/// (docs/player_wire.md).
///
/// The server has one thread for all input and output; in lockstep this thread also steps the
/// simulation. The simulation never waits for a socket.
class Server {
 public:
  /// Opens the listening sockets and starts the thread.
  /// @param host  the simulation; it must have all robots that settings.access names.
  /// @param log   receives messages about connections (kInfo) and errors; called from the server's
  ///              thread.
  /// @throws sim::ConfigError server/port-taken, server/port-range, server/address,
  ///         server/token-needed, server/unix-socket, access/unknown-robot.
  Server(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log = {});
  /// Throws the errors that the constructor would throw for these settings and robots, without side
  /// effects. It allows a check before a simulation is created.
  /// @param robots       names of the robots.
  /// @param robot_ports  their ports in the world, for ServerSettings::player_port.
  static void check(const ServerSettings& settings, const std::vector<std::string>& robots,
                    const std::vector<int>& robot_ports = {});
  /// The same for the robots of a world.
  static void check(const ServerSettings& settings, const sim::WorldDescription& world);
  /// Calls stop().
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The TCP port for services; 0 if there is none.
  [[nodiscard]] int port() const noexcept;
  /// Port of the clock synchronisation; 0 if it is off.
  [[nodiscard]] int sync_port() const noexcept;
  /// TCP ports of Player's protocol by the robots' ports in the world; empty if it is off.
  [[nodiscard]] const std::map<int, int>& player_ports() const noexcept;
  /// A line for the user about each of them, such as "Player's protocol on 127.0.0.1:6665: r1".
  [[nodiscard]] std::vector<std::string> player_port_lines() const;
  [[nodiscard]] std::size_t connections() const noexcept;
  /// Whether a client has requested the end (MORSE's `quit`), or the run is over and all clients
  /// have disconnected.
  [[nodiscard]] bool done() const noexcept;

  /// Serves a connected Unix socket, such as one end of a socketpair(), like a connection to the
  /// port for services. The server closes it.
  void adopt(int descriptor);

  /// Sends a closing message to all clients, spends a short time on sending queued data, closes all
  /// connections and ends the thread. The host continues. To notify clients of the end of the run,
  /// call Host::finish() first.
  void stop() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace playerlike
