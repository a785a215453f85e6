// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/core/pose.h"

namespace sim {

/// The constraint of a contact: along * v + sideways * lateral + turning * omega <= limit, in SI
/// units.
struct TwistConstraint {
  double along;           ///< forward component of the contact normal (towards the obstacle)
  double turning;         ///< lever arm of the contact point about the axle's centre [m]
  double limit;           ///< maximum closing speed [m/s], >= 0
  double sideways = 0.0;  ///< component of the normal to the left

  /// The speed at which a twist closes the gap [m/s].
  [[nodiscard]] double closing(const Twist& twist) const {
    return along * twist.v_mps + sideways * twist.lateral_mps + turning * twist.omega_radps;
  }
};

/// The feasible twist nearest to `target` in kinetic energy: minimises m (v - v0)^2 + I (omega -
/// omega0)^2 under the constraints.
///
/// This is Gauss's principle of least constraint for a body on wheels that cannot slip sideways
/// (two degrees of freedom, frictionless contacts); see Udwadia and Kalaba, Analytical Dynamics
/// (1996), ch. 3. Since every limit is >= 0, standing still is always feasible, and the result
/// has no more kinetic energy than the target.
/// The optimum of this small quadratic program is the target, a point on one constraint, or the
/// intersection of two; all are tried. The cost grows with the cube of the number of constraints,
/// which is 0 away from obstacles and rarely above 6.
[[nodiscard]] Twist feasible_twist(const Twist& target, double mass_kg, double inertia_kgm2,
                                   const std::vector<TwistConstraint>& constraints);

/// The feasible twist of an omnidirectional drive, with three degrees of freedom: minimises m (v -
/// v0)^2 + m (lateral - lateral0)^2 + I (omega - omega0)^2. So the robot slides along a wall that
/// it drives against. At the optimum, none, one, two or three constraints hold with equality; all
/// combinations are tried. The cost grows with the fourth power of the number of constraints.
[[nodiscard]] Twist feasible_planar_twist(const Twist& target, double mass_kg, double inertia_kgm2,
                                          const std::vector<TwistConstraint>& constraints);

/// The feasible twist of a car, which has one degree of freedom at a given steering angle: `target`
/// times the largest factor from 0 to 1 that the constraints allow. Against a wall the car stalls.
[[nodiscard]] Twist feasible_share(const Twist& target,
                                   const std::vector<TwistConstraint>& constraints);

}  // namespace sim
