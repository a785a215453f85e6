// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drivers of a configuration file of Player that are not Stage's.
#include <algorithm>
#include <utility>

#include "io/document.h"
#include "io/stage/player_drivers.h"
#include "io/stage/player_file.h"

namespace sim::io::stage {

RobotDraft* PlayerFile::owner_of(const Address& wanted) {
  for (auto& [robot, interfaces] : taken_) {
    if (ports_.at(robot) != wanted.port) continue;
    const auto found = interfaces.find(wanted.interface);
    if (found != interfaces.end() && found->second.contains(wanted.index)) return robot;
  }
  const auto driver = provided_.find(key_of(wanted));
  return driver == provided_.end() ? nullptr : driver->second.robot;
}

std::string PlayerFile::driver_of(const Address& wanted) const {
  const auto driver = provided_.find(key_of(wanted));
  return driver == provided_.end() ? "" : driver->second.name;
}

bool PlayerFile::left_out(const OtherDriver& driver, const std::string& why) {
  leave_out(driver, why);
  return false;
}

void PlayerFile::leave_out(const OtherDriver& driver, const std::string& why) {
  report_.note(
      "driver " + driver.name + why, driver.entity->place,
      "the driver " + in_quotes(driver.name) + " is left out" + (why.empty() ? "" : ": ") + why);
}

bool PlayerFile::is_provided(const Address& address) {
  return owner_of(address) != nullptr || of_world_.contains(key_of(address)) ||
         (is_everywhere(address.interface) && address.index == 0);
}

std::string PlayerFile::unprovided(const Address& address) {
  return "nothing provides " + in_quotes(address.text);
}

void PlayerFile::add_drivers() {
  for (bool complete = true;;) {
    const std::size_t before = others_.size();
    std::erase_if(others_, [&](const OtherDriver& driver) {
      const bool has_all =
          std::all_of(driver.required.begin(), driver.required.end(),
                      [&](const Address& address) { return is_provided(address); });
      return (has_all || !complete) && add_driver(driver);
    });
    if (others_.size() == before && !complete) break;
    complete = others_.size() < before;
  }
  for (const OtherDriver& driver : others_) {
    const auto missing =
        std::find_if(driver.required.begin(), driver.required.end(),
                     [&](const Address& address) { return !is_provided(address); });
    leave_out(driver, missing == driver.required.end() ? "" : unprovided(*missing));
  }
}

bool PlayerFile::add_driver(const OtherDriver& driver) {
  const std::string& name = driver.name;
  RobotDraft* robot = nullptr;
  for (const Address& address : driver.required) {
    if (robot == nullptr) robot = owner_of(address);
  }
  // A robot has the world's map and blackboard.
  const bool of_world = name == "mapfile" || name == "mapscale" || name == "localbb";
  if (of_world || (name == "passthrough" && robot == nullptr && !driver.required.empty() &&
                   is_everywhere(driver.required.front().interface))) {
    for (const Address& address : driver.provided) {
      of_world_.insert(key_of(address));
      everywhere_.emplace_back(nullptr, address);
    }
    tell_rest(*driver.entity, {"name", "plugin", "provides", "requires", "alwayson", "filename",
                               "resolution", "negate"});
    return true;
  }
  if (robot == nullptr) return false;
  if (!add_to(*robot, driver)) return true;
  kept_.emplace_back(driver, robot);
  const int index =
      is_goal_driver(name) ? robot->robot["drivers"].back().at("index").get<int>() : -1;
  for (const Address& address : driver.provided) {
    provided_[key_of(address)] = {robot, name, index};
    note_port(*robot, address);
  }
  for (const Address& address : driver.required) {
    if (is_provided(address)) continue;
    report_.note("address " + address.text, address.place,
                 unprovided(address) + "; the driver " + in_quotes(name) + " does without it");
  }
  return true;
}

bool PlayerFile::add_to(RobotDraft& robot, const OtherDriver& driver) {
  const std::string& name = driver.name;
  if (is_converter(name)) return convert(robot, driver);
  if (name == "amcl") return add_amcl(driver, robot);
  if (name == "wavefront") return add_wavefront(driver, robot);
  if (is_goal_driver(name)) return add_goal_driver(driver, robot);
  if (is_scan_driver(name)) return add_scan_driver(driver, robot);
  return left_out(driver, "");
}

bool PlayerFile::convert(RobotDraft& robot, const OtherDriver& driver) {
  std::set<std::string> done;  // addresses
  for (const Address& from : driver.required) {
    const auto found = taken_[&robot][from.interface].find(from.index);
    if (found == taken_[&robot][from.interface].end()) continue;
    const std::string device = found->second;
    const auto entry = std::find_if(robot.list.begin(), robot.list.end(),
                                    [&](const DraftDevice& one) { return one.name == device; });
    for (const Address& to : driver.provided) {
      const InterfaceRow* const row = row_of(to.interface);
      const bool same = to.interface == from.interface;
      if (!same && (row == nullptr || entry == robot.list.end() || !fits(*row, *entry))) continue;
      take(robot, to, device);
      done.insert(to.text);
    }
  }
  if (done.empty()) return left_out(driver, "it can use only devices of the robot");
  set_addresses();
  for (const Address& to : driver.provided) {
    if (!done.contains(to.text)) note_provided(driver, to);
  }
  tell_rest(*driver.entity, {"name", "plugin", "provides", "requires", "alwayson"});
  return true;
}

int PlayerFile::index_of(const std::vector<Address>& addresses, std::string_view interface,
                         std::string_view key, int fallback) {
  const Address* best = nullptr;
  for (const Address& address : addresses) {
    if (address.interface != interface) continue;
    if (best == nullptr || (address.key == key && best->key != key)) best = &address;
  }
  return best == nullptr ? fallback : best->index;
}

int PlayerFile::local_index(RobotDraft& robot, const std::string& interface, int index) {
  const auto first = first_[&robot].find(interface);
  return first == first_[&robot].end() ? index : std::max(0, index - first->second);
}

std::optional<std::string> PlayerFile::laser_of(RobotDraft& robot,
                                                const std::vector<Address>& required) {
  const auto is_laser = [&](const std::string& name) {
    return std::any_of(robot.list.begin(), robot.list.end(), [&](const DraftDevice& device) {
      return device.name == name && device.type == "laser";
    });
  };
  for (const Address& address : required) {
    if (address.interface != "laser" && address.interface != "ranger") continue;
    const auto& devices = taken_[&robot][address.interface];
    const auto device = devices.find(address.index);
    if (device != devices.end() && is_laser(device->second)) return device->second;
  }
  for (const DraftDevice& device : robot.list) {
    if (device.type == "laser") return device.name;
  }
  return std::nullopt;
}

std::size_t PlayerFile::index_of_laser(RobotDraft& robot, const std::string& laser) {
  Json& list = robot.robot["interfaces"]["laser"];
  if (!list.is_array()) list = Json::array();
  const auto found = std::find(list.begin(), list.end(), Json(laser));
  const auto index = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(laser);
  return index;
}

Json PlayerFile::settings_of(const OtherDriver& driver) {
  tell_sections(*driver.entity);
  return driver_settings(driver.name, Properties(*driver.entity, units_, report_), units_, report_);
}

std::optional<int> PlayerFile::own_position(RobotDraft& robot, const OtherDriver& driver,
                                            std::string_view key) {
  const Address* best = nullptr;
  const Address* other = nullptr;  // of another driver
  bool requires_one = false;
  for (const Address& address : driver.required) {
    if (address.interface != "position2d") continue;
    requires_one = true;
    if (!driver_of(address).empty()) {
      if (other == nullptr || address.key == key) other = &address;
    } else if (owner_of(address) == &robot &&
               (best == nullptr || (address.key == key && best->key != key))) {
      best = &address;
    }
  }
  const int index = best == nullptr ? 0 : local_index(robot, "position2d", best->index);
  if (best != nullptr && (other == nullptr || other->key != key || best->key == key)) {
    return index;
  }
  if (other == nullptr) return requires_one ? std::nullopt : std::optional(0);
  report_.note("position of " + driver.name, other->place,
               "the driver " + in_quotes(driver.name) + " uses the robot's position, not " +
                   in_quotes(other->text) + " of the driver " + in_quotes(driver_of(*other)));
  return index;
}

bool PlayerFile::leave_out_without_position(const OtherDriver& driver) {
  for (const Address& address : driver.required) {
    if (address.interface == "position2d") return left_out(driver, unprovided(address));
  }
  return left_out(driver, "");
}

int PlayerFile::next_index(RobotDraft& robot, std::string_view interface, int least) {
  std::set<int>& taken = driver_indexes_[{&robot, std::string(interface)}];
  while (!taken.insert(least).second) ++least;
  return least;
}

int PlayerFile::free_index(RobotDraft& robot, const OtherDriver& driver, std::string_view interface,
                           int fallback, int own) {
  int index = fallback;
  Place place = driver.entity->place;
  std::string text;
  for (const Address& address : driver.provided) {
    if (address.interface != interface) {
      note_provided(driver, address);
    } else if (text.empty()) {
      index = local_index(robot, address.interface, address.index);
      place = address.place;
      text = address.text;
    } else {
      note_provided(driver, address);
    }
  }
  const int free = next_index(robot, interface, std::max(index, own));
  if (free != index && !text.empty()) {
    report_.note("address " + text, place,
                 "the address " + in_quotes(text) + " of the driver " + in_quotes(driver.name) +
                     " is taken: it is " +
                     in_quotes(std::string(interface) + ":" + std::to_string(free)) + " here");
  }
  return free;
}

void PlayerFile::note_provided(const OtherDriver& driver, const Address& address) {
  report_.note("address " + address.text, address.place,
               "the address " + in_quotes(address.text) + " of the driver " +
                   in_quotes(driver.name) + " is left out");
}

bool PlayerFile::add_goal_driver(const OtherDriver& driver, RobotDraft& robot) {
  const std::optional<int> position = own_position(robot, driver, "input");
  if (!position) return leave_out_without_position(driver);
  std::optional<std::string> laser;
  if (driver.name != "goto") {
    laser = laser_of(robot, driver.required);
    if (!laser) return left_out(driver, "the robot has no laser");
  }
  Json settings = settings_of(driver);
  if (laser) settings["laser"] = index_of_laser(robot, *laser);
  settings["index"] = free_index(robot, driver, "position2d", 1, 1);
  settings["position"] = *position;
  free_position(robot, settings["index"].get<std::size_t>());
  robot.robot["drivers"].push_back(std::move(settings));
  return true;
}

bool PlayerFile::add_scan_driver(const OtherDriver& driver, RobotDraft& robot) {
  const bool needs_scan_driver =
      std::any_of(driver.required.begin(), driver.required.end(), [&](const Address& address) {
        return address.interface == "laser" && is_scan_driver(driver_of(address));
      });
  if (needs_scan_driver) return left_out(driver, "it can use only lasers that measure");
  const std::optional<std::string> laser = laser_of(robot, driver.required);
  if (!laser) return left_out(driver, "the robot has no laser");
  std::optional<int> position;
  if (driver.name == "laserposeinterpolator") {
    position = own_position(robot, driver, "");
    if (!position) return leave_out_without_position(driver);
  }
  Json settings = settings_of(driver);
  settings["laser"] = index_of_laser(robot, *laser);
  if (position) settings["position"] = *position;
  // Below this number are the indexes of the robot's own lasers.
  const auto lasers =
      std::count_if(robot.list.begin(), robot.list.end(),
                    [](const DraftDevice& device) { return device.type == "laser"; });
  settings["index"] = free_index(robot, driver, "laser", 1, static_cast<int>(lasers));
  robot.robot["drivers"].push_back(std::move(settings));
  return true;
}

bool PlayerFile::add_amcl(const OtherDriver& driver, RobotDraft& robot) {
  const std::optional<std::string> laser = laser_of(robot, driver.required);
  if (!laser) return left_out(driver, "the robot has no laser");
  for (const Address& address : driver.required) {
    if (address.interface == "laser" || address.interface == "ranger" ||
        address.interface == "position2d" || address.interface == "map") {
      continue;
    }
    report_.note("sensors of amcl", address.place,
                 "amcl measures by the robot's laser only; " + in_quotes(address.interface) +
                     " is left out");
  }
  Json settings = settings_of(driver);
  settings["laser"] = *laser;
  const auto& positions = taken_[&robot]["position2d"];
  const auto position = positions.find(index_of(driver.required, "position2d", "odometry", 0));
  settings["odometry"] = position != positions.end() ? Json(position->second)
                                                     : robot.robot["interfaces"]["position2d"][0];
  free_index(robot, driver, "localize", 0, 0);
  robot.robot["drivers"].push_back(std::move(settings));
  return true;
}

bool PlayerFile::add_wavefront(const OtherDriver& driver, RobotDraft& robot) {
  const Address* output = nullptr;
  for (const Address& address : driver.required) {
    if (address.interface == "position2d" && address.key == "output") output = &address;
  }
  const std::optional<int> own = own_output(robot, output);
  if (!own && (output == nullptr || !is_goal_driver(driver_of(*output)))) {
    return left_out(driver, "it needs a driver that drives to goals, such as vfh");
  }
  Json settings = settings_of(driver);
  for (const Address& address : driver.required) {
    if (address.interface != "position2d" && address.interface != "localize") continue;
    const int index = local_index(robot, address.interface, address.index);
    if (&address == output) {
      if (!own) settings["output"] = index_of_driver(robot, address);
    } else if (driver_of(address) == "amcl") {
      settings["localize"] = 0;
    } else if (address.interface == "position2d" &&
               taken_[&robot]["position2d"].contains(address.index)) {
      settings["position"] = index;  // not the position of another driver, as of vfh
    }
  }
  const int index = free_index(robot, driver, "planner", 0, 0);
  if (index != 0) settings["index"] = index;
  if (own) settings["output"] = add_straight_driver(driver, robot, *own);
  robot.robot["drivers"].push_back(std::move(settings));
  return true;
}

std::optional<int> PlayerFile::own_output(RobotDraft& robot, const Address* output) {
  if (output == nullptr || owner_of(*output) != &robot || !driver_of(*output).empty()) {
    return std::nullopt;
  }
  return local_index(robot, "position2d", output->index);
}

int PlayerFile::add_straight_driver(const OtherDriver& planner, RobotDraft& robot, int position) {
  const int index = next_index(robot, "position2d", 1);
  free_position(robot, static_cast<std::size_t>(index));
  robot.robot["drivers"].push_back({{"type", "goto"}, {"index", index}, {"position", position}});
  report_.note("output of " + planner.name, planner.entity->place,
               "the robot's position drives to goals in Stage; here a driver \"goto\" at "
               "position2d:" +
                   std::to_string(index) + " does it");
  return index;
}

int PlayerFile::index_of_driver(RobotDraft& robot, const Address& address) {
  const auto driver = provided_.find(key_of(address));
  return driver == provided_.end() || driver->second.index < 0
             ? local_index(robot, address.interface, address.index)
             : driver->second.index;
}

}  // namespace sim::io::stage
