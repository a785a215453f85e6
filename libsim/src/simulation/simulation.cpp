// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include "io/check_world.h"
#include "sim/core/assert.h"
#include "sim/core/error.h"
#include "sim/devices/builtin.h"
#include "sim/devices/realism.h"
#include "sim/world/view_mode.h"
#include "simulation/blocks.h"
#include "simulation/controller.h"
#include "simulation/loads.h"
#include "simulation/obstacle_motions.h"

namespace sim {
namespace {

// Maximum reported clearance; it limits the search around a robot.
constexpr double kClearanceLimit_m = 10.0;

// Margin of a clearance measurement beyond the least clearance so far. A larger margin costs more,
// but delays the next measurement.
constexpr double kClearanceLookahead_m = 0.1;
// Up to this margin the clearance is measured exactly, since a lower bound would require the next
// measurement sooner.
constexpr double kClearanceExact_m = 0.05;

// The world in which obstacles that the arena controller moves have a drive.
WorldDescription with_drives(WorldDescription world) {
  const auto give_drives = [&world](const std::vector<ArenaAction>& actions) {
    for (const ArenaAction& action : actions) {
      const auto* move = std::get_if<MoveAction>(&action);
      if (move == nullptr) continue;
      const auto index = find_named(world.arena.obstacles, move->obstacle);
      if (!index) continue;
      ObstacleDescription& obstacle = world.arena.obstacles[static_cast<std::size_t>(*index)];
      if (!obstacle.motion) obstacle.motion.emplace();
    }
  };
  for (const TimerDescription& timer : world.controller.timers) give_drives(timer.actions);
  for (const TrapDescription& trap : world.controller.traps) give_drives(trap.actions);
  return world;
}

}  // namespace

// The actions that the devices of one robot may perform on it.
class Simulation::Impl::Control final : public RobotControl {
 public:
  Control(Impl& owner, std::size_t robot) : impl_(owner), robot_(robot) {}

  [[nodiscard]] const BodyState& body() const override {
    return impl_.physics->body(static_cast<int>(robot_));
  }
  [[nodiscard]] std::optional<Pose> pose_estimate_of(int device) const override {
    const auto& devices = impl_.robots[robot_].devices;
    const auto index = static_cast<std::size_t>(device);
    if (device < 0 || index >= devices.size()) return std::nullopt;
    return devices[index]->pose_estimate();
  }
  bool acquire_motors(const Device& device) override {
    RobotParts& robot = impl_.robots[robot_];
    if (robot.motion == nullptr) return false;
    const auto is_other_motion = [&](const std::unique_ptr<Device>& own) {
      return own.get() == &device && own->motion() != nullptr && own->motion() != robot.motion;
    };
    if (std::ranges::any_of(robot.devices, is_other_motion)) return false;
    for (const auto& other : robot.devices) {
      if (other.get() != &device) other->on_motors_taken();
    }
    return true;
  }
  void drive(const Twist& twist) override {
    Motion* motion = impl_.robots[robot_].motion;
    if (motion != nullptr) static_cast<void>(motion->apply(TwistCommand{twist}));
  }
  std::optional<std::string> place(const Pose& X_WB) override { return impl_.place(robot_, X_WB); }
  void elevate(const Elevation& elevation) override {
    impl_.physics->set_elevation(static_cast<int>(robot_), elevation);
  }
  void say(const std::string& text) override { impl_.say(robot_, text); }
  [[nodiscard]] StepContext context() const override {
    return {impl_.now_ns, body(), *impl_.physics, static_cast<int>(robot_), impl_.world};
  }
  std::optional<std::string> pick_up(int obstacle) override {
    return impl_.loads->pick_up(robot_, obstacle);
  }
  void carry_at(int obstacle, const Pose& X_BT, bool inside) override {
    impl_.loads->carry_at(robot_, obstacle, X_BT, inside);
  }
  std::optional<std::string> put_down(int obstacle) override {
    return impl_.loads->put_down(robot_, obstacle);
  }

 private:
  Impl& impl_;
  std::size_t robot_;
};

class Simulation::Impl::Directory final : public DeviceDirectory {
 public:
  explicit Directory(const Impl& owner) : impl_(owner) {}
  [[nodiscard]] const Device* find(std::string_view robot, std::string_view device) const override {
    for (std::size_t i = 0; i < impl_.robots.size(); ++i) {
      if (impl_.world.robots[i].name != robot) continue;
      for (const auto& made : impl_.robots[i].devices) {
        if (made->name() == device) return made.get();
      }
    }
    return nullptr;
  }
  // Devices are connected before anything changes in the arena.
  [[nodiscard]] const ArenaDescription& arena() const override { return impl_.world.arena; }

