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

  /// @param key  of the robot's name; the object is at `pointer`.
  /// @return the robot; nullptr if none is named.
  const RobotDescription* need_robot(const std::string& pointer, const std::string& name,
                                     bool of_timer) {
    if (name.empty()) {
      if (of_timer) {
        add("world/missing-key", pointer, "\"robot\": the name of a robot", "none",
            "no robot springs a timer");
      }
      return nullptr;
    }
    if (!robots_trusted_) return nullptr;
    const auto found = robots_.find(name);
    if (found != robots_.end()) return found->second;
    add_unknown("world/unknown-robot", pointer + "/robot", "the name of a robot", name,
                robot_names());
    return nullptr;
  }

  void need_device(const std::string& pointer, const RobotDescription* robot, const char* type) {
    if (robot == nullptr) return;
    const auto& devices = robot->devices;
    if (std::any_of(devices.begin(), devices.end(),
                    [&](const DeviceDescription& device) { return device.type == type; })) {
      return;
    }
    add("world/missing-device", pointer, std::string("a robot with the device \"") + type + '"',
        "robot " + robot->name + " without it");
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

  void check_configurations() {
    for (const ArenaConfiguration& configuration : controller_.configurations) {
      const std::string pointer =
          "/controller/configurations/" + escape_pointer_part(configuration.name);
      if (!trusted_(pointer)) continue;
      for (std::size_t i = 0; i < configuration.extended.size(); ++i) {
        need_dynamic(at(pointer + "/extended", i), configuration.extended[i]);
      }
      const std::set<std::string> extended(configuration.extended.begin(),
                                           configuration.extended.end());
      for (std::size_t i = 0; i < configuration.retracted.size(); ++i) {
        const std::string& name = configuration.retracted[i];
        need_dynamic(at(pointer + "/retracted", i), name);
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
    check_conditions(timer.conditions, pointer + "/if", true);
    check_actions(timer.actions, pointer + "/do", true);
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
    check_conditions(trap.conditions, pointer + "/if", false);
    check_actions(trap.actions, pointer + "/do", false);
  }

  void check_near(const NearRegion& near, const std::string& pointer) {
    if (!trusted_(pointer + "/near") || !arena_trusted_ || !robots_trusted_) return;
    if (robots_.contains(near.object) || obstacles_.contains(near.object)) return;
    std::vector<std::string> names = robot_names();
    names.insert(names.end(), obstacles_.begin(), obstacles_.end());
    add_unknown("world/unknown-obstacle", pointer + "/near/object",
                "the name of a robot or an obstacle", near.object, names);
  }

  /// Most conditions and actions name other parts of the world; the others need no check.
  template <typename Simple>
  static void check(const Simple&, const std::string&, bool) {}

  // --- Conditions

  void check_conditions(const std::vector<ArenaCondition>& conditions, const std::string& pointer,
                        bool of_timer) {
    if (!trusted_(pointer)) return;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      std::visit([&](const auto& kind) { check(kind, at(pointer, i), of_timer); }, conditions[i]);
    }
  }

  void check(const TimeCondition& condition, const std::string& pointer, bool) {
    if (condition.from_s < condition.to_s) return;
    add("world/out-of-range", pointer + "/time", "\"from\" less than \"to\"",
        number_text(condition.from_s) + " and " + number_text(condition.to_s));
  }
  void check(const CountCondition& condition, const std::string& pointer, bool) {
    need_switch(pointer + "/count/of", condition.of);
    need_limits(pointer + "/count", condition.limits);
  }
  void check(const BlockCondition& condition, const std::string& pointer, bool) {
    need_dynamic(pointer + "/block/name", condition.block);
  }
  void check(const QuantityCondition& condition, const std::string& pointer, bool of_timer) {
    static constexpr const char* kKeys[] = {"/collisions", "/speed", "/battery", "/score"};
    const std::string place = pointer + kKeys[static_cast<std::size_t>(condition.quantity)];
    const RobotDescription* robot = need_robot(place, condition.robot, of_timer);
    if (condition.quantity == RobotQuantity::kBattery) need_device(place, robot, "battery");
    need_limits(place, condition.limits);
  }
  void check(const FiducialCondition& condition, const std::string& pointer, bool of_timer) {
    need_device(pointer + "/fiducial", need_robot(pointer + "/fiducial", condition.robot, of_timer),
                "fiducial");
  }

  // --- Actions

  void check_actions(const std::vector<ArenaAction>& actions, const std::string& pointer,
                     bool of_timer) {
    if (!trusted_(pointer)) return;
    for (std::size_t i = 0; i < actions.size(); ++i) {
      std::visit([&](const auto& kind) { check(kind, at(pointer, i), of_timer); }, actions[i]);
    }
  }

  void check(const ConfigurationAction& action, const std::string& pointer, bool) {
    if (configurations_.contains(action.configuration)) return;
    if (!trusted_("/controller/configurations")) return;
    add_unknown("world/unknown-configuration", pointer + "/configuration",
                "the name of a configuration", action.configuration, configurations_);
  }
  void check(const BlocksAction& action, const std::string& pointer, bool) {
    static constexpr const char* kKeys[] = {"/extend", "/retract", "/toggle"};
    const std::string list = pointer + kKeys[static_cast<std::size_t>(action.change)];
    for (std::size_t i = 0; i < action.blocks.size(); ++i) {
      need_dynamic(at(list, i), action.blocks[i]);
    }
  }
  void check(const PlaceAction& action, const std::string& pointer, bool) {
    need_obstacle(pointer + "/place/obstacle", action.obstacle);
  }
  void check(const RestartAction& action, const std::string& pointer, bool of_timer) {
    static_cast<void>(need_robot(pointer + "/restart", action.robot, of_timer));
  }
  void check(const ScoreAction& action, const std::string& pointer, bool of_timer) {
    static_cast<void>(need_robot(pointer + "/score", action.robot, of_timer));
  }
  void check(const SwitchAction& action, const std::string& pointer, bool) {
    for (std::size_t i = 0; i < action.names.size(); ++i) {
      need_switch(at(pointer + (action.on ? "/enable" : "/disable"), i), action.names[i]);
    }
  }
  void check(const MoveAction& action, const std::string& pointer, bool) {
    need_obstacle(pointer + "/move/obstacle", action.obstacle);
    const std::string place = pointer + "/move";
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
