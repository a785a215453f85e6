// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/mirror/reconnection.h"

#include <exception>
#include <utility>

#include "process/system_threads.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

Reconnection::Reconnection(Connect connect) : connect_(std::move(connect)) {
  thread_ = std::thread([this] { attempt(); });
}

Reconnection::~Reconnection() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

std::unique_ptr<RealLink> Reconnection::take() {
  const std::lock_guard lock(mutex_);
  return std::move(link_);
}

void Reconnection::attempt() noexcept {
  leave_signals_to_program();
  const virtual_time::Inside inside;
  std::unique_lock lock(mutex_);
  while (!stopping_ && !link_) {
    lock.unlock();
    std::unique_ptr<RealLink> made;
    try {
      made = connect_();
    } catch (const std::exception&) {
      // The next attempt may succeed.
    }
    lock.lock();
    link_ = std::move(made);
    if (!link_) changed_.wait_for(lock, wall(kPause_s), [this] { return stopping_; });
  }
}

}  // namespace playerlike
