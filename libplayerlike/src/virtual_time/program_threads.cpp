// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "virtual_time/program_threads.h"

#include <dirent.h>
#include <sys/prctl.h>
#include <sys/single_threaded.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>

namespace playerlike {
namespace {

constexpr const char* kOwnName = "playpen-own";

constinit std::atomic<bool> has_own_threads{false};
constinit std::atomic<bool> has_program_threads{false};

/// Whether a thread lives that is neither the process's first one nor this library's.
bool finds_program_thread() {
  DIR* const tasks = opendir("/proc/self/task");
  if (tasks == nullptr) return false;
  bool found = false;
  while (const dirent* task = readdir(tasks)) {
    const long thread = std::strtol(task->d_name, nullptr, 10);
    if (thread <= 0 || thread == getpid()) continue;
    std::ifstream file("/proc/self/task/" + std::string(task->d_name) + "/comm");
    std::string name;
    found = std::getline(file, name) && name != kOwnName;
    if (found) break;
  }
  closedir(tasks);
  return found;
}

}  // namespace

StartsOwnThreads::StartsOwnThreads() noexcept {
  if (!has_own_threads.exchange(true) && __libc_single_threaded == 0) has_program_threads = true;
  prctl(PR_GET_NAME, name_.data());
  prctl(PR_SET_NAME, kOwnName);
}

StartsOwnThreads::~StartsOwnThreads() { prctl(PR_SET_NAME, name_.data()); }

bool program_has_threads() noexcept {
  if (__libc_single_threaded != 0) return false;
  if (!has_own_threads || has_program_threads) return true;
  // It is called in each step, and a look takes some microseconds.
  constexpr unsigned kCallsPerLook = 32;
  static constinit std::atomic<unsigned> calls{0};
  if (calls.fetch_add(1) % kCallsPerLook != 0) return false;
  try {
    if (finds_program_thread()) has_program_threads = true;
  } catch (...) {
    // Out of memory or of descriptors; the next look may succeed.
  }
  return has_program_threads;
}

}  // namespace playerlike
