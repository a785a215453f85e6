// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/requests/blackboard.h"

#include "session/checks.h"

namespace playerlike {
namespace {

void require_name(const char* what, const std::string& name, std::size_t least) {
  const bool printable = is_printable(name);
  if (printable && name.size() >= least && name.size() <= Blackboard::kLongestName) return;
  std::string text = "a ";
  text += what;
  text += " of the blackboard has ";
  text += least > 0 ? "1 to " : "at most ";
  text += std::to_string(Blackboard::kLongestName) + " printable bytes, but this one has " +
          std::to_string(name.size());
  if (!printable) text += ", and not all of them are printable";
  throw SessionError(SessionError::Code::kBadArgument, text);
}

}  // namespace

void Blackboard::Table::put(const Name& name, Value value) {
  value.change = changes + 1;
  const auto place = by_change.emplace(value.change, name).first;
  try {
    const auto [known, is_new] = values.try_emplace(name);
    bytes += value.data.size();
    bytes -= known->second.data.size();
    if (is_new) {
      bytes += name.first.size() + name.second.size();
    } else {
      by_change.erase(known->second.change);
    }
    known->second = std::move(value);
  } catch (...) {
    by_change.erase(place);
    throw;
  }
  ++changes;
}

const Blackboard::Value* Blackboard::Table::find(const Name& name) const {
  const auto known = values.find(name);
  return known == values.end() ? nullptr : &known->second;
}

// The room that an entry needs in addition to its present value.
Blackboard::Room Blackboard::growth(const Name& name, std::size_t data_bytes) const {
  const Value* const known = entries_.find(name);
  if (known == nullptr) return {name.first.size() + name.second.size() + data_bytes, 1};
  return {data_bytes > known->data.size() ? data_bytes - known->data.size() : 0, 0};
}

void Blackboard::set(const SetBlackboardRequest& what, sim::SimTime now_ns, ThreadId thread) {
  require_name("group", what.group, 0);
  require_name("key", what.key, 1);
  if (what.data.size() > kMostData) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "an entry of the blackboard has at most " + std::to_string(kMostData) +
                           " bytes, but this one has " + std::to_string(what.data.size()));
  }
  const Name name(what.group, what.key);
  Room reserved = reserved_;
  const Value* const replaced = thread == 0 ? nullptr : find_waiting(name, thread);
  if (replaced != nullptr) {
    const Room freed = growth(name, replaced->data.size());
    reserved.bytes -= freed.bytes;
    reserved.entries -= freed.entries;
  }
  const Room added = growth(name, what.data.size());
  reserved.bytes += added.bytes;
  reserved.entries += added.entries;
  if (entries_.bytes + reserved.bytes > kMostBytes ||
      entries_.values.size() + reserved.entries > kMostEntries) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "the blackboard is full: it has room for " + std::to_string(kMostEntries) +
                           " entries of " + std::to_string(kMostBytes) + " bytes in all");
  }
  Value value{what.type, what.subtype, what.data, now_ns, 0};
  if (thread == 0) {
    entries_.put(name, std::move(value));
  } else {
    waiting_[thread].put(name, std::move(value));
    reserved_ = reserved;
  }
}

const Blackboard::Value* Blackboard::find_waiting(const Name& name, ThreadId thread) const {
  for (const auto& [owner, table] : waiting_) {
    if (thread != 0 && thread != owner) continue;
    if (const Value* const value = table.find(name)) return value;
  }
  return nullptr;
}

std::vector<BlackboardEntry> Blackboard::find(const BlackboardRequest& what,
                                              ThreadId thread) const {
  std::vector<BlackboardEntry> found;
  const auto add = [&](const Name& name, const Value& value, std::int64_t change) {
    found.push_back(
        {name.first, name.second, value.type, value.subtype, value.data, value.time_ns, change});
  };
  if (what.group && what.key && what.after == 0) {
    const Name name(*what.group, *what.key);
    if (const Value* const waiting = find_waiting(name, thread)) {
      add(name, *waiting, entries_.changes);
    } else if (const Value* const value = entries_.find(name)) {
      add(name, *value, value->change);
    }
    return found;
  }
  for (auto it = entries_.by_change.upper_bound(what.after); it != entries_.by_change.end(); ++it) {
    const Name& name = it->second;
    if ((what.group && *what.group != name.first) || (what.key && *what.key != name.second)) {
      continue;
    }
    add(name, entries_.values.at(name), it->first);
  }
  return found;
}

void Blackboard::publish(const std::vector<ThreadId>& order) {
  const auto publish_one = [this](Table& table) {
    for (const auto& [change, name] : table.by_change) {
      entries_.put(name, std::move(table.values.at(name)));
    }
  };
  for (const ThreadId thread : order) {
    const auto found = waiting_.find(thread);
    if (found == waiting_.end()) continue;
    publish_one(found->second);
    waiting_.erase(found);
  }
  for (auto& [thread, table] : waiting_) publish_one(table);
  waiting_.clear();
  reserved_ = {};
}

}  // namespace playerlike
