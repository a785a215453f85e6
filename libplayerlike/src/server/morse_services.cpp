// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_services.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "protocol/codec.h"
#include "server/morse_streams.h"
#include "sim/core/math.h"
#include "sim/devices/waypoint.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

constexpr double kFar_m = 1e6;
constexpr double kTurns_rad = 1e6;
/// Maximum length of a client's value in error texts [bytes].
constexpr std::size_t kShownBytes = 60;

const RobotInfo& robot_of(const MorseCall& call) {
  return call.state.host().robots().at(static_cast<std::size_t>(call.component->robot));
}

// Private worlds: see sim::SimulationDescription::own_sensors_only.
void require_own(const MorseCall& call) {
  if (call.from.rights().read.at(static_cast<std::size_t>(call.component->robot))) return;
  throw MorseRefusal(
      "access/denied: this world lets a client read the sensors of its own robots only: present "
      "the token of the robot " +
      robot_of(call).name);
}

const DeviceInfo& info_of(const MorseCall& call) {
  return robot_of(call).devices.at(static_cast<std::size_t>(id_of(call).device));
}

// --- motion

json drive(MorseCall& call, const sim::Twist& twist) {
  command(call, sim::TwistCommand{twist});
  return nullptr;
}
// A speed in m/s or rad/s.
double speed_from(const MorseCall& call, std::size_t index) {
  return call.arguments.number(index, -kFar_m, kFar_m);
}
json set_speed(MorseCall& call) {
  return drive(call, {.v_mps = speed_from(call, 0), .omega_radps = speed_from(call, 1)});
}
json stop_motion(MorseCall& call) { return drive(call, {}); }
json set_holonomic_speed(MorseCall& call) {
  // The first wrong argument is the one that the answer names: x, w, y.
  return drive(call, {.v_mps = speed_from(call, 0),
                      .omega_radps = speed_from(call, 2),
                      .lateral_mps = speed_from(call, 1)});
}

constexpr MorseService kMotion[] = {
    {"set_speed", "v, w", Right::kRobot, set_speed},
    {"stop", "", Right::kRobot, stop_motion},
};
constexpr MorseService kHolonomicMotion[] = {
    {"set_speed", "x, y, w", Right::kRobot, set_holonomic_speed},
    {"stop", "", Right::kRobot, stop_motion},
};

// --- waypoint

sim::GotoCommand goal_of(MorseCall& call) {
  const sim::WaypointParams params = ask<sim::Waypoint>(call, &sim::Waypoint::params);
  static_cast<void>(call.arguments.number(2, -kFar_m, kFar_m));  // z: the floor is flat
  constexpr double kLeast = 1e-6;
  return {{call.arguments.number(0, -kFar_m, kFar_m), call.arguments.number(1, -kFar_m, kFar_m)},
          call.arguments.number(3, kLeast, kFar_m, params.tolerance_m),
          call.arguments.number(4, kLeast, kFar_m, params.speed_mps)};
}

json go_to(MorseCall& call) {
  call.state.answer_on_arrival(call.from, call.id, id_of(call), goal_of(call));
  return nullptr;
}

json setdest(MorseCall& call) {
  const sim::GotoCommand goal = goal_of(call);
  const sim::Pose X_WB =
      ask<sim::Waypoint>(call, [&](const sim::Waypoint&, const sim::Simulation& all) {
        return all.body(call.component->robot).X_WB;
      });
  if ((goal.goal_m - X_WB.position()).norm() <= goal.tolerance_m) return false;
  command(call, goal);
  return true;
}

json status_of(MorseCall& call) {
  return std::string(to_string(ask<sim::Waypoint>(call, &sim::Waypoint::status)));
}
json stop_waypoint(MorseCall& call) {
  command(call, sim::StopCommand{});
  return status_of(call);
}
json resume(MorseCall& call) {
  command(call, sim::ResumeCommand{});
  return status_of(call);
}
json get_status(MorseCall& call) {
  require_own(call);
  return status_of(call);
}

constexpr std::string_view kGoal = "x, y, z, tolerance=0.5, speed=1.0";
constexpr MorseService kWaypoint[] = {
    {"goto", kGoal, Right::kRobot, go_to, nullptr, true},
    {"setdest", kGoal, Right::kRobot, setdest},
    {"stop", "", Right::kRobot, stop_waypoint},
    {"resume", "", Right::kRobot, resume},
    {"get_status", "", Right::kConnect, get_status},
};

// --- teleport

json translate(MorseCall& call) {
  if (call.arguments.number(2, -kFar_m, kFar_m, 0.0) != 0.0) {
    call.arguments.refuse(2, "0, as the floor is flat");
  }
  command(call, sim::TranslateCommand{{call.arguments.number(0, -kFar_m, kFar_m),
                                       call.arguments.number(1, -kFar_m, kFar_m, 0.0)}});
  return nullptr;
}

