// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/world_patch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "sim/core/degrees.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/simulation/simulation.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Replaces the name of a file by its absolute path.
void make_absolute(ordered_json& name, const fs::path& folder) {
  name = fs::absolute(folder / name.get<std::string>()).lexically_normal().string();
}

/// Whether a robot's model is the name of a file, and not of a model of Playpen.
bool is_model_file(const std::string& model) {
  return model.find('/') != std::string::npos || model.ends_with(".json");
}

/// Makes all names of other files absolute: pictures of maps, and files of robot models.
void make_names_absolute(ordered_json& root, const fs::path& folder) {
  root.erase("$schema");  // a hint for editors, relative to the file
  if (root.contains("arena") && root["arena"].contains("map")) {
    ordered_json& maps = root["arena"]["map"];
    if (maps.is_array()) {
      for (ordered_json& map : maps) make_absolute(map.at("image"), folder);
    } else {
      make_absolute(maps.at("image"), folder);
    }
  }
  if (!root.contains("robots")) return;
  for (ordered_json& robot : root["robots"]) {
    if (robot.contains("model") && is_model_file(robot["model"].get<std::string>())) {
      make_absolute(robot["model"], folder);
    }
  }
}

/// The number of degrees that the reader turns into this angle, to the bit if there is one.
double degrees_of(double yaw_rad) {
  const double nearest = yaw_rad / sim::kDegrees;
  for (const double degrees :
       {nearest, std::nextafter(nearest, -1000.0), std::nextafter(nearest, 1000.0)}) {
    if (sim::normalize_angle(degrees * sim::kDegrees) == yaw_rad) return degrees;
  }
  return nearest;
}

/// Sets the start of a robot. The reader gives robots without a pose free places, which depend on
/// the other robots, so these get the poses that they have now.
void set_start(ordered_json& root, const sim::WorldDescription& world, std::size_t index,
               const StartPose& start) {
  if (!root.contains("robots")) {
    root["robots"] = ordered_json::array();
    for (const sim::RobotDescription& robot : world.robots) {
      root["robots"].push_back({{"name", robot.name}});
    }
  }
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    ordered_json& robot = root["robots"].at(i);
    const sim::Pose& pose = world.robots[i].pose;
    if (i == index) {
      robot["pose"] = {{"x", start.x_m}, {"y", start.y_m}, {"yaw_deg", start.yaw_deg}};
    } else if (!robot.contains("pose")) {
      robot["pose"] = {{"x", pose.x_m}, {"y", pose.y_m}, {"yaw_deg", degrees_of(pose.yaw_rad)}};
    }
  }
}

void set_blocks(ordered_json& root, const sim::WorldDescription& world,
                const std::set<std::string>& extended) {
  if (!root.contains("arena")) root["arena"] = {{"preset", "syrotek"}};
  ordered_json& arena = root["arena"];
  arena["extended"] = ordered_json::array();
  arena["retracted"] = ordered_json::array();
  for (const sim::ObstacleDescription& obstacle : world.arena.obstacles) {
    if (obstacle.type != sim::ObstacleType::kDynamic) continue;
    arena[extended.contains(obstacle.name) ? "extended" : "retracted"].push_back(obstacle.name);
  }
}

/// The words of a JSON pointer.
std::vector<std::string> words_of(const std::string& pointer) {
  std::vector<std::string> words;
  for (ordered_json::json_pointer rest(pointer); !rest.empty(); rest.pop_back()) {
    words.push_back(rest.back());
  }
  std::reverse(words.begin(), words.end());
  return words;
}

/// Sets a value. Objects get missing members; lists do not get missing elements.
void set_value(ordered_json& root, const std::string& file, const WorldValue& value) {
  ordered_json* place = &root;
  for (const std::string& word : words_of(value.pointer)) {
    if (place->is_null()) *place = ordered_json::object();
    if (place->is_object()) {
      place = &(*place)[word];
      continue;
    }
    std::size_t index = 0;
    const char* const end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data(), end, index);
    if (!place->is_array() || error != std::errc() || rest != end || index >= place->size()) {
      throw sim::ConfigError(sim::ConfigIssue{
          "plan/parameter", file, value.pointer, "a place that the world file has",
          place->is_array()
              ? "a list of " + std::to_string(place->size()) + " before '" + word + "'"
              : "neither an object nor a list before '" + word + "'"});
    }
    place = &(*place)[index];
  }
  *place = ordered_json::parse(value.value);
}

}  // namespace

JsonWorld read_json_world(const std::string& file, const char* purpose) {
  if (file.empty()) {
    sim::WorldDescription world = sim::load_world("");
    return {ordered_json{{"name", world.name}}.dump(), std::move(world)};
  }
  std::string text;
  if (sim::read_whole_file(file, {}, text) ||
      !ordered_json::accept(text, /*ignore_comments=*/true)) {
    static_cast<void>(sim::load_world(file));  // throws, unless it can read other formats
    throw sim::ConfigError(sim::ConfigIssue{
        "task/world-of-stage", file, "", std::string("a world file in JSON for ") + purpose,
        "a file of Stage or Player, or a pipe", "translate it with playpen import"});
  }
  return {text, sim::load_world_text(text, file)};
}

std::string patched_world(const std::string& text, const sim::WorldDescription& world,
                          const WorldPatch& patch) {
  ordered_json root = ordered_json::parse(text, nullptr, true, /*ignore_comments=*/true);
  make_names_absolute(root, fs::path(world.file).parent_path());
  if (patch.start) set_start(root, world, patch.robot, *patch.start);
  if (patch.extended) set_blocks(root, world, *patch.extended);
  for (const WorldValue& value : patch.values) set_value(root, world.file, value);
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace playpen::grade
