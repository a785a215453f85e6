// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sim {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

double remainder_of(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kHalfTurn);
  return wrapped == -kHalfTurn ? kHalfTurn : wrapped;
}

TEST(NormalizeAngle, NearMultiplesOfHalfTurn_SameAsRemainder) {
  for (int half_turns = -13; half_turns <= 13; ++half_turns) {
    double below = kHalfTurn * half_turns;
    double above = below;
    for (int i = 0; i < 100; ++i) {
      ASSERT_EQ(normalize_angle(below), remainder_of(below)) << half_turns << " below, " << i;
      ASSERT_EQ(normalize_angle(above), remainder_of(above)) << half_turns << " above, " << i;
      below = std::nextafter(below, -100.0);
      above = std::nextafter(above, 100.0);
    }
  }
}

TEST(NormalizeAngle, AnyAngle_SameAsRemainder) {
  for (int i = -40'000; i <= 40'000; ++i) {
    const double angle_rad = 1e-3 * i + 1e-9 * i * i;  // -38.4..41.6
    ASSERT_EQ(normalize_angle(angle_rad), remainder_of(angle_rad)) << angle_rad;
  }
}

}  // namespace
}  // namespace sim
