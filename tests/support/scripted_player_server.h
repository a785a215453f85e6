// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "player_recordings.h"
#include "protocol/framing.h"
#include "protocol/player_xdr.h"
#include "relay.h"

namespace test {

namespace player = playerlike::player;

/// A message with its payload's bytes.
struct WireMessage {
  player::Msghdr header;
  std::string payload;
};

/// A Player server that follows a script: its devices, the rounds of data that it sends when it is
/// asked, and the answers to requests. It keeps what clients send. Its own thread serves one client
/// after the other.
class ScriptedPlayerServer {
 public:
  using Key = std::array<unsigned, 3>;  ///< interface, index, subtype

  /// What the server does. Set before start().
  struct Script {
    std::string banner = player::banner();
    std::vector<player::Devaddr> devices;
    std::string driver = "fixture";
    std::deque<std::string> rounds;  ///< bytes of the messages of a round, without SYNCH
    bool repeats = true;             ///< the last round again and again
    bool ends_rounds = true;         ///< by SYNCH
    std::map<Key, std::deque<std::optional<std::string>>> replies;  ///< nothing: NACK; the last one
                                                                    ///< again and again
    std::vector<Key> silent;                                        ///< requests that get no answer
    /// Answers anything instead of the script; @return whether it has. It may send bytes.
    std::function<bool(const WireMessage&, const std::function<void(std::string_view)>& send)>
        custom;
  };

  ScriptedPlayerServer() = default;
  explicit ScriptedPlayerServer(Script with) : script(std::move(with)) { start(); }
  ~ScriptedPlayerServer() { stop(); }
  ScriptedPlayerServer(const ScriptedPlayerServer&) = delete;
  ScriptedPlayerServer& operator=(const ScriptedPlayerServer&) = delete;

