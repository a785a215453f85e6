// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/box2d.h>

#include <cstddef>
#include <vector>

#include "physics/bodies.h"

namespace sim::physics {

/// Finds pairs of robots that may soon meet, and walls near each robot. A measured distance is
/// valid until the robots have travelled that far.
class Neighbours {
 public:
  struct Neighbour {
    int robot;
    double apart_m;
    b2Vec2 direction;  ///< towards the neighbour
  };
  /// Two robots that may hinder each other.
  struct NearPair {
    int first, second;
    double apart_m;    ///< lower bound at the start of this substep,
    b2Vec2 direction;  ///< along this direction, from the first to the second
  };

  explicit Neighbours(Bodies& bodies) : bodies_(bodies) {}

  /// Invalidates all distances after something was placed.
  void invalidate();
  /// Whether invalidate() was called since the last find(). Placed bodies may touch already, so
  /// find() then gives Box2D bodies to all robots that are near anything.
  [[nodiscard]] bool something_was_placed() const noexcept { return placed_; }
  void note_contacts_found() noexcept { placed_ = false; }

  /// Begins a step.
  /// @param travel_m  maximum travel of a robot that follows its target, in one substep [m].
  void begin_step(double travel_m) noexcept { travel_m_ = travel_m; }
  /// Finds the pairs of robots that are close enough to reach each other, and the distances to
  /// walls.
  void find(double dt_s);
  /// Ends a substep in which no robot moved farther than `farthest_m`.
  void note_moved(double farthest_m) noexcept { cumulative_max_travel_m_ += farthest_m; }
  /// Upper bound of the cumulative travel of any robot [m].
  [[nodiscard]] double cumulative_max_travel_m() const noexcept { return cumulative_max_travel_m_; }

  [[nodiscard]] const std::vector<NearPair>& near_pairs() const noexcept { return near_pairs_; }
  /// The neighbours of a robot, in the order of near_pairs().
  [[nodiscard]] const std::vector<Neighbour>& near_to(std::size_t robot) const {
    return near_to_[robot];
  }
  /// Whether a robot can follow its target in this substep: it reaches no solid, and no more
  /// than half of the gap to any other robot. Must not be called for robots that may be pushed.
  [[nodiscard]] bool is_free(std::size_t index, double dt_s) const;
  /// Whether a pushed robot might hit something that it does not touch yet.
  [[nodiscard]] bool may_be_pushed_into_others(std::size_t index) const;

  /// Writes or reads the state. When reading, Box2D's fixtures must exist.
  void archive(StateArchive& archive);

  /// See PhysicsWorld::clearance_m().
  [[nodiscard]] double clearance_m(Body& r, double limit_m, double exact_below_m);

 private:
  // Two robots that may come near each other.
  struct Pair {
    int first, second;
    double pair_at_travel_m;  // when the sum of both robots' travel had this value,
    double apart_m;           // this was a lower bound of their distance
    b2Vec2 direction;         // from the first to the second, between their nearest points
  };

  static bool comes_before(const Pair& a, const Pair& b);
  [[nodiscard]] bool is_solid(int robot) const { return bodies_.at(robot).details->info->solid; }
  void list_pairs();
  [[nodiscard]] static double distance_m(const Body& a, const Body& b, double enough_m, Pair& pair);
  void find_near_pairs(double dt_s);
  void look_for_walls(Body& r, double dt_s);
  [[nodiscard]] double wall_reach_m() const;
  [[nodiscard]] Wall wall_of(const b2Fixture& fixture) const;
  [[nodiscard]] double distance_to_walls_m(Body& r);
  void archive_robot(StateArchive& archive, Body& r, const std::vector<b2Fixture*>& fixtures);
  void collect_candidates(Body& r, const b2AABB& box, double reach_m);
  [[nodiscard]] bool is_near_wall(const Body& r, const b2Contact& contact) const;

  Bodies& bodies_;
  bool placed_ = true;
  double travel_m_ = 0.0;
  double cumulative_max_travel_m_ = 0.0;
  // all that may come near before cumulative_max_travel_m_ is pairs_until_m_, in order
  std::vector<Pair> pairs_;
  std::vector<double>
      meet_at_travel_m_;            // by pair: cumulative_max_travel_m_ from which on they may meet
  std::vector<Pair> pairs_before_;  // previous `pairs_`
  std::vector<double> meet_before_;
  std::vector<std::size_t> candidate_pairs_;  // indices of pairs that may meet in this substep
  double pairs_until_m_ = 0.0;
  std::vector<NearPair> near_pairs_;             // those that may hinder each other
  std::vector<std::vector<Neighbour>> near_to_;  // the same pairs, by robot
};

}  // namespace sim::physics
