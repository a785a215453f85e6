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
  return field<kMember>("tags", "",
                        "properties that sensors look for: [proximity](devices/proximity.md), "
                        "[semantic_camera](devices/semantic_camera.md), "
                        "[thermometer](devices/thermometer.md)")
      .counting(0, 64)
      .in_format(io::kTagsFormat);
}
template <auto kMember>
[[nodiscard]] constexpr Field fiducial_number_field() {
  return field<kMember>("fiducial", "",
                        "number that [fiducial](devices/fiducial.md) devices read of it; 0: they "
                        "do not see it")
      .within(0, std::numeric_limits<std::int32_t>::max());
}

// --- The arena

constexpr const char* kObstacleTypes[] = {"static", "dynamic"};
constexpr const char* kObstacleStates[] = {"extended", "retracted"};
constexpr const char* kObstacleShapes[] = {"box", "circle", "polygon"};
constexpr const char* kIfBlocked[] = {"refuse", "wait"};

constexpr Field kObstacleFields[] = {
    field<&ObstacleDescription::name>("name", "", "unique among obstacles and separators")
        .as_name()
        .defaults_to("the first free of o1, o2, ...; of separators: separator1, ..."),
    floor_point_field<&ObstacleDescription::center>(
        "center", "its middle in the world; of a polygon the place of its own origin")
        .needed("[x, y] of the middle of the box, in m"),
    field<&ObstacleDescription::shape>(
        "shape", "", "box: with a `size`; circle: with a `radius`; polygon: with an `outline`")
        .one_of(kObstacleShapes)
        .in_format(io::kShapeFormat),
    floor_size_field<&ObstacleDescription::size>(
        "size", "of a box: length and width along its own x and y axis")
        .read_apart(),
    key_of_files<double>("radius", "m", "of a circle, which needs it")
        .within(kLeastLength_m, 0.5 * kGreatestLength_m),
    floor_point_field<&ObstacleDescription::outline>(
        "outline",
        "of a polygon, which needs it: its corners [x, y] in its own frame, in order; it may be "
        "concave, but must not cross or touch itself")
        .counting(3, kMostOutlineVertices)
        .read_apart(),
    field<&ObstacleDescription::yaw_rad>("yaw_deg", "degrees",
                                         "its rotation about `center`, counter-clockwise"),
    solid_height_field<&ObstacleDescription::height_m>(
        "height",
        "height above the floor; a sensor that is mounted above it looks over the block, one at "
        "this very height, within 1 µm, sees the block"),
    field<&ObstacleDescription::type>("type", "",
                                      "dynamic: can be extended and retracted during a run")
        .one_of(kObstacleTypes),
    field<&ObstacleDescription::state>("state", "",
                                       "at the start; only dynamic obstacles can be retracted")
        .one_of(kObstacleStates)
        .in_format(io::kStateFormat),
    field<&ObstacleDescription::rise_speed_mps>(
        "rise_speed", "m/s",
        "of a dynamic one: how fast it "
        "[rises and sinks](arena_controller.md#blocks-that-take-their-time); 0: at once")
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
    field<&ObstacleDescription::portable>(
        "portable", "",
        "[grippers](devices/gripper.md) and [hands](devices/hand.md) can take and carry it, and "
        "clients may put it off the floor"),
    field<&ObstacleDescription::solid>(
        "solid", "",
        "`false`: nothing collides with it, as with a marking on the floor, and it is not in the "
        "true map; sensors outside of it see it up to its `height`"),
    field<&ObstacleDescription::colour>(
        "colour", "", "[blobfinder](devices/blobfinder.md) devices see only blocks that have one")
        .defaults_to("in pictures that of its type"),
    field<&ObstacleDescription::motion>(
        "motion", "",
        "it [moves](moving_obstacles.md#motions) by itself; not for dynamic or portable ones")
        .in_format(io::kMotionFormat)
        // A drive that stands was added for the controller.
        .with<&Field::find>(+[](const void* object) -> const void* {
          const auto& motion = static_cast<const ObstacleDescription*>(object)->motion;
          return motion && motion->law != MotionLaw::kStand ? &*motion : nullptr;
        }),
    field<&ObstacleDescription::mass_kg>("mass", "kg",
                                         "without a `motion`: robots can [push "
                                         "it](moving_obstacles.md#obstacles-that-can-be-pushed)")
        .within(kLeastMass_kg, kGreatestMass_kg)
        .defaults_to("10 with a `motion`; without, it stands fast"),
    field<&ObstacleDescription::friction>(
        "friction", "",
        "coefficient of friction with the floor of an obstacle that can be pushed; only with "
        "`mass` and without `motion`")
        .within(0.0, 10.0)
        .in_format(io::kFrictionFormat),
    field<&ObstacleDescription::bottom_m>(
        "bottom", "m",
        "height of its lower side, less than `height`: lasers, sonars and other sensors of "
        "distances look under it; not of obstacles that move, rise or are carried. Robots do not "
        "drive under it unless it is not `solid`, and cameras draw it down to the floor")
        .within(0.0, kGreatestHeight_m)
        .in_format(io::kBottomFormat),
    field<&ObstacleDescription::carried_by>("carried_by").as_read_only(),
    field<&ObstacleDescription::present_height_m>("present_height").as_read_only(),
};

