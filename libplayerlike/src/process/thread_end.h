// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

namespace playerlike {

/// Actions at the end of a thread: it leaves virtual time, then says goodbye to the peers that it
/// has waited on, so that nobody waits for it.
class ThreadEnd {
 public:
  ThreadEnd() = default;
  ThreadEnd(const ThreadEnd&) = delete;
  ThreadEnd& operator=(const ThreadEnd&) = delete;
  ~ThreadEnd();

  /// The calling thread's object; null once it has been destroyed at thread exit.
  [[nodiscard]] static ThreadEnd* mine();

  /// Sets a function to call before all goodbyes.
  void leave_by(void (*leave)()) noexcept { leave_ = leave; }
  /// Registers say(peer) for the end of the thread, once for each peer. It is skipped if the peer
  /// has been destroyed by then.
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
