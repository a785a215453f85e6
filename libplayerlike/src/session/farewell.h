// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

namespace playerlike {

/// Says goodbye, as a thread ends, to those that the thread has waited on, so that nobody waits for
/// it. For a thread_local variable of a kind of session.
/// @tparam Peer  what the thread waits on; kept weakly.
template <typename Peer>
class Farewell {
 public:
  /// @param say  what to do with each that is still there; must not throw.
  explicit Farewell(void (*say)(Peer&)) : say_(say) {}
  Farewell(const Farewell&) = delete;
  Farewell& operator=(const Farewell&) = delete;
  ~Farewell() {
    said = true;
    for (const std::weak_ptr<Peer>& known : peers_) {
      if (const std::shared_ptr<Peer> peer = known.lock()) say_(*peer);
    }
  }

  /// Adds one, unless it is known already.
  void remember(const std::shared_ptr<Peer>& peer) {
    if (said) return;  // by what is destroyed later: nothing is left that could remember
    for (const std::weak_ptr<Peer>& known : peers_) {
      if (!known.owner_before(peer) && !peer.owner_before(known)) return;
    }
    std::erase_if(peers_, [](const auto& known) { return known.expired(); });
    peers_.push_back(peer);
  }

 private:
  void (*say_)(Peer&);
  std::vector<std::weak_ptr<Peer>> peers_;
  static inline constinit thread_local bool said = false;  // outlives the rest
};

}  // namespace playerlike
