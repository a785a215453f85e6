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
#include <string>
#include <thread>
#include <vector>

#include "playerlike/session/session.h"
#include "protocol/codec.h"
#include "remote/connection.h"

namespace playerlike {

/// How a session with a server is opened.
struct SocketSettings {
  ServerAddress server;
  int port = kMorsePort;  ///< Player port
  protocol::Encoding encoding = protocol::Encoding::kCbor;
  std::vector<std::string> tokens;
  double connect_timeout_s = 10.0;
  double request_timeout_s = 10.0;
  /// An end-of-run error that nobody catches ends the program with status 0, see end_of_program.h.
  bool quiet_end = false;

  /// With what the environment says: PLAYPEN_ENCODING (cbor or json) and PLAYPEN_TOKEN (tokens,
  /// separated by commas). @throws sim::ConfigError run/environment.
  [[nodiscard]] static SocketSettings from_environment(ServerAddress server, int port);
};

/// What is said of an answer that makes no sense.
[[nodiscard]] SessionError misunderstood(const std::string& why);

class SocketLine;

/// A session with a simulation across a network, in Playpen's protocol (docs/protocol.md).
///
/// Has no thread: who waits for an answer reads the socket, see Connection. Only a session that
/// draws in a paced simulation gets one, which sends what waits in its draw queue.
/// What answers tell of is remembered, so overflow, size and generation of the canvas are as of
/// the last answer. A round that was waited for and not taken yet stays as it is.
class SocketSession final : public Session {
 public:
  /// Connects. @throws SessionError as Connection::open().
  explicit SocketSession(SocketSettings settings);
  ~SocketSession() override;

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
  /// Does something with the connection, again if that is lost and another one made.
  template <typename Use>
  auto with_connection(Use use) const;
  /// Makes another connection in place of a lost one. @return whether there is one.
  bool recover(const std::shared_ptr<Connection>& lost) const;
  [[nodiscard]] std::shared_ptr<Connection> connect() const;
  /// Has on a new connection what the lost one had. @throws SessionError.
  void resume(const std::shared_ptr<Connection>& connection) const;
  /// Asks for something that every connection to come is to be asked for as well, and notes that it
  /// is (note(), under `mutex_`), unless the connection was replaced meanwhile: then once more.
  template <typename Note>
  void request_for_good(const Request& request, Note note_it);
  /// Waits between two attempts. @return whether the session is still open.
  bool pause(double seconds) const;

  /// Sends drawings and a request; waits for the answer.
  nlohmann::json ask(nlohmann::json request) const;
  /// Has the server answer a request.
  [[nodiscard]] Answer ask_for(const Request& request) const;
  /// A `read` that may let time pass.
  nlohmann::json read(nlohmann::json request) const;
  void tell(const nlohmann::json& message) const;
  /// Remembers what any answer may tell.
  void note(const nlohmann::json& answer) const;
  /// Remembers what the answer to a `read` tells.
  /// @param round  whether it is a round in any case.
  void accept(const nlohmann::json& answer, bool round);
  /// Throws what the server has said against a message that is not answered.
  void throw_complaint() const;
  void unsubscribe(DeviceId device);
  void set_cells(const SetCellsRequest& what) const;
  [[nodiscard]] WorldMap world_map(double cell_size_m) const;
  void join();
  void sleep(double seconds);
  void sleep_by_the_wall_clock(double seconds);
  [[nodiscard]] TimeStatistics time() const;
  [[noreturn]] void throw_finished();

  const SocketSettings settings_;
  const std::optional<std::string> follow_;  ///< key of the session that this one follows
  std::vector<RobotInfo> robots_;
  std::shared_ptr<SocketLine> line_;
  std::atomic<bool> closed_{false};
  std::atomic<double> request_timeout_s_;
  std::atomic<int> retry_limit_{0};
  std::atomic<double> retry_time_s_{0.0};
  mutable std::mutex recover_mutex_;  ///< one attempt to connect again at a time

  /// Over what follows; never held while waiting for the server.
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  /// The newest connection that was told of all that is noted in the next three.
  mutable std::shared_ptr<const Connection> resumed_;
  std::map<std::pair<int, int>, int> subscriptions_;  ///< device -> count
  bool replace_by_default_ = true;
  std::map<std::pair<int, int>, bool> replace_;  ///< told since the last rule for all devices
  bool reading_ = false;                         ///< a `read` is on its way
  bool round_ = false;                           ///< a round was waited for and not taken yet
  std::vector<protocol::DecodedReading> readings_;
  bool over_ = false;  ///< the run is
  int reads_after_end_ = 0;
  mutable CanvasInfo canvas_;
  std::atomic<std::uint32_t> overflow_{0};
  mutable std::atomic<std::uint64_t> canvas_generation_{0};
};

}  // namespace playerlike
