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
#include "field_pages.h"
#include "known_keys.h"
#include "sim/io/world_io.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim::io {
namespace {

using nlohmann::json;

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
          {"move": {"zz": 0, "obstacle": "", "to": [1, 1]}}
        ]
      }],
      "traps": [
        {"zz": 0, "region": {"zz": 0, "box": {"zz": 0, "center": [1, 1]}}},
        {"region": {"circle": {"zz": 0, "center": [1, 1]}}},
        {"near": {"zz": 0, "place": [1, 1]}}
      ]
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
      {"/arena/obstacles/1/motion/area", "motion_area"},
      {"/arena/obstacles/2/motion", "motion_pedestrian"},
      {"/arena/obstacles/2/motion/force", "social_force"},
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
      {"/controller/traps/0", "trap"},
      {"/controller/traps/0/region", "region"},
      {"/controller/traps/0/region/box", "region_box"},
      {"/controller/traps/1/region/circle", "region_circle"},
      {"/controller/traps/2/near", "near"},
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

TEST(WorldSchema, MatchesFieldsOfDevices) {
  const std::string file = std::string(PLAYPEN_SOURCE_DIR) + "/worlds/schema/world.schema.json";
  const std::string now = test_support::read_bytes(file);
  const std::string made = test::json_text(test::with_devices(test::Json::parse(now))) + "\n";
  if (test::writes_pages()) test::write_page(file, made);
  EXPECT_TRUE(now == made || test::writes_pages())
      << file << " is not what the fields say: set PLAYPEN_WRITE_PAGES=1 to write it anew";
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

TEST(WorldSchema, HasRobotModels) {
  json names{default_robot_model().name};
  for (const ShippedModel& model : shipped_models()) names.push_back(model.name);
  std::sort(names.begin(), names.end());
  json listed = schema().at("$defs").at("robot").at("properties").at("model").at("examples");
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, names);
}

}  // namespace
}  // namespace sim::io
