// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/controller_io.h"

#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/document.h"
#include "io/motion_io.h"
#include "sim/world/limits.h"

namespace sim::io {
namespace {

constexpr std::size_t kMostTraps = 10'000;
constexpr std::size_t kMostTimers = 1000;
constexpr std::size_t kMostConfigurations = 1000;
constexpr std::size_t kMostParts = 100;  // conditions, actions, corners
constexpr std::size_t kMostNames = 10'000;

constexpr NumberRange kPlaceRange{-kFarthest_m, kFarthest_m, false, "m"};
constexpr NumberRange kLengthRange{0.0, kGreatestLength_m, true, "m"};
constexpr NumberRange kTimeRange{0.0, kLongestArenaTime_s, false, "s"};

std::string name_in(Reader& element) {
  if (element.is_string()) return *element.scalar_text();
  element.issue("world/wrong-type", "a name in double quotes", element.description_for_message());
  return {};
}

std::vector<std::string> read_names(Reader& owner, std::string_view key) {
  std::vector<std::string> names;
  for (Reader& element : owner.array(key, kMostNames)) names.push_back(name_in(element));
  return names;
}

/// A text that must be there. @param what  for the message.
std::string required_text(Reader& owner, std::string_view key, const char* what) {
  if (!owner.require(key, what)) return {};
  return owner.string(key, "");
}

/// The key of `kinds` that an object has; nullopt and an issue unless it has exactly one.
/// @param has_other_keys  the object may have other keys. Otherwise an unknown key is the issue.
std::optional<std::string> only_key(Reader& owner, const std::vector<std::string>& kinds,
                                    const char* what, bool has_other_keys = false) {
  std::vector<std::string> found;
  for (const std::string& kind : kinds) {
    if (owner.has(kind)) found.push_back(kind);
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    owner.issue("world/conflicting-keys",
                std::string(what) + " with one of the keys " + list_text(kinds),
                list_text(found, " and "),
                has_other_keys ? "leave one of them out" : "write an object for each of them");
  } else if (has_other_keys || owner.keys().empty()) {
    owner.issue("world/missing-key", std::string(what) + ": one of the keys " + list_text(kinds),
                "none");
  }
  return std::nullopt;
}

ArenaLimits read_limits(Reader& reader, double lowest, double highest, const char* unit = "") {
  ArenaLimits limits;
  const NumberRange range{lowest, highest, false, unit};
  limits.at_least = reader.number("at_least", limits.at_least, range);
  limits.at_most = reader.number("at_most", limits.at_most, range);
  return limits;
}

/// The member `key` as an object; its keys are checked after read(object).
template <typename Read>
void with_object(Reader& owner, std::string_view key, Read read) {
  std::optional<Reader> object = owner.object(key);
  if (!object) return;
  read(*object);
  object->finish();
}

WhenBlocked read_when_blocked_of(Reader& reader) {
  return reader.choice("when_blocked", "refuse", {"refuse", "wait"}) == "wait"
             ? WhenBlocked::kWait
             : WhenBlocked::kRefuse;
}

// --- Conditions

ArenaCondition read_quantity(Reader& owner, const std::string& kind) {
  QuantityCondition condition;
  double most = 1e9;
  const char* unit = "";
  if (kind == "speed") {
    condition.quantity = RobotQuantity::kSpeed;
    unit = "m/s";
  } else if (kind == "battery") {
    condition.quantity = RobotQuantity::kBattery;
    most = 100.0;
    unit = "%";
  } else if (kind == "score") {
    condition.quantity = RobotQuantity::kScore;
  }
  const double least = kind == "score" ? -most : 0.0;
  with_object(owner, kind, [&](Reader& reader) {
    condition.robot = reader.string("robot", "");
    condition.limits = read_limits(reader, least, most, unit);
  });
  return condition;
}

ArenaCondition read_condition_of(Reader& owner, const std::string& kind) {
  if (kind == "time") {
    TimeCondition time;
    with_object(owner, kind, [&](Reader& reader) {
      time.from_s = reader.number("from", time.from_s, kTimeRange);
      time.to_s = reader.number("to", time.to_s, kTimeRange);
    });
    return time;
  }
  if (kind == "count") {
    CountCondition count;
    with_object(owner, kind, [&](Reader& reader) {
      count.of = required_text(reader, "of", "the name of a timer or trap");
      count.limits = read_limits(reader, 0.0, 1e9);
    });
    return count;
  }
  if (kind == "block") {
    BlockCondition block;
    with_object(owner, kind, [&](Reader& reader) {
      block.block = required_text(reader, "name", "the name of a dynamic obstacle");
      const std::vector<std::string> words = {"extended", "retracted", "rising", "sinking"};
      const std::string word = reader.choice("state", words.front(), words);
      for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == word) block.phase = static_cast<BlockPhase>(i);
      }
    });
    return block;
  }
  if (kind == "fiducial") {
    FiducialCondition fiducial;
    with_object(owner, kind, [&](Reader& reader) {
      fiducial.robot = reader.string("robot", "");
      if (!reader.require("number", "the number of a robot or an obstacle")) return;
      fiducial.number = static_cast<int>(
          reader.integer("number", fiducial.number, 1, std::numeric_limits<std::int32_t>::max()));
    });
    return fiducial;
  }
  return read_quantity(owner, kind);
}

