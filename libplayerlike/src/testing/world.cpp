// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/testing/world.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "sim/core/degrees.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"
#include "testing/world_content.h"

namespace playpen::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kWorldInCode = "<world of the test>";

ordered_json list_of(double a, double b) { return ordered_json::array({a, b}); }

double degrees_of(double angle_rad) { return angle_rad / sim::kDegrees; }

ordered_json box_of(const Pose& pose, const Size& size) {
  return {{"center", list_of(pose.x_m, pose.y_m)},
          {"size", list_of(size.x_m, size.y_m)},
          {"yaw_deg", degrees_of(pose.yaw_rad)}};
}

std::string in_quotes(const std::string& text) { return '"' + text + '"'; }

// The folders of shipped worlds, in the order of `playpen list`.
constexpr const char* kWorldFolders[] = {"", "tasks", "examples", "devices"};

std::string hint_of_worlds(const std::string& name, const std::string& shipped) {
  std::vector<std::string> known;
  for (const char* folder : kWorldFolders) {
    std::error_code error;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(fs::path(shipped) / folder, error)) {
      if (entry.path().extension() == ".json") known.push_back(entry.path().stem().string());
    }
  }
  const std::string near = sim::nearest_word(fs::path(name).stem().string(), known);
  return near.empty() ? "; `playpen list worlds` shows the shipped ones"
                      : "; did you mean " + in_quotes(near) + '?';
}

// A file of the user, or of the shipped worlds.
std::string world_file(const std::string& name, const std::string& shipped) {
  std::error_code error;
  if (fs::is_regular_file(name, error)) return name;
  if (!shipped.empty()) {
    for (const char* folder : kWorldFolders) {
      for (const char* ending : {"", ".json"}) {
        const fs::path file = fs::path(shipped) / folder / (name + ending);
        if (fs::is_regular_file(file, error)) return file.string();
      }
    }
  }
  throw Error("World::File: there is no world " + in_quotes(name) +
              (shipped.empty() ? "; the folder of the shipped worlds is not known: link the CMake "
                                 "target playpen::testing"
                               : hint_of_worlds(name, shipped)));
}

ordered_json json_of_file(const std::string& file) {
  if (fs::path(file).extension() == ".world") {
    throw Error("World::File: " + file +
                " is a world of Stage; make a world file of it by `playpen import`");
  }
  std::string text;
  constexpr std::size_t kMostWorld = std::size_t{16} << 20U;
  if (const auto error = sim::read_whole_file(file, {.most_bytes = kMostWorld}, text)) {
    throw Error("World::File: " + file + ": " + error->found);
  }
  ordered_json json = ordered_json::parse(text, nullptr, /*allow_exceptions=*/false,
                                          /*ignore_comments=*/true);
  if (json.is_object()) return json;
  try {
    static_cast<void>(sim::load_world(file));  // says where the mistake is
  } catch (const sim::ConfigError& e) {
    throw Error(e.what());
  }
  throw Error("World::File: " + file + " is no JSON object");
}

}  // namespace

// --- Values

Value::Value(double number)
    : json_(std::isfinite(number) ? sim::shortest_text(number)
                                  : ordered_json(sim::shortest_text(number)).dump()) {}
Value::Value(int number) : json_(std::to_string(number)) {}
Value::Value(bool flag) : json_(flag ? "true" : "false") {}
Value::Value(const char* text) : Value(std::string(text)) {}
Value::Value(const std::string& text)
    : json_(ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace)) {}

Value Value::Json(std::string json) {
  if (!ordered_json::accept(json)) throw Error("Value::Json: this is no JSON: " + json);
  Value value;
  value.json_ = std::move(json);
  return value;
}

// --- The content

sim::WorldDescription World::Content::description() const {
  try {
    return sim::load_world_text(json.dump(), file.empty() ? kWorldInCode : file);
  } catch (const sim::ConfigError& e) {
    throw Error(e.what());
  }
}

ordered_json& World::Content::object(const char* key) {
  ordered_json& found = json[key];
  if (found.is_null()) found = ordered_json::object();
  if (!found.is_object()) throw Error(std::string("World: /") + key + " is no object of the file");
  return found;
}

ordered_json& World::Content::robots() {
  ordered_json& found = json["robots"];
  if (found.is_null()) found = ordered_json::array();
  if (!found.is_array()) throw Error("World: /robots is no list of the file");
  return found;
}

ordered_json* World::Content::find_robot(const std::string& name) {
  if (!json.contains("robots")) return nullptr;
  int number = 0;
  for (ordered_json& robot : robots()) {
    const std::string unnamed = "r" + std::to_string(++number);  // its name in the world then
    if (robot.is_object() && robot.value("name", ordered_json(unnamed)) == name) return &robot;
  }
  return nullptr;
}

void World::Content::add_obstacle(const char* kind, const std::string& name,
                                  ordered_json obstacle) {
  obstacle["name"] = name.empty() ? kind + std::to_string(++numbers[kind]) : name;
  ordered_json& all = object("arena")["obstacles"];
  if (all.is_null()) all = ordered_json::array();
  if (!all.is_array()) throw Error("World: /arena/obstacles is no list of the file");
  all.push_back(std::move(obstacle));
}

// --- World

World::World() : content_(std::make_unique<Content>()) { content_->json["name"] = "test"; }
World::World(const World& other) : content_(std::make_unique<Content>(*other.content_)) {}
World::World(World&& other) noexcept = default;
World& World::operator=(World other) noexcept {
  content_ = std::move(other.content_);
  return *this;
}
World::~World() = default;

