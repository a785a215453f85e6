// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/system_threads.h"

#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace playerlike {

void leave_signals_to_program() noexcept {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

pid_t this_thread() noexcept { return static_cast<pid_t>(syscall(SYS_gettid)); }

std::optional<std::chrono::nanoseconds> processor_time(pid_t process) noexcept {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) {
    return std::nullopt;
  }
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

std::optional<std::uint64_t> sleeps_since(pid_t thread) {
  std::ifstream status("/proc/self/task/" + std::to_string(thread) + "/status");
  bool asleep = false;
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("State:")) asleep = line.find("S (") != std::string::npos;
    constexpr std::string_view kSwitches = "voluntary_ctxt_switches:";
    if (asleep && line.starts_with(kSwitches)) {
      return std::strtoull(line.c_str() + kSwitches.size(), nullptr, 10);
    }
  }
  return std::nullopt;
}

}  // namespace playerlike
