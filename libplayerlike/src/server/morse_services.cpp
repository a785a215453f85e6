// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/morse_services.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "protocol/codec.h"
#include "server/morse_streams.h"
#include "sim/devices/waypoint.h"
#include "sim/world/view_mode.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

constexpr double kFar_m = 1e6;
constexpr double kTurns_rad = 1e6;
constexpr int kLeastCell = std::numeric_limits<int>::min();
constexpr int kMostCell = std::numeric_limits<int>::max();
/// What a client is shown of a value that it sent.
constexpr std::size_t kShownBytes = 60;

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > kShownBytes) text = text.substr(0, kShownBytes) + "...";
  return text;
}

std::string range(double least, double most) {
  const json low = least;
  const json high = most;
  return "from " + low.dump() + " to " + high.dump();
}

const MorseComponent& require_component(MorseCall& call, std::size_t argument) {
  const std::string name = call.arguments.text(argument);
  const MorseComponent* component = call.state.find(name);
  if (component == nullptr) throw MorseRefusal("there is no component \"" + name + "\"");
  return *component;
}

void require_command(const MorseCall& call, int robot) {
  if (call.from.rights().command.at(static_cast<std::size_t>(robot))) return;
  throw MorseRefusal("access/denied: this connection has no token for the robot " +
                     call.state.host().robots().at(static_cast<std::size_t>(robot)).name);
}

// Private worlds: see sim::SimulationDescription::own_sensors_only.
void require_own(const MorseCall& call) {
  if (call.from.rights().read.at(static_cast<std::size_t>(call.component->robot))) return;
  throw MorseRefusal(
      "access/denied: this world lets a client read the sensors of its own robots only: present "
      "the "
      "token of the robot " +
      call.state.host().robots().at(static_cast<std::size_t>(call.component->robot)).name);
}

void require_truth(const MorseCall& call) {
  if (call.from.rights().truth) return;
  throw MorseRefusal(
      "access/denied: this world keeps the poses of its objects private: that takes the tokens of "
      "all robots");
}

void require_command_all(const MorseCall& call) {
  if (call.from.rights().command_all()) return;
  throw MorseRefusal("access/denied: this connection has no tokens for all robots");
}

DeviceId device_of(const MorseCall& call) { return call.component->device.value(); }

const RobotInfo& robot_of(const MorseCall& call) {
  return call.state.host().robots().at(static_cast<std::size_t>(call.component->robot));
}

const DeviceInfo& info_of(const MorseCall& call) {
  return robot_of(call).devices.at(static_cast<std::size_t>(device_of(call).device));
}

// Throws what a simulation says against something.
void require_done(const std::optional<std::string>& refusal) {
  if (refusal) throw MorseRefusal(*refusal);
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
  const std::string world =
      call.state.with([](const sim::Simulation& simulation) { return simulation.world().name; });
  return {{"robots", std::move(robots)}, {"environment", world}};
}

json list_streams(MorseCall& call) {
  json names = json::array();
  for (const MorseComponent& component : call.state.components()) {
    if (component.stream != StreamDirection::kNone) names.push_back(component.name);
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
    if (component.stream == StreamDirection::kNone) continue;
    ports[component.name] = call.state.streams().port(component);
  }
  return ports;
}

json reset_objects(MorseCall& call) {
  call.state.with([](sim::Simulation& simulation) {
    simulation.reset();
    return true;
  });
  return "Objects restored to initial position";
}

json quit(MorseCall& call) {
  // After the answer.
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
  call.state.with([&](sim::Simulation& simulation) {
    simulation.set_active(*component.device, active);
    return true;
  });
  return nullptr;
}
json activate(MorseCall& call) { return set_active(call, true); }
json deactivate(MorseCall& call) { return set_active(call, false); }

json suspend_dynamics(MorseCall& call) {
  require_done(call.state.with([](sim::Simulation& s) { return s.set_dynamics(false); }));
  return "Physics is suspended";
}

json restore_dynamics(MorseCall& call) {
  require_done(call.state.with([](sim::Simulation& s) { return s.set_dynamics(true); }));
  return "Physics is resumed";
}

json get_scene_objects(MorseCall& call) {
  require_truth(call);
  return call.state.with([](const sim::Simulation& simulation) {
    json objects = json::object();
    for (const sim::SceneObject& object : simulation.scene_objects()) {
      objects.emplace(object.name, morse_scene_object(object));
    }
    return objects;
  });
}

