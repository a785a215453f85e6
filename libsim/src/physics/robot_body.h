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
#include "sim/core/pose.h"
#include "sim/world/robot_model.h"

namespace sim::physics {

/// Box2D keeps the hulls of touching polygons apart by their two skins less the slop.
inline constexpr double kRestingGap_m = (2.0 * b2_polygonRadius - b2_linearSlop) / kScale;

/// Nearer than this they touch, to Box2D.
inline constexpr double kTouchingGap_m = 2.0 * b2_polygonRadius / kScale;

/// Farther than this a point of a robot must not move in one step of Box2D: broad phase boxes of
/// obstacles are 1 cm fat, so a contact is known before it is reached.
inline constexpr double kMaxTravel_m = 0.0085;

/// Of a distance that is not known yet.
inline constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// Something near a robot that does not move.
struct Wall {
  const b2Shape* shape = nullptr;
  int fixture = 0;         ///< its FixtureInfo::id
  b2SimplexCache cache{};  ///< of its and the robot's nearest points
  bool is_edge = false;    ///< of a map, whose start, direction and length are:
  Vec2 start = Vec2::Zero();
  Vec2 along = Vec2::UnitX();
  double length_m = 0.0;
};

/// Something solid that may be the nearest to a robot.
struct Candidate {
  const b2Shape* shape;
  int robot;             ///< < 0: none, but what has the FixtureInfo::id -1 - robot
  b2AABB box;            ///< round it, if it does not move
  b2SimplexCache cache;  ///< of its and the robot's nearest points
};

/// What of a robot is asked for less often.
struct RobotDetails {
  b2PolygonShape shape;
  b2PolygonShape reaching_shape;  ///< the same with a wide skin, which finds contacts ahead
  FixtureInfo* info = nullptr;
  double height_m = 0.0;
  double mass_kg = 0.0;
  double inertia_kgm2 = 0.0;
  // Neighbours':
  std::vector<Candidate> candidates;  ///< all that is nearer than candidates_reach_m
  b2Vec2 nearest_direction{1.0F, 0.0F};
  double candidates_reach_m = -1.0;  ///< valid at candidates_at_travel_m; see clearance_m
  double candidates_at_travel_m = 0.0;
  std::vector<Wall> walls;  ///< complete until its cumulative travel reaches:
  double walls_until_m = kUnknown;
  // Contacts':
  std::vector<int> touching;  ///< contacts per partner, see count_contact
  // Sight's:
  EdgeList load;                    ///< outlines of what it carries, in B
  std::vector<int> load_obstacles;  ///< whose each of these edges is
  double seen_radius_m = 0.0;       ///< of the footprint and the load about B
};

/// A robot, as Bodies keeps it for all parts of the physics.
struct alignas(64) Robot {
  // What is asked for most often comes first: one line of the cache, then some others.
  b2Body* body = nullptr;  ///< none while nothing hinders it
  Twist target;
  double radius_m = 0.0;                 ///< of the footprint about B
  double cumulative_max_travel_m = 0.0;  ///< upper bound of any of its points' path length
  double wall_until_m =
      kUnknown;  ///< it reaches no wall or block before its cumulative travel is this
  bool suspended = false;
  bool shoving = false;         ///< touches another, or one that does is near
  std::uint8_t kept_parts = 0;  ///< of a step, for which Box2D keeps the body
  DriveKind drive = DriveKind::kDifferential;

  Pose X_WB;             ///< exact; yaw not wrapped, in step with the body's angle
  double moved_m = 0.0;  ///< upper bound of any of its points' travel in this substep
  double stall_clock_s = 0.0;
  double wall_at_travel_m = kUnknown;  ///< its cumulative travel at its last search for walls
  BodyState* state = nullptr;
  RobotDetails* details = nullptr;
};

/// Where a robot's shape is.
[[nodiscard]] inline b2Transform transform_of(const Robot& r) {
  if (r.body != nullptr) return r.body->GetTransform();
  return {to_box2d(r.X_WB.position()), b2Rot(static_cast<float>(r.X_WB.yaw_rad))};
}

/// How far the circles round two robots are apart.
[[nodiscard]] inline double circles_apart_m(const Robot& a, const Robot& b) {
  return std::max(0.0, (a.X_WB.position() - b.X_WB.position()).norm() - a.radius_m - b.radius_m);
}

/// How far any point of a robot that gets its target travels, at most [m].
[[nodiscard]] inline double most_travel_m(const Robot& r, double dt_s) {
  return (std::abs(r.target.v_mps) + std::abs(r.target.lateral_mps) +
          std::abs(r.target.omega_radps) * r.radius_m) *
         dt_s;
}

/// Contacts of a body, if there is one.
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

/// How far a robot's outline is off the line through an edge.
struct OffLine {
  double apart_m;    ///< below 0: across it
  b2Vec2 direction;  ///< to it
  bool exact;  ///< the edge is where the line is nearest: so far the robot is from the edge, too
};
[[nodiscard]] OffLine off_line(const Robot& r, const Wall& wall, const b2Transform& xf);

/// Whether a wall may be so near to a robot, by the circle round it.
[[nodiscard]] bool may_reach(const Robot& r, const Wall& wall, double reach_m);

}  // namespace sim::physics
