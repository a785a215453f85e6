// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/mover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/math.h"
#include "sim/world/outline.h"

namespace sim::physics {
namespace {

// A gap may decrease by this much more than the linear constraints allow in a substep.
constexpr double kSecondOrder_m = 0.0003;

// Maximum travel of any point of a robot in one Box2D step while robots push each other. Box2D
// decides where a pushed robot goes, and it detects a contact only if hulls are closer than the sum
// of their skins, 2 mm.
constexpr double kMaxContactTravel_m = 0.002;

// The same limit while the robots that touch have nothing else within reach.
constexpr double kMaxLoneContactTravel_m = 0.003;

// Tolerances within which a twist counts as achieved.
constexpr double kSpeedTolerance_mps = 0.01;
constexpr double kTurnTolerance_radps = 0.05;
constexpr double kStallDelay_s = 0.2;

// Lower limit of the travel in a substep that determines the search range around slow robots
// [m]. It suffices to find everything that touches.
constexpr double kLeastTravel_m = 0.25 * kMaxTravel_m;

// Coefficient of friction between the wheels and the floor: a tyre that slides on dry concrete
// (J. Y. Wong, Theory of Ground Vehicles, table 1.3).
constexpr double kTraction = 0.75;

// Integral gain of a drive that pushes. With the mass M of a robot and m of an obstacle the
// velocity's error decays if the gain is below 1.
constexpr double kPushGain = 0.2;

// Skin of a robot's shape that finds contacts in advance.
constexpr float kReach = static_cast<float>(3.0 * kMaxTravel_m) * kScaleF;

constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

// sin(x) / x. For small x (half the rotation of a step is small) the series is exact to the last
// bit.
inline double sinc(double x) {
  if (std::abs(x) > 0.05) return math::sin(x) / x;
  const double x2 = x * x;
  return 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0));
}

// Upper bound of how far any corner of a robot moves along a direction in W, if the twist were a
// straight motion.
double advance_m(const Body& r, const b2Transform& xf, const b2Vec2& direction, const Twist& twist,
                 double dt_s) {
  const b2Vec2 n = b2MulT(xf.q, direction);
  // About B, in the direction of the rotation.
  float lever = r.details->round ? 0.0F : -b2_maxFloat;
  const float sense = twist.omega_radps < 0.0 ? -1.0F : 1.0F;
  for_each_corner(*r.details, [&](const b2Vec2& corner) {
    lever = std::max(lever, sense * b2Cross(corner, n));
  });
  return (static_cast<double>(n.x) * twist.v_mps + static_cast<double>(n.y) * twist.lateral_mps +
          metres(lever) * std::abs(twist.omega_radps)) *
         dt_s;
}

// The pose of an unhindered robot after dt_s: along the exact arc of the twist (the exponential map
// of SE(2): Lynch and Park, Modern Robotics, 2017, sec. 3.3.3).
inline Pose arc_end(const Pose& X_WB, const Twist& twist, double dt_s) {
  const double half_turn = 0.5 * twist.omega_radps * dt_s;
  const double chord = twist.v_mps * dt_s * sinc(half_turn);
  const double side = twist.lateral_mps * dt_s * sinc(half_turn);
  const auto [s, c] = math::sin_cos(X_WB.yaw_rad + half_turn);
  return {X_WB.x_m + chord * c - side * s, X_WB.y_m + chord * s + side * c,
          X_WB.yaw_rad + twist.omega_radps * dt_s};
}

// The twist with which a body of a constant velocity in W moves during dt_s.
Twist twist_of(const Vec2& v_WB, double omega_radps, double yaw_rad, double dt_s) {
  if (omega_radps == 0.0 && v_WB.isZero(0.0)) return {};
  const double half_turn = 0.5 * omega_radps * dt_s;
  const auto [s, c] = math::sin_cos(yaw_rad + half_turn);
  const double arc_per_chord = 1.0 / sinc(half_turn);
  return {(v_WB.x() * c + v_WB.y() * s) * arc_per_chord, omega_radps,
          (v_WB.y() * c - v_WB.x() * s) * arc_per_chord};
}

