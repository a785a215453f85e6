// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "virtual_time/turns.h"

#include <linux/futex.h>
#include <pthread.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <ctime>
#include <utility>

#include "process/debugger.h"
#include "process/system_threads.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

using SteadyClock = std::chrono::steady_clock;

// How often to check for blocked threads, and after which time asleep a thread is blocked.
constexpr std::chrono::milliseconds kCheckPeriod(20);
constexpr std::chrono::milliseconds kBlocked(100);
// Minimum number of such checks, since the checking thread itself may have been preempted.
constexpr int kBlockedChecks = 4;
// Silence limit while there is no simulation, which knows the limit of the run.
constexpr std::chrono::seconds kSilence(5);

constinit thread_local TurnThread* own = nullptr;

enum class WaitResult { kEvent, kTimeOut, kSignal };

// The kernel does not restart a FUTEX_WAIT with a timeout after a signal, even with SA_RESTART.
WaitResult wait_for_event(const std::atomic<unsigned>& event_count, unsigned known_count,
                          std::chrono::nanoseconds limit) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(limit);
  const timespec time = {whole.count(), static_cast<long>((limit - whole).count())};
  if (syscall(SYS_futex, &event_count, FUTEX_WAIT_PRIVATE, known_count, &time, nullptr, 0) == 0) {
    return WaitResult::kEvent;
  }
  if (errno == EINTR) return WaitResult::kSignal;
  return errno == ETIMEDOUT ? WaitResult::kTimeOut : WaitResult::kEvent;
}

/// State of a running thread at the time of a check.
struct ThreadSample {
  ThreadId thread_id;
  pid_t number;
  SteadyClock::time_point since;
  std::optional<std::uint64_t> switches;
};

/// Detects signals that arrive while a parked thread steps the simulation. They are blocked in the
/// meantime.
class SignalWatch {
 public:
  SignalWatch() = default;
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  ~SignalWatch() { let_through(); }

  /// Blocks the signals until handle() or let_through().
  void hold() {
    if (holds_) return;
    sigset_t all;
    sigfillset(&all);
    // Fault signals must stay enabled, since the thread itself causes them. The timers of processor
    // time do not run during a real sleep.
    for (const int signal :
         {SIGPROF, SIGVTALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS}) {
      sigdelset(&all, signal);
    }
    holds_ = pthread_sigmask(SIG_BLOCK, &all, &before_) == 0;
  }
  /// Must be called after each step. @param now  whether to look now, not after some more steps.
  /// @return whether handle() is due.
  [[nodiscard]] bool is_due(bool now) {
    if (!now && ++steps_ % kSteps != 0) return false;
    hold();
    sigset_t pending;
    if (sigpending(&pending) != 0) return false;
    has_handler_ = false;
    bool any = false;
    for (int signal = 1; signal < NSIG; ++signal) {
      if (sigismember(&pending, signal) != 1 || sigismember(&before_, signal) == 1) continue;
      any = true;
      struct sigaction action {};
      if (sigaction(signal, nullptr, &action) != 0) continue;
      const bool plain = (action.sa_flags & SA_SIGINFO) == 0 &&
                         (action.sa_handler == SIG_IGN || action.sa_handler == SIG_DFL);
      has_handler_ = has_handler_ || !plain;
    }
    return any;
  }
  /// Lets the signal handlers run; no mutex may be held. @return whether there were any.
  [[nodiscard]] bool handle() {
    let_through();
    return has_handler_;
  }
  void let_through() {
    if (holds_) pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    holds_ = false;
  }

 private:
  static constexpr int kSteps = 64;
  int steps_ = 0;
  bool holds_ = false;
  bool has_handler_ = false;
  sigset_t before_{};
};

}  // namespace

Turns& Turns::instance() {
  static auto* const turns = new Turns;
  return *turns;
}

// --- Threads

void Turns::notify(TurnThread& thread) {
  thread.event_count.fetch_add(1);
  if (&thread == own) return;
  syscall(SYS_futex, &thread.event_count, FUTEX_WAKE_PRIVATE, INT_MAX, nullptr, nullptr, 0);
}

