// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "gate.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "playerlike/server/token_equal.h"

namespace playpen::page {
namespace {

using nlohmann::json;

json parsed(std::string_view message) { return json::parse(message, nullptr, false); }

}  // namespace

std::optional<std::string> token_of_greeting(std::string_view message) {
  const json greeting = parsed(message);
  if (!greeting.is_object()) return std::nullopt;
  if (greeting.empty()) return "";
  const auto token = greeting.find("token");
  if (greeting.size() != 1 || token == greeting.end() || !token->is_string()) return std::nullopt;
  return token->get<std::string>();
}

bool is_json_object(std::string_view message) { return parsed(message).is_object(); }

std::string refusal(std::string_view reason) { return json{{"refused", reason}}.dump(); }

Gate::Gate(const PageSettings& settings, bool open, std::function<void(const std::string&)> tell)
    : command_token_(settings.command_token),
      watch_token_(settings.watch_token),
      open_(open),
      tell_(std::move(tell)) {}

Rights Gate::admit(const std::string& peer, std::string_view token, Clock::time_point now) {
  using playerlike::server::equal_tokens;
  if (token.empty()) {
    if (open_) return {.watch = true};
    return {.reason = "watching needs a token: open the link that playpen printed, whole"};
  }
  // Both are compared, whatever the first comparison gives.
  const bool commands = !command_token_.empty() && equal_tokens(command_token_, token);
  const bool watches = !watch_token_.empty() && equal_tokens(watch_token_, token);
  if (commands || watches) {
    return {.watch = true, .command = commands, .delay = throttle_.delay_of_right(peer, now)};
  }
  const auto cost = throttle_.note_wrong(peer, now);
  if (cost.tell && tell_) {
    tell_(peer + ": a wrong token for the page, " + std::to_string(cost.count) +
          " from this address in the last minute");
  }
  return {.reason = "the token is wrong", .delay = cost.delay};
}

}  // namespace playpen::page
