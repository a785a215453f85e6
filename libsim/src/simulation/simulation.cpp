// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/simulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "io/check_world.h"
#include "io/solid_limits.h"
#include "physics/physics_world.h"
#include "sim/core/assert.h"
#include "sim/core/error.h"
#include "sim/devices/aio.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/builtin.h"
#include "sim/devices/bumper.h"
#include "sim/devices/camera.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gripper.h"
#include "sim/devices/laser.h"
#include "sim/devices/motion.h"
#include "sim/devices/rangers.h"
#include "sim/devices/speech.h"
#include "sim/io/world_io.h"
#include "sim/world/limits.h"
#include "sim/world/view_mode.h"

namespace sim {
namespace {

constexpr std::size_t kKeptCollisions = 1024;
constexpr std::size_t kKeptUtterances = 1024;
// Of names in a message.
constexpr std::size_t kMostNames = 40;
// Clearances beyond this are told as this; it bounds the search round a robot.
constexpr double kClearanceLimit_m = 10.0;

// A look at a robot's clearance sees this much farther than the least so far: the farther, the more
// it costs, and the longer until the next one.
constexpr double kClearanceLookahead_m = 0.1;
// Up to so much beyond the least so far it is looked at exactly: a lower bound would be used up
// sooner.
constexpr double kClearanceExact_m = 0.05;

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

}  // namespace

struct Simulation::Impl {
  // What the devices of one robot may do to it.
  class Control final : public RobotControl {
   public:
    Control(Impl& owner, std::size_t robot) : impl_(owner), robot_(robot) {}

    [[nodiscard]] const BodyState& body() const override {
      return impl_.physics->body(static_cast<int>(robot_));
    }
    [[nodiscard]] std::optional<Pose> pose_by(int device) const override {
      const auto& devices = impl_.robots[robot_].devices;
      const auto index = static_cast<std::size_t>(device);
      if (device < 0 || index >= devices.size()) return std::nullopt;
      return devices[index]->believed_pose();
    }
    bool take_motors(const Device& device) override {
      RobotParts& robot = impl_.robots[robot_];
      if (robot.motion == nullptr) return false;
      if (dynamic_cast<const Motion*>(&device) != nullptr && &device != robot.motion) return false;
      for (const auto& other : robot.devices) {
        if (other.get() != &device) other->motors_taken();
      }
      return true;
    }
    void drive(const Twist& twist) override {
      Motion* motion = impl_.robots[robot_].motion;
      if (motion != nullptr) static_cast<void>(motion->apply(TwistCommand{twist}));
    }
    std::optional<std::string> place(const Pose& X_WB) override {
      return impl_.place(robot_, X_WB);
    }
    void say(const std::string& text) override { impl_.say(robot_, text); }
    [[nodiscard]] StepContext context() const override {
      return {impl_.now_ns, body(), *impl_.physics, static_cast<int>(robot_), impl_.world};
    }
    std::optional<std::string> pick_up(int obstacle) override {
      return impl_.pick_up(robot_, obstacle);
    }
    void carry_at(int obstacle, const Pose& X_BT, bool inside) override {
      impl_.carry_at(robot_, obstacle, X_BT, inside);
    }
    std::optional<std::string> put_down(int obstacle) override {
      return impl_.put_down(robot_, obstacle);
    }

   private:
    Impl& impl_;
    std::size_t robot_;
  };

  Impl(WorldDescription description, LogHook hook)
      : world(std::move(description)),
        log(std::move(hook)),
        physics(std::make_unique<PhysicsWorld>(world.arena)),
        layers(world.canvas),
        view_mode(world.canvas.view_mode) {
    start_obstacles = world.arena.obstacles;
    for (const RobotDescription& robot : world.robots) {
      start_looks.push_back({robot.colour, robot.fiducial});
      add_robot(robot);
    }
    connect_devices();
    for (std::size_t i = 0; i < robots.size(); ++i) measure_clearance(i, kClearanceLimit_m);
  }

