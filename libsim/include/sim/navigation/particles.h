// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/pose.h"
#include "sim/core/random_stream.h"

namespace sim {

/// A possible pose of a robot.
struct Particle {
  Pose pose;            ///< X_WB
  double weight = 0.0;  ///< >= 0; the weights of a set add up to 1
};

/// Covariance of a pose's x, y and yaw; symmetric. The order is that of Player's `cov`.
struct PoseCovariance {
  std::array<double, 3> variance{};    ///< xx [m^2], yy [m^2], yaw yaw [rad^2]
  std::array<double, 3> covariance{};  ///< x y [m^2], y yaw [m rad], x yaw [m rad]
};

/// One of several possible poses of a robot: a Gaussian.
struct PoseHypothesis {
  Pose mean;                  ///< X_WB
  PoseCovariance covariance;  ///< in W
  double weight = 0.0;        ///< share of all particles' weight, (0, 1]
};

/// Whether a covariance is possible: finite, without negative variances, and positive semidefinite
/// (principal minors >= -1e-9 of the product of their variances).
[[nodiscard]] bool is_valid(const PoseCovariance& covariance);

/// Draws a pose from a Gaussian, with three normal deviates.
/// @pre is_valid(covariance)
[[nodiscard]] Pose sample_pose(const Pose& mean, const PoseCovariance& covariance,
                               RandomStream& random);

/// The hypothesis after the robot has moved: the mean follows exactly, the covariance by the
/// motion's Jacobian.
/// @param X_AB  motion in the robot's own frame.
[[nodiscard]] PoseHypothesis moved(const PoseHypothesis& hypothesis, const Pose& X_AB);

/// Sides of the bins that count how widely particles are spread (0.5 m and 10 degrees, as in
/// Player's amcl).
inline constexpr double kPoseBin_m = 0.5;
inline constexpr int kPoseBinsPerTurn = 36;  ///< bins of the heading

/// A histogram of poses: which bins have at least one pose. Used for KLD-sampling.
class PoseBins {
 public:
  PoseBins();
  /// @return whether the pose's bin was empty.
  bool add(const Pose& pose);
  /// Number of bins with poses.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
  void grow();

  std::vector<std::uint64_t> keys_;  // open addressing; 0: empty
  std::size_t count_ = 0;
};

/// Number of particles for which, with the probability that belongs to `z`, the Kullback-Leibler
/// divergence between the particles' distribution and the true one is at most `error`: D. Fox,
/// "Adapting the Sample Size in Particle Filters Through KLD-Sampling", International Journal of
/// Robotics Research 22(12), 2003, equation 7.
/// @param bins   number of bins with particles.
/// @param error  > 0
/// @param z      quantile of the standard normal distribution, >= 0.
/// @return >= 1; 1 for a single bin.
[[nodiscard]] double kld_sample_size(std::size_t bins, double error, double z);

/// Divides particles into clusters and returns the Gaussian of each, the heaviest first. Particles
/// belong to one cluster if a chain of neighbouring bins connects them (sides of kPoseBin_m and of
/// 1 / kPoseBinsPerTurn turn; diagonal neighbours count).
/// The yaw is the circular mean; its variance is that of the wrapped differences.
/// @param most  maximum number of hypotheses; the lightest ones are dropped.
/// @note O(n log n). Clusters of equal weight keep the order of their first particles.
[[nodiscard]] std::vector<PoseHypothesis> pose_hypotheses(std::span<const Particle> particles,
                                                          std::size_t most);

/// Draws `count` particles by their weights, with the low-variance resampler (Probabilistic
/// Robotics, table 4.4); all get the weight 1 / count. Draws one number.
/// @pre the weights add up to 1 (rounding errors are fine); count >= 1.
void resample_low_variance(std::span<const Particle> particles, std::size_t count,
                           RandomStream& random, std::vector<Particle>& into);

}  // namespace sim
