// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Checks of an arena controller: names of other parts of the world, and combinations of values.
#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "io/check_ranges.h"
#include "io/controller_io.h"
#include "io/controller_work.h"
#include "io/document.h"
#include "io/robot_io.h"
#include "io/solid_limits.h"
#include "sim/world/robot_model.h"
#include "world/controller_fields.h"

namespace sim::io {
namespace {

// Maximum number of names in a message.
constexpr std::size_t kMostListed = 20;

std::string at(const std::string& list, std::size_t index) {
  return list + '/' + std::to_string(index);
}

class ControllerChecker {
 public:
  ControllerChecker(const WorldDescription& world,
                    const std::function<bool(const std::string&)>& trusted)
      : world_(world), controller_(world.controller), trusted_(trusted) {
    for (const ObstacleDescription& o : world.arena.obstacles) {
      obstacles_.insert(o.name);
      if (o.type == ObstacleType::kDynamic) dynamic_.insert(o.name);
    }
    for (const RobotDescription& r : world.robots) robots_.emplace(r.name, &r);
    for (const auto& c : controller_.configurations) configurations_.insert(c.name);
    for (const auto& timer : controller_.timers) switches_.insert(timer.name);
    for (const auto& trap : controller_.traps) switches_.insert(trap.name);
    arena_trusted_ = trusted("/arena");
    robots_trusted_ = trusted("/robots");
    switches_trusted_ = trusted("/controller/timers") && trusted("/controller/traps");
  }

  std::vector<ConfigIssue> run() {
    check_numbers();
    check_configurations();
    check_unique_names();
    for (std::size_t i = 0; i < controller_.timers.size(); ++i) {
      check_timer(controller_.timers[i], at("/controller/timers", i));
    }
    for (std::size_t i = 0; i < controller_.traps.size(); ++i) {
      check_trap(controller_.traps[i], at("/controller/traps", i));
    }
    if (arena_trusted_ && robots_trusted_ && trusted_("/controller") && trusted_("/canvas") &&
        trusted_("/simulation")) {
      check_work();
    }
    return std::move(issues_);
  }

 private:
  void add(const char* id, std::string pointer, std::string expected, std::string found,
           std::string hint = "") {
    issues_.push_back({id, world_.file, std::move(pointer), std::move(expected), std::move(found),
                       std::move(hint)});
  }

  /// An issue of a name that does not exist.
  template <typename Names>
  void add_unknown(const char* id, const std::string& pointer, const std::string& what,
                   const std::string& name, const Names& names) {
    std::vector<std::string> known(names.begin(), names.end());
    const std::string hint = did_you_mean(name, known);
    if (known.size() > kMostListed) known.resize(kMostListed);
    add(id, pointer,
        known.empty() ? "no name: this world has none" : what + ": " + list_text(known),
        in_quotes(name), hint);
  }

  /// Checks what the ranges of the fields say.
  void check_numbers() {
    const std::function<void(SolidError)> report = [this](SolidError error) {
      if (!trusted_(error.key)) return;
      add(error.id, std::move(error.key), std::move(error.expected), std::move(error.found),
          std::move(error.hint));
    };
    check_ranges(fields_of<ControllerDescription>(), &controller_, "/controller", report);
  }

  void need_obstacle(const std::string& pointer, const std::string& name) {
    if (!arena_trusted_ || obstacles_.contains(name)) return;
    add_unknown("world/unknown-obstacle", pointer, "the name of an obstacle", name, obstacles_);
  }

  void need_dynamic(const std::string& pointer, const std::string& name) {
    if (!arena_trusted_ || dynamic_.contains(name)) return;
    if (obstacles_.contains(name)) {
      add("world/static-obstacle", pointer, "a dynamic obstacle",
          in_quotes(name) + ", which is static", "static obstacles are always there");
      return;
    }
    add_unknown("world/unknown-obstacle", pointer, "the name of a dynamic obstacle", name,
                dynamic_);
  }

  [[nodiscard]] std::vector<std::string> robot_names() const {
    std::vector<std::string> names;
    for (const auto& [name, robot] : robots_) names.push_back(name);
    return names;
  }

