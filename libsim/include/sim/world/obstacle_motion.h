// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sim/core/pose.h"

/// How obstacles of the arena move. docs/moving_obstacles.md explains it.
namespace sim {

/// Maximum speed of a moving obstacle [m/s].
inline constexpr double kMaxObstacleSpeed_mps = 10.0;

/// Maximum turn rate of a moving obstacle [rad/s].
inline constexpr double kMaxObstacleTurnRate_radps = 20.0;

/// Mass of a moving obstacle without a mass of its own [kg].
inline constexpr double kMovingObstacleMass_kg = 10.0;

/// Coefficient of friction between the floor and an obstacle without one of its own.
inline constexpr double kFloorFriction = 0.3;

/// What decides where an obstacle goes.
enum class MotionLaw {
  kStand,       ///< it stands until the arena controller moves it
  kPath,        ///< along waypoints
  kRandomWalk,  ///< straight legs of random direction and length
  kPedestrian,  ///< to waypoints, by the social-force model
};

/// What follows the last waypoint of a path.
enum class PathRepeat {
  kOnce,          ///< it stays there
  kBackAndForth,  ///< the waypoints in reverse, back to the place where the path began, and again
  kRound,         ///< the place where the path began, and again
  kRandom,        ///< pedestrians only: any waypoint after any other
};

/// Constants of the social-force model. The defaults are those of D. Helbing and P. Molnar, "Social
/// force model for pedestrian dynamics", Physical Review E 51, 4282 (1995), section III.
struct SocialForce {
  double relaxation_s = 0.5;           ///< tau: time in which it reaches its desired velocity [s]
  double repulsion_m2ps2 = 2.1;        ///< V0: strength of its repulsion by others [m^2/s^2]
  double repulsion_range_m = 0.3;      ///< sigma: range of that repulsion [m]
  double wall_repulsion_m2ps2 = 10.0;  ///< U0: strength of its repulsion by solids [m^2/s^2]
  double wall_range_m = 0.2;           ///< R: range of that repulsion [m]
};

/// The motion of an obstacle.
struct ObstacleMotion {
  /// A rectangle of the floor with sides along W's axes.
  struct Area {
    Vec2 center = Vec2::Zero();  ///< in W [m]
    Vec2 size = Vec2::Zero();    ///< [m]
  };
  MotionLaw law = MotionLaw::kStand;       ///< what decides where it goes
  double speed_mps = 0.3;                  ///< [m/s]; of a pedestrian the desired speed
  double turn_rate_radps = 1.57079632679;  ///< [rad/s]
  bool faces_way = false;    ///< its x axis points where it goes; a path turns on the spot first
  std::vector<Vec2> points;  ///< waypoints of paths and pedestrians, of its centre in W [m]
  PathRepeat repeat = PathRepeat::kOnce;  ///< what follows the last waypoint
  double wait_s = 0.0;                    ///< it stops for so long at each waypoint [s]
  std::optional<double> final_yaw_rad;    ///< of a path: it turns to this at its end [rad]
  double leg_m = 0.5;                     ///< of a random walk: mean length of a leg [m]
  std::optional<Area> area;  ///< of a random walk: it stays there; none: the whole floor
  SocialForce force;         ///< of a pedestrian
};

}  // namespace sim
