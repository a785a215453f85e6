// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "device_table.h"
#include "field_schema.h"
#include "known_keys.h"
#include "sim/io/world_io.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

using nlohmann::json;
using test::Json;

// --- The generated schemas

/// The schema of the object under a device's name in a world file.
Json device_schema(const DeviceKind& kind) {
  Json properties = {{"type", {{"$ref", "#/$defs/device_type"}}}};
  test::for_each_setting(kind, [&properties](const Field& field, const void* defaults) {
    test::add_schema(field, defaults, properties);
  });
  const Json settings = {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  return {{"description", "Settings of a device of type " + kind.name +
                              "; those left out keep the model's, or have their defaults."},
          {"oneOf", {settings, {{"$ref", "#/$defs/removed"}}}}};
}

/// Adds the definitions of devices.
void add_devices(Json& definitions) {
  definitions["device_type"] = {
      {"description",
       "Kind of device, e.g. \"laser\". Needed for a new device whose name is no type."},
      {"type", "string"}};
  definitions["removed"] = {{"description", "Removes the device."}, {"enum", {nullptr, false}}};
  Json& device = definitions["device"];
  device = {{"oneOf",
             {{{"description",
                "Settings; which there are depends on the type. Left out ones keep the model's."},
               {"type", "object"},
               {"properties", {{"type", {{"$ref", "#/$defs/device_type"}}}}}},
              {{"$ref", "#/$defs/removed"}}}}};
  const Field& frequency = field_named(*find_device_kind("clock")->settings, "frequency");
  test::add_schema(frequency, nullptr, device["oneOf"][0]["properties"]);
  std::vector<std::string> names;
  for (const DeviceKind& kind : device_kinds()) names.push_back(kind.name);
  std::sort(names.begin(), names.end());
  Json devices = Json::object();
  for (const std::string& name : names) {
    devices[name] = {{"$ref", "#/$defs/device_" + name}};
    definitions["device_" + name] = device_schema(*find_device_kind(name));
  }
  definitions.at("robot").at("properties").at("devices")["properties"] = devices;
}

/// A file's schema, with the key "$schema".
Json file_schema(const std::string& title, const std::string& description, const Json& object) {
  Json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"$comment",
       "Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause. Generated "
       "from the tables of fields: PLAYPEN_WRITE_PAGES=1 with the tests writes it anew."},
      {"title", title},
      {"description", description + " SI units; angles in degrees. Comments // and /* */ are "
                                    "allowed."}};
  schema.update(object);
  Json properties = {{"$schema",
                      {{"description",
                        "Name of this schema, so that editors help while you type. "
                        "The simulator does not look at it."},
                       {"type", "string"}}}};
  properties.update(object.at("properties"));
  schema["properties"] = properties;
  return schema;
}

/// The schema of robot models.
Json model_schema() {
  Json definitions = Json::object();
  RobotModel defaults;
  const Json object = test::SchemaMaker(&definitions).object(fields_of<RobotModel>(), &defaults);
  Json schema = file_schema("Playpen robot model",
                            "A robot model that worlds refer to by \"model\"; see "
                            "docs/robot_models.md.",
                            object);
  schema["$defs"] = definitions;
  return schema;
}

/// The schema of worlds.
/// @param drivers  a schema of worlds with definitions of drivers, which are copied: they are those
///                 of another library (driver_pages_test.cpp).
Json world_schema(const Json& drivers) {
  Json definitions = Json::object();
  WorldDescription defaults;
  const Json object =
      test::SchemaMaker(&definitions).object(fields_of<WorldDescription>(), &defaults);
  Json& models = definitions.at("robot").at("properties").at("model")["examples"];
  models.push_back(default_robot_model().name);
  for (const ShippedModel& model : shipped_models()) models.push_back(model.name);
  std::sort(models.begin(), models.end());
  add_devices(definitions);
  Json all = Json::object();
  for (const auto& [key, definition] : definitions.items()) {
    all[key] = definition;
    if (key != "driver") continue;
    const Json& old = drivers.at("$defs");
    if (old.contains(key) && old.at(key).contains("allOf"))
      all[key]["allOf"] = old.at(key)["allOf"];
    for (const auto& [name, driver] : old.items()) {
      if (name.starts_with("driver_")) all[name] = driver;
    }
  }
  Json schema = file_schema("Playpen world",
                            "A world for Playpen: an arena, robots with their devices, and how "
                            "time runs. Everything may be left out: {} is the SyRoTek arena with "
                            "one robot. docs/world_format.md explains the format at length.",
                            object);
  schema["$defs"] = all;
  return schema;
}

