// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "virtual_time/virtual_time.h"

#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/process/log.h"
#include "process/thread_end.h"
#include "virtual_time/hooks.h"
#include "virtual_time/turns.h"

namespace playerlike::virtual_time {
namespace {

// How often a thread may read the clock without reading data or sleeping; each further read waits
// for a step.
constexpr int kFreeClockReads = 4;
// How many calls of yield() without another ready thread are free; then a step passes.
constexpr int kFreeYields = 100;
// The same limit for accesses to data that a background thread changes, and how many more accesses
// a step costs then. The limit is high, since programs access all beams of a scan, perhaps several
// times.
constexpr long long kFreeDataReads = 1'000'000;
constexpr long long kDataReadsPerStep = 10'000;
// After this many accesses the other ready threads get a turn, since the loop may wait for one of
// them.
constexpr long long kDataReadsPerTurn = 1'000;
// The limits for programs without a reading thread: only the end of the run can change anything for
// them. They are higher, since such a program may compute for long between two reads.
constexpr long long kFreeDataReadsAlone = 3'000'000;
constexpr long long kDataReadsPerStepAlone = 1'000;
// How far a read of the clock advances time before there is a simulation [ns].
constexpr long long kStepBefore_ns = 10'000'000;

/// Used as a thread id: a thread that a library starts for Playpen, such as a film encoder's. It is
/// not part of virtual time.
constexpr unsigned long long kLibraryThread = ~0ULL;

/// State of a thread. Trivially constructed and destroyed, so it is valid at any time.
struct ThreadState {
  int inside = 0;
  int starts_for_program = 0;
  int starts_for_libraries = 0;
  bool ended = false;
  bool takes_part = false;
  bool programs = false;        ///< started by the program's code
  signed char main = -1;        ///< whether it is the main thread; < 0: unknown
  signed char leaving = 0;      ///< < 0: the thread is about to end; > 0: the process is
  int clock_reads = 0;          ///< reads of the clock since the last wait
  long long data_reads = 0;     ///< accesses to data since the last wait
  int yields = 0;               ///< yields without another ready thread
  sim::SimTime ahead_ns = 0;    ///< time slept beyond whole steps, ...
  sim::SimTime ahead_from = 0;  ///< ... at this simulated time
  long long deadline_ns = -1;   ///< end of the wait that has begun, since the program's start
};
constinit thread_local ThreadState state;

// State of the process. It must outlive all static objects.
constinit std::atomic<bool> registered{false};
constinit std::atomic<bool> given_up{false};
constinit std::atomic<bool> background{false};
constinit std::atomic<TurnClock*> attached{nullptr};
/// Time before the simulation plus time slept after its end [ns].
constinit std::atomic<long long> offset_ns{0};
/// Virtual and real time when virtual time was given up.
constinit std::atomic<long long> last_ns{0};
constinit std::atomic<long long> last_real_ns{0};
/// Address range of the program's executable, without libraries.
constinit std::uintptr_t program_begin = 0;
constinit std::uintptr_t program_end = 0;

long long real_ns() {
  const Inside inside;
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool is_main(ThreadState& thread) {
  if (thread.main < 0) thread.main = syscall(SYS_gettid) == getpid() ? 1 : 0;
  return thread.main == 1;
}

bool in_program(const void* address) {
  const auto value = reinterpret_cast<std::uintptr_t>(address);
  return value >= program_begin && value < program_end;
}

/// Whether code belongs to the program, so that its thread does too. Threads of system libraries
/// are not virtual, but some libraries sleep only on behalf of their callers.
bool is_programs_code(const void* address) {
  if (in_program(address)) return true;
  Dl_info info{};
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return false;
  const std::string_view file = info.dli_fname;
  const std::string_view name = file.substr(file.rfind('/') + 1);
  for (const std::string_view sleeps : {"libstdc++.", "libc++.", "libboost_thread."}) {
    if (name.starts_with(sleeps)) return true;
  }
  for (const std::string_view folder : {"/lib/", "/lib64/", "/usr/lib/", "/usr/lib64/"}) {
    if (file.starts_with(folder)) return false;
  }
  return !name.starts_with("libplaypen_") && !name.starts_with("libopencv_") &&
         !name.starts_with("libspdlog.");
}

/// The code that a thread will run, derived from how it is started.
const void* code_of_thread(const void* caller, const void* start, const void* argument) {
  Dl_info info{};
  if (in_program(caller) || dladdr(caller, &info) == 0 || info.dli_fname == nullptr) return caller;
  // libstdc++ passes std::thread's state object, whose virtual table lies in the module of the
  // thread's code.
  if (std::strstr(info.dli_fname, "/libstdc++.") == nullptr || argument == nullptr) return start;
  return *static_cast<const void* const*>(argument);
}

/// All simulations that were attached. They are kept, because a thread may be about to enter one.
std::vector<std::shared_ptr<TurnClock>>& kept_clocks() {
  static auto* const clocks = new std::vector<std::shared_ptr<TurnClock>>;
  return *clocks;
}
constinit std::mutex lists_mutex;  // guards kept_clocks()

long long elapsed(const ThreadState& thread) {
  if (given_up.load(std::memory_order_acquire)) {
    return last_ns.load() + real_ns() - last_real_ns.load();
  }
  const long long before_ns = offset_ns.load();
  TurnClock* const clock = attached.load(std::memory_order_acquire);
  if (clock == nullptr) return before_ns;
  const sim::SimTime now_ns = clock->now_ns();
  const bool ahead = thread.takes_part && thread.ahead_from == now_ns;
  return before_ns + now_ns + (ahead ? thread.ahead_ns : 0);
}

enum class SleepResult { kNo, kYes, kInterrupted };

/// Advances simulated time for the calling thread.
/// @param left_ns  of a sleep: receives the remaining time if a signal ends it; null if the thread
/// does not sleep.
SleepResult advance_time(ThreadState& thread, TurnClock& clock, long long duration_ns,
                         long long* left_ns = nullptr) {
  const Inside inside;
  try {
    thread.takes_part = true;
    remember_thread();
    const sim::SimTime from_ns = clock.now_ns();
    const sim::SimTime start_ns = from_ns + (thread.ahead_from == from_ns ? thread.ahead_ns : 0);
    bool interrupted = false;
    const auto ahead_ns = clock.pass_time(start_ns + duration_ns, left_ns != nullptr, interrupted);
    if (!ahead_ns) return SleepResult::kNo;
    if (interrupted) {
      if (left_ns != nullptr) *left_ns = std::max<sim::SimTime>(*ahead_ns, 0);
      return SleepResult::kInterrupted;
    }
    thread.ahead_from = clock.now_ns();
    thread.ahead_ns = *ahead_ns;
    return SleepResult::kYes;
  } catch (const std::exception&) {
    return SleepResult::kNo;  // out of memory, or the simulation has ended
  }
}

/// A sleep before there is a simulation, while other threads take turns. @return the result of the
/// sleep hook.
int sleep_before(long long duration_ns, long long* left_ns) {
  TurnThread* const self = Turns::known_self();
  if (self == nullptr) return 0;
  const Inside inside;
  Turns& turns = Turns::instance();
  Turns::Lock lock(turns.mutex());
  if (!turns.active() || turns.threads().size() < 2 || attached.load() != nullptr) return 0;
  const long long end_ns = offset_ns.load() + duration_ns;
  self->wake_ns = end_ns;
  switch (turns.wait(lock, *self, /*interruptible=*/true)) {
    case TurnThread::Wake::kNone:
      return 0;
    case TurnThread::Wake::kInterrupted:
      *left_ns = std::max(0LL, end_ns - elapsed(state));
      return 2;
    default:
      return 1;
  }
}

// --- The hooks

int on_sleep(long long duration_ns, const void* caller, long long* left_ns) {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended || given_up.load(std::memory_order_acquire)) return 0;
  TurnClock* const clock = attached.load(std::memory_order_acquire);
  if (clock == nullptr) {
    if (const int slept = sleep_before(duration_ns, left_ns); slept != 0) return slept;
    // No other thread could run. The clock must advance nevertheless.
    if (is_main(thread)) offset_ns.fetch_add(duration_ns);
    return 0;
  }
  if (!thread.takes_part && !thread.programs && !is_main(thread) && !is_programs_code(caller)) {
    return 0;
  }
  thread.clock_reads = 0;
  thread.data_reads = 0;
  thread.yields = 0;
  switch (advance_time(thread, *clock, duration_ns, left_ns)) {
    case SleepResult::kNo:
      return 0;
    case SleepResult::kYes:
      return 1;
    default:
      return 2;
  }
}

int on_now(long long* elapsed_ns, int ask, const void* caller) {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended) return 0;
  const bool programs = thread.takes_part || thread.programs || is_main(thread);
  if (!programs && !in_program(caller)) return 0;
  // Only the program's threads are counted. In other threads, code that is linked into the program
  // may belong to a library that does not wait, such as a sanitizer at the end of a thread.
  if (ask != 0 && programs && !given_up.load(std::memory_order_acquire) &&
      ++thread.clock_reads > kFreeClockReads) {
    thread.clock_reads = kFreeClockReads;
    TurnClock* const clock = attached.load(std::memory_order_acquire);
    if (clock == nullptr) {
      offset_ns.fetch_add(kStepBefore_ns);
    } else {
      advance_time(thread, *clock, clock->step_ns());
    }
  }
  *elapsed_ns = elapsed(thread);
  return 1;
}

/// Locks the mutex of Turns. A thread without a thread id only tries to.
Turns::Lock lock_turns() {
  Turns& turns = Turns::instance();
  if (has_thread_id()) return Turns::Lock(turns.mutex());
  return Turns::Lock(turns.mutex(), std::try_to_lock);
}

unsigned long long on_begin_thread(const void* caller, const void* start, const void* argument) {
  const ThreadState& thread = state;
  if (thread.ended || given_up.load(std::memory_order_acquire)) return 0;
  if (thread.starts_for_libraries > 0) return kLibraryThread;
  if (thread.inside > 0) return 0;
  const Inside inside;
  try {
    if (thread.starts_for_program == 0 &&
        !is_programs_code(code_of_thread(caller, start, argument))) {
      return 0;
    }
    const ThreadId thread_id = new_thread_id();
    remember_thread();
    Turns& turns = Turns::instance();
    const Turns::Lock lock(turns.mutex());
    if (!turns.active()) return 0;
    // The starting thread takes turns too; otherwise the progress of the new thread would depend on
    // scheduling.
    static_cast<void>(turns.self());
    turns.add(thread_id);
    return thread_id;
  } catch (const std::exception&) {
    return 0;
  }
}

void on_thread_started(unsigned long long number, const void* handle) {
  if (number == kLibraryThread) return;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  turns.note_handle(number, handle);
}

void on_thread_failed(unsigned long long number) {
  if (number == kLibraryThread) return;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  turns.remove(number);
}

void on_thread_begun(unsigned long long number) {
  if (number == kLibraryThread) {
    // Until the thread ends. The threads that it starts belong to the library too.
    ++state.inside;
    ++state.starts_for_libraries;
    return;
  }
  state.programs = true;
  const Inside inside;
  set_this_thread_id(number);
  remember_thread();
  Turns& turns = Turns::instance();
  Turns::Lock lock(turns.mutex());
  turns.enter(lock, number);
}

int on_begin_wait(const void* object, int kind, long long deadline_ns,
                  int (*is_ready)(const void*, unsigned), unsigned value) {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended) return 0;
  TurnThread* const self = Turns::known_self();
  if (self == nullptr) return 0;  // nobody waits for a library's thread
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  if (!turns.active()) return 0;
  const bool takes_mutex = kind == kPlaypenWaitMutex;
  if (takes_mutex && self->state == TurnThread::State::kDetached) return 0;
  if (is_ready != nullptr && is_ready(object, value) != 0) return 2;
  if (kind == kPlaypenWaitThread && !turns.lives(object)) return 2;
  turns.begin_wait(*self, object, takes_mutex);
  self->is_ready = is_ready;
  self->value = value;
  thread.yields = 0;
  thread.deadline_ns = -1;
  if (deadline_ns >= 0) {
    // At least 1 us, so that a loop of zero-length waits ends.
    thread.deadline_ns = std::max(deadline_ns, elapsed(thread) + 1'000);
    self->wake_ns = thread.deadline_ns;
    if (TurnClock* const clock = attached.load()) {
      const sim::SimTime wake_ns = thread.deadline_ns - offset_ns.load();
      self->wake_ns = wake_ns - wake_ns % clock->step_ns();
    }
  }
  return 1;
}

int on_finish_wait() {
  ThreadState& thread = state;
  const Inside inside;
  Turns& turns = Turns::instance();
  Turns::Lock lock(turns.mutex());
  TurnThread& self = turns.self();
  const bool timed = thread.deadline_ns >= 0;
  switch (turns.wait(lock, self)) {
    case TurnThread::Wake::kObjectReady:
      thread.clock_reads = 0;
      thread.data_reads = 0;
      return kPlaypenWaitReady;
    case TurnThread::Wake::kInterrupted:
      return kPlaypenWaitInterrupted;
    case TurnThread::Wake::kNone:
      return kPlaypenWaitReleased;
    case TurnThread::Wake::kTime:
      break;
  }
  thread.clock_reads = 0;
  thread.data_reads = 0;
  TurnClock* const clock = attached.load();
  if (timed && clock != nullptr) {
    thread.takes_part = true;
    thread.ahead_from = clock->now_ns();
    thread.ahead_ns =
        std::max<sim::SimTime>(0, thread.deadline_ns - offset_ns.load() - thread.ahead_from);
    clock->note_timed_wait(lock, thread.ahead_ns);
  }
  return kPlaypenWaitTime;
}

int on_wake(const void* object, int most) {
  if (state.inside > 0) return 0;
  const Inside inside;
  Turns& turns = Turns::instance();
  // A library's thread must not block here: it may hold a lock that the drawing thread needs, for
  // which the simulation may be waiting.
  const Turns::Lock lock = lock_turns();
  if (lock.owns_lock()) return turns.wake(object, most);
  turns.wake_later(object);
  return 0;
}

int on_waits_for_turn(int owner) {
  if (state.inside > 0 || Turns::known_self() == nullptr) return 0;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  return turns.active() && turns.is_parked(owner) ? 1 : 0;
}

int on_mutex_is_wanted(const void* mutex) {
  const TurnThread* const self = Turns::known_self();
  if (state.inside > 0 || self == nullptr) return 0;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  return turns.active() && self->state == TurnThread::State::kRunning && turns.is_wanted(mutex) ? 1
                                                                                                : 0;
}

int on_thread_lives(const void* handle) {
  if (state.inside > 0 || Turns::known_self() == nullptr) return 0;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  return turns.active() && turns.lives(handle) ? 1 : 0;
}

void interrupt(const void* handle, bool by_signal) {
  if (state.inside > 0) return;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  turns.interrupt(handle, by_signal);
}

void on_cancelled(const void* handle) { interrupt(handle, /*by_signal=*/false); }
void on_signalled(const void* handle) { interrupt(handle, /*by_signal=*/true); }

/// Lets the ready threads run. @return whether there were any.
bool yield_turn() {
  TurnThread* const self = Turns::known_self();
  if (self == nullptr || !Turns::instance().active()) return false;
  const Inside inside;
  Turns& turns = Turns::instance();
  Turns::Lock lock(turns.mutex());
  return turns.yield(lock, *self);
}

void on_yield() {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended || Turns::known_self() == nullptr) return;
  if (yield_turn()) thread.yields = 0;
  // No other thread can run, so the caller waits for simulated time.
  if (++thread.yields < kFreeYields || given_up.load(std::memory_order_acquire)) return;
  thread.yields = 0;
  TurnClock* const clock = attached.load(std::memory_order_acquire);
  if (clock != nullptr) advance_time(thread, *clock, clock->step_ns());
}

