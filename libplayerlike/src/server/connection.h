// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <asio/ip/tcp.hpp>
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

/// What connections need of their server.
class ConnectionOwner {
 public:
  ConnectionOwner() = default;
  ConnectionOwner(const ConnectionOwner&) = delete;
  ConnectionOwner& operator=(const ConnectionOwner&) = delete;

  [[nodiscard]] virtual const ServerLimits& limits() const noexcept = 0;
  virtual void log(sim::LogLevel level, const std::string& text) = 0;
  /// A handler has been destroyed: a client may have left.
  virtual void handler_gone() = 0;
  /// The connection is over and can be forgotten.
  virtual void ended(Connection& connection) = 0;

 protected:
  ~ConnectionOwner() = default;
};

/// One connection: reads messages for its handler, and writes what that sends.
///
/// Used by the server's thread only. Reading stops while too many requests are in flight, or too
/// many bytes wait to be written. Handlers are destroyed from the event loop, never from inside of
/// a call that they make.
class Connection final : public Peer, public std::enable_shared_from_this<Connection> {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param socket  connected. @param name  of the other end.
  Connection(asio::ip::tcp::socket socket, std::string name, ConnectionOwner& owner);

  /// Begins to read.
  void start(std::unique_ptr<Handler> handler);
  /// Instead: says so, and closes.
  void refuse(std::string farewell);
  [[nodiscard]] bool refused() const noexcept { return refused_; }
  /// See Hub::hand_over().
  void hand_over(std::unique_ptr<Handler> handler);
  /// Closes for a reason that the handler puts into words.
  void fail(const protocol::ProtocolError& error);
  /// As close(), with a reason for the log.
  void close(std::string farewell, std::string reason);
  /// Ends what takes too long. To be called now and then.
  void look_after(Clock::time_point now);
  /// A connection that is being closed ends at this time at the latest.
  void hurry(Clock::time_point deadline);
  /// Closes the socket, now.
  void end(std::string reason);

  /// Whether it has not begun to close.
  [[nodiscard]] bool open() const noexcept { return state_ == State::kOpen; }
  /// Destroys the handler. Not to be called while it may be inside of a call.
  void drop_handler();
  /// Bytes that wait to be written.
  [[nodiscard]] std::size_t queued_bytes() const noexcept { return queued_bytes_; }
  /// How it went, for the log.
  [[nodiscard]] std::string summary() const;

  void send(std::string bytes) override;
  bool send_record(std::shared_ptr<const std::string> bytes) override;
  void close(std::string farewell) override;
  void set_in_flight(std::size_t requests) override;
  void set_busy(bool busy) override;
  void set_encoding(protocol::Encoding encoding) override { splitter_.set_encoding(encoding); }
  [[nodiscard]] const std::string& name() const noexcept override { return name_; }
  void describe(const std::string& text) override { description_ = text; }

 private:
  enum class State { kOpen, kClosing, kEnded };

  /// Bytes that wait to be written.
  struct Item {
    std::string own;
    std::shared_ptr<const std::string> shared;  ///< instead, if set
    [[nodiscard]] const std::string& bytes() const { return shared ? *shared : own; }
  };

  [[nodiscard]] bool paused() const;
  void read();
  void on_read(const asio::error_code& error, std::size_t size);
  /// Hands the messages that are there to the handler.
  void process();
  bool process_one();
  void process_soon();
  template <typename Action>
  void guarded(Action action);
  void push(Item item);
  void flush();
  /// Writes as much as the system takes at once. @return whether that was all, or nothing more
  /// can be written.
  bool write_some();
  void written(std::size_t size);
  /// All has been written, and nothing follows.
  void close_when_read();
  void post(void (Connection::*member)());
  void forget();

  asio::ip::tcp::socket socket_;
  std::string name_;
  ConnectionOwner& owner_;
  std::unique_ptr<Handler> handler_;
  std::unique_ptr<Handler> next_handler_;

  State state_ = State::kOpen;
  bool refused_ = false;
  bool reading_ = false;        ///< a read is under way
  bool reading_bytes_ = false;  ///< ... into scratch_, not into the splitter
  bool writing_ = false;        ///< a wait for room to write is under way
  bool processing_ = false;     ///< inside process()
  bool process_posted_ = false;
  bool peer_left_ = false;    ///< it sends no more
  bool write_ended_ = false;  ///< it has been told that no more follows
  std::size_t in_flight_ = 0;
  bool busy_ = false;  ///< see Peer::set_busy()

  protocol::MessageSplitter splitter_;
  std::size_t room_;                  ///< bytes of the next read
  std::array<char, 2048> scratch_{};  ///< what is read while closing, and raw pieces

  std::deque<Item> queue_;
  std::size_t queue_begin_ = 0;   ///< bytes of the first item that were written
  std::size_t queued_bytes_ = 0;  ///< not written yet

  Clock::time_point opened_ = Clock::now();
  Clock::time_point last_request_ = opened_;
  std::optional<Clock::time_point> partial_since_;  ///< part of a message waits for its rest
  std::optional<Clock::time_point> close_deadline_;
  std::uint64_t requests_ = 0;
  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_out_ = 0;
  std::uint64_t records_lost_ = 0;
  std::string description_;
  std::string reason_;  ///< why it is being closed
};

}  // namespace playerlike::server
