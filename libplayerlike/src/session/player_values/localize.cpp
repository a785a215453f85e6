// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/player_values/localize.h"

#include <algorithm>
#include <cmath>

#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace playerlike {

ParticleMoments moments_of(const std::vector<LocalizationParticle>& particles) {
  double weight = 0.0;
  sim::Vec2 position = sim::Vec2::Zero();
  sim::Vec2 direction = sim::Vec2::Zero();
  double squares = 0.0;
  for (const LocalizationParticle& particle : particles) {
    weight += particle.weight;
    position += particle.weight * particle.pose.position();
    squares += particle.weight * particle.pose.position().squaredNorm();
    direction += particle.weight * sim::unit_vector(particle.pose.yaw_rad);
  }
  if (!(weight > 0.0)) return {};
  position /= weight;
  return {{position.x(), position.y(), sim::math::atan2(direction.y(), direction.x())},
          std::max(0.0, 0.5 * (squares / weight - position.squaredNorm()))};
}

}  // namespace playerlike
