// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/request_codec.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "protocol/codec.h"
#include "sim/core/error.h"

namespace playerlike::protocol {
namespace {

template <typename One>
concept HasName = requires {
  One::kName;
};

template <typename Value>
constexpr bool kIsOptional = false;
template <typename Value>
constexpr bool kIsOptional<std::optional<Value>> = true;
template <typename Value>
constexpr bool kIsVector = false;
template <typename Value>
constexpr bool kIsVector<std::vector<Value>> = true;
template <typename Value>
constexpr bool kIsMap = false;
template <typename Value>
constexpr bool kIsMap<std::map<std::string, Value>> = true;

constexpr int kMaxSide = 1 << 14;  // of a rectangle; canvases have at most 8192

sim::CellRect require_rect(const json& object, const char* key) {
  const json& rect = require(object, key);
  if (!rect.is_array() || rect.size() != 4) {
    refuse_value(key, "[column, row, width, height]", rect);
  }
  const auto number = [&](std::size_t i, std::int64_t least, std::int64_t most) {
    return static_cast<int>(require_integer({{key, rect[i]}}, key, least, most));
  };
  return {number(0, kCellRange.least, kCellRange.most),
          number(1, kCellRange.least, kCellRange.most), number(2, 0, kMaxSide),
          number(3, 0, kMaxSide)};
}

// --- Fields of structs that are not requests

constexpr WholeRange kAnyInt{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};

template <typename Struct>
requires requires { Struct::kFields; }
constexpr auto fields_of(std::type_identity<Struct> /*type*/) { return Struct::kFields; }

constexpr auto fields_of(std::type_identity<CanvasInfo> /*type*/) {
  using T = CanvasInfo;
  return std::tuple(field("width", &T::width, kMapSideRange),
                    field("height", &T::height, kMapSideRange), field("cell_size", &T::cell_size_m),
                    field("x", &T::origin_x_m), field("y", &T::origin_y_m));
}

constexpr auto fields_of(std::type_identity<TimeStatistics> /*type*/) {
  using T = TimeStatistics;
  return std::tuple(
      field("t", &T::sim_time_ns), field("steps", &T::steps), field("step", &T::step_s),
      field("wall_time", &T::wall_time_s), field("real_time_factor", &T::real_time_factor),
      field("duration", &T::duration_s), field("mode", &T::mode), field("finished", &T::finished));
}

constexpr auto fields_of(std::type_identity<LogStatus> /*type*/) {
  using T = LogStatus;
  return std::tuple(field("replay", &T::replay), field("running", &T::running),
                    field("file", &T::file));
}

constexpr auto fields_of(std::type_identity<sim::LayerStyle> /*type*/) {
  using T = sim::LayerStyle;
  constexpr Presence kOptional = Presence::kOptional;
  return std::tuple(field("name", &T::name, kOptional), field("colour", &T::colour, kOptional),
                    field("transparency", &T::transparency, kOptional),
                    field("transparent_colour", &T::transparent_colour, Presence::kNullable),
                    field("priority", &T::priority, kAnyInt, kOptional),
                    field("visible", &T::visible, kOptional));
}

constexpr auto fields_of(std::type_identity<sim::LayerInfo> /*type*/) {
  using T = sim::LayerInfo;
  return std::tuple(field("layer", &T::id, kAnyInt), field("kind", &T::kind),
                    field("owner", &T::owner, kAnyInt), field("style", &T::style));
}

constexpr auto fields_of(std::type_identity<DeviceInfo> /*type*/) {
  using T = DeviceInfo;
  return std::tuple(field("device", &T::id), field("name", &T::name), field("type", &T::type),
                    field("properties", &T::properties));
}

constexpr auto fields_of(std::type_identity<sim::DriverDescription> /*type*/) {
  using T = sim::DriverDescription;
  return std::tuple(field("type", &T::type), field("settings", &T::settings));
}

constexpr auto fields_of(std::type_identity<RobotInfo> /*type*/) {
  using T = RobotInfo;
  return std::tuple(
      field("name", &T::name), field("model", &T::model), field("colour", &T::colour),
      field("initial_pose", &T::initial_pose), field("port", &T::port, WholeRange{0, 65535}),
      field("length", &T::length_m), field("width", &T::width_m), field("height", &T::height_m),
      field("center", &T::center_m), field("radius", &T::radius_m, Presence::kOptional),
      field("mass", &T::mass_kg, Presence::kOptional), field("max_speed", &T::max_speed_mps),
      field("max_turn_rate", &T::max_turn_rate_radps), field("proxies", &T::proxies, kAnyInt),
      field("interfaces", &T::interfaces), field("drivers", &T::drivers),
      field("devices", &T::devices));
}

constexpr auto fields_of(std::type_identity<sim::ArenaTrigger> /*type*/) {
  using T = sim::ArenaTrigger;
  return std::tuple(field("name", &T::name), field("enabled", &T::enabled),
                    field("count", &T::count),
                    field("time_left", &T::time_left_s, Presence::kOptional));
}

constexpr auto fields_of(std::type_identity<sim::ArenaEvent> /*type*/) {
  using T = sim::ArenaEvent;
  return std::tuple(field("number", &T::number), field("t", &T::time_ns), field("kind", &T::kind),
                    field("what", &T::what), field("who", &T::who), field("text", &T::text),
                    field("value", &T::value));
}

constexpr auto fields_of(std::type_identity<sim::Verdict> /*type*/) {
  using T = sim::Verdict;
  return std::tuple(field("passed", &T::passed), field("reason", &T::reason),
                    field("t", &T::time_ns));
}

template <typename Struct>
concept HasFields = requires {
  fields_of(std::type_identity<Struct>{});
};

/// Describes a list in errors.
template <typename Element>
constexpr const char* kListOf = "a list";
template <>
constexpr const char* kListOf<std::string> = "a list of texts";
template <>
constexpr const char* kListOf<RobotInfo> = "a list of robots";
template <>
constexpr const char* kListOf<sim::LayerInfo> = "a list of layers";
template <>
constexpr const char* kListOf<LocalizationParticle> = "a list of particles";
template <>
constexpr const char* kListOf<BlackboardEntry> = "a list of entries";

// --- Values

constexpr std::string_view kLayerKinds[] = {"colour", "binary", "grey"};
constexpr std::string_view kTimeModes[] = {"lockstep", "paced"};

template <HasFields Struct>
void encode_fields(const Struct& from, Encoding encoding, json& message);
template <HasFields Struct>
Struct decode_fields(const json& message, Encoding encoding);

template <typename Value>
json encode_value(const Value& value, Encoding encoding) {
  if constexpr (kIsOptional<Value>) {
    return value ? encode_value(*value, encoding) : json();
  } else if constexpr (std::is_same_v<Value, DeviceId>) {
    return encode_device_id(value);
  } else if constexpr (std::is_same_v<Value, sim::Pose>) {
    return encode_pose(value);
  } else if constexpr (std::is_same_v<Value, sim::CellRect>) {
    return {value.column, value.row, value.width, value.height};
  } else if constexpr (std::is_same_v<Value, sim::CellValue>) {
    return encode_cells(std::span(&value, 1), encoding);
  } else if constexpr (std::is_same_v<Value, std::vector<sim::CellValue>>) {
    return encode_cells(value, encoding);
  } else if constexpr (std::is_same_v<Value, std::vector<std::uint8_t>>) {
    return bytes(value, encoding);
  } else if constexpr (std::is_same_v<Value, sim::LayerKind>) {
    return kLayerKinds[static_cast<std::size_t>(value)];
  } else if constexpr (std::is_same_v<Value, sim::TimeMode>) {
    return kTimeModes[value == sim::TimeMode::kLockstep ? 0 : 1];
  } else if constexpr (std::is_same_v<Value, sim::Colour> || std::is_same_v<Value, sim::ViewMode> ||
                       std::is_same_v<Value, sim::io::MapMode> ||
                       std::is_same_v<Value, sim::ArenaEventKind>) {
    return to_string(value);
  } else if constexpr (std::is_same_v<Value, sim::OccupancyMap>) {
    return encode_map(value, encoding);
  } else if constexpr (std::is_same_v<Value, PropertyValue>) {
    return encode_property(value);
  } else if constexpr (HasFields<Value>) {
    json message = json::object();
    encode_fields(value, encoding, message);
    return message;
  } else if constexpr (kIsVector<Value>) {
    json list = json::array();
    for (const auto& element : value) list.push_back(encode_value(element, encoding));
    return list;
  } else {
    return value;
  }
}

/// The index of a word in `words`. @param expected  describes the words in errors.
std::size_t decode_word(const json& value, const char* key, std::span<const std::string_view> words,
                        const char* expected) {
  const auto* const text = value.get_ptr<const std::string*>();
  const auto word = text == nullptr
                        ? words.end()
                        : std::find(words.begin(), words.end(), std::string_view(*text));
  if (word == words.end()) refuse_value(key, expected, value);
  return static_cast<std::size_t>(word - words.begin());
}

sim::ArenaEventKind decode_event_kind(const json& value, const char* key) {
  for (int i = 0; i <= static_cast<int>(sim::kLastArenaEventKind); ++i) {
    const auto kind = static_cast<sim::ArenaEventKind>(i);
    if (value == to_string(kind)) return kind;
  }
  refuse_value(key, "a kind of event", value);
}

template <typename Value>
Value decode_value(const json& object, const char* key, WholeRange range, Encoding encoding);

template <typename List>
List decode_list(const json& value, const char* key, Encoding encoding) {
  using Element = typename List::value_type;
  List list;
  for (const json& element : require_list(value, key, kListOf<Element>)) {
    if constexpr (HasFields<Element>) {
      list.push_back(decode_fields<Element>(element, encoding));
    } else {
      static_assert(std::is_same_v<Element, std::string>);
      if (!element.is_string()) refuse_value(key, kListOf<Element>, element);
      list.push_back(element.get<std::string>());
    }
  }
  return list;
}

template <typename Map>
Map decode_map_of(const json& value, const char* key, WholeRange range, Encoding encoding) {
  const auto* members = value.get_ptr<const json::object_t*>();
  if (members == nullptr) refuse_value(key, "an object", value);
  Map map;
  for (const auto& [name, member] : *members) {
    map.emplace(name,
                decode_value<typename Map::mapped_type>(value, name.c_str(), range, encoding));
  }
  return map;
}

template <typename Value>
Value decode_value(const json& object, const char* key, WholeRange range, Encoding encoding) {
  if constexpr (std::is_same_v<Value, bool>) {
    return require_bool(object, key);
  } else if constexpr (std::is_integral_v<Value>) {
    constexpr Value kMost = std::numeric_limits<Value>::max();
    const bool fits = std::cmp_less_equal(range.most, kMost);
    return static_cast<Value>(require_integer(
        object, key, range.least, fits ? range.most : static_cast<std::int64_t>(kMost)));
  } else if constexpr (std::is_same_v<Value, double>) {
    return require_number(object, key);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return require_text(object, key);
  } else if constexpr (std::is_same_v<Value, DeviceId>) {
    return require_device_id(object, key);
  } else if constexpr (std::is_same_v<Value, sim::CellRect>) {
    return require_rect(object, key);
  } else if constexpr (std::is_same_v<Value, std::vector<std::uint8_t>>) {
    return require_bytes(object, key, encoding);
  } else if constexpr (std::is_same_v<Value, sim::ViewMode>) {
    const auto mode = sim::parse_view_mode(require_text(object, key));
    if (!mode) refuse_value(key, "ground, mini-map or full-screen", object.at(key));
    return *mode;
  } else if constexpr (std::is_same_v<Value, sim::io::MapMode>) {
    const auto mode = sim::io::parse_map_mode(require_text(object, key));
    if (!mode) refuse_value(key, "trinary or scale", object.at(key));
    return *mode;
  } else if constexpr (std::is_same_v<Value, PropertyValue>) {
    return require_property(object, key);
  } else {
    const json& value = require(object, key);
    if constexpr (kIsOptional<Value>) {
      if (value.is_null()) return std::nullopt;
      return decode_value<typename Value::value_type>(object, key, range, encoding);
    } else if constexpr (std::is_same_v<Value, sim::Pose>) {
      return decode_pose(value);
    } else if constexpr (std::is_same_v<Value, sim::CellValue>) {
      const auto cells = decode_cells(value, encoding);
      if (cells.size() != 1) throw ProtocolError("protocol/bad-value", "cell: not one");
      return cells.front();
    } else if constexpr (std::is_same_v<Value, std::vector<sim::CellValue>>) {
      return decode_cells(value, encoding);
    } else if constexpr (std::is_same_v<Value, sim::LayerKind>) {
      return sim::LayerKind(
          decode_word(value, key, kLayerKinds, R"("colour", "binary" or "grey")"));
    } else if constexpr (std::is_same_v<Value, sim::TimeMode>) {
      return decode_word(value, key, kTimeModes, R"("lockstep" or "paced")") == 0
                 ? sim::TimeMode::kLockstep
                 : sim::TimeMode::kPaced;
    } else if constexpr (std::is_same_v<Value, sim::ArenaEventKind>) {
      return decode_event_kind(value, key);
    } else if constexpr (std::is_same_v<Value, sim::Colour>) {
      const auto* text = value.get_ptr<const std::string*>();
      const auto colour = text == nullptr ? std::nullopt : sim::parse_colour(*text);
      if (!colour) refuse_value(key, "a colour like \"#34aaff\" or \"#34aaff80\"", value);
      return *colour;
    } else if constexpr (std::is_same_v<Value, sim::OccupancyMap>) {
      return decode_map(value, encoding);
    } else if constexpr (kIsMap<Value>) {
      return decode_map_of<Value>(value, key, range, encoding);
    } else if constexpr (kIsVector<Value>) {
      return decode_list<Value>(value, key, encoding);
    } else {
      return decode_fields<Value>(value, encoding);
    }
  }
}

// --- Structs

template <typename Struct, typename Value>
void encode_field(const Struct& from, const MessageField<Struct, Value>& field, Encoding encoding,
                  json& message) {
  const Value& value = from.*field.member;
  if constexpr (kIsOptional<Value>) {
    if (!value && field.presence == Presence::kOptional) return;
  }
  if constexpr (std::is_same_v<Value, sim::Vec2>) {
    message[std::string(field.key) + "_x"] = value.x();
    message[std::string(field.key) + "_y"] = value.y();
  } else {
    message[field.key] = encode_value(value, encoding);
  }
}

template <typename Struct, typename Value>
void decode_field(const json& message, const MessageField<Struct, Value>& field, Encoding encoding,
                  Struct& to) {
  Value& value = to.*field.member;
  if (field.presence != Presence::kAlways) {
    const auto member = message.find(field.key);
    if (member == message.end()) return;
    if (field.presence == Presence::kNullable && member->is_null()) return;
  }
  if constexpr (std::is_same_v<Value, sim::Vec2>) {
    const std::string key = field.key;
    value = {require_number(message, (key + "_x").c_str()),
             require_number(message, (key + "_y").c_str())};
  } else if constexpr (kIsOptional<Value>) {
    if (field.presence == Presence::kAlways && require(message, field.key).is_null()) return;
    value = decode_value<typename Value::value_type>(message, field.key, field.range, encoding);
  } else {
    value = decode_value<Value>(message, field.key, field.range, encoding);
  }
}

// The keys of a field in messages; a point has two keys.
template <typename Struct, typename Value>
void add_keys(const MessageField<Struct, Value>& field, std::vector<std::string>& keys) {
  if constexpr (std::is_same_v<Value, sim::Vec2>) {
    keys.push_back(std::string(field.key) + "_x");
    keys.push_back(std::string(field.key) + "_y");
  } else {
    keys.emplace_back(field.key);
  }
}

template <typename Struct>
std::vector<std::string_view> keys_of() {
  static const std::vector<std::string> kKeys = [] {
    std::vector<std::string> keys;
    std::apply([&](const auto&... field) { (add_keys(field, keys), ...); },
               fields_of(std::type_identity<Struct>{}));
    return keys;
  }();
  return {kKeys.begin(), kKeys.end()};
}

template <HasFields Struct>
void encode_fields(const Struct& from, Encoding encoding, json& message) {
  std::apply([&](const auto&... field) { (encode_field(from, field, encoding, message), ...); },
             fields_of(std::type_identity<Struct>{}));
}

template <HasFields Struct>
Struct decode_fields(const json& message, Encoding encoding) {
  if constexpr (std::is_same_v<Struct, sim::LayerStyle>) {
    refuse_unknown_keys(message, keys_of<Struct>(), "a style");
  }
  Struct to;
  std::apply([&](const auto&... field) { (decode_field(message, field, encoding, to), ...); },
             fields_of(std::type_identity<Struct>{}));
  if constexpr (std::is_same_v<Struct, CanvasInfo>) {
    if (to.cell_size_m <= 0.0) {
      refuse_value("cell_size", "a number greater than 0", to.cell_size_m);
    }
  }
  return to;
}

// --- Requests by type

template <typename One>
Request decode_one(const json& message, Encoding encoding) {
  std::vector<std::string_view> keys{"id", "do"};
  if constexpr (HasFields<One>) std::ranges::copy(keys_of<One>(), std::back_inserter(keys));
  refuse_unknown_keys(message, keys, "this request");
  if constexpr (HasFields<One>) return decode_fields<One>(message, encoding);
  return One{};
}

struct RequestType {
  std::string_view name;  ///< empty: never sent
  Request (*decode)(const json& message, Encoding encoding) = nullptr;
};

template <typename One>
constexpr RequestType request_type() {
  if constexpr (HasName<One>) {
    return {One::kName, decode_one<One>};
  } else {
    return {};
  }
}

template <typename... One>
constexpr auto request_types(std::type_identity<std::variant<One...>>) {
  return std::array{request_type<One>()...};
}

constexpr auto kRequestTypes = request_types(std::type_identity<Request>{});

}  // namespace

std::optional<std::size_t> find_request(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kRequestTypes.size(); ++i) {
    if (!name.empty() && kRequestTypes[i].name == name) return i;
  }
  return std::nullopt;
}