  void start() {
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// Drops the present client; the next one may connect.
  void drop() { drop_ = true; }

  [[nodiscard]] int port() const noexcept { return listening_.port(); }
  [[nodiscard]] std::string host() const { return "player://127.0.0.1:" + std::to_string(port()); }
  [[nodiscard]] int connections() const noexcept { return connections_; }
  /// All messages of clients so far.
  [[nodiscard]] std::vector<WireMessage> received() const {
    const std::lock_guard lock(mutex_);
    return received_;
  }

  /// The script of a recording: its devices, rounds of data and answers.
  [[nodiscard]] static Script script_of(const playpen::test::PlayerRecording& recording) {
    Script script;
    std::string round;
    for (const auto& message : recording.described.at("messages")) {
      if (message.at("direction") != "server") continue;
      const auto parsed = player::parse_message(recording.bytes_of(message));
      const player::Msghdr& header = parsed.header;
      const Key key{header.addr.interf, header.addr.index, header.subtype};
      if (header.type == PLAYER_MSGTYPE_DATA) round += recording.bytes_of(message);
      if (header.type == PLAYER_MSGTYPE_SYNCH) script.rounds.push_back(std::exchange(round, {}));
      if (header.addr.interf == PLAYER_PLAYER_CODE) {
        if (header.type != PLAYER_MSGTYPE_RESP_ACK || header.subtype != PLAYER_PLAYER_REQ_DEV) {
          continue;
        }
        script.devices.push_back(player::decode<player::DeviceReq>(parsed.payload).addr);
      } else if (header.type == PLAYER_MSGTYPE_RESP_ACK) {
        script.replies[key].emplace_back(std::string(parsed.payload));
      } else if (header.type == PLAYER_MSGTYPE_RESP_NACK) {
        script.replies[key].emplace_back(std::nullopt);
      }
    }
    if (!round.empty()) script.rounds.push_back(round);
    return script;
  }

 private:
  void serve() {
    while (!stop_) {
      pollfd polled{listening_.descriptor(), POLLIN, 0};
      if (poll(&polled, 1, 5) <= 0) continue;
      const int client = accept(listening_.descriptor(), nullptr, nullptr);
      if (client < 0) continue;
      ++connections_;
      drop_ = false;
      serve(client);
      close(client);
    }
  }

  void serve(int client) {
    send(client, script.banner);
    playerlike::protocol::MessageSplitter splitter(playerlike::protocol::Framing::kPlayer,
                                                   player::kMaxPayload);
    while (!stop_ && !drop_) {
      pollfd polled{client, POLLIN, 0};
      if (poll(&polled, 1, 5) <= 0) continue;
      constexpr std::size_t kRoom = 65536;
      const auto room = splitter.room(kRoom);
      const ssize_t count = recv(client, room.data(), room.size(), 0);
      if (count <= 0) return;
      splitter.added(static_cast<std::size_t>(count));
      while (const auto bytes = splitter.next()) {
        const auto parsed = player::parse_message(*bytes);
        WireMessage message{parsed.header, std::string(parsed.payload)};
        {
          const std::lock_guard lock(mutex_);
          received_.push_back(message);
        }
        answer(client, message);
      }
    }
  }

  static void send(int client, std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void reply(int client, const WireMessage& to, bool accepted, std::string_view payload) const {
    player::Msghdr header = to.header;
    header.addr.robot = static_cast<std::uint32_t>(port());
    header.type = accepted ? PLAYER_MSGTYPE_RESP_ACK : PLAYER_MSGTYPE_RESP_NACK;
    header.timestamp = 1.0;
    std::string bytes;
    player::append_message(bytes, header, payload);
    send(client, bytes);
  }

  [[nodiscard]] bool has(const player::Devaddr& at) const {
    for (const player::Devaddr& device : script.devices) {
      if (device.interf == at.interf && device.index == at.index) return true;
    }
    return false;
  }

  void answer(int client, const WireMessage& message) {
    if (script.custom &&
        script.custom(message, [&](std::string_view bytes) { send(client, bytes); })) {
      return;
    }
    if (message.header.type != PLAYER_MSGTYPE_REQ) return;
    const player::Msghdr& header = message.header;
    const Key key{header.addr.interf, header.addr.index, header.subtype};
    for (const Key& silent : script.silent) {
      if (silent == key) return;
    }
    const auto scripted = script.replies.find(key);
    if (scripted != script.replies.end()) {
      auto& replies = scripted->second;
      const std::optional<std::string> next = replies.front();
      if (replies.size() > 1) replies.pop_front();
      return reply(client, message, next.has_value(), next.value_or(""));
    }
    if (header.addr.interf != PLAYER_PLAYER_CODE) return reply(client, message, false, "");
    answer_itself(client, message);
  }

  /// Requests to the interface player.
  void answer_itself(int client, const WireMessage& message) {
    switch (message.header.subtype) {
      case PLAYER_PLAYER_REQ_DEVLIST: {
        player::DeviceDevlist list;
        list.devices = script.devices;
        return reply(client, message, true, player::encode(list));
      }
      case PLAYER_PLAYER_REQ_DRIVERINFO: {
        auto info = player::decode<player::DeviceDriverinfo>(message.payload);
        info.driver_name = player::text_bytes(script.driver);
        return reply(client, message, true, player::encode(info));
      }
      case PLAYER_PLAYER_REQ_DEV: {
        auto request = player::decode<player::DeviceReq>(message.payload);
        const bool known = has(request.addr);
        if (known) {
          request.driver_name = player::text_bytes(script.driver);
        } else {
          request.access = PLAYER_ERROR_MODE;
        }
        return reply(client, message, known, player::encode(request));
      }
      case PLAYER_PLAYER_REQ_DATA:
        reply(client, message, true, "");
        return send_round(client);
      default:
        return reply(client, message, true, "");
    }
  }

  void send_round(int client) {
    if (script.rounds.empty()) return;
    std::string bytes = script.rounds.front();
    if (script.rounds.size() > 1 || !script.repeats) script.rounds.pop_front();
    if (script.ends_rounds) {
      player::Msghdr header;
      header.addr.interf = PLAYER_PLAYER_CODE;
      header.type = PLAYER_MSGTYPE_SYNCH;
      header.subtype = PLAYER_PLAYER_SYNCH_OK;
      header.timestamp = 6.9e-310;  // real servers leave them unset
      header.seq = 1660062647;
      player::append_message(bytes, header, std::string_view());
    }
    send(client, bytes);
  }

 public:
  Script script;

 private:
  ListeningSocket listening_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> drop_{false};
  std::atomic<int> connections_{0};
  mutable std::mutex mutex_;
  std::vector<WireMessage> received_;
  std::thread thread_;
};

/// The bytes of a message of data.
template <typename Payload>
std::string data_message(unsigned interface, unsigned index, unsigned subtype, double time_s,
                         const Payload& payload) {
  player::Msghdr header;
  header.addr.interf = static_cast<std::uint16_t>(interface);
  header.addr.index = static_cast<std::uint16_t>(index);
  header.type = PLAYER_MSGTYPE_DATA;
  header.subtype = static_cast<std::uint8_t>(subtype);
  header.timestamp = time_s;
  std::string bytes;
  player::append_message(bytes, header, std::string_view(player::encode(payload)));
  return bytes;
}

}  // namespace test
