// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/messages/messages.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <tuple>

#include "sim/core/number_text.h"
#include "sim/devices/builtin.h"
#include "sim/world/occupancy_map.h"

namespace playerlike {
namespace {

// The device types that implement an interface, in order of preference.
struct InterfaceRow {
  std::string_view interface;
  std::string_view device_type;
  int rank;
};

const std::vector<InterfaceRow>& interface_table() {
  static const auto* const table = [] {
    auto* rows = new std::vector<InterfaceRow>();
    for (const sim::DeviceKind& kind : sim::device_kinds()) {
      for (const sim::ProvidedInterface& interface : kind.interfaces) {
        rows->push_back({interface.name, kind.name, interface.rank});
      }
    }
    std::ranges::stable_sort(
        *rows, {}, [](const InterfaceRow& row) { return std::tuple(row.interface, row.rank); });
    return rows;
  }();
  return *table;
}

// Returns the robot's devices with the interface: first the devices that the robot names, then the
// others in the table's order. Robot is a RobotInfo or a sim::RobotDescription.
template <typename Robot, typename Device = typename decltype(Robot::devices)::value_type>
std::vector<const Device*> carriers(const Robot& robot, std::string_view interface) {
  std::vector<const Device*> found;
  for (const InterfaceRow& row : interface_table()) {
    if (row.interface != interface) continue;
    for (const Device& device : robot.devices) {
      if (device.type == row.device_type) found.push_back(&device);
    }
  }
  const auto named = robot.interfaces.find(std::string(interface));
  if (named == robot.interfaces.end()) return found;
  const std::vector<std::string>& names = named->second;
  const auto place = [&](const Device* device) {
    return std::find(names.begin(), names.end(), device->name) - names.begin();
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Device* a, const Device* b) { return place(a) < place(b); });
  return found;
}

// Interfaces of the world itself, independent of its robots.
constexpr std::string_view kWorldInterfaces[] = {"blackboard", "log", "map", "simulation"};

bool is_of_world(std::string_view interface) {
  return std::find(std::begin(kWorldInterfaces), std::end(kWorldInterfaces), interface) !=
         std::end(kWorldInterfaces);
}

// The end of a message about an interface that a port does not have.
std::string where_else(std::string_view interface) {
  if (interface == "planner") {
    return "; a driver \"wavefront\" provides it, as in worlds/examples/wavefront.json";
  }
  const std::string world = example_world(interface);
  return world.empty()
             ? "; no world that comes with Playpen has a device for " + std::string(interface)
             : "; of the worlds that come with Playpen, worlds/" + world + " has one";
}

// The devices of one robot that a port with several robots shows.
struct SharedDevices {
  std::int64_t first_index = 0;  // index of the robot's first device; servers may send any int
  std::size_t count = 0;         // number of shown devices, which have consecutive indices
};

// @param number  number of the robot among the robots of the port.
SharedDevices shared_devices(const std::map<std::string, int>& proxies, int number,
                             std::string_view interface, std::size_t carriers, int port) {
  const auto given = proxies.find(std::string(interface));
  const std::size_t first = std::min<std::size_t>(carriers, 1);
  if (given == proxies.end()) return {number, first};
  return {given->second, port == kMorsePort ? first : carriers};
}

// Returns the numbers of the robots of a port with several robots; none for the port of one robot.
std::vector<std::size_t> sharing(const std::vector<RobotInfo>& robots, int port) {
  std::vector<std::size_t> found;
  const RobotInfo* const first = robot_at(robots, port);
  if (port != kMorsePort && (first == nullptr || !first->shares_port)) return found;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (port == kMorsePort || robots[r].port == port) found.push_back(r);
  }
  return found;
}

// Name of the interface of planners, which only drivers provide.
constexpr std::string_view kPlanner = "planner";

// The device that measures the pose for a planner; null if the robot has none.
const DeviceInfo* pose_source(const RobotInfo& robot, const PlannerInfo& planner) {
  const bool localizes = planner.settings.localize >= 0;
  const auto devices = carriers(robot, localizes ? "localize" : "position2d");
  const int index = localizes ? planner.settings.localize : planner.settings.position;
  const auto i = static_cast<std::size_t>(std::max(index, 0));
  return i < devices.size() ? devices[i] : nullptr;
}

