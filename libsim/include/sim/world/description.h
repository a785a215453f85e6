// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"

/// What a world is: plain structs, no behaviour. io fills them from a file, a program may fill
/// them by hand; Simulation takes them as they are (check them with sim::io::check_world first).
namespace sim {

/// Outline of a solid, a polygon in its own frame, counter-clockwise [m].
using Polygon = std::vector<Vec2>;

/// Whether an obstacle can be moved out of the way.
enum class ObstacleType {
  kStatic,   ///< always there (light grey in pictures)
  kDynamic,  ///< can be extended from the floor and retracted into it while running (red)
};

/// Whether a dynamic obstacle stands in the arena now.
enum class ObstacleState { kExtended, kRetracted };

/// A block of the arena: a box standing on the floor.
struct ObstacleDescription {
  std::string name;  ///< unique in the world
  ObstacleType type = ObstacleType::kStatic;
  Vec2 center = Vec2::Zero();  ///< in W [m]
  Vec2 size = {0.2, 0.2};      ///< along its own x and y axes [m], each > 0
  double yaw_rad = 0.0;        ///< turn of its axes against W's [rad]
  double height_m = 0.16;      ///< a sensor mounted at or above this looks over it [m]
  ObstacleState state = ObstacleState::kExtended;  ///< a static one is always extended
  int fiducial = 0;                   ///< what fiducial devices read of it; 0: they do not see it
  std::optional<Colour> colour = {};  ///< none: in pictures that of its type, and no blobfinder
                                      ///< sees it
  bool portable = false;              ///< grippers can take and carry it
  int carried_by = -1;                ///< index of the robot that carries it now; -1: it stands
};

/// Corners of a box whose middle has the pose X_WB, counter-clockwise from its front right one, in
/// W [m].
/// @param size  along its own axes [m].
[[nodiscard]] inline std::vector<Vec2> box_corners(const Pose& X_WB, const Vec2& size) {
  const Vec2 h = 0.5 * size;
  return {X_WB * Vec2(h.x(), -h.y()), X_WB * Vec2(h.x(), h.y()), X_WB * Vec2(-h.x(), h.y()),
          X_WB * Vec2(-h.x(), -h.y())};
}
/// Corners of an obstacle, likewise.
[[nodiscard]] inline std::vector<Vec2> box_corners(const ObstacleDescription& box) {
  return box_corners({box.center.x(), box.center.y(), box.yaw_rad}, box.size);
}

/// A charging dock: a marked place on the floor, no obstacle.
struct DockDescription {
  std::string name;          ///< unique among docks
  Pose pose;                 ///< X_WD: centre; a docked robot faces along its x axis
  Vec2 size = {0.24, 0.24};  ///< along its own axes [m]
};

/// A wall that came from a map: a closed outline, solid on its left, as vertices in W [m].
/// The outer ring of a solid region runs counter-clockwise, the ring of a hole in it clockwise.
struct WallLoop {
  std::vector<Vec2> vertices;
};

/// Where the walls of an arena drawn as a picture came from (the loops are in ArenaDescription).
struct MapDescription {
  std::string image;                ///< file, relative to the world file
  double resolution_m = 0.05;       ///< side of a pixel [m]
  Vec2 origin = Vec2::Zero();       ///< W position of the picture's bottom left corner [m]
  double occupied_threshold = 0.5;  ///< pixels darker than this share of white are walls, (0, 1)
  double simplify_m = 0.0;  ///< outlines may be straightened by so much [m]; 0: pixel by pixel
};

/// The room: floor from `origin` to `origin + size`, borders round it unless turned off.
struct ArenaDescription {
  std::string preset;             ///< "syrotek", or "" for an arena described in full
  Vec2 origin = Vec2::Zero();     ///< bottom left corner of the floor in W [m]
  Vec2 size = {3.42, 3.72};       ///< [m]
  bool border = true;             ///< walls round the floor
  double border_height_m = 0.16;  ///< [m]
  std::vector<ObstacleDescription> obstacles;
  std::vector<DockDescription> docks;
  std::vector<ObstacleDescription> dock_separators;  ///< static boxes beside docks (brown)
  std::optional<MapDescription> map;
  std::vector<WallLoop> walls;  ///< of the map, merged into few edges
};

/// Lockstep: time advances when all clients wait in Read(). Paced: real time times a factor.
enum class TimeMode { kLockstep, kPaced };

/// How simulated time runs: its step, its end and its relation to the clock on the wall.
struct SimulationDescription {
  SimTime step_ns = 10'000'000;  ///< length of a step [ns], > 0
  std::uint64_t seed = 1;
  std::optional<SimTime> duration_ns;  ///< the run ends then; none: it goes on
  TimeMode time_mode = TimeMode::kLockstep;
  bool time_mode_given = false;  ///< somebody chose it; else a host may change it, see
                                 ///< playerlike::PreferRealTimeRequest
  double time_factor = 1.0;      ///< paced: simulated seconds a wall second, > 0
  int start_gate_clients = 1;    ///< the clock waits until so many clients have joined, >= 1
  bool objects_locked = false;   ///< clients may look at robots and obstacles by name, but not move
                                 ///< or change them
  bool own_sensors_only = false;  ///< for contests: clients read their own robots' sensors only,
                                  ///< and neither objects by name nor the map
};

/// A sensor or actuator of a robot.
struct DeviceDescription {
  std::string name;  ///< unique in its robot, e.g. "laser"; path is ROBOT.NAME
  std::string type;  ///< a name in the device table (sim/devices/builtin.h), e.g. "laser"
  std::any params;   ///< that type's params struct, e.g. LaserParams
};

/// A driver of the client side (e.g. SND) that a host runs for a robot; settings as text, which
/// libsim carries but does not read.
struct DriverDescription {
  std::string type;
  std::map<std::string, std::string> settings;
};

struct RobotModel;

/// A robot as the world starts: model, place, devices and how clients reach it.
struct RobotDescription {
  std::string name;           ///< unique in the world; letters, digits, _ and -
  std::string model = "s1r";  ///< see find_robot_model()
  Pose pose;                  ///< X_WB at the start
  Colour colour{0xff, 0x88, 0x00, 0xff};
  int port = 0;  ///< Player port; the reader gives the one that robots share, else 6665, ...
  std::vector<DeviceDescription> devices;  ///< in order of name
  std::map<std::string, int> proxies;      ///< interface name -> index on port 4000, and of the
                                           ///< first device on a port that robots share
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< interface name -> names of devices, by index on the robot's own port; those
                   ///< not named follow in the usual order
  std::vector<DriverDescription> drivers;
  int fiducial = 0;  ///< what fiducial devices of other robots read of it; 0: they do not see it
};

/// How the grid-map is shown in pictures, films and windows.
enum class ViewMode {
  kGround,      ///< it lies on the floor; obstacles and robots stand on it
  kMiniMap,     ///< in a corner of the picture of the arena
  kFullScreen,  ///< instead of the arena, its cells crisp, the robots on it
};

/// The most cells along a side of the grid-map.
inline constexpr int kMaxCanvasSide = 8192;

/// The grid-map that robots draw on with their pens.
struct CanvasDescription {
  int width = 172;                         ///< cells, 1..kMaxCanvasSide
  int height = 186;                        ///< cells, 1..kMaxCanvasSide
  double cell_size_m = 0.02;               ///< [m]
  Vec2 origin = Vec2::Zero();              ///< W position of the canvas's bottom left corner [m]
  ViewMode view_mode = ViewMode::kGround;  ///< at the start
  bool view_mode_locked = false;           ///< nobody may change it while running
};

/// A whole world, as a file describes it.
struct WorldDescription {
  std::string name = "unnamed";
  std::string description;  ///< for people, a sentence; "": none
  std::string file;         ///< where it was read from, "" if nowhere
  ArenaDescription arena;
  SimulationDescription simulation;
  /// The kinds of robot that are not the library's own, by what RobotDescription::model says.
  std::map<std::string, std::shared_ptr<const RobotModel>> models;
  std::vector<RobotDescription> robots;
  int robots_on_port = 0;  ///< Player port that robots without one of their own share; 0: none
  CanvasDescription canvas;
};

}  // namespace sim
