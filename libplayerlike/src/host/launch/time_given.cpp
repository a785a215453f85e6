// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "playerlike/host/program.h"
#include "process/system_threads.h"

namespace playerlike {
namespace {

using std::chrono::nanoseconds;

// Of the time between two looks, more than this passed without the process that looks.
constexpr std::chrono::milliseconds kLongestLook(100);
constexpr std::chrono::milliseconds kNextToNothing(5);

/// Whether all threads of a process wait for an event or are stopped: none computes, or waits for a
/// processor or a disk.
bool sleeps(pid_t process, pid_t without) {
  std::error_code error;
  const std::string folder = "/proc/" + std::to_string(process) + "/task";
  for (std::filesystem::directory_iterator task(folder, error), end; !error && task != end;
       task.increment(error)) {
    if (task->path().filename() == std::to_string(without)) continue;
    std::ifstream file(task->path() / "stat");
    std::string stat;
    std::getline(file, stat);
    // The name before the state is in brackets, and may contain any character.
    const std::size_t bracket = stat.rfind(')');
    const char state = bracket + 2 < stat.size() ? stat[bracket + 2] : 'S';
    if (state == 'R' || state == 'D') return false;
  }
  return true;
}

/// The processor time of a process so far, without that of this thread, if it is one of it.
nanoseconds time_of_others(pid_t process, bool has_this_thread) {
  timespec own{};
  if (has_this_thread) clock_gettime(CLOCK_THREAD_CPUTIME_ID, &own);
  return processor_time(process).value_or(nanoseconds::zero()) -
         (std::chrono::seconds(own.tv_sec) + nanoseconds(own.tv_nsec));
}

}  // namespace

TimeGiven::TimeGiven(pid_t process, pid_t without) noexcept
    : process_(process), without_(without), last_cpu_(time_of_others(process, without != 0)) {}

void TimeGiven::look() {
  const auto now = std::chrono::steady_clock::now();
  const nanoseconds passed = std::min<nanoseconds>(now - last_look_, kLongestLook);
  last_look_ = now;
  const nanoseconds cpu = std::max(time_of_others(process_, without_ != 0), last_cpu_);
  const nanoseconds computed = cpu - last_cpu_;
  last_cpu_ = cpu;
  computed_ += computed;
  computed_idly_ += computed;
  const bool slept = sleeps(process_, without_);
  if (slept) slept_ += std::max(passed - computed, nanoseconds::zero());
  if (slept && computed_idly_ <= kNextToNothing) {
    idle_ += passed;
  } else {
    idle_ = computed_idly_ = nanoseconds::zero();
  }
}

}  // namespace playerlike
