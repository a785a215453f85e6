// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "playerlike/messages/requests.h"
#include "session/player_values/poses.h"
#include "session/range_settings.h"
#include "sim/core/pose.h"
#include "sim/devices/device.h"
#include "sim/devices/localization.h"
#include "sim/navigation/particles.h"

/// @file
/// Player's interface localize.
namespace playerlike {

/// The one hypothesis of a localisation: the measured pose, with the variances of its noise.
template <typename Hypothesis>
[[nodiscard]] Hypothesis hypothesis_of(const sim::PoseReading& reading,
                                       const DeviceSettings& settings) {
  const double noise_m = setting_of(settings, "noise");
  const double noise_yaw_rad = setting_of(settings, "noise_yaw");
  Hypothesis hypothesis = {};
  hypothesis.mean = to_players<decltype(hypothesis.mean)>(reading.pose);
  hypothesis.cov[0] = noise_m * noise_m;
  hypothesis.cov[1] = noise_m * noise_m;
  hypothesis.cov[2] = noise_yaw_rad * noise_yaw_rad;
  hypothesis.alpha = 1.0;
  return hypothesis;
}
template <typename Hypothesis>
[[nodiscard]] Hypothesis hypothesis_of(const sim::PoseHypothesis& of) {
  Hypothesis hypothesis = {};
  hypothesis.mean = to_players<decltype(hypothesis.mean)>(of.mean);
  for (std::size_t i = 0; i < 3; ++i) {
    hypothesis.cov[i] = of.covariance.variance[i];
    hypothesis.cov[i + 3] = of.covariance.covariance[i];
  }
  hypothesis.alpha = of.weight;
  return hypothesis;
}

/// The command for a pose and Player's covariance: xx, yy, yaw yaw, xy, y yaw, x yaw.
[[nodiscard]] inline sim::SetPoseCommand set_pose_command(const sim::Pose& pose,
                                                          const std::array<double, 6>& cov) {
  return {pose, {{cov[0], cov[1], cov[2]}}, {{cov[3], cov[4], cov[5]}}};
}

/// Mean of particles, and the mean of the variances of x and y: what Player's GET_PARTICLES tells
/// besides the particles. 0 without particles.
struct ParticleMoments {
  sim::Pose mean;
  double variance_m2 = 0.0;
};
[[nodiscard]] ParticleMoments moments_of(const std::vector<LocalizationParticle>& particles);

}  // namespace playerlike
