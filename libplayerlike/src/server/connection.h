// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <asio/generic/stream_protocol.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "playerlike/server/server_settings.h"
#include "server/peer.h"

namespace playerlike::server {

class Connection;

/// The interface through which connections use their server.
class ConnectionOwner {
 public:
  ConnectionOwner() = default;
  ConnectionOwner(const ConnectionOwner&) = delete;
  ConnectionOwner& operator=(const ConnectionOwner&) = delete;

  [[nodiscard]] virtual const ServerLimits& limits() const noexcept = 0;
  virtual void log(sim::LogLevel level, const std::string& text) = 0;
  /// A handler has been destroyed, so a client may have left.
  virtual void handler_gone() = 0;
  /// The connection has ended and can be deleted.
  virtual void ended(Connection& connection) = 0;

 protected:
  ~ConnectionOwner() = default;
};

/// A connection: reads messages for its handler and writes what the handler sends.
///
/// Used by the server's thread only. Reading pauses while too many requests are in flight or too
/// many bytes are queued for writing (back-pressure). Handlers are destroyed from the event loop,
/// never inside of a call that they make.
class Connection final : public Peer, public std::enable_shared_from_this<Connection> {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param socket  connected.
  /// @param name    of the peer.
  Connection(asio::generic::stream_protocol::socket socket, std::string name,
             ConnectionOwner& owner);

  /// Starts to read.
  void start(std::unique_ptr<Handler> handler);
  /// Replaces start(): sends a farewell and closes.
  void refuse(std::string farewell);
  [[nodiscard]] bool refused() const noexcept { return refused_; }
  /// See Hub::hand_over().
  void hand_over(std::unique_ptr<Handler> handler);
  /// Closes with an error, which the handler formats.
  void fail(const protocol::ProtocolError& error);
  /// As close(), with a reason for the log.
  void close(std::string farewell, std::string reason);
  /// Ends connections that exceed a time limit; must be called periodically.
  void enforce_limits(Clock::time_point now);
  /// Sets the latest end of a connection that is closing.
  void hurry(Clock::time_point deadline);
  /// Closes the socket at once.
  void end(std::string reason);

  /// Whether it is open, and not closing.
  [[nodiscard]] bool open() const noexcept { return state_ == State::kOpen; }
  /// Destroys the handler. Must not be called inside of a call of the handler.
  void drop_handler();
  /// Bytes queued for writing.
  [[nodiscard]] std::size_t queued_bytes() const noexcept { return queued_bytes_; }
  /// Statistics of the connection for the log.
  [[nodiscard]] std::string summary() const;
  [[nodiscard]] bool is_debugged();

  void send(std::string bytes) override;
  bool send_record(std::shared_ptr<const std::string> bytes) override;
  void close(std::string farewell) override;
  void set_in_flight(std::size_t requests) override;
  void set_busy(bool busy) override;
  void set_framing(protocol::Framing framing) override { splitter_.set_framing(framing); }
  void acknowledge_at_once() override { acknowledges_at_once_ = true; }
  [[nodiscard]] std::optional<std::uint64_t> settled_input() const override;
  [[nodiscard]] std::optional<int> local_process() override;
  [[nodiscard]] std::function<std::optional<int>()> process_search() override;
  [[nodiscard]] std::uint32_t own_ipv4() override;
  [[nodiscard]] const std::string& name() const noexcept override { return name_; }
  void describe(const std::string& text) override { description_ = text; }

 private:
  enum class State { kOpen, kClosing, kEnded };

  /// A queued buffer.
  struct Item {
    std::string own;
    std::shared_ptr<const std::string> shared;  ///< replaces `own` if it is set
    [[nodiscard]] const std::string& bytes() const { return shared ? *shared : own; }
  };

  [[nodiscard]] bool paused() const;
  void read();
  void on_read(const asio::error_code& error, std::size_t size);
  /// Passes the buffered messages to the handler.
  void process();
  bool process_one();
  void process_soon();
  template <typename Action>
  void guarded(Action action);
  void push(Item item);
  void flush();
  /// Writes as much as the system takes at once. @return whether the queue is empty or writing has
  /// failed.
  bool write_some();
  void written(std::size_t size);
  /// Called when everything is written and nothing follows.
  void close_when_read();
  void post(void (Connection::*member)());
  void forget();

  asio::generic::stream_protocol::socket socket_;
  std::string name_;
  ConnectionOwner& owner_;
  std::unique_ptr<Handler> handler_;
  std::unique_ptr<Handler> next_handler_;

  State state_ = State::kOpen;
  bool refused_ = false;
  bool reading_ = false;        ///< an asynchronous read is in progress
  bool reading_bytes_ = false;  ///< ... into scratch_, not into the splitter
  bool writing_ = false;        ///< waits until the socket is writable
  bool processing_ = false;     ///< process() is running
  bool process_posted_ = false;
  bool peer_left_ = false;    ///< the peer has closed its sending direction
  bool write_ended_ = false;  ///< our sending direction is shut down
  std::size_t in_flight_ = 0;
  bool busy_ = false;  ///< see Peer::set_busy()
  bool acknowledges_at_once_ = false;

  protocol::MessageSplitter splitter_;
  std::size_t room_;                  ///< size of the next read [bytes]
  std::array<char, 2048> scratch_{};  ///< buffer for data while closing, and for unframed input

  std::deque<Item> queue_;
  std::size_t queue_begin_ = 0;   ///< bytes of the first item that are written already
  std::size_t queued_bytes_ = 0;  ///< not written yet

  Clock::time_point opened_ = Clock::now();
  Clock::time_point last_request_ = opened_;
  Clock::time_point
      debugged_at_{};  ///< the last time when a limit found the client under a debugger
  std::optional<Clock::time_point> partial_since_;  ///< age of an incomplete message
  std::optional<Clock::time_point> close_deadline_;
  std::uint64_t requests_ = 0;
  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_out_ = 0;
  std::uint64_t records_lost_ = 0;
  std::string description_;
  std::string reason_;  ///< why the connection is closing
};

}  // namespace playerlike::server
