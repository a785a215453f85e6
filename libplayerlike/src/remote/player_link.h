// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/player_structs.h"
#include "remote/server_address.h"
#include "remote/tcp_connect.h"

namespace playerlike {

/// The client's end of a connection in Player's protocol (docs/player_wire.md): the server's
/// greeting, commands, requests with one in flight at a time, and rounds of data in PULL mode.
///
/// It has no thread of its own. One of the threads that wait, the leader, reads the socket, hands
/// data to the receiver, and wakes the others. All members may be called from any thread. A failure
/// of the connection ends it for all threads; a request without an answer does not.
class PlayerLink {
 public:
  using Clock = SocketClock;

  /// Maximum length of a message, as in Player [bytes].
  static constexpr std::size_t kMaxMessage = PLAYER_MAX_MESSAGE_SIZE;
  /// Maximum number of bytes that a server may send in a round; more end the connection.
  static constexpr std::size_t kMaxRound = std::size_t{256} << 20U;

  /// A server that has connected, but that does not greet as a Player server does.
  class NoPlayerServer : public SessionError {
   public:
    explicit NoPlayerServer(const std::string& message)
        : SessionError(Code::kDisconnected, message) {}
  };

  /// Receives data. The leader calls it, one call at a time, without any lock of the link.
  class Receiver {
   public:
    virtual ~Receiver() = default;
    /// Takes a message of data. @throws protocol::ProtocolError if it cannot be understood, which
    /// ends the connection.
    virtual void on_data(const player::Msghdr& header, std::string_view payload) = 0;
    /// The server has sent all data that it had for the last request of data.
    /// @param dropped  how many messages it has dropped since the last round.
    virtual void on_round(std::uint32_t dropped) = 0;
  };

  /// An answer to a request.
  struct Reply {
    bool accepted = false;  ///< RESP_ACK; false: RESP_NACK
    double timestamp_s = 0.0;
    std::string payload;
  };

  /// Connects and waits for the server's greeting.
  ///
  /// @param receiver  outlives the link.
  /// @param timeout  of the whole attempt.
  /// @param banner_timeout  of the greeting, from the moment of the connection.
  /// @param give_up  polled; true ends the attempt.
  /// @throws SessionError kDisconnected that names host, port and reason; NoPlayerServer.
  [[nodiscard]] static std::shared_ptr<PlayerLink> open(const ServerAddress& address,
                                                        Receiver& receiver, Clock::duration timeout,
                                                        Clock::duration banner_timeout,
                                                        const std::function<bool()>& give_up);
  ~PlayerLink();
  PlayerLink(const PlayerLink&) = delete;
  PlayerLink& operator=(const PlayerLink&) = delete;

  [[nodiscard]] const ServerAddress& address() const noexcept;
  /// The server's version as in its greeting, e.g. "3.1.0".
  [[nodiscard]] const std::string& version() const noexcept;
  /// Sets the maximum time to wait for an answer.
  void set_request_timeout(Clock::duration timeout) noexcept;
  [[nodiscard]] Clock::duration request_timeout() const noexcept;

  /// Sends a command. @throws ConnectionLost.
  void command(const player::Devaddr& device, std::uint8_t subtype, std::string_view payload);
  /// Sends a request and waits for its answer; other threads' requests wait meanwhile.
  /// @return the answer; nothing if the server has not answered in time. @throws ConnectionLost.
  [[nodiscard]] std::optional<Reply> request(const player::Devaddr& device, std::uint8_t subtype,
                                             std::string_view payload);

  /// Requests the next round of data, unless that has been done already. @throws ConnectionLost.
  void request_round();
  /// Reads the socket until done() is true, at the latest until the deadline. done() is called
  /// under a lock of the link, so it must neither call the link nor wait.
  /// @return whether done() is true. @throws ConnectionLost.
  bool wait(Clock::time_point deadline, const std::function<bool()>& done);
  /// As wait() without a deadline, but makes sure that the server is alive: after half of a request
  /// timeout without data it is sent a request; a whole timeout without data ends the connection.
  void wait_while_alive(const std::function<bool()>& done);

  /// Whether the connection is lost; checks the socket too.
  [[nodiscard]] bool lost() const noexcept;
  /// Ends the connection and wakes all threads that wait.
  void close(const std::string& reason) noexcept;

 private:
  struct Impl;
  explicit PlayerLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The address of the interface "player" of a server.
[[nodiscard]] player::Devaddr player_itself() noexcept;

}  // namespace playerlike
