// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/messages/requests.h"
#include "playerlike/process/thread_id.h"

namespace playerlike {

/// Entries that all clients of a host share, by group and key (docs/blackboard.md).
///
/// A change either takes effect at once, or waits until publish(). A waiting change is visible only
/// to the thread that made it. The host lets changes wait if threads compute side by side in
/// lockstep: what they read then does not depend on thread scheduling.
///
/// The entries belong to the host, not to the world, so a restored state does not change them. Not
/// thread-safe: guarded by the host's mutex.
class Blackboard {
 public:
  // The limits also bound the answer of a server with all entries.
  static constexpr std::size_t kLongestName = 255;       ///< of a group or key [bytes]
  static constexpr std::size_t kMostData = 64 * 1024;    ///< of an entry [bytes]
  static constexpr std::size_t kMostBytes = 512 * 1024;  ///< names and data of all entries
  static constexpr std::size_t kMostEntries = 1024;

  /// Sets an entry at simulated time `now_ns`.
  /// @param thread  the change waits as a change of this thread; 0: it takes effect at once. Then
  ///                no other change may wait.
  /// @throws SessionError as SetBlackboardRequest; the entry then keeps its value.
  void set(const SetBlackboardRequest& what, sim::SimTime now_ns, ThreadId thread = 0);
  /// Returns the requested entries, see BlackboardRequest.
  /// @param thread  the thread that asks; 0: one that sees the waiting changes of all threads.
  [[nodiscard]] std::vector<BlackboardEntry> find(const BlackboardRequest& what,
                                                  ThreadId thread = 0) const;

  [[nodiscard]] bool has_waiting_changes() const noexcept { return !waiting_.empty(); }
  /// Lets the waiting changes take effect. Those of one thread keep their order.
  /// @param order  the threads, in the order in which their changes take effect; repetitions have
  ///               no effect. Threads that are not listed follow, in order of id.
  void publish(const std::vector<ThreadId>& order);

 private:
  using Name = std::pair<std::string, std::string>;  // group and key
  struct Value {
    int type = 0;
    int subtype = 0;
    std::vector<std::uint8_t> data;
    sim::SimTime time_ns = 0;
    std::int64_t change = 0;
  };
  /// Entries with their last changes.
  struct Table {
    void put(const Name& name, Value value);
    [[nodiscard]] const Value* find(const Name& name) const;

    std::map<Name, Value> values;
    std::map<std::int64_t, Name> by_change;
    std::int64_t changes = 0;  ///< number of the last change
    std::size_t bytes = 0;     ///< of names and data
  };
  struct Room {
    std::size_t bytes = 0;
    std::size_t entries = 0;
  };

  [[nodiscard]] Room growth(const Name& name, std::size_t data_bytes) const;
  [[nodiscard]] const Value* find_waiting(const Name& name, ThreadId thread) const;

  Table entries_;
  std::map<ThreadId, Table> waiting_;
  Room reserved_;  ///< for the waiting changes
};

}  // namespace playerlike
