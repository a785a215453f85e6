// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/player_file.h"

#include <algorithm>
#include <utility>

#include "io/document.h"

namespace sim::io::stage {

void PlayerFile::run(const Entity& config) {
  read_units(config);
  std::vector<const Entity*> stage_drivers;
  for (const Entity& driver : config.children) {
    if (driver.type != "driver") {
      report_.note("cfg " + driver.type, driver.place,
                   "the section " + in_quotes(driver.type) + " is left out");
      continue;
    }
    const Properties properties(driver, units_, report_);
    const std::string name = properties.text("name", "");
    if (name == "stage") {
      if (properties.has("model")) ++models_named_;
      stage_drivers.push_back(&driver);
    } else {
      others_.push_back(
          {&driver, name, addresses(properties, "provides"), addresses(properties, "requires")});
    }
  }
  for (const Entity* driver : stage_drivers) {
    stage_driver({*driver, units_, report_});
    tell_rest(*driver, {"name", "plugin", "provides", "model", "worldfile", "usegui"});
  }
  if (ports_.empty()) bind_all();
  set_addresses();
  add_drivers();
  set_ports();
  leave_out_on_shared_port();
  tell_moved();
  for (const auto& [robot, address] : everywhere_) tell_unserved(robot, address);
}

void PlayerFile::read_units(const Entity& config) {
  const Properties file(config, units_, report_);
  constexpr double kLengths[] = {1.0, 0.01, 0.001};
  units_.length_m = kLengths[file.choice("unit_length", 0, {"m", "cm", "mm"})];
  if (file.choice("unit_angle", 0, {"degrees", "radians"}) == 1) units_.angle_rad = 1.0;
  tell_rest(config, {"unit_length", "unit_angle"});
}

std::string PlayerFile::title_of(const Entity& entity) {
  const Property* name = entity.find("name");
  const bool has_name = name != nullptr && !name->values.empty();
  return entity.type + (has_name ? " " + in_quotes(name->values.front().text) : "");
}

void PlayerFile::tell_rest(const Entity& entity, std::initializer_list<std::string_view> known) {
  const std::string title = title_of(entity);
  for (const Property& property : entity.properties) {
    if (std::find(known.begin(), known.end(), property.name) != known.end()) continue;
    report_.note("cfg property " + title + property.name, property.place,
                 "the property " + in_quotes(property.name) +
                     (title.empty() ? "" : " of the " + title) + " is left out");
  }
  if (!entity.type.empty()) tell_sections(entity);
}

void PlayerFile::tell_sections(const Entity& driver) {
  const std::string title = title_of(driver);
  for (const Entity& section : driver.children) {
    report_.note("cfg section " + title + section.type, section.place,
                 "the section " + in_quotes(section.type) + " of the " + title + " is left out");
  }
}

std::vector<Address> PlayerFile::addresses(const Properties& driver, const char* key) {
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

RobotDraft* PlayerFile::find_robot(const std::string& name) {
  for (RobotDraft& robot : translation_.robots) {
    if (robot.stage_name == name) return &robot;
  }
  return nullptr;
}

void PlayerFile::stage_driver(const Properties& driver) {
  const std::vector<Address> provided = addresses(driver, "provides");
  const bool only_world = std::all_of(provided.begin(), provided.end(), [](const Address& address) {
    return is_everywhere(address.interface);
  });
  if (!driver.has("model")) return without_model(driver, provided);
  const std::string name = driver.text("model", "");
  RobotDraft* robot = find_robot(name);
  if (robot == nullptr && !only_world) robot = missing_robot(driver.place_of("model"), name);
  if (robot == nullptr) return;
  // A model that offers some of the interfaces is meant.
  std::vector<const Address*> unbound;
  for (const Address& address : provided) {
    if (!bind(*robot, address)) unbound.push_back(&address);
  }
  for (const Address* address : unbound) {
    missing_device(*robot, *address, must_match_ && unbound.size() == provided.size());
  }
}

void PlayerFile::without_model(const Properties& driver, const std::vector<Address>& provided) {
  for (const Address& address : provided) {
    if (is_everywhere(address.interface)) {
      everywhere_.emplace_back(nullptr, address);
      continue;
    }
    if (must_match_ && is_offered(address.interface)) {
      report_.error(driver.entity().place, "stage/no-model",
                    "\"model\", the name of a model of the world", "a driver without it");
    } else {
      note_interface(address);
    }
  }
}

void PlayerFile::bind_all() {
  int port = kDefaultPort;
  for (RobotDraft& robot : translation_.robots) {
    ports_.emplace(&robot, port++);
    const auto give = [&](const std::string& interface, const std::string& device) {
      auto& devices = taken_[&robot][interface];
      devices.emplace(static_cast<int>(devices.size()), device);
    };
    give("position2d", robot.robot["interfaces"]["position2d"][0].get<std::string>());
    for (const DraftDevice& device : robot.list) {
      if (device.type != "laser" && device.type != "sonar") continue;
      give("ranger", device.name);
      give(device.type, device.name);
    }
  }
}

RobotDraft* PlayerFile::missing_robot(const Place& place, const std::string& name) {
  std::vector<std::string> known;
  for (const RobotDraft& robot : translation_.robots) known.push_back(robot.stage_name);
  const std::string near = nearest_word(name, known);
  if (!must_match_) {
    report_.note("no model " + name, place,
                 "no position model " + in_quotes(name) + " in the world; left out");
    return nullptr;
  }
  if (near.empty() && models_named_ == 1 && !known.empty()) {
    report_.note("no model " + name, place,
                 "no position model " + in_quotes(name) + " in the world; the first one, " +
                     in_quotes(known.front()) + ", takes its place");
    return &translation_.robots.front();
  }
  report_.error(place, "stage/no-model",
                known.empty() ? "no name: the world has no position model"
                              : "a position model of the world: " + list_text(known),
                in_quotes(name), near.empty() ? "" : "did you mean " + in_quotes(near) + "?");
  return nullptr;
}

bool PlayerFile::bind(RobotDraft& robot, const Address& address) {
  if (is_everywhere(address.interface)) {
    note_port(robot, address);
    everywhere_.emplace_back(&robot, address);
    return true;
  }
  if (const RobotDraft* owner = owner_of(address); owner != nullptr && owner != &robot) {
    taken_twice(address, owner->stage_name);
    return true;
  }
  if (address.interface == "position2d") {
    if (!bound_.emplace(&robot, "position2d").second) return false;
    note_port(robot, address);
    take(robot, address, robot.robot["interfaces"]["position2d"][0].get<std::string>());
    return true;
  }
  const InterfaceRow* const row = row_of(address.interface);
  if (row == nullptr) {
    note_interface(address);
    return true;
  }
  for (const DraftDevice& device : robot.list) {
    if (!fits(*row, device) || !bound_.emplace(&robot, device.name).second) continue;
    note_port(robot, address);
    take(robot, address, device.name);
    return true;
  }
  return false;
}

void PlayerFile::taken_twice(const Address& address, const std::string& owner) {
  if (must_match_) {
    report_.error(address.place, "stage/bad-address", "an address that no other driver has",
                  in_quotes(address.text) + ", which " + owner + " has",
                  "robots that share a port have different indexes, as in \"position2d:1\"");
    return;
  }
  report_.note("address " + address.text, address.place,
               "the address " + in_quotes(address.text) + " is left out: " + owner + " has it");
}

void PlayerFile::tell_unserved(const RobotDraft* robot, const Address& address) {
  if (address.interface == "graphics3d") return note_interface(address);
  int served = 0;
  const bool of_robot = address.interface == "speech" || address.interface == "graphics2d";
  if (robot != nullptr && of_robot && translation_.world.contains("robots_on_port")) {
    // Robots that share a port have consecutive indexes.
    const int port = translation_.world["robots_on_port"].get<int>();
    for (const RobotDraft& other : translation_.robots) {
      if (&other == robot) break;
      const auto known = ports_.find(&other);
      if (known != ports_.end() && known->second == port) ++served;
    }
    if (ports_.at(robot) != port) served = 0;
  }
  if (address.index == served) return;
  report_.note("address " + address.text, address.place,
               "the address " + in_quotes(address.text) + " is left out: it is " +
                   in_quotes(address.interface + ":" + std::to_string(served)) + " here");
}

void PlayerFile::note_interface(const Address& address) {
  report_.note("interface " + address.interface, address.place,
               "the interface " + in_quotes(address.interface) + " is left out");
}

void PlayerFile::missing_device(const RobotDraft& robot, const Address& address, bool is_error) {
  const std::string expected = "a model on " + robot.stage_name + " that offers \"" +
                               address.interface + "\", not used by another address";
  if (is_error) {
    report_.error(address.place, "stage/no-model", expected, "none");
  } else {
    report_.note("no device " + address.interface, address.place,
                 "no " + expected.substr(2) + ": left out");
  }
}

void PlayerFile::note_port(const RobotDraft& robot, const Address& address) {
  const auto [known, is_new] = ports_.emplace(&robot, address.port);
  if (is_new || known->second == address.port) return;
  report_.note("ports", address.place,
               "a robot has one port: all devices of " + robot.stage_name + " are on " +
                   std::to_string(known->second));
}

void PlayerFile::take(RobotDraft& robot, const Address& address, const std::string& device) {
  taken_[&robot][address.interface][address.index] = device;
  addresses_.emplace(std::tuple(&robot, address.interface, address.index), address);
}

void PlayerFile::set_addresses() {
  for (auto& [robot, interfaces] : taken_) {
    for (auto& [interface, devices] : interfaces) {
      if (devices.empty()) continue;
      Json names = Json::array();
      const auto add = [&](const Json& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      };
      for (const auto& [index, device] : devices) add(device);
      first_[robot][interface] = devices.begin()->first;
      // The robot's other devices follow.
      Json& list = robot->robot["interfaces"][interface];
      for (const auto& name : list.is_array() ? list : Json::array()) add(name);
      list = std::move(names);
    }
  }
}

void PlayerFile::tell_moved() {
  for (const auto& [key, address] : addresses_) {
    const auto& [robot, interface, index] = key;
    const Json& list = robot->robot["interfaces"][interface];
    const auto place = std::find(list.begin(), list.end(), taken_[robot][interface][index]);
    if (place == list.end()) continue;
    const int here = first_[robot][interface] + static_cast<int>(place - list.begin());
    if (here == index) continue;
    report_.note("address " + address.text, address.place,
                 "the address " + in_quotes(address.text) + " is left out: it is " +
                     in_quotes(interface + ":" + std::to_string(here)) + " here");
  }
}

void PlayerFile::leave_out_on_shared_port() {
  for (const auto& [driver, robot] : kept_) {
    if (!robot->robot.contains("drivers")) continue;
    if (!translation_.world.contains("robots_on_port") ||
        translation_.world["robots_on_port"] != ports_.at(robot)) {
      continue;
    }
    robot->robot.erase("drivers");
    for (const auto& [other, its_robot] : kept_) {
      if (its_robot == robot && !is_converter(other.name)) {
        leave_out(other,
                  "a port that several robots share, or whose indexes do not begin at 0, "
                  "has no drivers");
      }
    }
  }
}

void PlayerFile::free_position(RobotDraft& robot, std::size_t index) {
  Json& list = robot.robot["interfaces"]["position2d"];
  while (index > 0 && list.size() > index) {
    robot.devices.erase(list.back().get<std::string>());
    list.erase(list.size() - 1);
  }
}

void PlayerFile::share_port(RobotDraft& robot) {
  std::set<std::string> named;
  for (const auto& [interface, devices] : taken_[&robot]) {
    for (const auto& [index, device] : devices) named.insert(device);
  }
  const auto drop = [&](const std::string& device) {
    if (named.contains(device)) return;
    robot.devices.erase(device);
    std::erase_if(robot.list, [&](const DraftDevice& one) { return one.name == device; });
    for (auto& [interface, list] : robot.robot["interfaces"].items()) {
      Json kept = Json::array();
      for (const Json& name : list) {
        if (name != device) kept.push_back(name);
      }
      list = std::move(kept);
    }
  };
  for (const auto& [interface, index] : first_[&robot]) {
    robot.robot["proxies"][interface] = index;
    std::vector<std::string> offered;
    if (interface == "position2d") offered = {"pose", "odometry"};
    const InterfaceRow* const row = row_of(interface);
    for (const DraftDevice& device : robot.list) {
      if (row != nullptr && fits(*row, device)) offered.push_back(device.name);
    }
    for (const std::string& device : offered) drop(device);
  }
}

void PlayerFile::set_ports() {
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
    for (RobotDraft* robot : robots) share_port(*robot);
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

void apply_player_file(const Entity& config, bool must_match, Translation& translation,
                       Report& report) {
  PlayerFile(must_match, translation, report).run(config);
}

}  // namespace sim::io::stage
