// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <asio/generic/stream_protocol.hpp>
#include <asio/ip/address.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"
#include "remote/server_address.h"

/// Connecting to servers with a time limit; all connections of clients share it.
namespace playerlike {

using SocketClock = std::chrono::steady_clock;
/// A connected socket, of TCP or of this machine.
using StreamSocket = asio::generic::stream_protocol::socket;

/// A lost connection; the message says why it was lost.
class ConnectionLost : public SessionError {
 public:
  explicit ConnectionLost(const std::string& message)
      : SessionError(Code::kDisconnected, message) {}
};

/// "2.5 s", for messages.
[[nodiscard]] std::string seconds_text(SocketClock::duration duration);

inline constexpr double kLongest_s = 1e9;  ///< 30 years
/// A duration from seconds, which are limited to [0, kLongest_s].
[[nodiscard]] SocketClock::duration wall_duration(double seconds);

/// Waits until the socket is readable (POLLIN) or writable (POLLOUT). @return false at the
/// deadline.
[[nodiscard]] bool wait_for_socket(int socket, short events, SocketClock::time_point deadline);

/// A deadline for a whole attempt to connect.
class ConnectDeadline {
 public:
  /// @param give_up  polled; true ends the attempt. It must outlive the deadline; may be empty.
  ConnectDeadline(SocketClock::duration timeout, const std::function<bool()>& give_up)
      : end_(SocketClock::now() + timeout), give_up_(give_up) {}
  [[nodiscard]] SocketClock::time_point end() const noexcept { return end_; }
  /// Waits until `ready(until)` is true. @param share  the wait may use 1/share of the time left.
  template <typename Ready>
  [[nodiscard]] bool wait(Ready ready, std::size_t share = 1) const {
    const auto now = SocketClock::now();
    const auto end = now + (end_ - now) / static_cast<SocketClock::rep>(share);
    for (;;) {
      if (give_up_ && give_up_()) return false;
      if (ready(std::min(end, SocketClock::now() + std::chrono::milliseconds(50)))) return true;
      if (SocketClock::now() >= end) return false;
    }
  }

 private:
  SocketClock::time_point end_;
  const std::function<bool()>& give_up_;
};

/// Throws SessionError kDisconnected: "cannot connect to ADDRESS: " and the reason.
[[noreturn]] void fail_to_connect(const ServerAddress& address, const std::string& why);

/// Resolves the server's host, tries all its addresses in turn, and connects the socket. The socket
/// does not block, and has no delay for small messages.
/// @param timeout  of the whole attempt, for messages.
/// @param refused  hint for a refused connection, e.g. "is `playpen serve` running there?".
/// @throws SessionError kDisconnected that names host, port and reason.
void connect_tcp(StreamSocket& socket, const ServerAddress& address, SocketClock::duration timeout,
                 const ConnectDeadline& deadline, const char* refused);

/// Connects the socket to a Unix socket, or uses a descriptor that is connected already. The socket
/// does not block.
/// @param address  one of this machine, see ServerAddress::is_local().
/// @throws SessionError kDisconnected that names address and reason.
void connect_local(StreamSocket& socket, const ServerAddress& address);

/// Calls attempt() until it does not throw a SessionError.
/// @param limit  maximum number of attempts; < 0: no limit.
/// @param pause  called before each attempt but the first; false gives up.
/// @return what to tell the user; empty: an attempt has succeeded.
[[nodiscard]] std::string connect_again(int limit, const std::function<bool()>& pause,
                                        const std::function<void()>& attempt);

/// The text of a socket's error, for messages.
[[nodiscard]] std::string socket_problem(const ServerAddress& address,
                                         const asio::error_code& error);

/// Writes all bytes. @return the reason if that is not possible within the timeout; empty: done.
[[nodiscard]] std::string write_all(StreamSocket& socket, const ServerAddress& address,
                                    std::string_view bytes, SocketClock::duration timeout);

/// Reads what has arrived, without waiting.
/// @return the number of bytes; 0 if there are none yet. @throws ConnectionLost.
[[nodiscard]] std::size_t read_some(StreamSocket& socket, const ServerAddress& address,
                                    std::span<char> room);

/// Whether the server has closed the connection and all its data were read.
[[nodiscard]] bool is_at_end(int socket) noexcept;

}  // namespace playerlike
