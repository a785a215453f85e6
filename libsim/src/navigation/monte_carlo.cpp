// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/navigation/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/assert.h"
#include "sim/core/math.h"

namespace sim {
namespace {

/// Poses that a scan selects new particles from, per particle.
constexpr std::size_t kCandidates = 10;
/// For recovery, a scan that selects them counts this share of independent_beams: no candidate is
/// exactly the robot's pose, so a sharper selection would keep few of them, and often not the right
/// ones. A filter that starts anywhere has so many candidates that it selects sharply.
constexpr double kSelection = 0.25;

}  // namespace

MonteCarloLocalizer::MonteCarloLocalizer(const MonteCarloSettings& settings,
                                         std::shared_ptr<const LikelihoodField> field,
                                         RandomStream random)
    : settings_(settings), field_(std::move(field)), random_(std::move(random)) {
  SIM_ASSERT(field_ != nullptr && settings_.min_samples >= 1 &&
             settings_.max_samples >= settings_.min_samples && settings_.independent_beams > 0.0);
}

void MonteCarloLocalizer::restart() {
  hypotheses_ = pose_hypotheses(particles_, kMostHypotheses);
  moved_ = {};
  is_new_ = true;
  slow_ = 0.0;
  fast_ = 0.0;
  reset_share_ = 0.0;
}

Pose MonteCarloLocalizer::random_free_pose() {
  const Vec2 centre = field_->free_position(random_.uniform());
  const double side_m = field_->cell_size_m();
  const double x_m = centre.x() + (random_.uniform() - 0.5) * side_m;
  const double y_m = centre.y() + (random_.uniform() - 0.5) * side_m;
  return {x_m, y_m, normalize_angle(2.0 * std::numbers::pi * random_.uniform())};
}

void MonteCarloLocalizer::spread() {
  const auto count = static_cast<std::size_t>(settings_.max_samples);
  particles_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    particles_.push_back({random_free_pose(), 1.0 / static_cast<double>(count)});
  }
  is_spread_ = true;
  restart();
}

void MonteCarloLocalizer::set_pose(const Pose& mean, const PoseCovariance& covariance) {
  const auto count = static_cast<std::size_t>(settings_.max_samples);
  particles_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    particles_.push_back(
        {sample_pose(mean, covariance, random_), 1.0 / static_cast<double>(count)});
  }
  is_spread_ = false;
  restart();
}

void MonteCarloLocalizer::move(const Pose& X_AB) {
  if (X_AB == Pose{}) return;
  // Differences of odometry that jumps by more than doubles can express.
  if (!X_AB.position().allFinite() || !std::isfinite(X_AB.yaw_rad)) return;
  moved_ = moved_ * X_AB;
}

bool MonteCarloLocalizer::wants_scan() const {
  if (particles_.empty()) return false;
  return is_new_ || math::hypot(moved_.x_m, moved_.y_m) >= settings_.update_m ||
         std::abs(moved_.yaw_rad) >= settings_.update_rad;
}

double MonteCarloLocalizer::scan_weight(const Pose& X_WB, const ScanPoints& scan) const {
  const double share = is_spread_ ? 1.0 : kSelection;
  return math::exp(share * settings_.independent_beams * field_->mean_log_likelihood(X_WB, scan));
}

void MonteCarloLocalizer::draw_from_scan(const ScanPoints& scan, std::size_t count,
                                         std::vector<Particle>& into) {
  std::vector<Particle> candidates;
  candidates.reserve(kCandidates * count);
  double sum = 0.0;
  for (std::size_t i = 0; i < kCandidates * count; ++i) {
    const Pose pose = random_free_pose();
    candidates.push_back({pose, scan_weight(pose, scan)});
    sum += candidates.back().weight;
  }
  for (Particle& candidate : candidates) candidate.weight /= sum;
  resample_low_variance(candidates, count, random_, into);
}

