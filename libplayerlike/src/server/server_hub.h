// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/peer.h"

namespace playerlike::server {

/// The core of a server: ports, connections, timers, and the thread that serves them. Handlers
/// implement the protocols.
class ServerHub {
 public:
  /// Opens the ports and starts the thread. @param services  makes the handlers of the services'
  /// port. @throws sim::ConfigError as Server.
  ServerHub(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log,
            MakeHandler services);
  /// Calls stop().
  ~ServerHub();
  ServerHub(const ServerHub&) = delete;
  ServerHub& operator=(const ServerHub&) = delete;

  /// @name As in Server
  /// @{
  static void check(const ServerSettings& settings, const std::vector<std::string>& robots,
                    const std::vector<int>& robot_ports);
  [[nodiscard]] int port() const noexcept;
  [[nodiscard]] int sync_port() const noexcept;
  [[nodiscard]] const std::map<int, int>& player_ports() const noexcept;
  [[nodiscard]] std::size_t connections() const noexcept;
  [[nodiscard]] bool done() const noexcept;
  void adopt(int descriptor);
  void stop() noexcept;
  /// @}

 private:
  class Body;
  std::unique_ptr<Body> body_;
};

}  // namespace playerlike::server
