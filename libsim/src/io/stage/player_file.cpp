// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "io/document.h"
#include "io/stage/player_drivers.h"
#include "io/stage/translation.h"

namespace sim::io::stage {
namespace {

constexpr int kDefaultPort = 6665;

/// An address as Player writes it: key:host:robot:interface:index, the first three of which may be
/// missing or empty.
struct Address {
  std::string key;  ///< what a driver uses it for, for example "input"
  int port = kDefaultPort;
  std::string interface;
  int index = 0;
  Place place;
  std::string text;  ///< as written
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
  address.text = value.text;
  const std::optional<int> index = whole_number(parts.back(), 1000);
  address.interface = std::string(parts[parts.size() - 2]);
  if (address.interface == "position") address.interface = "position2d";  // as in Player 1
  if (parts.size() >= 4) address.key = std::string(parts.front());
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

/// The row of an interface; nullptr if models do not offer it.
const InterfaceRow* row_of(std::string_view interface) {
  for (const InterfaceRow& row : interface_rows()) {
    if (row.interface == interface) return &row;
  }
  return nullptr;
}

/// Whether a device may have an address of an interface.
bool fits(const InterfaceRow& row, const DraftDevice& device) {
  return std::find(row.stage_types.begin(), row.stage_types.end(), device.stage_type) !=
             row.stage_types.end() &&
         (row.device.empty() || row.device == device.type);
}

bool is_offered(std::string_view interface) {
  return interface == "position2d" || row_of(interface) != nullptr;
}

/// Interfaces that every robot or world has. graphics3d is none here, but a note says so.
bool is_everywhere(std::string_view interface) {
  constexpr std::string_view kNames[] = {"simulation", "speech", "graphics2d", "graphics3d", "map"};
  return std::find(std::begin(kNames), std::end(kNames), interface) != std::end(kNames);
}

/// Whether a driver of Player turns an interface into another one.
bool is_converter(std::string_view name) {
  return name == "rangertolaser" || name == "lasertoranger" || name == "passthrough";
}

using AddressKey = std::tuple<int, std::string, int>;
AddressKey key_of(const Address& address) {
  return {address.port, address.interface, address.index};
}

/// A driver that is not Stage's.
struct OtherDriver {
  const Entity* entity;
  std::string name;
  std::vector<Address> provided;
  std::vector<Address> required;
};

class PlayerFile {
 public:
  PlayerFile(bool must_match, Translation& translation, Report& report)
      : must_match_(must_match), translation_(translation), report_(report) {}

