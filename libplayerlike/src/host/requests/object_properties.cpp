// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/requests/object_properties.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/requests/arena.h"
#include "session/checks.h"
#include "sim/core/colour.h"

namespace playerlike {
namespace {

using sim::SceneObject;
using sim::Simulation;
using Numbers = std::vector<double>;

// An object with the data for its properties: the robot or the box that it is, if any. The arena
// itself has kind "arena".
struct Subject {
  SceneObject object;
  const sim::RobotDescription* robot = nullptr;
  int robot_index = -1;
  const sim::ObstacleDescription* box = nullptr;  // a block or a separator
};

Subject subject(const Simulation& simulation, const std::string& name) {
  if (name == kArenaName && !simulation.find_object(name)) {
    Subject arena;
    arena.object.name = kArenaName;
    arena.object.kind = kArenaName;
    return arena;
  }
  Subject found{require_object(simulation, name)};
  if (const auto robot = simulation.find_robot(name)) {
    found.robot_index = *robot;
    found.robot = &simulation.world().robots[static_cast<std::size_t>(*robot)];
    return found;
  }
  const sim::ArenaDescription& arena = simulation.world().arena;
  for (const auto* boxes : {&arena.obstacles, &arena.dock_separators}) {
    for (const sim::ObstacleDescription& box : *boxes) {
      if (found.box == nullptr && box.name == found.object.name) found.box = &box;
    }
  }
  return found;
}

// E.g. block "d1", for messages.
std::string shown_name(const Subject& s) {
  return s.object.kind == kArenaName ? "the arena" : s.object.kind + " \"" + s.object.name + '"';
}

double height_m(const Simulation& simulation, const Subject& s) {
  if (s.robot != nullptr) return simulation.model(s.robot_index).height_m;
  if (s.box != nullptr) return s.box->height_m;
  if (s.object.kind == "border") return simulation.world().arena.border_height_m;
  return 0.0;  // walls of a map have no height of their own
}

const Numbers& numbers(const PropertyValue& value, const std::string& property, std::size_t least,
                       std::size_t most) {
  const auto* list = std::get_if<Numbers>(&value);
  const bool finite = list != nullptr && std::all_of(list->begin(), list->end(),
                                                     [](double x) { return std::isfinite(x); });
  if (!finite || list->size() < least || list->size() > most) {
    refuse_argument("the property \"" + property + "\" takes " + std::to_string(least) +
                    (least == most ? "" : " or " + std::to_string(most)) + " finite numbers");
  }
  return *list;
}

const std::string& text(const PropertyValue& value, const std::string& property) {
  const auto* words = std::get_if<std::string>(&value);
  if (words == nullptr) refuse_argument("the property \"" + property + "\" takes a text");
  return *words;
}

// A property: which objects have it, its getter and its setter (null: read-only).
struct Property {
  std::string_view name;
  bool (*has)(const Subject& s);
  PropertyValue (*get)(const Simulation& simulation, const Subject& s);
  void (*set)(Simulation& simulation, const Subject& s, const PropertyValue& value);
};

bool is_robot(const Subject& s) { return s.robot != nullptr; }
bool is_block(const Subject& s) { return s.object.kind == "block"; }
bool is_robot_or_block(const Subject& s) { return is_robot(s) || is_block(s); }
bool is_any(const Subject&) { return true; }
bool is_arena(const Subject& s) { return s.object.kind == kArenaName; }
bool is_object(const Subject& s) { return !is_arena(s); }

// State and height of a block now.
ArenaBlock block_now(const Simulation& simulation, const Subject& s) {
  for (ArenaBlock& block : arena_blocks(simulation)) {
    if (block.name == s.object.name) return std::move(block);
  }
  return {s.object.name, "extended", height_m(simulation, s)};  // a static one
}

constexpr Property kProperties[] = {
    {"colour", is_robot_or_block,
     [](const Simulation&, const Subject& s) -> PropertyValue {
       if (s.robot != nullptr) return sim::to_string(s.robot->colour);
       // The default colours of pictures.
       const sim::Colour by_type = s.box->type == sim::ObstacleType::kDynamic
                                       ? sim::Colour{0xd6, 0x45, 0x41, 0xff}
                                       : sim::Colour{0xcd, 0xd1, 0xd6, 0xff};
       return sim::to_string(s.box->colour.value_or(by_type));
     },
     [](Simulation& simulation, const Subject& s, const PropertyValue& value) {
       const auto colour = sim::parse_colour(text(value, "colour"));
       if (!colour) {
         refuse_argument("a colour is \"#rgb\", \"#rrggbb\" or \"#rrggbbaa\", but this is \"" +
                         text(value, "colour").substr(0, 20) + '"');
       }
       require_done(simulation.set_object_colour(s.object.name, *colour));
     }},
    {"configuration", is_arena,
     [](const Simulation& simulation, const Subject&) -> PropertyValue {
       return simulation.arena_state().configuration;
     },
     [](Simulation& simulation, const Subject&, const PropertyValue& value) {
       set_configuration(simulation, text(value, "configuration"));
     }},
    {"configurations", is_arena,
     [](const Simulation& simulation, const Subject&) -> PropertyValue {
       std::string names;
       for (const auto& configuration : simulation.world().controller.configurations) {
         names += (names.empty() ? "" : ", ") + configuration.name;
       }
       return names;
     },
     nullptr},
    {"dynamics", is_robot,
     [](const Simulation& simulation, const Subject& s) -> PropertyValue {
       return Numbers{simulation.robot_dynamics(s.robot_index) ? 1.0 : 0.0};
     },
     [](Simulation& simulation, const Subject& s, const PropertyValue& value) {
       const bool on = numbers(value, "dynamics", 1, 1).front() != 0.0;
       require_done(simulation.set_robot_dynamics(s.robot_index, on));
     }},
    {"event", is_arena,
     [](const Simulation& simulation, const Subject&) -> PropertyValue {
       const sim::ArenaEvents& events = simulation.arena_events();
       return events.newest.empty() ? std::string() : description(events.newest.back());
     },
     nullptr},
    {"events", is_arena,
     [](const Simulation& simulation, const Subject&) -> PropertyValue {
       return Numbers{static_cast<double>(simulation.arena_events().count)};
     },
     nullptr},
    {"fiducial_return", is_robot_or_block,
     [](const Simulation&, const Subject& s) -> PropertyValue {
       return Numbers{
           static_cast<double>(s.robot != nullptr ? s.robot->fiducial : s.box->fiducial)};
     },
     [](Simulation& simulation, const Subject& s, const PropertyValue& value) {
       const double number = numbers(value, "fiducial_return", 1, 1).front();
       constexpr int kMost = std::numeric_limits<std::int32_t>::max();
       if (!(number >= 0.0 && number <= kMost && number == std::floor(number))) {
         refuse_argument(
             "the property \"fiducial_return\" is a whole number from 0 (not seen) to " +
             std::to_string(kMost));
       }
       require_done(simulation.set_object_fiducial(s.object.name, static_cast<int>(number)));
     }},
    {"height", is_block,
     [](const Simulation& simulation, const Subject& s) -> PropertyValue {
       return Numbers{block_now(simulation, s).height_m};
     },
     nullptr},
    {"kind", is_any,
     [](const Simulation&, const Subject& s) -> PropertyValue { return s.object.kind; }, nullptr},
    {"model", is_robot,
     [](const Simulation&, const Subject& s) -> PropertyValue { return s.robot->model; }, nullptr},
    {"phase", is_block,
     [](const Simulation& simulation, const Subject& s) -> PropertyValue {
       return block_now(simulation, s).state;
     },
     nullptr},
    {"pose", is_object,
     [](const Simulation&, const Subject& s) -> PropertyValue {
       const sim::Pose& pose = s.object.pose;
       return Numbers{pose.x_m, pose.y_m, pose.yaw_rad};
     },
     [](Simulation& simulation, const Subject& s, const PropertyValue& value) {
       const Numbers& n = numbers(value, "pose", 3, 3);
       place_object(simulation, s.object.name, {n[0], n[1], n[2]});
     }},
    {"size", is_object,
     [](const Simulation& simulation, const Subject& s) -> PropertyValue {
       return Numbers{s.object.size.x(), s.object.size.y(), height_m(simulation, s)};
     },
     [](Simulation& simulation, const Subject& s, const PropertyValue& value) {
       const Numbers& n = numbers(value, "size", 2, 3);
       const double height = n.size() == 3 ? n[2] : height_m(simulation, s);
       require_done(simulation.set_block_size(s.object.name, {n[0], n[1]}, height));
     }},
    {"stalled", is_robot,
     [](const Simulation& simulation, const Subject& s) -> PropertyValue {
       return Numbers{simulation.body(s.robot_index).stalled ? 1.0 : 0.0};
     },
     nullptr},
    {"state", is_block,
     [](const Simulation&, const Subject& s) -> PropertyValue {
       return std::string(s.object.extended ? "extended" : "retracted");
     },
     [](Simulation& simulation, const Subject& s, const PropertyValue& value) {
       const std::string& word = text(value, "state");
       if (word != "extended" && word != "retracted") {
         refuse_argument("the state of a block is \"extended\" or \"retracted\"");
       }
       require_done(simulation.set_obstacle_state(
           s.object.name,
           word == "extended" ? sim::ObstacleState::kExtended : sim::ObstacleState::kRetracted));
     }},
    {"type", is_block,
     [](const Simulation&, const Subject& s) -> PropertyValue {
       return std::string(s.object.dynamic ? "dynamic" : "static");
     },
     nullptr},
    {"verdict", is_arena,
     [](const Simulation& simulation, const Subject&) -> PropertyValue {
       return verdict_text(simulation);
     },
     nullptr},
    {"velocity", is_robot,
     [](const Simulation& simulation, const Subject& s) -> PropertyValue {
       const sim::Twist& twist = simulation.body(s.robot_index).twist;
       return Numbers{twist.v_mps, twist.lateral_mps, twist.omega_radps};
     },
     nullptr},
};

const Property& require_property(const Subject& s, const std::string& name) {
  std::string known;
  for (const Property& property : kProperties) {
    if (!property.has(s)) continue;
    if (property.name == name) return property;
    known += (known.empty() ? "" : ", ") + std::string(property.name);
  }
  refuse_argument(shown_name(s) + " has no property \"" + name + "\"; it has: " + known);
}

}  // namespace

sim::SceneObject require_object(const Simulation& simulation, const std::string& name) {
  std::optional<SceneObject> object = simulation.find_object(name);
  if (!object) refuse_argument(simulation.no_such_object(name));
  return std::move(*object);
}

void place_object(Simulation& simulation, const std::string& name, const sim::Pose& pose) {
  // Coordinates beyond this are errors, and Box2D's arithmetic would fail.
  constexpr double kFarthest_m = 1e6;
  for (const double x : {pose.x_m, pose.y_m, pose.yaw_rad}) {
    if (!(std::abs(x) <= kFarthest_m)) {
      refuse_argument("a pose takes three finite numbers: x and y [m] and the heading [rad]");
    }
  }
  require_done(
      simulation.place_object(name, {pose.x_m, pose.y_m, sim::normalize_angle(pose.yaw_rad)}));
}

PropertyValue object_property(const Simulation& simulation, const std::string& name,
                              const std::string& property) {
  const Subject s = subject(simulation, name);
  return require_property(s, property).get(simulation, s);
}

void set_object_property(Simulation& simulation, const std::string& name,
                         const std::string& property, const PropertyValue& value) {
  const Subject s = subject(simulation, name);
  const Property& found = require_property(s, property);
  if (found.set == nullptr) {
    refuse_argument("the property \"" + property + "\" of " + shown_name(s) + " cannot be changed");
  }
  found.set(simulation, s, value);
}

}  // namespace playerlike