// --- The committed files

json schema() {
  std::ifstream stream(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/schema/world.schema.json");
  return json::parse(stream);
}

/// The keys that the reader knows in each object, by the object's pointer. They come from the
/// reader's messages about an unknown key ("zz").
std::map<std::string, std::set<std::string>> keys_of_reader() {
  constexpr const char* kWorld = R"({
    "zz": 0,
    "arena": {
      "zz": 0,
      "obstacles": [
        {"zz": 0, "center": [1, 1], "motion": {"zz": 0, "type": "path", "points": [[1, 1]]}},
        {"center": [2, 2], "motion": {"zz": 0, "type": "random_walk", "area": {"zz": 0}}},
        {"center": [3, 3], "motion": {"zz": 0, "type": "pedestrian", "points": [[1, 1]],
                                      "force": {"zz": 0}}}
      ],
      "docks": [{"zz": 0, "pose": {"zz": 0}}],
      "dock_separators": [{"zz": 0, "center": [1, 1]}],
      "map": {"zz": 0, "image": ""}
    },
    "simulation": {"zz": 0},
    "canvas": {"zz": 0},
    "robots": [{"zz": 0, "pose": {"zz": 0}}],
    "controller": {
      "zz": 0,
      "configurations": {"a": {"zz": 0}},
      "timers": [{
        "zz": 0,
        "if": [
          {"zz": 0, "time": {"zz": 0}}, {"count": {"zz": 0, "of": ""}},
          {"block": {"zz": 0, "name": ""}}, {"collisions": {"zz": 0}}, {"speed": {"zz": 0}},
          {"battery": {"zz": 0}}, {"score": {"zz": 0}}, {"fiducial": {"zz": 0, "number": 1}}
        ],
        "do": [
          {"zz": 0, "place": {"zz": 0, "obstacle": "", "pose": {}}},
          {"text": {"zz": 0, "text": ""}}, {"canvas": {"zz": 0}}, {"restart": {"zz": 0}},
          {"score": {"zz": 0}}, {"end": {"zz": 0, "verdict": "passed"}},
          {"move": {"zz": 0, "obstacle": "", "to": [1, 1]}}, {"fault": {"zz": 0, "device": ""}}
        ]
      }],
      "traps": [
        {"zz": 0, "region": {"zz": 0, "box": {"zz": 0, "center": [1, 1]}}},
        {"region": {"circle": {"zz": 0, "center": [1, 1]}}},
        {"near": {"zz": 0, "place": [1, 1]}}
      ]
    },
    "fuzz": {
      "zz": 0, "obstacles": {"zz": 0}, "moving": {"zz": 0}, "doors": {"zz": 0},
      "corridors": {"zz": 0}, "maps": {"zz": 0}, "noise": {"zz": 0},
      "faults": {"zz": 0}
    }
  })";
  return test_support::known_keys(
      [&] { static_cast<void>(read_world_text(kWorld, "<memory>", test::device_table())); });
}