  void add_robot(const RobotDescription& robot) {
    RobotParts parts;
    parts.model = find_robot_model(world, robot.model);
    SIM_ASSERT(parts.model != nullptr);
    const int index = physics->add_robot(*parts.model, robot.pose);
    for (const Vec2& v : parts.model->footprint) {
      parts.radius_m = std::max(parts.radius_m, v.norm());
    }
    parts.first_slot = static_cast<std::uint32_t>(slots.size());
    for (const DeviceDescription& device : robot.devices) {
      const DeviceKind* row = find_device_kind(device.type);
      SIM_ASSERT(row != nullptr);
      parts.devices.push_back(row->create(device, robot, *parts.model, world.simulation.seed));
      Device* made = parts.devices.back().get();
      auto* const sensor = dynamic_cast<Sensor*>(made);
      const bool last = dynamic_cast<const Aio*>(made) != nullptr ||
                        dynamic_cast<const Blobfinder*>(made) != nullptr ||
                        dynamic_cast<const Camera*>(made) != nullptr;
      slots.push_back({made, sensor == nullptr ? 0 : sensor->next_due_ns(),
                       static_cast<std::uint16_t>(parts.devices.size() - 1), sensor != nullptr,
                       true, last});
      actors.push_back({static_cast<std::size_t>(index), made});
      parts.any_last = parts.any_last || last;
      if (parts.motion == nullptr) parts.motion = dynamic_cast<Motion*>(made);
      if (parts.pen == nullptr) parts.pen = dynamic_cast<Pen*>(made);
    }
    if (parts.pen != nullptr) parts.pen->mark_trail(robot.pose, layers.base());
    parts.slot_count = static_cast<std::uint16_t>(parts.devices.size());
    parts.has_pen = parts.pen != nullptr;
    motions.push_back(parts.motion);
    parts.last_position = robot.pose.position();
    robots.push_back(std::move(parts));
    SIM_ASSERT(index + 1 == static_cast<int>(robots.size()));
  }

  class Directory final : public DeviceDirectory {
   public:
    explicit Directory(const Impl& owner) : impl_(owner) {}
    [[nodiscard]] const Device* find(std::string_view robot,
                                     std::string_view device) const override {
      for (std::size_t i = 0; i < impl_.robots.size(); ++i) {
        if (impl_.world.robots[i].name != robot) continue;
        for (const auto& made : impl_.robots[i].devices) {
          if (made->name() == device) return made.get();
        }
      }
      return nullptr;
    }

   private:
    const Impl& impl_;
  };

  // Throws ConfigError with all that devices miss.
  void connect_devices() {
    const Directory directory(*this);
    std::vector<ConfigIssue> issues;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      for (const auto& device : robots[i].devices) {
        if (const auto missing = device->connect(world.robots[i].name, directory)) {
          issues.push_back({"device/wiring", world.file,
                            "/robots/" + std::to_string(i) + "/devices/" + device->name(), *missing,
                            "none"});
        }
      }
    }
    if (!issues.empty()) throw ConfigError(std::move(issues));
  }

  void say(std::size_t robot, const std::string& text) {
    if (said.size() == kKeptUtterances) said.erase(said.begin());
    said.push_back({now_ns, static_cast<int>(robot), text});
    if (log) log(LogLevel::kInfo, "robot " + world.robots[robot].name + " says: " + text);
  }

  // Changes a block, unless something is against it: tells what.
  template <typename Edit>
  std::optional<std::string> change_block(const std::string& name, Edit edit) {
    auto& obstacles = world.arena.obstacles;
    const auto it = std::find_if(obstacles.begin(), obstacles.end(),
                                 [&](const ObstacleDescription& o) { return o.name == name; });
    SIM_ASSERT(it != obstacles.end());
    ObstacleDescription now = *it;
    edit(now);
    // A portable one may be put away beyond the floor, as programs for Stage do.
    const auto where = now.portable ? std::nullopt : io::outside_floor(world.arena, now);
    if (where) return "obstacle " + name + " would " + *where;
    if (const auto fault = io::box_fault(now)) {
      return "obstacle " + name + " cannot be so: expected " + fault->expected + ", found " +
             fault->found;
    }
    const int robot = physics->robot_within(now);
    if (robot >= 0 && now.state == ObstacleState::kExtended) {
      return "obstacle " + name + " cannot be put there: robot " +
             world.robots[static_cast<std::size_t>(robot)].name + " stands there";
    }
    const int index = static_cast<int>(it - obstacles.begin());
    *it = std::move(now);
    if (it->carried_by >= 0) let_go(index);
    physics->change_obstacle(index, *it);
    forget_clearances();
    return std::nullopt;
  }

  // --- What robots carry

  [[nodiscard]] ObstacleDescription& obstacle(int index) {
    return world.arena.obstacles.at(static_cast<std::size_t>(index));
  }