// Lowers the velocity of a pushed obstacle by the floor's friction: the ellipsoid approximation of
// the limit surface (R. Howe and M. Cutkosky, Practical force-motion models for sliding
// manipulation, Int. J. of Robotics Research 15(6), 1996). The friction that is not used up here
// remains against a push.
void slow_down(ObstacleBody& o, double dt_s) {
  const double most_mps = o.friction_mps2 * dt_s;
  const double speed_mps = math::hypot(o.v_WB.norm(), o.friction_arm_m * o.omega_radps);
  if (speed_mps <= most_mps) {
    o.v_WB.setZero();
    o.omega_radps = 0.0;
    o.friction_left = most_mps > 0.0 ? 1.0 - speed_mps / most_mps : 0.0;
    return;
  }
  const double rest = 1.0 - most_mps / speed_mps;
  o.v_WB *= rest;
  o.omega_radps *= rest;
  o.friction_left = 0.0;
}

// Whether a robot touches an obstacle that it can push.
bool touches_pushable(const Bodies& bodies, const Body& r) {
  for (const b2ContactEdge* e = contact_list(r.body); e != nullptr; e = e->next) {
    const int other = info_of(e->other->GetFixtureList()).body;
    if (other >= 0 && bodies.at(other).pushable && e->contact->IsTouching()) return true;
  }
  return false;
}

// Reverts changes that Box2D's solver made to a body that must not move.
inline void restore_pose(Body& r) {
  const b2Vec2 p = to_box2d(r.X_WB.position());
  const float angle = static_cast<float>(r.X_WB.yaw_rad);
  if (r.body->GetPosition() == p && r.body->GetAngle() == angle) return;
  r.body->SetTransform(p, angle);
  r.body->SetLinearVelocity({0.0F, 0.0F});
  r.body->SetAngularVelocity(0.0F);
}

// Keeps angles small, where single precision suffices.
inline void wrap_yaw(Body& r) {
  r.X_WB.yaw_rad = normalize_angle(r.X_WB.yaw_rad);
  if (r.body == nullptr) return;
  r.body->SetTransform(r.body->GetPosition(), static_cast<float>(r.X_WB.yaw_rad));
}

inline void finish_step(Body& r, double dt_s) {
  BodyState& s = *r.state;
  s.X_WB = {r.X_WB.x_m, r.X_WB.y_m, normalize_angle(r.X_WB.yaw_rad)};
  s.twist = {s.travel_m / dt_s, s.turn_rad / dt_s, s.side_m / dt_s};
  s.commanded = r.target;
  const bool achieved =
      std::abs(s.twist.v_mps - r.target.v_mps) <= kSpeedTolerance_mps &&
      std::abs(s.twist.omega_radps - r.target.omega_radps) <= kTurnTolerance_radps &&
      (r.drive != DriveKind::kOmnidirectional ||
       std::abs(s.twist.lateral_mps - r.target.lateral_mps) <= kSpeedTolerance_mps);
  r.stall_clock_s = achieved ? 0.0 : r.stall_clock_s + dt_s;
  s.stalled = r.stall_clock_s >= kStallDelay_s - 1e-9;
}

}  // namespace

// These functions are inline because they are called for every robot in every step.

// Records that a robot has travelled and turned this much.
inline void Mover::record_travel(Body& r, double way_m, double turn_rad) {
  r.state->turn_rad += turn_rad;
  if (std::abs(r.X_WB.yaw_rad) > 8.0 * std::numbers::pi) wrap_yaw(r);
  const double most_m = way_m + std::abs(turn_rad) * r.radius_m;  // bound for all its points
  r.cumulative_max_travel_m += most_m;
  r.moved_m += most_m;
  farthest_m_ = std::max(farthest_m_, r.moved_m);
}

// Moves a robot to the end of its arc.
inline void Mover::move_to_goal(Body& r, const Pose& goal, const Twist& twist, double dt_s) {
  r.X_WB = goal;
  if (bodies_.has_pushable()) r.details->achieved = twist;
  const double travel = twist.v_mps * dt_s;
  const double side = twist.lateral_mps * dt_s;
  r.state->travel_m += travel;
  r.state->side_m += side;
  record_travel(r, side == 0.0 ? std::abs(travel) : math::hypot(travel, side),
                twist.omega_radps * dt_s);
}