json set_object_visibility(MorseCall& call) {
  const std::string name = call.arguments.text(0);
  const bool visible = call.arguments.boolean(1);
  static_cast<void>(call.arguments.boolean(2));  // nothing has children
  return call.state.with([&](sim::Simulation& simulation) {
    const auto objects = simulation.scene_objects();
    // A block before a robot of the same name: it is what can be hidden.
    const auto is_block = [&](const sim::SceneObject& o) {
      return o.name == name && o.kind == "block" && o.dynamic;
    };
    if (std::any_of(objects.begin(), objects.end(), is_block)) {
      const auto state = visible ? sim::ObstacleState::kExtended : sim::ObstacleState::kRetracted;
      require_done(simulation.set_obstacle_state(name, state));
      return json(visible);
    }
    if (std::none_of(objects.begin(), objects.end(),
                     [&](const sim::SceneObject& o) { return o.name == name; })) {
      throw MorseRefusal("Object '" + name + "' does not appear in the scene.");
    }
    return json(true);  // as it was: nothing else can be hidden
  });
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
  require_done(call.state.with(
      [&](sim::Simulation& simulation) { return simulation.set_object_dynamics(name, on); }));
  return on;
}

json set_log_level(MorseCall& call) {
  const std::string component = call.arguments.text(0);
  if (component != "simulation" && component != "time") {
    static_cast<void>(require_component(call, 0));
  }
  // Python's names, and their numbers.
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

constexpr std::array kSimulation{
    MorseService{"list_robots", "", 0, 0, Right::kConnect, false, list_robots},
    MorseService{"details", "", 0, 0, Right::kConnect, false, details},
    MorseService{"list_streams", "", 0, 0, Right::kConnect, false, list_streams},
    MorseService{"get_stream_port", "component", 1, 1, Right::kConnect, false, get_stream_port},
    MorseService{"get_all_stream_ports", "", 0, 0, Right::kConnect, false, get_all_stream_ports},
    MorseService{"reset_objects", "", 0, 0, Right::kAll, false, reset_objects},
    MorseService{"quit", "", 0, 0, Right::kAll, false, quit},
    MorseService{"terminate", "", 0, 0, Right::kAll, false, quit},
    MorseService{"activate", "component", 1, 1, Right::kConnect, false, activate},
    MorseService{"deactivate", "component", 1, 1, Right::kConnect, false, deactivate},
    MorseService{"suspend_dynamics", "", 0, 0, Right::kAll, false, suspend_dynamics},
    MorseService{"restore_dynamics", "", 0, 0, Right::kAll, false, restore_dynamics},
    MorseService{"get_scene_objects", "", 0, 0, Right::kConnect, false, get_scene_objects},
    MorseService{"set_object_visibility", "object, visible, children", 3, 3, Right::kAll, false,
                 set_object_visibility},
    MorseService{"set_object_dynamics", "object, on", 2, 2, Right::kConnect, false,
                 set_object_dynamics},
    MorseService{"set_log_level", "component, level", 2, 2, Right::kAll, false, set_log_level},
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
  require_done(call.state.host().set_time_factor(call.arguments.number(0, 1e-3, 1e6)));
  return true;
}

json sleep(MorseCall& call) {
  call.state.answer_after(call.from, call.id, call.arguments.number(0, 0.0, 1e9));
  return nullptr;
}

constexpr std::array kTime{
    MorseService{"now", "", 0, 0, Right::kConnect, false, now},
    MorseService{"mode", "", 0, 0, Right::kConnect, false, mode},
    MorseService{"statistics", "", 0, 0, Right::kConnect, false, statistics},
    MorseService{"set_time_scale", "factor", 1, 1, Right::kAll, false, set_time_scale},
    MorseService{"sleep", "seconds", 1, 1, Right::kConnect, true, sleep},
};

// --- motion

json drive(MorseCall& call, double v_mps, double omega_radps) {
  call.state.command(device_of(call), sim::TwistCommand{{v_mps, omega_radps, 0.0}});
  return nullptr;
}
json set_speed(MorseCall& call) {
  return drive(call, call.arguments.number(0, -kFar_m, kFar_m),
               call.arguments.number(1, -kFar_m, kFar_m));
}
json stop_motion(MorseCall& call) { return drive(call, 0.0, 0.0); }

constexpr std::array kMotion{
    MorseService{"set_speed", "v, w", 2, 2, Right::kRobot, false, set_speed},
    MorseService{"stop", "", 0, 0, Right::kRobot, false, stop_motion},
};

// --- waypoint

const sim::Waypoint& waypoint_in(const sim::Simulation& simulation, DeviceId device) {
  return dynamic_cast<const sim::Waypoint&>(simulation.device(device.robot, device.device));
}

sim::GotoCommand goal_of(MorseCall& call) {
  const sim::WaypointParams params = call.state.with([&](const sim::Simulation& simulation) {
    return waypoint_in(simulation, device_of(call)).params();
  });
  static_cast<void>(call.arguments.number(2, -kFar_m, kFar_m));  // z: the floor is flat
  constexpr double kLeast = 1e-6;
  return {{call.arguments.number(0, -kFar_m, kFar_m), call.arguments.number(1, -kFar_m, kFar_m)},
          call.arguments.number(3, kLeast, kFar_m, params.tolerance_m),
          call.arguments.number(4, kLeast, kFar_m, params.speed_mps)};
}

json go_to(MorseCall& call) {
  call.state.answer_on_arrival(call.from, call.id, device_of(call), goal_of(call));
  return nullptr;
}

json setdest(MorseCall& call) {
  const sim::GotoCommand goal = goal_of(call);
  const double distance_m = call.state.with([&](const sim::Simulation& simulation) {
    const sim::Pose& X_WB = simulation.body(call.component->robot).X_WB;
    return (goal.goal_m - X_WB.position()).norm();
  });
  if (distance_m <= goal.tolerance_m) return false;
  call.state.command(device_of(call), goal);
  return true;
}

json status_after(MorseCall& call, const sim::Command& command) {
  call.state.command(device_of(call), command);
  return call.state.with([&](const sim::Simulation& simulation) {
    return json(std::string(to_string(waypoint_in(simulation, device_of(call)).status())));
  });
}
json stop_waypoint(MorseCall& call) { return status_after(call, sim::StopCommand{}); }
json resume(MorseCall& call) { return status_after(call, sim::ResumeCommand{}); }

json get_status(MorseCall& call) {
  require_own(call);
  return call.state.with([&](const sim::Simulation& simulation) {
    return json(std::string(to_string(waypoint_in(simulation, device_of(call)).status())));
  });
}

constexpr std::string_view kGoal = "x, y, z, tolerance=0.5, speed=1.0";
constexpr std::array kWaypoint{
    MorseService{"goto", kGoal, 3, 5, Right::kRobot, true, go_to},
    MorseService{"setdest", kGoal, 3, 5, Right::kRobot, false, setdest},
    MorseService{"stop", "", 0, 0, Right::kRobot, false, stop_waypoint},
    MorseService{"resume", "", 0, 0, Right::kRobot, false, resume},
    MorseService{"get_status", "", 0, 0, Right::kConnect, false, get_status},
};

// --- teleport

json translate(MorseCall& call) {
  if (call.arguments.number(2, -kFar_m, kFar_m, 0.0) != 0.0) {
    call.arguments.refuse(2, "0, as the floor is flat");
  }
  call.state.command(device_of(call),
                     sim::TranslateCommand{{call.arguments.number(0, -kFar_m, kFar_m),
                                            call.arguments.number(1, -kFar_m, kFar_m, 0.0)}});
  return nullptr;
}

json rotate(MorseCall& call) {
  for (const std::size_t index : {0U, 1U}) {
    if (call.arguments.number(index, -kTurns_rad, kTurns_rad, 0.0) != 0.0) {
      call.arguments.refuse(index, "0, as the floor is flat: robots turn by yaw only");
    }
  }
  call.state.command(device_of(call),
                     sim::RotateCommand{call.arguments.number(2, -kTurns_rad, kTurns_rad, 0.0)});
  return nullptr;
}

constexpr std::array kTeleport{
    MorseService{"translate", "x, y=0, z=0", 1, 3, Right::kRobot, false, translate},
    MorseService{"rotate", "roll, pitch=0, yaw=0", 1, 3, Right::kRobot, false, rotate},
};

// --- pen

std::uint8_t channel(const MorseArguments& arguments, std::size_t index,
                     std::optional<int> otherwise = {}) {
  return static_cast<std::uint8_t>(arguments.integer(index, 0, 255, otherwise));
}

// Red, green, blue, and maybe alpha, from an argument on.
sim::CellValue colour_from(const MorseArguments& arguments, std::size_t first) {
  return sim::CellValue::of(sim::Colour{channel(arguments, first), channel(arguments, first + 1),
                                        channel(arguments, first + 2),
                                        channel(arguments, first + 3, 255)});
}

// Cells that get_image_data lists.
constexpr std::size_t kMostListedCells = std::size_t{1} << 22U;

template <json (*kPen)(const PenCall&)>
json here(MorseCall& call) {
  return kPen({*call.state.client(), call.arguments});
}

json draw(MorseCall& call, std::span<const sim::DrawOperation> operations) {
  call.state.with([&](sim::Simulation& simulation) {
    simulation.layers().draw(operations);
    return true;
  });
  return nullptr;
}

json set_pixel(MorseCall& call) {
  sim::DrawOperation pixel;
  pixel.x0 = call.arguments.integer(0, kLeastCell, kMostCell);
  pixel.y0 = call.arguments.integer(1, kLeastCell, kMostCell);
  pixel.value = colour_from(call.arguments, 2);
  return draw(call, {&pixel, 1});
}

json set_line(MorseCall& call) {
  sim::DrawOperation line;
  line.kind = sim::DrawOperation::Kind::kLine;
  line.x0 = call.arguments.integer(0, kLeastCell, kMostCell);
  line.y0 = call.arguments.integer(1, kLeastCell, kMostCell);
  line.x1 = call.arguments.integer(2, kLeastCell, kMostCell);
  line.y1 = call.arguments.integer(3, kLeastCell, kMostCell);
  line.value = colour_from(call.arguments, 4);
  return draw(call, {&line, 1});
}

json clear(const PenCall& call) {
  DrawWork fill;
  fill.operations.emplace_back().kind = sim::DrawOperation::Kind::kFill;
  while (!call.client.draw_some(fill, kPieceCells)) {
  }
  return nullptr;
}

json get_pixel(MorseCall& call) {
  const int column = call.arguments.integer(0, kLeastCell, kMostCell);
  const int row = call.arguments.integer(1, kLeastCell, kMostCell);
  const auto cell = call.state.session().request(CellRequest{sim::kBaseLayer, column, row});
  if (!cell) return nullptr;
  const sim::Colour c = cell->colour();
  return json::array({c.r, c.g, c.b, c.a});
}

json get_image_data(const PenCall& call) {
  const int channels = call.arguments.integer(0, 3, 4, 3);
  if (canvas_cells(call.client.session()) > kMostListedCells) {
    throw MorseRefusal("the canvas has more than " + std::to_string(kMostListedCells) +
                       " cells, too many for a list of numbers: get_pixel has single cells, "
                       "save_image_copy the picture, and so has Playpen's own protocol");
  }
  json::array_t data;
  const auto cells = call.client.session().request(CellsRequest{sim::kBaseLayer});
  data.reserve(cells.size() * static_cast<std::size_t>(channels));
  for (const sim::CellValue& cell : cells) {
    const sim::Colour c = cell.colour();
    data.insert(data.end(), {c.r, c.g, c.b});
    if (channels == 4) data.emplace_back(c.a);
  }
  return data;
}

// A channel in a list of them.
std::uint8_t channel_in(const MorseArguments& arguments, const json& value) {
  if (!value.is_number_integer() || value < 0 || value > 255) {
    arguments.refuse(0, "whole numbers from 0 to 255 as colours, but there is " + shown(value));
  }
  return value.get<std::uint8_t>();
}

json set_image_data(MorseCall& call) {
  const json& data = call.arguments.list(0);
  Session& session = call.state.session();
  const CanvasInfo canvas = session.request(CanvasInfoRequest{});
  const auto count =
      static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
  if (data.size() != 3 * count && data.size() != 4 * count) {
    call.arguments.refuse(0, "a list of 3 or 4 numbers for each of the canvas's " +
                                 std::to_string(canvas.width) + " x " +
                                 std::to_string(canvas.height) + " cells, but it has " +
                                 std::to_string(data.size()));
  }
  const std::size_t channels = data.size() / count;
  std::vector<sim::CellValue> cells(count);
  for (std::size_t i = 0; i < count; ++i) {
    sim::Colour c;
    c.r = channel_in(call.arguments, data[channels * i]);
    c.g = channel_in(call.arguments, data[channels * i + 1]);
    c.b = channel_in(call.arguments, data[channels * i + 2]);
    if (channels == 4) c.a = channel_in(call.arguments, data[channels * i + 3]);
    cells[i] = sim::CellValue::of(c);
  }
  session.request(
      SetCellsRequest{sim::kBaseLayer, {0, 0, canvas.width, canvas.height}, std::move(cells)});
  return nullptr;
}

json update_image_data(MorseCall& call) {
  std::vector<sim::DrawOperation> pixels;
  for (const json& entry : call.arguments.list(0)) {
    const bool sound =
        entry.is_array() && (entry.size() == 5 || entry.size() == 6) &&
        std::all_of(entry.begin(), entry.end(), [](const json& number) {
          return number.is_number_integer() && number >= kLeastCell && number <= kMostCell;
        });
    if (!sound) {
      call.arguments.refuse(
          0, "a list of [x, y, r, g, b] or [x, y, r, g, b, a], but there is " + shown(entry));
    }
    sim::DrawOperation pixel;
    pixel.x0 = entry[0].get<int>();
    pixel.y0 = entry[1].get<int>();
    sim::Colour c;
    c.r = channel_in(call.arguments, entry[2]);
    c.g = channel_in(call.arguments, entry[3]);
    c.b = channel_in(call.arguments, entry[4]);
    if (entry.size() == 6) c.a = channel_in(call.arguments, entry[5]);
    pixel.value = sim::CellValue::of(c);
    pixels.push_back(pixel);
  }
  return draw(call, pixels);
}

json size_of_canvas(const PenCall& call) {
  const CanvasInfo canvas = call.client.session().request(CanvasInfoRequest{});
  return json::array({canvas.width, canvas.height});
}

json resize_canvas(const PenCall& call) {
  call.client.session().request(
      ResizeCanvasRequest{call.arguments.integer(0, 1, 8192), call.arguments.integer(1, 1, 8192)});
  return size_of_canvas(call);
}

json get_cell_size(MorseCall& call) {
  return call.state.session().request(CanvasInfoRequest{}).cell_size_m;
}

json save_image_copy(const PenCall& call) {
  call.client.session().request(SaveImageRequest{call.arguments.text(0)});
  return nullptr;
}

json get_view_mode(MorseCall& call) {
  return std::string(sim::to_string(call.state.session().request(ViewModeRequest{})));
}

json set_view_mode(MorseCall& call) {
  const auto chosen = sim::parse_view_mode(call.arguments.text(0));
  if (!chosen) call.arguments.refuse(0, "ground, mini-map or full-screen");
  call.state.session().request(SetViewModeRequest{*chosen});
  return nullptr;
}

constexpr std::array kPen{
    MorseService{"set_pixel", "x, y, r, g, b, a=255", 5, 6, Right::kRobot, false, set_pixel},
    MorseService{"get_pixel", "x, y", 2, 2, Right::kConnect, false, get_pixel},
    MorseService{"set_line", "x0, y0, x1, y1, r, g, b, a=255", 7, 8, Right::kRobot, false,
                 set_line},
    MorseService{"get_image_data", "channels=3", 0, 1, Right::kConnect, false, here<get_image_data>,
                 get_image_data},
    MorseService{"set_image_data", "data", 1, 1, Right::kRobot, false, set_image_data},
    MorseService{"update_image_data", "pixels", 1, 1, Right::kRobot, false, update_image_data},
    MorseService{"clear", "", 0, 0, Right::kRobot, false, here<clear>, clear},
    MorseService{"get_canvas_size", "", 0, 0, Right::kConnect, false, here<size_of_canvas>},
    MorseService{"resize_canvas", "width, height", 2, 2, Right::kRobot, false, here<resize_canvas>,
                 resize_canvas},
    MorseService{"get_cell_size", "", 0, 0, Right::kConnect, false, get_cell_size},
    MorseService{"save_image_copy", "name", 1, 1, Right::kRobot, false, here<save_image_copy>,
                 save_image_copy},
    MorseService{"get_view_mode", "", 0, 0, Right::kConnect, false, get_view_mode},
    MorseService{"set_view_mode", "mode", 1, 1, Right::kRobot, false, set_view_mode},
};

// --- sensors

json get_local_data(MorseCall& call) {
  require_own(call);
  if (!call.component->device) {
    return morse_properties_record(robot_of(call), call.state.host().time().sim_time_ns);
  }
  const DeviceId device = device_of(call);
  return call.state.with([&](const sim::Simulation& simulation) {
    const auto& sensor =
        dynamic_cast<const sim::Sensor&>(simulation.device(device.robot, device.device));
    if (sensor.reading().sequence == 0) {
      throw MorseRefusal(call.component->name +
                         " has no reading yet: simulated time has not come so far");
    }
    return morse_record(sensor.reading(), odometry_level(simulation, device));
  });
}

constexpr std::array kSensor{
    MorseService{"get_local_data", "", 0, 0, Right::kConnect, false, get_local_data},
};

// --- all components

// The settings of a component as the world gives them.
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
  const double c = std::cos(mount.yaw_rad);
  const double s = std::sin(mount.yaw_rad);
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
                     ", as the world gives it, and stays so while it runs");
}

