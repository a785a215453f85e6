// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/navigation/particles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include "sim/core/assert.h"
#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace sim {
namespace {

/// A bin's coordinates in one number: 21 bits for x, 21 for y, 8 for the yaw; never 0.
constexpr std::int64_t kBinOffset = 1 << 20;
constexpr int kYawBits = 8;
constexpr int kPositionBits = 21;

struct Bin {
  std::int64_t x;
  std::int64_t y;
  int yaw;  // 0 .. kPoseBinsPerTurn - 1
};

/// A number as an integer in a range; NaN becomes the least.
std::int64_t clamped_integer(double number, std::int64_t least, std::int64_t greatest) {
  // Outside of the range, the conversion would be undefined.
  if (!(number >= static_cast<double>(least))) return least;
  if (number >= static_cast<double>(greatest)) return greatest;
  return static_cast<std::int64_t>(number);
}

std::int64_t position_bin(double position_m) {
  return clamped_integer(std::floor(position_m / kPoseBin_m), 1 - kBinOffset, kBinOffset - 2) +
         kBinOffset;
}

Bin bin_of(const Pose& pose) {
  const double turn = normalize_angle(pose.yaw_rad) / (2.0 * std::numbers::pi) + 0.5;
  const std::int64_t yaw = clamped_integer(turn * kPoseBinsPerTurn, 0, kPoseBinsPerTurn - 1);
  return {position_bin(pose.x_m), position_bin(pose.y_m), static_cast<int>(yaw)};
}

std::uint64_t key_of(const Bin& bin) {
  return (static_cast<std::uint64_t>(bin.x) << (kPositionBits + kYawBits)) |
         (static_cast<std::uint64_t>(bin.y) << kYawBits) | static_cast<std::uint64_t>(bin.yaw);
}

/// The particles of a bin are those at places [first, last) of a sorted list.
struct BinOfParticles {
  std::uint64_t key;
  Bin bin;
  std::size_t first;
  std::size_t last;
  std::size_t cluster;
};

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

void flood(std::vector<BinOfParticles>& bins, std::size_t start, std::size_t cluster) {
  std::vector<std::size_t> open{start};
  bins[start].cluster = cluster;
  while (!open.empty()) {
    const Bin middle = bins[open.back()].bin;
    open.pop_back();
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dyaw = -1; dyaw <= 1; ++dyaw) {
          const Bin next{middle.x + dx, middle.y + dy,
                         (middle.yaw + dyaw + kPoseBinsPerTurn) % kPoseBinsPerTurn};
          const std::uint64_t key = key_of(next);
          const auto at = std::lower_bound(
              bins.begin(), bins.end(), key,
              [](const BinOfParticles& bin, std::uint64_t other) { return bin.key < other; });
          if (at == bins.end() || at->key != key || at->cluster != kNone) continue;
          at->cluster = cluster;
          open.push_back(static_cast<std::size_t>(at - bins.begin()));
        }
      }
    }
  }
}

/// Weighted sums over the particles of a cluster.
struct Sums {
  std::size_t first = kNone;  // its first particle
  double weight = 0.0;
  Vec2 position = Vec2::Zero();
  Vec2 direction = Vec2::Zero();
  Pose mean;
  PoseCovariance covariance;
};

double wrapped_difference(double a_rad, double b_rad) { return normalize_angle(a_rad - b_rad); }

}  // namespace

bool is_valid(const PoseCovariance& c) {
  const auto [xx, yy, aa] = c.variance;
  const auto [xy, ya, xa] = c.covariance;
  for (const double number : {xx, yy, aa, xy, ya, xa}) {
    if (!std::isfinite(number)) return false;
  }
  if (xx < 0.0 || yy < 0.0 || aa < 0.0) return false;
  constexpr double kRounding = 1e-9;
  const auto minor_is_valid = [](double a, double b, double ab) {
    return a * b - ab * ab >= -kRounding * a * b;
  };
  const double determinant =
      xx * (yy * aa - ya * ya) - xy * (xy * aa - ya * xa) + xa * (xy * ya - yy * xa);
  return minor_is_valid(xx, yy, xy) && minor_is_valid(yy, aa, ya) && minor_is_valid(xx, aa, xa) &&
         determinant >= -kRounding * xx * yy * aa;
}

Pose sample_pose(const Pose& mean, const PoseCovariance& c, RandomStream& random) {
  // Cholesky factor L of the covariance; a zero on its diagonal means that the rest of its column
  // is zero.
  const auto [xx, yy, aa] = c.variance;
  const auto [xy, ya, xa] = c.covariance;
  const auto over = [](double numerator, double denominator) {
    return denominator > 0.0 ? numerator / denominator : 0.0;
  };
  const double l00 = std::sqrt(std::max(0.0, xx));
  const double l10 = over(xy, l00);
  const double l11 = std::sqrt(std::max(0.0, yy - l10 * l10));
  const double l20 = over(xa, l00);
  const double l21 = over(ya - l20 * l10, l11);
  const double l22 = std::sqrt(std::max(0.0, aa - l20 * l20 - l21 * l21));
  const double u = random.normal();
  const double v = random.normal();
  const double w = random.normal();
  return {mean.x_m + l00 * u, mean.y_m + l10 * u + l11 * v,
          normalize_angle(mean.yaw_rad + l20 * u + l21 * v + l22 * w)};
}

