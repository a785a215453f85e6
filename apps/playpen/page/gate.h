// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "page_settings.h"
#include "playerlike/server/token_throttle.h"

namespace playpen::page {

/// The token in a client's first message, {"token": "..."}, or "" for {}.
/// @return nullopt if the message is something else.
[[nodiscard]] std::optional<std::string> token_of_greeting(std::string_view message);

/// Whether a message is a JSON object.
[[nodiscard]] bool is_json_object(std::string_view message);

/// The message {"refused": reason}.
/// @param reason  valid UTF-8.
[[nodiscard]] std::string refusal(std::string_view reason);

/// What a client may do.
struct Rights {
  bool watch = false;
  bool command = false;
  std::string reason{};                ///< why it may not watch
  std::chrono::milliseconds delay{0};  ///< before it is told
};

/// Decides who may watch and command. Guessing of tokens is slowed down, see TokenThrottle.
class Gate {
 public:
  using Clock = playerlike::server::TokenThrottle::Clock;

  /// @param open  whether watching needs no token.
  /// @param tell  receives warnings about wrong tokens; they contain no token.
  Gate(const PageSettings& settings, bool open, std::function<void(const std::string&)> tell);

  /// @param peer  "ADDRESS:PORT" of the client.
  /// @param token  "": none.
  [[nodiscard]] Rights admit(const std::string& peer, std::string_view token,
                             Clock::time_point now);

 private:
  std::string command_token_;
  std::string watch_token_;
  bool open_;
  std::function<void(const std::string&)> tell_;
  playerlike::server::TokenThrottle throttle_;
};

}  // namespace playpen::page
