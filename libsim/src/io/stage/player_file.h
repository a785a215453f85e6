// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "io/stage/player_address.h"
#include "io/stage/translation.h"

namespace sim::io::stage {

/// Whether a driver of Player turns an interface into another one.
[[nodiscard]] inline bool is_converter(std::string_view name) {
  return name == "rangertolaser" || name == "lasertoranger" || name == "passthrough";
}

/// A driver that is not Stage's.
struct OtherDriver {
  const Entity* entity;
  std::string name;
  std::vector<Address> provided;
  std::vector<Address> required;
};
/// Applies a configuration file of Player to a translation, see apply_player_file().
class PlayerFile {
 public:
  PlayerFile(bool must_match, Translation& translation, Report& report)
      : must_match_(must_match), translation_(translation), report_(report) {}
  void run(const Entity& config);

 private:
  /// Reads the properties outside of all sections.
  void read_units(const Entity& config);
  /// A driver in words, for messages; "" for the file itself.
  static std::string title_of(const Entity& entity);
  /// Reports properties without an effect, and the sections in a driver.
  void tell_rest(const Entity& entity, std::initializer_list<std::string_view> known);
  void tell_sections(const Entity& driver);
  std::vector<Address> addresses(const Properties& driver, const char* key);
  /// A robot by the name of its model, or of a model on it.
  RobotDraft* find_robot(const std::string& name);
  void stage_driver(const Properties& driver);
  /// A driver that names no model offers the interfaces of the world.
  void without_model(const Properties& driver, const std::vector<Address>& provided);
  /// Without any driver for models, as in the file of a second server: the robots have the default
  /// ports and the indexes of their devices.
  void bind_all();
  /// Reports a model that the world lacks. @return the robot that takes its place, or nullptr.
  RobotDraft* missing_robot(const Place& place, const std::string& name);
  /// Gives a device of a robot an address, as Stage does: the first one of the right type that has
  /// none of this interface yet.
  /// @return false if there is none.
  bool bind(RobotDraft& robot, const Address& address);
  void taken_twice(const Address& address, const std::string& owner);
  /// Notes an address of an interface that every robot or world has, if it has another index there.
  void tell_unserved(const RobotDraft* robot, const Address& address);
  void note_interface(const Address& address);
  void missing_device(const RobotDraft& robot, const Address& address, bool is_error);
  void note_port(const RobotDraft& robot, const Address& address);
  void take(RobotDraft& robot, const Address& address, const std::string& device);
  /// Writes the indexes of interfaces.
  void set_addresses();
  /// Notes addresses of devices that have another index here: indexes are consecutive, and each
  /// device has one.
  void tell_moved();
  /// The robot whose device, or whose driver, has that address.
  RobotDraft* owner_of(const Address& wanted);
  /// The driver that provides an address; "" if none does.
  [[nodiscard]] std::string driver_of(const Address& wanted) const;
  bool left_out(const OtherDriver& driver, const std::string& why);
  void leave_out(const OtherDriver& driver, const std::string& why);
  [[nodiscard]] bool is_provided(const Address& address);
  static std::string unprovided(const Address& address);
  /// Adds the drivers that are not Stage's. A driver may need what a later one provides, so those
  /// come first that have all they need.
  void add_drivers();
  /// Adds a driver of Player that turns one interface into another, drives or plans.
  /// @return whether it is done; otherwise no robot is known yet whose devices it needs.
  bool add_driver(const OtherDriver& driver);
  /// Adds a driver to a robot. @return false if it is left out, which is noted.
  bool add_to(RobotDraft& robot, const OtherDriver& driver);
  bool convert(RobotDraft& robot, const OtherDriver& driver);
  /// Index of the address of an interface, rather one with that key.
  static int index_of(const std::vector<Address>& addresses, std::string_view interface,
                      std::string_view key, int fallback);
  /// An index as the robot itself counts it: robots that share a port continue those of others.
  int local_index(RobotDraft& robot, const std::string& interface, int index);
  /// The robot's laser that a driver requires, or any of them.
  std::optional<std::string> laser_of(RobotDraft& robot, const std::vector<Address>& required);
  /// Index of a laser among the robot's, which it gets if it has none yet.
  static std::size_t index_of_laser(RobotDraft& robot, const std::string& laser);
  [[nodiscard]] Json settings_of(const OtherDriver& driver);
  /// Index of the robot's own `position2d` that a driver requires, rather of one with that key: 0
  /// if the driver requires none or that of another driver.
  /// @return nullopt if nothing provides what it requires.
  std::optional<int> own_position(RobotDraft& robot, const OtherDriver& driver,
                                  std::string_view key);
  bool leave_out_without_position(const OtherDriver& driver);
  /// The first index from `least` on that no driver has. @return it, which is taken then.
  int next_index(RobotDraft& robot, std::string_view interface, int least);
  /// The index of a driver among those of a robot's interface: the one in the file, or if that is
  /// taken the next one that is free, with a note.
  int free_index(RobotDraft& robot, const OtherDriver& driver, std::string_view interface,
                 int fallback, int own);
  void note_provided(const OtherDriver& driver, const Address& address);
  bool add_goal_driver(const OtherDriver& driver, RobotDraft& robot);
  bool add_scan_driver(const OtherDriver& driver, RobotDraft& robot);
  bool add_amcl(const OtherDriver& driver, RobotDraft& robot);
  bool add_wavefront(const OtherDriver& driver, RobotDraft& robot);
  /// The robot's own position if that is the output of a planner: Stage's positions drive to goals.
  std::optional<int> own_output(RobotDraft& robot, const Address* output);
  /// Adds a driver that drives straight to goals. @return its index.
  int add_straight_driver(const OtherDriver& planner, RobotDraft& robot, int position);
  /// Index that a driver has here, by the address that it has in the file.
  int index_of_driver(RobotDraft& robot, const Address& address);
  /// Leaves out the drivers of robots that share a port, which offers devices only.
  void leave_out_on_shared_port();
  /// Frees an index of position2d for a driver: a robot of Stage has only one position.
  static void free_position(RobotDraft& robot, std::size_t index);
  /// Gives a robot that shares its port its indexes. Devices that the file does not name would have
  /// the indexes of other robots' devices, so they are left out.
  void share_port(RobotDraft& robot);
  /// One port for each robot, or one for all of them.
  void set_ports();
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

}  // namespace sim::io::stage