PoseHypothesis moved(const PoseHypothesis& hypothesis, const Pose& X_AB) {
  if (X_AB == Pose{}) return hypothesis;
  PoseHypothesis result = hypothesis;
  result.mean = hypothesis.mean * X_AB;
  // x' = x + dx(yaw), y' = y + dy(yaw): the yaw's error moves the position.
  const double gx = -(result.mean.y_m - hypothesis.mean.y_m);
  const double gy = result.mean.x_m - hypothesis.mean.x_m;
  const auto [xx, yy, aa] = hypothesis.covariance.variance;
  const auto [xy, ya, xa] = hypothesis.covariance.covariance;
  result.covariance.variance = {xx + 2.0 * gx * xa + gx * gx * aa,
                                yy + 2.0 * gy * ya + gy * gy * aa, aa};
  result.covariance.covariance = {xy + gy * xa + gx * ya + gx * gy * aa, ya + gy * aa,
                                  xa + gx * aa};
  return result;
}

PoseBins::PoseBins() : keys_(256, 0) {}

bool PoseBins::add(const Pose& pose) {
  const std::uint64_t key = key_of(bin_of(pose));
  // Fibonacci hashing (D. Knuth, The Art of Computer Programming 3, section 6.4).
  std::size_t at =
      static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20) & (keys_.size() - 1);
  while (keys_[at] != 0) {
    if (keys_[at] == key) return false;
    at = (at + 1) & (keys_.size() - 1);
  }
  keys_[at] = key;
  ++count_;
  if (2 * count_ > keys_.size()) grow();
  return true;
}

void PoseBins::grow() {
  std::vector<std::uint64_t> before(2 * keys_.size(), 0);
  before.swap(keys_);
  for (const std::uint64_t key : before) {
    if (key == 0) continue;
    std::size_t at =
        static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20) & (keys_.size() - 1);
    while (keys_[at] != 0) at = (at + 1) & (keys_.size() - 1);
    keys_[at] = key;
  }
}

double kld_sample_size(std::size_t bins, double error, double z) {
  SIM_ASSERT(error > 0.0 && z >= 0.0);
  if (bins <= 1) return 1.0;
  const double k = static_cast<double>(bins - 1);
  const double share = 2.0 / (9.0 * k);
  const double root = 1.0 - share + std::sqrt(share) * z;
  return std::max(1.0, k / (2.0 * error) * root * root * root);
}

std::vector<PoseHypothesis> pose_hypotheses(std::span<const Particle> particles, std::size_t most) {
  std::vector<std::uint64_t> keys;
  keys.reserve(particles.size());
  for (const Particle& particle : particles) keys.push_back(key_of(bin_of(particle.pose)));
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&keys](std::size_t a, std::size_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  std::vector<BinOfParticles> bins;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint64_t key = keys[order[i]];
    if (bins.empty() || bins.back().key != key) {
      bins.push_back({key, bin_of(particles[order[i]].pose), i, i, kNone});
    }
    bins.back().last = i + 1;
  }
  std::vector<Sums> clusters;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (bins[b].cluster == kNone) {
      flood(bins, b, clusters.size());
      clusters.emplace_back();
    }
  }
  // Visits each particle with its cluster, in an order that depends on the particles only.
  const auto for_each = [&](auto visit) {
    for (const BinOfParticles& bin : bins) {
      for (std::size_t i = bin.first; i < bin.last; ++i) {
        visit(clusters[bin.cluster], order[i], particles[order[i]]);
      }
    }
  };
  for_each([](Sums& sums, std::size_t index, const Particle& particle) {
    sums.first = std::min(sums.first, index);
    sums.weight += particle.weight;
    sums.position += particle.weight * particle.pose.position();
    sums.direction += particle.weight * unit_vector(particle.pose.yaw_rad);
  });
  for (Sums& sums : clusters) {
    if (!(sums.weight > 0.0)) continue;
    const Vec2 mean = sums.position / sums.weight;
    sums.mean = {mean.x(), mean.y(), math::atan2(sums.direction.y(), sums.direction.x())};
  }
  for_each([](Sums& sums, std::size_t /*index*/, const Particle& particle) {
    if (!(sums.weight > 0.0)) return;
    const double share = particle.weight / sums.weight;
    const double dx = particle.pose.x_m - sums.mean.x_m;
    const double dy = particle.pose.y_m - sums.mean.y_m;
    const double da = wrapped_difference(particle.pose.yaw_rad, sums.mean.yaw_rad);
    auto& [xx, yy, aa] = sums.covariance.variance;
    auto& [xy, ya, xa] = sums.covariance.covariance;
    xx += share * dx * dx;
    yy += share * dy * dy;
    aa += share * da * da;
    xy += share * dx * dy;
    ya += share * dy * da;
    xa += share * dx * da;
  });
  std::erase_if(clusters, [](const Sums& sums) { return !(sums.weight > 0.0); });
  std::sort(clusters.begin(), clusters.end(), [](const Sums& a, const Sums& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.first < b.first;
  });
  if (clusters.size() > most) clusters.resize(most);
  std::vector<PoseHypothesis> hypotheses;
  for (const Sums& sums : clusters) {
    hypotheses.push_back({sums.mean, sums.covariance, std::min(1.0, sums.weight)});
  }
  return hypotheses;
}

void resample_low_variance(std::span<const Particle> particles, std::size_t count,
                           RandomStream& random, std::vector<Particle>& into) {
  SIM_ASSERT(!particles.empty() && count >= 1);
  const double step = 1.0 / static_cast<double>(count);
  double pointer = step * random.uniform();
  double sum = particles[0].weight;
  std::size_t at = 0;
  into.reserve(into.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    while (sum < pointer && at + 1 < particles.size()) sum += particles[++at].weight;
    into.push_back({particles[at].pose, step});
    pointer += step;
  }
}

}  // namespace sim
