// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
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

/// A request that cannot be executed: what MORSE's client is told after FAILED.
class MorseRefusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Passes tasks from whatever thread steps the simulation to the server's, as long as there is one.
class Postbox {
 public:
  explicit Postbox(Hub& hub) : hub_(&hub) {}
  /// From any thread. Does nothing once the box is closed.
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

/// What all of a server's connections in MORSE's protocol share: the components, the streams, and
/// the requests that are answered later. Used by the server's thread only.
class MorseState : public std::enable_shared_from_this<MorseState> {
 public:
  explicit MorseState(Hub& hub);
  ~MorseState();
  MorseState(const MorseState&) = delete;
  MorseState& operator=(const MorseState&) = delete;

  /// The hub's, made if there is none yet.
  static std::shared_ptr<MorseState> of(Hub& hub);

  [[nodiscard]] Hub& hub() noexcept { return hub_; }
  [[nodiscard]] Host& host() noexcept { return hub_.host(); }
  [[nodiscard]] const std::vector<MorseComponent>& components() const noexcept {
    return components_;
  }
  /// @return null if there is none of that name.
  [[nodiscard]] const MorseComponent* find(std::string_view name) const noexcept;
  [[nodiscard]] MorseStreams& streams() noexcept { return *streams_; }
  /// All robots', for what concerns the canvas. Takes no part in the lockstep.
  [[nodiscard]] Session& session() { return client()->session(); }
  [[nodiscard]] const std::shared_ptr<EventClient>& client();

  /// Does something with the simulation, and gives back what that gives.
  template <typename Action>
  auto with(Action action) {
    std::optional<decltype(action(std::declval<sim::Simulation&>()))> result;
    host().with_simulation(
        [&](sim::Simulation& simulation) { result.emplace(action(simulation)); });
    return std::move(*result);
  }
  /// Gives a device a command, at once.
  /// @throws MorseRefusal saying why not: the run is over, or what the device says.
  void command(DeviceId device, const sim::Command& command);

  /// @name Requests that are answered later
  /// @{

  /// Answers when so much simulated time has passed.
  void answer_after(MorseConnection& from, const std::string& id, double seconds);
  /// Sends a waypoint device to a goal, and answers when the robot has arrived. A request that
  /// waits for the same device is answered with PREEMPTED.
  /// @throws MorseRefusal as command().
  void answer_on_arrival(MorseConnection& from, const std::string& id, DeviceId waypoint,
                         const sim::GotoCommand& goal);
  /// Answers the connection's requests of that id with PREEMPTED; a goto stops its robot.
  void cancel(MorseConnection& from, const std::string& id);
  /// The connection has ended: what it waits for goes on, but nobody is answered.
  void forget(MorseConnection& from);
  /// Requests of a connection that have no answer yet.
  [[nodiscard]] std::size_t waiting(const MorseConnection& from) const noexcept;
  /// @}

  /// @name How much is told of the requests to a component: MORSE's set_log_level
  /// @{
  void set_verbose(const std::string& component, bool verbose);
  [[nodiscard]] bool verbose(const std::string& component) const {
    return verbose_.contains(component);
  }
  /// @}

  /// @name Whether a client of the clock synchronisation allows each step
  /// @{
  void set_synchronised(bool synchronised);
  [[nodiscard]] bool synchronised() const noexcept { return synchronised_; }
  /// @}

  [[nodiscard]] const std::shared_ptr<Postbox>& postbox() const noexcept { return postbox_; }

 private:
  /// How a request that waits has come out, as the alarm finds it.
  enum class Outcome { kNone, kArrived, kReplaced };
  struct Pending {
    MorseConnection* from = nullptr;
    std::string id;
    std::optional<DeviceId> waypoint;
    sim::SimTime until_ns = 0;  ///< of a sleep
    AlarmId alarm = 0;
    std::shared_ptr<std::atomic<Outcome>> outcome;
  };
  using Number = std::uint64_t;

  /// Starts waiting; the answer may be given before this returns.
  void wait_for(Pending pending, Alarm alarm);
  void ring(Number number);
  /// Answers and forgets. @return the entry after it.
  std::map<Number, Pending>::iterator end(std::map<Number, Pending>::iterator pending,
                                          std::string_view status, const nlohmann::json& result);

  Hub& hub_;
  std::shared_ptr<Postbox> postbox_;
  std::vector<MorseComponent> components_;
  std::shared_ptr<EventClient> client_;  ///< made when it is first needed
  std::map<Number, Pending> pending_;
  Number last_number_ = 0;
  std::set<std::string> verbose_;
  bool synchronised_ = false;
  std::unique_ptr<MorseStreams> streams_;
};

/// One client's connection to the services.
class MorseConnection final : public Handler {
 public:
  MorseConnection(Peer& peer, Hub& hub);
  ~MorseConnection() override;

  void on_message(std::string_view line) override;
  [[nodiscard]] std::string farewell(const protocol::ProtocolError& error) override;

  [[nodiscard]] Peer& peer() noexcept { return peer_; }
  [[nodiscard]] const Rights& rights() const noexcept { return rights_; }
  /// Adds a token, which may give more rights.
  void present(std::string token);

  /// Has the server's workshop execute a request about the canvas, and answers it then. Nothing
  /// more is read from the connection before. @param list  its arguments.
  void work(const std::string& id, const MorseService& service, const nlohmann::json& list);

  /// Sends an answer. @param result  null: none.
  void answer(const std::string& id, std::string_view status, const nlohmann::json& result);

 private:
  void execute(const std::string& id, std::string_view component, std::string_view service,
               std::string_view arguments);
  /// Does something for a request; what that throws is answered.
  template <typename Action>
  void guarded(const std::string& id, Action action);
  /// Does what presents tokens: at once if all are known; later and later if not, and not at all
  /// if too many were wrong.
  void try_tokens(const std::string& id, const std::vector<std::string>& tokens,
                  std::function<void()> action);
  void playpen(const std::string& id, std::string_view service, const nlohmann::json& arguments);

  Peer& peer_;
  Hub& hub_;
  std::shared_ptr<MorseState> state_;
  std::shared_ptr<MorseConnection*> self_;  ///< outlived by what the workshop does for it
  std::vector<std::string> tokens_;
  Rights rights_;
  int wrong_tokens_ = 0;
};

}  // namespace playerlike::server