// For Box2D, a free robot that still has a body is at rest and is placed at a new pose.
inline void Mover::move_freely(Body& r, double dt_s) {
  if (r.body != nullptr) {
    if (--r.substeps_in_box2d == 0) {
      bodies_.destroy_box2d_body(r);
    } else if (r.body->IsAwake()) {
      r.body->SetAwake(false);
    }
  }
  if (r.target == Twist{}) {
    if (bodies_.has_pushable()) r.details->achieved = {};
    return;
  }
  const Pose goal = arc_end(r.X_WB, r.target, dt_s);
  if (r.body != nullptr) {
    r.body->SetTransform(to_box2d(goal.position()), static_cast<float>(goal.yaw_rad));
  }
  move_to_goal(r, goal, r.target, dt_s);
}

void Mover::step(double dt_s) {
  double travel_m = 0.0;
  set_obstacle_targets(dt_s);
  for (const Body& r : bodies_.all()) travel_m = std::max(travel_m, most_travel_m(r, dt_s));
  const int substeps = std::max(1, static_cast<int>(std::ceil(travel_m / kMaxTravel_m)));
  neighbours_.begin_step(std::max(travel_m / substeps, kLeastTravel_m));
  step_s_ = dt_s;
  const double cumulative_max_travel_m = neighbours_.cumulative_max_travel_m();
  for (int i = 0; i < substeps; ++i) substep(dt_s / substeps, i == 0, i + 1 == substeps);
  step_max_travel_m_ = neighbours_.cumulative_max_travel_m() - cumulative_max_travel_m;
}

// Moves all robots for a time in which no robot travels farther than kMaxTravel_m. Robots that are
// free, or stay clear of everything near, are moved at once, without Box2D. Robots that push each
// other are moved in several Box2D steps.
void Mover::substep(double dt_s, bool first, bool last) {
  if (bodies_.has_pushable()) {
    for (std::size_t i = bodies_.robot_count(); i < bodies_.all().size(); ++i) {
      if (bodies_.all()[i].pushable) slow_down(bodies_.all()[i].details->obstacle, dt_s);
    }
  }
  // Otherwise step() has just set them.
  if (!first || !last || bodies_.has_pushable()) set_obstacle_targets(dt_s);
  neighbours_.find(dt_s);
  if (neighbours_.something_was_placed()) {
    // Lets Box2D find the contacts of everything that was placed since the last step.
    bodies_.world().Step(0.0F, 1, 1);
    neighbours_.note_contacts_found();
  }
  std::vector<Body>& robots = bodies_.all();
  goals_.resize(robots.size());
  twists_.resize(robots.size());
  wanted_.resize(robots.size());
  farthest_m_ = 0.0;
  find_contact_groups(dt_s);
  hindered_.clear();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Body& r = robots[i];
    r.moved_m = 0.0;
    if (first) r.state->travel_m = r.state->turn_rad = r.state->side_m = 0.0;
    if (r.in_contact_group || !neighbours_.is_free(i, dt_s)) {
      hindered_.push_back(i);
      continue;
    }
    move_freely(r, dt_s);
    if (last) finish_step(r, step_s_);
  }
  std::erase_if(hindered_, [&](std::size_t i) {
    Body& r = robots[i];
    if (!r.in_contact_group) {
      twists_[i] = allowed_twist(i, dt_s);
      if (clears_all(r, twists_[i], dt_s)) {
        move_freely(r, dt_s);
        if (last) finish_step(r, step_s_);
        return true;
      }
    }
    bodies_.ensure_box2d_body(r);
    for (const Neighbours::Neighbour& near : neighbours_.near_to(i)) {
      bodies_.ensure_box2d_body(bodies_.at(near.robot));
    }
    return false;
  });
  double contact_travel_m = 0.0;
  for (const std::size_t i : contact_robots_) {
    contact_travel_m = std::max(contact_travel_m, most_travel_m(robots[i], dt_s));
  }
  const int box2d_steps =
      std::max(1, static_cast<int>(std::ceil(contact_travel_m / max_contact_travel_m_)));
  contact_substep(dt_s / box2d_steps, dt_s);
  for (int i = 1; i < box2d_steps; ++i) contact_substep(dt_s / box2d_steps, 0.0);
  if (last) {
    for (const std::size_t i : hindered_) finish_step(robots[i], step_s_);
  }
  neighbours_.note_moved(farthest_m_);
  bodies_.note_moved();
}

