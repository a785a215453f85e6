// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "playerlike/messages/snd_settings.h"
#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"
#include "sim/devices/device.h"
#include "sim/simulation/simulation.h"

/// What passes between a simulation's host and its clients: plain structs.
/// Readings and commands are libsim's own (sim::Reading and those derived from it, sim::Command).
namespace playerlike {

/// A device of a simulation, by the indices of its robot and of itself.
using DeviceId = sim::Simulation::DeviceId;

/// The port on which all robots of a world are visible (MORSE's).
inline constexpr int kMorsePort = 4000;

/// A device as clients are told of it.
struct DeviceInfo {
  DeviceId id{-1, -1};
  std::string name;                          ///< in its robot, e.g. "laser"
  std::string type;                          ///< e.g. "laser"
  std::map<std::string, double> properties;  ///< its numeric settings, SI units and radians
};

/// A robot as clients are told of it.
struct RobotInfo {
  std::string name;
  std::string model;
  sim::Colour colour;
  sim::Pose initial_pose;                  ///< X_WB at the start
  int port = 0;                            ///< its Player port
  double length_m = 0.0;                   ///< of the footprint's bounding box along x, B [m]
  double width_m = 0.0;                    ///< along y [m]
  double height_m = 0.0;                   ///< [m]
  sim::Vec2 center_m = sim::Vec2::Zero();  ///< middle of that box, in B [m]
  double max_speed_mps = 0.0;
  double max_turn_rate_radps = 0.0;
  bool shares_port = false;  ///< other robots have this port, too; see note_shared_ports()
  std::map<std::string, int> proxies;  ///< interface -> index on port 4000, and of the first device
                                       ///< on a shared port, where the world says so
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< interface -> names of devices in order of index, where the world says so
  std::vector<sim::DriverDescription> drivers;    ///< as the world file has them
  std::vector<SndDriverDescription> snd_drivers;  ///< the same, understood
  std::vector<DeviceInfo> devices;
};

/// The grid-map's size and place.
struct CanvasInfo {
  int width = 0;
  int height = 0;
  double cell_size_m = 0.0;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
};

/// How far a simulation is.
struct TimeStatistics {
  sim::SimTime sim_time_ns = 0;
  std::uint64_t steps = 0;
  double step_s = 0.0;
  double wall_time_s = 0.0;          ///< since its first step
  double real_time_factor = 0.0;     ///< simulated over wall time; 0 before the first step
  std::optional<double> duration_s;  ///< of the run, if it has an end
  sim::TimeMode mode = sim::TimeMode::kLockstep;
  bool finished = false;
  /// Why another run of the same may differ: what rules of the wall clock had a say in. Known where
  /// the simulation is.
  std::vector<std::string> unrepeatable;
};

/// A property of a robot or an obstacle: numbers (SI units and radians), or a text.
using PropertyValue = std::variant<std::vector<double>, std::string>;

/// What the log of a port does.
struct LogStatus {
  bool replay = false;  ///< readings come from the log, not from the devices; else they are written
  bool running = false;  ///< it does so now
  std::string file;      ///< in the run's output folder
};

/// A call that could not be carried out. Player's layer turns it into PlayerCc::PlayerError.
class SessionError : public std::runtime_error {
 public:
  enum class Code {
    kFinished,      ///< the simulated duration is over
    kDisconnected,  ///< the connection is closed
    kNoSuchDevice,  ///< the world has no such device; the message names those it has
    kNotAvailable,  ///< not possible with this kind of session
    kBadArgument,   ///< a value that cannot be meant, e.g. NaN
  };
  SessionError(Code code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] Code code() const noexcept { return code_; }

