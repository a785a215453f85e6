// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/player_world.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>

#include "messages/player_interfaces.h"
#include "protocol/player_xdr.h"
#include "remote/player_session.h"
#include "session/player_values/poses.h"
#include "sim/core/colour.h"

namespace playerlike {
namespace {

constexpr std::uint32_t kMaxPlayerMap = 8192;  // as in Playpen's own maps
constexpr std::uint32_t kMapTile = 640;    // side of a tile [cells], as Player's client requests
constexpr std::size_t kMaxEntries = 4096;  // of the blackboard
constexpr std::size_t kMaxEntryBytes = std::size_t{64} << 20U;  // of all of them
constexpr float kUnknown = 0.5F;                                // occupancy of unknown cells

/// The bytes of properties are those of the machine, which is little-endian on all that Player
/// supports.
static_assert(std::endian::native == std::endian::little);

template <typename Number>
std::vector<Number> numbers_in(const std::string& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

template <typename Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// Player's name of a property of Playpen.
std::string player_property(const std::string& name) { return name == "colour" ? "color" : name; }

std::uint8_t channel(float value) {
  if (!(value > 0.0F)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0F) * 255.0F));
}

SessionError bad_property(const std::string& property, std::size_t bytes) {
  return {SessionError::Code::kNotAvailable, "the Player server's property \"" + property +
                                                 "\" has " + std::to_string(bytes) +
                                                 " bytes, whose meaning is unknown"};
}

PropertyValue property_value(const std::string& property, const std::string& bytes) {
  if (property == "colour" && bytes.size() == 4 * sizeof(float)) {
    const std::vector<float> rgba = numbers_in<float>(bytes);
    return sim::to_string(
        sim::Colour{channel(rgba[0]), channel(rgba[1]), channel(rgba[2]), channel(rgba[3])});
  }
  if (bytes.size() == sizeof(std::int32_t)) {
    return std::vector<double>{static_cast<double>(numbers_in<std::int32_t>(bytes).front())};
  }
  if (bytes.empty() || bytes.size() % sizeof(double) != 0) {
    throw bad_property(property, bytes.size());
  }
  return numbers_in<double>(bytes);
}

std::string property_bytes(const std::string& property, const PropertyValue& value) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return bytes_of(*numbers);
  const auto& text = std::get<std::string>(value);
  const std::optional<sim::Colour> colour = sim::parse_colour(text);
  if (property != "colour" || !colour) return player::text_bytes(text);
  return bytes_of(std::vector<float>{
      static_cast<float>(colour->r) / 255.0F, static_cast<float>(colour->g) / 255.0F,
      static_cast<float>(colour->b) / 255.0F, static_cast<float>(colour->a) / 255.0F});
}

[[noreturn]] void refuse_map(const std::string& why) {
  throw SessionError(SessionError::Code::kNotAvailable,
                     "the Player server's map is invalid: " + why);
}

/// Decompresses the cells of a tile, which must be exactly `count`.
std::vector<std::int8_t> inflated(const std::vector<std::int8_t>& data, std::size_t count) {
  std::vector<std::int8_t> cells(count);
  auto size = static_cast<uLongf>(count);
  const int result =
      uncompress(reinterpret_cast<Bytef*>(cells.data()), &size,
                 reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()));
  if (result != Z_OK || size != count) {
    refuse_map("a tile of " + std::to_string(count) + " cells cannot be decompressed");
  }
  return cells;
}

player::BlackboardEntry named(const std::string& group, const std::string& key) {
  player::BlackboardEntry entry;
  entry.group = player::text_bytes(group);
  entry.key = player::text_bytes(key);
  return entry;
}

}  // namespace

std::string PlayerWorld::ask(unsigned interface, std::uint8_t subtype, const std::string& payload) {
  PlayerSession::Address* const address = session_.address_of(interface);
  if (address == nullptr) {
    const char* name = player_interface_name(static_cast<int>(interface));
    static_cast<void>(find_interface(session_.robots(), session_.port(), name, 0));
  }
  return session_.ask(*address, subtype, payload);
}

template <typename Payload>
Payload PlayerWorld::ask_for(unsigned interface, std::uint8_t subtype, const std::string& payload) {
  const std::string answer = ask(interface, subtype, payload);
  try {
    return player::decode<Payload>(answer);
  } catch (const protocol::ProtocolError& e) {
    PlayerSession::refuse_bytes(*session_.link(), e.what());
  }
}

// --- Objects

ObjectPose PlayerWorld::handle(const ObjectPoseRequest& what) {
  player::SimulationPose2dReq request;
  request.name = player::text_bytes(what.name);
  const auto answer = ask_for<player::SimulationPose2dReq>(
      PLAYER_SIMULATION_CODE, PLAYER_SIMULATION_REQ_GET_POSE2D, player::encode(request));
  return {from_players<sim::Pose>(answer.pose), session_.time().sim_time_ns};
}

