// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/request_codec.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "protocol/codec.h"

namespace playerlike::protocol {
namespace {

template <typename Struct>
concept HasFields = requires {
  Struct::fields();
};
template <typename One>
concept HasName = requires {
  One::kName;
};

template <typename Value>
struct IsOptional : std::false_type {};
template <typename Value>
struct IsOptional<std::optional<Value>> : std::true_type {};

constexpr int kMaxSide = 1 << 14;  // of a rectangle; canvases have no more than 8192

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

// --- Values of all kinds that requests and results have

template <typename Value>
json encode_value(const Value& value, Encoding encoding) {
  if constexpr (IsOptional<Value>::value) {
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
    return encode_layer_kind(value);
  } else if constexpr (std::is_same_v<Value, sim::LayerStyle>) {
    return encode_style(value);
  } else if constexpr (std::is_same_v<Value, std::vector<sim::LayerInfo>>) {
    return encode_layers(value);
  } else if constexpr (std::is_same_v<Value, sim::ViewMode> ||
                       std::is_same_v<Value, sim::io::MapMode>) {
    return to_string(value);
  } else if constexpr (std::is_same_v<Value, sim::OccupancyMap>) {
    return encode_map(value, encoding);
  } else if constexpr (std::is_same_v<Value, CanvasInfo>) {
    return encode_canvas(value);
  } else if constexpr (std::is_same_v<Value, TimeStatistics>) {
    return encode_time(value);
  } else if constexpr (std::is_same_v<Value, LogStatus>) {
    return encode_log(value);
  } else if constexpr (std::is_same_v<Value, PropertyValue>) {
    return encode_property(value);
  } else {
    return value;
  }
}

template <typename Value>
Value decode_value(const json& object, const char* key, WholeRange range, Encoding encoding) {
  if constexpr (IsOptional<Value>::value) {
    if (require(object, key).is_null()) return std::nullopt;
    return decode_value<typename Value::value_type>(object, key, range, encoding);
  } else if constexpr (std::is_same_v<Value, bool>) {
    return require_bool(object, key);
  } else if constexpr (std::is_integral_v<Value>) {
    return static_cast<Value>(
        require_integer(object, key, range.least,
                        std::min<std::int64_t>(range.most, std::numeric_limits<Value>::max())));
  } else if constexpr (std::is_same_v<Value, double>) {
    return require_number(object, key);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return require_text(object, key);
  } else if constexpr (std::is_same_v<Value, DeviceId>) {
    return require_device_id(object, key);
  } else if constexpr (std::is_same_v<Value, sim::Pose>) {
    return require_pose(object, key);
  } else if constexpr (std::is_same_v<Value, sim::CellRect>) {
    return require_rect(object, key);
  } else if constexpr (std::is_same_v<Value, sim::CellValue>) {
    const auto cells = decode_cells(require(object, key), encoding);
    if (cells.size() != 1) throw ProtocolError("protocol/bad-value", "cell: not one");
    return cells.front();
  } else if constexpr (std::is_same_v<Value, std::vector<sim::CellValue>>) {
    return decode_cells(require(object, key), encoding);
  } else if constexpr (std::is_same_v<Value, std::vector<std::uint8_t>>) {
    return require_bytes(object, key, encoding);
  } else if constexpr (std::is_same_v<Value, sim::LayerKind>) {
    return decode_layer_kind(require(object, key));
  } else if constexpr (std::is_same_v<Value, sim::LayerStyle>) {
    return decode_style(require(object, key));
  } else if constexpr (std::is_same_v<Value, std::vector<sim::LayerInfo>>) {
    return decode_layers(require(object, key));
  } else if constexpr (std::is_same_v<Value, sim::ViewMode>) {
    const auto mode = sim::parse_view_mode(require_text(object, key));
    if (!mode) refuse_value(key, "ground, mini-map or full-screen", object.at(key));
    return *mode;
  } else if constexpr (std::is_same_v<Value, sim::io::MapMode>) {
    const auto mode = sim::io::parse_map_mode(require_text(object, key));
    if (!mode) refuse_value(key, "trinary or scale", object.at(key));
    return *mode;
  } else if constexpr (std::is_same_v<Value, sim::OccupancyMap>) {
    return decode_map(require(object, key), encoding);
  } else if constexpr (std::is_same_v<Value, CanvasInfo>) {
    return decode_canvas(require(object, key));
  } else if constexpr (std::is_same_v<Value, TimeStatistics>) {
    return decode_time(require(object, key));
  } else if constexpr (std::is_same_v<Value, LogStatus>) {
    return decode_log(require(object, key));
  } else {
    static_assert(std::is_same_v<Value, PropertyValue>);
    return require_property(object, key);
  }
}

// --- Structs

template <typename Struct, typename Value>
void encode_field(const Struct& from, const MessageField<Struct, Value>& field, Encoding encoding,
                  json& message) {
  const Value& value = from.*field.member;
  if constexpr (IsOptional<Value>::value) {
    if (!value && field.presence == Presence::kOptional) return;
  }
  message[field.key] = encode_value(value, encoding);
}

template <typename Struct, typename Value>
void decode_field(const json& message, const MessageField<Struct, Value>& field, Encoding encoding,
                  Struct& to) {
  if (field.presence != Presence::kAlways) {
    const auto member = message.find(field.key);
    if (member == message.end()) return;
    if (field.presence == Presence::kNullable && member->is_null()) return;
  }
  if constexpr (IsOptional<Value>::value) {
    to.*field.member =
        decode_value<typename Value::value_type>(message, field.key, field.range, encoding);
  } else {
    to.*field.member = decode_value<Value>(message, field.key, field.range, encoding);
  }
}

template <HasFields Struct>
void encode_fields(const Struct& from, Encoding encoding, json& message) {
  std::apply([&](const auto&... field) { (encode_field(from, field, encoding, message), ...); },
             Struct::fields());
}

template <HasFields Struct>
Struct decode_fields(const json& message, Encoding encoding) {
  Struct to;
  std::apply([&](const auto&... field) { (decode_field(message, field, encoding, to), ...); },
             Struct::fields());
  return to;
}

// --- Requests by their types

template <typename One>
Request decode_one(const json& message, Encoding encoding) {
  std::vector<std::string_view> keys{"id", "do"};
  if constexpr (HasFields<One>) {
    std::apply([&](const auto&... field) { (keys.push_back(field.key), ...); }, One::fields());
  }
  refuse_unknown_keys(message, keys, "this request");
  if constexpr (HasFields<One>) return decode_fields<One>(message, encoding);
  return One{};
}

struct RequestType {
  std::string_view name;  ///< empty: never leaves the process
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
        if constexpr (HasFields<Result>) {
          encode_fields(std::get<Result>(answer), encoding, message);
        } else if constexpr (requires { One::kAnswer; }) {
          message[One::kAnswer] = encode_value(std::get<Result>(answer), encoding);
        }
      },
      request);
  return message;
}

Answer decode_answer(const Request& request, const json& answer, Encoding encoding) {
  return std::visit(
      [&]<typename One>(const One&) -> Answer {
        using Result = typename One::Result;
        if constexpr (HasFields<Result>) {
          return decode_fields<Result>(answer, encoding);
        } else if constexpr (requires { One::kAnswer; }) {
          return Answer(std::in_place_type<Result>,
                        decode_value<Result>(answer, One::kAnswer, {}, encoding));
        } else {
          return {};
        }
      },
      request);
}

}  // namespace playerlike::protocol