void Turns::move(TurnThread& thread, State state) {
  if (current_ == &thread) current_ = nullptr;
  if (thread.state == State::kReady) --ready_;
  if (thread.state == State::kConcurrent) --concurrent_;
  thread.state = state;
  if (state == State::kReady) ++ready_;
  if (state == State::kConcurrent) ++concurrent_;
  if (state == State::kRunning) current_ = &thread;
  if (state == State::kRunning || state == State::kConcurrent) {
    thread.seen = SteadyClock::now();
    thread.blocked_since.reset();
  }
}

TurnThread* Turns::find(ThreadId thread_id) const {
  const auto found = std::find_if(threads_.begin(), threads_.end(),
                                  [&](const auto& t) { return t->thread_id == thread_id; });
  return found == threads_.end() ? nullptr : found->get();
}

TurnThread& Turns::insert(ThreadId thread_id, State state) {
  threads_.push_back(std::make_unique<TurnThread>(thread_id));
  TurnThread& thread = *threads_.back();
  thread.state = State::kDetached;
  thread.queue_order = ++last_queue_order_;
  move(thread, state);
  return thread;
}

TurnThread* Turns::known_self() noexcept { return own; }

TurnThread& Turns::self() {
  if (own == nullptr) {
    own = &insert(this_thread_id(), State::kConcurrent);
    own->number = this_thread();
    own->handle = reinterpret_cast<const void*>(pthread_self());
  }
  return *own;
}

void Turns::begin() {
  active_.store(true, std::memory_order_release);
  move(self(), State::kRunning);
}

void Turns::release() {
  active_.store(false, std::memory_order_release);
  for (const auto& thread : threads_) notify(*thread);
}

void Turns::set_clock(TurnClock* clock, sim::SimTime before_ns, sim::SimTime now_ns) {
  clock_ = clock;
  for (const auto& thread : threads_) {
    if (thread->wake_ns) *thread->wake_ns += now_ns - before_ns;
  }
  schedule_next();
}

void Turns::add(ThreadId thread_id) { insert(thread_id, State::kReady); }

void Turns::note_handle(ThreadId thread_id, const void* handle) {
  if (TurnThread* const thread = find(thread_id)) thread->handle = handle;
}

void Turns::enter(Lock& lock, ThreadId thread_id) {
  own = find(thread_id);
  if (own == nullptr) return;
  own->number = this_thread();
  own->handle = reinterpret_cast<const void*>(pthread_self());
  own->blocked_since.reset();
  park(lock, *own);
}

void Turns::remove(ThreadId thread_id) {
  TurnThread* const thread = find(thread_id);
  if (thread == nullptr) return;
  end_wait(*thread);
  move(*thread, State::kDetached);
  const void* const handle = thread->handle;
  if (own == thread) own = nullptr;
  std::erase_if(threads_, [&](const auto& t) { return t.get() == thread; });
  if (handle != nullptr) wake(handle, INT_MAX);
  schedule_next();
}

bool Turns::lives(const void* handle) const {
  return std::any_of(threads_.begin(), threads_.end(),
                     [&](const auto& t) { return t->handle == handle; });
}

bool Turns::is_parked(pid_t number) const {
  return number != 0 && std::any_of(threads_.begin(), threads_.end(), [&](const auto& t) {
           return t->number == number && (t->state == State::kReady || t->state == State::kWaits);
         });
}

bool Turns::is_wanted(const void* mutex) const {
  return std::any_of(threads_.begin(), threads_.end(), [&](const auto& t) {
    return t->takes_mutex && t->object == mutex && t->state == State::kReady;
  });
}

// --- Waiting

void Turns::begin_wait(TurnThread& self, const void* object, bool takes_mutex) {
  end_wait(self);
  self.object = object;
  self.takes_mutex = takes_mutex;
  self.counted = true;
  self.wake = Wake::kNone;
  self.queue_order = ++last_queue_order_;
  (takes_mutex ? mutex_waits_ : object_waits_).fetch_add(1);
}