  void run(const Entity& config) {
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

 private:
  /// Reads the properties outside of all sections.
  void read_units(const Entity& config) {
    const Properties file(config, units_, report_);
    constexpr double kLengths[] = {1.0, 0.01, 0.001};
    units_.length_m = kLengths[file.choice("unit_length", 0, {"m", "cm", "mm"})];
    if (file.choice("unit_angle", 0, {"degrees", "radians"}) == 1) units_.angle_rad = 1.0;
    tell_rest(config, {"unit_length", "unit_angle"});
  }

  /// A driver in words, for messages; "" for the file itself.
  static std::string title_of(const Entity& entity) {
    const Property* name = entity.find("name");
    const bool has_name = name != nullptr && !name->values.empty();
    return entity.type + (has_name ? " " + in_quotes(name->values.front().text) : "");
  }

  /// Reports properties without an effect, and the sections in a driver.
  void tell_rest(const Entity& entity, std::initializer_list<std::string_view> known) {
    const std::string title = title_of(entity);
    for (const Property& property : entity.properties) {
      if (std::find(known.begin(), known.end(), property.name) != known.end()) continue;
      report_.note("cfg property " + title + property.name, property.place,
                   "the property " + in_quotes(property.name) +
                       (title.empty() ? "" : " of the " + title) + " is left out");
    }
    if (!entity.type.empty()) tell_sections(entity);
  }

  void tell_sections(const Entity& driver) {
    const std::string title = title_of(driver);
    for (const Entity& section : driver.children) {
      report_.note("cfg section " + title + section.type, section.place,
                   "the section " + in_quotes(section.type) + " of the " + title + " is left out");
    }
  }

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

  /// A driver that names no model offers the interfaces of the world.
  void without_model(const Properties& driver, const std::vector<Address>& provided) {
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

  /// Without any driver for models, as in the file of a second server: the robots have the default
  /// ports and the indexes of their devices.
  void bind_all() {
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

  /// Reports a model that the world lacks. @return the robot that takes its place, or nullptr.
  RobotDraft* missing_robot(const Place& place, const std::string& name) {
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

  /// Gives a device of a robot an address, as Stage does: the first one of the right type that has
  /// none of this interface yet.
  /// @return false if there is none.
  bool bind(RobotDraft& robot, const Address& address) {
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

  void taken_twice(const Address& address, const std::string& owner) {
    if (must_match_) {
      report_.error(address.place, "stage/bad-address", "an address that no other driver has",
                    in_quotes(address.text) + ", which " + owner + " has",
                    "robots that share a port have different indexes, as in \"position2d:1\"");
      return;
    }
    report_.note("address " + address.text, address.place,
                 "the address " + in_quotes(address.text) + " is left out: " + owner + " has it");
  }

  /// Notes an address of an interface that every robot or world has, if it has another index there.
  void tell_unserved(const RobotDraft* robot, const Address& address) {
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

  void note_interface(const Address& address) {
    report_.note("interface " + address.interface, address.place,
                 "the interface " + in_quotes(address.interface) + " is left out");
  }

  void missing_device(const RobotDraft& robot, const Address& address, bool is_error) {
    const std::string expected = "a model on " + robot.stage_name + " that offers \"" +
                                 address.interface + "\", not used by another address";
    if (is_error) {
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
    addresses_.emplace(std::tuple(&robot, address.interface, address.index), address);
  }

  /// Writes the indexes of interfaces.
  void set_addresses() {
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

  /// Notes addresses of devices that have another index here: indexes are consecutive, and each
  /// device has one.
  void tell_moved() {
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

  /// The robot whose device, or whose driver, has that address.
  RobotDraft* owner_of(const Address& wanted) {
    for (auto& [robot, interfaces] : taken_) {
      if (ports_.at(robot) != wanted.port) continue;
      const auto found = interfaces.find(wanted.interface);
      if (found != interfaces.end() && found->second.contains(wanted.index)) return robot;
    }
    const auto driver = provided_.find(key_of(wanted));
    return driver == provided_.end() ? nullptr : driver->second.robot;
  }

  /// The driver that provides an address; "" if none does.
  [[nodiscard]] std::string driver_of(const Address& wanted) const {
    const auto driver = provided_.find(key_of(wanted));
    return driver == provided_.end() ? "" : driver->second.name;
  }

  bool left_out(const OtherDriver& driver, const std::string& why) {
    leave_out(driver, why);
    return false;
  }

  void leave_out(const OtherDriver& driver, const std::string& why) {
    report_.note(
        "driver " + driver.name + why, driver.entity->place,
        "the driver " + in_quotes(driver.name) + " is left out" + (why.empty() ? "" : ": ") + why);
  }

  [[nodiscard]] bool is_provided(const Address& address) {
    return owner_of(address) != nullptr || of_world_.contains(key_of(address)) ||
           (is_everywhere(address.interface) && address.index == 0);
  }

  static std::string unprovided(const Address& address) {
    return "nothing provides " + in_quotes(address.text);
  }

  /// Adds the drivers that are not Stage's. A driver may need what a later one provides, so those
  /// come first that have all they need.
  void add_drivers() {
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

  /// Adds a driver of Player that turns one interface into another, drives or plans.
  /// @return whether it is done; otherwise no robot is known yet whose devices it needs.
  bool add_driver(const OtherDriver& driver) {
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

  /// Adds a driver to a robot. @return false if it is left out, which is noted.
  bool add_to(RobotDraft& robot, const OtherDriver& driver) {
    const std::string& name = driver.name;
    if (is_converter(name)) return convert(robot, driver);
    if (name == "amcl") return add_amcl(driver, robot);
    if (name == "wavefront") return add_wavefront(driver, robot);
    if (is_goal_driver(name)) return add_goal_driver(driver, robot);
    if (is_scan_driver(name)) return add_scan_driver(driver, robot);
    return left_out(driver, "");
  }

  bool convert(RobotDraft& robot, const OtherDriver& driver) {
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

  /// Index of the address of an interface, rather one with that key.
  static int index_of(const std::vector<Address>& addresses, std::string_view interface,
                      std::string_view key, int fallback) {
    const Address* best = nullptr;
    for (const Address& address : addresses) {
      if (address.interface != interface) continue;
      if (best == nullptr || (address.key == key && best->key != key)) best = &address;
    }
    return best == nullptr ? fallback : best->index;
  }

  /// An index as the robot itself counts it: robots that share a port continue those of others.
  int local_index(RobotDraft& robot, const std::string& interface, int index) {
    const auto first = first_[&robot].find(interface);
    return first == first_[&robot].end() ? index : std::max(0, index - first->second);
  }

  /// The robot's laser that a driver requires, or any of them.
  std::optional<std::string> laser_of(RobotDraft& robot, const std::vector<Address>& required) {
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

  /// Index of a laser among the robot's, which it gets if it has none yet.
  static std::size_t index_of_laser(RobotDraft& robot, const std::string& laser) {
    Json& list = robot.robot["interfaces"]["laser"];
    if (!list.is_array()) list = Json::array();
    const auto found = std::find(list.begin(), list.end(), Json(laser));
    const auto index = static_cast<std::size_t>(found - list.begin());
    if (found == list.end()) list.push_back(laser);
    return index;
  }

  [[nodiscard]] Json settings_of(const OtherDriver& driver) {
    tell_sections(*driver.entity);
    return driver_settings(driver.name, Properties(*driver.entity, units_, report_), units_,
                           report_);
  }

  /// Index of the robot's own `position2d` that a driver requires, rather of one with that key: 0
  /// if the driver requires none or that of another driver.
  /// @return nullopt if nothing provides what it requires.
  std::optional<int> own_position(RobotDraft& robot, const OtherDriver& driver,
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

  bool leave_out_without_position(const OtherDriver& driver) {
    for (const Address& address : driver.required) {
      if (address.interface == "position2d") return left_out(driver, unprovided(address));
    }
    return left_out(driver, "");
  }

  /// The first index from `least` on that no driver has. @return it, which is taken then.
  int next_index(RobotDraft& robot, std::string_view interface, int least) {
    std::set<int>& taken = driver_indexes_[{&robot, std::string(interface)}];
    while (!taken.insert(least).second) ++least;
    return least;
  }

  /// The index of a driver among those of a robot's interface: the one in the file, or if that is
  /// taken the next one that is free, with a note.
  int free_index(RobotDraft& robot, const OtherDriver& driver, std::string_view interface,
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

  void note_provided(const OtherDriver& driver, const Address& address) {
    report_.note("address " + address.text, address.place,
                 "the address " + in_quotes(address.text) + " of the driver " +
                     in_quotes(driver.name) + " is left out");
  }

  bool add_goal_driver(const OtherDriver& driver, RobotDraft& robot) {
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

  bool add_scan_driver(const OtherDriver& driver, RobotDraft& robot) {
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

  bool add_amcl(const OtherDriver& driver, RobotDraft& robot) {
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

  bool add_wavefront(const OtherDriver& driver, RobotDraft& robot) {
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

  /// The robot's own position if that is the output of a planner: Stage's positions drive to goals.
  std::optional<int> own_output(RobotDraft& robot, const Address* output) {
    if (output == nullptr || owner_of(*output) != &robot || !driver_of(*output).empty()) {
      return std::nullopt;
    }
    return local_index(robot, "position2d", output->index);
  }

  /// Adds a driver that drives straight to goals. @return its index.
  int add_straight_driver(const OtherDriver& planner, RobotDraft& robot, int position) {
    const int index = next_index(robot, "position2d", 1);
    free_position(robot, static_cast<std::size_t>(index));
    robot.robot["drivers"].push_back({{"type", "goto"}, {"index", index}, {"position", position}});
    report_.note("output of " + planner.name, planner.entity->place,
                 "the robot's position drives to goals in Stage; here a driver \"goto\" at "
                 "position2d:" +
                     std::to_string(index) + " does it");
    return index;
  }

  /// Index that a driver has here, by the address that it has in the file.
  int index_of_driver(RobotDraft& robot, const Address& address) {
    const auto driver = provided_.find(key_of(address));
    return driver == provided_.end() || driver->second.index < 0
               ? local_index(robot, address.interface, address.index)
               : driver->second.index;
  }

  /// Leaves out the drivers of robots that share a port, which offers devices only.
  void leave_out_on_shared_port() {
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

  /// Frees an index of position2d for a driver: a robot of Stage has only one position.
  static void free_position(RobotDraft& robot, std::size_t index) {
    Json& list = robot.robot["interfaces"]["position2d"];
    while (index > 0 && list.size() > index) {
      robot.devices.erase(list.back().get<std::string>());
      list.erase(list.size() - 1);
    }
  }

  /// Gives a robot that shares its port its indexes. Devices that the file does not name would have
  /// the indexes of other robots' devices, so they are left out.
  void share_port(RobotDraft& robot) {
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

  bool must_match_;
  Translation& translation_;
  Report& report_;
  Units units_;
  std::vector<OtherDriver> others_;
  int models_named_ = 0;  ///< drivers of Stage with a model
  std::map<std::tuple<RobotDraft*, std::string, int>, Address> addresses_;  ///< of taken_
  std::set<std::pair<const RobotDraft*, std::string>> bound_;
  std::map<const RobotDraft*, int> ports_;
  std::map<RobotDraft*, std::map<std::string, std::map<int, std::string>>> taken_;
  std::map<RobotDraft*, std::map<std::string, int>> first_;
  struct Provider {
    RobotDraft* robot;
    std::string name;
    int index = -1;  ///< of a driver that drives to goals
  };
  std::map<AddressKey, Provider> provided_;  ///< by drivers
  std::set<AddressKey> of_world_;  ///< provided by drivers of the world: maps, blackboards
  std::vector<std::pair<OtherDriver, RobotDraft*>> kept_;  ///< drivers
  std::map<std::pair<const RobotDraft*, std::string>, std::set<int>> driver_indexes_;
  /// Addresses of interfaces that every robot or world has, with their robots or nullptr.
  std::vector<std::pair<const RobotDraft*, Address>> everywhere_;
};

}  // namespace

void apply_player_file(const Entity& config, bool must_match, Translation& translation,
                       Report& report) {
  PlayerFile(must_match, translation, report).run(config);
}

}  // namespace sim::io::stage
