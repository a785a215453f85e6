// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/saved_states.h"

#include <utility>

#include "playerlike/messages/messages.h"
#include "playerlike/session/session.h"
#include "session/checks.h"

namespace playerlike {

void SavedStates::save(const std::string& name, const sim::Simulation& simulation) {
  if (name.empty() || name.size() > kLongestName || !is_printable(name)) {
    throw SessionError(
        SessionError::Code::kBadArgument,
        "the name of a saved state has 1 to " + std::to_string(kLongestName) + " printable bytes");
  }
  const auto before = states_.find(name);
  if (before == states_.end() && states_.size() >= kMostStates) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       std::to_string(kMostStates) +
                           " states are saved, which is the most: save over one of them");
  }
  sim::Snapshot state = simulation.save();
  const std::size_t others = bytes_ - (before == states_.end() ? 0 : before->second.size());
  if (state.size() > kMostBytes - others) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "all saved states together have at most " +
                           std::to_string(kMostBytes >> 20) + " MiB: there is no room for one of " +
                           std::to_string(state.size() >> 20) + " MiB more");
  }
  bytes_ = others + state.size();
  states_[name] = std::move(state);
}

void SavedStates::restore(const std::string& name, sim::Simulation& simulation) const {
  const auto found = states_.find(name);
  if (found == states_.end()) {
    std::string known;
    for (const auto& [other, state] : states_) known += (known.empty() ? "" : ", ") + other;
    throw SessionError(
        SessionError::Code::kBadArgument,
        "no state was saved as \"" + name + "\"; there are: " + (known.empty() ? "none" : known));
  }
  simulation.restore(found->second, sim::RestoreScope::kWorld);
}

}  // namespace playerlike