// Calls visit(interface, index, robot, device, driver) for every address of a port. `driver` is
// null except for the addresses of a robot's drivers, of which it is the type. Only the robot's own
// port offers these.
template <typename Visit>
void for_each_address(const std::vector<RobotInfo>& robots, int port, Visit visit) {
  const std::vector<std::size_t> shown = sharing(robots, port);
  for (const std::string_view interface : interface_names()) {
    int number = 0;  // of the robot among the robots of the port
    for (const std::size_t r : shown) {
      const auto devices = carriers(robots[r], interface);
      const SharedDevices shared =
          shared_devices(robots[r].proxies, number++, interface, devices.size(), port);
      for (std::size_t i = 0; i < shared.count; ++i) {
        visit(interface, static_cast<int>(shared.first_index + static_cast<std::int64_t>(i)),
              static_cast<int>(r), *devices[i], nullptr);
      }
    }
    if (!shown.empty()) continue;
    for (std::size_t r = 0; r < robots.size(); ++r) {
      const RobotInfo& robot = robots[r];
      const auto devices = carriers(robot, interface);
      if (devices.empty()) continue;
      if (port == robot.port) {
        for (std::size_t i = 0; i < devices.size(); ++i) {
          visit(interface, static_cast<int>(i), static_cast<int>(r), *devices[i], nullptr);
        }
        if (interface == "laser") {
          for (const ScanDriverInfo& driver : robot.scan_drivers) {
            visit(interface, driver.index, static_cast<int>(r),
                  *devices[static_cast<std::size_t>(driver.laser)], driver.type());
          }
        }
        if (interface != "position2d") continue;
        for (const GoalDriverInfo& driver : robot.goal_drivers) {
          visit(interface, driver.index, static_cast<int>(r),
                *devices[static_cast<std::size_t>(driver.position)], driver.type());
        }
      }
    }
  }
  if (!shown.empty()) return;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    if (robots[r].port != port) continue;
    for (const PlannerInfo& planner : robots[r].planners) {
      const DeviceInfo* const source = pose_source(robots[r], planner);
      if (source == nullptr) continue;
      visit(kPlanner, planner.index, static_cast<int>(r), *source, PlannerInfo::type());
    }
  }
}

/// The addresses of a port of a Player server; null for other ports.
const std::vector<PlayerAddress>* server_addresses(const std::vector<RobotInfo>& robots, int port) {
  const RobotInfo* const robot = robot_at(robots, port);
  return robot != nullptr && robot->addresses ? &*robot->addresses : nullptr;
}

std::optional<InterfaceBinding> look_up(const std::vector<RobotInfo>& robots, int port,
                                        std::string_view interface, int index) {
  if (const auto* addresses = server_addresses(robots, port)) {
    for (const PlayerAddress& address : *addresses) {
      if (address.interface != interface || address.index != index) continue;
      return InterfaceBinding{address.reading, address.motion, address.reading.robot,
                              nullptr,         nullptr,        &address};
    }
    return std::nullopt;
  }
  const std::vector<std::size_t> shown = sharing(robots, port);
  int place = 0;  // of the robot among the robots of the port
  for (const std::size_t r : shown) {
    const auto devices = carriers(robots[r], interface);
    const SharedDevices shared =
        shared_devices(robots[r].proxies, place++, interface, devices.size(), port);
    const std::int64_t i = index - shared.first_index;
    if (i < 0 || static_cast<std::size_t>(i) >= shared.count) continue;
    return InterfaceBinding{devices[static_cast<std::size_t>(i)]->id, std::nullopt,
                            static_cast<int>(r), nullptr};
  }
  const RobotInfo* const robot = robot_at(robots, port);
  if (!shown.empty() || robot == nullptr) return std::nullopt;
  const auto number = static_cast<int>(robot - robots.data());
  const auto devices = carriers(*robot, interface);
  if (index >= 0 && static_cast<std::size_t>(index) < devices.size()) {
    return InterfaceBinding{devices[static_cast<std::size_t>(index)]->id, std::nullopt, number,
                            nullptr};
  }
  if (interface == kPlanner) {
    for (const PlannerInfo& planner : robot->planners) {
      const DeviceInfo* const source = pose_source(*robot, planner);
      if (planner.index != index || source == nullptr) continue;
      return InterfaceBinding{source->id, std::nullopt, number, nullptr, &planner};
    }
  }
  if (interface == "laser" && !devices.empty()) {
    for (const ScanDriverInfo& driver : robot->scan_drivers) {
      if (driver.index != index) continue;
      return InterfaceBinding{devices[static_cast<std::size_t>(driver.laser)]->id,
                              std::nullopt,
                              number,
                              nullptr,
                              nullptr,
                              nullptr,
                              &driver};
    }
  }
  if (interface != "position2d" || devices.empty()) return std::nullopt;
  for (const GoalDriverInfo& driver : robot->goal_drivers) {
    if (driver.index != index) continue;
    return InterfaceBinding{devices[static_cast<std::size_t>(driver.position)]->id, std::nullopt,
                            number, &driver};
  }
  return std::nullopt;
}

}  // namespace

