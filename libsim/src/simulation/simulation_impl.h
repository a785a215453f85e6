// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/physics_world.h"
#include "sim/devices/motion.h"
#include "sim/devices/pen.h"
#include "sim/simulation/simulation.h"

namespace sim {

struct alignas(64) RobotParts {
  // What each step asks for comes first: it fills one line of the cache.
  RobotStatistics statistics;
  Vec2 last_position;              // where it was at the end of the last step
  double clearance_slack_m = 0.0;  // see update_clearance
  std::uint32_t first_slot = 0;    // of its devices
  std::uint16_t slot_count = 0;
  bool any_last = false;  // of them
  bool has_pen = false;

  Pen* pen = nullptr;  // the first of each, if any
  Motion* motion = nullptr;
  double radius_m = 0.0;  // of the footprint about B
  const RobotModel* model = nullptr;
  std::vector<std::unique_ptr<Device>> devices;
};

// What a step must know of a device, so that most of them need not be looked at.
struct Slot {
  Device* device;
  SimTime due_ns;       // when a sensor's next reading is
  std::uint16_t index;  // of the device
  bool is_sensor;
  bool integrates;
  bool last;  // looks at others' readings, so comes after them

  [[nodiscard]] Sensor& sensor() const { return static_cast<Sensor&>(*device); }
};

struct Simulation::Impl {
  class Control;
  class Directory;
  struct Look {
    Colour colour;
    int fiducial;
  };
  // A device that steers, or was not yet asked to.
  struct Actor {
    std::size_t robot;
    Device* device;
  };
  // An obstacle that a robot carries.
  struct Load {
    std::size_t robot;
    int obstacle;
    Pose X_BT;    // of the thing in B
    bool inside;  // the robot, where nobody sees it
  };

  // @param to_be_read  a state is read next, so nothing need be measured.
  Impl(WorldDescription description, LogHook hook, bool to_be_read = false);

  void add_robot(const RobotDescription& robot);
  // Throws ConfigError with all that devices miss.
  void connect_devices();
  void say(std::size_t robot, const std::string& text);
  void reset();
  [[nodiscard]] Device& device(DeviceId id) const {
    return *robots.at(static_cast<std::size_t>(id.robot))
                .devices.at(static_cast<std::size_t>(id.device));
  }

  // A robot's sensors have changed when they are due.
  void note_due_times(std::size_t i);

  // --- A step
  void step();
  // Lets devices steer. Those that do not are asked once.
  void act(double dt_s);
  void update_robot(std::size_t i, double dt_s);
  // Of a robot's devices those that come last, or the others.
  void update_devices(std::size_t i, bool last);
  // How far any point of a robot can have moved in the last step, at most.
  [[nodiscard]] double move_m(std::size_t i, double dt_s) const;
  // The least clearance so far can only fall once the robot and what is round it have moved by
  // the difference to what was measured last; until then there is no need to look.
  void update_clearance(std::size_t i, double dt_s);
  void measure_clearance(std::size_t i, double limit_m);
  // Something was put somewhere: clearances must be looked at anew.
  void forget_clearances();
  void record_collisions();
  // Not with each one, which would move all that are kept.
  void forget_old_collisions();

  // --- Objects (objects.cpp)
  // Changes a block, unless something is against it: tells what.
  template <typename Edit>
  std::optional<std::string> change_block(const std::string& name, Edit edit);
  // Calls edit() with the description of a robot or block. Returns why it cannot.
  // @param refusal  what other objects do instead.
  template <typename Edit>
  std::optional<std::string> change_look(const Simulation& simulation, const std::string& name,
                                         const char* refusal, Edit edit);
  std::optional<std::string> place(std::size_t i, const Pose& X_WB);
  [[nodiscard]] ObstacleDescription& obstacle(int index) {
    return world.arena.obstacles.at(static_cast<std::size_t>(index));
  }
  [[nodiscard]] const Pose& body_pose(std::size_t robot) const {
    return physics->body(static_cast<int>(robot)).X_WB;
  }
  std::optional<std::string> pick_up(std::size_t robot, int index);
  void carry_at(std::size_t robot, int index, const Pose& X_BT, bool inside);
  std::optional<std::string> put_down(std::size_t robot, int index);
  // It stands again where its description says; the physics must still be told where that is.
  void let_go(int index);
  // The physics is told what others see of a robot's load.
  void show_load(std::size_t robot);
  void move_loads();

  // --- State (state.cpp)
  // Writes or reads it. When reading, this has just been made.
  void archive(StateArchive& archive);
  // Goes on in place of another one, see RestoreScope::kWorld.
  void succeed(Impl& before);
  void archive_obstacle(StateArchive& archive, ObstacleDescription& thing);
  void archive_robot(StateArchive& archive, std::size_t i);
  // The layers of clients, and how all is shown.
  void archive_pictures(StateArchive& archive);
  // The world as it was at the start.
  [[nodiscard]] WorldDescription start_world() const;
  [[nodiscard]] std::uint64_t start_hash() const;
  // The same world as a snapshot says. It is read into another one, so that nothing has changed if
  // something is wrong with it after all.
  [[nodiscard]] std::unique_ptr<Impl> restored(std::span<const std::uint8_t> snapshot,
                                               LogHook hook) const;

  WorldDescription world;
  LogHook log;
  std::unique_ptr<PhysicsWorld> physics;
  LayerStack layers;
  ViewMode view_mode;
  std::vector<ObstacleDescription> start_obstacles;
  std::vector<Look> start_looks;  // of the robots
  std::vector<RobotParts> robots;
  std::vector<Slot> slots;       // in order of robot and device
  std::vector<Motion*> motions;  // of the robots
  std::vector<Actor> actors;     // in the same order
  bool asked = false;            // all of them, once
  std::vector<Load> loads;
  std::vector<DeviceId> updated;
  std::vector<Collision> collisions;
  std::vector<Utterance> said;
  SimTime now_ns = 0;
  std::uint64_t steps = 0;
  mutable std::optional<std::uint64_t> known_start_hash;
};

}  // namespace sim
