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

/// A thread of the program in virtual time. Guarded by the mutex of Turns, but for the bell.
struct TurnThread {
  enum class State {
    kThinks,  ///< it is its turn
    kBeside,  ///< thinks beside that one: it has only come, or its client was closed
    kReady,   ///< what it waited for is there: it goes on in its turn
    kWaits,
    kAside,  ///< goes its own way: nobody waits for it until it waits again
  };
  /// What ended a wait.
  enum class Wake { kNone, kThere, kTime, kInterrupted };

  explicit TurnThread(ThreadId id) : thread_id(id) {}

  const ThreadId thread_id;
  pid_t number = 0;              ///< the system's; 0: it has not begun yet
  const void* handle = nullptr;  ///< its pthread_t
  State state = State::kReady;
  std::uint64_t place =
      0;  ///< of those that are ready, or wait for the same: the least comes first
  bool starts_background = false;  ///< it has called StartThread()

  // What it waits for: any of these.
  const void* object = nullptr;  ///< until somebody wakes one who waits for that
  int (*is_there)(const void*, unsigned) = nullptr;  ///< asked before time goes on, if set
  unsigned value = 0;                                ///< for is_there
  const void* client = nullptr;                      ///< this client's data, or ...
  /// ... this moment: simulated time, or without a simulation time since the program's start.
  std::optional<sim::SimTime> wake_ns;
  bool takes_mutex = false;    ///< the object is a mutex, which it takes when it is its turn
  bool counted = false;        ///< among those who wait for an object
  bool interruptible = false;  ///< signals end it
  Wake wake = Wake::kNone;

  // For the rules of the wall clock.
  std::chrono::steady_clock::time_point seen{};  ///< when it last began to think
  std::uint64_t blocked_switches = 0;  ///< when it was first seen asleep, thinking, and ...
  std::optional<std::chrono::steady_clock::time_point> blocked_since;  ///< ... since when it is
  std::chrono::steady_clock::time_point blocked_last{};                ///< when it last was
  int blocked_looks = 0;                                               ///< how often since then

  std::atomic<unsigned> bell{0};  ///< counts what it is to look at; a futex

  [[nodiscard]] bool waits_for_time() const noexcept {
    return client != nullptr || wake_ns.has_value();
  }
};

/// The simulation whose time the threads wait for. Called with the lock held, but for what says
/// otherwise.
class TurnClock {
 public:
  TurnClock() = default;
  TurnClock(const TurnClock&) = delete;
  TurnClock& operator=(const TurnClock&) = delete;
  virtual ~TurnClock() = default;

  /// Nobody thinks, and nobody is ready: lets a step pass, if it may, and makes ready those whose
  /// wait is over. @return whether it did.
  virtual bool step(std::unique_lock<std::mutex>& lock) = 0;
  /// Whether a moment has come, for those that wait for it.
  [[nodiscard]] virtual bool has_come(sim::SimTime wake_ns) const = 0;
  /// Whether somebody may have been silent for too long.
  virtual void look_at_start() = 0;
  /// When a thread last sent something, or began to think if that is later.
  [[nodiscard]] virtual std::chrono::steady_clock::time_point last_seen(
      const TurnThread& thread) const = 0;
  /// A thread has been silent for too long, or was blocked. @return whether time follows the wall
  /// clock now.
  virtual void on_silent(const TurnThread& thread) = 0;
  virtual bool on_blocked(const TurnThread& thread) = 0;

  // Without the lock:

  /// Simulated time, and the time of a step.
  [[nodiscard]] virtual sim::SimTime now_ns() const noexcept = 0;
  [[nodiscard]] virtual sim::SimTime step_ns() const noexcept = 0;
  /// From now on the threads of the program wait for this simulation's time, ...
  /// @param before_ns  what the clocks tell at its beginning, since the program's start.
  virtual void begin_turns(sim::SimTime before_ns) = 0;
  /// ... and no longer.
  virtual void end_turns(sim::SimTime before_ns) = 0;
  /// Lets time pass for the calling thread, until this moment or the step before it.
  /// @param interrupted  set to whether a signal ended that.
  /// @return how far the moment lies ahead then; nullopt if the thread is to sleep for real.
  virtual std::optional<sim::SimTime> pass_time(sim::SimTime target_ns, bool& interrupted) = 0;

  // With the lock held:

  /// A wait with a deadline was over. After the run's end it is for ever, so that is slowed down,
  /// and ended, as sleeps are.
  /// @param left_ns  how far the deadline lies ahead of simulated time.
  virtual void note_timed_wait(std::unique_lock<std::mutex>& lock, sim::SimTime left_ns) = 0;
  /// How long a thread may think before the others no longer wait for it.
  [[nodiscard]] virtual std::chrono::steady_clock::duration silence_limit() const = 0;
};

/// Virtual time: the threads of the program go on one by one, in a fixed order, so that what they
/// do is the same in each run (docs/virtual_time.md). Each goes on until it waits: for simulated
/// time, for data, or for another thread. Those that are ready then do so in the order in which
/// they became it; when none is left, simulated time goes on.
///
/// There is one of these in a process. It outlives all static objects.
class Turns {
 public:
  using Lock = std::unique_lock<std::mutex>;
  using State = TurnThread::State;
  using Wake = TurnThread::Wake;

  static Turns& instance();