void PlayerWorld::handle(const PlaceObjectRequest& what) {
  require_finite(sim::PlaceCommand{what.pose});
  player::SimulationPose2dReq request;
  request.name = player::text_bytes(what.name);
  request.pose = to_players<player::Pose2d>(what.pose);
  static_cast<void>(
      ask(PLAYER_SIMULATION_CODE, PLAYER_SIMULATION_REQ_SET_POSE2D, player::encode(request)));
}

PropertyValue PlayerWorld::handle(const ObjectPropertyRequest& what) {
  // Servers answer as many bytes as the request has room for.
  const std::size_t room = what.property == "colour" ? 4 * sizeof(float)
                           : what.property == "pose" ? 3 * sizeof(double)
                                                     : sizeof(double);
  player::SimulationPropertyReq request;
  request.name = player::text_bytes(what.name);
  request.prop = player::text_bytes(player_property(what.property));
  request.value.assign(room, '\0');
  const auto answer = ask_for<player::SimulationPropertyReq>(
      PLAYER_SIMULATION_CODE, PLAYER_SIMULATION_REQ_GET_PROPERTY, player::encode(request));
  return property_value(what.property, answer.value);
}

void PlayerWorld::handle(const SetObjectPropertyRequest& what) {
  player::SimulationPropertyReq request;
  request.name = player::text_bytes(what.name);
  request.prop = player::text_bytes(player_property(what.property));
  request.value = property_bytes(what.property, what.value);
  static_cast<void>(
      ask(PLAYER_SIMULATION_CODE, PLAYER_SIMULATION_REQ_SET_PROPERTY, player::encode(request)));
}

// --- The map

void PlayerWorld::fetch_tile(const player::MapInfo& info, const player::MapData& tile,
                             sim::OccupancyMap& map) {
  const auto answer =
      ask_for<player::MapData>(PLAYER_MAP_CODE, PLAYER_MAP_REQ_GET_DATA, player::encode(tile));
  if (answer.col != tile.col || answer.row != tile.row || answer.width != tile.width ||
      answer.height != tile.height) {
    refuse_map("it has sent another tile than was requested");
  }
  const std::vector<std::int8_t> cells =
      inflated(answer.data, std::size_t{tile.width} * tile.height);
  for (std::uint32_t row = 0; row < tile.height; ++row) {
    // The first row is the top row here, and the bottom row in Player.
    const std::size_t to = std::size_t{info.height - 1 - (tile.row + row)} * info.width + tile.col;
    for (std::uint32_t column = 0; column < tile.width; ++column) {
      const std::int8_t cell = cells[std::size_t{row} * tile.width + column];
      map.cells[to + column] = cell > 0 ? 1.0F : cell < 0 ? 0.0F : kUnknown;
    }
  }
}

WorldMap PlayerWorld::handle(const WorldMapRequest& /*what*/) {
  const auto info = ask_for<player::MapInfo>(PLAYER_MAP_CODE, PLAYER_MAP_REQ_GET_INFO, {});
  if (info.width == 0 || info.height == 0 || info.width > kMaxPlayerMap ||
      info.height > kMaxPlayerMap || !(info.scale > 0.0F) || !std::isfinite(info.scale)) {
    refuse_map(std::to_string(info.width) + " x " + std::to_string(info.height) + " cells of " +
               std::to_string(info.scale) + " m; expected 1 to " + std::to_string(kMaxPlayerMap) +
               " cells along a side, and a positive size");
  }
  WorldMap world;
  world.map.width = static_cast<int>(info.width);
  world.map.height = static_cast<int>(info.height);
  world.map.cell_size_m = double{info.scale};
  world.map.origin = {info.origin.px, info.origin.py};
  world.map.cells.resize(std::size_t{info.width} * info.height);
  player::MapData tile;
  for (tile.row = 0; tile.row < info.height; tile.row += kMapTile) {
    tile.height = std::min(kMapTile, info.height - tile.row);
    for (tile.col = 0; tile.col < info.width; tile.col += kMapTile) {
      tile.width = std::min(kMapTile, info.width - tile.col);
      fetch_tile(info, tile, world.map);
    }
  }
  return world;
}

// --- The log

LogStatus PlayerWorld::handle(const LogRequest& what) {
  const auto send = [&](std::uint8_t subtype, const std::string& payload) {
    static_cast<void>(ask(PLAYER_LOG_CODE, subtype, payload));
  };
  const auto status = [&] {
    return ask_for<player::LogGetState>(PLAYER_LOG_CODE, PLAYER_LOG_REQ_GET_STATE, {});
  };
  if (what.file) {
    player::LogSetFilename request;
    request.filename = player::text_bytes(*what.file);
    send(PLAYER_LOG_REQ_SET_FILENAME, player::encode(request));
  }
  if (what.rewind && *what.rewind) send(PLAYER_LOG_REQ_SET_READ_REWIND, {});
  if (what.running) {
    const bool replay = what.replay ? *what.replay : status().type == PLAYER_LOG_TYPE_READ;
    player::LogSetWriteState request;  // equal for reading and writing
    request.state = *what.running ? 1 : 0;
    send(replay ? PLAYER_LOG_REQ_SET_READ_STATE : PLAYER_LOG_REQ_SET_WRITE_STATE,
         player::encode(request));
  }
  const auto now = status();
  LogStatus result;
  result.replay = now.type == PLAYER_LOG_TYPE_READ;
  result.running = now.state != 0;
  result.file = what.file.value_or("");
  return result;
}

