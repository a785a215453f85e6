// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/busy_alarm.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <mutex>
#include <set>

namespace playerlike {
namespace {

constinit std::mutex mutex;  // guards timer
constinit timer_t timer{};
constinit std::atomic<bool> timer_runs{false};
// Read and written by the signal handler.
constinit std::atomic<const std::string*> alarm_text{nullptr};
constinit std::atomic<bool> rang{false};

/// Stores a text until the process ends, since the handler may run at any time. There are few
/// different texts.
const std::string& kept(const std::string& text) {
  static auto* const texts = new std::set<std::string>;
  return *texts->insert(text).first;
}

void on_busy(int /*signal*/) {
  const int error = errno;
  const std::string* const text = alarm_text.load();
  if (text != nullptr && !rang.exchange(true)) {
    static_cast<void>(!write(STDERR_FILENO, text->data(), text->size()));
  }
  errno = error;
}

}  // namespace

void set_busy_alarm(double cpu_s, const std::string& text) {
  const std::lock_guard lock(mutex);
  if (timer_runs || rang) return;
  struct sigaction present = {};
  if (sigaction(SIGURG, nullptr, &present) != 0) return;
  if (present.sa_handler != on_busy) {
    if (present.sa_handler != SIG_DFL) return;
    struct sigaction action = {};
    action.sa_handler = on_busy;
    action.sa_flags = SA_RESTART;
    if (sigaction(SIGURG, &action, nullptr) != 0) return;
  }
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGURG;
  if (timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer) != 0) return;
  alarm_text = &kept("playpen: warning: " + text + '\n');
  const double whole = std::floor(cpu_s);
  itimerspec times{};
  times.it_value = {static_cast<time_t>(whole), static_cast<long>(1e9 * (cpu_s - whole))};
  timer_settime(timer, 0, &times, nullptr);
  timer_runs = true;
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
