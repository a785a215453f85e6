// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "sim/simulation/simulation.h"

namespace playerlike {

/// States of a simulation that clients have saved by name; all clients share them.
class SavedStates {
 public:
  static constexpr std::size_t kMostStates = 64;
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;  ///< of all states together
  static constexpr std::size_t kLongestName = 64;

  /// Throws SessionError kBadArgument for a name that is not 1 to kLongestName printable bytes, and
  /// kNotAvailable if no further state can be saved.
  void require_place(const std::string& name) const;
  /// Saves a state. An earlier one of this name is replaced, and moved into `state`: its memory may
  /// take a while to free.
  /// @throws SessionError as require_place(); kNotAvailable if there is no room.
  void save(const std::string& name, std::shared_ptr<const sim::Snapshot>& state);
  /// @throws SessionError kBadArgument if there is no state of this name.
  [[nodiscard]] std::shared_ptr<const sim::Snapshot> find(const std::string& name) const;

 private:
  std::map<std::string, std::shared_ptr<const sim::Snapshot>> states_;
  std::size_t bytes_ = 0;  ///< total size
};

}  // namespace playerlike
