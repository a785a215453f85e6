// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/physics_world.h"
#include "sim/core/pose.h"
#include "sim/core/state_archive.h"
#include "sim/world/description.h"

namespace sim {

/// Finds out which robots come into the regions of traps and go out of them.
///
/// A robot counts as its centre B. For each robot, a lower bound of the way to the nearest border
/// of a region is known from the last test. Most steps subtract the robot's motion from it and test
/// nothing. The bound includes the motion of the objects that regions follow. It does not affect
/// the results, so it is not part of the state.
class TrapWatch {
 public:
  /// A robot that has crossed the border of a trap's region.
  struct Change {
    std::uint32_t trap;   ///< index
    std::uint32_t robot;  ///< index
    bool inside;          ///< it is inside now
  };
  /// The region of a trap.
  struct Region {
    std::vector<Vec2> corners;   ///< in W [m]; empty: a circle
    Vec2 low = Vec2::Zero();     ///< bounding box of the corners
    Vec2 high = Vec2::Zero();    ///< bounding box of the corners
    Vec2 center = Vec2::Zero();  ///< of the circle
    double radius_m = 0.0;       ///< of the circle [m]
    int target = -1;             ///< index in the list of targets that the centre follows; -1: none
  };

  /// @pre the names in the world's traps exist.
  explicit TrapWatch(const WorldDescription& world);

  /// Tests after a step. @return changes by trap and robot, valid until the next call.
  const std::vector<Change>& update(const PhysicsWorld& physics, const WorldDescription& world);
  /// A trap that is switched on or off is empty until the next update().
  void set_enabled(std::size_t trap, bool enabled);
  [[nodiscard]] bool enabled(std::size_t trap) const { return enabled_[trap] != 0; }
  [[nodiscard]] bool inside(std::size_t trap, std::size_t robot) const {
    return inside_[trap * robots_.size() + robot] != 0;
  }
  /// The region with its present centre.
  [[nodiscard]] Region region(std::size_t trap, const PhysicsWorld& physics,
                              const WorldDescription& world) const;
  void archive(StateArchive& archive);

 private:
  static constexpr std::size_t kNear = 8;
  struct Robot {
    Vec2 last = Vec2::Zero();  // position at the last update
    double slack_m = 0.0;      // no status changes before so much motion
    double far_slack_m = 0.0;  // the same for the traps that are not in `near`
    std::uint32_t near_count = 0;
    std::array<std::uint32_t, kNear> near{};  // the traps whose borders were nearest
    std::vector<std::uint32_t> traps;         // those that are for this robot
  };
  // An object that regions follow.
  struct Target {
    int robot;
    int obstacle;
    Vec2 last = Vec2::Zero();
  };
  void add_target(Region& region, const NearRegion& near, const WorldDescription& world);
  [[nodiscard]] static Vec2 position(const Target& target, const PhysicsWorld& physics,
                                     const WorldDescription& world);
  double move_targets(const PhysicsWorld& physics, const WorldDescription& world);
  void forget_bounds();
  double test(std::uint32_t trap, std::uint32_t robot, const Vec2& p);
  void test_near(std::uint32_t robot, const Vec2& p);
  void test_all(std::uint32_t robot, const Vec2& p);

  std::vector<Region> regions_;
  std::vector<Robot> robots_;
  std::vector<Target> targets_;
  std::vector<std::uint8_t> enabled_;
  std::vector<std::uint8_t> inside_;  // by trap and robot
  std::vector<Change> changes_;
};

}  // namespace sim