// Adds the limits of the closing speed towards a circle for a part of robot `r`. All point in the
// direction from the nearest point of the robot to the circle. Besides that point, each corner is
// limited by the gap along this direction, so that a side beside a large circle cannot turn into
// it.
void Mover::add_round_constraints(const Body& r, std::size_t part, const b2CircleShape& circle,
                                  const b2Transform& circle_xf, double share, double dt_s) {
  const b2Vec2 center = b2Mul(circle_xf, circle.m_p);
  const auto& shape = static_cast<const b2PolygonShape&>(r.details->part(part));
  const double radius_m = metres(core_radius(circle));
  const auto [s, c] = math::sin_cos(r.X_WB.yaw_rad);
  const double dx = metres(center.x) - r.X_WB.x_m;
  const double dy = metres(center.y) - r.X_WB.y_m;
  const Vec2 p_BC(c * dx + s * dy, c * dy - s * dx);
  std::array<Vec2, b2_maxPolygonVertices> corners;
  corners.fill(Vec2::Zero());
  const auto count = static_cast<std::size_t>(shape.m_count);
  for (std::size_t i = 0; i < count; ++i) {
    corners[i] = {metres(shape.m_vertices[i].x), metres(shape.m_vertices[i].y)};
  }
  Vec2 nearest = corners[0];
  bool inside = true;  // the centre is within the robot's outline
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 side = corners[(i + 1) % count] - corners[i];
    const Vec2 point = nearest_on_segment(p_BC, corners[i], corners[(i + 1) % count]);
    inside = inside && side.x() * (p_BC - corners[i]).y() > side.y() * (p_BC - corners[i]).x();
    if ((p_BC - point).squaredNorm() < (p_BC - nearest).squaredNorm()) nearest = point;
  }
  const double distance_m = inside ? -(p_BC - nearest).norm() : (p_BC - nearest).norm();
  if (distance_m == 0.0) return;
  const Vec2 normal = (p_BC - nearest) / distance_m;
  const auto add = [&](const Vec2& p, double gap_m) {
    constraints_.push_back({normal.x(), p.x() * normal.y() - p.y() * normal.x(),
                            share * std::max(0.0, gap_m - kRestingGap_m) / dt_s, normal.y()});
  };
  const double reach_m = metres(kReach);
  if (distance_m - radius_m > reach_m) return;
  if (is_between_parts(*r.details, part, to_box2d(nearest),
                       {static_cast<float>(normal.x()), static_cast<float>(normal.y())})) {
    return;
  }
  add(nearest, distance_m - radius_m);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 off = p_BC - corners[i];
    const double aside_m = off.x() * normal.y() - off.y() * normal.x();
    if (std::abs(aside_m) >= radius_m || (corners[i] - nearest).isZero(1e-9)) continue;
    const double gap_m = off.dot(normal) - std::sqrt((radius_m - aside_m) * (radius_m + aside_m));
    if (gap_m <= reach_m) add(corners[i], gap_m);
  }
}

// Adds the limit of the closing speed of a round obstacle `r` towards another shape. The distance
// of its centre from a convex shape is a convex function of its position, so the limit along the
// direction to the nearest point is sufficient.
void Mover::add_disc_constraint(const Body& r, const b2Shape& other, const b2Transform& other_xf,
                                double share, double dt_s) {
  const ShapeDistance found = core_distance(r.details->disc, transform_of(r), other, other_xf);
  if (found.distance <= 0.0F) return;
  const double gap_m = metres(found.distance - core_radius(r.details->disc) - core_radius(other));
  if (gap_m > metres(kReach)) return;
  const b2Vec2 normal = (1.0F / found.distance) * (found.pointB - found.pointA);
  const double nx = static_cast<double>(normal.x);
  const double ny = static_cast<double>(normal.y);
  const auto [s, c] = math::sin_cos(r.X_WB.yaw_rad);
  constraints_.push_back(
      {nx * c + ny * s, 0.0, share * std::max(0.0, gap_m - kRestingGap_m) / dt_s, ny * c - nx * s});
}

