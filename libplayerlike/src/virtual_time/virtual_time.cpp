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
#include <cstdint>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "host/core.h"
#include "playerlike/host/host.h"
#include "session/in_process_session.h"
#include "virtual_time/hooks.h"

namespace playerlike::virtual_time {
namespace {

// A thread is told the same moment so often; whoever asks on without reading or sleeping in between
// waits for time to pass.
constexpr int kFreeAsks = 4;
// The same for looks at data that a background thread changes. Programs look at all beams of a
// scan, more than once maybe, so it takes many until it is clear that they wait.
constexpr long long kFreeLooks = 1'000'000;
constexpr long long kLooksAStep = 10'000;
// And for calls of a program that nobody reads for: nothing will ever change for it but the end of
// the run. It may well compute for long between two reads, so this takes more of them.
constexpr long long kFreeLooksAlone = 3'000'000;
constexpr long long kLooksAStepAlone = 1'000;
// How far a look at the clock moves it while there is no simulation [ns].
constexpr long long kStepBefore_ns = 10'000'000;

/// In place of a thinker's number: a thread that a library starts on Playpen's behalf, as encoders
/// of films do. It is Playpen's own.
constexpr unsigned long long kLibraryThread = ~0ULL;

/// What is known of a thread. Needs no construction, nor destruction, so it can be used at any
/// time.
struct ThreadState {
  int inside = 0;
  int starts_for_program = 0;
  int starts_for_libraries = 0;
  bool ended = false;
  bool takes_part = false;
  bool programs = false;        ///< started by the program's own code
  signed char main = -1;        ///< whether it is the main thread; < 0: not looked up yet
  int asks = 0;                 ///< since it last waited
  long long looks = 0;          ///< since it last waited
  sim::SimTime ahead_ns = 0;    ///< what it has slept beyond whole steps, ...
  sim::SimTime ahead_from = 0;  ///< ... when simulated time was this
};
constinit thread_local ThreadState state;

// Of the process. What is here has to outlive all static objects.
constinit std::atomic<bool> registered{false};
constinit std::atomic<bool> given_up{false};
constinit std::atomic<bool> background{false};
constinit std::atomic<Host*> attached{nullptr};
/// Time before the simulation, and what was slept after its end [ns].
constinit std::atomic<long long> offset_ns{0};
/// When it was given up: what the clocks showed then, and the real one.
constinit std::atomic<long long> last_ns{0};
constinit std::atomic<long long> last_real_ns{0};
/// Threads that wait for others, without a deadline.
constinit std::atomic<int> away_threads{0};
/// Where the program's own code lies, without its libraries.
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

/// Whether code is the program's, so that its thread is, too. What the system's libraries do in
/// threads of their own is their affair; but some of them only sleep on behalf of who calls them.
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

/// The code that a thread will run, as far as can be told from how it is started.
const void* code_of_thread(const void* caller, const void* start, const void* argument) {
  Dl_info info{};
  if (in_program(caller) || dladdr(caller, &info) == 0 || info.dli_fname == nullptr) return caller;
  // std::thread is given an object with virtual functions, whose table lies with its code.
  if (std::strstr(info.dli_fname, "/libstdc++.") == nullptr || argument == nullptr) return start;
  return *static_cast<const void* const*>(argument);
}

/// Simulations that were attached. A thread may be on its way into one, so they are kept.
std::vector<std::shared_ptr<Host>>& kept_hosts() {
  static auto* const hosts = new std::vector<std::shared_ptr<Host>>;
  return *hosts;
}
/// Threads that the program has started before there was a simulation, and that have not ended.
std::vector<ThinkerId>& early_threads() {
  static auto* const threads = new std::vector<ThinkerId>;
  return *threads;
}
constinit std::mutex lists_mutex;  // over both

long long elapsed(const ThreadState& thread) {
  if (given_up.load(std::memory_order_acquire)) {
    return last_ns.load() + real_ns() - last_real_ns.load();
  }
  const long long before_ns = offset_ns.load();
  Host* const host = attached.load(std::memory_order_acquire);
  if (host == nullptr) return before_ns;
  const sim::SimTime now_ns = VirtualTimeAccess::core(*host).now_ns();
  const bool ahead = thread.takes_part && thread.ahead_from == now_ns;
  return before_ns + now_ns + (ahead ? thread.ahead_ns : 0);
}

/// Lets simulated time pass for the calling thread.
/// @return whether that was done.
bool pass(ThreadState& thread, Host& host, long long duration_ns) {
  const Inside inside;
  try {
    thread.takes_part = true;
    remember_thread();
    auto& core = VirtualTimeAccess::core(host);
    const sim::SimTime from_ns = core.now_ns();
    const sim::SimTime start_ns = from_ns + (thread.ahead_from == from_ns ? thread.ahead_ns : 0);
    const std::optional<sim::SimTime> left_ns = core.pass_time(start_ns + duration_ns);
    if (!left_ns) return false;
    thread.ahead_from = core.now_ns();
    thread.ahead_ns = *left_ns;
    return true;
  } catch (const std::exception&) {
    return false;  // there is no memory, or no simulation any more
  }
}

// --- The hooks

int on_sleep(long long duration_ns, const void* caller) {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended || given_up.load(std::memory_order_acquire)) return 0;
  Host* const host = attached.load(std::memory_order_acquire);
  if (host == nullptr) {
    // There is nothing yet that could go on instead. But the clock is not to stand still.
    if (is_main(thread)) offset_ns.fetch_add(duration_ns);
    return 0;
  }
  if (!thread.takes_part && !thread.programs && !is_main(thread) && !is_programs_code(caller)) {
    return 0;
  }
  thread.asks = 0;
  thread.looks = 0;
  return pass(thread, *host, duration_ns) ? 1 : 0;
}

int on_now(long long* elapsed_ns, int ask, const void* caller) {
  ThreadState& thread = state;
  if (thread.inside > 0 || thread.ended) return 0;
  const bool programs = thread.takes_part || thread.programs || is_main(thread);
  if (!programs && !in_program(caller)) return 0;
  // In other threads code that is linked into the program may be a library's, which waits for
  // nothing: that of a sanitizer, say, which asks while a thread of Playpen's ends.
  if (ask != 0 && programs && !given_up.load(std::memory_order_acquire) &&
      ++thread.asks > kFreeAsks) {
    thread.asks = kFreeAsks;
    Host* const host = attached.load(std::memory_order_acquire);
    if (host == nullptr) {
      offset_ns.fetch_add(kStepBefore_ns);
    } else {
      pass(thread, *host, VirtualTimeAccess::core(*host).step_ns());
    }
  }
  *elapsed_ns = elapsed(thread);
  return 1;
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
    const ThinkerId thinker = new_thinker();
    const std::lock_guard lock(lists_mutex);
    if (Host* const host = attached.load()) {
      // The one that starts it, too, or it would be chance how far the new one gets meanwhile.
      remember_thread();
      VirtualTimeAccess::core(*host).add_thread(this_thinker());
      VirtualTimeAccess::core(*host).note_thread_begun();
      VirtualTimeAccess::core(*host).add_thread(thinker);
    } else {
      early_threads().push_back(thinker);
    }
    return thinker;
  } catch (const std::exception&) {
    return 0;
  }
}

