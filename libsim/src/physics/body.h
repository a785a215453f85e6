// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/fixtures.h"
#include "physics/shapes.h"
#include "sim/core/body_state.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"
#include "sim/world/robot_model.h"

namespace sim::physics {

using sim::distance_between;
using sim::least_along;

/// Distance at which Box2D keeps the hulls of touching polygons: the sum of their skins minus the
/// slop.
inline constexpr double kRestingGap_m = (2.0 * b2_polygonRadius - b2_linearSlop) / kScale;

/// Distance below which bodies touch, according to Box2D.
inline constexpr double kTouchingGap_m = 2.0 * b2_polygonRadius / kScale;

/// Maximum travel of any point of a robot in one Box2D step. Broad-phase boxes of obstacles are
/// extended by 1 cm, so Box2D knows a contact before the robot reaches it.
inline constexpr double kMaxTravel_m = 0.0085;

/// Acceleration of gravity.
inline constexpr double kGravity_mps2 = 9.81;

/// A distance that is not known yet.
inline constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// A static solid near a robot.
struct Wall {
  const b2Shape* shape = nullptr;
  int fixture = 0;       ///< its FixtureInfo::id
  bool is_edge = false;  ///< an edge of a map, with this start, direction and length:
  Vec2 start = Vec2::Zero();
  Vec2 along = Vec2::UnitX();
  double length_m = 0.0;
};

/// A solid that may be the nearest one to a robot.
struct Candidate {
  const b2Shape* shape;
  int robot;   ///< index; if < 0, the fixture with the FixtureInfo::id -1 - robot
  b2AABB box;  ///< bounding box of a static solid
};

/// What a body that is an obstacle has besides a robot.
struct ObstacleBody {
  Vec2 p_BO =
      Vec2::Zero();  ///< origin of the obstacle's own frame; B is the centre of its area [m]
  Vec2 v_WB = Vec2::Zero();  ///< velocity of B in W: of a driven one the target [m/s]
  double omega_radps = 0.0;
  double friction_mps2 = 0.0;        ///< deceleration by the floor, mu g
  double friction_arm_m = 0.0;       ///< ratio of the floor's greatest torque to its greatest force
  double friction_left = 1.0;        ///< share of the floor's friction that a push meets now
  b2FrictionJoint* joint = nullptr;  ///< of a pushed one that has a Box2D body
};

/// Data of a robot that is needed less often.
struct BodyDetails {
  b2PolygonShape shape;
  std::vector<b2PolygonShape> further;  ///< of a body that is not convex: its parts after `shape`
  b2CircleShape disc;                   ///< of a round obstacle, about B, instead of `shape`
  bool round = false;
  FixtureInfo* info = nullptr;  ///< of the first part
  std::vector<FixtureInfo*> further_infos;
  double height_m = 0.0;
  double mass_kg = 0.0;
  double inertia_kgm2 = 0.0;
  double traction_arm_m = 0.0;  ///< lever of the wheels' forces about B
  Twist achieved;               ///< of a robot in its last Box2D step, see Mover::limit_by_traction
  Twist excess;                 ///< what its drive adds to its target against the force of a push
  ObstacleBody obstacle;
  // Of Neighbours:
  std::vector<Candidate> candidates;  ///< everything nearer than candidates_reach_m
  b2Vec2 nearest_direction{1.0F, 0.0F};
  double candidates_reach_m = -1.0;  ///< valid at candidates_at_travel_m; see clearance_m
  double candidates_at_travel_m = 0.0;
  bool clearance_settled = false;  ///< see PhysicsWorld::clearance_settled()
  std::vector<Wall> walls;         ///< complete until its cumulative travel reaches:
  double walls_until_m = kUnknown;
  // Of Contacts:
  std::vector<int> touching;  ///< number of contacts per partner, see count_contact
  // Of SensorView:
  EdgeList load;                     ///< outlines of carried objects, in B
  std::vector<Cylinder> round_load;  ///< carried objects that are round, in B
  std::vector<int> load_obstacles;   ///< obstacle index of each of these edges
  std::vector<Superstructure> superstructures;
  double own_radius_m = 0.0;   ///< radius of footprint and superstructures about B
  double seen_radius_m = 0.0;  ///< radius of footprint, superstructures and load about B

  [[nodiscard]] const b2Shape& solid() const {
    return round ? static_cast<const b2Shape&>(disc) : shape;
  }
  /// The convex parts of the body; solid() is the first one.
  [[nodiscard]] std::size_t part_count() const { return 1 + further.size(); }
  [[nodiscard]] const b2Shape& part(std::size_t i) const {
    return i == 0 ? solid() : further[i - 1];
  }
};

/// A robot or an obstacle that moves, as stored in Bodies for all parts of the physics.
struct alignas(64) Body {
  // The members that are needed most often come first: one cache line, then some others.
  b2Body* body = nullptr;  ///< null while nothing hinders the robot
  Twist target;
  double radius_m = 0.0;                 ///< of the footprint about B
  double cumulative_max_travel_m = 0.0;  ///< upper bound of any of its points' path length
  double wall_until_m =
      kUnknown;  ///< it reaches no wall or block before its cumulative travel is this
  bool suspended = false;
  bool in_contact_group = false;       ///< touches another robot, or is near one that does
  std::uint8_t substeps_in_box2d = 0;  ///< number of further substeps with a Box2D body
  bool pushable = false;               ///< an obstacle without a drive
  DriveKind drive = DriveKind::kDifferential;