const RobotInfo* robot_at(const std::vector<RobotInfo>& robots, int port) {
  if (robots.empty()) return nullptr;
  // Most worlds number their robots in order.
  const std::size_t guess =
      static_cast<std::size_t>(port) - static_cast<std::size_t>(robots.front().port);
  if (guess < robots.size() && robots[guess].port == port) return &robots[guess];
  const auto found = std::find_if(robots.begin(), robots.end(),
                                  [&](const RobotInfo& robot) { return robot.port == port; });
  return found == robots.end() ? nullptr : &*found;
}

bool is_open(const std::vector<RobotInfo>& robots, int port) {
  return port == kMorsePort || robot_at(robots, port) != nullptr;
}

void require_finite(const sim::Command& command) {
  const auto& kind = sim::command_kinds()[command.index()];
  if (!sim::all_finite(kind.fields(), sim::object_in(command))) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a command holds a value that is not a finite number");
  }
  const auto* set_pose = std::get_if<sim::SetPoseCommand>(&command);
  if (set_pose == nullptr) return;
  if (const auto fault = sim::fault_of(*set_pose)) {
    throw SessionError(SessionError::Code::kBadArgument, *fault);
  }
}

bool carries(std::string_view device_type, std::string_view interface) {
  return std::ranges::any_of(interface_table(), [&](const InterfaceRow& row) {
    return row.device_type == device_type && row.interface == interface;
  });
}

std::vector<std::string_view> interface_names() {
  std::vector<std::string_view> names;
  for (const InterfaceRow& row : interface_table()) {
    if (names.empty() || names.back() != row.interface) names.push_back(row.interface);
  }
  return names;
}

std::vector<std::string> device_order(const sim::RobotDescription& robot,
                                      std::string_view interface) {
  std::vector<std::string> names;
  for (const sim::DeviceDescription* device : carriers(robot, interface)) {
    names.push_back(device->name);
  }
  return names;
}

std::string example_world(std::string_view interface) {
  // Each device type has a world of its name; the tests check this.
  for (const InterfaceRow& row : interface_table()) {
    if (row.interface == interface) return "devices/" + std::string(row.device_type) + ".json";
  }
  return "";
}

namespace {

// Checks that the devices of a shared port have different indices.
void check_shared_indices(const sim::WorldDescription& world,
                          std::vector<sim::ConfigIssue>& issues) {
  if (world.robots_on_port == 0) return;
  for (const std::string_view interface : interface_names()) {
    std::map<std::int64_t, std::string> taken;  // index -> ROBOT.DEVICE
    int number = 0;
    for (std::size_t r = 0; r < world.robots.size(); ++r) {
      const sim::RobotDescription& robot = world.robots[r];
      if (robot.port != world.robots_on_port) continue;
      const std::vector<std::string> devices = device_order(robot, interface);
      const SharedDevices shared =
          shared_devices(robot.proxies, number++, interface, devices.size(), robot.port);
      for (std::size_t i = 0; i < shared.count; ++i) {
        const std::int64_t index = shared.first_index + static_cast<std::int64_t>(i);
        const auto [other, added] = taken.emplace(index, robot.name + '.' + devices[i]);
        if (added) continue;
        issues.push_back(
            {"world/duplicate-index", world.file,
             "/robots/" + std::to_string(r) + "/proxies/" + std::string(interface),
             "an index of its own for each device on port " + std::to_string(robot.port),
             std::string(interface) + ':' + std::to_string(index) + " for " + robot.name + '.' +
                 devices[i] + ", which " + other->second + " has",
             "a robot's devices of an interface follow the index in its \"proxies\""});
        break;
      }
    }
  }
}

}  // namespace