// Adds the limits of the closing speed that a solid implies for all parts of robot `r`.
void Mover::add_constraints(const Body& r, const b2Shape& other, const b2Transform& other_xf,
                            double share, double dt_s) {
  used_box2d_ = true;
  for (std::size_t part = 0; part < r.details->part_count(); ++part) {
    add_constraints(r, part, other, other_xf, share, dt_s);
  }
}

// Adds the limits of the closing speed that a pair of shapes implies for robot `r` to constraints_.
// `share` is the fraction of the gap that r may close in this step.
void Mover::add_constraints(const Body& r, std::size_t part, const b2Shape& other,
                            const b2Transform& other_xf, double share, double dt_s) {
  if (r.details->round) {
    add_disc_constraint(r, other, other_xf, share, dt_s);
    return;
  }
  if (other.GetType() == b2Shape::e_circle) {
    add_round_constraints(r, part, static_cast<const b2CircleShape&>(other), other_xf, share, dt_s);
    return;
  }
  b2PolygonShape reaching = static_cast<const b2PolygonShape&>(r.details->part(part));
  reaching.m_radius = kReach;
  const b2Transform xf = transform_of(r);
  b2Manifold manifold;
  b2WorldManifold points;
  double sign = 1.0;  // the normal points from A to B
  if (other.GetType() == b2Shape::e_polygon) {
    const auto& polygon = static_cast<const b2PolygonShape&>(other);
    b2CollidePolygons(&manifold, &reaching, xf, &polygon, other_xf);
    points.Initialize(&manifold, xf, reaching.m_radius, other_xf, polygon.m_radius);
  } else {
    const auto& edge = static_cast<const b2EdgeShape&>(other);
    b2CollideEdgeAndPolygon(&manifold, &edge, other_xf, &reaching, xf);
    points.Initialize(&manifold, other_xf, edge.m_radius, xf, reaching.m_radius);
    sign = -1.0;
  }
  if (manifold.pointCount == 0) return;
  const double nx = sign * static_cast<double>(points.normal.x);
  const double ny = sign * static_cast<double>(points.normal.y);
  const auto [s, c] = math::sin_cos(r.X_WB.yaw_rad);
  const double skins = static_cast<double>(reaching.m_radius + other.m_radius);
  const b2Vec2 normal_B = static_cast<float>(sign) * b2MulT(xf.q, points.normal);
  for (int32 i = 0; i < manifold.pointCount; ++i) {
    if (is_between_parts(*r.details, part, b2MulT(xf, points.points[i]), normal_B)) continue;
    const double gap_m = (static_cast<double>(points.separations[i]) + skins) / kScale;
    const double rx = metres(points.points[i].x) - r.X_WB.x_m;
    const double ry = metres(points.points[i].y) - r.X_WB.y_m;
    constraints_.push_back({nx * c + ny * s, rx * ny - ry * nx,
                            share * std::max(0.0, gap_m - kRestingGap_m) / dt_s, ny * c - nx * s});
  }
}

// Whether a robot that follows its target stays clear of a wall, or of the line through its edge.
bool Mover::clears_wall(const Body& r, const Wall& wall, const b2Transform& xf, double dt_s) {
  const LineDistance line = distance_to_line(r, wall, xf);
  return line.apart_m > 0.0 && advance_m(r, xf, line.direction, r.target, dt_s) + kSecondOrder_m <=
                                   line.apart_m - kTouchingGap_m;
}

