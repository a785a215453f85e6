// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "protocol/codec.h"
#include "server/native_handler.h"
#include "session/checks.h"

namespace playerlike::server {
namespace {

using protocol::Encoding;
using protocol::json;
using protocol::ProtocolError;

constexpr std::size_t kMaxName = 64;

/// A text that is safe to log.
std::string name_or_empty(const json& argument, const char* key) {
  if (!argument.contains(key)) return "";
  std::string text = protocol::require_text(argument, key);
  if (text.size() > kMaxName || !is_printable(text)) {
    protocol::refuse_value(key, "at most 64 bytes, all printable", argument[key]);
  }
  return text;
}

std::vector<std::string> tokens_of(const json& argument) {
  std::vector<std::string> tokens;
  if (!argument.contains("tokens")) return tokens;
  const json& list = argument["tokens"];
  const bool good =
      list.is_array() && list.size() <= kMaxTokens &&
      std::all_of(list.begin(), list.end(), [](const json& t) { return t.is_string(); });
  // The error does not show the value, which may be a token.
  if (!good) {
    throw ProtocolError("protocol/bad-value", "tokens: expected a list of up to 64 texts");
  }
  for (const json& token : list) tokens.push_back(token.get<std::string>());
  return tokens;
}

Encoding encoding_of(const json& argument) {
  if (!argument.contains("encoding")) return Encoding::kJson;
  const auto encoding = protocol::parse_encoding(protocol::require_text(argument, "encoding"));
  if (!encoding) protocol::refuse_value("encoding", "json or cbor", argument["encoding"]);
  return *encoding;
}

void require_version(const json& argument) {
  constexpr int kAny = 1 << 30;
  const auto version = protocol::require_integer(argument, "version", -kAny, kAny);
  if (version != protocol::kVersion) {
    throw ProtocolError("protocol/version", "this server speaks version " +
                                                std::to_string(protocol::kVersion) + ", not " +
                                                std::to_string(version));
  }
}

/// Sets the terms of a session that follows another one.
void follow(NativeHandler::Terms& terms, const NativeState& state, const json& argument) {
  const auto leader = state.open.find(protocol::require_text(argument, "follow"));
  if (leader == state.open.end()) {
    throw ProtocolError("access/denied", "follow: no open session has this key");
  }
  if (leader->second.command != terms.rights.command) {
    throw ProtocolError("access/denied",
                        "a follower presents the same tokens as the session that it follows");
  }
  if (argument.contains("port") && terms.port != leader->second.port) {
    protocol::refuse_value("port",
                           "that of the session to follow, " + std::to_string(leader->second.port),
                           argument["port"]);
  }
  terms.port = leader->second.port;
  terms.follower = true;
}

NativeHandler::Terms terms_of(Hub& hub, const json& argument) {
  protocol::refuse_unknown_keys(
      argument,
      {"version", "encoding", "port", "tokens", "name", "process", "thread", "follow", "watch"},
      "hello");
  require_version(argument);
  NativeHandler::Terms terms;
  terms.encoding = encoding_of(argument);
  if (argument.contains("port")) {
    terms.port = static_cast<int>(protocol::require_integer(argument, "port", 1, 65535));
  }
  const std::vector<std::string> tokens = tokens_of(argument);
  terms.rights = hub.access().rights(tokens, terms.port);
  terms.session = !argument.contains("watch") || !protocol::require_bool(argument, "watch");
  if (terms.session ? !terms.rights.connect : !terms.rights.watch) {
    throw ProtocolError("access/denied", "this server requires a valid token");
  }
  if (argument.contains("follow")) {
    if (!terms.session)
      protocol::refuse_value("follow", "no such key beside watch", argument["follow"]);
    follow(terms, *hub.native_state, argument);
    terms.rights = hub.access().rights(tokens, terms.port);
  }
  terms.key = make_token();
  terms.process = name_or_empty(argument, "process");
  if (argument.contains("thread") && !terms.process.empty()) {
    constexpr std::int64_t kMostThreads = std::int64_t{1} << 53U;
    terms.order.process = hub.thread_id(terms.process, 0);
    terms.order.thread =
        static_cast<std::uint64_t>(protocol::require_integer(argument, "thread", 0, kMostThreads));
  }
  // A name that no client can choose for its own process.
  if (terms.process.empty()) terms.process = "session " + terms.key;
  return terms;
}

json welcome(Hub& hub, NativeHandler& handler, const NativeHandler::Terms& terms) {
  NativeState& state = *hub.native_state;
  const ServerLimits& limits = hub.settings().limits;
  json answer = {{"version", protocol::kVersion},
                 {"encoding", protocol::to_string(terms.encoding)},
                 {"server", {{"name", "playpen"}, {"version", PLAYPEN_VERSION}}},
                 {"simulation", state.simulation},
                 {"port", terms.port},
                 {"robots", protocol::encode_robots(hub.host().robots())},
                 {"canvas", handler.tell_canvas()},
                 {"time", protocol::encode_time(hub.host().time())},
                 {"limits",
                  {{"message_bytes", limits.message_bytes},
                   {"requests_in_flight", limits.requests_in_flight}}}};
  if (terms.session) {
    answer["session"] = handler.number();
    answer["key"] = terms.key;
  }
  return answer;
}

}  // namespace

void say_hello(Peer& peer, Hub& hub, const std::string& id, const json& argument) {
  if (!hub.native_state) {
    hub.native_state = std::make_shared<NativeState>(hub);
    hub.native_state->simulation = make_token();
  }
  const auto refuse = [&](std::string_view error, const char* message) {
    const json answer = {{"error", error}, {"message", message}};
    peer.send(id + " FAILED " + protocol::encode(answer, Encoding::kJson));
  };
  try {
    const NativeHandler::Terms terms = terms_of(hub, argument);
    const std::string name = name_or_empty(argument, "name");
    auto handler = std::make_unique<NativeHandler>(peer, hub, terms);
    const json answer = welcome(hub, *handler, terms);
    peer.describe(
        "playpen " + std::string(protocol::to_string(terms.encoding)) +
        (terms.session ? " session " + std::to_string(hub.native_state->sessions) : " watcher") +
        (name.empty() ? "" : " \"" + name + '"'));
    peer.send(id + " SUCCESS " + protocol::encode(answer, Encoding::kJson));
    peer.set_framing(protocol::framing_of(terms.encoding));
    hub.hand_over(peer, std::move(handler));
  } catch (const ProtocolError& error) {
    refuse(error.id(), error.what());
  } catch (const SessionError& error) {
    refuse(protocol::error_id(error.code()), error.what());
  }
}

}  // namespace playerlike::server
