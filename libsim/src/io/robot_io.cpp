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
#include "sim/io/field_reader.h"
#include "sim/io/player_options.h"
#include "sim/world/outline.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

// The type of device that a world may write as a driver, as Player's configuration files do.
constexpr const char* kDriverDevice = "amcl";

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
std::optional<Polygon> read_points(std::vector<Reader> vertices, const NumberRange& range) {
  Polygon outline;
  const Vec2 not_read = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  for (Reader& vertex : vertices) {
    outline.push_back(vertex.as_vec2(not_read, range));
    if (!outline.back().allFinite()) return std::nullopt;
  }
  if (area_m2(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

std::optional<Polygon> read_points(Reader& owner, const Field& field) {
  if (!owner.require(field.name, field.needed_for)) return std::nullopt;
  const Reader list = *owner.child(field.name);
  std::optional<Polygon> outline = read_points(owner.array(field.name), field.range);
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

void read_footprint(Reader& reader, const Field& field, void* object) {
  auto& model = *static_cast<RobotModel*>(object);
  std::optional<SolidError> error;
  if (has_parts(reader)) {
    std::vector<Vec2> corners;
    for (const Reader& part : reader.array("footprint")) {
      std::optional<Polygon> outline = read_points(part.elements(), field.range);
      if (!outline) return;
      corners.insert(corners.end(), outline->begin(), outline->end());
      model.parts.push_back(*std::move(outline));
    }
    error = check_parts(model);
    if (!error) model.footprint = convex_outline(std::move(corners));
  } else if (std::optional<Polygon> outline = read_points(reader, field)) {
    error = check_footprint(*outline);
    model.footprint = *std::move(outline);
  }
  if (!error) return;
  reader.issue("world/bad-footprint", std::move(error->expected), std::move(error->found),
               std::move(error->hint), "footprint");
}

void read_superstructures(Reader& model_reader, const Field& field, void* object) {
  auto& model = *static_cast<RobotModel*>(object);
  for (Reader& reader : model_reader.array(field.name, field.max_count)) {
    if (!reader.expect_object()) continue;
    Superstructure part;
    read_some(reader, part, {"bottom"});
    std::optional<Polygon> outline =
        read_points(reader, field_named(fields_of<Superstructure>(), "outline"));
    read_some(reader, part, {"height"});
    reader.finish();
    if (!outline || part.height_m <= 0.0) continue;
    part.outline = *std::move(outline);
    if (auto error = check_superstructure(part, model.height_m)) {
      reader.issue("world/bad-superstructure", std::move(error->expected), std::move(error->found),
                   std::move(error->hint), error->key.substr(1));
    }
    model.superstructures.push_back(std::move(part));
  }
}

void read_drive(Reader& model_reader, const Field& field, void* object) {
  std::optional<Reader> reader = model_reader.object(field.name);
  if (!reader) return;
  read_typed(*reader, "kind", drive_kinds(), field.set(object));
  reader->finish();
}

RobotModel read_model_document(Reader& root, const std::vector<DeviceType>& types) {
  RobotModel model;
  if (!root.expect_object()) return model;
  static_cast<void>(root.string("$schema", ""));
  read_fields(root, fields_of<RobotModel>(), &model);
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

const CustomField kFootprintFormat{.read = read_footprint, .or_field = "parts"};
const CustomField kSuperstructureFormat{read_superstructures};
const CustomField kDriveFormat{read_drive};

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
