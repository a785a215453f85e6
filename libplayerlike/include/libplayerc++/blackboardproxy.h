// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Player's blackboard: entries that all programs of a simulation share (docs/blackboard.md).
///
/// Group and key identify an entry. An entry also has a type, a subtype and data, whose meaning
/// programs agree on, and the simulated time of its last change.
///
/// Read() reports changes of the entries that the proxy has subscribed to, including the proxy's
/// own changes: it raises the fresh flag and calls the event handler. An entry that was set several
/// times between two calls of Read() is reported once, with its newest value.
///
/// As in Player, the caller owns the entries that functions return by pointer: free(entry->key),
/// free(entry->group), free(entry->data) and free(entry).
class BlackBoardProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the index is not 0.
  BlackBoardProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  BlackBoardProxy(const BlackBoardProxy&) = delete;
  BlackBoardProxy& operator=(const BlackBoardProxy&) = delete;
  ~BlackBoardProxy() override;

  /// Reports changes of an entry from now on.
  /// @return a copy of the present entry, which the caller frees; with type 0 and no data if it was
  ///         never set.
  /// @throws PlayerError kBadArgument for a null pointer; kNotAvailable in a private world.
  player_blackboard_entry_t* SubscribeToKey(const char* key, const char* group = "");
  /// Ends a subscription of SubscribeToKey(). Does nothing if there is none.
  /// @throws PlayerError kBadArgument for a null pointer.
  void UnsubscribeFromKey(const char* key, const char* group = "");
  /// Reports changes of all entries of a group from now on. The next Read() reports the entries
  /// that the group already has.
  /// @param group  the group; Player's header calls this parameter key.
  /// @throws PlayerError kBadArgument for a null pointer; kNotAvailable in a private world.
  void SubscribeToGroup(const char* group);
  /// Ends a subscription of SubscribeToGroup(). Does nothing if there is none.
  /// @throws PlayerError kBadArgument for a null pointer.
  void UnsubscribeFromGroup(const char* group);
  /// Sets an entry. Its counts of key and group and its time are ignored: the texts end with a zero
  /// byte, and the time is the simulated time.
  ///
  /// The change takes effect immediately. Exception: if several threads or programs take part in
  /// lockstep without virtual time, the others see it from the next step on.
  /// @throws PlayerError kBadArgument for a null pointer, for a group or key of more than 255 bytes
  ///         or with control characters, for an empty key and for more than 65536 bytes of data;
  ///         kNotAvailable if the blackboard is full, or in a private world.
  void SetEntry(const player_blackboard_entry_t& entry);
  /// Returns a copy of the present entry, which the caller frees. If it was never set, the copy has
  /// an empty key and group, type 0 and no data, as in Player.
  /// @throws PlayerError kBadArgument for a null pointer; kNotAvailable in a private world.
  player_blackboard_entry_t* GetEntry(const char* key, const char* group);
  /// Sets the function that Read() calls for each reported change, in the order of the changes;
  /// null: none. It runs in the reading thread, with mMutex unlocked, and may delete the proxy. Its
  /// first argument is null, because this library is not built on the C library. The entry is valid
  /// until the function returns.
  void SetEventHandler(void (*handler)(playerc_blackboard_t*, player_blackboard_entry_t));

  /// An event handler without Player's first argument.
  typedef std::function<void(const player_blackboard_entry_t&)> EventHandler;
  /// Sets any callable as the event handler; see SetEventHandler().
  void SetEventFunction(EventHandler handler);

 protected:
  bool HandlePoll() override;

 private:
  struct Events;
  void DeliverEvents();

  // Guarded by the client's mutex.
  std::shared_ptr<Events> mEvents;
  EventHandler mHandler;
};

}  // namespace PlayerCc

namespace std {
/// Prints interface, index and flags.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BlackBoardProxy& c);
}  // namespace std
