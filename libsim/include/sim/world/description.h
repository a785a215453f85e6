// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/elevation.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"
#include "sim/world/controller.h"
#include "sim/world/fuzz.h"
#include "sim/world/obstacle_motion.h"

/// The description of a world: plain structs without behaviour. io fills them from a file; a
/// program may also fill them itself. Simulation uses them without further checks (call
/// sim::io::check_world first).
namespace sim {

/// Outline of a solid: a polygon in the solid's own frame, counter-clockwise [m].
using Polygon = std::vector<Vec2>;

/// Whether an obstacle can be retracted into the floor.
enum class ObstacleType {
  kStatic,   ///< always there (light grey in pictures)
  kDynamic,  ///< can be extended and retracted while running (red)
};

/// Whether a dynamic obstacle is extended or retracted now.
enum class ObstacleState { kExtended, kRetracted };

/// Outline of an obstacle, seen from above.
enum class ObstacleShape { kBox, kCircle, kPolygon };

/// A block of the arena: an upright solid that stands on the floor. sim/world/outline.h has
/// functions for its shapes.
struct ObstacleDescription {
  std::string name;  ///< unique in the world
  ObstacleType type = ObstacleType::kStatic;
  Vec2 center = Vec2::Zero();  ///< in W; of a polygon the origin of its own frame [m]
  Vec2 size = {0.2, 0.2};      ///< extent along its own x and y axes [m]; of a circle
                               ///< the diameter twice, of a polygon the extent of `outline`
  double yaw_rad = 0.0;        ///< turn of its axes against W's [rad]
  double height_m = 0.16;      ///< a sensor mounted above this height looks over it [m]
  ObstacleState state = ObstacleState::kExtended;  ///< a static one is always extended
  std::vector<std::string> tags;                   ///< as RobotDescription::tags
  int fiducial = 0;                   ///< number that fiducial devices read; 0: they do not see it
  std::optional<Colour> colour = {};  ///< none: pictures use the colour of its type, and
                                      ///< blobfinders do not see it
  bool portable = false;              ///< grippers can take and carry it
  int carried_by = -1;                ///< index of the robot that carries it now; -1: none
  double rise_speed_mps = 0.0;        ///< of a dynamic one, upwards and downwards [m/s]; 0: at once
  WhenBlocked when_blocked = WhenBlocked::kRefuse;  ///< of a dynamic one, if a robot stands on it
                                                    ///< when it is to be extended
  std::optional<double> present_height_m = {};  ///< while it rises or sinks, [0, height_m] [m]; its
                                                ///< state is kExtended then
  ObstacleShape shape = ObstacleShape::kBox;
  Polygon outline = {};  ///< of a polygon, in its own frame: simple, counter-clockwise, 3 to
                         ///< kMostOutlineVertices vertices; otherwise empty
  std::optional<ObstacleMotion> motion = {};  ///< it has a drive and moves
  std::optional<double> mass_kg = {};  ///< [kg]; without a motion robots can push it. None: it
                                       ///< stands fast, or has kMovingObstacleMass_kg if it moves
  double friction = kFloorFriction;    ///< coefficient of friction with the floor if robots can
                                       ///< push it
  bool solid = true;  ///< false: nothing collides with it, as with a marking on the floor. Sensors
                      ///< see it up to its height from outside
  double bottom_m = 0.0;  ///< of an obstacle that neither moves nor rises: lasers, sonars and other
                          ///< sensors of distances look under it below this height, [0, height_m)
};

/// Whether an obstacle has a drive or can be pushed, so that the physics moves it.
[[nodiscard]] inline bool is_movable(const ObstacleDescription& obstacle) {
  return obstacle.motion.has_value() || obstacle.mass_kg.has_value();
}

/// Whether robots can push an obstacle, which has no drive.
[[nodiscard]] inline bool is_pushable(const ObstacleDescription& obstacle) {
  return obstacle.mass_kg.has_value() && !obstacle.motion.has_value();
}

/// Present height of an extended obstacle [m].
[[nodiscard]] inline double standing_height_m(const ObstacleDescription& obstacle) {
  return obstacle.present_height_m.value_or(obstacle.height_m);
}

/// Maximum number of vertices of an obstacle's outline.
inline constexpr std::size_t kMostOutlineVertices = 64;

/// Corners of a box in W, counter-clockwise from the front right one [m].
/// @param X_WB  pose of the box's centre.
/// @param size  along its own axes [m].
[[nodiscard]] inline std::vector<Vec2> box_corners(const Pose& X_WB, const Vec2& size) {
  const Vec2 h = 0.5 * size;
  return {X_WB * Vec2(h.x(), -h.y()), X_WB * Vec2(h.x(), h.y()), X_WB * Vec2(-h.x(), h.y()),
          X_WB * Vec2(-h.x(), -h.y())};
}
/// Corners of an obstacle that is a box in W, counter-clockwise from the front right one [m].
[[nodiscard]] inline std::vector<Vec2> box_corners(const ObstacleDescription& box) {
  return box_corners({box.center.x(), box.center.y(), box.yaw_rad}, box.size);
}

/// A charging dock: a marked place on the floor, not an obstacle.
struct DockDescription {
  std::string name;          ///< unique among docks
  Pose pose;                 ///< X_WD: centre; a docked robot faces along its x axis
  Vec2 size = {0.24, 0.24};  ///< along its own axes [m]
};

/// A wall from a map: a closed outline with the solid on its left, as vertices in W [m]. The outer
/// ring of a solid region runs counter-clockwise, the ring of a hole clockwise.
struct WallLoop {
  std::vector<Vec2> vertices;
  /// A sensor mounted above this height looks over it [m]; infinite by default.
  double height_m = std::numeric_limits<double>::infinity();
  bool solid = true;  ///< false: robots drive through it
};

/// A picture of walls in an arena (the resulting loops are in ArenaDescription).
struct MapDescription {
  std::string image;                ///< file, relative to the world file
  double resolution_m = 0.05;       ///< side of a pixel [m], unless it has a size
  Vec2 origin = Vec2::Zero();       ///< W position of the picture's bottom left corner [m], unless
                                    ///< it has a size
  double occupied_threshold = 0.5;  ///< pixels darker than this fraction of white are walls
  double simplify_m = 0.0;          ///< tolerance for straightening outlines [m]; 0: none
  std::optional<Vec2> size = {};    ///< the picture is stretched to this size [m]
  Pose pose = {};                   ///< X_WP of the middle of a picture with a size
  std::optional<double> height_m = {};  ///< of the walls [m]; none: all sensors see them
  bool solid = true;                    ///< of the walls: false: robots drive through them
};

/// The room: floor from `origin` to `origin + size`, with borders around it unless turned off.
struct ArenaDescription {
  std::string preset;             ///< "syrotek", or "" for an arena described in full
  Vec2 origin = Vec2::Zero();     ///< bottom left corner of the floor in W [m]
  Vec2 size = {3.42, 3.72};       ///< [m]
  bool border = true;             ///< walls around the floor
  double border_height_m = 0.16;  ///< [m]
  std::vector<ObstacleDescription> obstacles;
  std::vector<DockDescription> docks;
  std::vector<ObstacleDescription> dock_separators;  ///< static boxes beside docks (brown)
  std::vector<MapDescription> maps;
  std::vector<WallLoop> walls;  ///< of the maps, merged into few edges
};

/// Lockstep: time advances when all clients wait in Read(). Paced: wall-clock time times a factor.
enum class TimeMode { kLockstep, kPaced };

/// How exactly devices measure and move (sim/world/realism.h).
enum class Realism {
  kIdeal,   ///< without noise, drift, slip and latency, whatever the settings say
  kCourse,  ///< as the settings say
  kReal,    ///< as the settings say; those that are left out get the figures of real devices
};

/// How simulated time runs: its step, its end and its relation to wall-clock time.
struct SimulationDescription {
  SimTime step_ns = 10'000'000;  ///< length of a step [ns]
  std::uint64_t seed = 1;
  std::optional<SimTime> duration_ns;  ///< the run ends then; none: it does not end
  TimeMode time_mode = TimeMode::kLockstep;
  bool time_mode_given = false;  ///< the world or the user chose the mode; otherwise a host may
                                 ///< change it, see playerlike::PreferRealTimeRequest
  double time_factor = 1.0;      ///< paced: simulated seconds per wall-clock second
  int start_gate_clients = 1;    ///< the clock waits until this many clients have joined
  bool objects_locked = false;   ///< clients may look up robots and obstacles by name, but not move
                                 ///< or change them, nor command the arena controller
  Realism realism = Realism::kCourse;
  bool own_sensors_only = false;  ///< for contests: clients read only the sensors of their own
                                  ///< robots, and no objects by name, map, state of the arena
};

/// A sensor or actuator of a robot.
struct DeviceDescription {
  std::string name;  ///< unique in its robot, e.g. "laser"; path is ROBOT.NAME
  std::string type;  ///< a name in the device table (sim/devices/builtin.h), e.g. "laser"
  std::any params;   ///< that type's params struct, e.g. LaserParams
  std::vector<std::string> given = {};  ///< keys of the settings that a file states, sorted
};

/// A client-side driver (e.g. SND) that a host runs for a robot. libsim passes its settings on as
/// text and does not read them.
struct DriverDescription {
  std::string type;
  std::map<std::string, std::string> settings;
};

/// The real robot that a robot of the world mirrors: its commands go there, its readings come from
/// there, and it stands where the real one is. libsim only stores this; the host of a run connects.
struct RealRobotDescription {
  /// Where the commands of programs go.
  enum class Drive {
    kReal,  ///< to the real robot only
    kBoth,  ///< also to a simulated ghost, for comparison
  };
  /// What happens when the connection is lost. In each case the robot stops.
  enum class OnLost {
    kContinue,   ///< the run continues without it
    kEnd,        ///< the run ends
    kReconnect,  ///< the run continues, and the connection is made again as soon as possible
  };
  std::string server;  ///< "player://HOST[:PORT]" or "tcp://HOST[:PORT]"
  int port = 0;        ///< its Player port at a "tcp://" server; 0: that of the world's robot
  Drive drive = Drive::kReal;
  std::string pose_interface = "position2d";  ///< "position2d" or "localize"
  int pose_index = 0;  ///< of the device whose readings say where the real robot is
  Pose X_WF;           ///< pose of that device's frame F in W
  OnLost on_lost = OnLost::kContinue;
  /// A Playpen server stops the real robot if it hears nothing for so long, and a connection is
  /// lost if nothing arrives for twice as long; wall-clock time [s].
  double watchdog_s = 0.4;
  bool take_over = false;  ///< from another client that is in charge of the real robot
};

struct RobotModel;

/// A robot at the start of the world: model, pose, devices and addresses for clients.
struct RobotDescription {
  std::string name;               ///< unique in the world; letters, digits, _ and -
  std::string model = "s1r";      ///< see find_robot_model()
  Pose pose;                      ///< X_WB at the start
  Elevation elevation;            ///< height and inclination at the start
  std::vector<std::string> tags;  ///< properties that sensors may look for, in alphabetical order
  Colour colour{0xff, 0x88, 0x00, 0xff};
  int port = 0;  ///< Player port; default: the shared port, otherwise 6665, 6666, ...
  std::vector<DeviceDescription> devices;  ///< sorted by name
  std::map<std::string, int> proxies;      ///< interface name -> index on port 4000, and of the
                                           ///< first device on a shared port
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< interface name -> names of devices, by index on the robot's own port;
                   ///< devices not named here follow in the usual order
  std::vector<DriverDescription> drivers;
  int fiducial = 0;  ///< number that fiducial devices of other robots read; 0: they do not see it
  std::optional<RealRobotDescription> real = {};  ///< none: the robot is simulated
};

/// Whether a text has the form of RealRobotDescription::server. The host part is not checked.
[[nodiscard]] inline bool is_real_server(std::string_view text) {
  for (const std::string_view prefix : {"player://", "tcp://"}) {
    if (text.starts_with(prefix)) return text.size() > prefix.size();
  }
  return false;
}

/// Description of the texts that is_real_server() accepts, for messages.
inline constexpr const char* kRealServerExpected = "player://HOST[:PORT] or tcp://HOST[:PORT]";

/// How the grid-map is shown in pictures, films and windows.
enum class ViewMode {
  kGround,      ///< on the floor, under obstacles and robots
  kMiniMap,     ///< in a corner of the arena's picture
  kFullScreen,  ///< instead of the arena, with crisp cells and the robots on it
};

/// Maximum number of cells along a side of the grid-map.
inline constexpr int kMaxCanvasSide = 8192;

/// The grid-map that robots draw on with their pens.
struct CanvasDescription {
  int width = 172;                         ///< cells
  int height = 186;                        ///< cells
  double cell_size_m = 0.02;               ///< [m]
  Vec2 origin = Vec2::Zero();              ///< W position of the canvas's bottom left corner [m]
  ViewMode view_mode = ViewMode::kGround;  ///< initial mode
  bool view_mode_locked = false;           ///< the mode cannot be changed while running
};

/// A whole world, as a file describes it.
struct WorldDescription {
  std::string name = "unnamed";
  std::string description;  ///< one sentence for people; "": none
  std::string file;         ///< path of the world file, "" if there is none
  /// What of a Stage world was left out or means something else, for people: "FILE:LINE: TEXT".
  std::vector<std::string> notes;
  ArenaDescription arena;
  SimulationDescription simulation;
  /// Robot models that are not built in, by the name in RobotDescription::model.
  std::map<std::string, std::shared_ptr<const RobotModel>> models;
  std::vector<RobotDescription> robots;
  int robots_on_port = 0;  ///< Player port of all robots without their own port; 0: none
  CanvasDescription canvas;
  ControllerDescription controller;  ///< timers, traps and configurations of the arena
  FuzzDescription fuzz;              ///< what `playpen fuzz` may change; not used by simulations
};

}  // namespace sim
