// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/launch/busy_alarm.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <mutex>
#include <set>
#include <string_view>

#include "process/debugger.h"
#include "process/system_threads.h"

namespace playerlike {
namespace {

constinit std::mutex mutex;  // guards timer
constinit timer_t timer{};
constinit std::atomic<bool> timer_runs{false};
// Read and written by the signal handler.
constinit std::atomic<const std::string*> alarm_text{nullptr};
constinit std::atomic<const std::string*> alarm_end{
    nullptr};  // null: the text is the whole message
constinit std::atomic<bool> rang{false};
constinit std::atomic<sim::SimTime> last_step_ns{0};
constinit std::atomic<sim::SimTime> seen_step_ns{-1};  // when the handler last ran
constinit std::atomic<int> quiet_periods{0};
constinit std::atomic<double> alarm_limit_s{0.0};

constexpr int kQuietPeriods = 2;

/// Stores a text until the process ends, since the handler may run at any time. There are few
/// different texts.
const std::string& kept(const std::string& text) {
  static auto* const texts = new std::set<std::string>;
  return *texts->insert(text).first;
}

void print(std::string_view text) noexcept {
  static_cast<void>(!write(STDERR_FILENO, text.data(), text.size()));
}

/// Prints seconds with two decimals; for signal handlers.
void print_seconds(sim::SimTime time_ns) noexcept {
  std::array<char, 32> digits{};
  std::size_t first = digits.size();
  sim::SimTime rest = time_ns / 10'000'000;
  for (int decimals = 0; rest > 0 || decimals < 3; ++decimals) {
    if (decimals == 2) digits.at(--first) = '.';
    digits.at(--first) = static_cast<char>('0' + rest % 10);
    rest /= 10;
  }
  print({digits.data() + first, digits.size() - first});
}

timespec time_of(double time_s) {
  const double whole = std::floor(time_s);
  return {static_cast<time_t>(whole), static_cast<long>(1e9 * (time_s - whole))};
}

/// Starts the timer; for signal handlers, too. @param period_s  0: it rings once.
void start_timer(double first_s, double period_s) noexcept {
  itimerspec times{};
  times.it_value = time_of(first_s);
  times.it_interval = time_of(period_s);
  timer_settime(timer, 0, &times, nullptr);
}

void on_busy(int /*signal*/) {
  const int error = errno;
  const std::string* const text = alarm_text.load();
  // A debugger steps slowly, and its user sees where the program is.
  if (text != nullptr && tracer_of(0) != 0) {
    quiet_periods = 0;
    if (alarm_end.load() == nullptr) start_timer(alarm_limit_s, 0.0);
    errno = error;
    return;
  }
  const std::string* const end = alarm_end.load();
  bool is_due = text != nullptr;
  if (end != nullptr) {
    const sim::SimTime step_ns = last_step_ns;
    const bool is_quiet = seen_step_ns.exchange(step_ns) == step_ns;
    quiet_periods = is_quiet ? quiet_periods + 1 : 0;
    is_due = is_due && quiet_periods >= kQuietPeriods;
  }
  if (is_due && !rang.exchange(true)) {
    print(*text);
    if (end != nullptr) {
      print_seconds(last_step_ns);
      print(*end);
    }
  }
  errno = error;
}

/// Handles SIGURG. @return false if the program does.
bool take_signal() {
  struct sigaction present = {};
  if (sigaction(SIGURG, nullptr, &present) != 0) return false;
  if (present.sa_handler == on_busy) return true;
  if (present.sa_handler != SIG_DFL) return false;
  struct sigaction action = {};
  action.sa_handler = on_busy;
  action.sa_flags = SA_RESTART;
  return sigaction(SIGURG, &action, nullptr) == 0;
}

constexpr const char* kPrefix = "playpen: warning: ";

}  // namespace

void set_busy_alarm(double cpu_s, const std::string& text) {
  const std::lock_guard lock(mutex);
  if (timer_runs || rang || !take_signal()) return;
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGURG;
  if (timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer) != 0) return;
  alarm_end = nullptr;
  alarm_text = &kept(kPrefix + text + '\n');
  alarm_limit_s = cpu_s;
  start_timer(cpu_s, 0.0);
  timer_runs = true;
}

void set_standstill_alarm(double cpu_s, const std::string& text, const std::string& end) {
  const std::lock_guard lock(mutex);
  if (timer_runs || rang || !take_signal()) return;
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = SIGURG;
  event._sigev_un._tid = this_thread();
  if (timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &timer) != 0) return;
  quiet_periods = 0;
  alarm_end = &kept(end + '\n');
  alarm_text = &kept(kPrefix + text);
  start_timer(cpu_s / kQuietPeriods, cpu_s / kQuietPeriods);
  timer_runs = true;
}

void note_step_for_alarm(sim::SimTime now_ns) noexcept {
  last_step_ns.store(now_ns, std::memory_order_relaxed);
}

void dismiss_busy_alarm() noexcept {
  if (!timer_runs) return;
  const std::lock_guard lock(mutex);
  if (!timer_runs) return;
  timer_runs = false;
  alarm_text = nullptr;
  timer_delete(timer);
}

bool busy_alarm_rang() noexcept { return rang; }

}  // namespace playerlike
