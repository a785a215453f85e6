// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/process/thread_id.h"
#include "sim/core/time.h"

namespace playerlike {

/// A thread of the program in virtual time. The mutex of Turns guards it, except for `event_count`.
struct TurnThread {
  enum class State {
    kRunning,     ///< has the turn and runs
    kConcurrent,  ///< runs concurrently with that one: it is new, or its client was closed
    kReady,       ///< its wait is over; it runs when it gets its turn
    kWaits,
    kDetached,  ///< runs on its own: nobody waits for it until it waits again
  };
  /// The reason why a wait ended.
  enum class Wake { kNone, kObjectReady, kTime, kInterrupted };

  explicit TurnThread(ThreadId id) : thread_id(id) {}

  const ThreadId thread_id;
  pid_t number = 0;              ///< the system's thread id; 0: not begun yet
  const void* handle = nullptr;  ///< its pthread_t
  State state = State::kReady;
  /// Order among ready threads and among threads that wait for one object: lowest first.
  std::uint64_t queue_order = 0;
  bool starts_background = false;  ///< it has called StartThread()

  // What it waits for; any of these ends the wait.
  const void* object = nullptr;                      ///< a wake-up for this object
  int (*is_ready)(const void*, unsigned) = nullptr;  ///< if set, checked before time advances
  unsigned value = 0;                                ///< argument of is_ready
  const void* client = nullptr;                      ///< data for this client, or ...
  /// ... this time: simulated time, or time since the program's start if there is no simulation.
  std::optional<sim::SimTime> wake_ns;
  bool takes_mutex = false;    ///< the object is a mutex, to be locked in its turn
  bool counted = false;        ///< included in the number of waits for objects
  bool interruptible = false;  ///< signals end the wait
  Wake wake = Wake::kNone;

  // For the rules of the wall clock.
  std::chrono::steady_clock::time_point seen{};  ///< when it last began to run
  std::uint64_t blocked_switches = 0;  ///< context switches at the first check that found it asleep
  std::optional<std::chrono::steady_clock::time_point> blocked_since;  ///< time of that check
  std::chrono::steady_clock::time_point blocked_last{};                ///< time of the latest check
  int blocked_checks = 0;                                              ///< checks since then

  std::atomic<unsigned> event_count{0};  ///< counts events for this thread; a futex

  [[nodiscard]] bool waits_for_time() const noexcept {
    return client != nullptr || wake_ns.has_value();
  }
};

/// The simulation whose time the threads wait for. The mutex of Turns is held during calls unless
/// stated otherwise.
class TurnClock {
 public:
  TurnClock() = default;
  TurnClock(const TurnClock&) = delete;
  TurnClock& operator=(const TurnClock&) = delete;
  virtual ~TurnClock() = default;

  /// Called when no thread runs or is ready. Advances time by a step, if possible, and makes the
  /// threads ready whose wait is over. @return whether time has advanced.
  virtual bool step(std::unique_lock<std::mutex>& lock) = 0;
  /// Whether step() may wait in the system, for a server: signals are held meanwhile. May return
  /// false after some milliseconds, and is called again.
  [[nodiscard]] virtual bool step_waits() const noexcept { return false; }
  /// Whether simulated time has reached a wake-up time.
  [[nodiscard]] virtual bool has_come(sim::SimTime wake_ns) const = 0;
  /// Checks for clients that have been silent for too long.
  virtual void check_silent_clients() = 0;
  /// When a thread last sent something, or began to run if that is later.
  [[nodiscard]] virtual std::chrono::steady_clock::time_point last_seen(
      const TurnThread& thread) const = 0;
  /// A thread has been silent for too long (on_silent) or was blocked (on_blocked). on_blocked()
  /// returns whether time follows the wall clock now.
  virtual void on_silent(const TurnThread& thread) = 0;
  virtual bool on_blocked(const TurnThread& thread) = 0;

  // Without the mutex:

