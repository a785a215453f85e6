// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/core/log.h"
#include "sim/core/state_archive.h"
#include "sim/devices/device.h"
#include "sim/devices/laser.h"
#include "sim/devices/pen.h"
#include "sim/simulation/arena_event.h"
#include "sim/simulation/arena_state.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/world/description.h"
#include "sim/world/robot_model.h"

namespace sim {

/// Statistics of a robot since the start of the run.
struct RobotStatistics {
  double path_length_m = 0.0;      ///< length of the path of the axle's centre [m]
  int collisions = 0;              ///< number of contacts begun with obstacles, walls or robots
  double least_clearance_m = 0.0;  ///< least distance of its footprint to any solid so far [m]; 0
                                   ///< once it has collided
  double stalled_time_s = 0.0;     ///< [s]
};

/// The start of a contact.
struct Collision {
  SimTime time_ns = 0;
  int robot = 0;              ///< index
  std::string partner;        ///< name of the obstacle or robot; "border" or "wall"
  Vec2 place = Vec2::Zero();  ///< contact point in W [m]
};

/// A text that a robot said.
struct SpokenText {
  SimTime time_ns = 0;
  int robot = 0;     ///< index
  std::string text;  ///< UTF-8
};

/// An object of the scene: its place and its size.
struct SceneObject {
  std::string name;  ///< as in the world; "border" and "wall" for the border and a map's walls
  std::string kind;  ///< "robot", "block", "separator", "border" or "wall"
  Pose pose;         ///< of its bounding box in W; for a robot the pose X_WB of its body, for a
                     ///< polygon that of its own frame
  Vec2 size = Vec2::Zero();  ///< of the bounding box along its own axes [m]
  bool dynamic = false;      ///< a robot, or a block that can be retracted
  bool extended = true;      ///< false: a block that is retracted now
};

/// The state of a simulation as bytes, see Simulation::save(). Only machines of the same byte order
/// with the same versions of Playpen and Box2D can read it.
using Snapshot = std::vector<std::uint8_t>;

/// How much of a snapshot is restored.
enum class RestoreScope {
  kAll,    ///< everything
  kWorld,  ///< the world only, not what clients have observed: see Simulation::restore()
};

/// The seed of the simulation that saved a snapshot.
/// @throws SnapshotError if these are no bytes of a snapshot. Other damage is found by restore().
[[nodiscard]] std::uint64_t seed_of(std::span<const std::uint8_t> snapshot);

class Simulation;

/// The state of a simulation at a moment, without its layers. Together with a copy of the layers of
/// that moment it gives the hash and the snapshot.
class StateParts {
 public:
  /// See Simulation::state_hash().
  [[nodiscard]] std::uint64_t hash(LayerStack& layers);
  /// See Simulation::save().
  [[nodiscard]] Snapshot snapshot(LayerStack& layers);
  /// Hash of what state_hash() covers, but without the canvas.
  [[nodiscard]] std::uint64_t hash_without_canvas();

 private:
  friend class Simulation;
  void append_state(StateArchive& archive, LayerStack& layers);

  std::uint64_t world_ = 0;  ///< world_hash() of the world in its initial state
  std::uint64_t seed_ = 0;
  std::vector<std::uint8_t> bodies_;    ///< what is archived before the canvas
  std::vector<std::uint8_t> rules_;     ///< and after it
  std::vector<std::uint8_t> pictures_;  ///< what only pictures show, before the clients' layers
};

/// Reads snapshots of simulations of one world; it needs no access to these simulations.
class SnapshotReader {
 public:
  /// @throws SnapshotError as Simulation::restore().
  [[nodiscard]] Simulation read(std::span<const std::uint8_t> snapshot) const;

 private:
  friend class Simulation;
  SnapshotReader(WorldDescription start, std::uint64_t hash, LogHook log);

