// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests to MORSE's components `simulation` and `time`.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "server/morse_services.h"
#include "server/morse_streams.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

const MorseComponent& require_component(MorseCall& call, std::size_t argument) {
  const std::string name = call.arguments.text(argument);
  const MorseComponent* component = call.state.find(name);
  if (component == nullptr) throw MorseRefusal("there is no component \"" + name + "\"");
  return *component;
}

// Executes a request whose refusal clients get without the id of an error, as in MORSE.
template <typename What>
void execute(MorseCall& call, const What& what) {
  try {
    call.state.session().request(what);
  } catch (const SessionError& error) {
    throw MorseRefusal(error.what());
  }
}

// --- simulation

json list_robots(MorseCall& call) {
  json names = json::array();
  for (const RobotInfo& robot : call.state.host().robots()) names.push_back(robot.name);
  return names;
}

json details(MorseCall& call) {
  json robots = json::array();
  for (const RobotInfo& robot : call.state.host().robots()) {
    robots.push_back({{"name", robot.name}, {"type", robot.model}, {"components", json::object()}});
  }
  for (const MorseComponent& component : call.state.components()) {
    json entry{{"type", component.class_name}};
    for (const MorseService* service : services_of(component)) {
      entry["services"].push_back(service->name);
    }
    entry["service_interfaces"] = json::array({"socket"});
    if (component.stream != StreamDirection::kNone) {
      const char* direction = component.stream == StreamDirection::kIn ? "IN" : "OUT";
      entry["stream_interfaces"] = json::array({json::array({"socket", direction})});
    }
    robots[static_cast<std::size_t>(component.robot)]["components"][component.name] =
        std::move(entry);
  }
  const std::string world = call.state.host().with_simulation(
      [](const sim::Simulation& simulation) { return simulation.world().name; });
  return {{"robots", std::move(robots)}, {"environment", world}};
}

json list_streams(MorseCall& call) {
  json names = json::array();
  for (const MorseComponent& component : call.state.components()) {
    // Playpen's own robot_properties has a stream, but no program of MORSE expects it in the list.
    if (component.stream != StreamDirection::kNone && component.device) {
      names.push_back(component.name);
    }
  }
  return names;
}

json get_stream_port(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  const MorseComponent* component = call.state.find(name);
  if (component == nullptr || component->stream == StreamDirection::kNone) {
    throw MorseRefusal("Stream unavailable for component " + name);
  }
  return call.state.streams().port(*component);
}

json get_all_stream_ports(MorseCall& call) {
  json ports = json::object();
  for (const MorseComponent& component : call.state.components()) {
    if (component.stream == StreamDirection::kNone || !component.device) continue;
    ports[component.name] = call.state.streams().port(component);
  }
  return ports;
}

json reset_objects(MorseCall& call) {
  execute(call, ResetRequest{});
  call.state.forget_targets();
  return "Objects restored to initial position";
}

json quit(MorseCall& call) {
  // Posted, so that the answer is sent first.
  Hub& hub = call.state.hub();
  hub.post([&hub] { hub.quit(); });
  return nullptr;
}

json set_active(MorseCall& call, bool active) {
  const MorseComponent& component = require_component(call, 0);
  require_command(call, component.robot);
  if (!component.device) {
    throw MorseRefusal(component.name + " is no device: it cannot be switched off or on");
  }
  call.state.session().request(SetActiveRequest{*component.device, active});
  return nullptr;
}
json activate(MorseCall& call) { return set_active(call, true); }
json deactivate(MorseCall& call) { return set_active(call, false); }

json suspend_dynamics(MorseCall& call) {
  execute(call, SetDynamicsRequest{std::nullopt, false});
  return "Physics is suspended";
}

json restore_dynamics(MorseCall& call) {
  execute(call, SetDynamicsRequest{std::nullopt, true});
  return "Physics is resumed";
}

json get_scene_objects(MorseCall& call) {
  require_truth(call);
  json objects = json::object();
  for (const sim::SceneObject& object : scene_of(call)) {
    objects.emplace(object.name, morse_scene_object(object));
  }
  return objects;
}

json set_object_visibility(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  const bool visible = call.arguments.boolean(1);
  static_cast<void>(call.arguments.boolean(2));  // checked, but not used: objects have no children
  const std::vector<sim::SceneObject> objects = scene_of(call);
  // A block takes precedence over a robot of the same name, since only blocks can be hidden.
  const auto is_block = [&](const sim::SceneObject& o) {
    return o.name == name && o.kind == "block" && o.dynamic;
  };
  if (std::any_of(objects.begin(), objects.end(), is_block)) {
    const bool locked = call.state.host().with_simulation(
        [](const sim::Simulation& all) { return all.world().simulation.objects_locked; });
    if (locked) {
      throw MorseRefusal(
          "this world locks its obstacles (\"lock_objects\" in its "
          "\"simulation\")");
    }
    execute(call, SetBlockRequest{name, visible});
    return visible;
  }
  if (std::none_of(objects.begin(), objects.end(),
                   [&](const sim::SceneObject& o) { return o.name == name; })) {
    throw MorseRefusal("Object '" + name + "' does not appear in the scene.");
  }
  return true;  // no effect: other objects cannot be hidden
}

