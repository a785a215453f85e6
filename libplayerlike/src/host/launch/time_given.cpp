// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
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

}  // namespace

TimeGiven::TimeGiven(pid_t process, pid_t without) noexcept
    : process_(process),
      without_(without),
      last_cpu_(processor_time(process).value_or(nanoseconds::zero())) {}

void TimeGiven::look() {
  const auto now = std::chrono::steady_clock::now();
  const nanoseconds passed = std::min<nanoseconds>(now - last_look_, kLongestLook);
  last_look_ = now;
  const nanoseconds cpu = processor_time(process_).value_or(last_cpu_);
  const nanoseconds computed = std::max(cpu - last_cpu_, nanoseconds::zero());
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
