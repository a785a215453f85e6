// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "playerlike/host/event_client.h"
#include "playerlike/host/host_state.h"
#include "playerlike/host/run_settings.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

class TurnClock;

/// Runs a simulation for clients, in lockstep or paced (DESIGN section 3).
///
/// Lockstep: the host starts no thread; the last thread that begins to wait steps the world. Paced:
/// one thread of the host steps the world against the wall clock. All members may be called from
/// any thread.
class Host : public std::enable_shared_from_this<Host> {
 public:
  /// @throws sim::ConfigError if the world is invalid; std::runtime_error if the output folder
  ///         cannot be created.
  [[nodiscard]] static std::shared_ptr<Host> create(sim::WorldDescription world,
                                                    RunSettings settings = {},
                                                    sim::LogHook log = {});
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Opens a session on a robot's Player port or on port 4000.
  /// @throws SessionError kNoSuchDevice if no robot has that port; the message lists the ports.
  [[nodiscard]] std::unique_ptr<Session> connect(int port);

  /// Whether there were clients and all have left. Onlookers do not count.
  [[nodiscard]] bool is_abandoned() const;

  /// @name For servers and other event loops
  ///
  /// In lockstep, the event loop must call advance() to step a simulation with such clients.
  /// @{

  /// Opens a session like connect(), for a client without its own thread.
  /// @param notify    called at the end of a wait, by the thread that steps, with the simulation
  ///                  locked. It must only forward the notification.
  /// @throws SessionError for the same errors as connect().
  [[nodiscard]] std::unique_ptr<EventClient> connect_events(
      int port, std::function<void()> notify, EventRole role = EventRole::kParticipant,
      const CreationOrder& order = {});

  /// Lockstep: steps the simulation while all participants wait, for at most about this wall time.
  /// @return whether stepping could continue immediately; the caller should then call again soon.
  bool advance(std::chrono::microseconds slice);
  /// Lockstep: finds clients that have been silent for longer than RunSettings::silence_limit_s,
  /// and no longer waits for them. Call it periodically.
  void check_silence();

  /// For a program in this process, in lockstep: enables a warning for a program that has
  /// subscribed to a device or commanded one, but uses RunSettings::silence_limit_s of processor
  /// time without letting simulated time advance.
  void watch_program();
  /// Notes that the program ends with this exit status. If the status is 0 and simulated time never
  /// advanced, a warning is printed.
  void note_program_ends(int status);
  /// Notes for the report that a signal has requested the end of the run. The caller must call
  /// finish() afterwards. Does not wait for the simulation.
  void note_end_request(int signal) noexcept;
  /// Takes the writing of the results away from the host, unless it has begun. Does not wait for
  /// the simulation.
  /// @return whether the host will write none. The caller then completes them, see
  ///         complete_results(), although the host still exists.
  [[nodiscard]] bool take_over_results() noexcept;

  /// Notes for the report that an onlooker has commanded a robot or changed the world, so that the
  /// run depends on the wall clock.
  void note_onlooker_acts() noexcept;

  /// Notes for the report a reason why another run may differ, which a program at a server tells
  /// about itself. Of many reasons only the first ones are kept.
  void note_unrepeatable(const std::string& reason);

  /// Notes that a thread no longer takes part; see EventClient.
  void thread_ended(ThreadId thread_id) noexcept;

  /// Sets an alarm. If it is already due or the run is over, it is notified before this function
  /// returns.
  AlarmId set_alarm(Alarm alarm);
  /// Removes an alarm.
  /// @return whether it was still set. If not, it has been notified or is being notified.
  bool cancel_alarm(AlarmId alarm);

  /// Looks at the simulation between two steps, for what no request tells.
  /// @param look  a function of `const sim::Simulation&`. It must not call the host.
  /// @return its result, as a value.
  template <typename Look>
  auto with_simulation(const Look& look) const {
    using Result = std::decay_t<std::invoke_result_t<const Look&, const sim::Simulation&>>;
    if constexpr (std::is_void_v<Result>) {
      look_at_simulation(look);
    } else {
      std::optional<Result> result;
      look_at_simulation([&](const sim::Simulation& all) { result.emplace(look(all)); });
      return *std::move(result);
    }
  }

  /// Changes the simulation between two steps, beside the clients' commands and without their
  /// permissions: for tests. The clients' pending drawings are executed first.
  /// @param act  must not call the host.
  void change_simulation(const std::function<void(sim::Simulation&)>& act);
  /// Sets what is called after each step, with the simulation locked; it replaces the earlier
  /// function, and an empty one ends the calls. It must not call the host.
  void watch_steps(std::function<void(const sim::Simulation&)> watch);
  /// The state between two steps, for RunSettings::start of other hosts. The clients' pending
  /// drawings are executed first, their pending commands become part of the state.
  [[nodiscard]] HostState save();

  /// The newest reading of a sensor: as its subscribers get it, so of the real robot if the device
  /// mirrors one. @return null before the first.
  [[nodiscard]] sim::SharedReading newest_reading(DeviceId sensor) const;
  /// The number of its readings up to now. Needs no lock, so the condition of an alarm may call.
  [[nodiscard]] std::uint64_t count_of_readings(DeviceId sensor) const noexcept;

  /// Limits the number of further steps, for clock synchronisation; nullopt (initially): no limit.
  /// With a limit, lockstep time also advances while no client takes part.
  void set_step_credit(std::optional<std::uint64_t> steps);
  /// Adds this number of steps to the limit, if there is one.
  void add_step_credit(std::uint64_t steps);

  /// Sets the simulated seconds per wall second, from now on; > 0.
  /// @return nullopt on success, otherwise the reason: a lockstep simulation has no time factor.
  std::optional<std::string> set_time_factor(double factor);

  /// The world's robots and devices, as in Session::robots(); constant.
  [[nodiscard]] const std::vector<RobotInfo>& robots() const noexcept;
  /// Whether clients may read only their own robots' sensors; see sim::SimulationDescription. A
  /// server enforces this for its clients. Thread-safe.
  [[nodiscard]] bool own_sensors_only() const noexcept;
  /// @}

  /// Ends the run: stops the clock and writes report and pictures (once). Sessions then report
  /// kFinished. Called at the end of the duration, by the destructor, and at the end of the
  /// program.
  void finish() noexcept;
  [[nodiscard]] bool finished() const;

  [[nodiscard]] TimeStatistics time() const;
  /// Current simulated time. Cheap, and needs no lock.
  [[nodiscard]] sim::SimTime now_ns() const noexcept;
  /// Statistics of a robot up to now.
  /// @param robot  index of the robot in the world; it must exist.
  [[nodiscard]] sim::RobotStatistics statistics(int robot) const;

  /// Clock for the program's threads in virtual time; see virtual_time::attach(). It keeps the host
  /// alive.
  [[nodiscard]] std::shared_ptr<TurnClock> clock();

  /// Hash of the simulation's state, see sim::Simulation::state_hash.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  friend class InProcessSession;
  friend class EventClient;
  friend class Commander;
  friend class InsideCore;
  class Core;
  explicit Host(std::unique_ptr<Core> core);
  /// @throws SessionError kNoSuchDevice.
  void require_port(int port) const;
  void look_at_simulation(const std::function<void(const sim::Simulation&)>& look) const;
  std::unique_ptr<Core> core_;
};

}  // namespace playerlike
