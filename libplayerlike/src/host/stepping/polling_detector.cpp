// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/polling_detector.h"

#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "process/system_threads.h"

namespace playerlike {
namespace {

// Number of voluntary context switches of the calling thread.
long own_sleeps() {
  rusage usage{};
  return getrusage(RUSAGE_THREAD, &usage) == 0 ? usage.ru_nvcsw : 0;
}

}  // namespace

void PollingDetector::begin_at(sim::SimTime now_ns) {
  *this = PollingDetector();
  since_ns_ = now_ns;
}

bool PollingDetector::note(sim::SimTime now_ns, double weight) {
  if (now_ns != since_ns_) begin_at(now_ns);
  used_ += weight;
  return used_ >= next_check_;
}

bool PollingDetector::note_command(sim::SimTime now_ns, double weight, double weight_after_sleep) {
  if (now_ns != since_ns_) begin_at(now_ns);
  // The first command does not count as one after a sleep: most programs send one command and read.
  // Without this, each step of theirs would cost a system call.
  if (std::exchange(commanded_, true)) {
    const long sleeps = own_sleeps();
    const long before = std::exchange(own_sleeps_, sleeps);
    if (before >= 0 && sleeps != before) weight = weight_after_sleep;
  }
  return note(now_ns, weight);
}

bool PollingDetector::check(sim::SimTime now_ns) {
  if (now_ns != since_ns_) return false;
  postpone();
  const std::optional<Sleepers> before = std::move(sleepers_);
  sleepers_ = sleepers();
  return used_ >= 1.0 && sleepers_ && sleepers_ == before;
}

std::optional<PollingDetector::Sleepers> PollingDetector::sleepers() {
  Sleepers found;
  std::error_code error;
  const pid_t self = this_thread();
  std::filesystem::directory_iterator tasks("/proc/self/task", error);
  for (; !error && tasks != std::filesystem::directory_iterator(); tasks.increment(error)) {
    const auto thread = static_cast<pid_t>(std::atol(tasks->path().filename().string().c_str()));
    if (thread == self) continue;
    const std::optional<std::uint64_t> sleeps = sleeps_since(thread);
    if (!sleeps) return std::nullopt;
    found[thread] = *sleeps;
  }
  if (error) return std::nullopt;
  return found;
}

}  // namespace playerlike