void check_interfaces(const sim::WorldDescription& world) {
  const std::vector<std::string_view> interfaces = interface_names();
  std::string known;
  for (const std::string_view name : interfaces) {
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  std::vector<sim::ConfigIssue> issues;
  for (std::size_t r = 0; r < world.robots.size(); ++r) {
    const std::vector<sim::DeviceDescription>& devices = world.robots[r].devices;
    for (const auto& order : world.robots[r].interfaces) {
      const std::string& interface = order.first;
      const std::string pointer = "/robots/" + std::to_string(r) + "/interfaces/" + interface;
      if (std::find(interfaces.begin(), interfaces.end(), interface) == interfaces.end()) {
        issues.push_back({"world/interface-device", world.file, pointer,
                          "an interface that devices have: " + known, '"' + interface + '"', ""});
        continue;
      }
      for (std::size_t i = 0; i < order.second.size(); ++i) {
        const std::string& name = order.second[i];
        const auto device = std::find_if(devices.begin(), devices.end(),
                                         [&name](const auto& d) { return d.name == name; });
        if (device != devices.end() && carries(device->type, interface)) continue;
        issues.push_back({"world/interface-device", world.file, pointer + '/' + std::to_string(i),
                          "a device of the robot that has the interface " + interface,
                          '"' + name + '"' +
                              (device == devices.end() ? ", which it does not have"
                                                       : ", of type " + device->type),
                          ""});
      }
    }
  }
  check_shared_indices(world, issues);
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
}

void note_shared_ports(std::vector<RobotInfo>& robots) {
  std::map<int, RobotInfo*> first;
  for (RobotInfo& robot : robots) {
    const auto [other, added] = first.emplace(robot.port, &robot);
    other->second->shares_port = robot.shares_port = !added || other->second->shares_port;
  }
}

std::vector<RobotInfo> describe_robots(const sim::Simulation& simulation) {
  std::vector<RobotInfo> robots;
  for (int r = 0; r < simulation.robot_count(); ++r) {
    const sim::RobotDescription& description =
        simulation.world().robots[static_cast<std::size_t>(r)];
    const sim::RobotModel& model = simulation.model(r);
    RobotInfo robot;
    robot.name = description.name;
    robot.model = model.name;
    robot.colour = description.colour;
    robot.initial_pose = description.pose;
    robot.port = description.port;
    robot.height_m = model.height_m;
    robot.max_speed_mps = model.max_speed_mps;
    robot.max_turn_rate_radps = model.max_turn_rate_radps;
    robot.proxies = description.proxies;
    robot.interfaces = description.interfaces;
    robot.drivers = description.drivers;
    sim::Vec2 low = sim::Vec2::Constant(std::numeric_limits<double>::infinity());
    sim::Vec2 high = -low;
    for (const sim::Vec2& v : model.footprint) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
      robot.radius_m = std::max(robot.radius_m, v.norm());
    }
    robot.mass_kg = model.mass_kg;
    robot.length_m = high.x() - low.x();
    robot.width_m = high.y() - low.y();
    robot.center_m = 0.5 * (low + high);
    for (std::size_t d = 0; d < description.devices.size(); ++d) {
      const sim::DeviceDescription& device = description.devices[d];
      DeviceInfo info;
      info.id = {r, static_cast<int>(d)};
      info.name = device.name;
      info.type = device.type;
      if (const sim::DeviceKind* kind = sim::find_device_kind(device.type)) {
        info.properties = kind->model_properties ? kind->model_properties(device.params, model)
                                                 : kind->properties(device.params);
      }
      robot.devices.push_back(std::move(info));
    }
    read_drivers(robot, simulation.world().file, "/robots/" + std::to_string(r));
    robots.push_back(std::move(robot));
  }
  note_shared_ports(robots);
  return robots;
}