std::set<std::string> keys_of(const json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

TEST(WorldSchema, HasKeysOfReader) {
  const json root = schema();
  const std::map<std::string, std::string> definitions{
      {"", ""},
      {"/arena", "arena"},
      {"/arena/obstacles/0", "obstacle"},
      {"/arena/obstacles/0/motion", "motion_path"},
      {"/arena/obstacles/1/motion", "motion_random_walk"},
      {"/arena/obstacles/1/motion/area", "area"},
      {"/arena/obstacles/2/motion", "motion_pedestrian"},
      {"/arena/obstacles/2/motion/force", "force"},
      {"/arena/docks/0", "dock"},
      {"/arena/docks/0/pose", "pose"},
      {"/arena/dock_separators/0", "dock_separator"},
      {"/arena/map", "map"},
      {"/simulation", "simulation"},
      {"/canvas", "canvas"},
      {"/robots/0", "robot"},
      {"/robots/0/pose", "pose"},
      {"/controller", "controller"},
      {"/controller/configurations/a", "configuration"},
      {"/controller/timers/0", "timer"},
      {"/controller/timers/0/if/0", "condition"},
      {"/controller/timers/0/if/0/time", "condition_time"},
      {"/controller/timers/0/if/1/count", "condition_count"},
      {"/controller/timers/0/if/2/block", "condition_block"},
      {"/controller/timers/0/if/3/collisions", "condition_collisions"},
      {"/controller/timers/0/if/4/speed", "condition_speed"},
      {"/controller/timers/0/if/5/battery", "condition_battery"},
      {"/controller/timers/0/if/6/score", "condition_score"},
      {"/controller/timers/0/if/7/fiducial", "condition_fiducial"},
      {"/controller/timers/0/do/0", "action"},
      {"/controller/timers/0/do/0/place", "action_place"},
      {"/controller/timers/0/do/1/text", "action_text"},
      {"/controller/timers/0/do/2/canvas", "action_canvas"},
      {"/controller/timers/0/do/3/restart", "action_restart"},
      {"/controller/timers/0/do/4/score", "action_score"},
      {"/controller/timers/0/do/5/end", "action_end"},
      {"/controller/timers/0/do/6/move", "action_move"},
      {"/controller/timers/0/do/7/fault", "action_fault"},
      {"/controller/traps/0", "trap"},
      {"/controller/traps/0/region", "region"},
      {"/controller/traps/0/region/box", "region_box"},
      {"/controller/traps/1/region/circle", "region_circle"},
      {"/controller/traps/2/near", "near"},
      {"/fuzz", "fuzz"},
      {"/fuzz/obstacles", "obstacles"},
      {"/fuzz/moving", "moving"},
      {"/fuzz/doors", "doors"},
      {"/fuzz/corridors", "corridors"},
      {"/fuzz/maps", "maps"},
      {"/fuzz/noise", "noise"},
      {"/fuzz/faults", "faults"},
  };
  const std::map<std::string, std::set<std::string>> known = keys_of_reader();
  ASSERT_EQ(known.size(), definitions.size());
  for (const auto& [pointer, keys] : known) {
    ASSERT_TRUE(definitions.contains(pointer)) << pointer;
    const std::string& name = definitions.at(pointer);
    const json& definition = name.empty() ? root : root.at("$defs").at(name);
    EXPECT_EQ(keys, keys_of(definition.at("properties"))) << pointer;
    EXPECT_EQ(definition.at("additionalProperties"), false) << pointer;
  }
}

/// Compares a schema with the generated one, or writes it.
void expect_generated(const std::string& name, const std::function<Json(const Json& now)>& make) {
  const std::string file = std::string(PLAYPEN_SOURCE_DIR) + "/worlds/schema/" + name;
  const std::string now = test_support::read_bytes(file);
  const std::string made = test::json_text(make(Json::parse(now))) + "\n";
  if (test::writes_pages()) test::write_page(file, made);
  EXPECT_TRUE(now == made || test::writes_pages())
      << file << " is not what the fields say: set PLAYPEN_WRITE_PAGES=1 to write it anew";
}

TEST(WorldSchema, World_MatchesFields) { expect_generated("world.schema.json", world_schema); }

TEST(WorldSchema, FuzzOfTask_MatchesFields) {
  expect_generated("task.schema.json", [](const Json& now) {
    Json made = now;
    made["$defs"]["fuzz"] = {{"description",
                              "What playpen fuzz may change; the keys replace those "
                              "of the world. docs/fuzz.md explains them."}};
    FuzzDescription defaults;
    made["$defs"]["fuzz"].update(
        test::SchemaMaker().object(fields_of<FuzzDescription>(), &defaults));
    return made;
  });
}

TEST(WorldSchema, Model_MatchesFields) {
  expect_generated("model.schema.json", [](const Json&) { return model_schema(); });
}

void expect_table(const std::string& page, const std::string& heading, const std::string& made) {
  EXPECT_TRUE(
      test::is_table_of_page(std::string(PLAYPEN_SOURCE_DIR) + "/docs/" + page, heading, made))
      << page << ", " << heading << ": PLAYPEN_WRITE_PAGES=1 writes it anew\n"
      << made;
}

template <typename Part>
std::string table_of(std::initializer_list<std::string> only = {}) {
  const Part defaults{};
  return test::fields_table(fields_of<Part>(), &defaults, {only.begin(), only.end()});
}

TEST(WorldPages, Tables_MatchFields) {
  const std::string worlds = "world_format.md";
  expect_table(worlds, "## Top level", table_of<WorldDescription>());
  expect_table(worlds, "## `arena`", table_of<ArenaDescription>());
  expect_table(worlds, "### `obstacles`, `dock_separators`", table_of<ObstacleDescription>());
  expect_table(worlds, "### `docks`", table_of<DockDescription>());
  expect_table(worlds, "### `map`", table_of<MapDescription>());
  expect_table(worlds, "## `simulation`", table_of<SimulationDescription>());
  expect_table(worlds, "## `canvas`", table_of<CanvasDescription>());
  expect_table(worlds, "## `robots`", table_of<RobotDescription>());
  expect_table(worlds, "### `elevation`", table_of<Elevation>());
  expect_table(worlds, "### `real`", table_of<RealRobotDescription>());

  expect_table("robot_models.md", "## A model of your own", table_of<RobotModel>());
  expect_table("robot_models.md", "### Superstructures", table_of<Superstructure>());
  expect_table("robot_models.md", "### Drives", table_of<DriveDescription>());

  const std::string moving = "moving_obstacles.md";
  expect_table(moving, "## Motions",
               table_of<ObstacleMotion>({"speed", "turn_rate_deg", "facing", "wait", "points",
                                         "repeat", "leg", "area", "force"}));
  expect_table(moving, "### Forces on pedestrians", table_of<SocialForce>());
  expect_table(moving, "## Obstacles that can be pushed",
               table_of<ObstacleDescription>({"mass", "friction"}));

  const std::string fuzz = "fuzz.md";
  expect_table(fuzz, "## Bounds", table_of<FuzzDescription>());
  expect_table(fuzz, "### `obstacles`", table_of<FuzzDescription::Obstacles>());
  expect_table(fuzz, "### `moving`", table_of<FuzzDescription::Moving>());
  expect_table(fuzz, "### `doors`, `corridors`", table_of<FuzzDescription::Passages>());
  expect_table(fuzz, "### `maps`", table_of<FuzzDescription::Maps>());
  expect_table(fuzz, "### `noise`", table_of<FuzzDescription::Noise>());
  expect_table(fuzz, "### `faults`", table_of<FuzzDescription::Faults>());

  const std::string controller = "arena_controller.md";
  expect_table(controller, "## Configurations", table_of<ArenaConfiguration>());
  expect_table(controller, "## Blocks that take their time",
               table_of<ObstacleDescription>({"rise_speed", "when_blocked"}));
  expect_table(controller, "## Timers", table_of<TimerDescription>());
  expect_table(controller, "## Traps", table_of<TrapDescription>());
  for (const Kind& kind : field_named(fields_of<TimerDescription>(), "do").kinds) {
    ArenaAction action;
    const auto table = [&] { return test::fields_table(kind.table(), kind.make(&action)); };
    if (kind.word == std::string("move")) expect_table(moving, "## The action `move`", table());
    if (kind.word == std::string("fault")) {
      expect_table(controller, "## Faults of devices", table());
    }
  }
}

TEST(WorldSchema, ExplainsEachKey) {
  const json root = schema();
  std::vector<const json*> objects{&root};
  for (const json& definition : root.at("$defs")) objects.push_back(&definition);
  int count = 0;
  for (const json* object : objects) {
    if (!object->contains("properties")) continue;
    for (const auto& [key, property] : object->at("properties").items()) {
      const json& described =
          property.contains("description") || !property.contains("$ref")
              ? property
              : root.at(json::json_pointer(property.at("$ref").get<std::string>().substr(1)));
      EXPECT_TRUE(described.contains("description")) << key;
      ++count;
    }
  }
  EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace sim::io
