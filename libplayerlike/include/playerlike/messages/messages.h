// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "playerlike/messages/driver_settings.h"
#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"
#include "sim/devices/device.h"
#include "sim/simulation/simulation.h"

/// Messages between a simulation's host and its clients, as plain structs. Readings and commands
/// are libsim's types (sim::Reading and its derived classes, sim::Command).
namespace playerlike {

/// Identifies a device of a simulation by the indices of its robot and of the device.
using DeviceId = sim::Simulation::DeviceId;

/// The port on which all robots of a world are visible (MORSE's).
inline constexpr int kMorsePort = 4000;
/// Player's default port, that of a world's first robot unless the world says otherwise.
inline constexpr int kPlayerPort = 6665;

/// Description of a device for clients.
struct DeviceInfo {
  DeviceId id{-1, -1};
  std::string name;                          ///< name within the robot, e.g. "laser"
  std::string type;                          ///< e.g. "laser"
  std::map<std::string, double> properties;  ///< numeric settings, in SI units and radians
};

/// An address of a Player server.
struct PlayerAddress {
  std::string interface;
  int index = 0;
  std::string driver;              ///< name of the server's driver
  DeviceId reading{-1, -1};        ///< device of the readings; none for the world's interfaces
  std::optional<DeviceId> motion;  ///< motors of the address, for position2d
};

/// Description of a robot for clients.
struct RobotInfo {
  std::string name;
  std::string model;
  sim::Colour colour;
  sim::Pose initial_pose;                  ///< X_WB at the start
  int port = 0;                            ///< the robot's Player port
  double length_m = 0.0;                   ///< footprint's bounding box along x of B [m]
  double width_m = 0.0;                    ///< that box along y [m]
  double height_m = 0.0;                   ///< [m]
  sim::Vec2 center_m = sim::Vec2::Zero();  ///< centre of that box, in B [m]
  double radius_m = 0.0;  ///< radius of the footprint about B's origin [m]; 0: unknown
  double mass_kg = 0.0;   ///< [kg]; 0: unknown
  double max_speed_mps = 0.0;
  double max_turn_rate_radps = 0.0;
  bool shares_port = false;  ///< whether other robots have this port, see note_shared_ports()
  std::map<std::string, int> proxies;  ///< interface -> index on port 4000, and of the first device
                                       ///< on a shared port, from the world file
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< interface -> device names in order of index, from the world file
  std::vector<sim::DriverDescription> drivers;  ///< as in the world file
  std::vector<GoalDriverInfo> goal_drivers;     ///< parsed from `drivers`, see read_drivers()
  std::vector<PlannerInfo> planners;            ///< parsed from `drivers`
  std::vector<ScanDriverInfo> scan_drivers;     ///< parsed from `drivers`
  std::vector<DeviceInfo> devices;
  /// All addresses of the port, if the robot is that of a Player server. Otherwise they follow from
  /// the devices' types, see find_interface().
  std::optional<std::vector<PlayerAddress>> addresses;
};

/// Size and position of the grid-map.
struct CanvasInfo {
  int width = 0;
  int height = 0;
  double cell_size_m = 0.0;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
};

/// Progress of a simulation.
struct TimeStatistics {
  sim::SimTime sim_time_ns = 0;
  std::uint64_t steps = 0;
  double step_s = 0.0;
  double wall_time_s = 0.0;          ///< wall time since the first step
  double real_time_factor = 0.0;     ///< simulated time / wall time; 0 before the first step
  std::optional<double> duration_s;  ///< simulated duration of the run; nullopt if unlimited
  sim::TimeMode mode = sim::TimeMode::kLockstep;
  bool finished = false;
  /// Reasons why a repetition of this run may differ, namely decisions that depended on the wall
  /// clock. Only available in the process of the simulation.
  std::vector<std::string> unrepeatable;
};

/// Value of a robot's or obstacle's property: numbers (SI units and radians) or a text.
using PropertyValue = std::variant<std::vector<double>, std::string>;

/// State of a port's log.
struct LogStatus {
  bool replay = false;   ///< true: readings come from the log; false: readings are written to the
                         ///< log
  bool running = false;  ///< whether the log is running
  std::string file;      ///< file name in the run's output folder
};

/// Error of a failed call. Player's layer converts it to PlayerCc::PlayerError.
class SessionError : public std::runtime_error {
 public:
  enum class Code {
    kFinished,      ///< the simulated duration is over
    kDisconnected,  ///< the connection is closed
    kNoSuchDevice,  ///< the world has no such device; the message names the existing ones
    kNotAvailable,  ///< not possible with this kind of session
    kBadArgument,   ///< an invalid value, e.g. NaN
  };
  SessionError(Code code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] Code code() const noexcept { return code_; }

