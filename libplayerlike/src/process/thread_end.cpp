// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/thread_end.h"

namespace playerlike {
namespace {

constinit thread_local bool ended = false;  // no destructor: valid during thread exit
thread_local ThreadEnd own_end;

}  // namespace

ThreadEnd* ThreadEnd::mine() { return ended ? nullptr : &own_end; }

ThreadEnd::~ThreadEnd() {
  ended = true;
  if (leave_ != nullptr) leave_();
  for (const Goodbye& known : goodbyes_) {
    if (const std::shared_ptr<void> peer = known.peer.lock()) known.say(peer.get());
  }
}

}  // namespace playerlike