 private:
  const Impl& impl_;
};

Simulation::Impl::Impl(WorldDescription description, LogHook hook, bool to_be_read)
    : world(with_drives(std::move(description))),
      chronicle(std::move(hook)),
      physics(std::make_unique<PhysicsWorld>(world.arena)),
      layers(world.canvas),
      view_mode(world.canvas.view_mode),
      loads(std::make_unique<Loads>(*this)),
      blocks(std::make_unique<Blocks>(*this)) {
  start_obstacles = world.arena.obstacles;
  for (const RobotDescription& robot : world.robots) {
    start_appearances.push_back({robot.colour, robot.fiducial});
    add_robot(robot);
  }
  connect_devices();
  add_moving_obstacles();
  if (!world.controller.empty()) controller = std::make_unique<Controller>(*this);
  const auto makes_events = [](const ObstacleDescription& obstacle) {
    return obstacle.rise_speed_mps > 0.0 || obstacle.motion ||
           obstacle.when_blocked == WhenBlocked::kWait;
  };
  if (controller || std::ranges::any_of(world.arena.obstacles, makes_events)) {
    chronicle.begin_events();
  }
  if (to_be_read) return;
  for (std::size_t i = 0; i < robots.size(); ++i) measure_clearance(i, kClearanceLimit_m, true);
}

Simulation::Impl::~Impl() = default;

void Simulation::Impl::add_robot(const RobotDescription& robot) {
  RobotParts parts;
  parts.model = find_robot_model(world, robot.model);
  SIM_ASSERT(parts.model != nullptr);
  const int index = physics->add_robot(*parts.model, robot.pose);
  physics->set_elevation(index, robot.elevation);
  for (const Vec2& v : parts.model->footprint) {
    parts.radius_m = std::max(parts.radius_m, v.norm());
  }
  parts.first_slot = static_cast<std::uint32_t>(slots.size());
  for (const DeviceDescription& device : robot.devices) {
    const DeviceKind* row = find_device_kind(device.type);
    SIM_ASSERT(row != nullptr);
    parts.devices.push_back(row->create(device, robot, *parts.model, world.simulation.seed));
    Device* made = parts.devices.back().get();
    const Sensor* const sensor = made->sensor();
    const bool after_others = made->measures_after_others();
    slots.push_back({made, sensor == nullptr ? 0 : sensor->next_due_ns(),
                     static_cast<std::uint16_t>(parts.devices.size() - 1), sensor != nullptr, true,
                     after_others});
    actors.push_back({static_cast<std::size_t>(index), made});
    parts.any_measures_after_others = parts.any_measures_after_others || after_others;
    if (parts.motion == nullptr) parts.motion = made->motion();
    if (parts.pen == nullptr) parts.pen = made->pen();
  }
  if (parts.pen != nullptr) parts.pen->mark_trail(robot.pose, layers.base());
  parts.slot_count = static_cast<std::uint16_t>(parts.devices.size());
  parts.has_pen = parts.pen != nullptr;
  motions.push_back(parts.motion);
  parts.last_position = robot.pose.position();
  robots.push_back(std::move(parts));
  SIM_ASSERT(index + 1 == static_cast<int>(robots.size()));
}

void Simulation::Impl::connect_devices() {
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

void Simulation::Impl::add_moving_obstacles() {
  obstacle_motions.reset();
  const auto& obstacles = world.arena.obstacles;
  if (std::none_of(obstacles.begin(), obstacles.end(), is_movable)) return;
  obstacle_motions = std::make_unique<ObstacleMotions>(*this);
}

void Simulation::Impl::say(std::size_t robot, const std::string& text) {
  chronicle.add_spoken({now_ns, static_cast<int>(robot), text}, world.robots[robot].name);
}

void Simulation::Impl::reset() {
  world.arena.obstacles = start_obstacles;
  loads->reset();
  blocks->reset();
  for (std::size_t i = 0; i < start_appearances.size(); ++i) {
    world.robots[i].colour = start_appearances[i].colour;
    world.robots[i].fiducial = start_appearances[i].fiducial;
  }
  physics = std::make_unique<PhysicsWorld>(world.arena);
  layers.base().clear();
  const std::vector<RobotParts> before = std::exchange(robots, {});
  slots.clear();
  motions.clear();
  actors.clear();
  all_actors_called = false;
  for (const RobotDescription& robot : world.robots) add_robot(robot);
  connect_devices();
  add_moving_obstacles();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i].statistics = before[i].statistics;
    for (std::size_t k = 0; k < robots[i].devices.size(); ++k) {
      robots[i].devices[k]->take_over_from(*before[i].devices[k], now_ns);
    }
    note_due_times(i);
  }
  updated.clear();
  invalidate_clearances();
  // As at the start, so that the next measurement starts from the same state.
  for (std::size_t i = 0; i < robots.size(); ++i) {
    static_cast<void>(
        physics->clearance_m(static_cast<int>(i), kClearanceLimit_m, kClearanceLimit_m));
  }
  if (controller) controller->reset();
  record(ArenaEventKind::kReset, "world");
}

