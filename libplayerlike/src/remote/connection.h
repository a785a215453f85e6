// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "playerlike/messages/messages.h"
#include "protocol/framing.h"
#include "remote/server_address.h"
#include "remote/tcp_connect.h"

namespace playerlike {

/// The client's end of a connection in Playpen's protocol (docs/protocol.md).
///
/// It has no thread of its own. One of the threads that wait for answers, the leader, reads the
/// socket and hands the other threads their answers. When the leader has its own answer, another
/// thread becomes the leader. All members may be called from any thread. Any failure ends the
/// connection for all threads.
class Connection {
 public:
  using Clock = SocketClock;

  /// Resolves the host, tries all its addresses in turn, and sends hello.
  ///
  /// @param hello    the argument of hello, encoding included.
  /// @param timeout  of the whole attempt.
  /// @param give_up  polled; true ends the attempt.
  /// @throws SessionError kDisconnected that names host, port and reason; the server's error if it
  /// refuses.
  [[nodiscard]] static std::shared_ptr<Connection> open(const ServerAddress& address,
                                                        const nlohmann::json& hello,
                                                        Clock::duration timeout,
                                                        const std::function<bool()>& give_up);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// The server's answer to hello.
  [[nodiscard]] const nlohmann::json& welcome() const noexcept;
  [[nodiscard]] protocol::Encoding encoding() const noexcept;
  /// Maximum length of a message to the server [bytes].
  [[nodiscard]] std::size_t message_limit() const noexcept;
  /// Sets whether answers come so soon that it is worth looking for them before a thread sleeps,
  /// see ShortWait.
  void expect_soon(bool soon) noexcept;
  /// Sets the maximum time to wait for an answer.
  void set_request_timeout(Clock::duration timeout) noexcept;

  /// How long to wait for the answer to a request.
  enum class WaitPolicy {
    kTimeout,     ///< the request timeout
    kWhileAlive,  ///< as long as the server is alive: after half of a request timeout without data
                  ///< it is asked for the time; a whole timeout without data ends the connection
  };
  /// Appends a request to `bytes` (encoded messages) and sends all in one piece. Sets the `id` of
  /// the request.
  /// @return the id for answer(), which must be called. @throws ConnectionLost.
  [[nodiscard]] std::uint64_t ask(nlohmann::json& request, std::string& bytes);
  /// Waits for an answer. In CBOR its `readings` are not decoded, see protocol::kEncodedItemTag.
  /// @param at_most  replaces the request timeout if it is shorter.
  /// @throws ConnectionLost; SessionError for an error answer.
  [[nodiscard]] nlohmann::json answer(std::uint64_t id, WaitPolicy policy = WaitPolicy::kTimeout,
                                      std::optional<Clock::duration> at_most = std::nullopt);
  /// As answer() with kWhileAlive, but returns nullopt if there is no answer within this time; then
  /// it must be called again.
  [[nodiscard]] std::optional<nlohmann::json> answer_within(std::uint64_t id,
                                                            Clock::duration at_most);
  /// Sends one or more messages that have no answers. @throws ConnectionLost.
  void tell(std::string_view bytes);
  /// The first error of such messages since the last call.
  [[nodiscard]] std::optional<SessionError> async_error();

  /// Whether the connection is lost; checks the socket too.
  [[nodiscard]] bool lost() const noexcept;
  /// Ends the connection and wakes all threads that wait.
  void close(const std::string& reason) noexcept;

 private:
  struct Impl;
  explicit Connection(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace playerlike
