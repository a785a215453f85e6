// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/core/pose.h"

namespace sim {

/// What a contact allows: along * v + sideways * lateral + turning * omega <= limit, all in SI
/// units.
struct TwistConstraint {
  double along;           ///< forward component of the contact normal (towards the obstacle)
  double turning;         ///< lever of the contact point about the axle's centre [m]
  double limit;           ///< greatest closing speed [m/s], >= 0
  double sideways = 0.0;  ///< component of the normal to the left

  /// How fast a twist closes the gap [m/s].
  [[nodiscard]] double closing(const Twist& twist) const {
    return along * twist.v_mps + sideways * twist.lateral_mps + turning * twist.omega_radps;
  }
};

/// The feasible twist nearest to `target` in kinetic energy: it minimises
/// m (v - v0)^2 + I (omega - omega0)^2 under the constraints.
///
/// This is Gauss's principle of least constraint for a body on wheels that cannot slip sideways
/// (two degrees of freedom, frictionless contacts); see Udwadia and Kalaba, Analytical Dynamics
/// (1996), ch. 3. Since every limit is >= 0, standing still is always feasible, and the result
/// has no more kinetic energy than the target.
/// The optimum of this small quadratic program lies at the target, on one constraint or at the
/// crossing of two; all are tried. Cost grows with the cube of the number of constraints, which
/// is 0 in the open and rarely above 6.
[[nodiscard]] Twist feasible_twist(const Twist& target, double mass_kg, double inertia_kgm2,
                                   const std::vector<TwistConstraint>& constraints);

/// The same for an omnidirectional drive, which has three degrees of freedom: it minimises
/// m (v - v0)^2 + m (lateral - lateral0)^2 + I (omega - omega0)^2. So it slides along a wall that
/// it is driven against. The optimum lies at the target or where one, two or three constraints
/// hold with equality; all are tried, at a cost that grows with the fourth power of their number.
[[nodiscard]] Twist feasible_planar_twist(const Twist& target, double mass_kg, double inertia_kgm2,
                                          const std::vector<TwistConstraint>& constraints);

/// The same for a car, whose steering leaves it one degree of freedom: the greatest share of
/// `target`, from 0 to 1, that the constraints allow. Against a wall it stalls.
[[nodiscard]] Twist feasible_share(const Twist& target,
                                   const std::vector<TwistConstraint>& constraints);

}  // namespace sim
