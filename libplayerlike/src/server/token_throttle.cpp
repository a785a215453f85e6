// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/token_throttle.h"

#include <algorithm>

namespace playerlike::server {

std::map<std::string, TokenThrottle::Address>::iterator TokenThrottle::find(const std::string& peer,
                                                                            Clock::time_point now) {
  const auto it = addresses_.find(peer.substr(0, peer.rfind(':')));
  if (it == addresses_.end() || now - it->second.last < kMemory) return it;
  addresses_.erase(it);
  return addresses_.end();
}

std::chrono::milliseconds TokenThrottle::delay_of_right(const std::string& peer,
                                                        Clock::time_point now) {
  const auto it = find(peer, now);
  const bool suspect = it != addresses_.end() && it->second.wrong >= kMostOfAnAddress;
  return suspect ? kLongestDelay : std::chrono::milliseconds(0);
}

TokenThrottle::Cost TokenThrottle::note_wrong(const std::string& peer, Clock::time_point now) {
  auto it = find(peer, now);
  if (it == addresses_.end()) {
    if (addresses_.size() >= kMostAddresses) {
      addresses_.erase(std::min_element(
          addresses_.begin(), addresses_.end(),
          [](const auto& a, const auto& b) { return a.second.last < b.second.last; }));
    }
    it = addresses_.emplace(peer.substr(0, peer.rfind(':')), Address{}).first;
  }
  Address& address = it->second;
  ++address.wrong;
  address.last = now;
  Cost cost;
  cost.count = address.wrong;
  constexpr int kMostDoublings = 10;
  cost.delay =
      std::min(kFirstDelay * (1 << std::min(address.wrong - 1, kMostDoublings)), kLongestDelay);
  cost.tell = (address.wrong & (address.wrong - 1)) == 0;
  return cost;
}

}  // namespace playerlike::server