void on_thread_begun(unsigned long long number) {
  if (number == kLibraryThread) {
    // Until it ends. What it starts is the library's, too.
    ++state.inside;
    ++state.starts_for_libraries;
    return;
  }
  state.programs = true;
  const Inside inside;
  set_this_thinker(number);
  remember_thread();
  Host* const host = attached.load(std::memory_order_acquire);
  if (host != nullptr) VirtualTimeAccess::core(*host).note_thread_begun();
}

void on_thread_failed(unsigned long long number) {
  if (number == kLibraryThread) return;
  const Inside inside;
  const std::lock_guard lock(lists_mutex);
  std::erase(early_threads(), number);
  if (Host* const host = attached.load()) VirtualTimeAccess::core(*host).thinker_ended(number);
}

int on_begin_wait(const void* what) {
  const ThreadState& thread = state;
  Host* const host = attached.load(std::memory_order_acquire);
  if (thread.inside > 0 || thread.ended || host == nullptr) return 0;
  // A library's thread holds up nobody. It must not wait for the simulation here either: with what
  // it has locked it could hold up the thread that draws, for which the simulation may be waiting.
  if (!is_thinker()) return 0;
  const Inside inside;
  away_threads.fetch_add(1);  // before anybody may look
  if (VirtualTimeAccess::core(*host).begin_away(what)) return 1;
  away_threads.fetch_sub(1);
  return 0;
}

void on_end_wait() {
  away_threads.fetch_sub(1);
  Host* const host = attached.load(std::memory_order_acquire);
  if (host == nullptr) return;
  const Inside inside;
  VirtualTimeAccess::core(*host).end_away();
}

void on_signalled(const void* what, int all) {
  if (away_threads.load() <= 0 || state.inside > 0) return;
  Host* const host = attached.load(std::memory_order_acquire);
  if (host == nullptr) return;
  const Inside inside;
  // For the same reason a library's thread does not wait here for long.
  VirtualTimeAccess::core(*host).call_back(what, all != 0, is_thinker());
}