 private:
  Code code_;
};

/// Checks the numbers of a command before it is sent.
/// @throws SessionError kBadArgument if any number is NaN or infinite, or for a pose that
///         sim::fault_of() refuses.
void require_finite(const sim::Command& command);

/// Whether devices of a type provide an interface, e.g. "pose" devices provide "position2d".
[[nodiscard]] bool carries(std::string_view device_type, std::string_view interface);

/// All interfaces that devices provide, in alphabetical order.
[[nodiscard]] std::vector<std::string_view> interface_names();

/// Names of a robot's devices that provide an interface, by index on the robot's own port.
[[nodiscard]] std::vector<std::string> device_order(const sim::RobotDescription& robot,
                                                    std::string_view interface);

/// Returns an example world for an interface. It is shipped with Playpen and has a robot with a
/// device that provides the interface.
/// @return name in the folder of worlds, e.g. "devices/laser.json"; "" if no device provides the
///         interface.
[[nodiscard]] std::string example_world(std::string_view interface);

/// Checks the `interfaces` tables of a world's robots, and the indices of devices on a shared port.
/// @throws sim::ConfigError naming each unknown interface, each device that does not provide the
///         interface of its entry, and each index that two devices of a shared port have.
void check_interfaces(const sim::WorldDescription& world);

/// Sets RobotInfo::shares_port of all robots.
void note_shared_ports(std::vector<RobotInfo>& robots);

/// Returns the descriptions of a simulation's robots for clients.
/// @throws sim::ConfigError if the drivers are invalid; see check_drivers().
[[nodiscard]] std::vector<RobotInfo> describe_robots(const sim::Simulation& simulation);

/// Returns the grid of the map of an arena's whole floor.
/// @throws SessionError kBadArgument for the same errors as WorldMapRequest.
[[nodiscard]] sim::CanvasDescription map_grid(const sim::ArenaDescription& arena,
                                              double cell_size_m);

/// Returns the first robot with this port, or null if there is none.
[[nodiscard]] const RobotInfo* robot_at(const std::vector<RobotInfo>& robots, int port);
/// Whether clients can connect to a port, which is a robot's port or kMorsePort.
[[nodiscard]] bool is_open(const std::vector<RobotInfo>& robots, int port);

/// The devices behind a Player device address.
struct InterfaceBinding {
  DeviceId reading{-1, -1};        ///< device of the readings; none for the world's interfaces
  std::optional<DeviceId> motion;  ///< the robot's motors, for position2d
  int robot = -1;                  ///< index of the robot; -1 for the world's interfaces
  const GoalDriverInfo* driver = nullptr;  ///< driver that receives goals, or null; belongs to the
                                           ///< list of robots
  const PlannerInfo* planner = nullptr;    ///< planner, or null; belongs to the list of robots
  const PlayerAddress* address = nullptr;  ///< of a Player server, or null; belongs to the list of
                                           ///< robots
  const ScanDriverInfo* scan_driver = nullptr;  ///< driver that makes scans of the readings, or
                                                ///< null; belongs to the list of robots

  /// Whether the address belongs to the world instead of a device. The world answers requests and
  /// makes no readings.
  [[nodiscard]] bool is_world() const { return robot < 0; }
  /// Type of the driver in the world file, e.g. "snd"; null if the address is that of a device or
  /// of the world.
  [[nodiscard]] const char* driver_type() const {
    if (driver != nullptr) return driver->type();
    if (scan_driver != nullptr) return scan_driver->type();
    return planner != nullptr ? PlannerInfo::type() : nullptr;
  }
};

/// Finds the device behind (port, interface, index).
///
/// On a robot's own port, index i is the robot's i-th device with the interface. The order is that
/// of the robot's `interfaces` table, by default by type and name. Drivers have the indexes that
/// the world defines, by default the first free ones. On port 4000, the world's `proxies` table
/// defines the index, by default the robot's number, counted from 0. A
/// shared port uses these indices, too. There, further devices of a robot follow the index in
/// `proxies`.
///
/// Known interfaces: "position2d" (pose, then odometry devices), "localize" (pose devices),
/// "laser", "sonar", "ir" (infrared), "ranger" (lasers, then sonar, then infrared), "power"
/// (batteries), "graphics2d" (pens); interfaces with the names of their devices ("aio",
/// "blinkenlight", "bumper", "dio", "fiducial", "gps", "gripper", "imu", "opaque", "speech",
/// "wifi"); "planner" (drivers of the world); and the world's interfaces "log", "map" and
/// "simulation", with index 0 on every port. The port of a Player server has that server's
/// addresses instead (RobotInfo::addresses).
/// @throws SessionError kNoSuchDevice, naming the existing addresses and, if the port does not have
///         the interface at all, a world that has it (example_world()).
[[nodiscard]] InterfaceBinding find_interface(const std::vector<RobotInfo>& robots, int port,
                                              std::string_view interface, int index);

/// An address of a port, for lists and messages.
struct InterfaceAddress {
  std::string interface;
  int index = 0;
  std::string robot;  ///< empty for the world's interfaces
  std::string device;
};
/// Returns all addresses of a port.
[[nodiscard]] std::vector<InterfaceAddress> list_interfaces(const std::vector<RobotInfo>& robots,
                                                            int port);

}  // namespace playerlike
