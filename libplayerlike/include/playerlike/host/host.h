// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "playerlike/host/event_client.h"
#include "playerlike/host/run_settings.h"
#include "playerlike/session/session.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

class TurnClock;

/// Runs a simulation for clients, in lockstep or paced (DESIGN section 3).
///
/// Lockstep: no thread is started; the thread that waits last steps the world. Paced: one thread
/// of the host steps it against the wall clock. All members may be called from any thread.
class Host : public std::enable_shared_from_this<Host> {
 public:
  /// @throws sim::ConfigError if the world is not sound; std::runtime_error if the output folder
  ///         cannot be made.
  [[nodiscard]] static std::shared_ptr<Host> create(sim::WorldDescription world,
                                                    RunSettings settings = {},
                                                    sim::LogHook log = {});
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Opens a session on a robot's Player port or on port 4000.
  /// @throws SessionError kNoSuchDevice if no robot has that port; the message lists the ports.
  [[nodiscard]] std::unique_ptr<Session> connect(int port);

  /// @name For servers and other event loops
  ///
  /// In lockstep a simulation with such clients needs somebody to step it: advance().
  /// @{

  /// As connect(), for a client without a thread of its own.
  /// @param notify    called when a wait that was begun is over, with the simulation locked, by
  ///                  whichever thread steps: it must do no more than pass the news on.
  /// @param follower  see Session::open_follower().
  /// @throws SessionError as connect().
  [[nodiscard]] std::unique_ptr<EventClient> connect_events(int port, std::function<void()> notify,
                                                            bool follower = false);

  /// Lockstep: steps the simulation while all who take part wait, for about so long at most.
  /// @return whether it could go on at once: call again soon.
  bool advance(std::chrono::microseconds slice);
  /// Lockstep: looks for clients that have been silent for too long, see
  /// RunSettings::silence_limit_s, and no longer waits for them. To be called now and then.
  void check_silence();

  /// For the simulation of a program in this process, in lockstep: from now on the program is told,
  /// as a warning, when it has used RunSettings::silence_limit_s of processor time without letting
  /// any simulated time pass, though it has subscribed to a device or commanded one.
  void watch_program();
  /// That program ends with this exit status: it is told, as a warning, if it has let no simulated
  /// time pass. Not if the status is not 0, as it then knows of an error.
  void note_program_ends(int status);
  /// A signal has asked for the end of the run, for the report; finish() is to follow.
  void note_end_request(int signal);

  /// A thread takes no more part, see EventClient.
  void thread_ended(ThreadId thread_id) noexcept;

  /// Asks to be told of a moment; at once (before this returns) if it has come or the run is over.
  AlarmId set_alarm(Alarm alarm);
  /// Forgets an alarm. @return whether it was still set: else it is being, or has been, notified.
  bool cancel_alarm(AlarmId alarm);

  /// Does something with the simulation between two steps. `action` must not call the host.
  void with_simulation(const std::function<void(sim::Simulation&)>& action);

  /// Limits how many steps may still be made, for clock synchronisation; nullopt: no limit (at
  /// first). In lockstep time then goes on while no client takes part, too.
  void set_step_credit(std::optional<std::uint64_t> steps);
  /// Allows so many further steps, if there is a limit.
  void add_step_credit(std::uint64_t steps);

  /// Simulated seconds a wall second, from now on; > 0.
  /// @return nothing if done; else why not: in lockstep there is no such thing.
  std::optional<std::string> set_time_factor(double factor);

  /// The world's robots and devices, as sessions have them; constant.
  [[nodiscard]] const std::vector<RobotInfo>& robots() const noexcept;
  /// Whether clients read their own robots' sensors only, see sim::SimulationDescription; a server
  /// sees to that for its own. Thread-safe.
  [[nodiscard]] bool own_sensors_only() const noexcept;
  /// @}

  /// Ends the run: stops the clock, writes report and pictures (once). Sessions then report
  /// kFinished. Called at the end of the duration, by the destructor and at the program's end.
  void finish() noexcept;
  [[nodiscard]] bool finished() const;

  [[nodiscard]] TimeStatistics time() const;
  /// What a robot has been through so far. @param robot  its index in the world; it must exist.
  [[nodiscard]] sim::RobotStatistics statistics(int robot) const;

  /// What the threads of the program wait for in virtual time, see virtual_time::attach(). Keeps
  /// the host.
  [[nodiscard]] std::shared_ptr<TurnClock> clock();

  /// Hash of the simulation's state, see sim::Simulation::state_hash.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  friend class InProcessSession;
  friend class EventClient;
  friend class InsideCore;
  class Core;
  explicit Host(std::unique_ptr<Core> core);
  /// @throws SessionError kNoSuchDevice.
  void require_port(int port) const;
  std::unique_ptr<Core> core_;
};

}  // namespace playerlike