void Simulation::Impl::note_due_times(std::size_t i) {
  for (Slot& slot : std::span(slots).subspan(robots[i].first_slot, robots[i].slot_count)) {
    if (slot.is_sensor) slot.due_ns = slot.sensor().next_due_ns();
  }
}

// --- A step. Functions that each robot needs in every step are inline.

void Simulation::Impl::record_collisions() {
  for (const PhysicsWorld::Contact& contact : physics->new_contacts()) {
    if (world.robots[static_cast<std::size_t>(contact.robot)].real) continue;
    RobotStatistics& s = robots[static_cast<std::size_t>(contact.robot)].statistics;
    ++s.collisions;
    s.least_clearance_m = 0.0;
    const Vec2 middle = physics->body(contact.robot).X_WB.position();
    chronicle.add_collision(
        {now_ns, contact.robot, partner_name(contact, world), contact.p_WC.value_or(middle)});
  }
}

void Simulation::Impl::invalidate_clearances() {
  for (RobotParts& robot : robots) {
    robot.clearance_slack_m = 0.0;
    robot.clearance_settled = false;
  }
}

inline double Simulation::Impl::move_m(std::size_t i, double dt_s) const {
  const BodyState& body = physics->body(static_cast<int>(i));
  return std::abs(body.travel_m) + std::abs(body.twist.lateral_mps) * dt_s +
         std::abs(body.turn_rad) * robots[i].radius_m;
}

void Simulation::Impl::measure_clearance(std::size_t i, double limit_m, bool is_first) {
  RobotParts& robot = robots[i];
  double& least_m = robot.statistics.least_clearance_m;
  const double exact_below_m = is_first ? limit_m : least_m + kClearanceExact_m;
  const double clearance_m = physics->clearance_m(static_cast<int>(i), limit_m, exact_below_m);
  const bool is_least = is_first || clearance_m < least_m;
  if (is_least) least_m = clearance_m;
  robot.clearance_slack_m = clearance_m - least_m;
  robot.clearance_settled = !is_least && physics->clearance_settled(static_cast<int>(i));
}

inline void Simulation::Impl::update_clearance(std::size_t i, double dt_s) {
  RobotParts& robot = robots[i];
  if (robot.statistics.least_clearance_m <= 0.0) return;
  const double moved_m = move_m(i, dt_s) + physics->farthest_move_m();
  robot.clearance_slack_m -= moved_m;
  if (robot.clearance_slack_m > 0.0) return;
  if (moved_m == 0.0 && robot.clearance_settled) return;
  measure_clearance(i, robot.statistics.least_clearance_m + kClearanceLookahead_m);
}

inline void Simulation::Impl::update_devices(std::size_t i, bool measures_after_others) {
  RobotParts& robot = robots[i];
  const int index = static_cast<int>(i);
  const StepContext context{now_ns, physics->body(index), *physics, index, world};
  for (Slot& slot : std::span(slots).subspan(robot.first_slot, robot.slot_count)) {
    if (slot.measures_after_others != measures_after_others) continue;
    if (slot.integrates) {
      slot.device->integrate(context);
      slot.integrates = slot.device->integrates();
    }
    if (!slot.is_sensor || now_ns < slot.due_ns) continue;
    if (slot.sensor().update(context)) updated.push_back({index, slot.index});
    slot.due_ns = slot.sensor().next_due_ns();
  }
}

