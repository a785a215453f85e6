// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace playerlike::server {

/// Slows down guessing of tokens by counting the wrong tokens of each address. The first ones,
/// which may be typing errors, cost some ms; the delay doubles with each further one. After
/// kMostOfAnAddress wrong tokens, right tokens from that address are delayed like wrong ones, so
/// that response times do not tell them apart. Used by the server's thread only. Header only, so
/// that the live page's process needs no library for it.
class TokenThrottle {
 public:
  using Clock = std::chrono::steady_clock;

  /// Wrong tokens after which a connection is closed.
  static constexpr int kMostOfAConnection = 5;
  /// Wrong tokens of an address after which its right tokens are delayed too.
  static constexpr int kMostOfAnAddress = 60;
  /// How long an address is remembered after its last wrong token.
  static constexpr std::chrono::seconds kMemory{60};
  /// Delay of the answer to the first wrong token. It doubles with each further one, up to
  /// kLongestDelay.
  static constexpr std::chrono::milliseconds kFirstDelay{25};
  static constexpr std::chrono::milliseconds kLongestDelay{5000};
  /// Maximum number of addresses; the least recently used one is evicted.
  static constexpr std::size_t kMostAddresses = 4096;

  /// Delay of the answer to a right token.
  /// @param peer  "ADDRESS:PORT".
  [[nodiscard]] std::chrono::milliseconds delay_of_right(const std::string& peer,
                                                         Clock::time_point now);

  /// The consequences of a wrong token.
  struct Cost {
    std::chrono::milliseconds delay{0};  ///< before its answer
    int count = 0;                       ///< recent wrong tokens of this address
    bool tell = false;                   ///< whether to log it: the 1st, 2nd, 4th, 8th ...
  };
  Cost note_wrong(const std::string& peer, Clock::time_point now);

 private:
  struct Address {
    int wrong = 0;
    Clock::time_point last{};
  };
  std::map<std::string, Address>::iterator find(const std::string& peer, Clock::time_point now);

  std::map<std::string, Address> addresses_;
};

inline std::map<std::string, TokenThrottle::Address>::iterator TokenThrottle::find(
    const std::string& peer, Clock::time_point now) {
  const auto it = addresses_.find(peer.substr(0, peer.rfind(':')));
  if (it == addresses_.end() || now - it->second.last < kMemory) return it;
  addresses_.erase(it);
  return addresses_.end();
}

inline std::chrono::milliseconds TokenThrottle::delay_of_right(const std::string& peer,
                                                               Clock::time_point now) {
  const auto it = find(peer, now);
  const bool suspect = it != addresses_.end() && it->second.wrong >= kMostOfAnAddress;
  return suspect ? kLongestDelay : std::chrono::milliseconds(0);
}

inline TokenThrottle::Cost TokenThrottle::note_wrong(const std::string& peer,
                                                     Clock::time_point now) {
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