constexpr PlaypenVirtualTimeHooks kHooks = {PLAYPEN_VIRTUAL_TIME_VERSION,
                                            on_sleep,
                                            on_now,
                                            on_begin_thread,
                                            on_thread_begun,
                                            on_thread_failed,
                                            on_begin_wait,
                                            on_end_wait,
                                            on_signalled};

int note_program(dl_phdr_info* info, std::size_t /*size*/, void* /*data*/) {
  program_begin = UINTPTR_MAX;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr;
    program_begin = std::min(program_begin, begin);
    program_end = std::max(program_end, begin + part.p_memsz);
  }
  return 1;  // the program comes first; its libraries do not matter
}

// Before main() and before the program's own static objects, which may look at the clock.
__attribute__((constructor(101))) void register_hooks() {
  void* const found = dlsym(RTLD_DEFAULT, PLAYPEN_VIRTUAL_TIME_REGISTER);
  if (found == nullptr) return;
  static_cast<void>(this_thinker());  // the main thread is the first
  dl_iterate_phdr(note_program, nullptr);
  registered = reinterpret_cast<PlaypenVirtualTimeRegister>(found)(&kHooks) != 0;
}

}  // namespace

bool active() noexcept { return registered && !given_up; }

Inside::Inside() noexcept { ++state.inside; }
Inside::~Inside() { --state.inside; }

StartsForProgram::StartsForProgram() noexcept { ++state.starts_for_program; }
StartsForProgram::~StartsForProgram() { --state.starts_for_program; }

StartsForLibraries::StartsForLibraries() noexcept { ++state.starts_for_libraries; }
StartsForLibraries::~StartsForLibraries() { --state.starts_for_libraries; }

void attach(const std::shared_ptr<Host>& host) {
  const std::lock_guard lock(lists_mutex);
  if (attached.load() != nullptr || !active()) return;
  kept_hosts().push_back(host);
  for (const ThinkerId thinker : early_threads())
    VirtualTimeAccess::core(*host).add_thread(thinker);
  early_threads().clear();
  attached.store(host.get(), std::memory_order_release);
}

void detach(const Host& host) noexcept {
  const std::lock_guard lock(lists_mutex);
  if (attached.load() != &host) return;
  offset_ns.fetch_add(VirtualTimeAccess::core(host).now_ns());
  attached.store(nullptr, std::memory_order_release);
}

// Called with a simulation locked, so without the lock over the lists.
void give_up() noexcept {
  static constinit std::atomic<bool> begun{false};
  if (begun.exchange(true)) return;
  last_ns = elapsed(state);
  last_real_ns = real_ns();
  given_up.store(true, std::memory_order_release);
}

void note_wait() noexcept {
  state.takes_part = true;
  state.asks = 0;
  state.looks = 0;
}

void note_look() noexcept {
  ThreadState& thread = state;
  ++thread.looks;
  const bool alone = !background.load(std::memory_order_relaxed);
  const long long free_looks = alone ? kFreeLooksAlone : kFreeLooks;
  if (thread.looks < free_looks) return;
  thread.looks = free_looks - (alone ? kLooksAStepAlone : kLooksAStep);
  Host* const host = attached.load(std::memory_order_acquire);
  if (thread.inside > 0 || thread.ended || given_up || host == nullptr) return;
  if (!thread.takes_part && (!alone || !(thread.programs || is_main(thread)))) return;
  pass(thread, *host, VirtualTimeAccess::core(*host).step_ns());
}

void note_background() noexcept { background = true; }

void note_thread_ends() noexcept {
  state.ended = true;
  const Inside inside;
  const std::lock_guard lock(lists_mutex);
  std::erase(early_threads(), this_thinker());
  if (Host* const host = attached.load()) {
    VirtualTimeAccess::core(*host).thinker_ended(this_thinker(),
                                                 reinterpret_cast<const void*>(pthread_self()));
  }
}

bool wait_until(const void* simulation, const std::function<bool()>& condition) {
  ThreadState& thread = state;
  Host* const host = attached.load(std::memory_order_acquire);
  if (!active() || host == nullptr || host != simulation || thread.ended || !thread.takes_part) {
    return false;
  }
  const sim::SimTime step_ns = VirtualTimeAccess::core(*host).step_ns();
  while (!condition()) {
    if (given_up || !pass(thread, *host, step_ns)) return false;
  }
  return true;
}

}  // namespace playerlike::virtual_time
