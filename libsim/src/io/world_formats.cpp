// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Formats of fields of maps, time, canvas and robots that their types do not tell.
#include <set>

#include "io/document.h"
#include "sim/io/field_reader.h"
#include "sim/world/description.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

constexpr int kMorsePort = 4000;  // on this port all robots are visible

void read_tags(Reader& owner, const Field& field, void* object) {
  if (!owner.has(field.name)) return;
  std::set<std::string> tags;
  for (Reader& element : owner.array(field.name, field.max_count)) {
    const std::string tag = element.is_string() ? element.scalar_text().value_or("") : "";
    if (!is_valid_name(tag)) {
      element.issue("world/bad-name", "a tag of 1 to 64 letters, digits, _ or -",
                    element.description_for_message());
    } else {
      tags.insert(tag);
    }
  }
  *static_cast<std::vector<std::string>*>(field.set(object)) = {tags.begin(), tags.end()};
}

/// The keys that place a picture: "size" and "pose", or "resolution" and "origin".
void read_map_place(Reader& reader, const Field& field, void* object) {
  auto& map = *static_cast<MapDescription*>(object);
  if (!reader.has("size")) {
    read_as_usual(reader, field, object);
    read_some(reader, map, {"origin"});
    if (!reader.has("pose")) return;
    reader.issue("world/conflicting-keys", "\"pose\" together with \"size\"", "it alone",
                 "a map without a size has an \"origin\"", "pose");
    return;
  }
  read_some(reader, map, {"size", "pose"});
  for (const char* key : {"resolution", "origin"}) {
    if (!reader.has(key)) continue;
    reader.issue("world/conflicting-keys", "either \"size\" or \"" + std::string(key) + "\"",
                 "both", "leave one of the two out", key);
  }
}

void read_time(Reader& reader, const Field& field, void* object) {
  auto& simulation = *static_cast<SimulationDescription*>(object);
  const std::optional<Reader> time = reader.child(field.name);
  if (!time) return;
  simulation.time_mode_given = true;
  if (time->is_string()) {
    if (reader.choice(field.name, "lockstep", {"lockstep", "real"}) == "real") {
      simulation.time_mode = TimeMode::kPaced;
    }
  } else if (time->is_number()) {
    simulation.time_mode = TimeMode::kPaced;
    const Field& factor = field_named(fields_of<SimulationDescription>(), "time_factor");
    simulation.time_factor = reader.number(field.name, simulation.time_factor, factor.range);
  } else {
    reader.issue("world/wrong-type", "\"lockstep\", \"real\" or a number: how many times real time",
                 time->description_for_message(), "", field.name);
  }
}

void read_canvas_size(Reader& reader, const Field& field, void* object) {
  auto& canvas = *static_cast<CanvasDescription*>(object);
  const auto [width, height] =
      reader.integer_pair(field.name, {canvas.width, canvas.height}, field.least, field.greatest);
  canvas.width = static_cast<int>(width);
  canvas.height = static_cast<int>(height);
}

void read_port(Reader& reader, const Field& field, void* object) {
  if (!reader.has(field.name)) return;
  int& port = *static_cast<int*>(field.set(object));
  read_as_usual(reader, field, object);
  if (port != kMorsePort) return;
  reader.issue("world/reserved-port", "a port other than 4000", "4000",
               "on port 4000 all robots are visible", field.name);
  port = 0;
}

void read_real_server(Reader& reader, const Field& field, void* object) {
  read_as_usual(reader, field, object);
  const std::string& server = static_cast<RealRobotDescription*>(object)->server;
  if (!reader.has(field.name) || is_real_server(server)) return;
  reader.issue("world/bad-real-server", kRealServerExpected, in_quotes(server), "", field.name);
}

void read_real_pose(Reader& reader, const Field& field, void* object) {
  auto& real = *static_cast<RealRobotDescription*>(object);
  if (!reader.has(field.name)) return;
  const std::string text = reader.string(field.name, "position2d:0");
  const std::size_t colon = text.find(':');
  const std::string interface = text.substr(0, colon);
  const std::string index = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool is_number = !index.empty() && index.size() <= 5 &&
                         index.find_first_not_of("0123456789") == std::string::npos;
  if (is_number && (interface == "position2d" || interface == "localize")) {
    real.pose_interface = interface;
    real.pose_index = std::stoi(index);
  } else {
    reader.issue("world/bad-real-pose", "\"position2d:INDEX\" or \"localize:INDEX\"",
                 in_quotes(text), "", field.name);
  }
}

const FieldTable& no_fields() {
  static constexpr FieldTable kNone{};
  return kNone;
}

}  // namespace

const CustomField kTagsFormat{.read = read_tags, .schema = R"("items": {"$ref": "#/$defs/name"})"};
const CustomField kMapPlaceFormat{.read = read_map_place, .rules = R"("if": {"required": ["size"]},
      "then": {"properties": {"resolution": false, "origin": false}},
      "else": {"properties": {"pose": false}})"};
const CustomField kTimeFormat{
    .read = read_time, .schema = R"("enum": ["lockstep", "real"])", .or_field = "time_factor"};
const CustomField kCanvasSizeFormat{.read = read_canvas_size, .is_pair = true};
const CustomField kPortFormat{.read = read_port, .schema = R"("not": {"const": 4000})"};
const CustomField kRealServerFormat{.read = read_real_server,
                                    .schema = R"("pattern": "^(player|tcp)://.")"};
const CustomField kRealPoseFormat{.read = read_real_pose,
                                  .schema = R"("pattern": "^(position2d|localize):[0-9]{1,5}$")"};

// These are read with the parts of a world that they depend on.
const CustomField kPresetFormat{.schema = R"("type": null, "enum": ["syrotek"])",
                                .rules = R"("if": {"required": ["preset"]},
      "then": {"properties": {"size": false, "origin": false, "map": false}})"};
const CustomField kMapsFormat{.or_else = R"({"$ref": "#/$defs/map"})"};
const CustomField kDriverSettingsFormat{
    .rules =
        R"("additionalProperties": {"type": ["number", "string", "boolean", "array", "object"]})",
    .keys = no_fields};
const CustomField kProxiesFormat{
    .schema = R"("additionalProperties": {"type": "integer", "minimum": 0, "maximum": 65535})"};
const CustomField kInterfacesFormat{.schema =
                                        R"("additionalProperties": {"type": "array", "maxItems": 64,
      "items": {"$ref": "#/$defs/name"}})"};
const CustomField kDevicesFormat{.schema = R"("propertyNames": {"$ref": "#/$defs/name"},
      "additionalProperties": {"$ref": "#/$defs/device"})"};
const CustomField kModelDevicesFormat{.schema = R"("type": null, "additionalProperties": null,
      "$ref": "world.schema.json#/$defs/robot/properties/devices")"};

}  // namespace sim::io
