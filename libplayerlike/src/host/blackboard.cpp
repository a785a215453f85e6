// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/blackboard.h"

#include "session/checks.h"

namespace playerlike {
namespace {

void require_name(const char* what, const std::string& name, std::size_t least) {
  const bool printable = is_printable(name);
  if (printable && name.size() >= least && name.size() <= Blackboard::kLongestName) return;
  throw SessionError(
      SessionError::Code::kBadArgument,
      std::string("a ") + what + " of the blackboard has " + (least > 0 ? "1 to " : "at most ") +
          std::to_string(Blackboard::kLongestName) + " printable bytes, but this has " +
          std::to_string(name.size()) + (printable ? "" : ", not all printable"));
}

}  // namespace

void Blackboard::set(const SetBlackboardRequest& what, sim::SimTime now_ns) {
  require_name("group", what.group, 0);
  require_name("key", what.key, 1);
  if (what.data.size() > kMostData) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "an entry of the blackboard has at most " + std::to_string(kMostData) +
                           " bytes, but this has " + std::to_string(what.data.size()));
  }
  const Name name(what.group, what.key);
  const auto known = values_.find(name);
  const std::size_t names = known == values_.end() ? what.group.size() + what.key.size() : 0;
  const std::size_t before = known == values_.end() ? 0 : known->second.data.size();
  const std::size_t bytes = bytes_ - before + what.data.size() + names;
  if (bytes > kMostBytes || (known == values_.end() && values_.size() == kMostEntries)) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "the blackboard is full: it has room for " + std::to_string(kMostEntries) +
                           " entries of " + std::to_string(kMostBytes) + " bytes in all");
  }
  bytes_ = bytes;
  Value& value = values_[name];
  by_change_.erase(value.change);
  value = {what.type, what.subtype, what.data, now_ns, ++changes_};
  by_change_.emplace(value.change, name);
}

std::vector<BlackboardEntry> Blackboard::find(const BlackboardRequest& what) const {
  std::vector<BlackboardEntry> found;
  for (auto it = by_change_.upper_bound(what.after); it != by_change_.end(); ++it) {
    const auto& [group, key] = it->second;
    if ((what.group && *what.group != group) || (what.key && *what.key != key)) continue;
    const Value& value = values_.at(it->second);
    found.push_back(
        {group, key, value.type, value.subtype, value.data, value.time_ns, value.change});
  }
  return found;
}

}  // namespace playerlike
