// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/physics_world.h"

#include <cmath>

#include "physics/bodies.h"
#include "physics/contacts.h"
#include "physics/mover.h"
#include "physics/neighbours.h"
#include "physics/sensor_view.h"
#include "sim/core/math.h"

namespace sim {

struct PhysicsWorld::Impl {
  explicit Impl(const ArenaDescription& arena) : bodies(arena) {}

  void something_was_placed() {
    neighbours.invalidate();
    sensor_view.robots_changed();
  }

  physics::Bodies bodies;
  physics::Contacts contacts{bodies};
  physics::Neighbours neighbours{bodies};
  physics::Mover mover{bodies, neighbours};
  physics::SensorView sensor_view{bodies};
};

PhysicsWorld::PhysicsWorld(const ArenaDescription& arena) : impl_(std::make_unique<Impl>(arena)) {}

PhysicsWorld::~PhysicsWorld() = default;

int PhysicsWorld::add_robot(const RobotModel& model, const Pose& X_WB) {
  const int robot = impl_->bodies.add_robot(model, X_WB);
  impl_->sensor_view.add_robot(robot);
  impl_->something_was_placed();
  return robot;
}

int PhysicsWorld::robot_count() const noexcept {
  return static_cast<int>(impl_->bodies.robot_count());
}

int PhysicsWorld::add_moving_obstacle(int obstacle, const ObstacleDescription& description) {
  const int body = impl_->bodies.add_moving_obstacle(obstacle, description);
  impl_->sensor_view.add_robot(body);
  impl_->something_was_placed();
  return body;
}

int PhysicsWorld::body_of_obstacle(int obstacle) const { return impl_->bodies.body_of(obstacle); }

int PhysicsWorld::obstacle_of_body(int body) const {
  return impl_->bodies.at(body).details->info->index;
}

Pose PhysicsWorld::obstacle_pose(int body) const {
  return physics::Bodies::obstacle_pose(impl_->bodies.at(body));
}

void PhysicsWorld::drive_obstacle(int body, const Pose& X_WO, double dt_s) {
  physics::Body& r = impl_->bodies.at(body);
  physics::ObstacleBody& o = r.details->obstacle;
  const Vec2 p_WB = o.p_BO.isZero(0.0) ? X_WO.position() : X_WO * Vec2(-o.p_BO);
  // Rounding must not move an obstacle that stands.
  constexpr double kRounding = 1e-13;
  const Vec2 way = p_WB - r.X_WB.position();
  const double turn_rad = normalize_angle(X_WO.yaw_rad - r.X_WB.yaw_rad);
  o.v_WB = way.isZero(kRounding) ? Vec2(Vec2::Zero()) : Vec2(way / dt_s);
  o.omega_radps = std::abs(turn_rad) <= kRounding ? 0.0 : turn_rad / dt_s;
}

Vec2 PhysicsWorld::obstacle_velocity(int body) const {
  const BodyState& state = *impl_->bodies.at(body).state;
  const auto [s, c] = math::sin_cos(state.X_WB.yaw_rad);
  const Twist& twist = state.twist;
  return {c * twist.v_mps - s * twist.lateral_mps, s * twist.v_mps + c * twist.lateral_mps};
}

double PhysicsWorld::height_m(int robot) const { return impl_->bodies.at(robot).details->height_m; }

void PhysicsWorld::set_target(int robot, const Twist& target) {
  physics::Body& r = impl_->bodies.at(robot);
  r.target = r.suspended ? Twist{} : target;
}

void PhysicsWorld::set_suspended(int robot, bool suspended) {
  impl_->bodies.set_suspended(impl_->bodies.at(robot), suspended);
}

bool PhysicsWorld::suspended(int robot) const { return impl_->bodies.at(robot).suspended; }

void PhysicsWorld::set_elevation(int robot, const Elevation& elevation) {
  impl_->bodies.at(robot).state->elevation = elevation;
}

void PhysicsWorld::set_pose(int robot, const Pose& X_WB) {
  impl_->bodies.set_pose(impl_->bodies.at(robot), X_WB);
  impl_->sensor_view.robot_was_placed();
  impl_->something_was_placed();
}

void PhysicsWorld::step(double dt_s) {
  impl_->contacts.begin_step();
  impl_->mover.step(dt_s);
  impl_->sensor_view.robots_changed();
}

bool PhysicsWorld::used_box2d() const noexcept {
  return impl_->mover.used_box2d() || !impl_->contacts.fresh().empty();
}

double PhysicsWorld::farthest_move_m() const noexcept { return impl_->mover.farthest_move_m(); }

const BodyState& PhysicsWorld::body(int robot) const { return *impl_->bodies.at(robot).state; }

const std::vector<PhysicsWorld::Contact>& PhysicsWorld::new_contacts() const noexcept {
  return impl_->contacts.fresh();
}

std::vector<PhysicsWorld::Contact> PhysicsWorld::contacts_of(int robot) const {
  return impl_->contacts.of(robot);
}

std::vector<PhysicsWorld::Touch> PhysicsWorld::touches_of(int robot) const {
  return impl_->contacts.touches_of(robot);
}

void PhysicsWorld::set_extended(int obstacle, bool extended) {
  impl_->bodies.obstacle(obstacle).SetEnabled(extended);
  impl_->neighbours.invalidate();
  impl_->sensor_view.solids_changed();
}

int PhysicsWorld::robot_on(int obstacle) const { return impl_->bodies.robot_on(obstacle); }

void PhysicsWorld::set_height(int obstacle, double height_m) {
  impl_->bodies.set_height(obstacle, height_m);
  impl_->sensor_view.solids_changed();
}

void PhysicsWorld::change_obstacle(int obstacle, const ObstacleDescription& now) {
  impl_->bodies.change_obstacle(obstacle, now);
  if (impl_->bodies.body_of(obstacle) >= 0) {
    impl_->sensor_view.robot_was_placed();
    impl_->something_was_placed();
    return;
  }
  impl_->neighbours.invalidate();
  impl_->sensor_view.solids_changed();
}

void PhysicsWorld::set_load(int robot, const std::vector<Load>& loads) {
  impl_->sensor_view.set_load(impl_->bodies.at(robot), loads);
}

int PhysicsWorld::robot_within(const ObstacleDescription& solid, int ignored) const {
  return impl_->bodies.robot_within(solid, ignored);
}

double PhysicsWorld::clearance_m(int robot, double limit_m, double exact_below_m) {
  return impl_->neighbours.clearance_m(impl_->bodies.at(robot), limit_m, exact_below_m);
}

bool PhysicsWorld::clearance_settled(int robot) const {
  return impl_->bodies.at(robot).details->clearance_settled;
}

void PhysicsWorld::collect_edges(const Vec2& p_WL, double radius_m, double sensor_height_m,
                                 int own_robot, bool test_inside, scan::EdgeBuffer& edges) const {
  impl_->sensor_view.collect_edges(p_WL, radius_m, sensor_height_m, own_robot, test_inside, edges);
}

void PhysicsWorld::scan(const scan::ScanGeometry& geometry, const Pose& X_WL,
                        double sensor_height_m, int own_robot, bool test_inside,
                        std::span<double> ranges_m) const {
  impl_->sensor_view.scan(geometry, X_WL, sensor_height_m, own_robot, test_inside, ranges_m);
}

void PhysicsWorld::scan(scan::ScanWorkspace& workspace, const scan::ScanGeometry& geometry,
                        const Pose& X_WL, double sensor_height_m, int own_robot, bool test_inside,
                        std::span<float> ranges_m) const {
  impl_->sensor_view.scan(workspace, geometry, X_WL, sensor_height_m, own_robot, test_inside,
                          ranges_m);
}

void PhysicsWorld::collect_faces(const Vec2& low, const Vec2& high, int own_robot,
                                 std::vector<Face>& faces) const {
  impl_->sensor_view.collect_faces(low, high, own_robot, faces);
}

bool PhysicsWorld::is_inside_solid(const Vec2& p_W, double height_m, int own_robot) const {
  return impl_->sensor_view.is_inside_solid(p_W, height_m, own_robot);
}

bool PhysicsWorld::is_line_free(const Vec2& p_WA, const Vec2& p_WC, double height_m, int own_robot,
                                const Contact& target, bool solid_only) const {
  return impl_->sensor_view.is_line_free(p_WA, p_WC, height_m, own_robot, target, solid_only);
}

double PhysicsWorld::ray_cast_m(const Vec2& p_WL, double angle_rad, double range_max_m,
                                int own_robot) const {
  return impl_->sensor_view.ray_cast_m(p_WL, angle_rad, range_max_m, own_robot);
}

void PhysicsWorld::share_memory_with(const PhysicsWorld& other) {
  impl_->sensor_view.share_memory_with(other.impl_->sensor_view);
}

void PhysicsWorld::archive(StateArchive& archive) {
  impl_->bodies.archive(archive);
  impl_->contacts.archive(archive);
  impl_->neighbours.archive(archive);
  impl_->mover.archive(archive);
  impl_->sensor_view.archive(archive);
}

void PhysicsWorld::plain_box2d_step(double dt_s) { impl_->mover.plain_box2d_step(dt_s); }

std::string partner_name(const PhysicsWorld::Contact& contact, const WorldDescription& world) {
  const auto index = static_cast<std::size_t>(contact.index);
  switch (contact.kind) {
    case PhysicsWorld::Contact::Kind::kObstacle:
      return world.arena.obstacles[index].name;
    case PhysicsWorld::Contact::Kind::kSeparator:
      return world.arena.dock_separators[index].name;
    case PhysicsWorld::Contact::Kind::kBorder:
      return "border";
    case PhysicsWorld::Contact::Kind::kWall:
      return "wall";
    case PhysicsWorld::Contact::Kind::kRobot:
      break;
  }
  return world.robots[index].name;
}

}  // namespace sim