json rotate(MorseCall& call) {
  for (const std::size_t index : {0U, 1U}) {
    if (call.arguments.number(index, -kTurns_rad, kTurns_rad, 0.0) != 0.0) {
      call.arguments.refuse(index, "0, as the floor is flat: robots turn by yaw only");
    }
  }
  command(call, sim::RotateCommand{call.arguments.number(2, -kTurns_rad, kTurns_rad, 0.0)});
  return nullptr;
}

constexpr MorseService kTeleport[] = {
    {"translate", "x, y=0, z=0", Right::kRobot, translate},
    {"rotate", "roll, pitch=0, yaw=0", Right::kRobot, rotate},
};

// --- sensors

json get_local_data(MorseCall& call) {
  require_own(call);
  if (!call.component->device) {
    return morse_properties_record(robot_of(call), call.state.host().time().sim_time_ns);
  }
  const sim::SharedReading reading = call.state.host().newest_reading(id_of(call));
  if (reading == nullptr) {
    throw MorseRefusal(call.component->name +
                       " has no reading yet: its first measurement is later");
  }
  return morse_record(*reading, call.state.host().with_simulation([&](const sim::Simulation& all) {
    return stream_format(all, id_of(call));
  }));
}

constexpr MorseService kSensor[] = {
    {"get_local_data", "", Right::kConnect, get_local_data},
};

// --- all components

// The settings of a component in the world.
std::map<std::string, double> properties_of(const MorseCall& call) {
  if (call.component->device) return info_of(call).properties;
  return {};
}

json get_properties(MorseCall& call) {
  json properties = json::object();
  for (const auto& [name, value] : properties_of(call)) {
    properties[name] = json::array({value, "float", "setting of the world, in SI units", name});
  }
  return {{"properties", std::move(properties)}};
}

json get_configurations(MorseCall& call) {
  auto settings = properties_of(call);
  const sim::Pose mount{settings["mount_x"], settings["mount_y"], settings["mount_yaw"]};
  const double height_m = settings["height"];
  json configurations = json::object();
  for (const auto& [name, value] : properties_of(call)) configurations[name] = value;
  const auto [s, c] = sim::math::sin_cos(mount.yaw_rad);
  configurations["object_to_robot"] = {{"rotation", {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}},
                                       {"translation", {mount.x_m, mount.y_m, height_m}}};
  return {{"configurations", std::move(configurations)}};
}

json set_property(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  const auto settings = properties_of(call);
  const auto it = settings.find(name);
  if (it == settings.end()) {
    throw MorseRefusal("Property " + name + " does not exist for object " + call.component->name);
  }
  const json& value = call.arguments.any(1);
  if (value.is_number() && value.get<double>() == it->second) return nullptr;
  throw MorseRefusal("Property " + name + " of " + call.component->name + " is " +
                     json(it->second).dump() +
                     ": a setting of the world, which does not change during a run");
}

constexpr MorseService kComponent[] = {
    {"get_configurations", "", Right::kConnect, get_configurations},
    {"get_properties", "", Right::kConnect, get_properties},
    {"set_property", "name, value", Right::kRobot, set_property},
};

std::string known_names(const std::vector<const MorseService*>& services) {
  std::string names;
  for (const MorseService* service : services) {
    names += (names.empty() ? "" : ", ") + std::string(service->name);
  }
  return names;
}

}  // namespace

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > kShownBytes) text = text.substr(0, kShownBytes) + "...";
  return text;
}

void command(const MorseCall& call, const sim::Command& what) {
  MorseState::command(call.from.commander(), id_of(call), what);
}

void answer_when(const MorseCall& call, const sim::Command& what,
                 std::function<bool(const sim::Device&)> done) {
  command(call, what);
  call.state.answer_when(call.from, call.id, id_of(call), std::move(done));
}

std::vector<sim::SceneObject> scene_of(const MorseCall& call) {
  return call.state.host().with_simulation(
      [](const sim::Simulation& simulation) { return simulation.scene_objects(); });
}

void require_command(const MorseCall& call, int robot) {
  if (call.from.rights().command.at(static_cast<std::size_t>(robot))) return;
  throw MorseRefusal("access/denied: this connection has no token for the robot " +
                     call.state.host().robots().at(static_cast<std::size_t>(robot)).name);
}

void require_command_all(const MorseCall& call) {
  if (call.from.rights().command_all()) return;
  throw MorseRefusal("access/denied: this connection has no tokens for all robots");
}

void require_truth(const MorseCall& call) {
  if (call.from.rights().truth) return;
  throw MorseRefusal(
      "access/denied: this world keeps the poses of its objects private: that takes the tokens of "
      "all robots");
}

bool is_world_component(std::string_view component) noexcept {
  return component == "simulation" || component == "time" || component == "arena" ||
         component == "communication";
}

// --- Arguments

void MorseArguments::refuse(std::size_t index, const std::string& expected) const {
  throw MorseRefusal("argument " + std::to_string(index + 1) + " of " + std::string(service_.name) +
                     "(" + std::string(service_.arguments) + "): expected " + expected +
                     (has(index) ? ", found " + shown(list_[index]) : ", found none"));
}