void Turns::end_wait(TurnThread& thread) {
  if (thread.counted) (thread.takes_mutex ? mutex_waits_ : object_waits_).fetch_sub(1);
  thread.counted = false;
  thread.takes_mutex = false;
  thread.object = nullptr;
  thread.is_ready = nullptr;
  thread.client = nullptr;
  thread.wake_ns.reset();
  thread.interruptible = false;
}

Turns::Wake Turns::wait(Lock& lock, TurnThread& self, bool interruptible) {
  if (active()) {
    const bool come = self.wake_ns && has_come(*self.wake_ns);
    move(self, State::kWaits);
    if (self.wake != Wake::kNone || come) {
      make_ready(self, self.wake != Wake::kNone ? self.wake : Wake::kTime);
    }
    self.interruptible = interruptible;
    park(lock, self);
  }
  const Wake wake = std::exchange(self.wake, Wake::kNone);
  end_wait(self);
  return active() ? wake : Wake::kNone;
}

bool Turns::yield(Lock& lock, TurnThread& self) {
  if (!active() || ready_ == 0 || self.state != State::kRunning) return false;
  move(self, State::kReady);
  self.queue_order = ++last_queue_order_;
  park(lock, self);
  return true;
}

void Turns::make_ready(TurnThread& thread, Wake wake) {
  thread.wake = wake;
  if (!thread.takes_mutex) thread.object = nullptr;
  if (thread.state != State::kWaits) return;  // about to wait: wait() will see `wake`
  move(thread, State::kReady);
  thread.queue_order = ++last_queue_order_;
}

int Turns::wake(const void* object, int most) {
  int woken = 0;
  while (woken < most) {
    TurnThread* first = nullptr;
    for (const auto& thread : threads_) {
      if (thread->object != object || !thread->counted) continue;
      // A thread that is about to lock the mutex is not woken twice.
      if (thread->takes_mutex && thread->wake != Wake::kNone) return woken;
      if (first == nullptr || thread->queue_order < first->queue_order) first = thread.get();
    }
    if (first == nullptr) break;
    make_ready(*first, Wake::kObjectReady);
    ++woken;
  }
  if (woken > 0) schedule_next();
  return woken;
}

void Turns::wake_later(const void* object) {
  bool kept = false;
  for (auto& slot : deferred_) {
    const void* none = nullptr;
    kept = slot.load() == object || slot.compare_exchange_strong(none, object);
    if (kept) break;
  }
  if (!kept) all_deferred_ = true;
  any_deferred_ = true;
}

void Turns::flush_deferred_wakes() {
  any_deferred_ = false;
  const bool all = all_deferred_.exchange(false);
  for (auto& slot : deferred_) {
    if (const void* const object = slot.exchange(nullptr)) wake(object, INT_MAX);
  }
  if (!all) return;
  for (const auto& thread : threads_) {
    if (thread->counted) make_ready(*thread, Wake::kObjectReady);
  }
}

void Turns::interrupt(const void* handle, bool by_signal) {
  for (const auto& thread : threads_) {
    if (thread->handle != handle || (by_signal && !thread->interruptible)) continue;
    if (thread->state == State::kWaits || thread->counted) {
      make_ready(*thread, Wake::kInterrupted);
    }
  }
  schedule_next();
}

void Turns::resume_client_thread(const void* client) {
  for (const auto& thread : threads_) {
    if (thread->client != client) continue;
    thread->wake = Wake::kNone;
    if (thread->state == State::kWaits || thread->state == State::kReady) {
      move(*thread, State::kConcurrent);
      notify(*thread);
    }
  }
}

// --- Turns

TurnThread* Turns::first_ready() const {
  TurnThread* first = nullptr;
  if (ready_ == 0) return nullptr;
  for (const auto& thread : threads_) {
    if (thread->state != State::kReady) continue;
    if (first == nullptr || thread->queue_order < first->queue_order) first = thread.get();
  }
  return first;
}

void Turns::schedule_next() {
  if (current_ != nullptr) return;
  if (TurnThread* const next = first_ready()) {
    move(*next, State::kRunning);
    return notify(*next);
  }
  if (concurrent_ > 0) return;
  for (const auto& thread : threads_) {
    if (thread->state == State::kWaits && thread->waits_for_time()) return notify(*thread);
  }
}

