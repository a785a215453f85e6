// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/random_stream.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/world/obstacle_motion.h"
#include "simulation/simulation_impl.h"

namespace sim {

/// The obstacles of a running world that move: where their drives take them, and their events.
class Simulation::Impl::ObstacleMotions {
 public:
  /// Adds the bodies of the movable obstacles to the physics, after all robots.
  explicit ObstacleMotions(Impl& owner);

  /// Must be called before each step of the physics.
  void before_step(double dt_s);
  /// Must be called after each step of the physics.
  void after_step();
  /// Gives an obstacle another motion. @pre it has a drive.
  void move(int obstacle, const ObstacleMotion& motion);
  /// Must be called after an obstacle was placed.
  void placed(int obstacle);
  /// Adds the paths to a scene.
  void show(SceneSnapshot& scene) const;
  /// Continues at another time.
  void shift_times(SimTime later_ns);
  void archive(StateArchive& archive);

 private:
  struct Moving {
    int obstacle;
    int body;
    double radius_m;  // about its centre
    ObstacleMotion motion{};
    bool has_order = false;     // the controller has replaced its motion
    Vec2 begin = Vec2::Zero();  // where its path begins
    Vec2 from = Vec2::Zero();   // the last waypoint
    Vec2 goal = Vec2::Zero();   // the next waypoint
    std::size_t next = 0;       // number of the next waypoint; 0: `begin`
    bool backwards = false;
    bool has_goal = false;  // otherwise it is at the end of its path
    bool turning = false;   // at the end of its path, to its final angle
    bool blocked = false;
    bool off_path = false;
    SimTime resume_ns = 0;  // it waits until then
    std::optional<RandomStream> random{};
  };

  void begin(Moving& m);
  void choose_next(Moving& m);
  void choose_leg(Moving& m);
  void arrive(Moving& m);
  void finish(Moving& m);
  [[nodiscard]] Pose next_pose(const Moving& m, const Pose& X_WO, double dt_s) const;
  [[nodiscard]] Pose walk(Moving& m, const Pose& X_WO, double dt_s);
  [[nodiscard]] Vec2 force_of_solids(const Moving& m, const Vec2& p_WO);
  void note_hindrance(Moving& m, const Vec2& p_WO);
  // A robot that touches it, otherwise the name of another partner.
  [[nodiscard]] std::pair<std::string, std::string> partner_of(const Moving& m) const;
  [[nodiscard]] ObstacleDescription& description(const Moving& m) const {
    return impl_.obstacle(m.obstacle);
  }

  Impl& impl_;
  std::vector<Moving> moving_;            // by obstacle
  std::vector<std::size_t> pedestrians_;  // indices in moving_
  std::vector<bool> is_pedestrian_;       // by obstacle
  std::vector<PhysicsWorld::Face> faces_;
};

}  // namespace sim