 private:
  Code code_;
};

/// Refuses a command with a number that cannot be meant, before it is sent.
/// @throws SessionError kBadArgument if any of its numbers is NaN or infinite.
void require_finite(const sim::Command& command);

/// Whether devices of a type carry an interface, e.g. "pose" devices carry "position2d".
[[nodiscard]] bool carries(std::string_view device_type, std::string_view interface);

/// All interfaces that devices carry, in alphabetical order.
[[nodiscard]] std::vector<std::string_view> interface_names();

/// Names of a robot's devices that carry an interface, by index on the robot's own port.
[[nodiscard]] std::vector<std::string> device_order(const sim::RobotDescription& robot,
                                                    std::string_view interface);

/// The world that comes with Playpen for trying an interface: it has a robot with a device that
/// carries it.
/// @return its name in the folder of worlds, e.g. "devices/laser.json"; "" if no device carries the
///         interface.
[[nodiscard]] std::string example_world(std::string_view interface);

/// Checks the orders of devices that robots give for interfaces, and the indices of devices on a
/// port that robots share.
/// @throws sim::ConfigError naming each interface that there is not, each device that does not
///         carry the one it is listed for, and each index that two devices of a shared port have.
void check_interfaces(const sim::WorldDescription& world);

/// Notes which robots share a port.
void note_shared_ports(std::vector<RobotInfo>& robots);

/// Builds what clients are told of a simulation's robots.
/// @throws sim::ConfigError if their drivers are not sound, see check_drivers().
[[nodiscard]] std::vector<RobotInfo> describe_robots(const sim::Simulation& simulation);

/// The cells of the map of an arena's whole floor.
/// @throws SessionError kBadArgument as WorldMapRequest.
[[nodiscard]] sim::CanvasDescription map_grid(const sim::ArenaDescription& arena,
                                              double cell_size_m);

/// The first robot that has a port; null if none has this one.
[[nodiscard]] const RobotInfo* robot_at(const std::vector<RobotInfo>& robots, int port);
/// Whether clients can connect to a port: a robot's, or that of all robots.
[[nodiscard]] bool is_open(const std::vector<RobotInfo>& robots, int port);

/// Which devices stand behind a Player device address.
struct InterfaceBinding {
  DeviceId reading{-1, -1};        ///< whose readings the interface carries; none: the world's own
  std::optional<DeviceId> motion;  ///< the robot's motors, for position2d
  int robot = -1;                  ///< -1: no robot's, but the world's
  const SndDriverDescription* driver = nullptr;  ///< what takes goals for it, if it is a driver's;
                                                 ///< lives as long as the list of robots

  /// Whether the world itself stands there, not a device: it answers requests, and makes no
  /// readings.
  [[nodiscard]] bool is_world() const { return robot < 0; }
};

/// Finds the device behind (port, interface, index). On a robot's own port, index i is that
/// robot's i-th device with the interface, in the order that its `interfaces` give or else in order
/// of type and name, and drivers have the indices that the world gives them
/// (by default the first free ones); on port 4000 the index is the one that the world's
/// `proxies` table gives, by default the robot's number counted from 0. On a port that robots share
/// it is the same, but a robot's further devices follow the index that `proxies` gives.
/// Interfaces known: "position2d" (pose, then odometry devices), "localize" (pose devices),
/// "laser", "sonar", "ir" (infrared), "ranger" (lasers, then sonar, then infrared), "power"
/// (batteries), "graphics2d" (pens); those of the devices that have their names ("aio",
/// "blinkenlight", "bumper", "dio", "fiducial", "gps", "gripper", "imu", "opaque", "speech",
/// "wifi"); and "log", "map" and "simulation", the world's own, with index 0 on every port.
/// @throws SessionError kNoSuchDevice, naming the addresses that exist and, where the port has none
///         of the interface, the world that does (example_world()).
[[nodiscard]] InterfaceBinding find_interface(const std::vector<RobotInfo>& robots, int port,
                                              std::string_view interface, int index);

/// One address of a port, for lists and messages.
struct InterfaceAddress {
  std::string interface;
  int index = 0;
  std::string robot;  ///< empty: the world's
  std::string device;
};
/// All addresses of a port.
[[nodiscard]] std::vector<InterfaceAddress> list_interfaces(const std::vector<RobotInfo>& robots,
                                                            int port);

}  // namespace playerlike
