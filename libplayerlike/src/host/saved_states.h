// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "sim/simulation/simulation.h"

namespace playerlike {

/// States of a simulation that clients have saved by name; all clients share them.
class SavedStates {
 public:
  static constexpr std::size_t kMostStates = 64;
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;  ///< of all states together
  static constexpr std::size_t kLongestName = 64;

  /// Saves a state; replaces an earlier one of this name. @throws SessionError kBadArgument for a
  /// name that is not 1 to kLongestName printable bytes; kNotAvailable if there is no room.
  void save(const std::string& name, const sim::Simulation& simulation);
  /// Restores a state of the world, see sim::RestoreScope::kWorld. @throws SessionError
  /// kBadArgument if there is no state of this name.
  void restore(const std::string& name, sim::Simulation& simulation) const;

 private:
  std::map<std::string, sim::Snapshot> states_;
  std::size_t bytes_ = 0;  ///< total size
};

}  // namespace playerlike