Twist Mover::allowed_twist(std::size_t index, double dt_s) {
  Body& r = bodies_.all()[index];
  constraints_.clear();
  if (r.target == Twist{}) return r.target;
  const double way_m = most_travel_m(r, dt_s);
  // Obstacles farther away, or in another direction, do not limit the robot.
  const b2Transform xf = transform_of(r);
  const double reach_m = way_m + kTouchingGap_m + kSecondOrder_m;
  if (r.wall_until_m - r.cumulative_max_travel_m <= reach_m) {
    for (const Wall& wall : r.details->walls) {
      if (!may_reach(r, wall, reach_m)) continue;
      if (wall.is_edge && clears_wall(r, wall, xf, dt_s)) continue;
      add_constraints(r, *wall.shape, identity_transform(), 1.0, dt_s);
    }
  }
  for (const Neighbours::Neighbour& near : neighbours_.near_to(index)) {
    const Body& other = bodies_.at(near.robot);
    const double share = other.suspended ? 1.0 : 0.5;  // a suspended robot is like a wall
    const double apart_m = near.apart_m - r.moved_m - other.moved_m;
    const double mine_m = share * (apart_m - kTouchingGap_m);
    if (mine_m > way_m) continue;
    // A body of several parts may be around the other one, so that no direction separates them.
    const bool convex = r.details->further.empty() && other.details->further.empty();
    if (convex && apart_m > 0.0 &&
        advance_m(r, xf, near.direction, r.target, dt_s) + kSecondOrder_m <= mine_m) {
      continue;
    }
    // The robots push each other: Box2D's solver distributes the momentum.
    if (!other.suspended && (touches(r.body, other.body) || r.pushable || other.pushable)) continue;
    for (std::size_t part = 0; part < other.details->part_count(); ++part) {
      add_constraints(r, other.details->part(part), transform_of(other), share, dt_s);
    }
  }
  if (constraints_.empty()) return r.target;
  switch (r.drive) {
    case DriveKind::kOmnidirectional:
      return feasible_planar_twist(r.target, r.details->mass_kg, r.details->inertia_kgm2,
                                   constraints_);
    case DriveKind::kCar:
      return feasible_share(r.target, constraints_);
    case DriveKind::kDifferential:
      break;
  }
  return feasible_twist(r.target, r.details->mass_kg, r.details->inertia_kgm2, constraints_);
}

// Whether a robot that is not free can follow its target after all: it touches nothing, and the
// constraints just computed show that it will touch nothing.
bool Mover::clears_all(const Body& r, const Twist& allowed, double dt_s) const {
  if (allowed != r.target || r.target == Twist{}) return false;
  for (const b2ContactEdge* e = contact_list(r.body); e != nullptr; e = e->next) {
    if (e->contact->IsTouching()) return false;
  }
  const double spare = (kTouchingGap_m - kRestingGap_m + kSecondOrder_m) / dt_s;
  return std::all_of(constraints_.begin(), constraints_.end(), [&](const TwistConstraint& c) {
    return c.closing(allowed) + spare <= c.limit;
  });
}

// Sets the targets of the moving obstacles to their velocities.
void Mover::set_obstacle_targets(double dt_s) {
  for (std::size_t i = bodies_.robot_count(); i < bodies_.all().size(); ++i) {
    Body& r = bodies_.all()[i];
    const ObstacleBody& o = r.details->obstacle;
    r.target = r.suspended ? Twist{} : twist_of(o.v_WB, o.omega_radps, r.X_WB.yaw_rad, dt_s);
  }
}

// Whether a robot may reach an obstacle that it can push. Box2D exchanges their momentum, so
// nothing else may stop them.
bool Mover::may_push(const Neighbours::NearPair& pair, double dt_s) const {
  const Body& a = bodies_.at(pair.first);
  const Body& b = bodies_.at(pair.second);
  if (!a.pushable && !b.pushable) return false;
  const double way_m = std::max(most_travel_m(a, dt_s), most_travel_m(b, dt_s));
  return 0.5 * (pair.apart_m - kTouchingGap_m) <= way_m;
}