constexpr std::array kComponent{
    MorseService{"get_configurations", "", 0, 0, Right::kConnect, false, get_configurations},
    MorseService{"get_properties", "", 0, 0, Right::kConnect, false, get_properties},
    MorseService{"set_property", "name, value", 2, 2, Right::kRobot, false, set_property},
};

std::string known_names(const std::vector<const MorseService*>& services) {
  std::string names;
  for (const MorseService* service : services) {
    names += (names.empty() ? "" : ", ") + std::string(service->name);
  }
  return names;
}

}  // namespace

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
  if (!(value >= least && value <= most)) refuse(index, "a number " + range(least, most));
  return value;
}

int MorseArguments::integer(std::size_t index, int least, int most,
                            std::optional<int> otherwise) const {
  if (otherwise && (!has(index) || list_[index].is_null())) return *otherwise;
  // As doubles, so that 3.0 is a whole number too and nothing overflows.
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
  if (kind == "simulation") return kSimulation;
  if (kind == "time") return kTime;
  if (kind == "motion") return kMotion;
  if (kind == "waypoint") return kWaypoint;
  if (kind == "teleport") return kTeleport;
  if (kind == "pen") return kPen;
  if (kind == "sensor") return kSensor;
  if (kind == "component") return kComponent;
  return {};
}