constexpr Field kDockFields[] = {
    field<&DockDescription::name>("name", "", "unique among docks")
        .as_name()
        .defaults_to("the first free of dock1, dock2, ..."),
    field<&DockDescription::pose>("pose", "m, degrees",
                                  "its middle, and the heading of a docked robot")
        .needed("{\"x\", \"y\", \"yaw_deg\"} of its middle"),
    floor_size_field<&DockDescription::size>("size", "length along its own axes"),
};

constexpr Field kMapFields[] = {
    field<&MapDescription::image>(
        "image", "", "PNG or PGM file, relative to the world file; at most 8192 pixels a side")
        .needed("a PNG or PGM file, relative to this file"),
    field<&MapDescription::resolution_m>("resolution", "m", "side of a pixel; not with a `size`")
        .within(kLeastLength_m, 10.0)
        .in_format(io::kMapPlaceFormat),
    floor_point_field<&MapDescription::origin>(
        "origin", "position of the picture's bottom left corner; not with a `size`")
        .defaults_to("the arena's `origin`")
        .read_apart(),
    floor_size_field<&MapDescription::size>("size", "the picture is stretched to this size")
        .read_apart(),
    field<&MapDescription::pose>("pose", "m, degrees",
                                 "of the middle of a picture with a `size`, which it needs")
        .defaults_to("the world's origin")
        .read_apart(),
    field<&MapDescription::occupied_threshold>("occupied_threshold", "",
                                               "pixels darker than this share of white are walls")
        .above(0.0, 1.0),
    field<&MapDescription::simplify_m>(
        "simplify", "m",
        "straightens outlines, but moves no corner farther than this, so slanted and round walls "
        "have no steps; the size of a pixel is a good value; 0: pixel by pixel")
        .within(0.0, 10.0),
    solid_height_field<&MapDescription::height_m>(
        "height", "of the walls; sensors above this height look over them")
        .defaults_to("every sensor sees them"),
    field<&MapDescription::solid>("solid", "",
                                  "`false`: robots drive through the walls; sensors see them, and "
                                  "they are in the true map"),
};

constexpr Field kWallFields[] = {
    field<&WallLoop::vertices>("vertices", "m"),
    field<&WallLoop::height_m>("height", "m"),
    field<&WallLoop::solid>("solid"),
};

