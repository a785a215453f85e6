// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/blackboard_feed.h"

#include <algorithm>
#include <set>

namespace playerlike {

BlackboardEntry BlackboardFeed::entry_now(Session& session, const Name& name) {
  std::vector<BlackboardEntry> found =
      session.request(BlackboardRequest{0, name.first, name.second});
  return found.empty() ? BlackboardEntry{} : std::move(found.front());
}

BlackboardEntry BlackboardFeed::subscribe_to_key(Session& session, const Name& name) {
  BlackboardEntry entry = entry_now(session, name);
  keys_[name] = entry.change;
  entry.group = name.first;  // as in Player, also if the entry was never set
  entry.key = name.second;
  return entry;
}

void BlackboardFeed::subscribe_to_group(Session& session, const std::string& group) {
  // changes() would throw in a private world, so ask now: no change has a greater number.
  static_cast<void>(session.request(BlackboardRequest{INT64_MAX, group}));
  groups_.emplace(group, 0);
}

std::vector<BlackboardEntry> BlackboardFeed::changes(Session& session) {
  if (keys_.empty() && groups_.empty()) return {};
  // All changes up to `after` have been reported. Programs usually subscribe within one group; then
  // the entries of other groups are not transferred.
  BlackboardRequest what;
  what.after = INT64_MAX;
  std::set<std::string> names;
  for (const auto& key : keys_) {
    what.after = std::min(what.after, key.second);
    names.insert(key.first.first);
  }
  for (const auto& group : groups_) {
    what.after = std::min(what.after, group.second);
    names.insert(group.first);
  }
  if (names.size() == 1) what.group = *names.begin();
  std::vector<BlackboardEntry> changed = session.request(what);
  if (changed.empty()) return changed;
  const std::int64_t newest = changed.back().change;
  std::erase_if(changed, [&](const BlackboardEntry& entry) {
    const auto key = keys_.find({entry.group, entry.key});
    const auto group = groups_.find(entry.group);
    const bool by_key = key != keys_.end() && entry.change > key->second;
    const bool by_group = group != groups_.end() && entry.change > group->second;
    return !by_key && !by_group;
  });
  for (auto& key : keys_) key.second = std::max(key.second, newest);
  for (auto& group : groups_) group.second = std::max(group.second, newest);
  return changed;
}

}  // namespace playerlike
