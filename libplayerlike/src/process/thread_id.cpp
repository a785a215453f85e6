// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/process/thread_id.h"

#include <atomic>

namespace playerlike {
namespace {

constinit thread_local ThreadId own_thread_id = 0;

}  // namespace

ThreadId new_thread_id() noexcept {
  static std::atomic<ThreadId> last{0};
  return ++last;
}

ThreadId this_thread_id() noexcept {
  if (own_thread_id == 0) own_thread_id = new_thread_id();
  return own_thread_id;
}

bool has_thread_id() noexcept { return own_thread_id != 0; }

void set_this_thread_id(ThreadId thread_id) noexcept { own_thread_id = thread_id; }

}  // namespace playerlike
