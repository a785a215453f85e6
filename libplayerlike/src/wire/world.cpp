// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The world's interfaces: blackboard, log, map and simulation.
#include <zlib.h>

#include <memory>

#include "libplayerinterface/player_constants.h"
#include "session/blackboard_feed.h"
#include "session/object_values.h"
#include "session/player_values/map.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

// --- blackboard

player::BlackboardEntry wire_entry(BlackboardEntry entry) {
  player::BlackboardEntry out;
  out.key = player::text_bytes(entry.key);
  out.group = player::text_bytes(entry.group);
  out.type = static_cast<std::uint16_t>(entry.type);
  out.subtype = static_cast<std::uint16_t>(entry.subtype);
  out.data = std::move(entry.data);
  out.timestamp_sec = static_cast<std::uint32_t>(entry.time_ns / sim::kNanosecondsPerSecond);
  out.timestamp_usec =
      static_cast<std::uint32_t>(entry.time_ns % sim::kNanosecondsPerSecond / 1000);
  return out;
}

class Blackboard final : public CommonDevice {
 public:
  using CommonDevice::CommonDevice;

  void on_round(DataSink& sink) override {
    for (BlackboardEntry& entry : feed_.changes(session())) {
      sink.data(PLAYER_BLACKBOARD_DATA_UPDATE, player::encode(wire_entry(std::move(entry))));
    }
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    if (subtype < PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_KEY ||
        subtype > PLAYER_BLACKBOARD_REQ_GET_ENTRY) {
      return std::nullopt;
    }
    auto asked = player::decode<player::BlackboardEntry>(payload);
    const BlackboardFeed::Name name(printable_text("the group", asked.group),
                                    printable_text("the key", asked.key));
    switch (subtype) {
      case PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_KEY:
        return player::encode(wire_entry(feed_.subscribe_to_key(session(), name)));
      case PLAYER_BLACKBOARD_REQ_UNSUBSCRIBE_FROM_KEY:
        feed_.unsubscribe_from_key(name);
        return empty_payload();
      case PLAYER_BLACKBOARD_REQ_SUBSCRIBE_TO_GROUP:
        feed_.subscribe_to_group(session(), name.first);
        return empty_payload();
      case PLAYER_BLACKBOARD_REQ_UNSUBSCRIBE_FROM_GROUP:
        feed_.unsubscribe_from_group(name.first);
        return empty_payload();
      case PLAYER_BLACKBOARD_REQ_SET_ENTRY:
        session().request(SetBlackboardRequest{name.first, name.second, asked.type, asked.subtype,
                                               std::move(asked.data)});
        return empty_payload();
      default:
        return player::encode(wire_entry(BlackboardFeed::entry_now(session(), name)));
    }
  }

 private:
  BlackboardFeed feed_;
};

// --- log

class Log final : public CommonDevice {
 public:
  using CommonDevice::CommonDevice;

  // A log that is to be replayed is read first, which may take seconds.
  [[nodiscard]] LongAnswer long_answer(std::uint8_t subtype, std::string_view payload) override {
    LogRequest change;
    if (subtype == PLAYER_LOG_REQ_SET_WRITE_STATE) {
      change.replay = false;
      change.running = player::decode<player::LogSetWriteState>(payload).state != 0;
    } else if (subtype == PLAYER_LOG_REQ_SET_READ_STATE) {
      change.replay = true;
      change.running = player::decode<player::LogSetReadState>(payload).state != 0;
    } else {
      return {};
    }
    if (!change.running.value_or(false)) return {};
    static_cast<void>(session().request(LogRequest{}));  // whether the client may
    return [change](Session& client) -> std::optional<std::string> {
      static_cast<void>(client.request(change));
      return empty_payload();
    };
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    LogRequest change;
    switch (subtype) {
      case PLAYER_LOG_REQ_SET_WRITE_STATE:
        change.replay = false;
        change.running = player::decode<player::LogSetWriteState>(payload).state != 0;
        break;
      case PLAYER_LOG_REQ_SET_READ_STATE:
        change.replay = true;
        change.running = player::decode<player::LogSetReadState>(payload).state != 0;
        break;
      case PLAYER_LOG_REQ_SET_READ_REWIND:
        change.rewind = true;
        break;
      case PLAYER_LOG_REQ_SET_FILENAME:
        change.file = printable_text("the name of the log",
                                     player::decode<player::LogSetFilename>(payload).filename);
        break;
      case PLAYER_LOG_REQ_GET_STATE: {
        const LogStatus now = session().request(change);
        return player::encode(player::LogGetState{
            static_cast<std::uint8_t>(now.replay ? PLAYER_LOG_TYPE_READ : PLAYER_LOG_TYPE_WRITE),
            static_cast<std::uint8_t>(now.running ? 1 : 0)});
      }
      default:
        return std::nullopt;
    }
    static_cast<void>(session().request(std::move(change)));
    return empty_payload();
  }
};

