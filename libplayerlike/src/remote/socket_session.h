// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "playerlike/session/session.h"
#include "protocol/codec.h"
#include "remote/connection.h"
#include "remote/message_sender.h"
#include "remote/remote_clock.h"

namespace playerlike {

/// How to open a session with a server.
struct SocketSettings {
  ServerAddress server;
  int port = kMorsePort;  ///< Player port
  protocol::Encoding encoding = protocol::Encoding::kCbor;
  std::vector<std::string> tokens;
  double connect_timeout_s = 10.0;
  double request_timeout_s = 10.0;
  /// An end-of-run error that nobody catches ends the program with status 0, see end_of_program.h.
  bool quiet_end = false;
  /// Whether the program's time is virtual if the server's is lockstep, see RemoteClock.
  bool virtual_time = false;
  double silence_limit_s = 5.0;  ///< in virtual time, see RunSettings

  /// Reads the environment: PLAYPEN_ENCODING (cbor or json) and PLAYPEN_TOKEN (tokens, separated by
  /// commas). @throws sim::ConfigError run/environment.
  [[nodiscard]] static SocketSettings from_environment(ServerAddress server, int port);
};

/// The error for an answer that cannot be decoded.
[[nodiscard]] SessionError misunderstood(const std::string& why);

/// A session with a simulation on a server, in Playpen's protocol (docs/protocol.md).
///
/// It has no thread: a thread that waits for an answer reads the socket, see Connection. The
/// exception is a session that draws in a paced simulation; its thread sends the draw queue.
/// Overflow, size and generation of the canvas are cached from the last answer. A round that peek()
/// or wait() has fetched is kept until take().
///
/// In virtual time its waits are those of RemoteClock, which all such sessions of a simulation
/// share.
class SocketSession final : public Session {
 public:
  /// Connects. @throws SessionError as Connection::open().
  explicit SocketSession(SocketSettings settings);
  ~SocketSession() override;

  /// Whether its waits are those of virtual time.
  [[nodiscard]] bool in_turns() const noexcept;

  const std::vector<RobotInfo>& robots() const noexcept override;
  int port() const noexcept override;
  bool connected() const noexcept override;

  void wait() override;
  int take(ReadingSink& sink) override;
  bool peek(std::chrono::milliseconds timeout) override;
  void send(DeviceId device, const sim::Command& command) override;
  Answer answer(const Request& request) override;
  DrawQueue& draw_queue() noexcept override;
  std::uint64_t canvas_generation() const noexcept override;
  std::unique_ptr<Session> open_follower() override;
  const void* simulation() const noexcept override;
  void close() noexcept override;

 private:
  using Lock = std::unique_lock<std::mutex>;
  class ReadTurn;
  struct RequestHandler;

  SocketSession(SocketSettings settings, std::optional<std::string> follow);

  void require_open() const;
  [[noreturn]] static void throw_closed();
  [[nodiscard]] nlohmann::json hello() const;
  /// Calls use(); repeats it after a reconnection if the connection is lost.
  template <typename Use>
  auto with_connection(Use use) const {
    for (;;) {
      require_open();
      const std::shared_ptr<Connection> connection = sender_->connection();
      try {
        return use();
      } catch (const ConnectionLost&) {
        require_open();
        if (!recover(connection)) throw;
      }
    }
  }
  /// Replaces a lost connection. @return whether there is one now.
  bool recover(const std::shared_ptr<Connection>& lost) const;
  [[nodiscard]] std::shared_ptr<Connection> connect() const;
  /// Restores the session's state on a new connection. @throws SessionError.
  void resume(const std::shared_ptr<Connection>& connection) const;
  /// Sends a request that must be repeated on every later connection, and records it with note_it()
  /// under `mutex_`. Repeats the request if the connection was replaced meanwhile.
  template <typename Note>
  void request_persistently(const Request& request, Note note_it);
  /// Waits between two attempts to connect. @return whether the session is still open.
  bool pause(double seconds) const;