double MorseArguments::number(std::size_t index, double least, double most,
                              std::optional<double> otherwise) const {
  if (otherwise && (!has(index) || list_[index].is_null())) return *otherwise;
  const double value =
      has(index) && list_[index].is_number() ? list_[index].get<double>() : std::nan("");
  if (!(value >= least && value <= most)) {
    refuse(index, "a number from " + json(least).dump() + " to " + json(most).dump());
  }
  return value;
}

int MorseArguments::integer(std::size_t index, int least, int most,
                            std::optional<int> otherwise) const {
  if (otherwise && (!has(index) || list_[index].is_null())) return *otherwise;
  // Compared as doubles, so that 3.0 counts as a whole number and nothing overflows.
  const double value =
      has(index) && list_[index].is_number() ? list_[index].get<double>() : std::nan("");
  if (!(value >= least && value <= most && value == std::floor(value))) {
    refuse(index, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return static_cast<int>(value);
}

std::string MorseArguments::text(std::size_t index) const {
  if (!list_[index].is_string()) refuse(index, "a text");
  return list_[index].get<std::string>();
}

bool MorseArguments::boolean(std::size_t index) const {
  if (!list_[index].is_boolean()) refuse(index, "true or false");
  return list_[index].get<bool>();
}

const json& MorseArguments::list(std::size_t index) const {
  if (!list_[index].is_array()) refuse(index, "a list");
  return list_[index];
}

// --- The table

std::span<const MorseService> morse_services(std::string_view kind) {
  if (kind == "simulation") return simulation_services();
  if (kind == "time") return time_services();
  if (kind == "arena") return arena_services();
  if (kind == "motion") return kMotion;
  if (kind == "MotionXYW") return kHolonomicMotion;
  if (kind == "waypoint") return kWaypoint;
  if (kind == "teleport") return kTeleport;
  if (kind == "pen") return pen_services();
  if (kind == "communication") return communication_services();
  if (const auto services = device_services(kind); !services.empty()) return services;
  if (kind == "sensor") return kSensor;
  if (kind == "component") return kComponent;
  return {};
}

std::vector<const MorseService*> services_of(const MorseComponent& component) {
  std::vector<const MorseService*> all;
  const auto add = [&all](std::string_view kind) {
    for (const MorseService& service : morse_services(kind)) all.push_back(&service);
  };
  // The services of the device's type; sensors have none of their own type.
  if (component.device) {
    add(component.class_name == "MotionXYW" ? component.class_name
                                            : std::string_view(component.type));
  }
  if (component.stream == StreamDirection::kOut) add("sensor");
  add("component");
  return all;
}

std::optional<json> call_service(MorseState& state, MorseConnection& from, const std::string& id,
                                 std::string_view component, std::string_view service,
                                 const json& list) {
  if (!from.rights().connect) {
    throw MorseRefusal(
        "access/denied: this server requires a token first: playpen token [\"...\"]");
  }
  const MorseComponent* found = state.find(component);
  std::vector<const MorseService*> services;
  if (found != nullptr) {
    services = services_of(*found);
  } else if (is_world_component(component)) {
    for (const MorseService& row : morse_services(component)) services.push_back(&row);
  } else {
    throw MorseRefusal("there is no component \"" + std::string(component) + "\"");
  }
  const auto row = std::find_if(services.begin(), services.end(),
                                [&](const MorseService* s) { return s->name == service; });
  if (row == services.end()) {
    throw MorseRefusal("The request " + std::string(service) + " has not been registered for " +
                       std::string(component) + "; it has: " + known_names(services));
  }
  const MorseService& chosen = **row;
  const std::size_t least = chosen.least();
  const std::size_t most = chosen.most();
  if (list.size() < least || list.size() > most) {
    const std::string wanted =
        std::to_string(least) + (most > least ? " to " + std::to_string(most) : "");
    if (list.empty()) {
      throw MorseRefusal("parameters expected for service " + std::string(service) + "! Expected " +
                         wanted + " (" + std::string(chosen.arguments) + ")");
    }
    throw MorseRefusal("wrong # of parameters for service " + std::string(service) + " of " +
                       std::string(component) + ": expected " + wanted + " (" +
                       std::string(chosen.arguments) + "), found " + std::to_string(list.size()));
  }
  if (state.verbose(std::string(component))) {
    state.hub().log(sim::LogLevel::kInfo, from.peer().name() + ": " + std::string(component) + ' ' +
                                              std::string(service) + ' ' + shown(list));
  }
  MorseCall call{state, from, id, found, MorseArguments(chosen, list)};
  if (chosen.right == Right::kAll) require_command_all(call);
  if (chosen.right == Right::kRobot) require_command(call, found->robot);
  if (chosen.work != nullptr && (chosen.is_heavy || canvas_cells(state.session()) > kInlineCells)) {
    from.work(id, chosen, list);
    return std::nullopt;
  }
  json result = chosen.run(call);
  if (chosen.later) return std::nullopt;
  return result;
}

}  // namespace playerlike::server
