// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "localizer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "frames.h"
#include "par_common/distance.h"

const char* const LOCALIZER_NAME = "particle filter";

namespace {

const std::size_t MOST_PARTICLES = 20000;  // at the start, when the robot may be anywhere
const std::size_t LEAST_PARTICLES = 1000;
// The number of particles follows the room that they take: so many for each bin of 0.1 m, 0.1 m and
// 10 degrees with a particle in it. (KLD-sampling derives such a number from a bound of the error:
// D. Fox, "Adapting the sample size in particle filters through KLD-sampling", IJRR 22(12), 2003.)
const std::size_t PARTICLES_PER_BIN = 40;

const double MOVED = 0.04;   // a scan is used after so much motion [m] ...
const double TURNED = 0.08;  // ... or such a turn [rad]
const unsigned BEAMS = 40;   // beams of a scan that are used

// The likelihood of a beam whose end is at distance d of the nearest wall: a Gaussian, and a part
// that is the same everywhere, for what is not on the map (S. Thrun, W. Burgard, D. Fox,
// "Probabilistic Robotics", 2005, table 6.3).
const double SIGMA = 0.06;  // [m]
const double RANDOM_PART = 0.1;
// Neighbouring beams tell much the same. The exponent keeps the filter from being too sure.
const double EXPONENT = 0.2;

struct Particle {
  par::Pose pose;
  double weight;
};

class ParticleFilter final : public Localizer {
 public:
  ParticleFilter(const par::Mask& walls, const CCMorse::Position2dProxy& odometry,
                 CCMorse::LaserProxy& laser)
      : walls_(walls),
        wallsAt_(par::distance_to_blocked_m(walls)),
        fit_(walls.frame()),
        odometry_(odometry),
        laser_(laser),
        lastOdometry_(odometryNow()) {
    for (std::size_t i = 0; i < fit_.values().size(); i++) {
      const double d = wallsAt_.values()[i];
      fit_.values()[i] =
          std::log((1.0 - RANDOM_PART) * std::exp(-0.5 * d * d / (SIGMA * SIGMA)) + RANDOM_PART);
    }
    forget();
  }

  void update() override {
    const par::Pose now = odometryNow();
    const par::Pose step = seenFrom(lastOdometry_, now);
    if (std::hypot(step.x, step.y) < MOVED && std::fabs(step.yaw) < TURNED) return;
    lastOdometry_ = now;
    move(step);
    weigh();
    resample();
    estimate_ = meanAndSpread();
  }

  Estimate estimate() const override {
    // The robot has moved on since the last scan that was used.
    Estimate now = estimate_;
    now.pose = then(estimate_.pose, seenFrom(lastOdometry_, odometryNow()));
    return now;
  }

  std::vector<par::Pose> particles() const override {
    std::vector<par::Pose> poses;
    poses.reserve(particles_.size());
    for (const Particle& particle : particles_) poses.push_back(particle.pose);
    return poses;
  }

  void forget() override {
    // Anywhere on the free cells, with any heading.
    std::vector<par::Cell> free;
    const par::GridFrame& frame = walls_.frame();
    for (std::size_t i = 0; i < frame.size(); i++) {
      if (wallsAt_.values()[i] > 0.09) free.push_back(frame.cell_at(i));
    }
    particles_.clear();
    if (free.empty()) free.push_back(par::Cell());
    std::uniform_int_distribution<std::size_t> cell(0, free.size() - 1);
    std::uniform_real_distribution<double> yaw(-par::kPi, par::kPi);
    while (particles_.size() < MOST_PARTICLES) {
      const par::Point place = frame.centre_of(free[cell(random_)]);
      particles_.push_back({{place.x, place.y, yaw(random_)}, 1.0});
    }
    estimate_ = meanAndSpread();
  }

 private:
  par::Pose odometryNow() const {
    return {odometry_.GetXPos(), odometry_.GetYPos(), odometry_.GetYaw()};
  }

  // Moves each particle by the step that odometry measured, with an error of its own.
  void move(const par::Pose& step) {
    const double length = std::hypot(step.x, step.y);
    std::normal_distribution<double> along(0.0, 0.002 + 0.1 * length);
    std::normal_distribution<double> aside(0.0, 0.001 + 0.05 * length);
    std::normal_distribution<double> turn(0.0, 0.01 + 0.1 * std::fabs(step.yaw) + 0.2 * length);
    for (Particle& particle : particles_) {
      particle.pose = then(particle.pose, {step.x + along(random_), step.y + aside(random_),
                                           step.yaw + turn(random_)});
    }
  }

