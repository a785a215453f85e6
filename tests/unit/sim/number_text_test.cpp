// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/number_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace sim {
namespace {

TEST(NumberText, RoundTrips) {
  EXPECT_EQ(shortest_text(0.98), "0.98");
  EXPECT_EQ(shortest_text(12.0), "12");
  EXPECT_EQ(shortest_text(0.1F), "0.1");
  EXPECT_EQ(shortest_text(static_cast<double>(0.1F)), "0.10000000149011612");
  EXPECT_EQ(shortest_text(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(NumberText, HasRequestedDigits) {
  EXPECT_EQ(fixed_text(2.0, 3), "2.000");
  EXPECT_EQ(fixed_text(-0.126, 2), "-0.13");
  EXPECT_EQ(fixed_text(7.6, 0), "8");
  // The longest text: a sign, 309 digits, the point, 60 digits.
  EXPECT_EQ(fixed_text(std::numeric_limits<double>::lowest(), 60).size(), 371U);
  EXPECT_EQ(rounded_text(1.0 / 3.0, 6), "0.333333");
  EXPECT_EQ(rounded_text(0.5, 6), "0.5");
}

}  // namespace
}  // namespace sim
