// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace sim {

struct ActArrayParams;

/// The frame of an arm's base, then the frame at the end of each joint's link, in B. See
/// JointParams for the frames.
/// @param positions  of the joints [m or rad]; joints beyond the list are at 0.
[[nodiscard]] std::vector<Eigen::Isometry3d> arm_frames(const ActArrayParams& arm,
                                                        const std::vector<double>& positions);

/// The origins of arm_frames() [m]; z is the height above the floor.
[[nodiscard]] std::vector<std::array<double, 3>> arm_points_m(const ActArrayParams& arm,
                                                              const std::vector<double>& positions);

/// Positions of an arm's joints with which the end of its last link comes as near as it can to a
/// pose (inverse kinematics).
///
/// They minimise |dp|^2 + weight^2 |dR|^2, with dp the distance between the positions [m] and dR
/// the angle between the orientations [rad], within the limits of the joints. The method is that of
/// damped least squares (S. R. Buss, "Introduction to inverse kinematics with Jacobian transpose,
/// pseudoinverse and damped least squares methods", 2004, sec. 6), with the damping of Levenberg
/// and Marquardt. It finds a local minimum near the start.
/// @param start   positions from which the search begins, one for each joint [m or rad].
/// @param X_BE    the wanted pose of the end in B.
/// @param weight  of the orientation [m/rad], >= 0.
/// @param steps   maximum number of iterations; the search ends earlier if it does not move any
/// more.
[[nodiscard]] std::vector<double> solve_arm(const ActArrayParams& arm, std::vector<double> start,
                                            const Eigen::Isometry3d& X_BE, double weight,
                                            int steps = 500);

}  // namespace sim