void on_leaving(int process) { state.leaving = process != 0 ? 1 : -1; }

int on_takes_turns() {
  const ThreadState& thread = state;
  return thread.inside == 0 && !thread.ended && Turns::known_self() != nullptr &&
                 Turns::instance().active()
             ? 1
             : 0;
}

int on_is_programs(const void* caller) {
  if (on_takes_turns() == 0) return 0;
  const Inside inside;
  return is_programs_code(caller) ? 1 : 0;
}

void on_waits_for_real(const char* what) {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended || given_up || Turns::known_self() == nullptr) return;
  const Inside inside;
  try {
    const std::string text = std::string(what) +
                             " counts real time, which passes far slower than the program's "
                             "simulated time";
    if (Turns::instance().note_unrepeatable(text)) {
      log_to_stderr()(sim::LogLevel::kWarning,
                      text + " ('playpen doc virtual_time'; --real-sleep makes all of it real)");
    }
  } catch (const std::exception&) {
    // Out of memory; the warning is lost.
  }
}

const int* counter(const std::atomic<int>& value) {
  static_assert(sizeof(std::atomic<int>) == sizeof(int));
  return reinterpret_cast<const int*>(&value);
}

const PlaypenVirtualTimeHooks* hooks() {
  static const auto* const table =
      new PlaypenVirtualTimeHooks{PLAYPEN_VIRTUAL_TIME_VERSION,
                                  counter(Turns::instance().mutex_waits()),
                                  counter(Turns::instance().object_waits()),
                                  on_sleep,
                                  on_now,
                                  on_begin_thread,
                                  on_thread_started,
                                  on_thread_failed,
                                  on_thread_begun,
                                  on_begin_wait,
                                  on_finish_wait,
                                  on_wake,
                                  on_waits_for_turn,
                                  on_mutex_is_wanted,
                                  on_thread_lives,
                                  on_cancelled,
                                  on_signalled,
                                  on_yield,
                                  on_leaving,
                                  on_is_programs,
                                  on_takes_turns,
                                  on_waits_for_real};
  return table;
}

