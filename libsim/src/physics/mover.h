// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <cstddef>
#include <vector>

#include "physics/bodies.h"
#include "physics/feasible_twist.h"
#include "physics/neighbours.h"

namespace sim::physics {

/// Moves the robots and the moving obstacles, which are robots here: free ones along the arcs of
/// their twists, the others with Box2D.
class Mover {
 public:
  Mover(Bodies& bodies, Neighbours& neighbours) : bodies_(bodies), neighbours_(neighbours) {}

  void step(double dt_s);
  /// Writes or reads the state. When reading, the robots' state must have been read before.
  void archive(StateArchive& archive);
  /// Upper bound of how far any robot moved in the last step [m].
  [[nodiscard]] double farthest_move_m() const noexcept { return step_max_travel_m_; }
  /// Whether Box2D has computed what a robot may do, or did.
  [[nodiscard]] bool used_box2d() const noexcept { return used_box2d_; }
  /// See PhysicsWorld::plain_box2d_step().
  void plain_box2d_step(double dt_s);

 private:
  void substep(double dt_s, bool first, bool last);
  void add_constraints(const Body& r, const b2Shape& other, const b2Transform& other_xf,
                       double share, double dt_s);
  void add_constraints(const Body& r, std::size_t part, const b2Shape& other,
                       const b2Transform& other_xf, double share, double dt_s);
  void add_round_constraints(const Body& r, std::size_t part, const b2CircleShape& circle,
                             const b2Transform& circle_xf, double share, double dt_s);
  void add_disc_constraint(const Body& r, const b2Shape& other, const b2Transform& other_xf,
                           double share, double dt_s);
  [[nodiscard]] static bool clears_wall(const Body& r, const Wall& wall, const b2Transform& xf,
                                        double dt_s);
  [[nodiscard]] Twist allowed_twist(std::size_t index, double dt_s);
  [[nodiscard]] bool clears_all(const Body& r, const Twist& allowed, double dt_s) const;
  void find_contact_groups(double dt_s);
  [[nodiscard]] bool may_push(const Neighbours::NearPair& pair, double dt_s) const;
  void set_obstacle_targets(double dt_s);
  [[nodiscard]] Twist limit_by_traction(Body& r, const Twist& wanted, double dt_s) const;
  void set_friction(std::size_t index, double dt_s, bool first);
  static void note_velocity(Body& r);
  void move_freely(Body& r, double dt_s);
  void contact_substep(double dt_s, double others_dt_s);
  void follow_body(std::size_t index, double dt_s);
  void move_to_goal(Body& r, const Pose& goal, const Twist& twist, double dt_s);
  void record_travel(Body& r, double way_m, double turn_rad);

  Bodies& bodies_;
  Neighbours& neighbours_;
  double step_s_ = 0.0;                // length of the current step
  double step_max_travel_m_ = 0.0;     // upper bound of how far any robot moved in the last step
  double farthest_m_ = 0.0;            // maximum travel of any robot in the current substep
  std::vector<std::size_t> hindered_;  // robots that are not free
  bool used_box2d_ = false;
  double max_contact_travel_m_ = 0.0;
  std::vector<std::size_t> contact_robots_;  // robots that touch others, or are near such robots
  std::vector<Pose> goals_;                  // poses of hindered robots if nothing stops them
  std::vector<Twist> twists_;                // twists towards `goals_`
  std::vector<Twist> wanted_;                // twists without the limit of traction
  std::vector<TwistConstraint> constraints_;
};

}  // namespace sim::physics
