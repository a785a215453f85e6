// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/core/log.h"
#include "sim/core/state_archive.h"
#include "sim/devices/device.h"
#include "sim/devices/pen.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/world/description.h"
#include "sim/world/robot_model.h"

namespace sim {

/// What a robot has been through so far.
struct RobotStatistics {
  double path_length_m = 0.0;      ///< length of the way of the axle's centre [m]
  int collisions = 0;              ///< contacts begun, with obstacles, walls or robots
  double least_clearance_m = 0.0;  ///< least distance of its footprint to anything solid so far
                                   ///< [m]; 0 once it has collided
  double stalled_time_s = 0.0;     ///< [s]
};

/// A contact that began.
struct Collision {
  SimTime time_ns = 0;
  int robot = 0;              ///< index
  std::string partner;        ///< name of the obstacle or robot; "border" or "wall"
  Vec2 place = Vec2::Zero();  ///< where they touched, in W [m]
};

/// Something that a robot said.
struct Utterance {
  SimTime time_ns = 0;
  int robot = 0;     ///< index
  std::string text;  ///< UTF-8
};

/// A thing of the scene: where it is and how much room it takes.
struct SceneObject {
  std::string name;  ///< as in the world; "border" and "wall" (all of a map's) have no other
  std::string kind;  ///< "robot", "block", "separator", "border" or "wall"
  Pose pose;         ///< of the box round it in W; a robot's: of its body, X_WB
  Vec2 size = Vec2::Zero();  ///< of that box along its own axes [m]
  bool dynamic = false;      ///< a robot, or a block that can be retracted
  bool extended = true;      ///< false: a block that is retracted into the floor now
};

/// The state of a simulation as bytes, see Simulation::save(). The machine that wrote it reads it,
/// or another of the same byte order with the same version of Playpen and of Box2D.
using Snapshot = std::vector<std::uint8_t>;

/// How much of a snapshot counts.
enum class RestoreScope {
  kAll,    ///< all of it
  kWorld,  ///< not what others have seen of the simulation: see Simulation::restore()
};

/// A world in motion. Owns all of it; single-threaded and deterministic: the same description,
/// commands and steps give the same state to the bit.
class Simulation {
 public:
  /// @throws ConfigError if the world is not sound (see io::check_world).
  explicit Simulation(WorldDescription world, LogHook log = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// One step: motors take their targets, Box2D steps, then each sensor that is due measures.
  void step();

  [[nodiscard]] SimTime now_ns() const noexcept;
  [[nodiscard]] std::uint64_t steps() const noexcept;
  /// Whether the world's duration is over; step() may still be called.
  [[nodiscard]] bool finished() const noexcept;

  [[nodiscard]] const WorldDescription& world() const noexcept;
  [[nodiscard]] int robot_count() const noexcept;
  [[nodiscard]] const RobotModel& model(int robot) const;
  [[nodiscard]] const BodyState& body(int robot) const;
  [[nodiscard]] const RobotStatistics& statistics(int robot) const;
  /// The newest collisions, oldest first; at most 1024 are kept, all are counted.
  [[nodiscard]] const std::vector<Collision>& collisions() const noexcept;
  /// The newest things that robots said, oldest first; at most 1024 are kept.
  [[nodiscard]] const std::vector<Utterance>& said() const noexcept;

  [[nodiscard]] int device_count(int robot) const;
  [[nodiscard]] const Device& device(int robot, int device) const;
  /// Index of the robot's device of that name; nullopt if it has none.
  [[nodiscard]] std::optional<int> find_device(int robot, const std::string& name) const;
  [[nodiscard]] std::optional<int> find_robot(const std::string& name) const;

  /// Indices (robot, device) of the sensors that measured in the last step, in fixed order.
  struct DeviceId {
    int robot;
    int device;
    friend bool operator==(const DeviceId&, const DeviceId&) = default;
  };
  [[nodiscard]] const std::vector<DeviceId>& updated() const noexcept;

  /// Carries a command out now, between two steps.
  /// @return nothing if done, else why not, e.g. that the device is not active.
  std::optional<std::string> apply(DeviceId id, const Command& command);

  /// Puts everything back to its start: robots, obstacles, devices with their noise, and the base
  /// canvas, which is blank again but keeps its present size. All devices are active again, all
  /// dynamics on. From here on, poses and readings are those of a new simulation that gets the same
  /// commands.
  /// Not put back: clock and step count, sequence numbers and Waypoint::goal_number(), which go on;
  /// statistics() and collisions(), which tell of the whole run (the way back to the start does not
  /// count); view mode and the layers of clients.
  /// References to devices and readings from before end here.
  void reset();

  /// Switches a device off or on; at first all are on. One that is off makes no readings, though
  /// its schedule goes on, refuses commands, and does not act: the motors stop, unless another
  /// device steers them, a waypoint stops and keeps its goal, a pen leaves no trail.
  void set_active(DeviceId id, bool active);
  [[nodiscard]] bool active(DeviceId id) const;

  /// Suspends (false) or restores the dynamics of every robot. A suspended robot stands still like
  /// a wall, whatever its motors were told and whoever pushes; sensors and the clock go on.
  /// Restored, it goes on as it was told last. set_robot_dynamics() afterwards makes exceptions.
  /// @return nothing if done, else why not.
  std::optional<std::string> set_dynamics(bool on);
  /// The same for one robot. @return nothing if done, else why not: no such robot.
  std::optional<std::string> set_robot_dynamics(int robot, bool on);
  /// The same for a thing by name.
  /// @return nothing if done, else why not: no such thing, or one that never moves by itself.
  std::optional<std::string> set_object_dynamics(const std::string& name, bool on);
  /// Whether the robot may move; true at first.
  [[nodiscard]] bool robot_dynamics(int robot) const;

  /// Everything solid: robots, blocks, dock separators, then the border and the walls of a map as
  /// one thing each, if there are any. In the world's order.
  [[nodiscard]] std::vector<SceneObject> scene_objects() const;

  /// The one of them with that name; nullopt if there is none.
  [[nodiscard]] std::optional<SceneObject> find_object(const std::string& name) const;
  /// What to tell somebody who asked for an object that is not there: names those there are.
  [[nodiscard]] std::string no_such_object(const std::string& name) const;
  /// Puts a robot or a block somewhere, at once: a robot as RobotControl::place() does, but its
  /// motors go on as they were told last.
  /// @param pose  X_WB of a robot, the middle of a block.
  /// A portable block may be put beyond the floor; one that is carried leaves its robot.
  /// @return nothing if done, else why not: no such object, one that stands fast, or what is in the
  ///         way. A block, unless it is retracted, is not put where a robot stands.
  std::optional<std::string> place_object(const std::string& name, const Pose& pose);
  /// Gives a block another size, at once.
  /// @param size_m  along its own axes [m], each > 0.
  /// @return as place_object(). One that is carried is put down for it, where it is.
  std::optional<std::string> set_block_size(const std::string& name, const Vec2& size_m,
                                            double height_m);
  /// Gives a robot or a block another colour, in pictures.
  /// @return nothing if done, else why not.
  std::optional<std::string> set_object_colour(const std::string& name, Colour colour);
  /// Gives a robot or a block another number for fiducial devices to read.
  /// @param fiducial  > 0; 0: they do not see it.
  /// @return nothing if done, else why not.
  std::optional<std::string> set_object_fiducial(const std::string& name, int fiducial);

  /// The grid-maps: the canvas of all pens, and the layers that clients put over or under it.
  [[nodiscard]] LayerStack& layers() noexcept;
  [[nodiscard]] const LayerStack& layers() const noexcept;
  /// The base layer of layers().
  [[nodiscard]] Canvas& canvas() noexcept;
  [[nodiscard]] const Canvas& canvas() const noexcept;

  /// How pictures show the grid-maps now; the simulation itself makes nothing of it.
  [[nodiscard]] ViewMode view_mode() const noexcept;
  /// @return nothing if done (or nothing to do), else why not: the world locks another mode.
  std::optional<std::string> set_view_mode(ViewMode mode);

  /// Extends or retracts a dynamic obstacle.
  /// @return nothing if done, else why not: no such obstacle, static, or a robot stands there.
  std::optional<std::string> set_obstacle_state(const std::string& name, ObstacleState state);

  /// Hash of all state that the future depends on, and of the base canvas: equal hashes, equal
  /// futures. Other layers and the view mode are left out: they are the clients' pictures.
  [[nodiscard]] std::uint64_t state_hash() const;

  /// All that a step or a command changes: bodies, contacts and what Box2D keeps of them, devices
  /// with their readings, noise and commands, what robots carry, obstacles, statistics, collisions,
  /// what was said, clock, canvas and layers.
  ///
  /// A snapshot says of which world it is, and of which seed; the world itself is not in it. It has
  /// the hash of its bytes, so that damage is found.
  /// Cost: about 1 KB a robot, 2.5 KB for each device with noise, and the readings; some 0.5 ms for
  /// each megabyte.
  [[nodiscard]] Snapshot save() const;

  /// Goes on from a snapshot, which this simulation or another one of the same world and seed has
  /// saved, perhaps in another process: all that follows is the same to the bit.
  /// With RestoreScope::kWorld only the world goes back. What reset() does not put back goes on
  /// here, too: clock and step count, sequence numbers and Waypoint::goal_number(); statistics(),
  /// collisions() and said(), which tell of the whole run; view mode, the size of the canvas and
  /// the layers of clients. Sensors measure as long after now as they would have measured after the
  /// moment of the snapshot. References to devices and readings from before end here, as with
  /// reset().
  /// @throws SnapshotError if it was cut or altered, or is of another version, world or seed. Then
  ///         nothing has changed.
  void restore(std::span<const std::uint8_t> snapshot, RestoreScope scope = RestoreScope::kAll);

  /// Another simulation of the same world in the same state, for programs that search: what happens
  /// to one is nothing to the other. It has no log.
  [[nodiscard]] Simulation fork() const;

  /// The scene as it is now. Trails are kept by the caller (Simulation remembers no past).
  [[nodiscard]] SceneSnapshot snapshot() const;
  /// A robot's part of it. @param robot  its index in the world; it must exist.
  [[nodiscard]] RobotSnapshot robot_snapshot(int robot) const;

 private:
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads a world file with all built-in devices; "" is the default world: the SyRoTek arena with
/// one S1R.
/// @throws ConfigError with all issues of the file.
[[nodiscard]] WorldDescription load_world(const std::string& path);

/// Reads the file of a robot model with all built-in devices.
/// @throws ConfigError with all issues of the file.
[[nodiscard]] RobotModel load_model(const std::string& path);

/// As load_world, from text; `file` is what messages call it and whose folder maps lie in.
[[nodiscard]] WorldDescription load_world_text(std::string_view text,
                                               const std::string& file = "<memory>");

}  // namespace sim