// A drive that pushes an obstacle changes its velocity by at most what the friction of its wheels
// permits in dt_s. It controls its velocity with an integral part, so that the push does not slow
// it down as long as the wheels have traction.
Twist Mover::limit_by_traction(Body& r, const Twist& wanted, double dt_s) const {
  Twist& excess = r.details->excess;
  if (!touches_pushable(bodies_, r)) {
    excess = {};
    return wanted;
  }
  const Twist& before = r.details->achieved;
  const double most_mps = kTraction * kGravity_mps2 * dt_s;
  const double most_radps =
      most_mps * r.details->mass_kg * r.details->traction_arm_m / r.details->inertia_kgm2;
  const auto change = [](double target, double now, double most, double& more) {
    const double error = target - now;
    const bool controls = std::abs(error) < most && target * (more + error) > 0.0;
    more = controls ? std::clamp(more + kPushGain * error, -most, most) : 0.0;
    return error + more;
  };
  const double dv = change(wanted.v_mps, before.v_mps, most_mps, excess.v_mps);
  const double dl = change(wanted.lateral_mps, before.lateral_mps, most_mps, excess.lateral_mps);
  const double dw = change(wanted.omega_radps, before.omega_radps, most_radps, excess.omega_radps);
  const double share = most_mps / std::max(most_mps, math::hypot(dv, dl));
  return {before.v_mps + share * dv, before.omega_radps + std::clamp(dw, -most_radps, most_radps),
          before.lateral_mps + share * dl};
}

// Collects the robots that touch others, those near them, those near these, and so on.
void Mover::find_contact_groups(double dt_s) {
  for (const std::size_t i : contact_robots_) bodies_.all()[i].in_contact_group = false;
  contact_robots_.clear();
  const auto add = [this](int index) {
    const auto i = static_cast<std::size_t>(index);
    if (!std::exchange(bodies_.all()[i].in_contact_group, true)) contact_robots_.push_back(i);
  };
  for (const Neighbours::NearPair& pair : neighbours_.near_pairs()) {
    if (!touches(bodies_.at(pair.first).body, bodies_.at(pair.second).body) &&
        !may_push(pair, dt_s)) {
      continue;
    }
    add(pair.first);
    add(pair.second);
  }
  max_contact_travel_m_ =
      std::any_of(contact_robots_.begin(), contact_robots_.end(),
                  [this](std::size_t i) { return neighbours_.may_be_pushed_into_others(i); })
          ? kMaxContactTravel_m
          : kMaxLoneContactTravel_m;
  for (std::size_t i = 0; i < contact_robots_.size(); ++i) {
    for (const Neighbours::Neighbour& near : neighbours_.near_to(contact_robots_[i])) {
      add(near.robot);
    }
  }
}

// Moves the hindered robots in one Box2D step: robots in contact groups by dt_s, the others by
// others_dt_s. The first call moves the others by the whole time; in further calls others_dt_s is
// 0, and they rest.
void Mover::contact_substep(double dt_s, double others_dt_s) {
  if (!bodies_.has_robots_in_box2d()) return;
  used_box2d_ = used_box2d_ || !hindered_.empty();
  const float inv_dt = static_cast<float>(1.0 / dt_s);
  for (const std::size_t i : hindered_) {
    Body& r = bodies_.all()[i];
    const double own_dt_s = r.in_contact_group ? dt_s : others_dt_s;
    if (own_dt_s == 0.0) {
      r.body->SetAwake(false);
      continue;
    }
    if (others_dt_s > 0.0 && r.in_contact_group) twists_[i] = allowed_twist(i, others_dt_s);
    if (bodies_.has_pushable()) set_friction(i, own_dt_s, others_dt_s > 0.0);
    goals_[i] = arc_end(r.X_WB, twists_[i], own_dt_s);
    if (goals_[i] == r.X_WB && !r.body->IsAwake()) continue;
    if (r.pushable && (others_dt_s == 0.0 || twists_[i] == r.target)) {
      // Its velocity is its state. One towards the goal would turn the rounding of the body's
      // position into momentum.
      r.body->SetLinearVelocity(to_box2d(r.details->obstacle.v_WB));
      r.body->SetAngularVelocity(static_cast<float>(r.details->obstacle.omega_radps));
      continue;
    }
    // This velocity takes Box2D's single-precision body to the exact goal, so that rounding errors
    // do not accumulate.
    const b2Vec2 goal = to_box2d(goals_[i].position());
    r.body->SetLinearVelocity(inv_dt * (goal - r.body->GetPosition()));
    r.body->SetAngularVelocity(inv_dt *
                               (static_cast<float>(goals_[i].yaw_rad) - r.body->GetAngle()));
  }
  bodies_.world().Step(static_cast<float>(dt_s), kVelocityIterations, kPositionIterations);
  for (const std::size_t i : hindered_) {
    const double own_dt_s = bodies_.all()[i].in_contact_group ? dt_s : others_dt_s;
    if (own_dt_s > 0.0) follow_body(i, own_dt_s);
  }
}

