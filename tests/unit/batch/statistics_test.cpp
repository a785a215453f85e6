// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/core/random_stream.h"

namespace playpen::batch {
namespace {

// The squares of the deviations from the mean 5 are 9, 1, 1, 1, 0, 0, 4, 16.
TEST(Summary, KnownValues_MeanDeviationMedianAndExtremes) {
  const Summary summary = summary_of({7, 4, 2, 4, 9, 5, 4, 5}, "path");
  EXPECT_EQ(summary.count, 8U);
  EXPECT_DOUBLE_EQ(summary.mean, 5.0);
  EXPECT_DOUBLE_EQ(summary.deviation, std::sqrt(32.0 / 7.0));
  EXPECT_DOUBLE_EQ(summary.least, 2.0);
  EXPECT_DOUBLE_EQ(summary.median, 4.5);
  EXPECT_DOUBLE_EQ(summary.most, 9.0);
  EXPECT_DOUBLE_EQ(summary_of({3, -1, 2}, "path").median, 2.0);
}

TEST(Summary, EqualValues_IntervalIsTheValue) {
  for (const std::size_t count : {1U, 2U, 3U, 7U}) {
    const Summary summary = summary_of(std::vector<double>(count, 0.1), "time");
    EXPECT_EQ(summary, (Summary{count, 0.1, 0.0, 0.1, 0.1, 0.1, {0.1, 0.1}}));
  }
}

// The expected numbers come from another program: the Mersenne twister of the C++ standard, whose
// 10000th number was checked, and the definition of the percentile interval, in Python.
TEST(Summary, Interval_IsThatOfAnotherImplementation) {
  const Interval tens = summary_of({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, "path").interval;
  EXPECT_DOUBLE_EQ(tens.low, 3.7);
  EXPECT_DOUBLE_EQ(tens.high, 7.3);
  const Interval eights = summary_of({3, 1.5, 4, 1, 5.25, 9, 2, 6}, "cave: time").interval;
  EXPECT_DOUBLE_EQ(eights.low, 2.28125);
  EXPECT_DOUBLE_EQ(eights.high, 5.78125);
}

// The mean of many values is nearly normal. The bounds of 2000 resamples have a standard error of
// sqrt(0.025 * 0.975 / 2000) / 0.0584 = 0.06 deviations of the mean, 0.0584 being the normal
// density at 1.96; allowed are 4 of them.
TEST(Summary, IntervalOfManyValues_IsNearlyNormal) {
  sim::RandomStream random(3, "values");
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back(20.0 + 4.0 * random.normal());
  const Summary summary = summary_of(values, "time");
  const double error = summary.deviation / std::sqrt(200.0);
  EXPECT_NEAR(summary.interval.low, summary.mean - 1.96 * error, 0.24 * error);
  EXPECT_NEAR(summary.interval.high, summary.mean + 1.96 * error, 0.24 * error);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(summary_of(values, "time"), summary);
  std::rotate(values.begin(), values.begin() + 77, values.end());
  EXPECT_EQ(summary_of(values, "time"), summary);
  EXPECT_NE(summary_of(values, "path"), summary);
}

// The roots p of (p - k / n)^2 = z^2 p (1 - p) / n, solved in Python.
TEST(WilsonInterval, KnownTrials_RootsOfTheScoreEquation) {
  struct Case {
    std::size_t successes;
    std::size_t trials;
    Interval interval;
  };
  for (const Case& known :
       {Case{8, 10, {0.4901624715366418, 0.9433178485456247}},
        Case{50, 100, {0.4038315303659957, 0.5961684696340043}},
        Case{1, 1'000'000, {1.765245767453717e-07, 5.664911804311443e-06}},
        Case{0, 10, {0.0, 0.2775327998628892}}, Case{10, 10, {0.7224672001371114, 1.0}}}) {
    const Interval interval = wilson_interval(known.successes, known.trials);
    EXPECT_NEAR(interval.low, known.interval.low, 1e-14);
    EXPECT_NEAR(interval.high, known.interval.high, 1e-14);
  }
}

TEST(WilsonInterval, Ends_AreExact) {
  EXPECT_EQ(wilson_interval(0, 0), (Interval{0.0, 1.0}));
  for (std::size_t trials = 1; trials < 200; ++trials) {
    EXPECT_EQ(wilson_interval(0, trials).low, 0.0);
    EXPECT_EQ(wilson_interval(trials, trials).high, 1.0);
    EXPECT_GT(wilson_interval(trials, trials).low, 0.0);
    EXPECT_LT(wilson_interval(0, trials).high, 1.0);
  }
}

}  // namespace
}  // namespace playpen::batch
