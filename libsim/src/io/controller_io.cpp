// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/controller_io.h"

#include <set>

#include "io/document.h"
#include "sim/io/field_reader.h"
#include "world/controller_fields.h"

namespace sim::io {
namespace {

/// The surroundings of an object, or of a place, which are a circle.
void read_near(Reader& reader, TrapRegion& region) {
  NearRegion near;
  read_fields(reader, region_kinds().back().table(), &near);
  const auto middle = only_key(reader, {"object", "place"}, "the middle of the surroundings", true);
  if (middle == "place") {
    const FieldTable& fields = region_kinds().back().table();
    const Vec2 place = reader.vec2("place", {0.0, 0.0}, field_named(fields, "place").range);
    region = CircleRegion{place, near.distance_m};
  } else {
    region = near;
  }
}

void read_region(Reader& trap_reader, const Field& field, void* object) {
  auto& trap = *static_cast<TrapDescription*>(object);
  const auto where = only_key(trap_reader, {"region", "near"}, "a trap's place", true);
  if (!where) return;
  std::optional<Reader> reader = trap_reader.object(*where);
  if (!reader) return;
  if (where == "near") {
    read_near(*reader, trap.region);
  } else {
    read_kind(*reader, field.kinds.first(field.kinds.size() - 1), field.issue_expected,
              &trap.region);
  }
  reader->finish();
}

void read_robots(Reader& trap_reader, const Field& field, void* object) {
  const std::optional<Reader> robots = trap_reader.child(field.name);
  if (robots && robots->is_string()) {
    static_cast<void>(trap_reader.choice(field.name, "any", {"any"}));
  } else {
    read_as_usual(trap_reader, field, object);
  }
}

void read_stay(Reader& trap_reader, const Field& field, void* object) {
  read_as_usual(trap_reader, field, object);
  const auto on = static_cast<TrapDescription*>(object)->on;
  if (!trap_reader.has(field.name) || on == TrapDescription::On::kStay) return;
  trap_reader.issue(
      "world/conflicting-keys", "\"for\" only with \"on\": \"stay\"",
      std::string("\"on\": ") + (on == TrapDescription::On::kLeave ? "\"leave\"" : "\"enter\""), "",
      field.name);
}

void read_first_time(Reader& timer_reader, const Field& field, void* object) {
  auto& timer = *static_cast<TimerDescription*>(object);
  timer.at_s = timer.every_s;
  read_as_usual(timer_reader, field, object);
}

void read_random_time(Reader& timer_reader, const Field& field, void* object) {
  read_as_usual(timer_reader, field, object);
  if (!timer_reader.has(field.name) || !timer_reader.has("at")) return;
  timer_reader.issue("world/conflicting-keys", "either \"at\" or \"within\"", "both",
                     "\"within\" makes the first time random", "at");
}

/// Names the elements of a list that have no name: the first free of prefix1, prefix2, ...
template <typename List>
void name_unnamed(List& list, const char* prefix) {
  std::set<std::string> taken;
  for (const auto& element : list) taken.insert(element.name);
  int number = 0;
  for (auto& element : list) {
    while (element.name.empty()) {
      const std::string name = prefix + std::to_string(++number);
      if (taken.insert(name).second) element.name = name;
    }
  }
}

}  // namespace

const CustomField kTrapRegionFormat{
    .read = read_region, .rules = R"("oneOf": [{"required": ["region"]}, {"required": ["near"]}])"};
const CustomField kTrapRobotsFormat{.read = read_robots, .or_else = R"({"const": "any"})"};
const CustomField kTrapStayFormat{read_stay};
const CustomField kFirstTimeFormat{read_first_time};
const CustomField kRandomTimeFormat{.read = read_random_time,
                                    .rules = R"("not": {"required": ["at", "within"]})"};
const CustomField kNearPlaceFormat{
    .rules = R"("oneOf": [{"required": ["object"]}, {"required": ["place"]}])"};

ControllerDescription read_controller(Reader& root) {
  ControllerDescription controller;
  std::optional<Reader> reader = root.object("controller");
  if (!reader) return controller;
  read_fields(*reader, fields_of<ControllerDescription>(), &controller);
  name_unnamed(controller.timers, "timer");
  name_unnamed(controller.traps, "trap");
  reader->finish();
  return controller;
}

}  // namespace sim::io
