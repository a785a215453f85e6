// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/mirror/mirror.h"
#include "host/requests/blackboard.h"
#include "host/requests/permissions.h"
#include "host/requests/saved_states.h"
#include "host/results/client_files.h"
#include "host/results/results.h"
#include "host/stepping/alarms.h"
#include "host/stepping/clients.h"
#include "host/stepping/inputs.h"
#include "host/stepping/lockstep.h"
#include "host/stepping/pace.h"
#include "host/stepping/progress.h"
#include "host/stepping/stalled_time_warning.h"
#include "playerlike/host/event_client.h"
#include "playerlike/host/host.h"
#include "virtual_time/turns.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

/// The implementation of Host: one mutex and the state that it guards. docs/architecture.md
/// describes the rules of time.
///
/// The members below divide the work of a run. This class waits and steps: it owns the mutex, the
/// threads and the order of actions. Each client has its own mutex for commands and its own queue
/// for drawings, so senders do not wait for a step.
class Host::Core {
 public:
  using Lock = std::unique_lock<std::mutex>;
  class VirtualClock;
  class Window;
  class Page;

  Core(sim::WorldDescription world, RunSettings settings, sim::LogHook log);
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;
  ~Core();

  /// Connects the run to its window, if the settings name one, and starts the pacer of a paced run.
  void start();
  /// Ends the run and its threads. The mutex must not be held.
  void stop() noexcept;

  std::shared_ptr<Client> add_client(int port, EventRole role = EventRole::kParticipant,
                                     std::function<void()> notify = {},
                                     const CreationOrder& order = {});
  /// @param abandoned  see EventClient::abandon().
  void remove_client(Client& client, bool abandoned = false) noexcept;
  void thread_ended(ThreadId thread_id) noexcept;
  void join(Client& client, ThreadId thread_id);

  /// Answers a client's request; see requests.cpp.
  Answer answer(Client& client, const Request& request);
  void send(Client& client, DeviceId device, const sim::Command& command);

  // See Commander.
  std::optional<std::string> command(Commanders::Who who, DeviceId device,
                                     const sim::Command& command);
  void commander_gone(Commanders::Who who) noexcept;

  void wait(Client& client);
  int take(Client& client, ReadingSink& sink);
  bool peek(Client& client, std::chrono::milliseconds timeout);
  void sleep(Client& client, double seconds);

  // The counterparts for event clients, see EventClient and Host.
  EventClient::Outcome begin_wait(Client& client, ThreadId thread_id);
  EventClient::Outcome begin_peek(Client& client, ThreadId thread_id,
                                  std::chrono::milliseconds timeout);
  EventClient::Outcome begin_sleep(Client& client, ThreadId thread_id, double seconds);
  EventClient::Outcome begin_turns_wait(Client& client, ThreadId thread_id,
                                        const EventClient::TurnsWait& what);
  EventClient::Outcome outcome_of(const Client& client) const;
  void cancel_wait(Client& client);
  bool advance_for(std::chrono::microseconds slice);
  void check_silence();
  AlarmId set_alarm(Alarm alarm);
  /// Calls action() with the mutex held.
  template <typename Action>
  auto locked(Action action) const {
    const Lock lock = lock_with_priority();
    return action();
  }
  void change_step_limit(const std::function<void(Pace&)>& change);
  std::optional<std::string> set_time_factor(double factor);
  void note_program_ends(int status);

  /// Applies the client's pending drawings, then calls action(layers, registry); all under the
  /// mutex.
  template <typename Action>
  auto with_layers(Client& client, Action action) {
    const Lock lock = lock_with_priority();
    client.require_open();
    inputs_.apply_drawings(client);
    return action(simulation_.layers(), inputs_.registry);
  }
  // In canvas_work.cpp: work that takes long on a large canvas. It is done in pieces, between which
  // other threads can lock the mutex.
  /// See EventClient::draw_some().
  bool draw_some(Client& client, DrawWork& work, std::size_t cells);
  /// All cells of a layer.
  std::vector<sim::CellValue> cells(Client& client, sim::LayerId layer);
  /// The picture of one layer, or of all, with size and position of the canvas at that time.
  std::vector<std::uint8_t> picture(Client& client, std::optional<sim::LayerId> layer,
                                    sim::CanvasDescription& canvas);
  sim::LayerId create_layer(Client& client, const CreateLayerRequest& what);
  void remove_layer(Client& client, sim::LayerId layer);
  void resize_canvas(Client& client, int width, int height);

  void finish() noexcept;
  [[nodiscard]] bool own_sensors_only() const noexcept {
    return simulation_.world().simulation.own_sensors_only;  // constant
  }
  const std::vector<RobotInfo>& robots() const noexcept { return robots_; }
  std::uint64_t canvas_generation() const noexcept {
    return canvas_generation_.load(std::memory_order_acquire);
  }
  /// This simulation as the clock of Turns.
  [[nodiscard]] TurnClock& clock() noexcept;