  /// @param object  pointer of the condition's or action's object.
  void need_robot(const std::string& object, const std::string& key, const std::string& name,
                  bool of_timer) {
    if (name.empty()) {
      if (!of_timer) return;
      add("world/missing-key", object, "\"robot\": the name of a robot", "none",
          "no robot springs a timer");
    } else if (robots_trusted_ && !robots_.contains(name)) {
      add_unknown("world/unknown-robot", key, "the name of a robot", name, robot_names());
    }
  }

  void need_device(const std::string& pointer, const std::string& robot, const char* type) {
    const auto found = robots_.find(robot);
    if (!robots_trusted_ || found == robots_.end()) return;
    const auto& devices = found->second->devices;
    if (std::any_of(devices.begin(), devices.end(),
                    [&](const DeviceDescription& device) { return device.type == type; })) {
      return;
    }
    add("world/missing-device", pointer, std::string("a robot with the device \"") + type + '"',
        "robot " + robot + " without it");
  }

  void need_limits(const std::string& pointer, const ArenaLimits& limits) {
    if (limits.at_least <= limits.at_most) return;
    add("world/out-of-range", pointer, "\"at_least\" not above \"at_most\"",
        number_text(limits.at_least) + " and " + number_text(limits.at_most));
  }

  void need_switch(const std::string& pointer, const std::string& name) {
    if (!switches_trusted_ || switches_.contains(name)) return;
    add_unknown("world/unknown-trap", pointer, "the name of a timer or trap", name, switches_);
  }

  void need_configuration(const std::string& pointer, const std::string& name) {
    if (configurations_.contains(name) || !trusted_("/controller/configurations")) return;
    add_unknown("world/unknown-configuration", pointer, "the name of a configuration", name,
                configurations_);
  }

  void check_configurations() {
    for (const ArenaConfiguration& configuration : controller_.configurations) {
      const std::string pointer =
          "/controller/configurations/" + escape_pointer_part(configuration.name);
      if (!trusted_(pointer)) continue;
      for (const Field& field : fields_of<ArenaConfiguration>().fields) {
        if (field.names == NamedPart::kNone) continue;
        check_names(field, field.get(&configuration), pointer, pointer + '/' + field.name, false);
      }
      const std::set<std::string> extended(configuration.extended.begin(),
                                           configuration.extended.end());
      for (std::size_t i = 0; i < configuration.retracted.size(); ++i) {
        const std::string& name = configuration.retracted[i];
        if (!extended.contains(name)) continue;
        add("world/conflicting-state", at(pointer + "/retracted", i),
            "an obstacle in one of the two lists only", in_quotes(name) + " in \"extended\" too",
            "take it out of one of them");
      }
      for (const auto& [name, pose] : configuration.places) {
        need_obstacle(pointer + "/poses/" + escape_pointer_part(name), name);
      }
    }
  }

  void check_work() {
    const ControllerWork work(world_);
    const std::string most = std::to_string(kMaxControllerWork);
    for (const ArenaConfiguration& configuration : controller_.configurations) {
      const std::int64_t changes = work.of_configuration(configuration.name);
      if (changes <= kMaxControllerWork) continue;
      add("world/too-much-work",
          "/controller/configurations/" + escape_pointer_part(configuration.name),
          "at most " + most + " operations in a change of the arena", std::to_string(changes),
          "a configuration that changes fewer obstacles");
    }
    for (const ControllerWork::Excess& excess : work.excesses()) {
      add("world/too-much-work",
          at(excess.is_timer ? "/controller/timers" : "/controller/traps", excess.index),
          "at most " + most + " operations in a step", text_of(excess),
          excess.acts > 1 ? "a longer \"every\", or less to do each time"
                          : "less to do, such as smaller parts of the canvas");
    }
  }

  void check_unique_names() {
    std::map<std::string, std::string> first;
    const auto check = [&](const auto& list, const char* where) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string pointer = at(where, i);
        if (!trusted_(pointer + "/name")) continue;
        const auto [known, added] = first.emplace(list[i].name, pointer);
        if (added) continue;
        add("world/duplicate-name", pointer + "/name", "a name of its own for each timer and trap",
            in_quotes(list[i].name) + " a second time (first at " + known->second + ")",
            "rename one of the two");
      }
    };
    check(controller_.timers, "/controller/timers");
    check(controller_.traps, "/controller/traps");
  }

