// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <cstddef>
#include <vector>

#include "physics/bodies.h"
#include "physics/feasible_twist.h"
#include "physics/neighbours.h"

namespace sim::physics {

/// Moves the robots: those that are free along the arcs of their twists, the others by Box2D.
class Mover {
 public:
  Mover(Bodies& bodies, Neighbours& neighbours) : bodies_(bodies), neighbours_(neighbours) {}

  void step(double dt_s);
  /// Writes or reads the state. When reading, that of the robots is there already.
  void archive(StateArchive& archive);
  /// How far any robot went in the last step, at most [m].
  [[nodiscard]] double farthest_move_m() const noexcept { return step_max_travel_m_; }
  /// As PhysicsWorld::bare_step().
  void bare_step(double dt_s);

 private:
  void advance(double dt_s, bool first, bool last);
  void add_constraints(const Robot& r, const b2Shape& other, const b2Transform& other_xf,
                       double share, double dt_s);
  [[nodiscard]] static bool keeps_off(const Robot& r, const Wall& wall, const b2Transform& xf,
                                      double dt_s);
  [[nodiscard]] Twist allowed_twist(std::size_t index, double dt_s);
  [[nodiscard]] bool stays_clear(const Robot& r, const Twist& allowed, double dt_s) const;
  void find_shoving();
  void move_freely(Robot& r, double dt_s);
  void substep(double dt_s, double others_dt_s);
  void follow_body(std::size_t index, double dt_s);
  void arrive(Robot& r, const Pose& goal, const Twist& twist, double dt_s);
  void moved(Robot& r, double way_m, double turn_rad);

  Bodies& bodies_;
  Neighbours& neighbours_;
  double step_s_ = 0.0;                // the whole step under way
  double step_max_travel_m_ = 0.0;     // how far any robot went in the last one, at most
  double farthest_m_ = 0.0;            // that any robot has moved in this part of a step
  std::vector<std::size_t> hindered_;  // robots that are not free
  double most_shove_m_ = 0.0;
  std::vector<std::size_t> shoving_;  // robots that touch others or are near such
  std::vector<Pose> goals_;           // where hindered robots get to if nothing stops them
  std::vector<Twist> twists_;         // by which twist
  std::vector<TwistConstraint> constraints_;
};

}  // namespace sim::physics
