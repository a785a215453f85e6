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

namespace playerlike {

/// A connection that is no more: what the messages of a lost one are told by.
class ConnectionLost : public SessionError {
 public:
  explicit ConnectionLost(const std::string& message)
      : SessionError(Code::kDisconnected, message) {}
};

/// The client's end of one connection that speaks Playpen's protocol (docs/protocol.md).
///
/// There is no thread behind it: of the threads that wait for answers one at a time, the leader,
/// reads the socket and hands the others what is theirs; when its own answer is there, another one
/// leads. All members may be called from any thread. Whatever goes wrong with the connection ends
/// it, for all of them.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  /// Looks the host up, tries all its addresses in turn, and says hello.
  /// @param hello    its argument, encoding included.
  /// @param timeout  of all that together.
  /// @param give_up  asked now and then; true ends the attempt.
  /// @throws SessionError kDisconnected that names host, port and reason; what the server has
  ///         against it.
  [[nodiscard]] static std::shared_ptr<Connection> open(const ServerAddress& address,
                                                        const nlohmann::json& hello,
                                                        Clock::duration timeout,
                                                        const std::function<bool()>& give_up);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// What the server has answered to hello.
  [[nodiscard]] const nlohmann::json& welcome() const noexcept;
  [[nodiscard]] protocol::Encoding encoding() const noexcept;
  /// Of a message to the server [bytes].
  [[nodiscard]] std::size_t message_limit() const noexcept;
  /// How long an answer may take.
  void set_request_timeout(Clock::duration timeout) noexcept;

  /// How long the answer to a request is waited for.
  enum class Patience {
    kTimeout,  ///< the request timeout
    kLiving,   ///< as long as the server shows within each request timeout that it lives; it is
               ///< asked for the time when it has been silent for half of that
  };
  /// Sends bytes (messages), then a request, in one piece. Gives the request its `id`.
  /// @return the id, for answer(), which must be called.
  /// @throws ConnectionLost.
  [[nodiscard]] std::uint64_t ask(nlohmann::json& request, std::string before = {});
  /// Waits for an answer.
  /// @param at_most  instead of the request timeout, if shorter.
  /// @throws ConnectionLost; SessionError for an answer that is an error.
  [[nodiscard]] nlohmann::json answer(std::uint64_t id, Patience patience = Patience::kTimeout,
                                      std::optional<Clock::duration> at_most = std::nullopt);
  /// Sends a message that is not answered, or several. @throws ConnectionLost.
  void tell(std::string_view bytes);
  /// The first error since the last call that such a message has met with.
  [[nodiscard]] std::optional<SessionError> complaint();

  /// Whether nothing can be sent any more; looks at the socket too.
  [[nodiscard]] bool lost() const noexcept;
  /// Ends the connection, waking all who wait.
  void shut(const std::string& reason) noexcept;

 private:
  struct Impl;
  explicit Connection(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace playerlike
