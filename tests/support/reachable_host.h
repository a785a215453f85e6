// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
#include "playerlike/server/server.h"

namespace test {

/// How a test's sessions reach a host: by function calls, or over TCP in one of two encodings.
enum class Transport { kInProcess, kCbor, kJson };

inline void PrintTo(Transport transport, std::ostream* os) {
  *os << (transport == Transport::kInProcess ? "in-process"
          : transport == Transport::kCbor    ? "cbor"
                                             : "json");
}
/// For INSTANTIATE_TEST_SUITE_P.
[[nodiscard]] inline std::string transport_name(Transport transport) {
  return transport == Transport::kInProcess ? "InProcess"
         : transport == Transport::kCbor    ? "Cbor"
                                            : "Json";
}

/// A host that sessions reach by one of these transports, so that one test covers all of them.
class ReachableHost {
 public:
  ReachableHost(std::shared_ptr<playerlike::Host> host, Transport transport,
                playerlike::ServerLimits limits = {})
      : host_(std::move(host)), transport_(transport) {
    if (transport_ == Transport::kInProcess) return;
    playerlike::ServerSettings settings;
    settings.port = 0;
    settings.limits = limits;
    server_ = std::make_unique<playerlike::Server>(host_, std::move(settings));
    name_ = "tcp://127.0.0.1:" + std::to_string(server_->port());
  }

  [[nodiscard]] std::unique_ptr<playerlike::Session> connect(int port) const {
    if (!server_) return host_->connect(port);
    setenv("PLAYPEN_ENCODING", transport_ == Transport::kJson ? "json" : "cbor", 1);
    return playerlike::open_session(name_, port);
  }

  /// The host name for clients, over TCP.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] playerlike::Server* server() noexcept { return server_.get(); }
  [[nodiscard]] playerlike::Host& host() const noexcept { return *host_; }
  [[nodiscard]] playerlike::TimeStatistics time() const { return host_->time(); }
  [[nodiscard]] sim::RobotStatistics statistics(int robot) const {
    return host_->statistics(robot);
  }
  [[nodiscard]] std::uint64_t state_hash() const { return host_->state_hash(); }

 private:
  std::shared_ptr<playerlike::Host> host_;
  Transport transport_;
  std::string name_;
  std::unique_ptr<playerlike::Server> server_;  // destroyed before the host, which it uses
};

}  // namespace test