  WorldDescription start_;
  std::uint64_t hash_;  ///< of start_
  LogHook log_;
};

/// A running world. Owns all its parts. Single-threaded and deterministic: the same description,
/// commands and steps give bit-identical states.
class Simulation {
 public:
  /// @throws ConfigError if the world is invalid (see io::check_world).
  explicit Simulation(WorldDescription world, LogHook log = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Runs one step: motors update their targets, Box2D steps, then each sensor that is due
  /// measures.
  void step();

  [[nodiscard]] SimTime now_ns() const noexcept;
  [[nodiscard]] std::uint64_t steps() const noexcept;
  /// The end of the first step in which Box2D's code took part: a robot touched something, or might
  /// have. Up to there the simulation has the same bits on every machine; from then on, on machines
  /// of one processor family. nullopt: not yet.
  [[nodiscard]] std::optional<SimTime> box2d_since_ns() const noexcept;
  /// Whether the world's duration is over, or the arena controller has ended the run. step() may
  /// still be called; the arena controller does nothing more then.
  [[nodiscard]] bool finished() const noexcept;

  [[nodiscard]] const WorldDescription& world() const noexcept;
  [[nodiscard]] int robot_count() const noexcept;
  [[nodiscard]] const RobotModel& model(int robot) const;
  [[nodiscard]] const BodyState& body(int robot) const;
  /// Whether no solid as high as the first robot's centre of height is between two robots' centres.
  [[nodiscard]] bool sees(int robot, int other) const;
  [[nodiscard]] const RobotStatistics& statistics(int robot) const;
  /// Lets all statistics() begin anew, as if the run started here: for programs that place robots
  /// before it. collisions() stay.
  void restart_statistics();
  /// The newest collisions, oldest first. At most 1024 are kept; RobotStatistics counts all.
  [[nodiscard]] const std::vector<Collision>& collisions() const noexcept;
  /// The newest texts that robots said, oldest first; at most 1024 are kept.
  [[nodiscard]] const std::vector<SpokenText>& spoken_texts() const noexcept;

  [[nodiscard]] int device_count(int robot) const;
  [[nodiscard]] const Device& device(int robot, int device) const;
  /// Index of the robot's device of that name; nullopt if there is none.
  [[nodiscard]] std::optional<int> find_device(int robot, const std::string& name) const;
  [[nodiscard]] std::optional<int> find_robot(const std::string& name) const;

  /// Identifies a device by the indices of its robot and of itself.
  struct DeviceId {
    int robot;
    int device;
    friend bool operator==(const DeviceId&, const DeviceId&) = default;
  };
  /// Identifiers of the sensors that measured in the last step, in a fixed order.
  [[nodiscard]] const std::vector<DeviceId>& updated() const noexcept;

  /// Executes a command now, between two steps.
  /// @return nothing on success, otherwise the reason, e.g. that the device is not active.
  std::optional<std::string> apply(DeviceId id, const Command& command);

  /// Called by apply() before it executes a command.
  using CommandWatch = std::function<void(DeviceId, const Command&)>;
  /// @param watch  replaces the earlier one; empty: nobody watches. It must not change this
  ///     simulation. Forks and snapshots do not have it.
  void watch_commands(CommandWatch watch) { watch_ = std::move(watch); }
  /// Counts the calls that may have changed the state otherwise than by step() and apply(), also
  /// those that were refused. While it stays the same, the commands determine all that happens.
  /// Drawings on the layers do not count.
  [[nodiscard]] std::uint64_t interventions() const noexcept { return interventions_; }

  /// Resets the world to its start: robots, obstacles, devices with their noise, and the base
  /// canvas, which becomes blank but keeps its current size. All devices are active again and all
  /// dynamics are on. From then on, poses and readings equal those of a new simulation that gets
  /// the same commands.
  ///
  /// Not reset are: the clock and the step count; sequence numbers and Waypoint::goal_number();
  /// statistics() and collisions(), which cover the whole run (the jump back to the start adds no
  /// path length); the view mode; the layers of clients; arena_events(), scores() and verdict().
  /// The timers and traps of the arena controller start anew.
  /// Invalidates references to devices and readings.
  /// @return nothing on success, otherwise the reason: refusal_of_mirrored().
  std::optional<std::string> reset();

  /// Switches a device on or off; initially all are on. An inactive device makes no readings (its
  /// schedule continues), refuses commands and does not act: motors stop unless another device
  /// drives them, a waypoint device stops and keeps its goal, a pen leaves no trail.
  void set_active(DeviceId id, bool active);
  [[nodiscard]] bool active(DeviceId id) const;

  /// Suspends (false) or resumes the dynamics of every robot and of every obstacle that moves or
  /// can be pushed. A suspended robot stands still like a wall, whatever its commands are and
  /// whatever pushes it; its sensors and the clock continue. A resumed robot continues with its
  /// last command. Later calls of set_robot_dynamics() make exceptions.
  ///
  /// @return nothing on success, otherwise the reason: refusal_of_mirrored().
  std::optional<std::string> set_dynamics(bool on);
  /// Suspends or resumes the dynamics of one robot.
  /// @return nothing on success, otherwise the reason: no such robot, or one that mirrors a real
  /// one.
  std::optional<std::string> set_robot_dynamics(int robot, bool on);
  /// Suspends or resumes the dynamics of an object by name.
  /// @return nothing on success, otherwise the reason: no such object, or one that never moves by
  ///     itself.
  std::optional<std::string> set_object_dynamics(const std::string& name, bool on);
  /// Whether the robot's dynamics are on; initially true.
  [[nodiscard]] bool robot_dynamics(int robot) const;

  /// All solids in the world's order: robots, blocks, dock separators, then the border and the
  /// walls of a map as one object each, if there are any.
  [[nodiscard]] std::vector<SceneObject> scene_objects() const;

  /// The scene object with that name; nullopt if there is none.
  [[nodiscard]] std::optional<SceneObject> find_object(const std::string& name) const;
  /// Error message for an unknown object; lists the existing names.
  [[nodiscard]] std::string no_such_object(const std::string& name) const;
  /// Moves a robot or a block at once. A robot is placed as by RobotControl::place(), but its
  /// motors keep their last command. A portable block may be placed beyond the floor; a carried
  /// block leaves its robot. A moving obstacle is at rest there, and goes on to its next goal.
  /// @param pose  X_WB of a robot; the pose of a block's centre.
  /// @return nothing on success, otherwise the reason: no such object, an immovable object, or the
  ///     obstacle in the way. A block that is not retracted cannot be placed where a robot stands.
  std::optional<std::string> place_object(const std::string& name, const Pose& pose);
  /// A robot, by its index, and the pose X_WB that it gets.
  struct RobotPlace {
    int robot;
    Pose X_WB;
  };
  /// Places several robots at once, at rest, as by RobotControl::place(). They may take one
  /// another's places.
  /// @param places  each robot at most once; the robots must exist.
  /// @return nothing on success, otherwise the reason, which names the first robot that cannot be
  ///     placed; no robot is moved then.
  std::optional<std::string> place_robots(std::span<const RobotPlace> places);
  /// Changes the size of a block at once. A carried block is put down where it is.
  /// @param size_m  along its own axes [m], each > 0.
  /// @return as for place_object().
  std::optional<std::string> set_block_size(const std::string& name, const Vec2& size_m,
                                            double height_m);
  /// Changes the colour of a robot or a block in pictures.
  /// @return nothing on success, otherwise the reason.
  std::optional<std::string> set_object_colour(const std::string& name, Colour colour);
  /// Changes the number of a robot or a block that fiducial devices read.
  /// @param fiducial  > 0, or 0: they do not see it.
  /// @return nothing on success, otherwise the reason.
  std::optional<std::string> set_object_fiducial(const std::string& name, int fiducial);

  /// Why the whole world can neither be put back nor held fast: a robot mirrors a real one
  /// (RobotDescription::real), for which that would have no effect. Such a robot cannot be placed
  /// either. @return nullopt if no robot does.
  [[nodiscard]] std::optional<std::string> refusal_of_mirrored() const;
  /// Puts a robot where its real counterpart is (RobotDescription::real), between two steps. From
  /// the first call on, the robot moves in no other way, whatever its commands are. It may overlap
  /// obstacles, and no collisions are counted for it. The first call adds no path length.
  /// @return nothing on success, otherwise the reason: the world binds the robot to no real one, or
  ///     the pose is invalid.
  std::optional<std::string> follow_real(int robot, const Pose& X_WB);
  /// Returns the scan that a laser would make without noise from its robot's present pose. The
  /// simulation does not change.
  /// @return nullopt if the device is no laser.
  [[nodiscard]] std::optional<LaserReading> ideal_scan(DeviceId laser) const;
  /// Writes such a scan into the caller's memory, in single precision: for programs that need many
  /// scans and no readings. A range is that of the other function, rounded, if the beams are the
  /// laser's own.
  /// @param geometry   the beams, see ScanGeometry; Laser::geometry() are the laser's own.
  /// @param workspace  of the calling thread; it may serve several simulations.
  /// @param ranges_m   receives geometry.beam_count ranges, the rightmost beam first [m].
  /// @return false if the device is no laser; nothing is written then.
  /// @note O(edges + beams); allocates only when the workspace or the world is new.
  [[nodiscard]] bool ideal_scan(DeviceId laser, const scan::ScanGeometry& geometry,
                                scan::ScanWorkspace& workspace, std::span<float> ranges_m) const;

  /// The grid-maps: the canvas that all pens share, and the layers of clients above or below it.
  [[nodiscard]] LayerStack& layers() noexcept;
  [[nodiscard]] const LayerStack& layers() const noexcept;
  /// The base layer of layers().
  [[nodiscard]] Canvas& canvas() noexcept;
  [[nodiscard]] const Canvas& canvas() const noexcept;

  /// How pictures show the grid-maps now; the simulation itself does not use it.
  [[nodiscard]] ViewMode view_mode() const noexcept;
  /// @return nothing on success or if nothing changes, otherwise the reason: the world locks the
  ///     mode.
  std::optional<std::string> set_view_mode(ViewMode mode);

  /// Extends or retracts a dynamic obstacle, at once or with its rise_speed_mps. An obstacle with
  /// WhenBlocked::kWait on which a robot stands waits until the robot has left.
  /// @return nothing on success, otherwise the reason: no such obstacle, a static one, or a robot
  ///     stands there.
  std::optional<std::string> set_obstacle_state(const std::string& name, ObstacleState state);

  // The arena controller, see docs/arena_controller.md. Callers that act for clients must respect
  // SimulationDescription::objects_locked.
  /// Puts the arena into one of the world's configurations. Other blocks change even if one is
  /// refused.
  /// @return nothing on success, otherwise the reason: no such configuration, or what was refused.
  std::optional<std::string> set_configuration(const std::string& name);
  /// Switches a timer on or off. A timer that is switched on counts its times from now.
  /// @return nothing on success or if nothing changes, otherwise the reason: no such timer.
  std::optional<std::string> set_timer_enabled(const std::string& name, bool enabled);
  /// Switches a trap on or off. Robots inside a trap that is switched on enter it now.
  /// @return nothing on success or if nothing changes, otherwise the reason: no such trap.
  std::optional<std::string> set_trap_enabled(const std::string& name, bool enabled);
  /// Whether the timer or trap of that name is on; nullopt if there is none.
  [[nodiscard]] std::optional<bool> timer_or_trap_enabled(const std::string& name) const;
  /// The configuration, timers and traps as they are now; empty without an arena controller.
  [[nodiscard]] ArenaState arena_state() const;
  /// Whether this world records events: it has an arena controller, or blocks that rise slowly or
  /// wait.
  [[nodiscard]] bool records_arena_events() const noexcept;
  /// The events of the run. For those since number n: the ones with ArenaEvent::number > n.
  [[nodiscard]] const ArenaEvents& arena_events() const noexcept;
  /// Points of the robots, by index; empty without an arena controller. A reset keeps them.
  [[nodiscard]] const std::vector<double>& scores() const noexcept;
  /// Why the canvas cannot have this size, in one sentence; nullopt if it can. The arena controller
  /// may do so much in a step only, and it may fill the canvas.
  [[nodiscard]] std::optional<std::string> canvas_refusal(int width, int height) const;
  /// How the arena controller ended the run; nullopt if it did not.
  [[nodiscard]] const std::optional<Verdict>& verdict() const noexcept;
  /// The dynamic obstacles that rise, sink or wait, by index.
  [[nodiscard]] std::vector<MovingBlock> moving_blocks() const;

  /// Hash of the base canvas and of all state that future steps depend on: equal hashes mean equal
  /// futures. Other layers and the view mode are left out, because they only affect the clients'
  /// pictures.
  [[nodiscard]] std::uint64_t state_hash() const;

  /// Saves everything that a step or a command changes: bodies, contacts and Box2D's internal
  /// state, devices with their readings, noise and commands, carried objects, obstacles,
  /// statistics, collisions, said texts, the arena controller, clock, canvas and layers.
  ///
  /// A snapshot identifies its world and seed, but does not contain the world. It contains a hash
  /// of its bytes, so that damage is detected. It takes about 1 KB per robot, 2.5 KB per device
  /// with noise, and the readings. Saving takes about 0.7 ms per megabyte.
  [[nodiscard]] Snapshot save() const;
  /// The state without the layers, for callers that hash or save it later, when this simulation is
  /// in use again.
  [[nodiscard]] StateParts state_parts() const;

  /// Continues from a snapshot that a simulation of the same world and seed has saved, perhaps in
  /// another process. All later states are bit-identical.
  ///
  /// With RestoreScope::kWorld only the world is restored. Everything that reset() keeps is kept
  /// here too: the clock and the step count; sequence numbers and Waypoint::goal_number();
  /// statistics(), collisions(), spoken_texts(), arena_events(), scores() and verdict(), which
  /// cover the whole run; the view mode, the size of the canvas and the layers of clients. The
  /// delay until each sensor's next measurement is the one at the time of the snapshot. Invalidates
  /// references to devices and readings, like reset().
  /// @throws SnapshotError if the snapshot is truncated or altered, or has another version, world
  ///     or seed. The simulation is then unchanged.
  void restore(std::span<const std::uint8_t> snapshot, RestoreScope scope = RestoreScope::kAll);
  /// For callers that read a snapshot while this simulation is in use, and then call replace_by().
  [[nodiscard]] SnapshotReader snapshot_reader() const;
  /// Continues as the simulation that a snapshot_reader() of this one has read, like restore().
  /// Takes time only if the sizes of the canvases differ.
  /// @return the state before, whose memory may take a while to free. Its layers are undefined.
  [[nodiscard]] Simulation replace_by(Simulation restored, RestoreScope scope = RestoreScope::kAll);

  /// Creates an independent copy of this simulation in the same state, for programs that search
  /// ahead. The copy has no log.
  [[nodiscard]] Simulation fork() const;
  /// Uses the memory of another simulation for what is equal in both and does not change, so that
  /// more of many simulations stays in the cache. Nothing else changes: they stay independent, also
  /// for threads, and in any order of destruction.
  void share_memory_with(const Simulation& other);

  /// The current scene. The caller records trails, since Simulation keeps no history.
  /// @param with_canvas  false: the picture of the canvas and the list of layers are left out, for
  ///     callers that have a copy of the layers.
  [[nodiscard]] SceneSnapshot snapshot(bool with_canvas = true) const;
  /// One robot's part of the scene.
  /// @param robot  its index in the world; it must exist.
  [[nodiscard]] RobotSnapshot robot_snapshot(int robot) const;

 private:
  friend class SnapshotReader;
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
  CommandWatch watch_;
  std::uint64_t interventions_ = 0;
};

/// Reads a world file that may use all built-in devices. "" is the default world: the SyRoTek arena
/// with one S1R.
/// @throws ConfigError with all issues of the file.
[[nodiscard]] WorldDescription load_world(const std::string& path);

/// Reads the file of a robot model that may use all built-in devices.
/// @throws ConfigError with all issues of the file.
[[nodiscard]] RobotModel load_model(const std::string& path);

/// Like load_world, from text. `file` is its name in messages; its folder contains the maps.
[[nodiscard]] WorldDescription load_world_text(std::string_view text,
                                               const std::string& file = "<memory>");

}  // namespace sim