  void check_timer(const TimerDescription& timer, const std::string& pointer) {
    if (trusted_(pointer) && timer.every_s != 0.0 && timer.jitter_s > 0.5 * timer.every_s) {
      add("world/out-of-range", pointer + "/jitter",
          "at most half of \"every\": " + number_text(0.5 * timer.every_s) + " s",
          number_text(timer.jitter_s), "otherwise the order of the times would change");
    }
    if (trusted_(pointer) && timer.within_s && timer.within_s->x() > timer.within_s->y()) {
      add("world/out-of-range", pointer + "/within", "[from, to] with from not above to",
          '[' + number_text(timer.within_s->x()) + ", " + number_text(timer.within_s->y()) + ']');
    }
    const FieldTable& fields = fields_of<TimerDescription>();
    check_parts(field_named(fields, "if"), timer.conditions, pointer + "/if", true);
    check_parts(field_named(fields, "do"), timer.actions, pointer + "/do", true);
  }

  void check_trap(const TrapDescription& trap, const std::string& pointer) {
    if (robots_trusted_ && trusted_(pointer + "/robots")) {
      for (std::size_t i = 0; i < trap.robots.size(); ++i) {
        if (robots_.contains(trap.robots[i])) continue;
        add_unknown("world/unknown-robot", at(pointer + "/robots", i), "the name of a robot",
                    trap.robots[i], robot_names());
      }
    }
    std::set<std::string> models;
    for (const RobotDescription& robot : world_.robots) models.insert(robot.model);
    if (!trap.model.empty() && robots_trusted_ && !models.contains(trap.model)) {
      add_unknown("world/unknown-model", pointer + "/model", "the model of a robot of this world",
                  trap.model, models);
    }
    if (const auto* near = std::get_if<NearRegion>(&trap.region)) check_near(*near, pointer);
    const FieldTable& fields = fields_of<TrapDescription>();
    check_parts(field_named(fields, "if"), trap.conditions, pointer + "/if", false);
    check_parts(field_named(fields, "do"), trap.actions, pointer + "/do", false);
  }

  void check_near(const NearRegion& near, const std::string& pointer) {
    if (!trusted_(pointer + "/near") || !arena_trusted_ || !robots_trusted_) return;
    if (robots_.contains(near.object) || obstacles_.contains(near.object)) return;
    std::vector<std::string> names = robot_names();
    names.insert(names.end(), obstacles_.begin(), obstacles_.end());
    add_unknown("world/unknown-obstacle", pointer + "/near/object",
                "the name of a robot or an obstacle", near.object, names);
  }

  // --- Conditions and actions

