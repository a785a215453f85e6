// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sim {
namespace {

TEST(RandomStream, SameSeedAndPath_SameNumbers) {
  RandomStream a(1, "r1/laser");
  RandomStream b(1, "r1/laser");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.normal(), b.normal());
}

TEST(RandomStream, OtherSeedOrPath_OtherNumbers) {
  EXPECT_NE(RandomStream(1, "r1/laser").uniform(), RandomStream(2, "r1/laser").uniform());
  EXPECT_NE(RandomStream(1, "r1/laser").uniform(), RandomStream(1, "r1/pose").uniform());
}

TEST(RandomStream, Normal_HasMeanDeviationAndShapeOfGaussian) {
  // n = 200 000. The standard error of the mean is 1/sqrt(n), of the variance sqrt(2/n), and of the
  // share within one sigma (p = 0.682689) sqrt(p (1 - p) / n). The bounds are four standard errors.
  constexpr int kCount = 200'000;
  RandomStream stream(5, "noise");
  double sum = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  int within = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = stream.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    if (std::abs(x) < 1.0) ++within;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 4.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourths / kCount, 3.0, 4.0 * std::sqrt(96.0 / kCount));  // Var(x^4) = 105 - 9
  EXPECT_NEAR(within / static_cast<double>(kCount), 0.682689,
              4.0 * std::sqrt(0.682689 * 0.317311 / kCount));
}

TEST(RandomStream, ZeroDeviation_DrawsNothing) {
  RandomStream stream(1, "x");
  EXPECT_EQ(stream.gaussian(0.0), 0.0);
  EXPECT_EQ(stream.draws(), 0U);
}

TEST(MersenneTwister, MatchesStandard) {
  for (const std::uint64_t seed : {0ULL, 5489ULL, 0xfedcba9876543210ULL}) {
    MersenneTwister ours(seed);
    std::mt19937_64 theirs(seed);
    for (int i = 0; i < 2000; ++i) ASSERT_EQ(ours(), theirs()) << i;
  }
}

}  // namespace
}  // namespace sim