inline void Simulation::Impl::update_robot(std::size_t i, double dt_s) {
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

inline void Simulation::Impl::act(double dt_s) {
  auto actor = actors.begin();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto begin = actor;
    while (actor != actors.end() && actor->robot == i) ++actor;
    // The motors of a suspended robot keep their command.
    if (physics->suspended(static_cast<int>(i))) continue;
    Control control(*this, i);
    for (auto own = begin; own != actor; ++own) {
      if (own->device->active()) own->device->act(control);
    }
    if (motions[i] != nullptr) {
      physics->set_target(static_cast<int>(i), motions[i]->next_target(dt_s));
    }
  }
  if (!all_actors_called) std::erase_if(actors, [](const Actor& a) { return !a.device->acts(); });
  all_actors_called = true;
}

void Simulation::Impl::step() {
  const double dt_s = to_seconds(world.simulation.step_ns);
  if (controller) controller->before_step();
  act(dt_s);
  if (obstacle_motions) obstacle_motions->before_step(dt_s);
  physics->step(dt_s);
  loads->follow_robots();
  now_ns += world.simulation.step_ns;
  ++steps;
  if (!box2d_since_ns && physics->used_box2d()) box2d_since_ns = now_ns;
  if (obstacle_motions) obstacle_motions->after_step();
  record_collisions();
  blocks->after_step(dt_s);
  updated.clear();
  for (std::size_t i = 0; i < robots.size(); ++i) update_robot(i, dt_s);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i].any_measures_after_others) update_devices(i, true);
  }
  if (controller) controller->after_step();
}

// --- Simulation

Simulation::Simulation(WorldDescription world, LogHook log) {
  std::vector<ConfigIssue> issues = io::check_world(world);
  if (!issues.empty()) throw ConfigError(std::move(issues));
  apply_realism(world);
  impl_ = std::make_unique<Impl>(std::move(world), std::move(log));
}

Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step() { impl_->step(); }
SimTime Simulation::now_ns() const noexcept { return impl_->now_ns; }
std::uint64_t Simulation::steps() const noexcept { return impl_->steps; }

std::optional<SimTime> Simulation::box2d_since_ns() const noexcept { return impl_->box2d_since_ns; }

bool Simulation::finished() const noexcept {
  const auto& duration = impl_->world.simulation.duration_ns;
  if (duration.has_value() && impl_->now_ns >= *duration) return true;
  return impl_->controller && impl_->controller->verdict().has_value();
}

const WorldDescription& Simulation::world() const noexcept { return impl_->world; }
int Simulation::robot_count() const noexcept { return static_cast<int>(impl_->robots.size()); }

const RobotModel& Simulation::model(int robot) const {
  return *impl_->robots.at(static_cast<std::size_t>(robot)).model;
}

bool Simulation::sees(int robot, int other) const {
  const PhysicsWorld& physics = *impl_->physics;
  return physics.is_line_free(physics.body(robot).X_WB.position(),
                              physics.body(other).X_WB.position(), 0.5 * physics.height_m(robot),
                              robot, {other, PhysicsWorld::Contact::Kind::kRobot, other});
}

const BodyState& Simulation::body(int robot) const {
  SIM_ASSERT(robot >= 0 && robot < robot_count());
  return impl_->physics->body(robot);
}

const RobotStatistics& Simulation::statistics(int robot) const {
  return impl_->robots.at(static_cast<std::size_t>(robot)).statistics;
}

void Simulation::restart_statistics() {
  ++interventions_;
  for (std::size_t i = 0; i < impl_->robots.size(); ++i) {
    impl_->robots[i].statistics = {};
    impl_->measure_clearance(i, kClearanceLimit_m, /*is_first=*/true);
  }
}

const std::vector<Collision>& Simulation::collisions() const noexcept {
  impl_->chronicle.forget_old_collisions();
  return impl_->chronicle.collisions();
}

bool Simulation::records_arena_events() const noexcept { return impl_->chronicle.records_events(); }

const ArenaEvents& Simulation::arena_events() const noexcept { return impl_->chronicle.events(); }

const std::vector<SpokenText>& Simulation::spoken_texts() const noexcept {
  return impl_->chronicle.spoken_texts();
}

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
  return find_named(impl_->world.robots, name);
}

const std::vector<Simulation::DeviceId>& Simulation::updated() const noexcept {
  return impl_->updated;
}

