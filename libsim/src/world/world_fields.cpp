// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The fields of worlds. Fields that are read-only are read by the format of another field, or by
// the reader of worlds (io/world_io.cpp), because they depend on other parts of the world.
#include "world/world_fields.h"

#include "sim/world/description.h"
#include "sim/world/limits.h"

namespace sim {
namespace {

constexpr double kGreatestHeight_m = 10.0;  // of obstacles and walls
constexpr double kAnyAngle_deg = 3600.0;
constexpr int kFirstFreePort = 1024;  // lower ports are reserved by the system
constexpr int kLastPort = 65535;

/// A point of the floor [m].
template <auto kMember>
[[nodiscard]] constexpr Field floor_point_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).within(-kFarthest_m, kFarthest_m);
}
/// The sides of a floor, or of something on it [m].
template <auto kMember>
[[nodiscard]] constexpr Field floor_size_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).within(kLeastLength_m, kGreatestLength_m);
}
template <auto kMember>
[[nodiscard]] constexpr Field solid_height_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).within(kLeastLength_m, kGreatestHeight_m);
}
template <auto kMember>
[[nodiscard]] constexpr Field tags_field() {
  return field<kMember>(
             "tags", "",
             "properties that sensors look for: thermometers, semantic cameras, proximity")
      .counting(0, 64)
      .in_format(io::kTagsFormat);
}
template <auto kMember>
[[nodiscard]] constexpr Field fiducial_number_field() {
  return field<kMember>("fiducial", "", "what fiducial devices read of it; 0: they do not see it")
      .within(0, std::numeric_limits<std::int32_t>::max());
}

// --- The arena

constexpr const char* kObstacleTypes[] = {"static", "dynamic"};
constexpr const char* kObstacleStates[] = {"extended", "retracted"};
constexpr const char* kObstacleShapes[] = {"box", "circle", "polygon"};
constexpr const char* kIfBlocked[] = {"refuse", "wait"};

constexpr Field kObstacleFields[] = {
    field<&ObstacleDescription::name>("name", "", "unique among obstacles and separators")
        .as_name(),
    floor_point_field<&ObstacleDescription::center>(
        "center", "middle of the box or circle, or place of the origin of the outline")
        .needed("[x, y] of the middle of the box, in m"),
    field<&ObstacleDescription::shape>(
        "shape", "", "box: with a size; circle: with a radius; polygon: with an outline")
        .one_of(kObstacleShapes)
        .in_format(io::kShapeFormat),
    floor_size_field<&ObstacleDescription::size>("size", "length along its own x and y axis")
        .as_read_only(),
    floor_point_field<&ObstacleDescription::outline>("outline",
                                                     "points [x, y] round a polygon, in order")
        .counting(3, kMostOutlineVertices)
        .as_read_only(),
    field<&ObstacleDescription::yaw_rad>("yaw_deg", "degrees",
                                         "turn about the center, counter-clockwise"),
    solid_height_field<&ObstacleDescription::height_m>("height", "height above the floor"),
    field<&ObstacleDescription::type>("type", "",
                                      "dynamic: can be extended and retracted while running")
        .one_of(kObstacleTypes),
    field<&ObstacleDescription::state>("state", "", "at the start")
        .one_of(kObstacleStates)
        .in_format(io::kStateFormat),
    field<&ObstacleDescription::rise_speed_mps>(
        "rise_speed", "m/s", "of a dynamic one: how fast it rises and sinks; 0: at once")
        .within(0.0, kMaxRiseSpeed_mps)
        .in_format(io::kDynamicFormat),
    field<&ObstacleDescription::when_blocked>(
        "when_blocked", "",
        "of a dynamic one that is to be extended while a robot stands on it: it is refused, or it "
        "waits until the robot has left")
        .one_of(kIfBlocked)
        .in_format(io::kDynamicFormat),
    fiducial_number_field<&ObstacleDescription::fiducial>(),
    tags_field<&ObstacleDescription::tags>(),
    field<&ObstacleDescription::portable>("portable", "", "gripper devices can take and carry it"),
    field<&ObstacleDescription::solid>(
        "solid", "", "false: nothing collides with it, as with a marking on the floor"),
    field<&ObstacleDescription::colour>("colour", "",
                                        "blobfinder devices see blocks that have one"),
    field<&ObstacleDescription::motion>("motion", "", "it moves by itself")
        .in_format(io::kMotionFormat)
        // A drive that stands was added for the controller.
        .with<&Field::find>(+[](const void* object) -> const void* {
          const auto& motion = static_cast<const ObstacleDescription*>(object)->motion;
          return motion && motion->law != MotionLaw::kStand ? &*motion : nullptr;
        }),
    field<&ObstacleDescription::mass_kg>("mass", "kg", "without a motion: robots can push it")
        .within(kLeastMass_kg, kGreatestMass_kg),
    field<&ObstacleDescription::friction>(
        "friction", "", "coefficient of friction with the floor of an obstacle that can be pushed")
        .within(0.0, 10.0)
        .in_format(io::kFrictionFormat),
    field<&ObstacleDescription::bottom_m>(
        "bottom", "m", "of an obstacle that neither moves nor rises: height of its lower side")
        .within(0.0, kGreatestHeight_m)
        .in_format(io::kBottomFormat),
    field<&ObstacleDescription::carried_by>("carried_by").as_read_only(),
    field<&ObstacleDescription::present_height_m>("present_height").as_read_only(),
};