  std::optional<std::string> pick_up(std::size_t robot, int index) {
    ObstacleDescription& thing = obstacle(index);
    if (!thing.portable || thing.state != ObstacleState::kExtended || thing.carried_by >= 0) {
      return "obstacle " + thing.name + " cannot be taken: it is " +
             (!thing.portable         ? "not portable"
              : thing.carried_by >= 0 ? "carried already"
                                      : "retracted");
    }
    thing.carried_by = static_cast<int>(robot);
    const Pose X_WT{thing.center.x(), thing.center.y(), thing.yaw_rad};
    loads.push_back({robot, index, body_pose(robot).inverse() * X_WT, false});
    physics->set_extended(index, false);
    show_load(robot);
    forget_clearances();
    return std::nullopt;
  }

  void carry_at(std::size_t robot, int index, const Pose& X_BT, bool inside) {
    for (Load& load : loads) {
      if (load.robot != robot || load.obstacle != index) continue;
      load.X_BT = X_BT;
      load.inside = inside;
    }
    move_loads();
    show_load(robot);
  }

  std::optional<std::string> put_down(std::size_t robot, int index) {
    ObstacleDescription& thing = obstacle(index);
    if (thing.carried_by != static_cast<int>(robot)) {
      return "robot " + world.robots[robot].name + " does not carry obstacle " + thing.name;
    }
    std::vector<Pose> poses;
    for (int k = 0; k < physics->robot_count(); ++k) poses.push_back(physics->body(k).X_WB);
    if (const auto what = io::put_down_blocked_by(world, poses, robot, thing)) {
      return "obstacle " + thing.name + " cannot be put down: " + *what;
    }
    let_go(index);
    physics->change_obstacle(index, thing);
    forget_clearances();
    return std::nullopt;
  }

  // It stands again where its description says; the physics must still be told where that is.
  void let_go(int index) {
    const auto robot = static_cast<std::size_t>(std::exchange(obstacle(index).carried_by, -1));
    std::erase_if(loads, [&](const Load& load) { return load.obstacle == index; });
    physics->set_extended(index, true);
    show_load(robot);
  }

  // The physics is told what others see of a robot's load.
  void show_load(std::size_t robot) {
    std::vector<PhysicsWorld::Load> seen;
    for (const Load& load : loads) {
      if (load.robot != robot || load.inside) continue;
      seen.push_back({load.obstacle, obstacle(load.obstacle)});
      seen.back().box_B.center = load.X_BT.position();
      seen.back().box_B.yaw_rad = load.X_BT.yaw_rad;
    }
    physics->set_load(static_cast<int>(robot), seen);
  }

  void move_loads() {
    for (const Load& load : loads) {
      const Pose X_WT = body_pose(load.robot) * load.X_BT;
      obstacle(load.obstacle).center = X_WT.position();
      obstacle(load.obstacle).yaw_rad = normalize_angle(X_WT.yaw_rad);
    }
  }

  [[nodiscard]] const Pose& body_pose(std::size_t robot) const {
    return physics->body(static_cast<int>(robot)).X_WB;
  }