sim::CanvasDescription map_grid(const sim::ArenaDescription& arena, double cell_size_m) {
  if (const auto grid = sim::floor_grid(arena, cell_size_m)) return *grid;
  throw SessionError(SessionError::Code::kBadArgument,
                     "a map of this arena needs a cell size of at least " +
                         sim::rounded_text(arena.size.maxCoeff() / sim::kMaxCanvasSide, 6) +
                         " m, but it is " + sim::rounded_text(cell_size_m, 6));
}

namespace {

SessionError no_such_device(const std::vector<RobotInfo>& robots, int port,
                            std::string_view interface, int index) {
  std::ostringstream known;
  known.imbue(std::locale::classic());
  const std::string what = "there is no device " + std::string(interface) + ':' +
                           std::to_string(index) + " on port " + std::to_string(port);
  if (const auto* addresses = server_addresses(robots, port)) {
    for (const PlayerAddress& address : *addresses) {
      known << (known.tellp() > 0 ? ", " : "") << address.interface << ':' << address.index;
    }
    return {SessionError::Code::kNoSuchDevice,
            what + "; the Player server has there: " +
                (known.tellp() > 0 ? known.str() : std::string("nothing"))};
  }
  bool has_others = is_of_world(interface);  // whether the interface exists under another index
  for_each_address(
      robots, port,
      [&](std::string_view name, int i, int robot, const DeviceInfo& device, const char* driver) {
        has_others = has_others || name == interface;
        known << (known.tellp() > 0 ? ", " : "") << name << ':' << i << " ("
              << robots[static_cast<std::size_t>(robot)].name << '.'
              << (driver == nullptr ? device.name : std::string(driver)) << ')';
      });
  if (is_open(robots, port)) {
    for (const std::string_view name : kWorldInterfaces) {
      known << (known.tellp() > 0 ? ", " : "") << name << ":0 (the world)";
    }
  }
  return {SessionError::Code::kNoSuchDevice,
          what + "; this world has there: " +
              (known.tellp() > 0 ? known.str() : std::string("nothing")) +
              (has_others ? "" : where_else(interface))};
}

}  // namespace

InterfaceBinding find_interface(const std::vector<RobotInfo>& robots, int port,
                                std::string_view interface, int index) {
  const bool of_server = server_addresses(robots, port) != nullptr;
  if (!of_server && is_of_world(interface) && index == 0 && is_open(robots, port)) return {};
  std::optional<InterfaceBinding> found = look_up(robots, port, interface, index);
  if (!found) throw no_such_device(robots, port, interface, index);
  if (of_server) return *found;
  for (const DeviceInfo& device : robots[static_cast<std::size_t>(found->robot)].devices) {
    if (device.type == "motion") {
      found->motion = device.id;
      break;
    }
  }
  return *found;
}

std::vector<InterfaceAddress> list_interfaces(const std::vector<RobotInfo>& robots, int port) {
  std::vector<InterfaceAddress> addresses;
  if (const auto* of_server = server_addresses(robots, port)) {
    const RobotInfo& robot = *robot_at(robots, port);
    for (const PlayerAddress& address : *of_server) {
      const bool is_world = address.reading.robot < 0;
      addresses.push_back(
          {address.interface, address.index, is_world ? "" : robot.name,
           is_world ? "world"
                    : robot.devices[static_cast<std::size_t>(address.reading.device)].name});
    }
    return addresses;
  }
  for_each_address(
      robots, port,
      [&](std::string_view name, int i, int robot, const DeviceInfo& device, const char* driver) {
        addresses.push_back({std::string(name), i, robots[static_cast<std::size_t>(robot)].name,
                             driver == nullptr ? device.name : std::string(driver)});
      });
  if (!is_open(robots, port)) return addresses;
  for (const std::string_view name : kWorldInterfaces) {
    addresses.push_back({std::string(name), 0, "", "world"});
  }
  return addresses;
}

}  // namespace playerlike