  /// @param field    their field of a timer or trap.
  /// @param pointer  of their list.
  template <typename Part>
  void check_parts(const Field& field, const std::vector<Part>& parts, const std::string& pointer,
                   bool of_timer) {
    if (!trusted_(pointer)) return;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto is_kind = [&](const Kind& kind) { return kind.find(&parts[i]) != nullptr; };
      const Kind& kind = *std::find_if(field.kinds.begin(), field.kinds.end(), is_kind);
      const std::string object = at(pointer, i) + '/' + kind.word;
      for (const Field& part : kind.table().fields) {
        if (part.names == NamedPart::kNone) continue;
        const std::string key = kind.is_bare ? object : object + '/' + part.name;
        check_names(part, part.get(kind.find(&parts[i])), object, key, of_timer);
      }
      std::visit([&](const auto& part) { check(part, object); }, parts[i]);
    }
  }

  /// Checks that what a field names exists.
  void check_names(const Field& field, const void* value, const std::string& object,
                   const std::string& key, bool of_timer) {
    const auto need = [&](const std::string& pointer, const std::string& name) {
      switch (field.names) {
        case NamedPart::kNone:
          return;
        case NamedPart::kObstacle:
          return need_obstacle(pointer, name);
        case NamedPart::kDynamicObstacle:
          return need_dynamic(pointer, name);
        case NamedPart::kRobot:
          return need_robot(object, pointer, name, of_timer);
        case NamedPart::kConfiguration:
          return need_configuration(pointer, name);
        case NamedPart::kSwitch:
          return need_switch(pointer, name);
      }
    };
    if (field.type != FieldType::kTexts) return need(key, *static_cast<const std::string*>(value));
    const auto& names = *static_cast<const std::vector<std::string>*>(value);
    for (std::size_t i = 0; i < names.size(); ++i) need(at(key, i), names[i]);
  }

  /// The names of most are all that has to be checked.
  template <typename Simple>
  static void check(const Simple&, const std::string&) {}

  void check(const TimeCondition& condition, const std::string& object) {
    if (condition.from_s < condition.to_s) return;
    add("world/out-of-range", object, "\"from\" less than \"to\"",
        number_text(condition.from_s) + " and " + number_text(condition.to_s));
  }
  void check(const CountCondition& condition, const std::string& object) {
    need_limits(object, condition.limits);
  }
  void check(const QuantityCondition& condition, const std::string& object) {
    if (condition.quantity == RobotQuantity::kBattery) {
      need_device(object, condition.robot, "battery");
    }
    need_limits(object, condition.limits);
  }
  void check(const FiducialCondition& condition, const std::string& object) {
    need_device(object, condition.robot, "fiducial");
  }
  void check(const MoveAction& action, const std::string& place) {
    if (!arena_trusted_ || !trusted_(place)) return;
    const ObstacleMotion& motion = action.motion;
    if (motion.law != MotionLaw::kPath && motion.law != MotionLaw::kStand) {
      add("world/out-of-range", place, "a path, or to stop", "another motion");
    } else if (motion.law == MotionLaw::kPath && motion.points.empty() && !motion.final_yaw_rad) {
      add("world/missing-key", place, "a point or an angle to move to", "none");
    }
    for (const ObstacleDescription& obstacle : world_.arena.obstacles) {
      if (obstacle.name != action.obstacle) continue;
      ObstacleDescription driven = obstacle;
      if (!driven.motion) driven.motion = motion;
      if (auto error = check_movable(driven)) {
        add(error->id, place + "/obstacle", error->expected, error->found + " of " + obstacle.name,
            error->hint);
      }
    }
  }

  void check(const FaultAction& action, const std::string& place) {
    const auto robot = robots_.find(action.robot);
    if (!robots_trusted_ || !trusted_(place) || robot == robots_.end()) return;
    const auto& devices = robot->second->devices;
    const auto device = std::ranges::find(devices, action.device, &DeviceDescription::name);
    if (device == devices.end()) {
      std::vector<std::string> names;
      for (const DeviceDescription& one : devices) names.push_back(one.name);
      return add_unknown("world/missing-device", place + "/device",
                         "the name of a device of robot " + action.robot, action.device, names);
    }
    const auto need_type = [&](std::initializer_list<const char*> types, const char* words) {
      if (std::ranges::find(types, device->type) != types.end()) return;
      add("world/missing-device", place + "/device", words,
          in_quotes(action.device) + ", which is of type " + device->type);
    };
    if (action.kind == FaultAction::Kind::kBlind) {
      need_type({"laser", "sonar", "infrared"}, "a laser, sonar or infrared ranger");
    } else if (action.kind == FaultAction::Kind::kJump) {
      need_type({"odometry", "pose"}, "an odometry or pose device");
    }
  }

  const WorldDescription& world_;
  const ControllerDescription& controller_;
  const std::function<bool(const std::string&)>& trusted_;
  std::set<std::string> obstacles_;
  std::set<std::string> dynamic_;
  std::map<std::string, const RobotDescription*> robots_;
  std::set<std::string> configurations_;
  std::set<std::string> switches_;  // names of timers and traps
  bool arena_trusted_ = true;
  bool robots_trusted_ = true;
  bool switches_trusted_ = true;
  std::vector<ConfigIssue> issues_;
};

}  // namespace

std::vector<ConfigIssue> check_controller(const WorldDescription& world,
                                          const std::function<bool(const std::string&)>& trusted) {
  if (world.controller.empty()) return {};
  return ControllerChecker(world, trusted).run();
}

}  // namespace sim::io
