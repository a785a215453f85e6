// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "io/document.h"
#include "io/stage/translation.h"

namespace sim::io::stage {
namespace {

constexpr int kDefaultPort = 6665;

/// An address as Player writes it: key:host:robot:interface:index, the first three of which may be
/// missing or empty.
struct Address {
  int port = kDefaultPort;
  std::string interface;
  int index = 0;
  Place place;
};

std::optional<int> whole_number(std::string_view text, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most) {
    return std::nullopt;
  }
  return value;
}

std::optional<Address> parse_address(const Value& value) {
  std::vector<std::string_view> parts;
  std::string_view rest = value.text;
  while (rest.ends_with(' ')) rest.remove_suffix(1);  // as Player, which reads numbers by atoi()
  for (;;) {
    const std::size_t colon = rest.find(':');
    parts.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (parts.size() < 2 || parts.size() > 5) return std::nullopt;
  Address address;
  address.place = value.place;
  const std::optional<int> index = whole_number(parts.back(), 1000);
  address.interface = std::string(parts[parts.size() - 2]);
  if (!index || address.interface.empty()) return std::nullopt;
  address.index = *index;
  if (parts.size() >= 3 && !parts[parts.size() - 3].empty()) {
    const std::optional<int> port = whole_number(parts[parts.size() - 3], 65535);
    if (!port) return std::nullopt;
    address.port = *port;
  }
  return address;
}

/// The interface of Player and the model of Stage that offers it.
struct InterfaceRow {
  std::string_view interface;
  std::vector<std::string_view> stage_types;
  std::string_view device;  ///< type of device; "": any
};

const std::vector<InterfaceRow>& interface_rows() {
  static const std::vector<InterfaceRow> kRows = {
      {"ranger", {"ranger", "laser"}, ""},
      {"laser", {"ranger", "laser"}, "laser"},
      {"sonar", {"ranger"}, "sonar"},
      {"fiducial", {"fiducial"}, ""},
      {"blobfinder", {"blobfinder"}, ""},
      {"bumper", {"bumper"}, ""},
      {"gripper", {"gripper"}, ""},
      {"camera", {"camera"}, ""},
      {"ptz", {"ptz"}, ""},
      {"wifi", {"wifi"}, ""},
      {"power", {"power"}, ""},
      {"actarray", {"actuator"}, ""},
      {"blinkenlight", {"blinkenlight", "lightindicator"}, ""},
  };
  return kRows;
}

/// Interfaces that every robot or world has.
bool is_everywhere(std::string_view interface) {
  constexpr std::string_view kNames[] = {"simulation", "speech", "graphics2d", "graphics3d", "map"};
  return std::find(std::begin(kNames), std::end(kNames), interface) != std::end(kNames);
}

class PlayerFile {
 public:
  PlayerFile(bool must_match, Translation& translation, Report& report)
      : must_match_(must_match), translation_(translation), report_(report) {}

  void run(const Entity& config) {
    for (const Entity& driver : config.children) {
      if (driver.type != "driver") {
        report_.note("cfg " + driver.type, driver.place,
                     "the section " + in_quotes(driver.type) + " is left out");
        continue;
      }
      const Properties properties(driver, units_, report_);
      const std::string name = properties.text("name", "");
      if (name == "stage") {
        stage_driver(properties);
      } else {
        others_.emplace_back(&driver, name);
      }
    }
    set_addresses();
    for (const auto& [driver, name] : others_) {
      other_driver(Properties(*driver, units_, report_), name);
    }
    set_ports();
  }

 private:
  std::vector<Address> addresses(const Properties& driver, const char* key) {
    std::vector<Address> all;
    const Property* property = driver.entity().find(key);
    if (property == nullptr) return all;
    for (const Value& value : property->values) {
      if (std::optional<Address> address = parse_address(value)) {
        all.push_back(*std::move(address));
      } else {
        report_.error(value.place, "stage/bad-address",
                      "an address like \"position2d:0\" or \"6665:position2d:0\"",
                      in_quotes(value.text));
      }
    }
    return all;
  }

  /// A robot by the name of its model, or of a model on it.
  RobotDraft* find_robot(const std::string& name) {
    for (RobotDraft& robot : translation_.robots) {
      if (robot.stage_name == name) return &robot;
    }
    return nullptr;
  }

  void stage_driver(const Properties& driver) {
    const std::vector<Address> provided = addresses(driver, "provides");
    const bool only_world =
        std::all_of(provided.begin(), provided.end(),
                    [](const Address& address) { return is_everywhere(address.interface); });
    if (!driver.has("model")) {
      if (!only_world) {
        report_.error(driver.entity().place, "stage/no-model",
                      "\"model\", the name of a model of the world", "a driver without it");
      }
      return;
    }
    const std::string name = driver.text("model", "");
    RobotDraft* const robot = find_robot(name);
    if (robot == nullptr) {
      if (!only_world) missing_robot(driver.place_of("model"), name);
      return;
    }
    for (const Address& address : provided) bind(*robot, address);
  }

  void missing_robot(const Place& place, const std::string& name) {
    std::vector<std::string> known;
    for (const RobotDraft& robot : translation_.robots) known.push_back(robot.stage_name);
    const std::string expected = known.empty()
                                     ? "no name: the world has no position model"
                                     : "a position model of the world: " + list_text(known);
    if (must_match_) {
      const std::string near = nearest_word(name, known);
      report_.error(place, "stage/no-model", expected, in_quotes(name),
                    near.empty() ? "" : "did you mean " + in_quotes(near) + "?");
    } else {
      report_.note("no model " + name, place,
                   "no position model " + in_quotes(name) + " in the world; left out");
    }
  }

  /// Gives a device of a robot an address, as Stage does: the first one of the right type that has
  /// none of this interface yet.
  void bind(RobotDraft& robot, const Address& address) {
    if (is_everywhere(address.interface)) return note_port(robot, address);
    if (address.interface == "position2d") {
      note_port(robot, address);
      return take(robot, address, robot.robot["interfaces"]["position2d"][0].get<std::string>());
    }
    const auto row =
        std::find_if(interface_rows().begin(), interface_rows().end(),
                     [&](const InterfaceRow& r) { return r.interface == address.interface; });
    if (row == interface_rows().end()) {
      report_.note("interface " + address.interface, address.place,
                   "the interface " + in_quotes(address.interface) + " is left out");
      return;
    }
    for (const DraftDevice& device : robot.list) {
      const bool fits = std::find(row->stage_types.begin(), row->stage_types.end(),
                                  device.stage_type) != row->stage_types.end() &&
                        (row->device.empty() || row->device == device.type);
      if (!fits || !bound_.emplace(&robot, device.name).second) continue;
      note_port(robot, address);
      return take(robot, address, device.name);
    }
    const std::string expected = "a model on " + robot.stage_name + " that offers \"" +
                                 address.interface + "\", not used by another address";
    if (must_match_) {
      report_.error(address.place, "stage/no-model", expected, "none");
    } else {
      report_.note("no device " + address.interface, address.place,
                   "no " + expected.substr(2) + ": left out");
    }
  }

  void note_port(const RobotDraft& robot, const Address& address) {
    const auto [known, is_new] = ports_.emplace(&robot, address.port);
    if (is_new || known->second == address.port) return;
    report_.note("ports", address.place,
                 "a robot has one port: all devices of " + robot.stage_name + " are on " +
                     std::to_string(known->second));
  }

  void take(RobotDraft& robot, const Address& address, const std::string& device) {
    taken_[&robot][address.interface][address.index] = device;
  }

  /// Writes the indexes of interfaces.
  void set_addresses() {
    for (auto& [robot, interfaces] : taken_) {
      for (auto& [interface, devices] : interfaces) {
        Json names = Json::array();
        for (const auto& [index, device] : devices) names.push_back(device);
        first_[robot][interface] = devices.begin()->first;
        // The robot's other devices follow.
        Json& list = robot->robot["interfaces"][interface];
        for (const auto& name : list.is_array() ? list : Json::array()) {
          if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
        list = std::move(names);
      }
    }
  }

  /// The robot whose device has that address.
  RobotDraft* owner_of(const Address& wanted) {
    for (auto& [robot, interfaces] : taken_) {
      if (ports_.at(robot) != wanted.port) continue;
      const auto found = interfaces.find(wanted.interface);
      if (found != interfaces.end() && found->second.contains(wanted.index)) return robot;
    }
    return nullptr;
  }

  /// Drivers of Player that turn one interface into another, and drivers that drive.
  void other_driver(const Properties& driver, const std::string& name) {
    const std::vector<Address> provided = addresses(driver, "provides");
    const std::vector<Address> required = addresses(driver, "requires");
    RobotDraft* robot = nullptr;
    for (const Address& address : required) {
      if (robot == nullptr) robot = owner_of(address);
    }
    if (name == "rangertolaser" || name == "lasertoranger") {
      if (robot != nullptr) return convert(*robot, provided, required);
      report_.note("driver " + name, driver.entity().place,
                   "the driver " + in_quotes(name) + " has no device; left out");
      return;
    }
    if (name == "mapfile") return;  // every robot has the map of the world
    if (name == "snd" && robot != nullptr) return add_snd(driver, *robot, provided, required);
    report_.note("driver " + name, driver.entity().place,
                 "the driver " + in_quotes(name) + " is left out");
  }

  void convert(RobotDraft& robot, const std::vector<Address>& provided,
               const std::vector<Address>& required) {
    for (const Address& from : required) {
      const auto device = taken_[&robot][from.interface].find(from.index);
      if (device == taken_[&robot][from.interface].end()) continue;
      for (const Address& to : provided) {
        Json& list = robot.robot["interfaces"][to.interface];
        if (!list.is_array()) list = Json::array();
        if (std::find(list.begin(), list.end(), device->second) == list.end()) {
          list.push_back(device->second);
        }
        first_[&robot].emplace(to.interface, to.index);
        take(robot, to, device->second);
      }
    }
  }

  static int index_of(const std::vector<Address>& addresses, std::string_view interface,
                      int fallback) {
    for (const Address& address : addresses) {
      if (address.interface == interface) return address.index;
    }
    return fallback;
  }

  void add_snd(const Properties& driver, RobotDraft& robot, const std::vector<Address>& provided,
               const std::vector<Address>& required) {
    Json snd = {{"type", "snd"}};
    snd["index"] = index_of(provided, "position2d", 1);
    snd["position"] = index_of(required, "position2d", 0);
    snd["laser"] = index_of(required, "laser", 0);
    constexpr std::pair<const char*, const char*> kSettings[] = {
        {"robot_radius", "robot_radius"},
        {"obstacle_avoid_dist", "safety_distance"},
        {"max_speed", "max_speed"},
        {"goal_position_tol", "goal_distance"}};
    for (const auto& [theirs, ours] : kSettings) {
      if (driver.has(theirs)) snd[ours] = neat(driver.number(theirs, 0.0));
    }
    constexpr std::pair<const char*, const char*> kAngles[] = {
        {"max_turn_rate", "max_turn_rate_deg"}, {"goal_angle_tol", "goal_angle_deg"}};
    for (const auto& [theirs, ours] : kAngles) {
      if (driver.has(theirs)) snd[ours] = neat_deg(driver.angle_rad(theirs, 0.0));
    }
    free_position(robot, snd["index"].get<std::size_t>());
    robot.robot["drivers"].push_back(std::move(snd));
  }

  /// Frees an index of position2d for a driver: a robot of Stage has only one position.
  static void free_position(RobotDraft& robot, std::size_t index) {
    Json& list = robot.robot["interfaces"]["position2d"];
    while (index > 0 && list.size() > index) {
      robot.devices.erase(list.back().get<std::string>());
      list.erase(list.size() - 1);
    }
  }

  /// One port for each robot, or one for all of them.
  void set_ports() {
    std::map<int, std::vector<RobotDraft*>> robots_of;
    for (RobotDraft& robot : translation_.robots) {
      if (const auto port = ports_.find(&robot); port != ports_.end()) {
        robots_of[port->second].push_back(&robot);
      }
    }
    int shared = 0;
    for (const auto& [port, robots] : robots_of) {
      const bool renumbered = std::any_of(robots.begin(), robots.end(), [&](RobotDraft* robot) {
        return std::any_of(first_[robot].begin(), first_[robot].end(),
                           [](const auto& entry) { return entry.second != 0; });
      });
      if (robots.size() == 1 && !renumbered) {
        robots.front()->robot["port"] = port;
        continue;
      }
      if (shared != 0) {
        report_.error(robots.front()->place, "stage/ports",
                      "one port that several robots share, or indexes from 0",
                      std::to_string(shared) + " and " + std::to_string(port));
        continue;
      }
      shared = port;
      translation_.world["robots_on_port"] = port;
      for (RobotDraft* robot : robots) {
        for (const auto& [interface, index] : first_[robot]) {
          robot->robot["proxies"][interface] = index;
        }
      }
    }
    if (shared == 0) return;
    // Robots without an address must not end on the shared port.
    int next = shared;
    for (RobotDraft& robot : translation_.robots) {
      if (ports_.contains(&robot)) continue;
      do {
        ++next;
      } while (robots_of.contains(next));
      robot.robot["port"] = next;
    }
  }

  bool must_match_;
  Translation& translation_;
  Report& report_;
  Units units_;
  std::vector<std::pair<const Entity*, std::string>> others_;
  std::set<std::pair<const RobotDraft*, std::string>> bound_;
  std::map<const RobotDraft*, int> ports_;
  std::map<RobotDraft*, std::map<std::string, std::map<int, std::string>>> taken_;
  std::map<RobotDraft*, std::map<std::string, int>> first_;
};

}  // namespace

void apply_player_file(const Entity& config, bool must_match, Translation& translation,
                       Report& report) {
  PlayerFile(must_match, translation, report).run(config);
}

}  // namespace sim::io::stage
