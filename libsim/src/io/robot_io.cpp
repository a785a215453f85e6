// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/robot_io.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "io/solid_limits.h"
#include "sim/io/player_options.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim::io {
namespace {

// The type of device that a world may write as a driver, as Player's configuration files do.
constexpr const char* kDriverDevice = "amcl";

constexpr NumberRange kVertex{-100.0, 100.0, false, "m"};
constexpr NumberRange kRobotLength{kLeastLength_m, 100.0, false, "m"};

std::vector<std::string> type_names(const std::vector<DeviceType>& types) {
  std::vector<std::string> names;
  for (const DeviceType& type : types) names.push_back(type.name);
  return names;
}

const DeviceType* find_type(const std::vector<DeviceType>& types, const std::string& name) {
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&name](const DeviceType& t) { return t.name == name; });
  return type == types.end() ? nullptr : &*type;
}

void read_device(Reader& settings, const std::string& name,
                 const std::vector<std::string>& of_model, const std::vector<DeviceType>& types,
                 std::map<std::string, DeviceDescription>& devices) {
  const auto of_same_name = devices.find(name);
  const bool known = of_same_name != devices.end();
  std::string type_name = known ? of_same_name->second.type : name;
  if (settings.has("type")) {
    const std::vector<std::string> names = type_names(types);
    const std::string wanted = settings.choice("type", "", names);
    if (std::find(names.begin(), names.end(), wanted) == names.end()) return;
    type_name = wanted;
  }
  const DeviceType* type = find_type(types, type_name);
  if (type == nullptr) {
    settings.issue("world/unknown-device",
                   "a device that the model has (" + list_text(of_model) +
                       "), or a \"type\" for a new one (" + list_text(type_names(types)) + ")",
                   in_quotes(name) + " without a type", did_you_mean(name, of_model));
    return;
  }
  const bool has_base = known && of_same_name->second.type == type_name;
  const std::any base = has_base ? of_same_name->second.params : type->defaults();
  std::any params = type->parse(settings, base);
  settings.finish();
  std::set<std::string> given;
  if (has_base) given.insert(of_same_name->second.given.begin(), of_same_name->second.given.end());
  for (const std::string& key : settings.keys()) given.insert(key);
  devices[name] = {name, type_name, std::move(params), {given.begin(), given.end()}};
}

