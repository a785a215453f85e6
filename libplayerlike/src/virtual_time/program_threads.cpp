// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "virtual_time/program_threads.h"

#include <sys/single_threaded.h>

#include <atomic>

namespace playerlike {
namespace {

constinit std::atomic<ProgramThreads> before_own_threads{ProgramThreads::kNone};

}  // namespace

void note_own_threads() noexcept {
  ProgramThreads none = ProgramThreads::kNone;
  before_own_threads.compare_exchange_strong(
      none, __libc_single_threaded != 0 ? ProgramThreads::kUnknown : ProgramThreads::kSome);
}

ProgramThreads program_threads() noexcept {
  if (__libc_single_threaded != 0) return ProgramThreads::kNone;
  const ProgramThreads before = before_own_threads;
  return before == ProgramThreads::kNone ? ProgramThreads::kSome : before;
}

}  // namespace playerlike
