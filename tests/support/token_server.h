// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include "libplayerc++/playerc++.h"
#include "playerlike/connect/open_session.h"
#include "playerlike/host/host.h"
#include "playerlike/server/server.h"

namespace test {

/// A server that asks for tokens: kServerToken for each robot, except for robot r2, which has its
/// own.
class TokenServer {
 public:
  static constexpr const char* kServerToken = "open-sesame-1234";
  static constexpr const char* kTokenOfR2 = "second-robot-1234";
  static constexpr const char* kBothTokens = "open-sesame-1234,second-robot-1234";

  explicit TokenServer(const char* world)
      : server_(playerlike::Host::create(sim::load_world_text(world)), settings()) {}

  /// A client of the robot on port 6665 with these tokens.
  [[nodiscard]] std::unique_ptr<PlayerCc::PlayerClient> client(const char* tokens) const {
    const std::string name = "tcp://127.0.0.1:" + std::to_string(server_.port());
    setenv("PLAYPEN_TOKEN", tokens, 1);
    auto client = std::make_unique<PlayerCc::PlayerClient>(playerlike::open_session(name, 6665));
    unsetenv("PLAYPEN_TOKEN");
    return client;
  }

 private:
  static playerlike::ServerSettings settings() {
    playerlike::ServerSettings settings;
    settings.port = 0;
    settings.access.server_token = kServerToken;
    settings.access.robot_tokens["r2"] = kTokenOfR2;
    return settings;
  }

  playerlike::Server server_;
};

}  // namespace test
