// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "playerlike/messages/requests.h"
#include "protocol/player_structs.h"
#include "remote/player_link.h"

namespace playerlike {

class PlayerSession;

/// Answers a Player session's requests about the world by the server's interfaces simulation, map,
/// log and blackboard, always by the first index of each.
///
/// Errors: SessionError kNoSuchDevice if the server has no such interface; kNotAvailable if it
/// refuses a request or does not answer in time.
class PlayerWorld {
 public:
  explicit PlayerWorld(PlayerSession& session) : session_(session) {}
  PlayerWorld(const PlayerWorld&) = delete;
  PlayerWorld& operator=(const PlayerWorld&) = delete;

  [[nodiscard]] ObjectPose handle(const ObjectPoseRequest& what);
  void handle(const PlaceObjectRequest& what);
  /// Values are bytes in Player. Those of "colour" are four floats; others are one number, or three
  /// for "pose".
  [[nodiscard]] PropertyValue handle(const ObjectPropertyRequest& what);
  void handle(const SetObjectPropertyRequest& what);
  /// The server's map, whatever cell size and tile were requested.
  [[nodiscard]] WorldMap handle(const WorldMapRequest& what);
  [[nodiscard]] LogStatus handle(const LogRequest& what);
  /// A request for a key gets the present entry from the server. Others subscribe to their group;
  /// then changes arrive with the rounds of data. Changes are numbered as they arrive.
  [[nodiscard]] std::vector<BlackboardEntry> handle(const BlackboardRequest& what);
  void handle(const SetBlackboardRequest& what);

  /// Takes a change of the blackboard. The caller holds the session's mutex.
  /// @throws protocol::ProtocolError.
  void on_update(std::string_view payload);
  /// Subscribes again on a new connection.
  void resume(PlayerLink& link);

 private:
  using Name = std::pair<std::string, std::string>;  ///< group and key

  /// Sends a request to the first device of an interface, which it opens. @return the payload.
  std::string ask(unsigned interface, std::uint8_t subtype, const std::string& payload);
  template <typename Payload>
  Payload ask_for(unsigned interface, std::uint8_t subtype, const std::string& payload);
  /// Fetches a tile of the map. @param map  receives the cells.
  void fetch_tile(const player::MapInfo& info, const player::MapData& tile, sim::OccupancyMap& map);
  void subscribe_to_group(const std::string& group);
  /// Stores an entry of the server. The caller holds the session's mutex.
  const BlackboardEntry* note(const player::BlackboardEntry& entry);

  PlayerSession& session_;
  // Guarded by the session's mutex.
  std::map<Name, BlackboardEntry> entries_;
  std::size_t entry_bytes_ = 0;   ///< of the entries' names and data
  std::set<std::string> groups_;  ///< that were subscribed to
  std::int64_t changes_ = 0;
};

}  // namespace playerlike