json encode_request(const Request& request, Encoding encoding) {
  json message{{"do", kRequestTypes[request.index()].name}};
  std::visit(
      [&]<typename One>(const One& what) {
        if constexpr (HasFields<One>) encode_fields(what, encoding, message);
      },
      request);
  return message;
}

Request decode_request(std::size_t type, const json& message, Encoding encoding) {
  return kRequestTypes.at(type).decode(message, encoding);
}

json encode_answer(const Request& request, const Answer& answer, Encoding encoding) {
  json message = json::object();
  std::visit(
      [&]<typename One>(const One&) {
        using Result = typename One::Result;
        if constexpr (requires { One::kAnswer; }) {
          message[One::kAnswer] = encode_value(std::get<Result>(answer), encoding);
        } else if constexpr (HasFields<Result>) {
          encode_fields(std::get<Result>(answer), encoding, message);
        }
      },
      request);
  return message;
}

Answer decode_answer(const Request& request, const json& answer, Encoding encoding) {
  return std::visit(
      [&]<typename One>(const One&) -> Answer {
        using Result = typename One::Result;
        if constexpr (requires { One::kAnswer; }) {
          return Answer(std::in_place_type<Result>,
                        decode_value<Result>(answer, One::kAnswer, {}, encoding));
        } else if constexpr (HasFields<Result>) {
          return decode_fields<Result>(answer, encoding);
        } else {
          return {};
        }
      },
      request);
}

