// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace playerlike::server {

/// Slows down those who guess tokens. Counts wrong tokens by the address that they come from: the
/// first ones cost some ms, as a slip may happen, later ones more and more. After many in a minute
/// right tokens from that address are answered as late as wrong ones, so that nobody can tell by
/// the time which of his guesses to give up. Used by the server's thread only.
class TokenGuard {
 public:
  using Clock = std::chrono::steady_clock;

  /// Wrong tokens after which a connection is closed.
  static constexpr int kMostOfAConnection = 5;
  /// Wrong tokens after which right ones of the address have to wait, too.
  static constexpr int kMostOfAnAddress = 60;
  /// How long an address is remembered after its last wrong token.
  static constexpr std::chrono::seconds kMemory{60};
  /// Of the answer to the first wrong token; each further one takes twice as long, up to the
  /// second.
  static constexpr std::chrono::milliseconds kFirstDelay{25};
  static constexpr std::chrono::milliseconds kLongestDelay{5000};
  /// Addresses that are remembered; the one heard of longest ago makes room.
  static constexpr std::size_t kMostAddresses = 4096;

  /// How long the answer to a right token takes.
  /// @param peer  "ADDRESS:PORT".
  [[nodiscard]] std::chrono::milliseconds delay_of_right(const std::string& peer,
                                                         Clock::time_point now);

  /// What a wrong token costs.
  struct Cost {
    std::chrono::milliseconds delay{0};  ///< of its answer
    int count = 0;                       ///< wrong ones of this address in the last while
    bool tell = false;                   ///< whether the log is told: of the 1st, 2nd, 4th, 8th ...
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
