// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "playerlike/session/draw_queue.h"
#include "remote/connection.h"

namespace playerlike {

class RemoteClock;
class RemoteSimulation;

/// Sends a socket session's messages to the server in order, drawings before the messages that
/// follow them. Other sessions of the process, and threads that end, use it to make sure that
/// messages have arrived. All members may be called from any thread.
class MessageSender : public std::enable_shared_from_this<MessageSender> {
 public:
  /// @param simulation  the server's name for its simulation.
  MessageSender(std::shared_ptr<Connection> connection, const std::string& simulation);
  ~MessageSender();
  MessageSender(const MessageSender&) = delete;
  MessageSender& operator=(const MessageSender&) = delete;

  [[nodiscard]] std::shared_ptr<Connection> connection() const;
  /// Continues with another connection.
  void replace(std::shared_ptr<Connection> connection, const std::string& simulation);
  [[nodiscard]] std::shared_ptr<RemoteSimulation> simulation() const;

  [[nodiscard]] DrawQueue& drawings() noexcept { return drawings_; }
  /// Sends the draw queue. The first call allocates the queue. @throws ConnectionLost.
  void flush();
  /// Sends drawings and a request, and waits for the answer. @throws as Connection.
  nlohmann::json ask(nlohmann::json& request,
                     Connection::WaitPolicy policy = Connection::WaitPolicy::kTimeout);
  /// As above; also returns the connection that answered.
  nlohmann::json ask(nlohmann::json& request, std::shared_ptr<Connection>& answered_by);
  /// Sends a request by which a thread waits. Before, it makes sure that all earlier messages of
  /// the process's other sessions have arrived, so that the next step sees them.
  nlohmann::json wait(nlohmann::json& request);
  /// As wait(), but returns at once. @param on  receives the connection for
  /// Connection::answer_within(). @return the id for it.
  std::uint64_t begin_wait(nlohmann::json& request, std::shared_ptr<Connection>& on);
  /// Appends a message, with its length or line end.
  using Append = std::function<void(protocol::Encoding encoding, std::string& out)>;
  /// Sends a message without an answer, at once or with the next one that has an answer, see
  /// hold_back(). @throws ConnectionLost.
  void tell(const Append& append);
  /// Makes sure that all messages sent so far have arrived.
  void flush_and_confirm() noexcept;
  /// Calls flush_and_confirm() for all other sessions of this process in the same simulation.
  void confirm_others() noexcept;

  /// Sets whether messages without answers are sent with the next message that has one. That is
  /// equivalent, and saves a system call for each, while no time can pass without this program. The
  /// server then computes for this program only, so answers are expected soon.
  void hold_back(bool holds) noexcept;

  /// Sets whether time follows the wall clock; then a thread flushes the draw queue periodically.
  void set_paced(bool paced);
  [[nodiscard]] bool paced() const noexcept { return paced_; }

  /// Sends the draw queue, and ends the session but not the connection, which then only lets time
  /// pass (`begin_wait`). @return false: that was not possible, and close() must be called.
  [[nodiscard]] bool leave() noexcept;
  /// Sends the draw queue and a good-bye, and ends the connection.
  void close() noexcept;

 private:
  using Lock = std::unique_lock<std::mutex>;
  /// Replaces `outgoing_` by the messages that are held back, and the encoded draw queue. The
  /// caller holds `send_mutex_`.
  void begin_with_waiting(const Connection& connection);
  /// Sends these and a request. The caller holds `send_mutex_`.
  [[nodiscard]] std::uint64_t send_request(Connection& connection, nlohmann::json& request);
  nlohmann::json ask(nlohmann::json& request, Connection::WaitPolicy policy, bool waits,
                     std::shared_ptr<Connection>* answered_by);
  void start_flusher();
  /// Ends the flusher. @return whether it was done before.
  bool stop_flusher() noexcept;
  void flush_now_and_then();

  mutable std::mutex connection_mutex_;  // guards the next two; a leaf mutex
  std::shared_ptr<Connection> connection_;
  std::shared_ptr<RemoteSimulation> simulation_;

  std::mutex send_mutex_;  // guards the consumer's end of the draw queue and the order of messages
  DrawQueue drawings_;
  std::string outgoing_;  // guarded by send_mutex_; kept, see Spare
  bool has_room_ = false;
  std::string held_back_;  // guarded by send_mutex_; see hold_back()
  std::atomic<bool> holds_back_{false};
  std::atomic<std::uint64_t> sent_{0};          // messages without answers so far
  std::atomic<std::uint64_t> acknowledged_{0};  // how many of them have arrived
  std::atomic<bool> joined_{false};             // this client has joined the lockstep

  std::atomic<bool> paced_{false};
  std::mutex flusher_mutex_;  // guards the members below
  std::condition_variable flusher_changed_;
  std::thread flusher_;
  bool closing_ = false;
};

/// A server's simulation, shared by the sessions of this process.
class RemoteSimulation {
 public:
  /// The simulation of a name; one object as long as it is in use.
  [[nodiscard]] static std::shared_ptr<RemoteSimulation> of(const std::string& name);

  /// Its clock in virtual time. @param make  makes the clock if there is none.
  std::shared_ptr<RemoteClock> clock_or(const std::function<std::shared_ptr<RemoteClock>()>& make);

  void add(const std::shared_ptr<MessageSender>& sender);
  void remove(const MessageSender& sender) noexcept;
  /// All senders except the given one.
  [[nodiscard]] std::vector<std::shared_ptr<MessageSender>> others(
      const MessageSender& sender) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<MessageSender>> senders_;
  std::shared_ptr<RemoteClock> clock_;
};

}  // namespace playerlike
