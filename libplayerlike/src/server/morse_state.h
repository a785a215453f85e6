// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "server/morse_components.h"
#include "server/peer.h"

namespace playerlike::server {

class MorseConnection;
class MorseStreams;
struct MorseService;

/// A request that cannot be executed; the text is sent to MORSE's client after FAILED.
class MorseRefusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Posts tasks from the thread that steps the simulation to the server's thread, while the server
/// exists.
class Postbox {
 public:
  explicit Postbox(Hub& hub) : hub_(&hub) {}
  /// May be called from any thread. Does nothing after close().
  void post(std::function<void()> task) {
    const std::lock_guard lock(mutex_);
    if (hub_ != nullptr) hub_->post(std::move(task));
  }
  void close() {
    const std::lock_guard lock(mutex_);
    hub_ = nullptr;
  }

 private:
  std::mutex mutex_;
  Hub* hub_;
};

/// State that all of a server's connections in MORSE's protocol share: components, streams, and
/// requests with a later answer. Used by the server's thread only.
class MorseState : public std::enable_shared_from_this<MorseState> {
 public:
  explicit MorseState(Hub& hub);
  ~MorseState();
  MorseState(const MorseState&) = delete;
  MorseState& operator=(const MorseState&) = delete;

  /// The hub's object; created by the first call.
  static std::shared_ptr<MorseState> of(Hub& hub);

  [[nodiscard]] Hub& hub() noexcept { return hub_; }
  [[nodiscard]] Host& host() noexcept { return hub_.host(); }
  [[nodiscard]] const std::vector<MorseComponent>& components() const noexcept {
    return components_;
  }
  /// @return null if no component has this name.
  [[nodiscard]] const MorseComponent* find(std::string_view name) const noexcept;
  [[nodiscard]] MorseStreams& streams() noexcept { return *streams_; }
  /// The session for requests about the canvas, with the rights of all robots. It does not take
  /// part in the lockstep.
  [[nodiscard]] Session& session() { return client()->session(); }
  [[nodiscard]] const std::shared_ptr<EventClient>& client();

  /// Sends a command to a device at once, to the real robot if it mirrors one. @throws MorseRefusal
  /// with the reason: the run is over, the device refuses, or the real robot cannot execute it.
  static void command(Commander& commander, DeviceId device, const sim::Command& command);

  /// @name Requests that are answered later
  /// @{

  /// Answers after a duration of simulated time.
  void answer_after(MorseConnection& from, const std::string& id, double seconds);
  /// Sends a goal to a waypoint device, and answers when the robot has arrived. An earlier request
  /// that waits for this device is answered with PREEMPTED. @throws MorseRefusal as command().
  void answer_on_arrival(MorseConnection& from, const std::string& id, DeviceId waypoint,
                         const sim::GotoCommand& goal);
  /// Answers without a result when done(device) is true. An earlier request that waits for this
  /// device is answered with PREEMPTED. @throws MorseRefusal if the run is over.
  void answer_when(MorseConnection& from, const std::string& id, DeviceId device,
                   std::function<bool(const sim::Device&)> done);
  /// Answers the connection's requests with this id with PREEMPTED; the device stops what it does.
  void cancel(MorseConnection& from, const std::string& id);
  /// Called when the connection has ended: its actions continue without an answer.
  void forget(MorseConnection& from);
  /// Number of the connection's requests without an answer so far.
  [[nodiscard]] std::size_t waiting(const MorseConnection& from) const noexcept;
  /// @}

  /// @name Whether requests to a component are logged: MORSE's set_log_level
  /// @{
  void set_verbose(const std::string& component, bool verbose);
  [[nodiscard]] bool verbose(const std::string& component) const {
    return verbose_.contains(component);
  }
  /// @}

