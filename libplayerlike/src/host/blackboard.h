// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/messages/requests.h"

namespace playerlike {

/// Values by group and key that all clients of a host share. They are the host's, not the world's:
/// a restored state leaves them as they are. Has no lock; its owner's mutex guards it.
class Blackboard {
 public:
  static constexpr std::size_t kLongestName = 255;        ///< of a group or key [bytes]
  static constexpr std::size_t kMostData = 64 * 1024;     ///< of an entry [bytes]
  static constexpr std::size_t kMostBytes = 1024 * 1024;  ///< of all entries
  static constexpr std::size_t kMostEntries = 4096;

  /// Sets an entry, at simulated time `now_ns`.
  /// @throws SessionError as SetBlackboardRequest.
  void set(const SetBlackboardRequest& what, sim::SimTime now_ns);
  /// @return the entries that are asked for, in the order of their changes.
  [[nodiscard]] std::vector<BlackboardEntry> find(const BlackboardRequest& what) const;

 private:
  struct Value {
    int type = 0;
    int subtype = 0;
    std::vector<std::uint8_t> data;
    sim::SimTime time_ns = 0;
    std::int64_t change = 0;
  };
  using Name = std::pair<std::string, std::string>;  // group and key

  std::map<Name, Value> values_;
  std::map<std::int64_t, Name> by_change_;
  std::size_t bytes_ = 0;
  std::int64_t changes_ = 0;
};

}  // namespace playerlike
