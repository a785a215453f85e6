// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/session/session.h"

namespace playerlike {

/// The changes of the blackboard that a client has subscribed to (docs/blackboard.md).
///
/// Threads: an object must not be used by two threads at once. Errors: SessionError as for
/// BlackboardRequest.
class BlackboardFeed {
 public:
  using Name = std::pair<std::string, std::string>;  ///< group and key

  /// The present entry; one without a group and a key if it was never set.
  [[nodiscard]] static BlackboardEntry entry_now(Session& session, const Name& name);

  /// Subscribes to an entry.
  /// @return the present entry. If it was never set, it has the group and the key only.
  BlackboardEntry subscribe_to_key(Session& session, const Name& name);
  void unsubscribe_from_key(const Name& name) { keys_.erase(name); }
  /// Subscribes to all entries of a group, also those that were set before.
  void subscribe_to_group(Session& session, const std::string& group);
  void unsubscribe_from_group(const std::string& group) { groups_.erase(group); }

  /// The changes of the subscribed entries that were not returned before, in their order.
  [[nodiscard]] std::vector<BlackboardEntry> changes(Session& session);

 private:
  // For each subscription, the number of the last change that is known to the client.
  std::map<Name, std::int64_t> keys_;
  std::map<std::string, std::int64_t> groups_;
};

}  // namespace playerlike