  // Multiplies each weight by the likelihood of the scan at the particle's pose.
  void weigh() {
    const player_pose3d_t mount = laser_.GetPose();
    const unsigned count = laser_.GetCount();
    const unsigned stride = std::max(1U, count / BEAMS);
    std::vector<par::Point> ends;  // seen from the robot
    for (unsigned i = stride / 2; i < count; i += stride) {
      const double range = laser_.GetRange(i);
      if (range >= laser_.GetMaxRange() - 1e-6) continue;
      const double bearing = mount.pyaw + laser_.GetBearing(i);
      ends.push_back({mount.px + range * std::cos(bearing), mount.py + range * std::sin(bearing)});
    }
    for (Particle& particle : particles_) {
      const double c = std::cos(particle.pose.yaw);
      const double s = std::sin(particle.pose.yaw);
      double sum = 0.0;
      for (const par::Point& end : ends) {
        const par::Point place = {particle.pose.x + c * end.x - s * end.y,
                                  particle.pose.y + s * end.x + c * end.y};
        sum += fit_.value_or(walls_.frame().cell_of(place), std::log(RANDOM_PART));
      }
      particle.weight = std::exp(EXPONENT * sum);
      // The robot's centre is not within a wall.
      const par::Cell cell = walls_.frame().cell_of({particle.pose.x, particle.pose.y});
      if (wallsAt_.value_or(cell, 0.0) < 0.07) particle.weight *= 1e-6;
    }
  }

  // Draws new particles by their weights, with one random number for all (the low variance sampler,
  // "Probabilistic Robotics", table 4.4).
  void resample() {
    double sum = 0.0;
    for (const Particle& particle : particles_) sum += particle.weight;
    const std::size_t count = wantedParticles();
    const double step = sum / static_cast<double>(count);
    double at = std::uniform_real_distribution<double>(0.0, step)(random_);
    std::vector<Particle> drawn;
    drawn.reserve(count);
    std::size_t i = 0;
    double reached = particles_[0].weight;
    for (std::size_t n = 0; n < count; n++, at += step) {
      while (reached < at && i + 1 < particles_.size()) reached += particles_[++i].weight;
      drawn.push_back({particles_[i].pose, 1.0});
    }
    particles_ = std::move(drawn);
  }

  std::size_t wantedParticles() const {
    double best = 0.0;
    for (const Particle& particle : particles_) best = std::max(best, particle.weight);
    std::set<std::tuple<int, int, int>> bins;
    for (const Particle& particle : particles_) {
      if (particle.weight < 0.01 * best) continue;
      bins.insert(std::make_tuple(static_cast<int>(std::floor(particle.pose.x / 0.1)),
                                  static_cast<int>(std::floor(particle.pose.y / 0.1)),
                                  static_cast<int>(std::floor(particle.pose.yaw / 0.1745))));
    }
    return std::min(MOST_PARTICLES, std::max(LEAST_PARTICLES, PARTICLES_PER_BIN * bins.size()));
  }

  Estimate meanAndSpread() const {
    const double count = static_cast<double>(particles_.size());
    double x = 0.0;
    double y = 0.0;
    double c = 0.0;
    double s = 0.0;
    for (const Particle& particle : particles_) {
      x += particle.pose.x / count;
      y += particle.pose.y / count;
      c += std::cos(particle.pose.yaw) / count;
      s += std::sin(particle.pose.yaw) / count;
    }
    double square = 0.0;
    for (const Particle& particle : particles_) {
      const double dx = particle.pose.x - x;
      const double dy = particle.pose.y - y;
      square += (dx * dx + dy * dy) / count;
    }
    Estimate result;
    result.pose = {x, y, std::atan2(s, c)};
    result.positionError = std::sqrt(square);
    // The circular standard deviation, from the length of the mean direction.
    const double length = std::min(1.0, std::max(1e-9, std::hypot(c, s)));
    result.headingError = std::sqrt(-2.0 * std::log(length));
    return result;
  }

  const par::Mask& walls_;
  const par::Grid<double> wallsAt_;  // distance of each cell to the nearest wall [m]
  par::Grid<double> fit_;            // logarithm of the likelihood of a beam that ends in a cell
  const CCMorse::Position2dProxy& odometry_;
  CCMorse::LaserProxy& laser_;
  std::mt19937 random_{1};  // a fixed seed: two runs are equal
  par::Pose lastOdometry_;  // at the last scan that was used
  std::vector<Particle> particles_;
  Estimate estimate_;  // at the last scan that was used
};

}  // namespace

std::unique_ptr<Localizer> makeLocalizer(CCMorse::PlayerClient& /*client*/, const par::Mask& walls,
                                         const CCMorse::Position2dProxy& odometry,
                                         CCMorse::LaserProxy& laser) {
  return std::unique_ptr<Localizer>(new ParticleFilter(walls, odometry, laser));
}
