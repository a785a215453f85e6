// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "devices/errors.h"
#include "libplayerc++/blackboardproxy.h"
#include "proxies/link.h"

namespace PlayerCc {

using playerlike::BlackboardEntry;
using playerlike::BlackboardRequest;

/// Changes that were read and not delivered yet. A handler may delete the proxy.
struct BlackBoardProxy::Events {
  std::vector<BlackboardEntry> waiting;
  bool gone = false;
};

namespace {

constexpr const char* kNullText = "a group or key is a null pointer";

std::string text_of(const char* fun, const char* text) {
  if (text == nullptr) playerlike::refuse(fun, kNullText);
  return text;
}

/// An entry in Player's struct, which shows the bytes of another one.
player_blackboard_entry_t shown(BlackboardEntry& entry) {
  player_blackboard_entry_t out = {};
  out.key = entry.key.data();
  out.key_count = static_cast<uint32_t>(entry.key.size() + 1);
  out.group = entry.group.data();
  out.group_count = static_cast<uint32_t>(entry.group.size() + 1);
  out.type = static_cast<uint16_t>(entry.type);
  out.subtype = static_cast<uint16_t>(entry.subtype);
  out.data = entry.data.data();
  out.data_count = static_cast<uint32_t>(entry.data.size());
  out.timestamp_sec = static_cast<uint32_t>(entry.time_ns / sim::kNanosecondsPerSecond);
  out.timestamp_usec = static_cast<uint32_t>(entry.time_ns % sim::kNanosecondsPerSecond / 1000);
  return out;
}

/// Bytes that free() takes; never null.
void* copied(const void* from, std::size_t count) {
  void* const to = std::malloc(std::max<std::size_t>(count, 1));
  if (to == nullptr) throw std::bad_alloc();
  if (count > 0) std::memcpy(to, from, count);
  return to;
}

/// A copy for the caller, who frees it.
player_blackboard_entry_t* owned(BlackboardEntry entry) {
  player_blackboard_entry_t out = shown(entry);
  out.key = static_cast<char*>(copied(out.key, out.key_count));
  out.group = static_cast<char*>(copied(out.group, out.group_count));
  out.data = static_cast<uint8_t*>(copied(out.data, out.data_count));
  return static_cast<player_blackboard_entry_t*>(copied(&out, sizeof out));
}

/// The entry as it is now; of type 0 if it was never set.
BlackboardEntry entry_now(playerlike::Session& session, const std::string& group,
                          const std::string& key) {
  std::vector<BlackboardEntry> found = session.request(BlackboardRequest{0, group, key});
  if (!found.empty()) return std::move(found.front());
  BlackboardEntry none;
  none.group = group;
  none.key = key;
  return none;
}

}  // namespace

BlackBoardProxy::BlackBoardProxy(PlayerClient* aPc, uint32_t aIndex)
    : ClientProxy(aPc, aIndex), mEvents(std::make_shared<Events>()) {
  const char* fun = "BlackBoardProxy::BlackBoardProxy";
  Attach(PLAYER_BLACKBOARD_CODE, aIndex, fun, false);
  {
    const scoped_lock_t lock(LockData(fun));
    Poll();
  }
  ConnectReadSignal([this] { DeliverEvents(); });
}

BlackBoardProxy::~BlackBoardProxy() {
  mEvents->gone = true;
  ClientProxy::Unsubscribe();
}

player_blackboard_entry_t* BlackBoardProxy::SubscribeToKey(const char* key, const char* group) {
  const char* fun = "BlackBoardProxy::SubscribeToKey";
  const Name name(text_of(fun, group), text_of(fun, key));
  const scoped_lock_t lock(LockData(fun));
  return playerlike::translated(fun, [&] {
    BlackboardEntry entry = entry_now(mLink->core->session(), name.first, name.second);
    mKeys[name] = entry.change;
    return owned(std::move(entry));
  });
}

void BlackBoardProxy::UnsubscribeFromKey(const char* key, const char* group) {
  const char* fun = "BlackBoardProxy::UnsubscribeFromKey";
  const Name name(text_of(fun, group), text_of(fun, key));
  const scoped_lock_t lock(LockData(fun));
  mKeys.erase(name);
}

void BlackBoardProxy::SubscribeToGroup(const char* key) {
  const char* fun = "BlackBoardProxy::SubscribeToGroup";
  const std::string group = text_of(fun, key);
  const scoped_lock_t lock(LockData(fun));
  mGroups.emplace(group, 0);
}

void BlackBoardProxy::UnsubscribeFromGroup(const char* group) {
  const char* fun = "BlackBoardProxy::UnsubscribeFromGroup";
  const std::string name = text_of(fun, group);
  const scoped_lock_t lock(LockData(fun));
  mGroups.erase(name);
}

void BlackBoardProxy::SetEntry(const player_blackboard_entry_t& entry) {
  const char* fun = "BlackBoardProxy::SetEntry";
  playerlike::SetBlackboardRequest what;
  what.group = text_of(fun, entry.group);
  what.key = text_of(fun, entry.key);
  what.type = entry.type;
  what.subtype = entry.subtype;
  if (entry.data_count > 0) {
    if (entry.data == nullptr) playerlike::refuse(fun, "the data are a null pointer");
    what.data.assign(entry.data, entry.data + entry.data_count);
  }
  const scoped_lock_t lock(LockData(fun));
  playerlike::translated(fun, [&] { mLink->core->session().request(what); });
}

player_blackboard_entry_t* BlackBoardProxy::GetEntry(const char* key, const char* group) {
  const char* fun = "BlackBoardProxy::GetEntry";
  const Name name(text_of(fun, group), text_of(fun, key));
  const scoped_lock_t lock(LockData(fun));
  return playerlike::translated(
      fun, [&] { return owned(entry_now(mLink->core->session(), name.first, name.second)); });
}

void BlackBoardProxy::SetEventHandler(void (*handler)(playerc_blackboard_t*,
                                                      player_blackboard_entry_t)) {
  SetEventFunction(handler == nullptr ? EventHandler()
                                      : [handler](const player_blackboard_entry_t& entry) {
                                          handler(nullptr, entry);
                                        });
}

void BlackBoardProxy::SetEventFunction(EventHandler handler) {
  const scoped_lock_t lock(LockData("BlackBoardProxy::SetEventHandler"));
  mHandler = std::move(handler);
}

bool BlackBoardProxy::HandlePoll() {
  if (mKeys.empty() && mGroups.empty()) return false;
  // Changes up to the least of these have all been reported.
  int64_t after = INT64_MAX;
  for (const auto& key : mKeys) after = std::min(after, key.second);
  for (const auto& group : mGroups) after = std::min(after, group.second);
  playerlike::Session& session = mLink->core->session();
  const std::vector<BlackboardEntry> changes = session.request(BlackboardRequest{after});
  bool is_new = false;
  for (const BlackboardEntry& entry : changes) {
    const auto key = mKeys.find({entry.group, entry.key});
    const auto group = mGroups.find(entry.group);
    const bool by_key = key != mKeys.end() && entry.change > key->second;
    const bool by_group = group != mGroups.end() && entry.change > group->second;
    if (by_key || by_group) mEvents->waiting.push_back(entry);
    is_new = is_new || by_key || by_group;
  }
  if (!changes.empty()) {
    const int64_t newest = changes.back().change;
    for (auto& key : mKeys) key.second = std::max(key.second, newest);
    for (auto& group : mGroups) group.second = std::max(group.second, newest);
  }
  if (is_new) {
    mLink->refresh(sim::to_seconds(mEvents->waiting.back().time_ns));
    mFresh = true;
  }
  return is_new;
}

void BlackBoardProxy::DeliverEvents() {
  const std::shared_ptr<Events> events = mEvents;  // outlives the proxy
  std::vector<BlackboardEntry> entries;
  EventHandler handler;
  {
    const scoped_lock_t lock(mLink->core->mutex());
    entries.swap(events->waiting);
    handler = mHandler;
  }
  if (!handler) return;
  for (BlackboardEntry& entry : entries) {
    handler(shown(entry));
    if (events->gone) return;
  }
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::BlackBoardProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << '\n';
}

}  // namespace std
