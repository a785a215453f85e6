// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <cstddef>
#include <vector>

#include "physics/bodies.h"

namespace sim::physics {

/// Who is near whom: pairs of robots that may meet soon, and the walls near each robot. Distances
/// that were found hold until the robots have gone as far.
class Neighbours {
 public:
  struct Neighbour {
    int robot;
    double apart_m;
    b2Vec2 direction;  ///< towards it
  };
  /// Two robots that may be in each other's way.
  struct NearPair {
    int first, second;
    double apart_m;    ///< at least, when this part of a step began,
    b2Vec2 direction;  ///< along this, from the first to the second
  };

  explicit Neighbours(Bodies& bodies) : bodies_(bodies) {}

  /// Forgets all distances: something was put somewhere.
  void forget();
  /// Whether that was so since the last find(). What was put somewhere may touch already, so find()
  /// lets Box2D have all robots that something is near to.
  [[nodiscard]] bool something_was_placed() const noexcept { return placed_; }
  void note_contacts_found() noexcept { placed_ = false; }

  /// Begins a step.
  /// @param travel_m  upper bound of a robot's travel in one substep at its target twist [m].
  void begin_step(double travel_m) noexcept { travel_m_ = travel_m; }
  /// Finds the robots so close that they may reach one another, and how near walls are.
  void find(double dt_s);
  /// Ends a substep in which no robot moved farther than `farthest_m` [m].
  void note_moved(double farthest_m) noexcept { cumulative_max_travel_m_ += farthest_m; }
  /// Upper bound of the cumulative travel of any robot [m].
  [[nodiscard]] double cumulative_max_travel_m() const noexcept { return cumulative_max_travel_m_; }

  [[nodiscard]] const std::vector<NearPair>& near_pairs() const noexcept { return near_pairs_; }
  /// Those near to a robot, in the order of near_pairs().
  [[nodiscard]] const std::vector<Neighbour>& near_to(std::size_t robot) const {
    return near_to_[robot];
  }
  /// Whether a robot can have its way in this part of a step: it reaches nothing, and if others
  /// come half as near as they are, they do not reach it. Not asked of robots that may be shoved.
  [[nodiscard]] bool is_free(std::size_t index, double dt_s) const;
  /// Whether a robot that is shoved might run into something that it does not touch yet.
  [[nodiscard]] bool may_be_shoved_into(std::size_t index) const;

  /// Writes or reads the state. When reading, Box2D's fixtures are there already.
  void archive(StateArchive& archive);

  /// As PhysicsWorld::clearance_m().
  [[nodiscard]] double clearance_m(Robot& r, double limit_m, double exact_below_m);

 private:
  // Two robots that may come near one another.
  struct Pair {
    int first, second;
    double pair_at_travel_m;  // sum of both cumulative travels at the last measurement
    double apart_m;           // lower bound of their distance then
    b2Vec2 direction;         // from the first to the second, between their nearest points
    b2SimplexCache cache;     // of these points
  };

  static bool comes_before(const Pair& a, const Pair& b);
  void list_pairs();
  [[nodiscard]] static double distance_m(const Robot& a, const Robot& b, double enough_m,
                                         Pair& pair);
  void find_near_pairs(double dt_s);
  void look_for_walls(Robot& r, double dt_s);
  [[nodiscard]] double wall_reach_m() const;
  [[nodiscard]] Wall wall_of(const b2Fixture& fixture) const;
  [[nodiscard]] double distance_to_walls_m(Robot& r);
  void archive_robot(StateArchive& archive, Robot& r, const std::vector<b2Fixture*>& fixtures);
  void collect_candidates(Robot& r, const b2AABB& box, double reach_m);
  [[nodiscard]] bool is_near_wall(const Robot& r, const b2Contact& contact) const;

  Bodies& bodies_;
  bool placed_ = true;
  double travel_m_ = 0.0;
  double cumulative_max_travel_m_ = 0.0;
  // All pairs that may come near before cumulative_max_travel_m_ reaches pairs_until_m_, sorted.
  std::vector<Pair> pairs_;
  // For each pair: they may meet once cumulative_max_travel_m_ has reached this.
  std::vector<double> meet_at_travel_m_;
  std::vector<Pair> pairs_before_;  // the previous list
  std::vector<double> meet_before_;
  std::vector<std::size_t> may_meet_;  // those of them that may meet in this part of a step
  double pairs_until_m_ = 0.0;
  std::vector<NearPair> near_pairs_;             // of them, those that may be in each other's way
  std::vector<std::vector<Neighbour>> near_to_;  // the same by robot
};

}  // namespace sim::physics
