// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Values by group and key that all programs of a simulation share (docs/blackboard.md).
///
/// An entry has a group, a key, a type and a subtype, which mean what programs agree on, data of up
/// to 64 KiB and the simulated time of its last change. Groups and keys have up to 255 printable
/// bytes. SetEntry() takes effect at once. Read() reports changes of entries that the proxy has
/// subscribed to, also its own: it raises the fresh flag and calls the event handler. An entry that
/// was set several times between two Read() is reported once, with its newest value.
///
/// Entries that functions return by pointer belong to the caller, as in Player: free(entry->key),
/// free(entry->group), free(entry->data) and free(entry).
class BlackBoardProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice for an index that is not 0, or a port without robots.
  BlackBoardProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  BlackBoardProxy(const BlackBoardProxy&) = delete;
  BlackBoardProxy& operator=(const BlackBoardProxy&) = delete;
  ~BlackBoardProxy() override;

  /// Reports changes of an entry from now on.
  /// @return a copy of it as it is now, with an empty value of type 0 if it was never set.
  /// @throws PlayerError kBadArgument for a null pointer; kNotAvailable in a private world.
  player_blackboard_entry_t* SubscribeToKey(const char* key, const char* group = "");
  /// Undoes SubscribeToKey(); harmless without it.
  void UnsubscribeFromKey(const char* key, const char* group = "");
  /// Reports changes of all entries of a group from now on; the next Read() reports those that it
  /// has already.
  void SubscribeToGroup(const char* key);
  /// Undoes SubscribeToGroup(); harmless without it.
  void UnsubscribeFromGroup(const char* group);
  /// Sets an entry; its time is that of the simulation, whatever aEntry says.
  /// @throws PlayerError kBadArgument for null pointers and for a group, key or data that are too
  ///         long; kNotAvailable if the blackboard is full, or in a private world.
  void SetEntry(const player_blackboard_entry_t& entry);
  /// @return a copy of an entry, with an empty value of type 0 if it was never set.
  player_blackboard_entry_t* GetEntry(const char* key, const char* group);
  /// Sets what Read() calls for each reported change, in the order of the changes, in the thread
  /// that reads and with mMutex unlocked; null: nothing. The first argument of the handler is null:
  /// a C++ program's proxies do not stand on the C library. The entry lives until it returns.
  void SetEventHandler(void (*handler)(playerc_blackboard_t*, player_blackboard_entry_t));

  /// An event handler of any kind, for the C library.
  typedef std::function<void(const player_blackboard_entry_t&)> EventHandler;
  /// SetEventHandler() for such a one.
  void SetEventFunction(EventHandler handler);

 protected:
  bool HandlePoll() override;

 private:
  struct Events;
  typedef std::pair<std::string, std::string> Name;  // group and key

  void DeliverEvents();

  // Guarded by the client's mutex. Of what is subscribed to: the number of the last change that was
  // reported.
  std::map<Name, int64_t> mKeys;
  std::map<std::string, int64_t> mGroups;
  std::shared_ptr<Events> mEvents;
  EventHandler mHandler;
};

}  // namespace PlayerCc

namespace std {
/// Prints interface, index and flags.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BlackBoardProxy& c);
}  // namespace std
