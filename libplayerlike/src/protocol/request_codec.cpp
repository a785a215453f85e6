// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/request_codec.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "protocol/codec.h"
#include "protocol/field_codec.h"
#include "protocol/request_fields.h"
#include "sim/core/error.h"

namespace playerlike::protocol {

std::optional<std::size_t> find_request(std::string_view name) noexcept {
  const auto& kinds = request_kinds();
  const auto kind = std::ranges::find(kinds, name, &RequestKind::name);
  if (name.empty() || kind == kinds.end()) return std::nullopt;
  return static_cast<std::size_t>(kind - kinds.begin());
}

json encode_request(const Request& request, Encoding encoding) {
  const RequestKind& kind = request_kinds()[request.index()];
  json message{{"do", kind.name}};
  write_fields(kind.fields(), sim::object_in(request), message, encoding);
  return message;
}

Request decode_request(std::size_t type, const json& message, Encoding encoding,
                       Spare<sim::CellValue>* spare) {
  const RequestKind& kind = request_kinds().at(type);
  refuse_unknown_keys(message, {"id", "do"}, kind.fields(), "this request");
  Request request = kind.make();
  auto* const image = std::get_if<SetCellsRequest>(&request);
  if (image != nullptr && spare != nullptr) image->cells = spare->take();
  read_fields(kind.fields(), message, encoding, sim::object_in(request));
  return request;
}

json encode_answer(const Request& request, const Answer& answer, Encoding encoding) {
  json message = json::object();
  write_fields(request_kinds()[request.index()].answer(), sim::object_in(answer), message,
               encoding);
  return message;
}

Answer decode_answer(const Request& request, const json& answer, Encoding encoding) {
  const RequestKind& kind = request_kinds()[request.index()];
  Answer decoded = kind.make_answer();
  read_fields(kind.answer(), answer, encoding, sim::object_in(decoded));
  return decoded;
}

// --- Structs outside of requests

namespace {

template <typename Struct>
json encode_struct(const Struct& value) {
  json message = json::object();
  write_fields(sim::fields_of<Struct>(), &value, message, Encoding::kJson);
  return message;
}

template <typename Struct>
Struct decode_struct(const json& message) {
  Struct value;
  read_fields(sim::fields_of<Struct>(), message, Encoding::kJson, &value);
  return value;
}

template <typename Struct>
json encode_list(const std::vector<Struct>& values) {
  json list = json::array();
  for (const Struct& value : values) list.push_back(encode_struct(value));
  return list;
}

template <typename Struct>
std::vector<Struct> decode_list(const json& values, const char* key, const char* expected) {
  std::vector<Struct> list;
  for (const json& value : require_list(values, key, expected)) {
    list.push_back(decode_struct<Struct>(value));
  }
  return list;
}

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

json encode_robots(const std::vector<RobotInfo>& robots) { return encode_list(robots); }

std::vector<RobotInfo> decode_robots(const json& robots) {
  auto decoded = decode_list<RobotInfo>(robots, "robots", "a list of robots");
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

json encode_canvas(const CanvasInfo& canvas) { return encode_struct(canvas); }
CanvasInfo decode_canvas(const json& canvas) { return decode_struct<CanvasInfo>(canvas); }
json encode_time(const TimeStatistics& time) { return encode_struct(time); }
TimeStatistics decode_time(const json& time) { return decode_struct<TimeStatistics>(time); }
json encode_style(const sim::LayerStyle& style) { return encode_struct(style); }
sim::LayerStyle decode_style(const json& style) {
  refuse_unknown_keys(style, {}, sim::fields_of<sim::LayerStyle>(), "a style");
  return decode_struct<sim::LayerStyle>(style);
}
json encode_layers(const std::vector<sim::LayerInfo>& layers) { return encode_list(layers); }
std::vector<sim::LayerInfo> decode_layers(const json& layers) {
  return decode_list<sim::LayerInfo>(layers, "layers", "a list of layers");
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