constexpr Field kDockFields[] = {
    field<&DockDescription::name>("name", "", "unique among docks").as_name(),
    field<&DockDescription::pose>("pose", "m, degrees",
                                  "its middle, and where a docked robot looks")
        .needed("{\"x\", \"y\", \"yaw_deg\"} of its middle"),
    floor_size_field<&DockDescription::size>("size", "length along its own axes"),
};

constexpr Field kMapFields[] = {
    field<&MapDescription::image>("image", "", "PNG or PGM file, relative to the world file")
        .needed("a PNG or PGM file, relative to this file"),
    field<&MapDescription::resolution_m>("resolution", "m", "side of a pixel; not with a size")
        .within(kLeastLength_m, 10.0)
        .in_format(io::kMapPlaceFormat),
    floor_point_field<&MapDescription::origin>(
        "origin", "position of the picture's bottom left corner; not with a size")
        .as_read_only(),
    floor_size_field<&MapDescription::size>("size", "the picture is stretched to this size")
        .as_read_only(),
    field<&MapDescription::pose>("pose", "m, degrees", "of the middle of a picture with a size")
        .as_read_only(),
    field<&MapDescription::occupied_threshold>("occupied_threshold", "",
                                               "pixels darker than this share of white are walls")
        .above(0.0, 1.0),
    field<&MapDescription::simplify_m>(
        "simplify", "m", "outlines are straightened where that moves no corner farther than this")
        .within(0.0, 10.0),
    solid_height_field<&MapDescription::height_m>("height",
                                                  "of the walls; left out: every sensor sees them"),
    field<&MapDescription::solid>("solid", "", "false: robots drive through the walls"),
};

constexpr Field kWallFields[] = {
    field<&WallLoop::vertices>("vertices", "m"),
    field<&WallLoop::height_m>("height", "m"),
    field<&WallLoop::solid>("solid"),
};

