// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace playerlike::server {

/// Slows down guessing of tokens by counting the wrong tokens of each address. The first ones,
/// which may be typing errors, cost some ms; the delay doubles with each further one. After
/// kMostOfAnAddress wrong tokens, right tokens from that address are delayed like wrong ones, so
/// that response times do not tell them apart. Used by the server's thread only.
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

}  // namespace playerlike::server
