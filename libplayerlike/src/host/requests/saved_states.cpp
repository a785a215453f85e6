// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/requests/saved_states.h"

#include <utility>

#include "playerlike/messages/messages.h"
#include "playerlike/session/session.h"
#include "session/checks.h"

namespace playerlike {

void SavedStates::require_place(const std::string& name) const {
  if (name.empty() || name.size() > kLongestName || !is_printable(name)) {
    throw SessionError(
        SessionError::Code::kBadArgument,
        "the name of a saved state has 1 to " + std::to_string(kLongestName) + " printable bytes");
  }
  if (!states_.contains(name) && states_.size() >= kMostStates) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       std::to_string(kMostStates) +
                           " states are saved, which is the most: save over one of them");
  }
}

void SavedStates::save(const std::string& name, std::shared_ptr<const sim::Snapshot>& state) {
  require_place(name);
  const auto before = states_.find(name);
  const std::size_t others = bytes_ - (before == states_.end() ? 0 : before->second->size());
  if (state->size() > kMostBytes - others) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "all saved states together have at most " +
                           std::to_string(kMostBytes >> 20) + " MiB: there is no room for one of " +
                           std::to_string(state->size() >> 20) + " MiB more");
  }
  bytes_ = others + state->size();
  states_[name].swap(state);
}

std::shared_ptr<const sim::Snapshot> SavedStates::find(const std::string& name) const {
  const auto found = states_.find(name);
  if (found != states_.end()) return found->second;
  std::string known;
  for (const auto& [other, state] : states_) known += (known.empty() ? "" : ", ") + other;
  throw SessionError(
      SessionError::Code::kBadArgument,
      "no state was saved as \"" + name + "\"; there are: " + (known.empty() ? "none" : known));
}

}  // namespace playerlike