// --- Structs outside of requests

json encode_robots(const std::vector<RobotInfo>& robots) {
  return encode_value(robots, Encoding::kJson);
}

namespace {

// Parses a robot's drivers. A newer server may have types that this program does not know.
void read_known_drivers(RobotInfo& robot, std::size_t number) {
  RobotInfo known = robot;
  std::erase_if(known.drivers, [](const sim::DriverDescription& driver) {
    return std::ranges::find(driver_types(), driver.type, &DriverType::name) ==
           driver_types().end();
  });
  try {
    read_drivers(known, "the robots of the server", "/robots/" + std::to_string(number));
  } catch (const sim::ConfigError& e) {
    throw ProtocolError("protocol/bad-value", e.what());
  }
  robot.goal_drivers = std::move(known.goal_drivers);
  robot.planners = std::move(known.planners);
  robot.scan_drivers = std::move(known.scan_drivers);
}

}  // namespace

std::vector<RobotInfo> decode_robots(const json& robots) {
  auto decoded = decode_list<std::vector<RobotInfo>>(robots, "robots", Encoding::kJson);
  for (std::size_t r = 0; r < decoded.size(); ++r) {
    const std::vector<DeviceInfo>& devices = decoded[r].devices;
    for (std::size_t d = 0; d < devices.size(); ++d) {
      if (devices[d].id == DeviceId{static_cast<int>(r), static_cast<int>(d)}) continue;
      refuse_value("device", "the indices of the robot and of the device in these lists",
                   encode_device_id(devices[d].id));
    }
  }
  for (std::size_t r = 0; r < decoded.size(); ++r) read_known_drivers(decoded[r], r);
  note_shared_ports(decoded);
  return decoded;
}

