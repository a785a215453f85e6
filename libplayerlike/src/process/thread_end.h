// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

namespace playerlike {

/// What is done as a thread ends: it leaves virtual time, then it says goodbye to those that it has
/// waited on, so that nobody waits for it.
class ThreadEnd {
 public:
  ThreadEnd() = default;
  ThreadEnd(const ThreadEnd&) = delete;
  ThreadEnd& operator=(const ThreadEnd&) = delete;
  ~ThreadEnd();

  /// The calling thread's; null once it has ended: what is destroyed later is not remembered.
  [[nodiscard]] static ThreadEnd* mine();

  /// Calls that before any goodbye.
  void leave_by(void (*leave)()) noexcept { leave_ = leave; }
  /// Calls say(peer), unless nothing of the peer is left then. Once for each peer.
  /// @param say  must not throw.
  template <typename Peer>
  void say_goodbye(const std::shared_ptr<Peer>& peer, void (*say)(void* peer)) {
    for (const Goodbye& known : goodbyes_) {
      if (!known.peer.owner_before(peer) && !peer.owner_before(known.peer)) return;
    }
    std::erase_if(goodbyes_, [](const Goodbye& known) { return known.peer.expired(); });
    goodbyes_.push_back({peer, say});
  }

 private:
  struct Goodbye {
    std::weak_ptr<void> peer;
    void (*say)(void*);
  };

  void (*leave_)() = nullptr;
  std::vector<Goodbye> goodbyes_;
};

}  // namespace playerlike