 private:
  friend class Host;
  struct RequestHandler;

  /// Locks the mutex for a short call; a thread that steps the simulation lets it in first.
  [[nodiscard]] Lock lock_with_priority() const;
  /// Locks the mutex for a call that steps the simulation; callers with priority go first.
  [[nodiscard]] Lock lock_for_stepping() const;
  /// Releases the mutex until all callers with priority have had it.
  void give_way(Lock& lock) const;
  void yield_to_priority_waiters() const;
  void adopt(Client& client, ThreadId thread_id);
  [[nodiscard]] bool is_abandoned() const { return had_client_ && !clients_.any_but_onlookers(); }
  /// Whether no further step is made.
  [[nodiscard]] bool stands_still() const { return ended_ || simulation_.finished(); }
  /// Whether the run is over and its results are written, so that waits end.
  [[nodiscard]] bool over() const { return stands_still() && !writing_; }
  [[nodiscard]] bool paced() const { return pace_.by_wall_clock(); }
  [[nodiscard]] bool in_turns() const noexcept {
    return turns_ && !paced() && Turns::instance().active();
  }
  /// Simulated time; the mutex is not needed.
  [[nodiscard]] sim::SimTime now_ns() const noexcept {
    return now_ns_.load(std::memory_order_acquire);
  }

  void subscribe(Client& client, DeviceId device);
  void unsubscribe(Client& client, DeviceId device);
  Charge take_charge(Client& client, const TakeChargeRequest& what);
  /// Stops robots whose watchdog has heard nothing for too long.
  void stop_unwatched(WallClock::time_point now);
  /// Throws SessionError kNotAvailable if the world hides something from this client.
  /// @param robot  whose sensors to read; -1: data of no robot, such as objects and the map.
  void require_readable(const Client& client, int robot) const;
  /// Throws SessionError kNotAvailable, and notes it for the report, if the run's task forbids
  /// something.
  /// @param what  as returned by a function of Permissions. @pre The mutex is held.
  void require_permission(const std::optional<std::string>& what);
  /// Notes for the report that the run's task forbids something. @return the message.
  std::string note_forbidden(const std::string& what);
  void count_data_reads(Client& client, int count, bool has_data);
  void check_stalled_time(Client& client);
  void set_busy_alarm();
  /// Whether limits of the wall clock count no time under a debugger. A program that is graded
  /// could be its own debugger.
  [[nodiscard]] bool excuses_debuggers() const { return settings_.grading.nonce.empty(); }
  /// Whether the client's process, or this one, is under a debugger now.
  [[nodiscard]] static bool is_debugged(Client& client);
  /// See Host::watch_program().
  void watch_program();
  /// Tells the user of a program that runs without `playpen run` that its run has no end.
  void tell_of_endless_run(WallClock::time_point now);
  void prefer_real_time(const std::string& reason);
  /// Makes the stop of the settings, after a step.
  void make_stop();

  /// Waits until the client has data (if wants_data), until simulated time wake_ns (if set) or
  /// until the end of the run.
  void wait_until(Lock& lock, Client& client, bool wants_data, std::optional<sim::SimTime> wake_ns);
  /// Whether the client's wait is over.
  [[nodiscard]] bool wait_is_over(const Client& client) const { return over() || is_due(client); }
  /// Whether it is over, also if the run is not.
  [[nodiscard]] bool is_due(const Client& client) const;
  [[nodiscard]] bool program_takes_part() const;
  /// Whether lockstep time may advance by a step now.
  /// @param all_known_waiting  the caller knows that all clients wait.
  [[nodiscard]] bool may_advance(bool all_known_waiting = false);
  void wait_for_others(Lock& lock, const Client& client);
  /// Whether the next step of a lockstep run has to wait, because people watch; see
  /// Pace::is_too_early().
  [[nodiscard]] bool is_too_early();
  /// Waits until the next step is due, or for something else.
  void wait_for_next_step(Lock& lock);
  [[nodiscard]] EventClient::Outcome outcome(const Client& client) const;
  EventClient::Outcome begin(Client& client, ThreadId thread_id, bool wants_data,
                             std::optional<sim::SimTime> wake_ns);
  /// The same, for a client that takes part already.
  EventClient::Outcome begin_adopted(Client& client, bool wants_data,
                                     std::optional<sim::SimTime> wake_ns);
  /// The end of a peek that begins now in lockstep.
  [[nodiscard]] sim::SimTime end_of_peek(std::chrono::milliseconds timeout) const;