  // Lets devices steer. Those that do not are asked once.
  void act(double dt_s) {
    auto actor = actors.begin();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const auto begin = actor;
      while (actor != actors.end() && actor->robot == i) ++actor;
      // The command of a suspended robot's motors waits.
      if (physics->suspended(static_cast<int>(i))) continue;
      Control control(*this, i);
      for (auto own = begin; own != actor; ++own) {
        if (own->device->active()) own->device->act(control);
      }
      if (motions[i] != nullptr) {
        physics->set_target(static_cast<int>(i), motions[i]->next_target(dt_s));
      }
    }
    if (!asked) std::erase_if(actors, [](const Actor& a) { return !a.device->acts(); });
    asked = true;
  }

  void step() {
    const double dt_s = to_seconds(world.simulation.step_ns);
    act(dt_s);
    physics->step(dt_s);
    move_loads();
    now_ns += world.simulation.step_ns;
    ++steps;
    record_collisions();
    updated.clear();
    for (std::size_t i = 0; i < robots.size(); ++i) update_robot(i, dt_s);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (robots[i].any_last) update_devices(i, true);
    }
  }

  std::optional<std::string> place(std::size_t i, const Pose& X_WB) {
    std::vector<Pose> poses;
    for (int k = 0; k < physics->robot_count(); ++k) poses.push_back(physics->body(k).X_WB);
    if (const auto what = io::blocked_by(world, poses, i, X_WB)) {
      return "robot " + world.robots[i].name + " cannot be put there: " + *what;
    }
    if (!io::is_place(X_WB)) {
      return "robot " + world.robots[i].name + " cannot be put there: a pose takes finite numbers";
    }
    physics->set_pose(static_cast<int>(i), X_WB);
    robots[i].last_position = X_WB.position();  // the way there does not count
    move_loads();
    for (const auto& device : robots[i].devices) device->placed(X_WB);
    forget_clearances();
    return std::nullopt;
  }

  void reset() {
    world.arena.obstacles = start_obstacles;
    loads.clear();
    for (std::size_t i = 0; i < start_looks.size(); ++i) {
      world.robots[i].colour = start_looks[i].colour;
      world.robots[i].fiducial = start_looks[i].fiducial;
    }
    physics = std::make_unique<PhysicsWorld>(world.arena);
    layers.base().clear();
    const std::vector<RobotParts> before = std::exchange(robots, {});
    slots.clear();
    motions.clear();
    actors.clear();
    asked = false;
    for (const RobotDescription& robot : world.robots) add_robot(robot);
    connect_devices();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      robots[i].statistics = before[i].statistics;
      for (std::size_t k = 0; k < robots[i].devices.size(); ++k) {
        robots[i].devices[k]->succeed(*before[i].devices[k], now_ns);
        Slot& slot = slots[robots[i].first_slot + k];
        if (slot.is_sensor) slot.due_ns = slot.sensor().next_due_ns();
      }
    }
    updated.clear();
    forget_clearances();
  }

  // Something was put somewhere: clearances must be looked at anew.
  void forget_clearances() {
    for (RobotParts& robot : robots) robot.clearance_slack_m = 0.0;
  }

  void update_robot(std::size_t i, double dt_s) {
    RobotParts& robot = robots[i];
    const int index = static_cast<int>(i);
    const BodyState& body = physics->body(index);
    const Vec2 position = body.X_WB.position();
    robot.statistics.path_length_m += (position - robot.last_position).norm();
    robot.last_position = position;
    if (body.stalled) robot.statistics.stalled_time_s += dt_s;
    update_clearance(i, dt_s);
    if (robot.has_pen) robot.pen->mark_trail(body.X_WB, layers.base());
    update_devices(i, false);
  }

  // Of a robot's devices those that come last, or the others.
  void update_devices(std::size_t i, bool last) {
    RobotParts& robot = robots[i];
    const int index = static_cast<int>(i);
    const StepContext context{now_ns, physics->body(index), *physics, index, world};
    for (Slot& slot : std::span(slots).subspan(robot.first_slot, robot.slot_count)) {
      if (slot.last != last) continue;
      if (slot.integrates) {
        slot.device->integrate(context);
        slot.integrates = slot.device->integrates();
      }
      if (!slot.is_sensor || now_ns < slot.due_ns) continue;
      if (slot.sensor().update(context)) updated.push_back({index, slot.index});
      slot.due_ns = slot.sensor().next_due_ns();
    }
  }

  // How far any point of a robot can have moved in the last step, at most.
  [[nodiscard]] double move_m(std::size_t i, double dt_s) const {
    const BodyState& body = physics->body(static_cast<int>(i));
    return std::abs(body.travel_m) + std::abs(body.twist.lateral_mps) * dt_s +
           std::abs(body.turn_rad) * robots[i].radius_m;
  }

  // The least clearance so far can only fall once the robot and what is round it have moved by
  // the difference to what was measured last; until then there is no need to look.
  void update_clearance(std::size_t i, double dt_s) {
    RobotParts& robot = robots[i];
    if (robot.statistics.least_clearance_m <= 0.0) return;
    robot.clearance_slack_m -= move_m(i, dt_s) + physics->farthest_move_m();
    if (robot.clearance_slack_m > 0.0) return;
    measure_clearance(i, robot.statistics.least_clearance_m + kClearanceLookahead_m);
  }

  void measure_clearance(std::size_t i, double limit_m) {
    RobotParts& robot = robots[i];
    double& least_m = robot.statistics.least_clearance_m;
    const double exact_below_m = steps == 0 ? limit_m : least_m + kClearanceExact_m;
    const double clearance_m = physics->clearance_m(static_cast<int>(i), limit_m, exact_below_m);
    if (steps == 0 || clearance_m < least_m) least_m = clearance_m;
    robot.clearance_slack_m = clearance_m - least_m;
  }

  void record_collisions() {
    for (const PhysicsWorld::Contact& contact : physics->new_contacts()) {
      RobotStatistics& s = robots[static_cast<std::size_t>(contact.robot)].statistics;
      ++s.collisions;
      s.least_clearance_m = 0.0;
      if (collisions.size() == 2 * kKeptCollisions) forget_old_collisions();
      collisions.push_back({now_ns, contact.robot, partner_name(contact, world)});
    }
  }

  // Not with each one, which would move all that are kept.
  void forget_old_collisions() {
    if (collisions.size() <= kKeptCollisions) return;
    collisions.erase(collisions.begin(),
                     collisions.end() - static_cast<std::ptrdiff_t>(kKeptCollisions));
  }

  [[nodiscard]] Device& device(DeviceId id) const {
    return *robots.at(static_cast<std::size_t>(id.robot))
                .devices.at(static_cast<std::size_t>(id.device));
  }

  WorldDescription world;
  LogHook log;
  std::unique_ptr<PhysicsWorld> physics;
  LayerStack layers;
  ViewMode view_mode;
  std::vector<ObstacleDescription> start_obstacles;
  struct Look {
    Colour colour;
    int fiducial;
  };
  std::vector<Look> start_looks;  // of the robots
  std::vector<RobotParts> robots;
  std::vector<Slot> slots;       // in order of robot and device
  std::vector<Motion*> motions;  // of the robots
  // A device that steers, or was not yet asked to.
  struct Actor {
    std::size_t robot;
    Device* device;
  };
  std::vector<Actor> actors;  // in the same order
  bool asked = false;         // all of them, once
  // An obstacle that a robot carries.
  struct Load {
    std::size_t robot;
    int obstacle;
    Pose X_BT;    // of the thing in B
    bool inside;  // the robot, where nobody sees it
  };
  std::vector<Load> loads;
  std::vector<DeviceId> updated;
  std::vector<Collision> collisions;
  std::vector<Utterance> said;
  SimTime now_ns = 0;
  std::uint64_t steps = 0;
};