std::vector<const MorseService*> services_of(const MorseComponent& component) {
  std::vector<const MorseService*> all;
  const auto add = [&all](std::string_view kind) {
    for (const MorseService& service : morse_services(kind)) all.push_back(&service);
  };
  // By the device's type; a sensor's type has no group of its own.
  if (component.device) add(component.type);
  if (component.stream == StreamDirection::kOut) add("sensor");
  add("component");
  return all;
}

std::optional<json> call_service(MorseState& state, MorseConnection& from, const std::string& id,
                                 std::string_view component, std::string_view service,
                                 const json& list) {
  if (!from.rights().connect) {
    throw MorseRefusal("access/denied: this server wants a token first: playpen token [\"...\"]");
  }
  const MorseComponent* found = state.find(component);
  std::vector<const MorseService*> services;
  if (found != nullptr) {
    services = services_of(*found);
  } else {
    if (component != "simulation" && component != "time") {
      throw MorseRefusal("there is no component \"" + std::string(component) + "\"");
    }
    for (const MorseService& row : morse_services(component)) services.push_back(&row);
  }
  const auto row = std::find_if(services.begin(), services.end(),
                                [&](const MorseService* s) { return s->name == service; });
  if (row == services.end()) {
    throw MorseRefusal("The request " + std::string(service) + " has not been registered for " +
                       std::string(component) + "; it has: " + known_names(services));
  }
  const MorseService& chosen = **row;
  if (list.size() < chosen.least || list.size() > chosen.most) {
    const std::string wanted =
        std::to_string(chosen.least) +
        (chosen.most > chosen.least ? " to " + std::to_string(chosen.most) : "");
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
  const bool resizes = chosen.work == static_cast<json (*)(const PenCall&)>(resize_canvas);
  if (chosen.work != nullptr && (resizes || canvas_cells(state.session()) > kLightCells)) {
    from.work(id, chosen, list);
    return std::nullopt;
  }
  json result = chosen.run(call);
  if (chosen.later) return std::nullopt;
  return result;
}

}  // namespace playerlike::server