// --- map

// Compresses the cells of a tile as Player's clients expect them.
std::vector<std::int8_t> compressed(const std::vector<std::int8_t>& cells) {
  uLongf length = compressBound(static_cast<uLong>(cells.size()));
  std::vector<std::int8_t> bytes(length);
  const int result =
      compress(reinterpret_cast<Bytef*>(bytes.data()), &length,
               reinterpret_cast<const Bytef*>(cells.data()), static_cast<uLong>(cells.size()));
  if (result != Z_OK) {
    throw SessionError(SessionError::Code::kNotAvailable, "the map cannot be compressed");
  }
  bytes.resize(length);
  return bytes;
}

/// MapProxy's counterpart: the true map of the floor, with the canvas's cells.
class Map final : public CommonDevice {
 public:
  using CommonDevice::CommonDevice;

  [[nodiscard]] LongAnswer long_answer(std::uint8_t subtype, std::string_view payload) override {
    constexpr std::int64_t kQuickCells = 1 << 14;
    constexpr std::int64_t kMostCells = 1 << 22;  // a server refuses more, see request()
    if (subtype != PLAYER_MAP_REQ_GET_DATA) return {};
    const auto asked = player::decode<player::MapData>(payload);
    const std::optional<WorldMapRequest> tile = tile_of(asked);
    if (!tile) return {};
    const std::int64_t cells = std::int64_t{tile->tile->width} * tile->tile->height;
    if (cells <= kQuickCells || cells > kMostCells) return {};
    return [asked, tile = *tile](Session& client) { return tile_answer(client, asked, tile); };
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_MAP_REQ_GET_INFO: {
        const Whole whole = whole_map();
        return player::encode(player::MapInfo{
            static_cast<float>(whole.cell_size_m), static_cast<std::uint32_t>(whole.width),
            static_cast<std::uint32_t>(whole.height), pose_2d(whole.origin)});
      }
      case PLAYER_MAP_REQ_GET_DATA: {
        const auto asked = player::decode<player::MapData>(payload);
        const std::optional<WorldMapRequest> tile = tile_of(asked);
        return tile ? tile_answer(session(), asked, *tile) : std::nullopt;
      }
      default:
        return std::nullopt;
    }
  }

 private:
  struct Whole {
    double cell_size_m = 0.0;
    int width = 0;
    int height = 0;
    sim::Pose origin;
  };

  // Size and place of the map, from its smallest tile.
  [[nodiscard]] Whole whole_map() const {
    const double cell_size_m = session().request(CanvasInfoRequest{}).cell_size_m;
    const WorldMap corner =
        session().request(WorldMapRequest{cell_size_m, sim::CellRect{0, 0, 1, 1}});
    return {corner.map.cell_size_m, corner.width.value_or(corner.map.width),
            corner.height.value_or(corner.map.height),
            corner.origin.value_or(sim::Pose{corner.map.origin.x(), corner.map.origin.y(), 0.0})};
  }

  // The part of the map that is asked for; nullopt if the map has no such part.
  [[nodiscard]] std::optional<WorldMapRequest> tile_of(const player::MapData& asked) const {
    const Whole whole = whole_map();
    const auto width = static_cast<std::uint32_t>(whole.width);
    const auto height = static_cast<std::uint32_t>(whole.height);
    if (asked.width == 0 || asked.height == 0 || asked.col >= width || asked.row >= height ||
        asked.width > width - asked.col || asked.height > height - asked.row) {
      return std::nullopt;
    }
    // Rows are counted from the bottom here, and from the top in tiles.
    const sim::CellRect rect{static_cast<int>(asked.col),
                             static_cast<int>(height - asked.row - asked.height),
                             static_cast<int>(asked.width), static_cast<int>(asked.height)};
    return WorldMapRequest{whole.cell_size_m, rect};
  }

  [[nodiscard]] static std::optional<std::string> tile_answer(Session& session,
                                                              player::MapData asked,
                                                              const WorldMapRequest& tile) {
    const WorldMap part = session.request(tile);
    asked.data_range = kMapDataRange;
    asked.data = compressed(map_cells(part.map));
    std::string payload = player::encode(asked);
    if (payload.size() > player::kMaxPayload) return std::nullopt;
    return payload;
  }
};