void Turns::park(Lock& lock, TurnThread& self) {
  SignalWatch signals;
  const auto parked = [&] {
    return active() && (self.state == State::kReady || self.state == State::kWaits);
  };
  while (parked()) {
    if (any_deferred_.load(std::memory_order_relaxed)) flush_deferred_wakes();
    if (current_ == nullptr) {
      if (TurnThread* const next = first_ready()) {
        move(*next, State::kRunning);
        if (next == &self) break;
        notify(*next);
      } else if (concurrent_ == 0) {
        if (poll_waits()) continue;
        const bool waits = clock_ != nullptr && clock_->step_waits();
        if (waits && self.interruptible) signals.hold();
        const bool stepped = clock_ != nullptr ? clock_->step(lock) : wait_real_time(lock, self);
        if ((stepped || waits) && self.interruptible && self.state == State::kWaits &&
            signals.is_due(waits)) {
          lock.unlock();
          const bool handled = signals.handle();
          lock.lock();
          if (handled) note_signal(self);
          continue;
        }
        if (stepped) continue;
      }
    }
    const unsigned known_count = self.event_count.load();
    if (!parked()) break;
    lock.unlock();
    signals.let_through();
    const auto before = SteadyClock::now();
    const WaitResult result = wait_for_event(self.event_count, known_count, kCheckPeriod);
    lock.lock();
    if (SteadyClock::now() - before > silence_limit() / 2) forgive_standstill();
    if (result == WaitResult::kSignal && self.interruptible) note_signal(self);
    if (result == WaitResult::kTimeOut && parked()) check_blocked_threads(lock);
  }
}

void Turns::note_signal(TurnThread& self) {
  if (self.state != State::kWaits) return;
  make_ready(self, Wake::kInterrupted);
  note_unrepeatable("a signal ended a sleep");
}

bool Turns::has_come(sim::SimTime wake_ns) const {
  return clock_ != nullptr ? clock_->has_come(wake_ns) : virtual_time::time_before_ns() >= wake_ns;
}

// Also detects changes that come from elsewhere: another process or a signal handler.
bool Turns::poll_waits() {
  if (object_waits_.load() == 0) return false;
  bool any = false;
  for (const auto& thread : threads_) {
    if (thread->state != State::kWaits || thread->is_ready == nullptr) continue;
    if (thread->is_ready(thread->object, thread->value) == 0) continue;
    make_ready(*thread, Wake::kObjectReady);
    any = true;
  }
  return any;
}

bool Turns::wait_real_time(Lock& lock, TurnThread& self) {
  const auto first = [this] {
    TurnThread* earliest = nullptr;
    for (const auto& thread : threads_) {
      if (thread->state != State::kWaits || !thread->wake_ns) continue;
      if (earliest == nullptr || *thread->wake_ns < *earliest->wake_ns) earliest = thread.get();
    }
    return earliest;
  };
  if (first() != &self) {
    if (TurnThread* const earliest = first()) notify(*earliest);
    return false;
  }
  const sim::SimTime wake_ns = *self.wake_ns;
  const unsigned known_count = self.event_count.load();
  lock.unlock();
  const WaitResult result =
      wait_for_event(self.event_count, known_count,
                     std::chrono::nanoseconds(wake_ns - virtual_time::time_before_ns()));
  lock.lock();
  if (result == WaitResult::kSignal) return note_signal(self), true;
  if (result != WaitResult::kTimeOut || clock_ != nullptr || first() != &self) return true;
  virtual_time::set_time_before_ns(wake_ns);
  for (const auto& thread : threads_) {
    if (thread->state == State::kWaits && thread->wake_ns && *thread->wake_ns <= wake_ns) {
      make_ready(*thread, Wake::kTime);
    }
  }
  return true;
}

bool Turns::somebody_waits_for_time() const {
  return std::any_of(threads_.begin(), threads_.end(), [](const auto& t) {
    return t->state == State::kWaits && t->waits_for_time();
  });
}