Simulation::Simulation(WorldDescription world, LogHook log) {
  std::vector<ConfigIssue> issues = io::check_world(world);
  if (!issues.empty()) throw ConfigError(std::move(issues));
  impl_ = std::make_unique<Impl>(std::move(world), std::move(log));
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step() { impl_->step(); }
SimTime Simulation::now_ns() const noexcept { return impl_->now_ns; }
std::uint64_t Simulation::steps() const noexcept { return impl_->steps; }

bool Simulation::finished() const noexcept {
  const auto& duration = impl_->world.simulation.duration_ns;
  return duration.has_value() && impl_->now_ns >= *duration;
}

const WorldDescription& Simulation::world() const noexcept { return impl_->world; }
int Simulation::robot_count() const noexcept { return static_cast<int>(impl_->robots.size()); }

const RobotModel& Simulation::model(int robot) const {
  return *impl_->robots.at(static_cast<std::size_t>(robot)).model;
}

const BodyState& Simulation::body(int robot) const {
  SIM_ASSERT(robot >= 0 && robot < robot_count());
  return impl_->physics->body(robot);
}

const RobotStatistics& Simulation::statistics(int robot) const {
  return impl_->robots.at(static_cast<std::size_t>(robot)).statistics;
}

const std::vector<Collision>& Simulation::collisions() const noexcept {
  impl_->forget_old_collisions();
  return impl_->collisions;
}

const std::vector<Utterance>& Simulation::said() const noexcept { return impl_->said; }

int Simulation::device_count(int robot) const {
  return static_cast<int>(impl_->robots.at(static_cast<std::size_t>(robot)).devices.size());
}

const Device& Simulation::device(int robot, int device) const {
  return *impl_->robots.at(static_cast<std::size_t>(robot))
              .devices.at(static_cast<std::size_t>(device));
}

std::optional<int> Simulation::find_device(int robot, const std::string& name) const {
  const auto& devices = impl_->robots.at(static_cast<std::size_t>(robot)).devices;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i]->name() == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::optional<int> Simulation::find_robot(const std::string& name) const {
  for (std::size_t i = 0; i < impl_->world.robots.size(); ++i) {
    if (impl_->world.robots[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

const std::vector<Simulation::DeviceId>& Simulation::updated() const noexcept {
  return impl_->updated;
}

std::optional<std::string> Simulation::apply(DeviceId id, const Command& command) {
  Device& device = impl_->device(id);
  if (!device.active()) {
    return "device " + impl_->world.robots[static_cast<std::size_t>(id.robot)].name + "." +
           device.name() + " is switched off: it takes no commands until it is on again";
  }
  Impl::Control control(*impl_, static_cast<std::size_t>(id.robot));
  return device.carry_out(command, control);
}

void Simulation::reset() { impl_->reset(); }

void Simulation::set_active(DeviceId id, bool active) {
  Impl::Control control(*impl_, static_cast<std::size_t>(id.robot));
  impl_->device(id).set_active(active, control);
}

bool Simulation::active(DeviceId id) const { return impl_->device(id).active(); }

std::optional<std::string> Simulation::set_dynamics(bool on) {
  for (int i = 0; i < robot_count(); ++i) impl_->physics->set_suspended(i, !on);
  return std::nullopt;
}

std::optional<std::string> Simulation::set_robot_dynamics(int robot, bool on) {
  if (robot < 0 || robot >= robot_count()) {
    return "there is no robot number " + std::to_string(robot) + "; this world has " +
           std::to_string(robot_count());
  }
  impl_->physics->set_suspended(robot, !on);
  return std::nullopt;
}

std::optional<std::string> Simulation::set_object_dynamics(const std::string& name, bool on) {
  if (const auto robot = find_robot(name)) return set_robot_dynamics(*robot, on);
  for (const SceneObject& object : scene_objects()) {
    if (object.name != name) continue;
    return object.kind + " \"" + name + "\" has no dynamics: it stands fast and moves for nobody" +
           (object.dynamic ? ", though it can be extended and retracted" : "");
  }
  return no_such_object(name);
}

bool Simulation::robot_dynamics(int robot) const {
  SIM_ASSERT(robot >= 0 && robot < robot_count());
  return !impl_->physics->suspended(robot);
}

std::vector<SceneObject> Simulation::scene_objects() const {
  const ArenaDescription& arena = impl_->world.arena;
  std::vector<SceneObject> objects;
  const auto add_box = [&objects](const ObstacleDescription& o, const char* kind) {
    objects.push_back({o.name,
                       kind,
                       {o.center.x(), o.center.y(), o.yaw_rad},
                       o.size,
                       o.type == ObstacleType::kDynamic,
                       o.state == ObstacleState::kExtended});
  };
  for (int i = 0; i < robot_count(); ++i) {
    Eigen::AlignedBox2d box;
    for (const Vec2& v : model(i).footprint) box.extend(v);
    objects.push_back({impl_->world.robots[static_cast<std::size_t>(i)].name, "robot", body(i).X_WB,
                       box.sizes(), true});
  }
  for (const ObstacleDescription& o : arena.obstacles) add_box(o, "block");
  for (const ObstacleDescription& o : arena.dock_separators) add_box(o, "separator");
  if (arena.border) {
    const Vec2 middle = arena.origin + 0.5 * arena.size;
    objects.push_back({"border", "border", {middle.x(), middle.y(), 0.0}, arena.size});
  }
  Eigen::AlignedBox2d walls;
  for (const WallLoop& loop : arena.walls) {
    for (const Vec2& v : loop.vertices) walls.extend(v);
  }
  if (!walls.isEmpty()) {
    const Vec2 middle = walls.center();
    objects.push_back({"wall", "wall", {middle.x(), middle.y(), 0.0}, walls.sizes()});
  }
  return objects;
}

std::optional<SceneObject> Simulation::find_object(const std::string& name) const {
  std::vector<SceneObject> objects = scene_objects();
  const auto it = std::find_if(objects.begin(), objects.end(),
                               [&](const SceneObject& object) { return object.name == name; });
  if (it == objects.end()) return std::nullopt;
  return std::move(*it);
}

std::string Simulation::no_such_object(const std::string& name) const {
  const std::vector<SceneObject> objects = scene_objects();
  std::string known;
  for (std::size_t i = 0; i < std::min(objects.size(), kMostNames); ++i) {
    known += (i == 0 ? "" : ", ") + objects[i].name;
  }
  if (objects.size() > kMostNames) {
    known += " and " + std::to_string(objects.size() - kMostNames) + " more";
  }
  return "there is no robot or obstacle named \"" + name +
         "\"; this world has: " + (known.empty() ? "nothing" : known);
}

std::optional<std::string> Simulation::place_object(const std::string& name, const Pose& pose) {
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  if (object->kind == "robot") {
    const auto robot = static_cast<std::size_t>(*find_robot(name));
    Motion* motion = impl_->robots[robot].motion;
    const Twist told = motion == nullptr ? Twist{} : motion->commanded();
    if (auto refusal = impl_->place(robot, pose)) return refusal;
    if (motion != nullptr && told != Twist{}) {
      static_cast<void>(motion->apply(TwistCommand{told}));
    }
    return std::nullopt;
  }
  if (object->kind != "block") return object->kind + " \"" + name + "\" stands fast";
  return impl_->change_block(name, [&](ObstacleDescription& block) {
    block.center = pose.position();
    block.yaw_rad = pose.yaw_rad;
  });
}

std::optional<std::string> Simulation::set_block_size(const std::string& name, const Vec2& size_m,
                                                      double height_m) {
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  if (object->kind != "block") return object->kind + " \"" + name + "\" keeps its size";
  // As a world's reader has it; Box2D makes nothing of smaller boxes.
  if (!(size_m.minCoeff() >= kLeastLength_m && height_m >= kLeastLength_m)) {
    return "the sides and the height of a block are at least 0.001 m";
  }
  return impl_->change_block(name, [&](ObstacleDescription& block) {
    block.size = size_m;
    block.height_m = height_m;
  });
}

std::optional<std::string> Simulation::set_object_colour(const std::string& name, Colour colour) {
  if (const auto robot = find_robot(name)) {
    impl_->world.robots[static_cast<std::size_t>(*robot)].colour = colour;
    return std::nullopt;
  }
  for (ObstacleDescription& block : impl_->world.arena.obstacles) {
    if (block.name != name) continue;
    block.colour = colour;
    return std::nullopt;
  }
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  return object->kind + " \"" + name + "\" keeps its colour";
}

std::optional<std::string> Simulation::set_object_fiducial(const std::string& name, int fiducial) {
  if (fiducial < 0) return "the number of a fiducial is at least 0";
  if (const auto robot = find_robot(name)) {
    impl_->world.robots[static_cast<std::size_t>(*robot)].fiducial = fiducial;
    return std::nullopt;
  }
  for (ObstacleDescription& block : impl_->world.arena.obstacles) {
    if (block.name != name) continue;
    block.fiducial = fiducial;
    return std::nullopt;
  }
  const std::optional<SceneObject> object = find_object(name);
  if (!object) return no_such_object(name);
  return object->kind + " \"" + name + "\" bears no fiducial";
}

LayerStack& Simulation::layers() noexcept { return impl_->layers; }
const LayerStack& Simulation::layers() const noexcept { return impl_->layers; }
Canvas& Simulation::canvas() noexcept { return impl_->layers.base(); }
const Canvas& Simulation::canvas() const noexcept { return impl_->layers.base(); }

ViewMode Simulation::view_mode() const noexcept { return impl_->view_mode; }

std::optional<std::string> Simulation::set_view_mode(ViewMode mode) {
  if (mode == impl_->view_mode) return std::nullopt;
  if (impl_->world.canvas.view_mode_locked) {
    return "the view mode cannot be changed to \"" + std::string(to_string(mode)) +
           "\": the world locks it at \"" + std::string(to_string(impl_->view_mode)) + "\"";
  }
  impl_->view_mode = mode;
  return std::nullopt;
}

std::optional<std::string> Simulation::set_obstacle_state(const std::string& name,
                                                          ObstacleState state) {
  auto& obstacles = impl_->world.arena.obstacles;
  const auto it = std::find_if(obstacles.begin(), obstacles.end(),
                               [&](const ObstacleDescription& o) { return o.name == name; });
  if (it == obstacles.end()) return "there is no obstacle named \"" + name + "\"";
  if (it->type == ObstacleType::kStatic) {
    return "obstacle \"" + name + "\" is static: it can be neither extended nor retracted";
  }
  if (it->carried_by >= 0) {
    return "obstacle \"" + name + "\" is carried by robot " +
           impl_->world.robots[static_cast<std::size_t>(it->carried_by)].name;
  }
  const int index = static_cast<int>(it - obstacles.begin());
  const bool extend = state == ObstacleState::kExtended;
  if (it->state == state) return std::nullopt;
  if (extend && impl_->physics->robot_stands_on(index)) {
    return "obstacle \"" + name + "\" cannot be extended: a robot stands on it";
  }
  impl_->physics->set_extended(index, extend);
  it->state = state;
  impl_->forget_clearances();
  return std::nullopt;
}

std::uint64_t Simulation::state_hash() const {
  StateHash hash;
  hash.add(impl_->now_ns);
  hash.add(impl_->steps);
  impl_->physics->hash(hash);
  for (const RobotParts& robot : impl_->robots) {
    for (const auto& device : robot.devices) {
      device->hash(hash);
      if (!device->active()) hash.add("off " + device->name());
    }
    hash.add(robot.statistics.path_length_m);
    hash.add(robot.statistics.collisions);
    hash.add(robot.statistics.least_clearance_m);
    hash.add(robot.statistics.stalled_time_s);
  }
  for (std::size_t i = 0; i < impl_->start_looks.size(); ++i) {
    const int fiducial = impl_->world.robots[i].fiducial;
    if (fiducial == impl_->start_looks[i].fiducial) continue;
    hash.add("fiducial of " + impl_->world.robots[i].name);
    hash.add(fiducial);
  }
  // Blocks that are where they were at the start, as nearly always, leave the hash as it was.
  for (std::size_t i = 0; i < impl_->start_obstacles.size(); ++i) {
    const ObstacleDescription& start = impl_->start_obstacles[i];
    const ObstacleDescription& now = impl_->world.arena.obstacles[i];
    if (now.center == start.center && now.size == start.size && now.yaw_rad == start.yaw_rad &&
        now.height_m == start.height_m && now.fiducial == start.fiducial) {
      continue;
    }
    for (const double x : {static_cast<double>(i), now.center.x(), now.center.y(), now.size.x(),
                           now.size.y(), now.yaw_rad, now.height_m}) {
      hash.add(x);
    }
    if (now.fiducial != start.fiducial) hash.add(now.fiducial);
  }
  for (const Impl::Load& load : impl_->loads) {
    for (const double x : {static_cast<double>(load.obstacle), load.X_BT.x_m, load.X_BT.y_m,
                           load.X_BT.yaw_rad, load.inside ? 1.0 : 0.0}) {
      hash.add(x);
    }
  }
  impl_->layers.base().hash(hash);
  return hash.value();
}

namespace {

// What a picture shows of the readings of one device.
void add_readings(const Device& device, RobotSnapshot& shot) {
  if (const auto* ranger = dynamic_cast<const Ranger*>(&device)) {
    const RangerReading& round = ranger->reading();
    if (round.sequence == 0) return;
    for (std::size_t i = 0; i < round.ranges_m.size(); ++i) {
      shot.cones.push_back({round.X_WB * round.X_BS[i], round.ranges_m[i], round.field_of_view_rad,
                            round.ranges_m[i] < round.range_max_m});
    }
  } else if (const auto* bumper = dynamic_cast<const Bumper*>(&device)) {
    for (std::size_t i = 0; i < bumper->segments().size(); ++i) {
      shot.bumpers.push_back({line_of(bumper->segments()[i]), bumper->reading().pressed[i] != 0});
    }
  } else if (const auto* finder = dynamic_cast<const FiducialFinder*>(&device)) {
    const FiducialReading& seen = finder->reading();
    for (const auto& mark : seen.marks) {
      shot.sights.emplace_back(seen.X_WS.position(), seen.X_WS * mark.X_ST.position());
    }
  } else if (const auto* gripper = dynamic_cast<const Gripper*>(&device)) {
    for (Polygon& paddle : gripper->paddles()) shot.paddles.push_back(std::move(paddle));
  }
}

}  // namespace

RobotSnapshot Simulation::robot_snapshot(int number) const {
  const auto i = static_cast<std::size_t>(number);
  const RobotParts& robot = impl_->robots[i];
  const BodyState& body = impl_->physics->body(number);
  RobotSnapshot shot;
  shot.name = impl_->world.robots[i].name;
  shot.colour = impl_->world.robots[i].colour;
  shot.X_WB = body.X_WB;
  shot.footprint = robot.model->footprint;
  shot.stalled = body.stalled;
  for (const auto& device : robot.devices) {
    if (const auto* speech = dynamic_cast<const Speech*>(device.get())) {
      if (!speech->text().empty()) shot.says = speech->text();
    } else if (const auto* light = dynamic_cast<const Blinkenlight*>(device.get())) {
      shot.lights.push_back(
          {light->params().p_BL, light->colour(), light->lit(impl_->now_ns) && light->active()});
    }
  }
  for (const auto& device : robot.devices) {
    const auto* laser = dynamic_cast<const Laser*>(device.get());
    if (laser == nullptr || laser->reading().sequence == 0) continue;
    const LaserReading& scan = laser->reading();
    const Pose X_WL = scan.X_WB * laser->params().X_BL;
    shot.scan_origin = X_WL.position();
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double angle = scan.angle_min_rad + scan.resolution_rad * static_cast<double>(beam);
      shot.scan_points.push_back(X_WL * Vec2(scan.ranges_m[beam] * std::cos(angle),
                                             scan.ranges_m[beam] * std::sin(angle)));
    }
    break;
  }
  for (const auto& device : robot.devices) add_readings(*device, shot);
  return shot;
}

SceneSnapshot Simulation::snapshot() const {
  SceneSnapshot scene;
  scene.world_name = impl_->world.name;
  scene.arena = impl_->world.arena;
  scene.canvas_description = impl_->layers.description();
  scene.canvas = impl_->layers.composed();
  scene.layers = impl_->layers.layers();
  scene.view_mode = impl_->view_mode;
  scene.time_s = to_seconds(impl_->now_ns);
  for (int i = 0; i < robot_count(); ++i) scene.robots.push_back(robot_snapshot(i));
  return scene;
}

}  // namespace sim