// Reads points; in the result they are counter-clockwise. nullopt if one is none.
std::optional<Polygon> read_points(std::vector<Reader> vertices) {
  Polygon outline;
  const Vec2 not_read = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  for (Reader& vertex : vertices) {
    outline.push_back(vertex.as_vec2(not_read, kVertex));
    if (!outline.back().allFinite()) return std::nullopt;
  }
  if (area_m2(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

std::optional<Polygon> read_points(Reader& owner, const char* key) {
  if (!owner.require(key, "the outline: a list of points [x, y] round it, in m")) {
    return std::nullopt;
  }
  const Reader list = *owner.child(key);
  std::optional<Polygon> outline = read_points(owner.array(key));
  return list.is_array() ? outline : std::nullopt;
}

// Whether a footprint is a list of parts, each a list of points.
bool has_parts(Reader& model) {
  const std::optional<Reader> footprint = model.child("footprint");
  if (!footprint) return false;
  const std::vector<Reader> parts = footprint->elements();
  if (parts.empty()) return false;
  const std::vector<Reader> points = parts.front().elements();
  return !points.empty() && points.front().is_array();
}

void read_footprint(Reader& reader, RobotModel& model) {
  std::optional<SolidError> error;
  if (has_parts(reader)) {
    std::vector<Vec2> corners;
    for (const Reader& part : reader.array("footprint")) {
      std::optional<Polygon> outline = read_points(part.elements());
      if (!outline) return;
      corners.insert(corners.end(), outline->begin(), outline->end());
      model.parts.push_back(*std::move(outline));
    }
    error = check_parts(model);
    if (!error) model.footprint = convex_outline(std::move(corners));
  } else if (std::optional<Polygon> outline = read_points(reader, "footprint")) {
    error = check_footprint(*outline);
    model.footprint = *std::move(outline);
  }
  if (!error) return;
  reader.issue("world/bad-footprint", std::move(error->expected), std::move(error->found),
               std::move(error->hint), "footprint");
}

std::vector<Superstructure> read_superstructures(Reader& model, double body_height_m) {
  std::vector<Superstructure> all;
  for (Reader& reader : model.array("superstructures", kMostSuperstructures)) {
    if (!reader.expect_object()) continue;
    Superstructure part;
    part.bottom_m =
        reader.number("bottom", part.bottom_m, {0.0, kGreatestRobotHeight_m, false, "m"});
    const std::optional<Polygon> outline = read_points(reader, "outline");
    const bool has_height = reader.require("height", "the height of its top above the floor, in m");
    part.height_m = reader.number("height", part.height_m,
                                  {kLeastLength_m, kGreatestRobotHeight_m, false, "m"});
    reader.finish();
    if (!outline || !has_height || part.height_m <= 0.0) continue;
    part.outline = *outline;
    if (auto error = check_superstructure(part, body_height_m)) {
      reader.issue("world/bad-superstructure", std::move(error->expected), std::move(error->found),
                   std::move(error->hint), error->key.substr(1));
    }
    all.push_back(std::move(part));
  }
  return all;
}

DriveDescription read_drive(Reader& model) {
  DriveDescription drive;
  std::optional<Reader> reader = model.object("drive");
  if (!reader) return drive;
  const std::string kind =
      reader->choice("kind", "differential", {"differential", "omnidirectional", "car"});
  drive.wheel_radius_m = reader->number("wheel_radius", drive.wheel_radius_m, kRobotLength);
  drive.wheel_separation_m =
      reader->number("wheel_separation", drive.wheel_separation_m, kRobotLength);
  if (kind == "omnidirectional") drive.kind = DriveKind::kOmnidirectional;
  if (kind == "car") {
    drive.kind = DriveKind::kCar;
    drive.wheelbase_m = reader->number("wheelbase", drive.wheelbase_m, kRobotLength);
    drive.max_steering_rad =
        reader->angle_deg("max_steering_deg", drive.max_steering_rad, {0.0, 80.0, true, "degrees"});
    drive.max_steering_rate_radps = reader->angle_deg(
        "max_steering_rate_deg", drive.max_steering_rate_radps, {0.0, 3600.0, false, "degrees/s"});
    drive.steering_commands =
        reader->choice("commands", "turn_rate", {"turn_rate", "steering"}) == "steering";
  }
  reader->finish();
  return drive;
}

RobotModel read_model_document(Reader& root, const std::vector<DeviceType>& types) {
  RobotModel model;
  if (!root.expect_object()) return model;
  static_cast<void>(root.string("$schema", ""));
  if (root.require("name", "what to call the model")) model.name = root.name("name", "");
  model.description = root.string("description", "");
  read_footprint(root, model);
  model.solid = root.boolean("solid", model.solid);
  model.height_m =
      root.number("height", model.height_m, {kLeastLength_m, kGreatestRobotHeight_m, false, "m"});
  model.superstructures = read_superstructures(root, model.height_m);
  model.mass_kg =
      root.number("mass", model.mass_kg, {kLeastMass_kg, kGreatestMass_kg, false, "kg"});
  model.drive = read_drive(root);
  model.max_speed_mps = root.number("max_speed", model.max_speed_mps, {0.0, 20.0, true, "m/s"});
  model.max_turn_rate_radps = root.angle_deg("max_turn_rate_deg", model.max_turn_rate_radps,
                                             {0.0, 3600.0, true, "degrees/s"});
  model.devices = read_devices(root, {}, types);
  model.interfaces = read_interfaces(root, model.devices, {});
  root.finish();
  return model;
}

/// Reads a model's text. Issues are added to `document`; the model is valid only if there are none.
RobotModel read_model_text(std::string_view text, Reader::Document& document,
                           const std::vector<DeviceType>& types) {
  if (text.size() > kMaxFileBytes) {
    document.add({"file/too-large", document.file, "", "at most 16 MiB", "more", ""});
  } else if (parse_document(text, document)) {
    Reader root(document, document.root, "");
    return read_model_document(root, types);
  }
  return {};
}

bool is_file_name(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(".json");
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest_word(word, known);
  return near.empty() ? "" : "did you mean " + in_quotes(near) + "?";
}

std::vector<DeviceDescription> default_devices(Reader& place, const RobotModel& model,
                                               const std::vector<DeviceType>& types) {
  std::vector<DeviceDescription> devices = model.devices;
  for (DeviceDescription& device : devices) {
    if (device.params.has_value()) continue;
    if (const DeviceType* type = find_type(types, device.type)) {
      device.params = type->defaults();
    } else {
      place.issue("world/unknown-device-type",
                  "one of the types that this program has: " + list_text(type_names(types)),
                  in_quotes(device.type) + ", which the model " + model.name + " carries");
    }
  }
  return devices;
}

std::vector<DeviceDescription> read_devices(Reader& owner, std::vector<DeviceDescription> base,
                                            const std::vector<DeviceType>& types) {
  std::map<std::string, DeviceDescription> devices;
  for (DeviceDescription& device : base) devices.emplace(device.name, device);
  std::vector<std::string> of_model;
  for (const auto& [name, device] : devices) of_model.push_back(name);

  if (std::optional<Reader> reader = owner.object("devices")) {
    for (const std::string& name : reader->keys()) {
      Reader settings = *reader->child(name);
      const bool known = devices.contains(name);
      if (!is_valid_name(name)) {
        settings.issue("world/bad-name", "a name of 1 to 64 letters, digits, _ or -",
                       in_quotes(name));
      } else if (settings.is_null() || settings.scalar_text() == "false") {
        if (known) {
          devices.erase(name);
        } else {
          settings.issue(
              "world/unknown-device", "a device that the model has: " + list_text(of_model),
              in_quotes(name) + ", which is not there to be removed", did_you_mean(name, of_model));
        }
      } else if (!settings.is_object()) {
        settings.issue("world/wrong-type",
                       "an object {...} of settings, or null for no such device",
                       settings.description_for_message());
      } else {
        read_device(settings, name, of_model, types, devices);
      }
    }
  }
  std::vector<DeviceDescription> all;
  for (auto& [name, device] : devices) all.push_back(std::move(device));
  return all;
}

bool is_driver_device(Reader& driver) {
  const std::optional<Reader> type = driver.child("type");
  return type && type->is_string() && type->scalar_text() == kDriverDevice;
}

void read_driver_device(Reader& driver, std::vector<DeviceDescription>& devices,
                        const std::vector<DeviceType>& types) {
  std::map<std::string, DeviceDescription> all;
  for (DeviceDescription& device : devices) all.emplace(device.name, std::move(device));
  const std::string name = kDriverDevice;
  if (all.contains(name)) {
    driver.issue("world/duplicate-name", "one amcl for a robot, as a device or as a driver",
                 "another device " + in_quotes(name),
                 "further ones are \"devices\" with names of their own", "type");
  } else {
    driver.explain_unknown_keys(
        [](std::string_view key) { return hint_for_player_option(kDriverDevice, key); });
    read_device(driver, name, {}, types, all);
  }
  devices.clear();
  for (auto& [key, device] : all) devices.push_back(std::move(device));
}

std::map<std::string, std::vector<std::string>> read_interfaces(
    Reader& owner, const std::vector<DeviceDescription>& devices,
    const std::map<std::string, std::vector<std::string>>& base) {
  std::vector<std::string> known;
  for (const DeviceDescription& device : devices) known.push_back(device.name);
  // A model's order of interfaces applies to those of its devices that the robot still has.
  std::map<std::string, std::vector<std::string>> interfaces = base;
  for (auto& [interface, names] : interfaces) {
    std::erase_if(names, [&](const std::string& name) {
      return std::find(known.begin(), known.end(), name) == known.end();
    });
  }
  std::optional<Reader> reader = owner.object("interfaces");
  if (!reader) return interfaces;
  for (const std::string& interface : reader->keys()) {
    std::vector<std::string> names;
    for (Reader& element : reader->array(interface, 64)) {
      const std::string name = element.is_string() ? element.scalar_text().value_or("") : "";
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        element.issue("world/unknown-device",
                      "the name of a device of this robot: " + list_text(known),
                      element.description_for_message(), did_you_mean(name, known));
      } else if (std::find(names.begin(), names.end(), name) != names.end()) {
        element.issue("world/duplicate-name", "each device once", in_quotes(name) + " again",
                      "a device has one index of an interface");
      } else {
        names.push_back(name);
      }
    }
    interfaces[interface] = std::move(names);
  }
  return interfaces;
}

Elevation read_elevation(Reader& robot) {
  Elevation elevation;
  std::optional<Reader> reader = robot.object("elevation");
  if (!reader) return elevation;
  elevation.z_m = reader->number("z", 0.0, {-kFarthest_m, kFarthest_m, false, "m"});
  elevation.roll_rad = reader->angle_deg("roll_deg", 0.0);
  elevation.pitch_rad = reader->angle_deg("pitch_deg", 0.0);
  reader->finish();
  return elevation;
}

std::vector<std::string> read_tags(Reader& owner) {
  std::set<std::string> tags;
  for (Reader& element : owner.array("tags", 64)) {
    const std::string tag = element.is_string() ? element.scalar_text().value_or("") : "";
    if (!is_valid_name(tag)) {
      element.issue("world/bad-name", "a tag of 1 to 64 letters, digits, _ or -",
                    element.description_for_message());
    } else {
      tags.insert(tag);
    }
  }
  return {tags.begin(), tags.end()};
}

std::optional<RealRobotDescription> read_real_robot(Reader& robot) {
  std::optional<Reader> reader = robot.object("real");
  if (!reader) return std::nullopt;
  RealRobotDescription real;
  if (reader->require("server", kRealServerExpected)) {
    real.server = reader->string("server", "");
    if (!is_real_server(real.server)) {
      reader->issue("world/bad-real-server", kRealServerExpected, in_quotes(real.server), "",
                    "server");
    }
  }
  real.port = static_cast<int>(reader->integer("port", real.port, 1, 65535));
  if (reader->choice("drive", "real", {"real", "both"}) == "both") {
    real.drive = RealRobotDescription::Drive::kBoth;
  }
  const std::string on_lost =
      reader->choice("on_lost", "continue", {"continue", "end", "reconnect"});
  if (on_lost == "end") real.on_lost = RealRobotDescription::OnLost::kEnd;
  if (on_lost == "reconnect") real.on_lost = RealRobotDescription::OnLost::kReconnect;
  real.watchdog_s = reader->number("watchdog", real.watchdog_s, {0.05, 600.0, false, "s"});
  real.take_over = reader->boolean("take_over", real.take_over);
  if (reader->has("pose")) {
    const std::string text = reader->string("pose", "position2d:0");
    const std::size_t colon = text.find(':');
    const std::string interface = text.substr(0, colon);
    const std::string index = colon == std::string::npos ? "" : text.substr(colon + 1);
    const bool is_number = !index.empty() && index.size() <= 5 &&
                           index.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && (interface == "position2d" || interface == "localize")) {
      real.pose_interface = interface;
      real.pose_index = std::stoi(index);
    } else {
      reader->issue("world/bad-real-pose", "\"position2d:INDEX\" or \"localize:INDEX\"",
                    in_quotes(text), "", "pose");
    }
  }
  real.X_WF = reader->pose("offset", real.X_WF);
  reader->finish();
  return real;
}

std::optional<RobotModel> read_model(Reader& robot, const std::string& name,
                                     Reader::Document& world,
                                     const std::vector<DeviceType>& types) {
  Reader::Document document;
  document.what = "robot model";
  std::string text;
  if (is_file_name(name)) {
    const auto given = world.files == nullptr ? std::map<std::string, std::string>::const_iterator()
                                              : world.files->find(name);
    const bool in_memory = world.files != nullptr && given != world.files->end();
    document.file = in_memory ? name : (folder_of(world.file) / name).string();
    if (in_memory) text = given->second;
    if (!in_memory &&
        !read_file(document.file, text, document, "a file with a robot model", NamedBy::kFile)) {
      const ConfigIssue& why = document.issues.front();
      robot.issue(
          "world/model-unreadable", "a file with a robot model", document.file + ": " + why.found,
          why.hint.empty() ? "the name is relative to the folder of the world file" : why.hint,
          "model");
      return std::nullopt;
    }
  } else {
    std::vector<std::string> known{default_robot_model().name};
    for (const ShippedModel& model : shipped_models()) {
      known.emplace_back(model.name);
      if (model.name != name) continue;
      document.file = "models/" + name + ".json";
      text = model.text;
    }
    if (text.empty()) {
      robot.issue("world/unknown-model",
                  "one of the models " + list_text(known) + ", or a file NAME.json",
                  in_quotes(name), did_you_mean(name, known), "model");
      return std::nullopt;
    }
  }
  RobotModel model = read_model_text(text, document, types);
  if (document.issues.empty()) return model;
  for (ConfigIssue& issue : document.issues) world.add(std::move(issue));
  return std::nullopt;
}

RobotModel read_robot_model(const std::string& path, const std::vector<DeviceType>& device_types) {
  Reader::Document document;
  document.file = path;
  document.what = "robot model";
  std::string text;
  if (!read_file(path, text, document, "a file with a robot model")) throw_issues(document);
  RobotModel model = read_model_text(text, document, device_types);
  throw_issues(document);
  return model;
}

}  // namespace sim::io
