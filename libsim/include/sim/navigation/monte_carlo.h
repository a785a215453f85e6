// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/core/random_stream.h"
#include "sim/core/state_archive.h"
#include "sim/navigation/likelihood_field.h"
#include "sim/navigation/odometry_motion.h"
#include "sim/navigation/particles.h"

namespace sim {

/// Settings of Monte Carlo localisation.
struct MonteCarloSettings {
  int min_samples = 100;         ///< least number of particles, >= 1
  int max_samples = 10000;       ///< greatest number of particles, >= min_samples
  double kld_error = 0.01;       ///< see kld_sample_size(), > 0
  double kld_z = 3.0;            ///< see kld_sample_size(), >= 0
  double update_m = 0.2;         ///< a scan is used after this distance, >= 0 [m]
  double update_rad = 0.5236;    ///< or after this turn, >= 0 [rad]
  double independent_beams = 0;  ///< a scan counts like this many independent beams, > 0
  double alpha_slow = 0.01;      ///< rate of the slow mean of the scans' likelihood, [0, 1]
  double alpha_fast = 0.3;       ///< rate of the fast mean, [0, 1]; 0: no recovery
  OdometryNoise motion;
};

/// Monte Carlo localisation on a known map: a particle filter that estimates a robot's pose from
/// odometry and laser scans.
///
/// Sources:
/// - F. Dellaert, D. Fox, W. Burgard, S. Thrun, "Monte Carlo Localization for Mobile Robots", ICRA
///   1999: the filter;
/// - S. Thrun, W. Burgard, D. Fox, "Probabilistic Robotics" (2005): the motion model (table 5.6),
///   the likelihood field (table 6.3), the low-variance resampler (table 4.4), and recovery by
///   the short- and long-term mean likelihood (augmented MCL, table 8.3);
/// - D. Fox, "Adapting the Sample Size in Particle Filters Through KLD-Sampling", IJRR 22(12),
///   2003: the number of particles;
/// - S. Lenser and M. Veloso, "Sensor resetting localization for poorly modelled mobile robots",
///   ICRA 2000: new particles are drawn from poses that fit the scan.
///
/// Differences from them: neighbouring beams hit the same walls, so their likelihoods are not
/// independent. A scan therefore has the weight exp(independent_beams * mean log-likelihood of its
/// beams). The mean likelihood that recovery compares is that of one beam (a geometric mean),
/// because a product over all beams differs between places by many orders of magnitude.
///
/// Deterministic: equal inputs and random streams give equal results. Not thread-safe.
class MonteCarloLocalizer {
 public:
  /// Starts without particles; call spread() or set_pose().
  MonteCarloLocalizer(const MonteCarloSettings& settings,
                      std::shared_ptr<const LikelihoodField> field, RandomStream random);

  /// The robot may be anywhere on the map: max_samples particles, uniformly spread over all free
  /// cells and headings. The next scan is used whether or not the robot has moved; it first selects
  /// the particles from ten times as many poses.
  void spread();
  /// The robot is near a pose: max_samples particles from a Gaussian. The next scan is used whether
  /// or not the robot has moved.
  /// @pre is_valid(covariance)
  void set_pose(const Pose& mean, const PoseCovariance& covariance);

  /// Adds a motion that odometry has measured, in the robot's own frame.
  void move(const Pose& X_AB);
  /// Whether the next scan is used: the robot has moved by update_m or turned by update_rad since
  /// the last one, or spread() or set_pose() was called.
  [[nodiscard]] bool wants_scan() const;
  /// One update of the filter with a scan from the present pose, whatever wants_scan() says: moves
  /// the particles, weights them, finds hypotheses, resamples.
  /// @pre there are particles.
  /// @note A scan without points (nothing within range) changes no weights.
  void update(const ScanPoints& scan);

  /// The possible poses now, the most likely one first: the result of the last update, moved by the
  /// odometry since then. Before the first update: that of the initial particles.
  [[nodiscard]] std::vector<PoseHypothesis> hypotheses() const;
  /// The particles now, moved in the same way.
  [[nodiscard]] std::vector<Particle> particles() const;
  [[nodiscard]] std::size_t size() const noexcept { return particles_.size(); }
  /// Number of calls of update().
  [[nodiscard]] std::uint64_t updates() const noexcept { return updates_; }
  /// Share of the particles that the last update replaced by poses that fit the scan, [0, 1].
  [[nodiscard]] double reset_share() const noexcept { return reset_share_; }
  [[nodiscard]] const LikelihoodField& field() const noexcept { return *field_; }

  /// Writes or reads the state; settings and field are not part of it.
  void archive(StateArchive& archive);

  /// Maximum number of hypotheses.
  static constexpr std::size_t kMostHypotheses = 10;

 private:
  [[nodiscard]] double scan_weight(const Pose& X_WB, const ScanPoints& scan) const;
  [[nodiscard]] Pose random_free_pose();
  /// Appends `count` particles, drawn from random free poses by how well they fit the scan.
  void draw_from_scan(const ScanPoints& scan, std::size_t count, std::vector<Particle>& into);
  /// Sets weights; @return the mean likelihood of one beam.
  double weigh(const ScanPoints& scan);
  [[nodiscard]] std::size_t adapted_size();
  void resample(const ScanPoints& scan);
  void restart();

  MonteCarloSettings settings_;
  std::shared_ptr<const LikelihoodField> field_;
  RandomStream random_;
  std::vector<Particle> particles_;
  std::vector<Particle> next_;  // scratch
  std::vector<PoseHypothesis> hypotheses_;
  Pose moved_;              // since the last update
  bool is_new_ = true;      // no scan was used since the last restart
  bool is_spread_ = false;  // the particles come from spread(), and no scan was used yet
  double slow_ = 0.0;       // means of the likelihood; 0: none yet
  double fast_ = 0.0;
  double reset_share_ = 0.0;
  std::uint64_t updates_ = 0;
};

}  // namespace sim
