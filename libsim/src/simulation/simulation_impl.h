// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "physics/physics_world.h"
#include "sim/devices/motion.h"
#include "sim/devices/pen.h"
#include "sim/simulation/simulation.h"
#include "simulation/chronicle.h"
#include "world/find_named.h"

namespace sim {

struct alignas(64) RobotParts {
  // The members that each step needs come first and fill one cache line.
  RobotStatistics statistics;
  Vec2 last_position;              // at the end of the last step
  double clearance_slack_m = 0.0;  // see update_clearance()
  bool clearance_settled = false;  // measured again before anything moves, nothing would change
  std::uint32_t first_slot = 0;    // index of its first device's slot
  std::uint16_t slot_count = 0;
  bool any_measures_after_others = false;  // whether any device measures after others
  bool has_pen = false;

  Pen* pen = nullptr;  // its first pen and motion device, if any
  Motion* motion = nullptr;
  double radius_m = 0.0;  // of the footprint about B
  const RobotModel* model = nullptr;
  std::vector<std::unique_ptr<Device>> devices;
};

// What a step needs to know about a device, so that it need not access most devices.
struct Slot {
  Device* device;
  SimTime due_ns;       // time of a sensor's next reading
  std::uint16_t index;  // of the device
  bool is_sensor;
  bool integrates;
  bool measures_after_others;  // it reads other devices

  [[nodiscard]] Sensor& sensor() const { return static_cast<Sensor&>(*device); }
};

struct Simulation::Impl {
  class Control;
  class Directory;
  // Each in a header of its own name.
  class Blocks;
  class Controller;
  class Loads;
  class ObstacleMotions;
  struct Appearance {
    Colour colour;
    int fiducial;
  };
  // A device whose act() is called: one that acts, or that has not been called yet.
  struct Actor {
    std::size_t robot;
    Device* device;
  };

  // @param to_be_read  the state is read next, so nothing needs to be measured.
  Impl(WorldDescription description, LogHook hook, bool to_be_read = false);
  ~Impl();

  void add_robot(const RobotDescription& robot);
  // Throws ConfigError with everything that devices are missing.
  void connect_devices();
  // After all robots.
  void add_moving_obstacles();
  void say(std::size_t robot, const std::string& text);
  void reset();
  [[nodiscard]] Device& device(DeviceId id) const {
    return *robots.at(static_cast<std::size_t>(id.robot))
                .devices.at(static_cast<std::size_t>(id.device));
  }

  // Updates the due times of a robot's sensors.
  void note_due_times(std::size_t i);

  // --- A step
  void step();
  // Calls act() of the devices that need it. Devices that do not override it are called once.
  void act(double dt_s);
  void update_robot(std::size_t i, double dt_s);
  // Updates a robot's devices that measure after others, or the remaining ones.
  void update_devices(std::size_t i, bool measures_after_others);
  // Upper bound of how far any point of a robot can have moved in the last step.
  [[nodiscard]] double move_m(std::size_t i, double dt_s) const;
  // The least clearance so far can decrease only after the robot and its surroundings have moved by
  // the difference to the last measurement. Until then no measurement is needed.
  void update_clearance(std::size_t i, double dt_s);
  // @param is_first  the statistics begin here.
  void measure_clearance(std::size_t i, double limit_m, bool is_first = false);
  // Invalidates all clearances after something was placed.
  void invalidate_clearances();
  void record_collisions();

  // --- Objects (objects.cpp)
  // Edits a block, unless the result is invalid; returns the reason then.
  template <typename Edit>
  std::optional<std::string> change_block(const std::string& name, Edit edit);
  // Calls edit() with the description of a robot or block. Returns why it cannot.
  // @param refusal  what other objects do instead.
  template <typename Edit>
  std::optional<std::string> change_appearance(const Simulation& simulation,
                                               const std::string& name, const char* refusal,
                                               Edit edit);
  // Name of a robot or a moving obstacle, given by its body in the physics.
  [[nodiscard]] const std::string& name_of_body(int body) const;
  // The same with "robot " or "obstacle " in front.
  [[nodiscard]] std::string title_of_body(int body) const;
  std::optional<std::string> place(std::size_t i, const Pose& X_WB);
  std::optional<std::string> place(std::span<const RobotPlace> places);
  /// Why a robot cannot be placed or suspended; nullopt unless it mirrors a real one.
  [[nodiscard]] std::optional<std::string> refusal_of_mirrored(std::size_t robot) const;
  std::optional<std::string> place_block(const std::string& name, const Pose& pose);
  // Index of the obstacle of that name.
  [[nodiscard]] std::optional<int> find_obstacle(const std::string& name) const {
    return find_named(world.arena.obstacles, name);
  }
  [[nodiscard]] ObstacleDescription& obstacle(int index) {
    return world.arena.obstacles.at(static_cast<std::size_t>(index));
  }
  // Gives a device a fault. @return whether the robot has such a device.
  bool set_fault(std::size_t robot, const FaultAction& fault);
  // Keeps and logs an event if the world records events.
  void record(ArenaEventKind kind, std::string what, std::string who = {}, std::string text = {},
              double value = 0.0) {
    chronicle.add_event(now_ns, kind, std::move(what), std::move(who), std::move(text), value);
  }

  // --- State (state.cpp)
  // Writes or reads the state. When reading, this object must be newly constructed.
  void archive(StateArchive& archive);
  // The parts of the state before and after the canvas.
  void archive_bodies(StateArchive& archive);
  void archive_rules(StateArchive& archive);
  // Replaces another simulation, see RestoreScope::kWorld.
  void take_over_from(Impl& before);
  void archive_obstacle(StateArchive& archive, ObstacleDescription& thing);
  void archive_robot(StateArchive& archive, std::size_t i);
  // The view mode, and what only pictures show; the layers of clients follow.
  void archive_pictures(StateArchive& archive);
  // The world in its initial state.
  [[nodiscard]] WorldDescription start_world() const;
  [[nodiscard]] std::uint64_t start_hash() const;
  WorldDescription world;
  Chronicle chronicle;
  std::unique_ptr<PhysicsWorld> physics;
  LayerStack layers;
  ViewMode view_mode;
  std::vector<ObstacleDescription> start_obstacles;
  std::vector<Appearance> start_appearances;  // of the robots
  std::vector<RobotParts> robots;
  std::vector<Slot> slots;         // sorted by robot and device
  std::vector<Motion*> motions;    // of the robots
  std::vector<Actor> actors;       // sorted by robot and device
  bool all_actors_called = false;  // act() of all devices has been called once
  std::unique_ptr<Loads> loads;
  std::unique_ptr<Blocks> blocks;
  std::unique_ptr<Controller> controller;             // null: the world has none
  std::unique_ptr<ObstacleMotions> obstacle_motions;  // null: no obstacle moves
  std::vector<DeviceId> updated;
  SimTime now_ns = 0;
  std::uint64_t steps = 0;
  std::optional<SimTime> box2d_since_ns;
  mutable std::optional<std::uint64_t> known_start_hash;
  // About as many bytes as the parts of the state take: as many as were written last; 0: unknown.
  std::size_t bodies_bytes = 0;
  std::size_t rules_bytes = 0;
  std::size_t pictures_bytes = 0;
};

}  // namespace sim