int note_program(dl_phdr_info* info, std::size_t /*size*/, void* /*data*/) {
  program_begin = UINTPTR_MAX;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr;
    program_begin = std::min(program_begin, begin);
    program_end = std::max(program_end, begin + part.p_memsz);
  }
  return 1;  // the program is the first module; stop the iteration
}

// Runs before main() and before the program's static objects, which may read the clock.
// After keep_library_functions() of libsim (101), which may be part of the same library, and after
// copies of a prepared process are made (102).
__attribute__((constructor(103))) void register_hooks() {
  void* const found = dlsym(RTLD_DEFAULT, PLAYPEN_VIRTUAL_TIME_REGISTER);
  if (found == nullptr) return;
  static_cast<void>(this_thread_id());  // the main thread gets the first id
  dl_iterate_phdr(note_program, nullptr);
  const Inside inside;
  registered = reinterpret_cast<PlaypenVirtualTimeRegister>(found)(hooks()) != 0;
  if (!registered) return;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  turns.begin();
}

}  // namespace

bool active() noexcept { return registered && !given_up; }

Inside::Inside() noexcept { ++state.inside; }
Inside::~Inside() { --state.inside; }

StartsForProgram::StartsForProgram() noexcept { ++state.starts_for_program; }
StartsForProgram::~StartsForProgram() { --state.starts_for_program; }