World& World::File(const std::string& name, const std::string& shipped) {
  if (content_->json.size() > 1 || !content_->file.empty()) {
    throw Error("World::File: call it first; the world would lose what was added before");
  }
  const std::string file = world_file(name, shipped);
  content_->json = json_of_file(file);
  content_->file = file;
  return *this;
}

World& World::Name(const std::string& name) {
  content_->json["name"] = name;
  return *this;
}

World& World::Room(double width_m, double height_m) {
  ordered_json& arena = content_->object("arena");
  arena.erase("preset");
  arena["size"] = list_of(width_m, height_m);
  return *this;
}

World& World::Robot(const std::string& name, const Pose& pose, const std::string& model) {
  ordered_json* robot = content_->find_robot(name);
  if (robot == nullptr) {
    content_->robots().push_back({{"name", name}});
    robot = &content_->robots().back();
  }
  (*robot)["pose"] = {{"x", pose.x_m}, {"y", pose.y_m}, {"yaw_deg", degrees_of(pose.yaw_rad)}};
  if (!model.empty()) (*robot)["model"] = model;
  return *this;
}

World& World::Wall(const Point& from, const Point& to, double thickness_m,
                   const std::string& name) {
  const double dx = to.x_m - from.x_m;
  const double dy = to.y_m - from.y_m;
  const Pose middle{0.5 * (from.x_m + to.x_m), 0.5 * (from.y_m + to.y_m), sim::math::atan2(dy, dx)};
  content_->add_obstacle("wall", name, box_of(middle, {sim::math::hypot(dx, dy), thickness_m}));
  return *this;
}

World& World::Box(const Pose& pose, const Size& size, const std::string& name) {
  content_->add_obstacle("box", name, box_of(pose, size));
  return *this;
}

World& World::Circle(const Point& center, double radius_m, const std::string& name) {
  content_->add_obstacle(
      "circle", name,
      {{"shape", "circle"}, {"center", list_of(center.x_m, center.y_m)}, {"radius", radius_m}});
  return *this;
}

World& World::MovingCircle(const std::vector<Point>& points, double radius_m, double speed_mps,
                           const std::string& name) {
  if (points.size() < 2) {
    throw Error("World::MovingCircle: expected at least two points, found " +
                std::to_string(points.size()));
  }
  ordered_json way = ordered_json::array();
  for (std::size_t i = 1; i < points.size(); ++i) {
    way.push_back(list_of(points[i].x_m, points[i].y_m));
  }
  content_->add_obstacle("moving", name,
                         {{"shape", "circle"},
                          {"center", list_of(points[0].x_m, points[0].y_m)},
                          {"radius", radius_m},
                          {"motion",
                           {{"type", "path"},
                            {"speed", speed_mps},
                            {"repeat", "back_and_forth"},
                            {"points", std::move(way)}}}});
  return *this;
}

World& World::Block(const Pose& pose, const Size& size, const std::string& name, bool extended) {
  ordered_json block = box_of(pose, size);
  block["type"] = "dynamic";
  if (!extended) block["state"] = "retracted";
  content_->add_obstacle("block", name, std::move(block));
  return *this;
}

World& World::Crate(const Pose& pose, const Size& size, double mass_kg, const std::string& name) {
  ordered_json crate = box_of(pose, size);
  crate["mass"] = mass_kg;
  content_->add_obstacle("crate", name, std::move(crate));
  return *this;
}

World& World::Goal(const std::string& robot, const Point& point, double tolerance_m) {
  if (!std::isfinite(point.x_m) || !std::isfinite(point.y_m) || !(tolerance_m > 0.0)) {
    throw Error("World::Goal: expected a point and a tolerance above 0, found x " +
                sim::shortest_text(point.x_m) + ", y " + sim::shortest_text(point.y_m) +
                ", tolerance " + sim::shortest_text(tolerance_m));
  }
  content_->goals.push_back({robot, point, tolerance_m});
  return *this;
}

World& World::Seed(unsigned seed) {
  content_->object("simulation")["seed"] = seed;
  return *this;
}

World& World::Realism(const std::string& level) {
  content_->object("simulation")["realism"] = level;
  return *this;
}

World& World::Duration(double seconds) {
  content_->object("simulation")["duration"] = seconds;
  return *this;
}

World& World::Set(const std::string& pointer, const Value& value) {
  try {
    content_->json[ordered_json::json_pointer(pointer)] = ordered_json::parse(value.json());
  } catch (const nlohmann::json::exception& e) {
    throw Error(
        "World::Set: " + in_quotes(pointer) +
        " is no place in the world, expected a JSON pointer such as \"/robots/0/pose/x\": " +
        e.what());
  }
  return *this;
}

World& World::Set(const std::string& device, const std::string& setting, const Value& value) {
  const std::size_t dot = device.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == device.size()) {
    throw Error("World::Set: expected ROBOT.DEVICE such as r1.laser, found " + in_quotes(device));
  }
  ordered_json* const robot = content_->find_robot(device.substr(0, dot));
  if (robot == nullptr) {
    throw Error("World::Set: the world has no robot " + in_quotes(device.substr(0, dot)) +
                " yet; call Robot() first");
  }
  ordered_json& devices = (*robot)["devices"];
  if (devices.is_null()) devices = ordered_json::object();
  if (!devices.is_object())
    throw Error("World::Set: the robot's devices are no object of the file");
  ordered_json& settings = devices[device.substr(dot + 1)];
  if (settings.is_null()) settings = ordered_json::object();
  if (!settings.is_object()) throw Error("World::Set: " + device + " is no object of the file");
  settings[setting] = ordered_json::parse(value.json());
  return *this;
}

std::string World::json() const { return content_->json.dump(2); }

}  // namespace playpen::testing
