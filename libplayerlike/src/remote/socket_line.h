// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "playerlike/session/draw_queue.h"
#include "remote/connection.h"

namespace playerlike {

class RemoteSimulation;

/// What a socket session says to its server, in order: drawings, then whatever comes after them.
/// Shared with those who must see to it that it has arrived: other sessions of the process, and
/// threads that end. All members may be called from any thread.
class SocketLine : public std::enable_shared_from_this<SocketLine> {
 public:
  /// @param simulation  its server's name for what it runs.
  SocketLine(std::shared_ptr<Connection> connection, const std::string& simulation);
  ~SocketLine();
  SocketLine(const SocketLine&) = delete;
  SocketLine& operator=(const SocketLine&) = delete;

  [[nodiscard]] std::shared_ptr<Connection> connection() const;
  /// Goes on with another connection.
  void replace(std::shared_ptr<Connection> connection, const std::string& simulation);
  [[nodiscard]] std::shared_ptr<RemoteSimulation> simulation() const;

  [[nodiscard]] DrawQueue& drawings() noexcept { return drawings_; }
  /// Sends what waits in the draw queue, and gives it its first room. @throws ConnectionLost.
  void flush();
  /// Sends drawings and a request, and waits for the answer. @throws as Connection.
  nlohmann::json ask(nlohmann::json& request,
                     Connection::Patience patience = Connection::Patience::kTimeout);
  /// The same; tells which connection has answered.
  nlohmann::json ask(nlohmann::json& request, std::shared_ptr<Connection>& answered_by);
  /// A request by which a thread waits: what other sessions of the process have said to the
  /// simulation before has arrived when it is sent, so that a step finds it there.
  nlohmann::json wait(nlohmann::json& request);
  /// Sends a message that is not answered. @throws ConnectionLost.
  void tell(const nlohmann::json& message);
  /// Sees to it that all that was said has arrived.
  void settle() noexcept;
  /// The same for all other sessions of the process with the same simulation.
  void settle_others() noexcept;

  /// Whether time follows the wall clock: then drawings are sent soon without being asked for.
  void set_paced(bool paced);
  [[nodiscard]] bool paced() const noexcept { return paced_; }

  /// Sends what waits, says good-bye and ends the connection.
  void close() noexcept;

 private:
  using Lock = std::unique_lock<std::mutex>;
  /// What waits in the draw queue as bytes, ready to be sent. `say_mutex_` is held.
  [[nodiscard]] std::string take_drawings(protocol::Encoding encoding, std::size_t limit);
  nlohmann::json ask(nlohmann::json& request, Connection::Patience patience, bool waits,
                     std::shared_ptr<Connection>* answered_by);
  void start_flusher();
  void flush_now_and_then();

  mutable std::mutex connection_mutex_;  // over the two; nothing is taken with it held
  std::shared_ptr<Connection> connection_;
  std::shared_ptr<RemoteSimulation> simulation_;

  std::mutex say_mutex_;  // over the draw queue's other end and the order of what is sent
  DrawQueue drawings_;
  bool has_room_ = false;
  std::atomic<std::uint64_t> said_{0};     // messages without answer so far
  std::atomic<std::uint64_t> settled_{0};  // so many of them have arrived
  std::atomic<bool> joined_{false};        // this client has taken part

  std::atomic<bool> paced_{false};
  std::mutex flusher_mutex_;  // over what follows
  std::condition_variable flusher_changed_;
  std::thread flusher_;
  bool closing_ = false;
};

/// A simulation of some server, as the sessions of this process know it.
class RemoteSimulation {
 public:
  /// That of a name; the same one as long as anybody has it.
  [[nodiscard]] static std::shared_ptr<RemoteSimulation> of(const std::string& name);

  void add(const std::shared_ptr<SocketLine>& line);
  void remove(const SocketLine& line) noexcept;
  /// All lines but one.
  [[nodiscard]] std::vector<std::shared_ptr<SocketLine>> others(const SocketLine& line) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<SocketLine>> lines_;
};

}  // namespace playerlike