StartsForLibraries::StartsForLibraries() noexcept { ++state.starts_for_libraries; }
StartsForLibraries::~StartsForLibraries() { --state.starts_for_libraries; }

void attach(const std::shared_ptr<TurnClock>& clock) {
  const std::lock_guard lock(lists_mutex);
  if (attached.load() != nullptr || !active()) return;
  kept_clocks().push_back(clock);
  clock->begin_turns(offset_ns.load());
  attached.store(clock.get(), std::memory_order_release);
}

const TurnClock* attached_clock() noexcept { return attached.load(std::memory_order_acquire); }

void detach(TurnClock& clock) noexcept {
  const std::lock_guard lock(lists_mutex);
  if (attached.load() != &clock) return;
  offset_ns.fetch_add(clock.now_ns());
  attached.store(nullptr, std::memory_order_release);
  clock.end_turns(offset_ns.load());
}

long long time_before_ns() noexcept { return offset_ns.load(); }
void set_time_before_ns(long long now_ns) noexcept { offset_ns.store(now_ns); }

// The caller has locked a simulation, so lists_mutex must not be locked here.
void give_up_locked() noexcept {
  static constinit std::atomic<bool> begun{false};
  if (begun.exchange(true)) return;
  last_ns = elapsed(state);
  last_real_ns = real_ns();
  given_up.store(true, std::memory_order_release);
  Turns::instance().release();
}