constexpr Field kArenaFields[] = {
    field<&ArenaDescription::preset>(
        "preset", "",
        "a room that is built in: its floor, blocks and docks are there, and what you list is "
        "added; not with `size`, `origin` or `map`")
        .read_apart()
        .in_format(io::kPresetFormat)
        .not_identity(),
    floor_size_field<&ArenaDescription::size>(
        "size", "length of the floor along x and y; with a map the default is the picture's"),
    floor_point_field<&ArenaDescription::origin>(
        "origin", "bottom left corner of the floor; with a map the default is the map's"),
    field<&ArenaDescription::maps>("map", "", "a floor plan, or a list of them")
        .counting(0, 1000)
        .in_format(io::kMapsFormat)
        .read_apart()
        .not_identity(),
    field<&ArenaDescription::border>("border", "", "whether walls enclose the floor"),
    solid_height_field<&ArenaDescription::border_height_m>("border_height", "height of the border"),
    field<&ArenaDescription::obstacles>("obstacles", "",
                                        "blocks on the floor: boxes, circles and polygons")
        .counting(0, 100'000)
        .read_apart(),
    field<&ArenaDescription::docks>("docks", "", "charging places, marked on the floor")
        .counting(0, 100'000),
    field<&ArenaDescription::dock_separators>("dock_separators", "", "static boxes between docks")
        .counting(0, 100'000)
        .in_format(io::kSeparatorsFormat)
        .read_apart(),
    key_of_files<std::vector<std::string>>(
        "extended", "", "names of dynamic obstacles that are extended at the start"),
    key_of_files<std::vector<std::string>>(
        "retracted", "", "names of dynamic obstacles that are retracted at the start"),
    field<&ArenaDescription::walls>("walls").as_read_only(),
};

// --- Time and canvas

constexpr const char* kTimeModes[] = {"lockstep", "paced"};
constexpr const char* kRealisms[] = {"ideal", "course", "real"};
constexpr const char* kPrivacies[] = {"none", "own"};
constexpr Field kSimulationFields[] = {
    field<&SimulationDescription::step_ns>("step", "s", "length of a simulation step")
        .seconds({1e-4, 0.1, false, "s"}),
    field<&SimulationDescription::seed>(
        "seed", "", "of all random numbers; the same seed, world and program give the same run")
        .not_identity(),
    field<&SimulationDescription::duration_ns>(
        "duration", "s", "the run ends after so many simulated seconds; `null`: it does not end")
        .seconds({0.0, 1e9, true, "s"})
        .or_null()
        .not_identity(),
    field<&SimulationDescription::start_gate_clients>(
        "clients", "", "start gate: the clock waits until this number of clients have joined")
        .within(1, 1000),
    field<&SimulationDescription::objects_locked>(
        "lock_objects", "",
        "programs may read the state of robots and obstacles [by name](simulation.md), but not "
        "move or change them, nor switch timers and traps"),
    field<&SimulationDescription::realism>(
        "realism", "",
        "noise, drift, slip and latency of all devices; ideal: none; course: as the settings say; "
        "real: settings that are left out get the [figures of real devices](realism.md)")
        .one_of(kRealisms),
    field<&SimulationDescription::own_sensors_only>(
        "privacy", "",
        "for contests; own: a client reads the sensors of its own robot only, and neither objects "
        "by name nor the map nor the state and events of the arena ([rules](remote.md#contests))")
        .one_of(kPrivacies, false),
    field<&SimulationDescription::time_mode>(
        "time", "",
        "lockstep: simulated time stands still while programs compute; real: it follows the wall "
        "clock; a number: so many times as fast as the clock")
        .one_of(kTimeModes)
        .in_format(io::kTimeFormat)
        .not_identity(),
    field<&SimulationDescription::time_factor>("time_factor", "times real time")
        .above(0.0, 1e6)
        .as_read_only()
        .not_identity(),
    field<&SimulationDescription::time_mode_given>("time_given").as_read_only().not_identity(),
};

constexpr const char* kViewModeWords[] = {"ground", "mini-map", "full-screen"};
constexpr Field kCanvasFields[] = {
    // The limits of the physics do not apply to cells.
    field<&CanvasDescription::cell_size_m>(
        "cell_size", "m", "side of a cell; for floors over 80 m the default is coarser")
        .within(1e-4, 10.0),
    floor_point_field<&CanvasDescription::origin>("origin", "position of the bottom left corner")
        .defaults_to("the floor's"),
    field<&CanvasDescription::width>("size", "cells", "[columns, rows]")
        .within(1, kMaxCanvasSide)
        .defaults_to("what covers the floor, rounded up to even numbers: `[172, 186]` for SyRoTek")
        .in_format(io::kCanvasSizeFormat),
    field<&CanvasDescription::height>("rows", "cells").within(1, kMaxCanvasSide).as_read_only(),
    field<&CanvasDescription::view_mode>(
        "view_mode", "",
        "how pictures show it: on the floor, in a corner, or instead of the arena with the robots "
        "on it")
        .one_of(kViewModeWords)
        .not_identity(),
    field<&CanvasDescription::view_mode_locked>(
        "lock_view_mode", "", "`true`: no option, key or program can change the view mode"),
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
        "`player://HOST[:PORT]`: a Player server; `tcp://HOST[:PORT]`: a Playpen server")
        .needed(kRealServerExpected)
        .in_format(io::kRealServerFormat),
    field<&Real::port>("port", "", "Player port of the real robot at a Playpen server")
        .within(1, kLastPort)
        .defaults_to("the robot's own port"),
    field<&Real::drive>("drive", "",
                        "real: commands go to the real robot only; both: also to a simulated ghost")
        .one_of(kRealDrives),
    field<&Real::on_lost>("on_lost", "",
                          "what happens when the connection is lost: the run goes on, ends, or "
                          "makes the connection again")
        .one_of(kOnLost),
    field<&Real::watchdog_s>(
        "watchdog", "s",
        "time without a message after which a Playpen server stops the real robot; after twice as "
        "long the connection is lost")
        .within(0.05, 600.0),
    field<&Real::take_over>(
        "take_over", "",
        "whether to take over the robot from another client that is in charge of it"),
    field<&Real::pose_interface>(
        "pose", "",
        "device of the real robot that says where it is: `position2d:INDEX` or `localize:INDEX`")
        .defaults_to("`\"position2d:0\"`")
        .in_format(io::kRealPoseFormat),
    field<&Real::pose_index>("pose_index").as_read_only(),
    field<&Real::X_WF>("offset", "m, degrees", "pose of that device's frame in the world")
        .defaults_to("the world's frame"),
};

constexpr Field kDriverFields[] = {
    field<&DriverDescription::type>("type", "", "which driver, e.g. `snd`")
        .as_name()
        .needed("which driver, for example \"snd\""),
    field<&DriverDescription::settings>("settings", "", "its settings have keys of their own")
        .read_apart()
        .in_format(io::kDriverSettingsFormat),
};

// The devices have tables of their own (sim/devices/builtin.h).
constexpr Field kRobotFields[] = {
    field<&RobotDescription::name>("name", "", "unique")
        .as_name()
        .defaults_to("r1, r2, ... by place in the list"),
    field<&RobotDescription::model>(
        "model", "",
        "kind of robot: one of [Playpen's models](robot_models.md), or a model's file, with a `/` "
        "or `.json` in its name, relative to this file"),
    field<&RobotDescription::pose>(
        "pose", "m, degrees", "middle of the axle and heading at the start; a part left out is 0")
        .defaults_to("a free place near the middle; in the SyRoTek arena on the road by the docks"),
    field<&RobotDescription::elevation>(
        "elevation", "",
        "[height and inclination](world_format.md#elevation) at the start; the physics ignores "
        "them"),
    tags_field<&RobotDescription::tags>(),
    field<&RobotDescription::colour>("colour", "", "in pictures and for cameras")
        .defaults_to("each robot another, the first `#ff8800`"),
    field<&RobotDescription::port>("port", "", "Player port, unique, not 4000")
        .within(kFirstFreePort, kLastPort)
        .defaults_to("`robots_on_port`, otherwise 6665, 6666, ...")
        .in_format(io::kPortFormat),
    key_of_files<std::map<std::string, std::string>>(
        "devices", "",
        "settings of the model's devices by name (s1r: laser, motion, odometry, pen, pose), and "
        "further devices, with a `type` unless the name is one; `null` or `false` removes one")
        .defaults_to("the model's devices")
        .in_format(io::kDevicesFormat),
    field<&RobotDescription::drivers>(
        "drivers", "", "[drivers](drivers.md) that the host runs for this robot, with settings")
        .counting(0, 100)
        .read_apart(),
    field<&RobotDescription::proxies>(
        "proxies", "",
        "index of this robot's device on port 4000, and of its first device on a port that robots "
        "share, by interface: `{\"laser\": 0}`")
        .defaults_to("the robot's number")
        .in_format(io::kProxiesFormat)
        .read_apart(),
    fiducial_number_field<&RobotDescription::fiducial>(),
    field<&RobotDescription::real>("real", "", "the real robot that this one [mirrors](mirror.md)"),
    field<&RobotDescription::interfaces>(
        "interfaces", "",
        "names of devices of an [interface](world_format.md#interfaces) in the order of their "
        "index on the robot's own port: `{\"ranger\": [\"sonar\", \"laser\"]}`")
        .defaults_to("the usual order; those not named follow in it")
        .in_format(io::kInterfacesFormat)
        .read_apart(),
};

// The models are parts of the robots.
constexpr Field kWorldFields[] = {
    field<&WorldDescription::name>("name", "", "name of the world, for reports and titles"),
    field<&WorldDescription::description>(
        "description", "", "what the world is for, a sentence for people; `playpen list` shows it")
        .not_identity(),
    field<&WorldDescription::arena>("arena", "", "the room")
        .defaults_to("the preset `syrotek`")
        .read_apart(),
    field<&WorldDescription::simulation>("simulation", "", "how time runs").read_apart(),
    field<&WorldDescription::canvas>("canvas", "", "the grid map that robots draw on with pens")
        .defaults_to("covers the floor")
        .read_apart(),
    field<&WorldDescription::robots_on_port>(
        "robots_on_port", "",
        "[Player port of all robots](world_format.md#robots_on_port) that have none of their own, "
        "not 4000: index 0 of an interface is the first robot's")
        .within(kFirstFreePort, kLastPort)
        .defaults_to("each robot has a port")
        .in_format(io::kPortFormat)
        .read_apart(),
    field<&WorldDescription::robots>("robots", "", "the robots; an empty list: none")
        .counting(0, kMostRobots)
        .defaults_to("one S1R at a free place")
        .read_apart(),
    field<&WorldDescription::controller>(
        "controller", "",
        "[the arena controller](arena_controller.md), which changes the arena during a run")
        .defaults_to("the arena changes only by commands of clients")
        .read_apart(),
    field<&WorldDescription::fuzz>(
        "fuzz", "", "[what `playpen fuzz` may change](fuzz.md#bounds); runs ignore it")
        .not_identity(),
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