constexpr Field kArenaFields[] = {
    field<&ArenaDescription::preset>("preset", "", "a room that is built in")
        .as_read_only()
        .not_identity(),
    floor_size_field<&ArenaDescription::size>("size", "length of the floor along x and y"),
    floor_point_field<&ArenaDescription::origin>("origin", "bottom left corner of the floor"),
    field<&ArenaDescription::maps>("map", "", "a floor plan, or a list of them")
        .counting(0, 1000)
        .as_read_only()
        .not_identity(),
    field<&ArenaDescription::border>("border", "", "whether walls stand round the floor"),
    solid_height_field<&ArenaDescription::border_height_m>("border_height", "height of the border"),
    field<&ArenaDescription::obstacles>("obstacles", "",
                                        "blocks on the floor: boxes, circles and polygons")
        .counting(0, 100'000)
        .as_read_only(),
    field<&ArenaDescription::docks>("docks", "", "charging places, marked on the floor")
        .counting(0, 100'000),
    field<&ArenaDescription::dock_separators>("dock_separators", "", "static boxes between docks")
        .counting(0, 100'000)
        .as_read_only(),
    field<&ArenaDescription::walls>("walls").as_read_only(),
};

// --- Time and canvas

constexpr const char* kTimeModes[] = {"lockstep", "paced"};
constexpr const char* kRealisms[] = {"ideal", "course", "real"};
constexpr const char* kPrivacies[] = {"none", "own"};
constexpr Field kSimulationFields[] = {
    field<&SimulationDescription::step_ns>("step", "s", "length of a simulation step")
        .seconds({1e-4, 0.1, false, "s"}),
    field<&SimulationDescription::seed>("seed", "", "of all random numbers").not_identity(),
    field<&SimulationDescription::duration_ns>(
        "duration", "s", "the run ends after so many simulated seconds; null: it does not end")
        .seconds({0.0, 1e9, true, "s"})
        .or_null()
        .not_identity(),
    field<&SimulationDescription::start_gate_clients>(
        "clients", "", "start gate: the clock waits until this number of clients have joined")
        .within(1, 1000),
    field<&SimulationDescription::objects_locked>(
        "lock_objects", "",
        "clients may look at robots and obstacles by name, but not move or change them"),
    field<&SimulationDescription::realism>("realism", "",
                                           "noise, drift, slip and latency of all devices")
        .one_of(kRealisms),
    field<&SimulationDescription::own_sensors_only>(
        "privacy", "", "for contests; own: a client reads the sensors of its own robot only")
        .one_of(kPrivacies, false),
    field<&SimulationDescription::time_mode>(
        "time", "", "lockstep, real, or how many times as fast as the clock")
        .one_of(kTimeModes)
        .in_format(io::kTimeFormat)
        .not_identity(),
    field<&SimulationDescription::time_factor>("time_factor").as_read_only().not_identity(),
    field<&SimulationDescription::time_mode_given>("time_given").as_read_only().not_identity(),
};

constexpr const char* kViewModeWords[] = {"ground", "mini-map", "full-screen"};
constexpr Field kCanvasFields[] = {
    // The limits of the physics do not apply to cells.
    field<&CanvasDescription::cell_size_m>("cell_size", "m", "side of a cell").within(1e-4, 10.0),
    floor_point_field<&CanvasDescription::origin>("origin", "position of the bottom left corner"),
    field<&CanvasDescription::width>("size", "cells", "[columns, rows]")
        .within(1, kMaxCanvasSide)
        .in_format(io::kCanvasSizeFormat),
    field<&CanvasDescription::height>("rows", "cells").within(1, kMaxCanvasSide).as_read_only(),
    field<&CanvasDescription::view_mode>("view_mode", "", "how pictures show it")
        .one_of(kViewModeWords)
        .not_identity(),
    field<&CanvasDescription::view_mode_locked>("lock_view_mode", "",
                                                "nobody may change the view mode"),
};

// --- Robots

constexpr Field kElevationFields[] = {
    field<&Elevation::z_m>("z", "m", "height of the robot's origin over the floor")
        .within(-kFarthest_m, kFarthest_m),
    field<&Elevation::roll_rad>("roll_deg", "degrees", "about its x axis")
        .within(-kAnyAngle_deg, kAnyAngle_deg),
    field<&Elevation::pitch_rad>("pitch_deg", "degrees", "about its y axis; positive: nose down")
        .within(-kAnyAngle_deg, kAnyAngle_deg),
};

using Real = RealRobotDescription;
constexpr const char* kRealDrives[] = {"real", "both"};
constexpr const char* kOnLost[] = {"continue", "end", "reconnect"};
constexpr Field kRealFields[] = {
    field<&Real::server>(
        "server", "",
        "player://HOST[:PORT] for a Player server, tcp://HOST[:PORT] for a Playpen "
        "server")
        .needed(kRealServerExpected)
        .in_format(io::kRealServerFormat),
    field<&Real::port>("port", "", "Player port of the real robot at a Playpen server")
        .within(1, kLastPort),
    field<&Real::drive>("drive", "",
                        "real: commands go to the real robot only; both: also to a simulated ghost")
        .one_of(kRealDrives),
    field<&Real::on_lost>("on_lost", "", "what happens when the connection is lost")
        .one_of(kOnLost),
    field<&Real::watchdog_s>("watchdog", "s",
                             "time without a message after which the real robot is stopped")
        .within(0.05, 600.0),
    field<&Real::take_over>("take_over", "", "from another client that is in charge of it"),
    field<&Real::pose_interface>("pose", "", "device of the real robot that says where it is")
        .in_format(io::kRealPoseFormat),
    field<&Real::pose_index>("pose_index").as_read_only(),
    field<&Real::X_WF>("offset", "m, degrees", "pose of that device's frame in the world"),
};

constexpr Field kDriverFields[] = {
    field<&DriverDescription::type>("type", "", "which driver").as_name(),
    field<&DriverDescription::settings>("settings"),
};

// The devices have tables of their own (sim/devices/builtin.h).
constexpr Field kRobotFields[] = {
    field<&RobotDescription::name>("name", "", "unique").as_name(),
    field<&RobotDescription::model>("model", "", "kind of robot: a model, or a model's file"),
    field<&RobotDescription::pose>("pose", "m, degrees",
                                   "at the start; left out: a free place is found"),
    field<&RobotDescription::elevation>(
        "elevation", "", "height and inclination at the start; the physics ignores them"),
    tags_field<&RobotDescription::tags>(),
    field<&RobotDescription::colour>("colour", "", "default: each robot another"),
    field<&RobotDescription::port>("port", "", "Player port, unique, not 4000")
        .within(kFirstFreePort, kLastPort)
        .in_format(io::kPortFormat),
    field<&RobotDescription::drivers>("drivers", "", "drivers that the host runs for this robot")
        .counting(0, 100)
        .as_read_only(),
    field<&RobotDescription::proxies>("proxies", "",
                                      "index of this robot's device on port 4000, by interface")
        .as_read_only(),
    fiducial_number_field<&RobotDescription::fiducial>(),
    field<&RobotDescription::real>("real", "", "the real robot that this one mirrors"),
    field<&RobotDescription::interfaces>(
        "interfaces", "", "devices of an interface in the order of their index on its own port")
        .as_read_only(),
};

// The models are parts of the robots.
constexpr Field kWorldFields[] = {
    field<&WorldDescription::name>("name", "", "name of the world, for reports and titles"),
    field<&WorldDescription::description>("description", "",
                                          "what the world is for, a sentence for people")
        .not_identity(),
    field<&WorldDescription::arena>("arena", "", "the room").as_read_only(),
    field<&WorldDescription::simulation>("simulation", "", "how time runs").as_read_only(),
    field<&WorldDescription::canvas>("canvas", "", "the grid map that robots draw on")
        .as_read_only(),
    field<&WorldDescription::robots_on_port>(
        "robots_on_port", "", "Player port of all robots that have none of their own")
        .within(kFirstFreePort, kLastPort)
        .in_format(io::kPortFormat)
        .as_read_only(),
    field<&WorldDescription::robots>("robots", "", "the robots")
        .counting(0, kMostRobots)
        .as_read_only(),
    field<&WorldDescription::controller>("controller", "",
                                         "the arena controller, which changes the arena")
        .as_read_only(),
};

}  // namespace

SIM_FIELDS(ObstacleDescription, kObstacleFields)
SIM_FIELDS(DockDescription, kDockFields)
SIM_FIELDS(MapDescription, kMapFields)
SIM_FIELDS(WallLoop, kWallFields)
SIM_FIELDS(ArenaDescription, kArenaFields)
SIM_FIELDS(SimulationDescription, kSimulationFields)
SIM_FIELDS(CanvasDescription, kCanvasFields)
SIM_FIELDS(Elevation, kElevationFields)
SIM_FIELDS(RealRobotDescription, kRealFields)
SIM_FIELDS(DriverDescription, kDriverFields)
SIM_FIELDS(RobotDescription, kRobotFields)
SIM_FIELDS(WorldDescription, kWorldFields)

}  // namespace sim