  Pose X_WB;             ///< exact; yaw is not wrapped, and matches the body's angle
  double moved_m = 0.0;  ///< upper bound of the travel of any of its points in this substep
  double stall_clock_s = 0.0;
  double wall_at_travel_m = kUnknown;  ///< its cumulative travel at its last search for walls
  BodyState* state = nullptr;
  BodyDetails* details = nullptr;
};

/// Pose of a robot's shape.
[[nodiscard]] inline b2Transform transform_of(const Body& r) {
  if (r.body != nullptr) return r.body->GetTransform();
  // b2Rot's own functions are the C library's.
  const math::SinCos turn = math::sin_cos(static_cast<double>(static_cast<float>(r.X_WB.yaw_rad)));
  b2Transform xf;
  xf.p = to_box2d(r.X_WB.position());
  xf.q.s = static_cast<float>(turn.sin);
  xf.q.c = static_cast<float>(turn.cos);
  return xf;
}

/// Calls visit(corner) for each corner of a body's polygons, in B.
template <typename Visitor>
void for_each_corner(const BodyDetails& d, Visitor visit) {
  for (int32 i = 0; i < d.shape.m_count; ++i) visit(d.shape.m_vertices[i]);
  for (const b2PolygonShape& part : d.further) {
    for (int32 i = 0; i < part.m_count; ++i) visit(part.m_vertices[i]);
  }
}

/// The least n . v over the points v of a body.
[[nodiscard]] inline float least_along(const b2Vec2& n, const BodyDetails& d,
                                       const b2Transform& xf) {
  float least = least_along(n, d.solid(), xf);
  for (const b2PolygonShape& part : d.further) least = std::min(least, least_along(n, part, xf));
  return least;
}

/// The bounding box of a body.
[[nodiscard]] b2AABB box_of(const BodyDetails& d, const b2Transform& xf);

/// Distance of a body from a shape or another body; see distance_between().
[[nodiscard]] ShapeDistance distance_between(const BodyDetails& a, const b2Transform& xf_a,
                                             const b2Shape& b, const b2Transform& xf_b);
[[nodiscard]] ShapeDistance distance_between(const BodyDetails& a, const b2Transform& xf_a,
                                             const BodyDetails& b, const b2Transform& xf_b);

/// Whether a contact of a part is inside the body, where that part meets another one: then the
/// other part decides. Otherwise a corner that slides along a side of two parts would stop at the
/// inner side of the second one.
/// @param point   of the contact, near the part, in B [Box2D units].
/// @param normal  out of the part, in B.
[[nodiscard]] bool is_between_parts(const BodyDetails& d, std::size_t part, const b2Vec2& point,
                                    const b2Vec2& normal);

/// Distance between the bounding circles of two robots.
[[nodiscard]] inline double circles_apart_m(const Body& a, const Body& b) {
  return std::max(0.0, (a.X_WB.position() - b.X_WB.position()).norm() - a.radius_m - b.radius_m);
}

/// Upper bound of how far any point of a robot moves if it follows its target [m].
[[nodiscard]] inline double most_travel_m(const Body& r, double dt_s) {
  return (std::abs(r.target.v_mps) + std::abs(r.target.lateral_mps) +
          std::abs(r.target.omega_radps) * r.radius_m) *
         dt_s;
}

/// The contacts of a body; nullptr if there is no body.
[[nodiscard]] inline const b2ContactEdge* contact_list(const b2Body* body) {
  return body == nullptr ? nullptr : body->GetContactList();
}

[[nodiscard]] inline bool touches(const b2Body* a, const b2Body* b) {
  if (b == nullptr) return false;
  for (const b2ContactEdge* e = contact_list(a); e != nullptr; e = e->next) {
    if (e->other == b && e->contact->IsTouching()) return true;
  }
  return false;
}

/// Distance of a robot's outline from the line through an edge.
struct LineDistance {
  double apart_m;    ///< negative if the outline crosses the line
  b2Vec2 direction;  ///< towards the line
  bool exact;  ///< the nearest point of the line is on the edge, so apart_m is the distance to the
               ///< edge, too
};
[[nodiscard]] LineDistance distance_to_line(const Body& r, const Wall& wall, const b2Transform& xf);

/// Whether a wall may be within reach_m of a robot, judged by the robot's bounding circle.
[[nodiscard]] bool may_reach(const Body& r, const Wall& wall, double reach_m);

}  // namespace sim::physics
