// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_localization/template, implemented as the comments there describe.

// function: void CRobot::moveParticles(
void CRobot::moveParticles(double ahead, double left, double turned) {
  const double length = std::hypot(ahead, left);
  std::normal_distribution<double> along(0.0, 0.002 + 0.1 * length);
  std::normal_distribution<double> aside(0.0, 0.001 + 0.05 * length);
  std::normal_distribution<double> turn(0.0, 0.01 + 0.1 * std::fabs(turned) + 0.2 * length);
  for (Particle& particle : particles) {
    const double c = std::cos(particle.yaw);
    const double s = std::sin(particle.yaw);
    const double a = ahead + along(random);
    const double l = left + aside(random);
    particle.x += c * a - s * l;
    particle.y += s * a + c * l;
    particle.yaw += turned + turn(random);
  }
}

// function: void CRobot::weighParticles(
void CRobot::weighParticles() {
  for (Particle& particle : particles) {
    const double c = std::cos(particle.yaw);
    const double s = std::sin(particle.yaw);
    double sum = 0.0;
    for (const End& end : ends) {
      const double d = std::min(0.15, distanceToWall(particle.x + c * end.ahead - s * end.left,
                                                     particle.y + s * end.ahead + c * end.left));
      sum -= d * d / (2.0 * 0.06 * 0.06);
    }
    particle.weight = std::exp(0.2 * sum);
    if (distanceToWall(particle.x, particle.y) < 0.07) particle.weight *= 1e-6;
  }
}

// function: void CRobot::resample(
void CRobot::resample() {
  std::vector<double> weights;
  for (const Particle& particle : particles) weights.push_back(particle.weight);
  std::discrete_distribution<std::size_t> draw(weights.begin(), weights.end());
  std::vector<Particle> drawn;
  const std::size_t count = settled ? 2000 : particles.size();
  while (drawn.size() < count) drawn.push_back(particles[draw(random)]);
  particles.swap(drawn);
}