std::optional<LaserReading> Simulation::ideal_scan(DeviceId laser) const {
  const auto* const device = dynamic_cast<const Laser*>(&impl_->device(laser));
  if (device == nullptr) return std::nullopt;
  return device->ideal_scan({impl_->now_ns, impl_->physics->body(laser.robot), *impl_->physics,
                             laser.robot, impl_->world});
}

bool Simulation::ideal_scan(DeviceId laser, const scan::ScanGeometry& geometry,
                            scan::ScanWorkspace& workspace, std::span<float> ranges_m) const {
  const auto* const device = dynamic_cast<const Laser*>(&impl_->device(laser));
  if (device == nullptr) return false;
  device->ideal_scan({impl_->now_ns, impl_->physics->body(laser.robot), *impl_->physics,
                      laser.robot, impl_->world},
                     geometry, workspace, ranges_m);
  return true;
}

std::optional<std::string> Simulation::apply(DeviceId id, const Command& command) {
  if (watch_) watch_(id, command);
  Device& device = impl_->device(id);
  if (!device.active()) {
    return "device " + impl_->world.robots[static_cast<std::size_t>(id.robot)].name + "." +
           device.name() + " is switched off: it takes no commands until it is on again";
  }
  Impl::Control control(*impl_, static_cast<std::size_t>(id.robot));
  return device.execute(command, control);
}

std::optional<std::string> Simulation::reset() {
  ++interventions_;
  if (auto refusal = refusal_of_mirrored()) return refusal;
  impl_->reset();
  return std::nullopt;
}

void Simulation::set_active(DeviceId id, bool active) {
  ++interventions_;
  Impl::Control control(*impl_, static_cast<std::size_t>(id.robot));
  impl_->device(id).set_active(active, control);
}

bool Simulation::Impl::set_fault(std::size_t robot, const FaultAction& fault) {
  const std::optional<int> index = find_named(world.robots[robot].devices, fault.device);
  if (!index) return false;
  Device& device = *robots[robot].devices[static_cast<std::size_t>(*index)];
  if (fault.kind == FaultAction::Kind::kJump) {
    const std::optional<Pose> estimate = device.pose_estimate();
    return estimate && !device.apply(SetPoseCommand{*estimate * fault.by});
  }
  Control control(*this, robot);
  device.set_blind(fault.kind == FaultAction::Kind::kBlind);
  device.set_active(fault.kind != FaultAction::Kind::kDead, control);
  return true;
}

bool Simulation::active(DeviceId id) const { return impl_->device(id).active(); }

std::optional<std::string> Simulation::set_dynamics(bool on) {
  ++interventions_;
  if (auto refusal = refusal_of_mirrored()) return refusal;
  for (int i = 0; i < robot_count(); ++i) impl_->physics->set_suspended(i, !on);
  for (int i = 0; i < static_cast<int>(world().arena.obstacles.size()); ++i) {
    const int body = impl_->physics->body_of_obstacle(i);
    if (body >= 0) impl_->physics->set_suspended(body, !on);
  }
  return std::nullopt;
}

std::optional<std::string> Simulation::set_robot_dynamics(int robot, bool on) {
  ++interventions_;
  if (robot < 0 || robot >= robot_count()) {
    return "there is no robot number " + std::to_string(robot) + "; this world has " +
           std::to_string(robot_count());
  }
  if (auto refusal = impl_->refusal_of_mirrored(static_cast<std::size_t>(robot))) return refusal;
  impl_->physics->set_suspended(robot, !on);
  return std::nullopt;
}

bool Simulation::robot_dynamics(int robot) const {
  SIM_ASSERT(robot >= 0 && robot < robot_count());
  return !impl_->physics->suspended(robot);
}

LayerStack& Simulation::layers() noexcept { return impl_->layers; }
const LayerStack& Simulation::layers() const noexcept { return impl_->layers; }
Canvas& Simulation::canvas() noexcept { return impl_->layers.base(); }
const Canvas& Simulation::canvas() const noexcept { return impl_->layers.base(); }

ViewMode Simulation::view_mode() const noexcept { return impl_->view_mode; }

std::optional<std::string> Simulation::set_view_mode(ViewMode mode) {
  if (mode == impl_->view_mode) return std::nullopt;
  ++interventions_;
  if (impl_->world.canvas.view_mode_locked) {
    return "the view mode cannot be changed to \"" + std::string(to_string(mode)) +
           "\": the world locks it at \"" + std::string(to_string(impl_->view_mode)) + "\"";
  }
  impl_->view_mode = mode;
  return std::nullopt;
}

}  // namespace sim