  /// Guards this, and the simulation that is its clock.
  [[nodiscard]] std::mutex& mutex() noexcept { return mutex_; }
  /// Until it is released. Changes with the lock held.
  [[nodiscard]] bool active() const noexcept { return active_.load(std::memory_order_acquire); }
  /// How many wait for mutexes, or are about to take one they have waited for.
  [[nodiscard]] const std::atomic<int>& mutex_waits() const noexcept { return mutex_waits_; }
  /// How many wait for other objects.
  [[nodiscard]] const std::atomic<int>& object_waits() const noexcept { return object_waits_; }

  // With the lock held:

  /// It is the turn of the calling thread, the program's first.
  void begin();
  /// Everybody goes on at the same time from now on: virtual time is over.
  void release();
  /// @param now_ns  what the threads' moments are counted from now; they were so from before_ns.
  void set_clock(TurnClock* clock, sim::SimTime before_ns, sim::SimTime now_ns);

  /// The calling thread. One that was not known is from now on; it thinks beside the others.
  TurnThread& self();
  /// The same, if it is known.
  [[nodiscard]] static TurnThread* known_self() noexcept;
  /// The calling thread starts one, which goes on when it is its turn.
  void add(ThreadId thread_id);
  /// @param handle  its pthread_t
  void note_handle(ThreadId thread_id, const void* handle);
  /// The calling thread is that one. Returns when it is its turn.
  void enter(Lock& lock, ThreadId thread_id);
  /// A thread has ended, or could not be started.
  void remove(ThreadId thread_id);
  /// Whether a thread of the program with this pthread_t lives.
  [[nodiscard]] bool lives(const void* handle) const;
  /// Whether that thread, by the system's number, is one that waits for its turn.
  [[nodiscard]] bool is_parked(pid_t number) const;
  /// Whether somebody waits for that mutex, or is about to take it.
  [[nodiscard]] bool is_wanted(const void* mutex) const;

  /// What the calling thread will wait for; whoever wakes it from now on is not missed.
  void begin_wait(TurnThread& self, const void* object, bool takes_mutex);
  /// Waits for that, for data or for a moment, whatever is set, and for its turn.
  /// @param interruptible  signals end the wait.
  /// @return what ended it; kNone: all go on at the same time now, or its client was closed.
  Wake wait(Lock& lock, TurnThread& self, bool interruptible = false);
  /// Lets those go on that are ready. @return whether there was one.
  bool yield(Lock& lock, TurnThread& self);
  /// Wakes those who wait for an object, in the order in which they began to. @return how many.
  int wake(const void* object, int most);
  /// The same for all of them, soon; for threads that must not wait for the lock. Without it.
  void wake_later(const void* object);
  /// Ends a thread's wait, wherever it stands in it; or only one that signals end.
  void interrupt(const void* handle, bool by_signal);
  /// What a thread waits for is there: it goes on in its turn.
  void make_ready(TurnThread& thread, Wake wake);
  /// The thread that waits for this client's data goes on at once, beside the others.
  void let_go(const void* client);
  /// Lets somebody go on, if nobody thinks; wakes one to let time pass.
  void kick();

  /// Whether somebody waits for data or a moment.
  [[nodiscard]] bool somebody_waits_for_time() const;
  [[nodiscard]] const std::vector<std::unique_ptr<TurnThread>>& threads() const noexcept {
    return threads_;
  }

  /// A rule of the wall clock has stepped in: another run may differ. Any thread, without the lock.
  /// @return whether it is news.
  bool note_unrepeatable(const std::string& why);
  [[nodiscard]] std::vector<std::string> unrepeatable() const;

 private:
  Turns() = default;

  /// Waits until it is the thread's turn, or all are released.
  void park(Lock& lock, TurnThread& self);
  TurnThread& insert(ThreadId thread_id, State state);
  [[nodiscard]] TurnThread* find(ThreadId thread_id) const;
  void move(TurnThread& thread, State state);
  static void ring(TurnThread& thread);
  [[nodiscard]] TurnThread* first_ready() const;
  void end_wait(TurnThread& thread);
  [[nodiscard]] bool has_come(sim::SimTime wake_ns) const;
  void note_signal(TurnThread& self);
  /// Asks those that can be asked whether what they wait for is there. @return whether so.
  bool ask_waiting();
  /// Without a simulation: waits for the first moment that somebody waits for.
  /// @return whether something has changed.
  bool wait_really(Lock& lock, TurnThread& self);
  void wake_those_of_later();
  /// Looks for threads that are blocked, or think for too long.
  void look(Lock& lock);

  std::mutex mutex_;
  std::atomic<bool> active_{false};
  std::vector<std::unique_ptr<TurnThread>> threads_;  ///< in order of their start
  TurnThread* current_ = nullptr;                     ///< whose turn it is
  TurnClock* clock_ = nullptr;
  std::uint64_t last_place_ = 0;
  int ready_ = 0;   ///< how many are
  int beside_ = 0;  ///< the same
  std::atomic<int> mutex_waits_{0};
  std::atomic<int> object_waits_{0};

  /// What is to be woken later. When there are more, all who wait are: they look again.
  std::array<std::atomic<const void*>, 16> later_{};
  std::atomic<bool> any_later_{false};
  std::atomic<bool> all_later_{false};

  mutable std::mutex reasons_mutex_;
  std::vector<std::string> reasons_;
};

}  // namespace playerlike