std::vector<ArenaCondition> read_conditions(Reader& owner) {
  std::vector<ArenaCondition> conditions;
  for (Reader& reader : owner.array("if", kMostParts)) {
    if (!reader.expect_object()) continue;
    const auto kind = only_key(
        reader, {"time", "count", "block", "collisions", "speed", "battery", "score", "fiducial"},
        "a condition");
    if (kind) conditions.push_back(read_condition_of(reader, *kind));
    reader.finish();
  }
  return conditions;
}

// --- Actions

TextAction read_text(Reader& reader, const ArenaDescription& arena) {
  TextAction text;
  text.text = required_text(reader, "text", "what is shown");
  text.place = reader.vec2("place", arena.origin + 0.5 * arena.size, kPlaceRange);
  text.duration_s = reader.number("duration", text.duration_s, kTimeRange);
  text.colour = reader.colour("colour", text.colour);
  return text;
}

CanvasAction read_canvas_action(Reader& reader) {
  CanvasAction canvas;
  if (reader.has("colour")) canvas.colour = reader.colour("colour", {});
  const bool has_center = reader.has("center");
  const bool has_size = reader.has("size");
  if (!has_center && !has_size) return canvas;
  CanvasAction::Area area;
  if (reader.require("center", "[x, y] of the middle of the rectangle, in m")) {
    area.center = reader.vec2("center", area.center, kPlaceRange);
  }
  if (reader.require("size", "[x, y]: the sides of the rectangle, in m")) {
    area.size = reader.vec2("size", area.size, kLengthRange);
  }
  canvas.area = area;
  return canvas;
}

std::optional<ArenaAction> read_block_action(Reader& owner, const std::string& kind) {
  using Change = BlocksAction::Change;
  for (const auto& [key, change] :
       {std::pair("extend", Change::kExtend), std::pair("retract", Change::kRetract),
        std::pair("toggle", Change::kToggle)}) {
    if (kind == key) return BlocksAction{change, read_names(owner, kind)};
  }
  return std::nullopt;
}