  /// Sends drawings and a request; waits for the answer.
  nlohmann::json ask(nlohmann::json& request) const;
  nlohmann::json ask(nlohmann::json&& request) const { return ask(request); }
  /// Sends a request to the server and decodes its answer.
  [[nodiscard]] Answer ask_for(const Request& request) const;
  /// Sends a `read`, which may let time pass.
  nlohmann::json read(nlohmann::json request) const;
  /// Caches the values that any answer may contain.
  void note(const nlohmann::json& answer) const;
  /// Stores the contents of an answer to a `read`.
  /// @param round  whether it counts as a round even without readings.
  void store_answer(const nlohmann::json& answer, bool round);
  /// Throws the server's error for a message without an answer.
  void throw_async_error() const;
  void unsubscribe(DeviceId device);
  void set_cells(const SetCellsRequest& what) const;
  /// Sends cells that fit one message. The first ones of a layer wait for the answer, which says
  /// whether the session may draw there. Nothing that this session does not do itself changes that,
  /// so further ones need no answer.
  void set_cells(sim::LayerId layer, const sim::CellRect& rect,
                 std::span<const sim::CellValue> cells) const;
  /// Whether the server has taken cells of a layer before.
  [[nodiscard]] bool accepts_cells(sim::LayerId layer) const;
  /// Lets the next cells of each layer wait for the answer again.
  void forget_layers() const;
  [[nodiscard]] WorldMap world_map(double cell_size_m) const;
  /// Attaches the session to the clock of virtual time, if the settings and the server allow it.
  void take_part_in_turns(const TimeStatistics& time, std::uint64_t session);
  void note_wait() const;
  /// The waits in virtual time. @return whether it was done; otherwise time is real now.
  [[nodiscard]] bool wait_for_data_in_turns();
  [[nodiscard]] bool peek_in_turns(std::chrono::milliseconds timeout, bool& result);
  [[nodiscard]] bool sleep_in_turns(double seconds);
  void join();
  void sleep(double seconds);
  void sleep_by_the_wall_clock(double seconds);
  [[nodiscard]] TimeStatistics time() const;
  [[noreturn]] void throw_finished();

  const SocketSettings settings_;
  const std::optional<std::string> follow_;  ///< key of the session that this one follows
  std::vector<RobotInfo> robots_;
  std::shared_ptr<MessageSender> sender_;
  std::shared_ptr<RemoteClock> clock_;  ///< null: the session's time is real
  RemoteClock::ClientPointer turns_;    ///< the clock's state of this session
  std::atomic<bool> closed_{false};
  std::atomic<double> request_timeout_s_;
  std::atomic<int> retry_limit_{0};
  std::atomic<double> retry_time_s_{0.0};
  mutable std::mutex recover_mutex_;  ///< allows one reconnection at a time

  /// Guards the members below; never held while waiting for the server.
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  /// The newest connection that has the state of the next three members.
  mutable std::shared_ptr<const Connection> resumed_;
  std::map<std::pair<int, int>, int> subscriptions_;  ///< device -> count
  bool replace_by_default_ = true;
  std::map<std::pair<int, int>, bool> replace_;  ///< set since the last rule for all devices
  bool reading_ = false;                         ///< a `read` is in progress
  bool round_ = false;                           ///< a round was fetched and not taken yet
  std::vector<protocol::DecodedReading> readings_;
  bool over_ = false;  ///< the run is over
  int reads_after_end_ = 0;
  mutable CanvasInfo canvas_;
  mutable std::shared_ptr<const Connection> layers_of_;  ///< the server that has taken cells of ...
  mutable std::set<sim::LayerId> layers_;                ///< ... these layers
  std::atomic<std::uint32_t> overflow_{0};
  mutable std::atomic<std::uint64_t> canvas_generation_{0};
};

}  // namespace playerlike