void give_up() noexcept {
  const Inside inside;
  const Turns::Lock lock(Turns::instance().mutex());
  give_up_locked();
}

void remember_thread() {
  if (ThreadEnd* const end = ThreadEnd::mine()) end->leave_by(note_thread_ends);
}

void note_wait() noexcept {
  state.takes_part = true;
  state.clock_reads = 0;
  state.data_reads = 0;
  state.yields = 0;
}

void count_data_reads(int count) noexcept {
  ThreadState& thread = state;
  const bool turn =
      thread.data_reads / kDataReadsPerTurn != (thread.data_reads + count) / kDataReadsPerTurn;
  thread.data_reads += count;
  const bool alone = !background.load(std::memory_order_relaxed);
  const long long free_data_reads = alone ? kFreeDataReadsAlone : kFreeDataReads;
  if (turn && thread.inside == 0) yield_turn();
  if (thread.data_reads < free_data_reads) return;
  thread.data_reads = free_data_reads - (alone ? kDataReadsPerStepAlone : kDataReadsPerStep);
  TurnClock* const clock = attached.load(std::memory_order_acquire);
  if (thread.inside > 0 || thread.ended || given_up || clock == nullptr) return;
  if (!thread.takes_part && (!alone || !(thread.programs || is_main(thread)))) return;
  advance_time(thread, *clock, clock->step_ns());
}

void note_background() noexcept { background = true; }

bool process_ends() noexcept {
  ThreadState& thread = state;
  return thread.leaving > 0 || (thread.leaving == 0 && is_main(thread));
}

void note_thread_ends() noexcept {
  // At the end of the process no other thread may run, since its progress would depend on
  // scheduling.
  if (process_ends()) return;
  state.ended = true;
  const Inside inside;
  Turns& turns = Turns::instance();
  const Turns::Lock lock(turns.mutex());
  turns.remove(this_thread_id());
}

bool wait_until(const void* simulation, const std::function<bool()>& condition) {
  ThreadState& thread = state;
  TurnClock* const clock = attached.load(std::memory_order_acquire);
  if (!active() || clock == nullptr || clock != simulation || thread.ended || !thread.takes_part) {
    return false;
  }
  const sim::SimTime step_ns = clock->step_ns();
  while (!condition()) {
    if (given_up || advance_time(thread, *clock, step_ns) == SleepResult::kNo) return false;
  }
  return true;
}

}  // namespace playerlike::virtual_time