ArenaAction read_action_of(Reader& owner, const std::string& kind, const ArenaDescription& arena) {
  if (auto blocks = read_block_action(owner, kind)) return *std::move(blocks);
  if (kind == "configuration") return ConfigurationAction{owner.string(kind, "")};
  if (kind == "message") return MessageAction{owner.string(kind, "")};
  if (kind == "enable") return SwitchAction{true, read_names(owner, kind)};
  if (kind == "disable") return SwitchAction{false, read_names(owner, kind)};
  ArenaAction action;
  with_object(owner, kind, [&](Reader& reader) {
    if (kind == "place") {
      PlaceAction place;
      place.obstacle = required_text(reader, "obstacle", "the name of an obstacle");
      if (reader.require("pose", "{\"x\", \"y\", \"yaw_deg\"} of its middle")) {
        place.pose = reader.pose("pose", {});
      }
      action = place;
    } else if (kind == "text") {
      action = read_text(reader, arena);
    } else if (kind == "canvas") {
      action = read_canvas_action(reader);
    } else if (kind == "restart") {
      RestartAction restart;
      restart.robot = reader.string("robot", "");
      restart.when_blocked = read_when_blocked_of(reader);
      action = restart;
    } else if (kind == "score") {
      ScoreAction score;
      score.robot = reader.string("robot", "");
      score.points = reader.number("points", score.points, {-1e6, 1e6, false, ""});
      action = score;
    } else if (kind == "move") {
      action = read_move(reader);
    } else {
      EndAction end;
      if (reader.require("verdict", "\"passed\" or \"failed\"")) {
        end.passed = reader.choice("verdict", "passed", {"passed", "failed"}) == "passed";
      }
      end.reason = reader.string("reason", "");
      action = end;
    }
  });
  return action;
}

std::vector<ArenaAction> read_actions(Reader& owner, const ArenaDescription& arena) {
  std::vector<ArenaAction> actions;
  for (Reader& reader : owner.array("do", kMostParts)) {
    if (!reader.expect_object()) continue;
    const auto kind =
        only_key(reader,
                 {"configuration", "extend", "retract", "toggle", "place", "message", "text",
                  "canvas", "restart", "score", "enable", "disable", "end", "move"},
                 "an action");
    if (kind) actions.push_back(read_action_of(reader, *kind, arena));
    reader.finish();
  }
  return actions;
}

// --- Configurations, timers and traps

ArenaConfiguration read_configuration(Reader& reader, const std::string& name) {
  using Others = ArenaConfiguration::Others;
  ArenaConfiguration configuration;
  configuration.name = name;
  configuration.extended = read_names(reader, "extended");
  configuration.retracted = read_names(reader, "retracted");
  const std::string others = reader.choice("others", "keep", {"keep", "extended", "retracted"});
  configuration.others = others == "extended"    ? Others::kExtended
                         : others == "retracted" ? Others::kRetracted
                                                 : Others::kKeep;
  if (std::optional<Reader> poses = reader.object("poses")) {
    for (const std::string& obstacle : poses->keys()) {
      configuration.places.emplace_back(obstacle, poses->pose(obstacle, {}));
    }
  }
  reader.finish();
  return configuration;
}