json encode_canvas(const CanvasInfo& canvas) { return encode_value(canvas, Encoding::kJson); }
CanvasInfo decode_canvas(const json& canvas) {
  return decode_fields<CanvasInfo>(canvas, Encoding::kJson);
}
json encode_time(const TimeStatistics& time) { return encode_value(time, Encoding::kJson); }
TimeStatistics decode_time(const json& time) {
  return decode_fields<TimeStatistics>(time, Encoding::kJson);
}
json encode_style(const sim::LayerStyle& style) { return encode_value(style, Encoding::kJson); }
sim::LayerStyle decode_style(const json& style) {
  return decode_fields<sim::LayerStyle>(style, Encoding::kJson);
}
json encode_layers(const std::vector<sim::LayerInfo>& layers) {
  return encode_value(layers, Encoding::kJson);
}
std::vector<sim::LayerInfo> decode_layers(const json& layers) {
  return decode_list<std::vector<sim::LayerInfo>>(layers, "layers", Encoding::kJson);
}

json encode_map(const sim::OccupancyMap& map, Encoding encoding) {
  json message =
      encode_canvas({map.width, map.height, map.cell_size_m, map.origin.x(), map.origin.y()});
  message["cells"] = encode_occupancy(map.cells, encoding);
  return message;
}

sim::OccupancyMap decode_map(const json& map, Encoding encoding) {
  const CanvasInfo grid = decode_canvas(map);
  const auto count = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  return {grid.width,
          grid.height,
          grid.cell_size_m,
          {grid.origin_x_m, grid.origin_y_m},
          decode_occupancy(require(map, "cells"), count, encoding)};
}

}  // namespace playerlike::protocol