  /// Simulated time, and the duration of a step.
  [[nodiscard]] virtual sim::SimTime now_ns() const noexcept = 0;
  [[nodiscard]] virtual sim::SimTime step_ns() const noexcept = 0;
  /// The program's threads wait for this simulation's time from now on, ...
  /// @param before_ns  virtual time at its beginning, since the program's start.
  virtual void begin_turns(sim::SimTime before_ns) = 0;
  /// ... and no longer.
  virtual void end_turns(sim::SimTime before_ns) = 0;
  /// Advances simulated time for the calling thread until the last step at or before `target_ns`.
  /// @param asleep  whether the thread sleeps; otherwise time passes because it has done something
  /// else for long, such as looking at data.
  /// @param interrupted  receives whether a signal ended the wait.
  /// @return the remaining time up to the target; nullopt if the thread must sleep in real time.
  virtual std::optional<sim::SimTime> pass_time(sim::SimTime target_ns, bool asleep,
                                                bool& interrupted) = 0;

  // With the mutex held:

  /// Called after a timed wait. After the run's end such waits are slowed down and finally ended,
  /// like sleeps, since a program may repeat them forever.
  /// @param left_ns  time from the present simulated time to the deadline.
  virtual void note_timed_wait(std::unique_lock<std::mutex>& lock, sim::SimTime left_ns) = 0;
  /// How long a thread may run before the others stop waiting for it.
  [[nodiscard]] virtual std::chrono::steady_clock::duration silence_limit() const = 0;
  /// Whether that limit counts no time under a debugger.
  [[nodiscard]] virtual bool excuses_debuggers() const { return true; }
};

/// Scheduler of virtual time: the program's threads run one at a time in a fixed order, so that
/// every run is the same (docs/virtual_time.md). A thread runs until it waits for simulated time,
/// for data or for another thread. Ready threads run in the order in which they became ready. When
/// no thread is ready, simulated time advances.
///
/// There is one object per process. It outlives all static objects.
class Turns {
 public:
  using Lock = std::unique_lock<std::mutex>;
  using State = TurnThread::State;
  using Wake = TurnThread::Wake;

  static Turns& instance();

  /// Guards this object and the simulation that is its clock.
  [[nodiscard]] std::mutex& mutex() noexcept { return mutex_; }
  /// False after release(). Changes with the mutex held.
  [[nodiscard]] bool active() const noexcept { return active_.load(std::memory_order_acquire); }
  /// Number of threads that wait for mutexes or are about to lock one after such a wait.
  [[nodiscard]] const std::atomic<int>& mutex_waits() const noexcept { return mutex_waits_; }
  /// Number of threads that wait for other objects.
  [[nodiscard]] const std::atomic<int>& object_waits() const noexcept { return object_waits_; }

  // With the mutex held:

  /// Starts virtual time and gives the turn to the calling thread, the program's first.
  void begin();
  /// Ends virtual time: all threads run at the same time from now on.
  void release();
  /// @param now_ns  present time of the new clock. @param before_ns  present time of the old one,
  ///                for converting the threads' wake-up times.
  void set_clock(TurnClock* clock, sim::SimTime before_ns, sim::SimTime now_ns);

  /// The calling thread's entry. An unknown thread is added; it runs concurrently with the others.
  TurnThread& self();
  /// The calling thread's entry, null if it is unknown.
  [[nodiscard]] static TurnThread* known_self() noexcept;
  /// The calling thread starts another one, which runs when it gets its turn.
  void add(ThreadId thread_id);
  /// @param handle  its pthread_t.
  void note_handle(ThreadId thread_id, const void* handle);
  /// The calling thread begins as this one. Returns when it gets its turn.
  void enter(Lock& lock, ThreadId thread_id);
  /// A thread has ended or could not be started.
  void remove(ThreadId thread_id);
  /// Whether a thread of the program with this pthread_t exists.
  [[nodiscard]] bool lives(const void* handle) const;
  /// Whether the thread with this system id waits, for its turn or for something else.
  [[nodiscard]] bool is_parked(pid_t number) const;
  /// Whether a thread that has waited for this mutex is about to lock it.
  [[nodiscard]] bool is_wanted(const void* mutex) const;

