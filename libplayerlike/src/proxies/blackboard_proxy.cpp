// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/blackboardproxy.h"
#include "proxies/link.h"
#include "session/blackboard_feed.h"

namespace PlayerCc {

using playerlike::BlackboardEntry;
using Name = playerlike::BlackboardFeed::Name;

/// The subscriptions, and changes that were read, but not delivered to the handler yet. A handler
/// may delete the proxy.
struct BlackBoardProxy::Events {
  playerlike::BlackboardFeed feed;       ///< guarded by the client's mutex
  std::vector<BlackboardEntry> waiting;  ///< guarded by the client's mutex
  std::atomic<bool> proxy_deleted{false};
};

namespace {

constexpr const char* kNullText = "a group or key is a null pointer";

std::string text_of(const char* fun, const char* text) {
  if (text == nullptr) playerlike::refuse(fun, kNullText);
  return text;
}

/// Returns Player's struct with pointers into `entry`.
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

/// Returns a copy of the bytes that free() accepts; never null.
void* copied(const void* from, std::size_t count) {
  void* const to = std::malloc(std::max<std::size_t>(count, 1));
  if (to == nullptr) throw std::bad_alloc();
  if (count > 0) std::memcpy(to, from, count);
  return to;
}

/// Returns a copy that the caller frees.
player_blackboard_entry_t* owned(BlackboardEntry entry) {
  using Bytes = std::unique_ptr<void, decltype(&std::free)>;
  player_blackboard_entry_t out = shown(entry);
  Bytes key(copied(out.key, out.key_count), &std::free);
  Bytes group(copied(out.group, out.group_count), &std::free);
  Bytes data(copied(out.data, out.data_count), &std::free);
  out.key = static_cast<char*>(key.get());
  out.group = static_cast<char*>(group.get());
  out.data = static_cast<uint8_t*>(data.get());
  auto* const owned_entry = static_cast<player_blackboard_entry_t*>(copied(&out, sizeof out));
  static_cast<void>(key.release());
  static_cast<void>(group.release());
  static_cast<void>(data.release());
  return owned_entry;
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
  mEvents->proxy_deleted = true;
  ClientProxy::Unsubscribe();
}

player_blackboard_entry_t* BlackBoardProxy::SubscribeToKey(const char* key, const char* group) {
  const char* fun = "BlackBoardProxy::SubscribeToKey";
  const Name name(text_of(fun, group), text_of(fun, key));
  const scoped_lock_t lock(LockData(fun));
  return playerlike::translated(
      fun, [&] { return owned(mEvents->feed.subscribe_to_key(mLink->core->session(), name)); });
}

void BlackBoardProxy::UnsubscribeFromKey(const char* key, const char* group) {
  const char* fun = "BlackBoardProxy::UnsubscribeFromKey";
  const Name name(text_of(fun, group), text_of(fun, key));
  const scoped_lock_t lock(LockData(fun));
  mEvents->feed.unsubscribe_from_key(name);
}

void BlackBoardProxy::SubscribeToGroup(const char* group) {
  const char* fun = "BlackBoardProxy::SubscribeToGroup";
  const std::string name = text_of(fun, group);
  const scoped_lock_t lock(LockData(fun));
  playerlike::translated(fun,
                         [&] { mEvents->feed.subscribe_to_group(mLink->core->session(), name); });
}

void BlackBoardProxy::UnsubscribeFromGroup(const char* group) {
  const char* fun = "BlackBoardProxy::UnsubscribeFromGroup";
  const std::string name = text_of(fun, group);
  const scoped_lock_t lock(LockData(fun));
  mEvents->feed.unsubscribe_from_group(name);
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
  return playerlike::translated(fun, [&] {
    return owned(playerlike::BlackboardFeed::entry_now(mLink->core->session(), name));
  });
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
  const std::vector<BlackboardEntry> changes = mEvents->feed.changes(mLink->core->session());
  if (changes.empty()) return false;
  mEvents->waiting.insert(mEvents->waiting.end(), changes.begin(), changes.end());
  mLink->refresh(sim::to_seconds(changes.back().time_ns));
  mFresh = true;
  return true;
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
    if (events->proxy_deleted) return;
  }
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::BlackBoardProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << '\n';
}

}  // namespace std