json set_object_dynamics(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  const bool on = call.arguments.boolean(1);
  const auto& robots = call.state.host().robots();
  const auto robot = std::find_if(robots.begin(), robots.end(),
                                  [&](const RobotInfo& r) { return r.name == name; });
  if (robot != robots.end()) {
    require_command(call, static_cast<int>(robot - robots.begin()));
  } else {
    require_command_all(call);
  }
  execute(call, SetDynamicsRequest{name, on});
  return on;
}

json set_log_level(MorseCall& call) {
  const std::string component = call.arguments.text(0);
  if (!is_world_component(component)) {
    static_cast<void>(require_component(call, 0));
  }
  // The names and numbers of Python's log levels.
  constexpr std::array<std::pair<std::string_view, int>, 6> kLevels{{{"NOTSET", 0},
                                                                     {"DEBUG", 10},
                                                                     {"INFO", 20},
                                                                     {"WARNING", 30},
                                                                     {"ERROR", 40},
                                                                     {"CRITICAL", 50}}};
  const json& level = call.arguments.any(1);
  std::optional<int> number;
  if (level.is_number_integer()) number = call.arguments.integer(1, 0, 1000);
  for (const auto& [name, value] : kLevels) {
    if (level == name) number = value;
  }
  if (!number) {
    call.arguments.refuse(1, "DEBUG, INFO, WARNING, ERROR, CRITICAL or a number from 0 to 1000");
  }
  call.state.set_verbose(component, *number > 0 && *number <= 10);
  return nullptr;
}

constexpr MorseService kSimulation[] = {
    {"list_robots", "", Right::kConnect, list_robots},
    {"details", "", Right::kConnect, details},
    {"list_streams", "", Right::kConnect, list_streams},
    {"get_stream_port", "component", Right::kConnect, get_stream_port},
    {"get_all_stream_ports", "", Right::kConnect, get_all_stream_ports},
    {"reset_objects", "", Right::kAll, reset_objects},
    {"quit", "", Right::kAll, quit},
    {"terminate", "", Right::kAll, quit},
    {"activate", "component", Right::kConnect, activate},
    {"deactivate", "component", Right::kConnect, deactivate},
    {"suspend_dynamics", "", Right::kAll, suspend_dynamics},
    {"restore_dynamics", "", Right::kAll, restore_dynamics},
    {"get_scene_objects", "", Right::kConnect, get_scene_objects},
    {"set_object_visibility", "object, visible, children", Right::kAll, set_object_visibility},
    {"set_object_dynamics", "object, on", Right::kConnect, set_object_dynamics},
    {"set_log_level", "component, level", Right::kAll, set_log_level},
};

// --- time

json now(MorseCall& call) { return sim::to_seconds(call.state.host().time().sim_time_ns); }

json mode(MorseCall& /*call*/) { return "Fixed Simulation Step"; }

json statistics(MorseCall& call) {
  const TimeStatistics time = call.state.host().time();
  const double now_s = sim::to_seconds(time.sim_time_ns);
  const double mean_s = time.steps > 0 ? time.wall_time_s / static_cast<double>(time.steps) : 0.0;
  return {{"mean_time", mean_s},
          {"diff_real_time", now_s - time.wall_time_s},
          {"time", now_s},
          {"step", time.step_s},
          {"steps", time.steps},
          {"wall_time", time.wall_time_s},
          {"real_time_factor", time.real_time_factor},
          {"duration", time.duration_s ? json(*time.duration_s) : json()},
          {"mode", time.mode == sim::TimeMode::kLockstep ? "lockstep" : "paced"},
          {"finished", time.finished}};
}

json set_time_scale(MorseCall& call) {
  const double factor = call.arguments.number(0, 1e-3, 1e6);
  if (const auto refusal = call.state.host().set_time_factor(factor)) throw MorseRefusal(*refusal);
  return true;
}

json sleep(MorseCall& call) {
  call.state.answer_after(call.from, call.id, call.arguments.number(0, 0.0, 1e9));
  return nullptr;
}

constexpr MorseService kTime[] = {
    {"now", "", Right::kConnect, now},
    {"mode", "", Right::kConnect, mode},
    {"statistics", "", Right::kConnect, statistics},
    {"set_time_scale", "factor", Right::kAll, set_time_scale},
    {"sleep", "seconds", Right::kConnect, sleep, nullptr, true},
};

}  // namespace

std::span<const MorseService> simulation_services() { return kSimulation; }
std::span<const MorseService> time_services() { return kTime; }

}  // namespace playerlike::server