// --- The blackboard

const BlackboardEntry* PlayerWorld::note(const player::BlackboardEntry& entry) {
  const Name name(player::text_of(entry.group), player::text_of(entry.key));
  if (name.second.empty()) return nullptr;  // what servers answer for a missing entry
  const auto known = entries_.find(name);
  if (known == entries_.end() && entries_.size() >= kMaxEntries) return nullptr;
  const std::size_t names = name.first.size() + name.second.size();
  const std::size_t before_bytes = known == entries_.end() ? 0 : names + known->second.data.size();
  const std::size_t now_bytes = names + entry.data.size();
  if (entry_bytes_ - before_bytes + now_bytes > kMaxEntryBytes) return nullptr;
  BlackboardEntry now;
  now.group = name.first;
  now.key = name.second;
  now.type = entry.type;
  now.subtype = entry.subtype;
  now.data = entry.data;
  now.time_ns = sim::SimTime{entry.timestamp_sec} * sim::kNanosecondsPerSecond +
                sim::SimTime{entry.timestamp_usec} * 1000;
  if (known != entries_.end()) {
    const BlackboardEntry& before = known->second;
    if (before.data == now.data && before.time_ns == now.time_ns && before.type == now.type &&
        before.subtype == now.subtype) {
      return &before;
    }
  }
  now.change = ++changes_;
  entry_bytes_ += now_bytes - before_bytes;
  return &(entries_[name] = std::move(now));
}

void PlayerWorld::on_update(std::string_view payload) {
  static_cast<void>(note(player::decode<player::BlackboardEntry>(payload)));
}

void PlayerWorld::subscribe_to_group(const std::string& group) {
  {
    const PlayerSession::Lock lock(session_.mutex_);
    if (groups_.contains(group)) return;
  }
  static_cast<void>(ask(PLAYER_BLACKBOARD_CODE, PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_GROUP,
                        player::encode(named(group, ""))));
  const PlayerSession::Lock lock(session_.mutex_);
  groups_.insert(group);
}

void PlayerWorld::resume(PlayerLink& link) {
  PlayerSession::Address* const address = session_.address_of(PLAYER_BLACKBOARD_CODE);
  std::set<std::string> groups;
  {
    const PlayerSession::Lock lock(session_.mutex_);
    groups = groups_;
  }
  for (const std::string& group : groups) {
    static_cast<void>(session_.ask(link, *address, PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_GROUP,
                                   player::encode(named(group, ""))));
  }
}

std::vector<BlackboardEntry> PlayerWorld::handle(const BlackboardRequest& what) {
  if (what.group && what.key && what.after == 0) {
    const auto answer =
        ask_for<player::BlackboardEntry>(PLAYER_BLACKBOARD_CODE, PLAYER_BLACKBOARD_REQ_GET_ENTRY,
                                         player::encode(named(*what.group, *what.key)));
    const PlayerSession::Lock lock(session_.mutex_);
    const BlackboardEntry* const entry = note(answer);
    if (entry == nullptr) return {};
    return {*entry};
  }
  std::set<std::string> groups;
  if (what.group) {
    groups.insert(*what.group);
  } else {
    const PlayerSession::Lock lock(session_.mutex_);
    for (const auto& entry : entries_) groups.insert(entry.first.first);
  }
  for (const std::string& group : groups) subscribe_to_group(group);
  std::vector<BlackboardEntry> found;
  {
    const PlayerSession::Lock lock(session_.mutex_);
    for (const auto& [name, entry] : entries_) {
      if (entry.change <= what.after || (what.group && *what.group != name.first) ||
          (what.key && *what.key != name.second)) {
        continue;
      }
      found.push_back(entry);
    }
  }
  std::sort(found.begin(), found.end(),
            [](const BlackboardEntry& a, const BlackboardEntry& b) { return a.change < b.change; });
  return found;
}

void PlayerWorld::handle(const SetBlackboardRequest& what) {
  player::BlackboardEntry entry = named(what.group, what.key);
  entry.type = static_cast<std::uint16_t>(what.type);
  entry.subtype = static_cast<std::uint16_t>(what.subtype);
  entry.data = what.data;
  using std::chrono::microseconds;
  const auto now =
      std::chrono::duration_cast<microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  constexpr std::int64_t kMicroseconds = 1'000'000;
  entry.timestamp_sec = static_cast<std::uint32_t>(now / kMicroseconds);
  entry.timestamp_usec = static_cast<std::uint32_t>(now % kMicroseconds);
  static_cast<void>(
      ask(PLAYER_BLACKBOARD_CODE, PLAYER_BLACKBOARD_REQ_SET_ENTRY, player::encode(entry)));
}

}  // namespace playerlike