  /// The thread for which a client's changes of the blackboard wait until the next step; 0: they
  /// take effect at once. They wait if threads compute side by side between two steps.
  [[nodiscard]] ThreadId blackboard_thread(const Client& client) const;
  /// Lets the waiting changes of the blackboard take effect, in the order of the clients.
  void publish_blackboard();

  /// Makes a step. @return the result of release_waiters().
  /// @param lock  on the mutex; unlocked now and then while the results of the run are written.
  bool advance(Lock& lock);
  /// Lets clients know of connections to real robots that were lost in this step.
  void note_losses();
  /// Ends the waits that are over. @return whether a client may have stopped waiting.
  bool release_waiters();
  /// Ends the run and writes its results. Then the waits are over.
  void end_run(Lock& lock);
  /// The same, by a thread of its own; until it is done, the run has not ended for its clients.
  void end_run_elsewhere();
  void write_results(Lock& lock);
  /// Tells the client that a real robot is lost, if it does not know yet. @throws SessionError.
  void tell_of_loss(Client& client);
  [[nodiscard]] TimeStatistics time_locked() const;
  /// Reasons why another run may differ.
  [[nodiscard]] std::vector<std::string> unrepeatable() const;

  void start_pacing(const std::string& warning);
  void pace();
  /// Blocks the pacer while the user has paused the run.
  void wait_while_paused(Lock& lock);

  template <typename Copy>
  sim::CanvasDescription copy_in_pieces(Client& client, const Copy& copy);
  /// Copies all layers in pieces, between which the mutex is unlocked. At the return it is locked,
  /// and the copy equals the layers.
  /// @param may_unlock  false: in one piece.
  void copy_layers(Lock& lock, sim::LayerCopy& copy, bool may_unlock = true);
  /// Throws SessionError kFinished while the results are written.
  void require_not_writing() const;

  const RunSettings settings_;
  const sim::LogHook log_;
  const Warn warn_;
  sim::Simulation simulation_;
  const std::vector<RobotInfo> robots_;
  const Permissions permissions_;
  const sim::SimTime step_ns_;
  const bool turns_;  ///< virtual time: threads take turns in a fixed order
  mutable std::mutex own_mutex_;
  std::mutex& mutex_;                             ///< its own, or that of Turns
  mutable std::atomic<int> priority_waiters_{0};  ///< threads in lock_with_priority()
  std::condition_variable changed_;
  std::atomic<sim::SimTime> now_ns_{
      simulation_.now_ns()};  ///< the simulation's time; needs no mutex
  std::atomic<std::uint64_t> canvas_generation_{0};
  ClientFiles client_files_;
  SavedStates saved_states_;
  Blackboard blackboard_;
  std::unique_ptr<Mirror> mirror_;  ///< null: the world has no real robots

  Clients clients_;
  Lockstep lockstep_;
  Pace pace_;
  Inputs inputs_;
  Alarms alarms_;
  StalledTimeWarning stalled_time_warning_;
  Progress progress_{simulation_.now_ns()};
  Results results_;
  std::unique_ptr<VirtualClock> clock_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<Page> page_;
  std::thread pacer_;
  std::thread ender_;      ///< see end_run_elsewhere()
  std::mutex copy_mutex_;  ///< for copies in pieces, one at a time; locked before the mutex

  std::optional<sim::SimTime> stop_ns_;  ///< when the stop of the settings is due, until then
  std::function<void(const sim::Simulation&)> step_watch_;  ///< see Host::watch_steps()
  bool watches_program_ = false;  ///< the program in whose process this is
  bool tells_of_endless_run_ = false;
  bool had_client_ = false;
  bool mode_chosen_ = false;  ///< the world or a setting has set the time mode
  bool stop_pacing_ = false;
  bool ended_ = false;
  bool writing_ = false;         ///< the run has ended, and its results are being written
  bool ends_elsewhere_ = false;  ///< the thread that makes the last step does not write the results
  bool ended_by_program_ = false;
  bool end_reported_ = false;  ///< a session has thrown because the run is over
  int reads_after_end_ = 0;
  /// When the server calls check_silence() again; nullopt: it has not called it yet.
  std::optional<WallClock::time_point> silence_check_due_;
  std::vector<std::string> told_unrepeatable_;  ///< see Host::note_unrepeatable()
  bool driven_by_hand_ = false;                 ///< a user has driven a robot
  bool acted_on_page_ = false;                  ///< a user has moved robots or blocks on the page
  std::atomic<bool> onlooker_acted_{false};     ///< see Host::note_onlooker_acts()
};

/// A program's thread inside of the host: its clocks and locks are real during the call.
class InsideCore {
 public:
  explicit InsideCore(Host::Core& core) noexcept : core_(core) {}
  Host::Core* operator->() const noexcept { return &core_; }

 private:
  virtual_time::Inside inside_;
  Host::Core& core_;
};

}  // namespace playerlike
