// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <variant>
#include <vector>

#include "sim/core/time.h"
#include "sim/devices/device.h"

namespace playerlike {

/// Whether a command is of one of these kinds.
template <typename... Kinds>
[[nodiscard]] bool is_one_of(const sim::Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

/// Notes who commands which robot to move, for the run's report. Guarded by the host's mutex.
class CommandBook {
 public:
  /// The commands to move a robot.
  struct Entry {
    std::optional<sim::SimTime> first_ns;  ///< when the first was executed; nullopt: there was none
    std::uint64_t count = 0;
    std::set<int> ports;  ///< ports of the clients that sent them
  };

  explicit CommandBook(std::size_t robots) : entries_(robots) {}

  /// Notes a command that is executed now. Commands that move nothing are ignored.
  void note(int robot, int port, const sim::Command& command, sim::SimTime now_ns);
  [[nodiscard]] const Entry& of(std::size_t robot) const { return entries_[robot]; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace playerlike