TimerDescription read_timer(Reader& reader, const ArenaDescription& arena) {
  TimerDescription timer;
  timer.name = reader.name("name", "");
  timer.every_s =
      reader.number("every", 0.0, {kLeastArenaPeriod_s, kLongestArenaTime_s, false, "s"});
  timer.at_s = reader.number("at", timer.every_s, kTimeRange);
  if (reader.has("within")) {
    const Vec2 within = reader.vec2("within", {0.0, 0.0}, kTimeRange);
    timer.within_s = {within.x(), within.y()};
    if (reader.has("at")) {
      reader.issue("world/conflicting-keys", "either \"at\" or \"within\"", "both",
                   "\"within\" makes the first time random", "at");
    }
  }
  timer.times = static_cast<int>(reader.integer("times", 0, 1, 1'000'000'000));
  timer.jitter_s = reader.number("jitter", 0.0, kTimeRange);
  timer.enabled = reader.boolean("enabled", timer.enabled);
  timer.conditions = read_conditions(reader);
  timer.actions = read_actions(reader, arena);
  reader.finish();
  return timer;
}

TrapRegion read_shape(Reader& owner, const std::string& shape) {
  if (shape == "polygon") {
    PolygonRegion polygon;
    for (Reader& corner : owner.array(shape, kMostParts)) {
      polygon.corners.push_back(corner.as_vec2({}, kPlaceRange));
    }
    return polygon;
  }
  TrapRegion region;
  with_object(owner, shape, [&](Reader& reader) {
    Vec2 center = Vec2::Zero();
    if (reader.require("center", "[x, y] of its middle, in m")) {
      center = reader.vec2("center", center, kPlaceRange);
    }
    if (shape == "circle") {
      CircleRegion circle;
      circle.center = center;
      circle.radius_m = reader.number("radius", circle.radius_m, kLengthRange);
      region = circle;
      return;
    }
    BoxRegion box;
    box.center = center;
    box.size = reader.vec2("size", box.size, kLengthRange);
    box.yaw_rad = reader.angle_deg("yaw_deg", 0.0);
    region = box;
  });
  return region;
}

TrapRegion read_near(Reader& reader) {
  NearRegion near;
  near.distance_m = reader.number("distance", near.distance_m, kLengthRange);
  const auto kind = only_key(reader, {"object", "place"}, "the middle of the surroundings", true);
  if (kind && *kind == "place") {
    return CircleRegion{reader.vec2("place", {0.0, 0.0}, kPlaceRange), near.distance_m};
  }
  near.object = reader.string("object", "");
  return near;
}

TrapRegion read_region(Reader& owner) {
  TrapRegion region;
  const auto where = only_key(owner, {"region", "near"}, "a trap's place", true);
  if (!where) return region;
  with_object(owner, *where, [&](Reader& reader) {
    if (*where == "near") {
      region = read_near(reader);
    } else if (const auto shape = only_key(reader, {"box", "circle", "polygon"}, "a region")) {
      region = read_shape(reader, *shape);
    }
  });
  return region;
}

TrapDescription read_trap(Reader& reader, const ArenaDescription& arena) {
  TrapDescription trap;
  trap.name = reader.name("name", "");
  trap.region = read_region(reader);
  if (const std::optional<Reader> robots = reader.child("robots")) {
    if (robots->is_string()) {
      static_cast<void>(reader.choice("robots", "any", {"any"}));
    } else {
      trap.robots = read_names(reader, "robots");
    }
  }
  trap.model = reader.string("model", "");
  const std::string on = reader.choice("on", "enter", {"enter", "leave", "stay"});
  trap.on = on == "leave"  ? TrapDescription::On::kLeave
            : on == "stay" ? TrapDescription::On::kStay
                           : TrapDescription::On::kEnter;
  trap.stay_s = reader.number("for", 0.0, kTimeRange);
  if (reader.has("for") && trap.on != TrapDescription::On::kStay) {
    reader.issue("world/conflicting-keys", "\"for\" only with \"on\": \"stay\"",
                 "\"on\": " + in_quotes(on), "", "for");
  }
  trap.once = reader.boolean("once", trap.once);
  trap.enabled = reader.boolean("enabled", trap.enabled);
  trap.conditions = read_conditions(reader);
  trap.actions = read_actions(reader, arena);
  reader.finish();
  return trap;
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

WhenBlocked read_when_blocked(Reader& reader) { return read_when_blocked_of(reader); }

ControllerDescription read_controller(Reader& root, const ArenaDescription& arena) {
  ControllerDescription controller;
  std::optional<Reader> reader = root.object("controller");
  if (!reader) return controller;
  if (std::optional<Reader> all = reader->object("configurations")) {
    for (const std::string& name : all->keys()) {
      if (controller.configurations.size() == kMostConfigurations) {
        reader->issue("world/too-many", "at most " + std::to_string(kMostConfigurations), "more",
                      "", "configurations");
        break;
      }
      std::optional<Reader> one = all->object(name);
      if (!is_valid_name(name)) {
        all->issue("world/bad-name", "a name of 1 to 64 letters, digits, _ or -", in_quotes(name),
                   "English letters only, no blanks", name);
      }
      if (one) controller.configurations.push_back(read_configuration(*one, name));
    }
  }
  for (Reader& element : reader->array("timers", kMostTimers)) {
    TimerDescription& timer = controller.timers.emplace_back();
    if (element.expect_object()) timer = read_timer(element, arena);
  }
  for (Reader& element : reader->array("traps", kMostTraps)) {
    TrapDescription& trap = controller.traps.emplace_back();
    if (element.expect_object()) trap = read_trap(element, arena);
  }
  name_unnamed(controller.timers, "timer");
  name_unnamed(controller.traps, "trap");
  reader->finish();
  return controller;
}

}  // namespace sim::io