// --- Rules of the wall clock

SteadyClock::duration Turns::silence_limit() const {
  return clock_ != nullptr ? clock_->silence_limit() : SteadyClock::duration(kSilence);
}

bool Turns::excuses_debuggers() const { return clock_ == nullptr || clock_->excuses_debuggers(); }

void Turns::forgive_standstill() {
  if (!excuses_debuggers()) return;
  const auto now = SteadyClock::now();
  for (const auto& thread : threads_) {
    if (thread->state != State::kRunning && thread->state != State::kConcurrent) continue;
    thread->seen = now;
    thread->blocked_since.reset();
  }
}

// A thread that sleeps in the system for something other than simulated time, such as a file or a
// key, does not hold up the others. A thread that computes or waits for a processor does.
void Turns::check_blocked_threads(Lock& lock) {
  if (clock_ != nullptr) clock_->check_silent_clients();
  if (ready_ == 0 && !somebody_waits_for_time()) return;  // nobody waits for the running thread
  // /proc is read without the mutex, because these threads may be waiting for it.
  std::vector<ThreadSample> samples;
  for (const auto& t : threads_) {
    if (t->state != State::kRunning && t->state != State::kConcurrent) continue;
    if (t->number == 0) continue;  // not begun yet
    samples.push_back({t->thread_id, t->number, t->seen, std::nullopt});
  }
  lock.unlock();
  for (ThreadSample& sample : samples) sample.switches = sleeps_since(sample.number);
  lock.lock();
  if (!active()) return;
  const auto now = SteadyClock::now();
  std::vector<TurnThread*> blocked;
  std::vector<TurnThread*> running;
  for (const ThreadSample& sample : samples) {
    TurnThread* const t = find(sample.thread_id);
    if (t == nullptr || t->seen != sample.since) return;  // it has waited in the meantime
    if (t->state != State::kRunning && t->state != State::kConcurrent) return;
    running.push_back(t);
    if (!sample.switches || !t->blocked_since || *sample.switches != t->blocked_switches) {
      t->blocked_since = sample.switches ? std::optional(now) : std::nullopt;
      t->blocked_switches = sample.switches.value_or(0);
      t->blocked_checks = 0;
    } else if (now - t->blocked_last >= kCheckPeriod) {
      ++t->blocked_checks;
      if (t->blocked_checks >= kBlockedChecks && now - *t->blocked_since >= kBlocked) {
        blocked.push_back(t);
      }
    } else {
      continue;  // another thread has just checked it
    }
    t->blocked_last = now;
  }
  // A thread that still runs may be the one that the blocked threads wait for.
  if (!blocked.empty() && blocked.size() == running.size()) {
    for (TurnThread* const t : blocked) {
      if (clock_ != nullptr && clock_->on_blocked(*t)) return;
      move(*t, State::kDetached);
      note_unrepeatable(
          "a thread of the program waited for 100 ms of wall time for something that is not "
          "simulated: a file, a key, a pipe or a socket");
    }
    return;
  }
  const auto limit = silence_limit();
  for (TurnThread* const t : running) {
    const auto seen = clock_ != nullptr ? clock_->last_seen(*t) : t->seen;
    // From half of the limit on: so much is left at least when a debugger leaves the process.
    if (now - seen >= limit / 2 && excuses_debuggers() && tracer_of(0) != 0) {
      t->seen = now;
      continue;
    }
    if (now - seen < limit) continue;
    move(*t, State::kDetached);
    note_unrepeatable("a thread of the program neither read nor slept for the silence limit");
    if (clock_ != nullptr) clock_->on_silent(*t);
  }
}

bool Turns::note_unrepeatable(const std::string& why) {
  const std::lock_guard lock(reasons_mutex_);
  if (std::find(reasons_.begin(), reasons_.end(), why) != reasons_.end()) return false;
  reasons_.push_back(why);
  return true;
}

std::vector<std::string> Turns::unrepeatable() const {
  const std::lock_guard lock(reasons_mutex_);
  return reasons_;
}

}  // namespace playerlike