  /// @name Targets of arms: MORSE's IK targets, in B
  /// @{
  [[nodiscard]] std::optional<Eigen::Isometry3d> target_of(const std::string& component) const {
    const auto found = targets_.find(component);
    return found != targets_.end() ? std::optional(found->second) : std::nullopt;
  }
  void keep_target(const std::string& component, const Eigen::Isometry3d& X_BT) {
    targets_.insert_or_assign(component, X_BT);
  }
  /// The targets are again where they were at the start.
  void forget_targets() { targets_.clear(); }
  /// @}

  /// @name Whether a client of the clock synchronisation allows each step
  /// @{
  void set_synchronised(bool synchronised);
  [[nodiscard]] bool synchronised() const noexcept { return synchronised_; }
  /// @}

  [[nodiscard]] const std::shared_ptr<Postbox>& postbox() const noexcept { return postbox_; }

 private:
  /// The result of a waiting request, set by its alarm.
  enum class Outcome { kNone, kArrived, kReplaced };
  struct PendingRequest {
    MorseConnection* from = nullptr;
    std::string id;
    std::optional<DeviceId> device;  ///< that executes it; none: a sleep
    nlohmann::json result;           ///< of the answer if the device has done it
    sim::SimTime until_ns = 0;       ///< end of a sleep
    AlarmId alarm = 0;
    std::shared_ptr<std::atomic<Outcome>> outcome;
  };
  using Number = std::uint64_t;

  /// Registers a waiting request; the answer may be sent before this returns.
  void add_pending(PendingRequest pending, Alarm alarm);
  void on_alarm(Number number);
  /// Sends the answer and removes the entry. @return the next entry.
  std::map<Number, PendingRequest>::iterator end(std::map<Number, PendingRequest>::iterator pending,
                                                 std::string_view status,
                                                 const nlohmann::json& result);

  Hub& hub_;
  std::shared_ptr<Postbox> postbox_;
  std::vector<MorseComponent> components_;
  std::shared_ptr<EventClient> client_;  ///< created on first use
  std::map<Number, PendingRequest> pending_;
  Number last_number_ = 0;
  std::set<std::string> verbose_;
  std::map<std::string, Eigen::Isometry3d> targets_;
  bool synchronised_ = false;
  std::unique_ptr<MorseStreams> streams_;
};

/// A client's connection to the services.
class MorseConnection final : public Handler {
 public:
  MorseConnection(Peer& peer, Hub& hub);
  ~MorseConnection() override;

  void on_message(std::string_view line) override;
  [[nodiscard]] std::string farewell(const protocol::ProtocolError& error) override;

  [[nodiscard]] Peer& peer() noexcept { return peer_; }
  /// Its commands. Real robots stop at its end.
  [[nodiscard]] Commander& commander() noexcept { return commander_; }
  [[nodiscard]] const Rights& rights() const noexcept { return rights_; }
  /// Adds a token, which may add rights.
  void present(std::string token);

  /// Has the server's worker thread execute a request about the canvas, then answers it. Reading
  /// from the connection pauses until then. @param list  its arguments.
  void work(const std::string& id, const MorseService& service, const nlohmann::json& list);

  /// Sends an answer. @param result  null: none.
  void answer(const std::string& id, std::string_view status, const nlohmann::json& result);

 private:
  void execute(const std::string& id, std::string_view component, std::string_view service,
               std::string_view arguments);
  /// Runs an action for a request; answers its exceptions.
  template <typename Action>
  void guarded(const std::string& id, Action action);
  /// Runs an action that presents tokens: at once if all tokens are known, after a growing delay if
  /// not, and never after too many wrong tokens.
  void try_tokens(const std::string& id, const std::vector<std::string>& tokens,
                  std::function<void()> action);
  void playpen(const std::string& id, std::string_view service, const nlohmann::json& arguments);

  Peer& peer_;
  Hub& hub_;
  std::shared_ptr<MorseState> state_;
  std::shared_ptr<MorseConnection*> self_;  ///< expires with the connection; jobs check it
  Commander commander_;
  std::vector<std::string> tokens_;
  Rights rights_;
  int wrong_tokens_ = 0;
};

}  // namespace playerlike::server
