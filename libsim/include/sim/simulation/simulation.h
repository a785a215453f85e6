// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/core/log.h"
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
  int robot = 0;        ///< index
  std::string partner;  ///< name of the obstacle or robot; "border" or "wall"
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
  /// @return nothing if done, else why not.
  std::optional<std::string> apply(DeviceId id, const Command& command);

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

  /// The scene as it is now. Trails are kept by the caller (Simulation remembers no past).
  [[nodiscard]] SceneSnapshot snapshot() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a world file with all built-in devices; "" is the default world: the SyRoTek arena with
/// one S1R.
/// @throws ConfigError with all issues of the file.
[[nodiscard]] WorldDescription load_world(const std::string& path);

/// As load_world, from text; `file` is what messages call it and whose folder maps lie in.
[[nodiscard]] WorldDescription load_world_text(std::string_view text,
                                               const std::string& file = "<memory>");

}  // namespace sim
