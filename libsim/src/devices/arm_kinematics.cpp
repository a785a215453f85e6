// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/arm_kinematics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/core/elevation.h"
#include "sim/devices/actarray.h"

namespace sim {
namespace {

Eigen::Vector3d vector_of(JointAxis axis) {
  const auto index = static_cast<int>(axis);
  return (index < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(index % 3);
}

// Where the axis of a joint is, in B.
struct PlacedAxis {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d direction;
};

// Calls visit(joint index, axis, frame at the end of its link) from the base outwards.
// @return the frame of the base.
template <typename Visit>
Eigen::Isometry3d walk(const ActArrayParams& arm, const std::vector<double>& positions,
                       Visit visit) {
  Eigen::Isometry3d X_BA = in_space(arm.X_BA, {arm.height_m, arm.roll_rad, arm.pitch_rad});
  Eigen::Isometry3d X = X_BA;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const JointParams& joint = arm.joints[i];
    const double position = i < positions.size() ? positions[i] : 0.0;
    const Eigen::Vector3d axis = vector_of(joint.axis);
    X.linear() *= rotation_of(joint.roll_rad, joint.pitch_rad, joint.yaw_rad);
    const PlacedAxis placed{X.translation(), X.linear() * axis};
    if (joint.type == JointType::kLinear) {
      X.translation() += position * placed.direction;
    } else {
      X.linear() *= rotation_about(axis, position);
    }
    X.translation() += X.linear() * Eigen::Vector3d(joint.length_m, 0.0, 0.0);
    visit(i, placed, X);
  }
  return X_BA;
}

// The end of an arm, seen from its goal.
struct Errors {
  Eigen::Matrix<double, 6, 1> value;           // position, then orientation times its weight
  Eigen::Matrix<double, 6, Eigen::Dynamic> J;  // its derivatives by the joints' positions
};

Errors errors_of(const ActArrayParams& arm, const std::vector<double>& positions,
                 const Eigen::Isometry3d& X_BE, double weight) {
  Errors errors;
  errors.J.resize(6, static_cast<Eigen::Index>(arm.joints.size()));
  std::vector<PlacedAxis> axes;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d X_BA =
      walk(arm, positions, [&](std::size_t, const PlacedAxis& axis, const Eigen::Isometry3d& end) {
        axes.push_back(axis);
        X = end;
      });
  if (axes.empty()) X = X_BA;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (arm.joints[i].type == JointType::kLinear) {
      errors.J.col(column) << axes[i].direction, Eigen::Vector3d::Zero();
    } else {
      errors.J.col(column) << axes[i].direction.cross(X.translation() - axes[i].origin_m),
          weight * axes[i].direction;
    }
  }
  errors.value << X.translation() - X_BE.translation(),
      weight * rotation_vector_of(X.linear() * X_BE.linear().transpose());
  return errors;
}

}  // namespace

std::vector<Eigen::Isometry3d> arm_frames(const ActArrayParams& arm,
                                          const std::vector<double>& positions) {
  std::vector<Eigen::Isometry3d> frames(1);
  frames[0] = walk(
      arm, positions,
      [&](std::size_t, const PlacedAxis&, const Eigen::Isometry3d& end) { frames.push_back(end); });
  return frames;
}

std::vector<std::array<double, 3>> arm_points_m(const ActArrayParams& arm,
                                                const std::vector<double>& positions) {
  std::vector<std::array<double, 3>> points;
  for (const Eigen::Isometry3d& frame : arm_frames(arm, positions)) {
    const Eigen::Vector3d p = frame.translation();
    points.push_back({p.x(), p.y(), p.z()});
  }
  return points;
}

std::vector<double> solve_arm(const ActArrayParams& arm, std::vector<double> start,
                              const Eigen::Isometry3d& X_BE, double weight, int steps) {
  constexpr double kMostDamping = 1e12;
  constexpr double kSmallStep = 1e-8;  // [m or rad]
  const std::size_t joints = arm.joints.size();
  start.resize(joints, 0.0);
  double damping = 1e-3;
  Errors errors = errors_of(arm, start, X_BE, weight);
  for (int step = 0; step < steps && damping < kMostDamping; ++step) {
    const Eigen::VectorXd gradient = errors.J.transpose() * errors.value;
    Eigen::MatrixXd normal = errors.J.transpose() * errors.J;
    // A joint that is at a limit and would leave it stays there.
    for (std::size_t i = 0; i < joints; ++i) {
      const JointTravel travel = travel_of(arm.joints[i]);
      const auto k = static_cast<Eigen::Index>(i);
      const bool is_held = (start[i] <= travel.min && gradient[k] > 0.0) ||
                           (start[i] >= travel.max && gradient[k] < 0.0);
      if (!is_held) continue;
      normal.row(k).setZero();
      normal.col(k).setZero();
    }
    normal.diagonal().array() += damping;
    const Eigen::VectorXd change = -normal.ldlt().solve(gradient);
    std::vector<double> trial = start;
    double moved = 0.0;
    for (std::size_t i = 0; i < joints; ++i) {
      const JointTravel travel = travel_of(arm.joints[i]);
      trial[i] =
          std::clamp(start[i] + change[static_cast<Eigen::Index>(i)], travel.min, travel.max);
      moved = std::max(moved, std::abs(trial[i] - start[i]));
    }
    Errors next = errors_of(arm, trial, X_BE, weight);
    if (next.value.squaredNorm() >= errors.value.squaredNorm()) {
      damping *= 4.0;
      continue;
    }
    start = std::move(trial);
    errors = std::move(next);
    damping = std::max(1e-9, damping / 3.0);
    if (moved < kSmallStep) break;
  }
  return start;
}

}  // namespace sim