// Sets what Box2D needs to know about friction before its step of dt_s.
void Mover::set_friction(std::size_t index, double dt_s, bool first) {
  Body& r = bodies_.all()[index];
  if (!r.pushable) {
    if (first) wanted_[index] = twists_[index];
    twists_[index] = limit_by_traction(r, wanted_[index], dt_s);
    return;
  }
  ObstacleBody& o = r.details->obstacle;
  // After the first step Box2D has changed the velocity.
  if (!first) twists_[index] = twist_of(o.v_WB, o.omega_radps, r.X_WB.yaw_rad, dt_s);
  const double force_N = o.friction_left * o.friction_mps2 * r.details->mass_kg;
  o.joint->SetMaxForce(static_cast<float>(force_N * kScale));
  o.joint->SetMaxTorque(static_cast<float>(force_N * o.friction_arm_m * kScale * kScale));
}

// Updates the robot from its Box2D body; it gets the exact goal if nothing hindered it.
void Mover::follow_body(std::size_t index, double dt_s) {
  Body& r = bodies_.all()[index];
  if (r.suspended) {
    restore_pose(r);
    return;
  }
  const Pose& goal = goals_[index];
  const b2Vec2 p = r.body->GetPosition();
  const b2Vec2 wanted = to_box2d(goal.position());
  const float angle = r.body->GetAngle();
  // Bound of the rounding of position and angle, a few units in the last place.
  const float slack = 4e-6F * (4.0F + std::abs(p.x) + std::abs(p.y));
  if (std::abs(p.x - wanted.x) <= slack && std::abs(p.y - wanted.y) <= slack &&
      std::abs(angle - static_cast<float>(goal.yaw_rad)) <= 2e-5F) {
    if (r.pushable && twists_[index] != r.target) note_velocity(r);
    move_to_goal(r, goal, twists_[index], dt_s);
    return;
  }
  const Pose before = r.X_WB;
  r.X_WB = {metres(p.x), metres(p.y), static_cast<double>(angle)};
  const double turn = r.X_WB.yaw_rad - before.yaw_rad;
  const auto [s, c] = math::sin_cos(before.yaw_rad + 0.5 * turn);
  const double dx = r.X_WB.x_m - before.x_m;
  const double dy = r.X_WB.y_m - before.y_m;
  // The wheels' path is the arc with this chord.
  r.state->travel_m += (dx * c + dy * s) / sinc(0.5 * turn);
  r.state->side_m += dy * c - dx * s;
  record_travel(r, math::hypot(dx, dy), turn);
  if (!bodies_.has_pushable()) return;
  r.details->achieved = {(dx * c + dy * s) / dt_s, turn / dt_s, (dy * c - dx * s) / dt_s};
  if (r.pushable) note_velocity(r);
}

// Takes over the velocity of a pushed obstacle from Box2D.
void Mover::note_velocity(Body& r) {
  const b2Vec2& v = r.body->GetLinearVelocity();
  r.details->obstacle.v_WB = {metres(v.x), metres(v.y)};
  r.details->obstacle.omega_radps = static_cast<double>(r.body->GetAngularVelocity());
}

void Mover::plain_box2d_step(double dt_s) {
  for (Body& r : bodies_.all()) {
    bodies_.ensure_box2d_body(r);
    const double yaw = static_cast<double>(r.body->GetAngle());
    r.body->SetLinearVelocity(
        to_box2d({r.target.v_mps * math::cos(yaw), r.target.v_mps * math::sin(yaw)}));
    r.body->SetAngularVelocity(static_cast<float>(r.target.omega_radps));
  }
  bodies_.world().Step(static_cast<float>(dt_s), kVelocityIterations, kPositionIterations);
}

}  // namespace sim::physics