// --- simulation

/// SimulationProxy's counterpart. The world is flat: poses in space are those in the plane.
class Simulation final : public CommonDevice {
 public:
  using CommonDevice::CommonDevice;

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_SIMULATION_REQ_GET_POSE2D: {
        auto asked = player::decode<player::SimulationPose2dReq>(payload);
        asked.pose = pose_2d(object(asked.name).pose);
        return player::encode(asked);
      }
      case PLAYER_SIMULATION_REQ_SET_POSE2D: {
        const auto asked = player::decode<player::SimulationPose2dReq>(payload);
        place(asked.name, from_players<sim::Pose>(asked.pose));
        return empty_payload();
      }
      case PLAYER_SIMULATION_REQ_GET_POSE3D: {
        auto asked = player::decode<player::SimulationPose3dReq>(payload);
        const ObjectPose found = object(asked.name);
        asked.pose = pose_3d(found.pose);
        asked.simtime = sim::to_seconds(found.time_ns);
        return player::encode(asked);
      }
      case PLAYER_SIMULATION_REQ_SET_POSE3D: {
        const auto asked = player::decode<player::SimulationPose3dReq>(payload);
        place(asked.name, from_players<sim::Pose>(asked.pose));
        return empty_payload();
      }
      case PLAYER_SIMULATION_REQ_GET_PROPERTY: {
        auto asked = player::decode<player::SimulationPropertyReq>(payload);
        const Property property = property_of(asked);
        write_property(property.name, property.value, asked.value.data(), asked.value.size());
        return player::encode(asked);
      }
      case PLAYER_SIMULATION_REQ_SET_PROPERTY: {
        const auto asked = player::decode<player::SimulationPropertyReq>(payload);
        const Property property = property_of(asked);
        session().request(SetObjectPropertyRequest{
            property.object, property.name,
            read_property(property.name, property.value, asked.value.data(), asked.value.size())});
        return empty_payload();
      }
      default:
        return std::nullopt;
    }
  }

 private:
  struct Property {
    std::string object;
    std::string name;
    PropertyValue value;  // the present one
  };

  [[nodiscard]] static std::string object_name(std::string_view bytes) {
    return printable_text("the name of the object", bytes);
  }

  [[nodiscard]] ObjectPose object(std::string_view bytes) const {
    return session().request(ObjectPoseRequest{object_name(bytes)});
  }

  void place(std::string_view bytes, const sim::Pose& pose) const {
    for (const double number : {pose.x_m, pose.y_m, pose.yaw_rad}) {
      require_number("a coordinate of the pose", number);
    }
    session().request(PlaceObjectRequest{object_name(bytes), pose});
  }

  [[nodiscard]] Property property_of(const player::SimulationPropertyReq& asked) const {
    Property property{object_name(asked.name),
                      property_name(printable_text("the name of the property", asked.prop)),
                      {}};
    property.value = session().request(ObjectPropertyRequest{property.object, property.name});
    return property;
  }
};

}  // namespace

MadeDevice make_world_device(const DeviceContext& context) {
  switch (context.interface) {
    case PLAYER_BLACKBOARD_CODE:
      return std::make_unique<Blackboard>(context);
    case PLAYER_LOG_CODE:
      return std::make_unique<Log>(context);
    case PLAYER_MAP_CODE:
      return std::make_unique<Map>(context);
    case PLAYER_SIMULATION_CODE:
      return std::make_unique<Simulation>(context);
    default:
      return nullptr;
  }
}

}  // namespace playerlike::wire