  /// Sets the object that the calling thread will wait for, so that no wake-up from now on is
  /// missed.
  void begin_wait(TurnThread& self, const void* object, bool takes_mutex);
  /// Waits until an object, data or a time ends the wait, and then for the turn.
  /// @param interruptible  signals end the wait.
  /// @return the reason; kNone: virtual time has ended, or the client was closed.
  Wake wait(Lock& lock, TurnThread& self, bool interruptible = false);
  /// Lets the ready threads run first. @return whether there were any.
  bool yield(Lock& lock, TurnThread& self);
  /// Wakes threads that wait for an object, in the order in which they began to wait. @return the
  /// number of threads woken.
  int wake(const void* object, int most);
  /// Wakes all threads that wait for an object, with a delay. For threads that must not wait for
  /// the mutex; called without it.
  void wake_later(const void* object);
  /// Ends a thread's wait in any state, or only an interruptible one (`by_signal`).
  void interrupt(const void* handle, bool by_signal);
  /// Ends a thread's wait; it runs when it gets its turn.
  void make_ready(TurnThread& thread, Wake wake);
  /// Lets the thread that waits for this client's data run at once, concurrently with the others.
  void resume_client_thread(const void* client);
  /// If no thread runs: gives the turn to a ready thread, or wakes one that steps the simulation.
  void schedule_next();

  /// Whether a thread waits for data or a time.
  [[nodiscard]] bool somebody_waits_for_time() const;
  [[nodiscard]] const std::vector<std::unique_ptr<TurnThread>>& threads() const noexcept {
    return threads_;
  }

  /// A rule of the wall clock was applied, so another run may differ. Any thread, without the
  /// mutex. @return whether the reason is new.
  bool note_unrepeatable(const std::string& why);
  [[nodiscard]] std::vector<std::string> unrepeatable() const;

 private:
  Turns() = default;

  /// Waits until the thread gets its turn or virtual time ends.
  void park(Lock& lock, TurnThread& self);
  TurnThread& insert(ThreadId thread_id, State state);
  [[nodiscard]] TurnThread* find(ThreadId thread_id) const;
  void move(TurnThread& thread, State state);
  static void notify(TurnThread& thread);
  [[nodiscard]] TurnThread* first_ready() const;
  void end_wait(TurnThread& thread);
  [[nodiscard]] bool has_come(sim::SimTime wake_ns) const;
  void note_signal(TurnThread& self);
  /// Calls the is_ready functions of waiting threads. @return whether a wait is over.
  bool poll_waits();
  /// Without a simulation: sleeps in real time until the earliest wake-up time. @return whether
  /// anything has changed.
  bool wait_real_time(Lock& lock, TurnThread& self);
  void flush_deferred_wakes();
  /// Checks for threads that are blocked or run for too long.
  void check_blocked_threads(Lock& lock);
  [[nodiscard]] std::chrono::steady_clock::duration silence_limit() const;
  [[nodiscard]] bool excuses_debuggers() const;
  /// All threads of the process were stopped for long, as at a breakpoint: the wall-clock limits
  /// begin anew.
  void forgive_standstill();

  std::mutex mutex_;
  std::atomic<bool> active_{false};
  std::vector<std::unique_ptr<TurnThread>> threads_;  ///< in the order of their start
  TurnThread* current_ = nullptr;                     ///< the thread that has the turn
  TurnClock* clock_ = nullptr;
  std::uint64_t last_queue_order_ = 0;
  int ready_ = 0;       ///< number of ready threads
  int concurrent_ = 0;  ///< number of concurrent threads
  std::atomic<int> mutex_waits_{0};
  std::atomic<int> object_waits_{0};

  /// Objects for wake_later(). If there are too many, all waiting threads are woken and check for
  /// themselves.
  std::array<std::atomic<const void*>, 16> deferred_{};
  std::atomic<bool> any_deferred_{false};
  std::atomic<bool> all_deferred_{false};

  mutable std::mutex reasons_mutex_;
  std::vector<std::string> reasons_;
};

}  // namespace playerlike