double MonteCarloLocalizer::weigh(const ScanPoints& scan) {
  double sum = 0.0;
  double mean = 0.0;
  for (Particle& particle : particles_) {
    const double log_likelihood = field_->mean_log_likelihood(particle.pose, scan);
    mean += particle.weight * math::exp(log_likelihood);
    particle.weight *= math::exp(settings_.independent_beams * log_likelihood);
    sum += particle.weight;
  }
  for (Particle& particle : particles_) particle.weight /= sum;
  return mean;
}

std::size_t MonteCarloLocalizer::adapted_size() {
  std::vector<double> sums(particles_.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sum += particles_[i].weight;
  PoseBins bins;
  const auto least = static_cast<double>(settings_.min_samples);
  const auto most = static_cast<std::size_t>(settings_.max_samples);
  double needed = least;
  std::size_t count = 0;
  while (count < most && static_cast<double>(count) < needed) {
    ++count;
    const auto at = std::upper_bound(sums.begin(), sums.end() - 1, sum * random_.uniform());
    if (!bins.add(particles_[static_cast<std::size_t>(at - sums.begin())].pose)) continue;
    needed = std::max(least, kld_sample_size(bins.count(), settings_.kld_error, settings_.kld_z));
  }
  return count;
}

void MonteCarloLocalizer::resample(const ScanPoints& scan) {
  const std::size_t count = adapted_size();
  const auto resets =
      static_cast<std::size_t>(std::floor(reset_share_ * static_cast<double>(count)));
  next_.clear();
  if (resets < count) resample_low_variance(particles_, count - resets, random_, next_);
  if (resets > 0) draw_from_scan(scan, resets, next_);
  for (Particle& particle : next_) particle.weight = 1.0 / static_cast<double>(count);
  particles_.swap(next_);
}

void MonteCarloLocalizer::update(const ScanPoints& scan) {
  SIM_ASSERT(!particles_.empty());
  if (moved_ != Pose{}) {
    const OdometryMotion motion(moved_, settings_.motion);
    for (Particle& particle : particles_) particle.pose = particle.pose * motion.sample(random_);
  }
  moved_ = {};
  is_new_ = false;
  ++updates_;
  reset_share_ = 0.0;
  if (scan.p_BQ.empty()) {
    hypotheses_ = pose_hypotheses(particles_, kMostHypotheses);
    return;
  }
  if (is_spread_) {
    next_.clear();
    draw_from_scan(scan, particles_.size(), next_);
    particles_.swap(next_);
    is_spread_ = false;
  }
  const double mean = weigh(scan);
  hypotheses_ = pose_hypotheses(particles_, kMostHypotheses);
  slow_ = slow_ == 0.0 ? mean : slow_ + settings_.alpha_slow * (mean - slow_);
  fast_ = fast_ == 0.0 ? mean : fast_ + settings_.alpha_fast * (mean - fast_);
  if (settings_.alpha_fast > 0.0) reset_share_ = std::max(0.0, 1.0 - fast_ / slow_);
  resample(scan);
}

std::vector<PoseHypothesis> MonteCarloLocalizer::hypotheses() const {
  std::vector<PoseHypothesis> now;
  now.reserve(hypotheses_.size());
  for (const PoseHypothesis& hypothesis : hypotheses_) {
    now.push_back(moved(hypothesis, moved_));
  }
  return now;
}

std::vector<Particle> MonteCarloLocalizer::particles() const {
  std::vector<Particle> now = particles_;
  if (moved_ == Pose{}) return now;
  for (Particle& particle : now) particle.pose = particle.pose * moved_;
  return now;
}

void MonteCarloLocalizer::archive(StateArchive& archive) {
  archive(random_, moved_, is_new_, is_spread_, slow_, fast_, reset_share_, updates_);
  archive.list(particles_,
               [&archive](Particle& particle) { archive(particle.pose, particle.weight); });
  archive.expect(particles_.size() <= static_cast<std::size_t>(settings_.max_samples),
                 "no more particles than the settings allow");
  archive.list(hypotheses_, [&archive](PoseHypothesis& hypothesis) {
    archive(hypothesis.mean, hypothesis.covariance.variance, hypothesis.covariance.covariance,
            hypothesis.weight);
  });
  archive.expect(hypotheses_.size() <= kMostHypotheses, "at most 10 hypotheses");
}

}  // namespace sim
