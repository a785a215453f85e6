// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/player_xdr.h"
#include "raw_client.h"

namespace test_support {

/// A message of Player's protocol with its own payload.
struct PlayerMessage {
  playerlike::player::Msghdr header;
  std::string payload;

  [[nodiscard]] bool is(int type, int interface, int subtype) const {
    return header.type == type && header.addr.interf == interface && header.subtype == subtype;
  }
  template <typename Payload>
  [[nodiscard]] Payload as() const {
    return playerlike::player::decode<Payload>(payload);
  }
};

/// A client of Player's protocol that is only a socket. Each call waits at most for patience().
class PlayerWireClient {
 public:
  explicit PlayerWireClient(int port) : socket("127.0.0.1", port) {
    banner = socket.bytes(playerlike::player::kBannerBytes);
  }

  /// A message's bytes; its header has host 0, robot 0 and a wall clock's time, as real clients'.
  [[nodiscard]] static std::string message(int type, int interface, int index, int subtype,
                                           std::string_view payload = "") {
    playerlike::player::Msghdr header;
    header.addr.interf = static_cast<std::uint16_t>(interface);
    header.addr.index = static_cast<std::uint16_t>(index);
    header.type = static_cast<std::uint8_t>(type);
    header.subtype = static_cast<std::uint8_t>(subtype);
    header.timestamp = 1795355264.4;
    std::string bytes;
    playerlike::player::append_message(bytes, header, payload);
    return bytes;
  }
  void send(int type, int interface, int index, int subtype, std::string_view payload = "") {
    socket.send(message(type, interface, index, subtype, payload));
  }
  void command(int interface, int index, int subtype, std::string_view payload) {
    send(PLAYER_MSGTYPE_CMD, interface, index, subtype, payload);
  }

  /// The next message. @throws std::runtime_error if the connection ends before.
  [[nodiscard]] PlayerMessage receive() {
    using playerlike::player::kHeaderBytes;
    const std::string head = socket.bytes(kHeaderBytes);
    if (head.size() < kHeaderBytes) throw std::runtime_error("the server has closed");
    PlayerMessage message;
    message.header = playerlike::player::decode<playerlike::player::Msghdr>(head);
    message.payload = socket.bytes(message.header.size);
    return message;
  }

  /// Sends a request. @return the answer; data that came before it are in `data`.
  PlayerMessage request(int interface, int index, int subtype, std::string_view payload = "") {
    send(PLAYER_MSGTYPE_REQ, interface, index, subtype, payload);
    for (;;) {
      PlayerMessage answer = receive();
      if (answer.header.type != PLAYER_MSGTYPE_DATA && answer.header.type != PLAYER_MSGTYPE_SYNCH) {
        return answer;
      }
      data.push_back(std::move(answer));
    }
  }
  PlayerMessage request(int subtype, std::string_view payload = "") {
    return request(PLAYER_PLAYER_CODE, 0, subtype, payload);
  }
  PlayerMessage set_mode(int mode) {
    return request(PLAYER_PLAYER_REQ_DATAMODE,
                   playerlike::player::encode(
                       playerlike::player::DeviceDatamodeReq{static_cast<std::uint8_t>(mode)}));
  }
  PlayerMessage access(int interface, int index, int mode) {
    playerlike::player::DeviceReq request;
    request.addr.interf = static_cast<std::uint16_t>(interface);
    request.addr.index = static_cast<std::uint16_t>(index);
    request.access = static_cast<std::uint8_t>(mode);
    return this->request(PLAYER_PLAYER_REQ_DEV, playerlike::player::encode(request));
  }
  PlayerMessage open(int interface, int index = 0) {
    return access(interface, index, PLAYER_OPEN_MODE);
  }

  /// Requests data (PULL) without waiting.
  void begin_round() { send(PLAYER_MSGTYPE_REQ, PLAYER_PLAYER_CODE, 0, PLAYER_PLAYER_REQ_DATA); }
  /// The data of a round that has been requested, without the acknowledgement and SYNCH.
  [[nodiscard]] std::vector<PlayerMessage> end_round() {
    std::vector<PlayerMessage> round;
    for (;;) {
      PlayerMessage message = receive();
      if (message.header.type == PLAYER_MSGTYPE_SYNCH) return round;
      if (message.header.type == PLAYER_MSGTYPE_DATA) round.push_back(std::move(message));
    }
  }
  [[nodiscard]] std::vector<PlayerMessage> round() {
    begin_round();
    return end_round();
  }

  RawClient socket;
  std::string banner;
  std::vector<PlayerMessage> data;  ///< see request()
};

}  // namespace test_support
