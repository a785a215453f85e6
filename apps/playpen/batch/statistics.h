// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

/// The implementation of `playpen batch`: many runs, their statistics and charts.
namespace playpen::batch {

/// A closed interval of numbers, in the unit of the values that it describes.
struct Interval {
  double low = 0.0;
  double high = 0.0;  ///< >= low

  friend bool operator==(const Interval&, const Interval&) = default;
};

/// What is known about a sample of values. All but the count are in the unit of the values.
struct Summary {
  std::size_t count = 0;
  double mean = 0.0;
  double deviation = 0.0;  ///< sample standard deviation, divisor count - 1; 0 for one value
  double least = 0.0;
  double median = 0.0;  ///< of an even number of values: the mean of the two in the middle
  double most = 0.0;
  Interval interval;  ///< 95 % confidence interval of the mean

  friend bool operator==(const Summary&, const Summary&) = default;
};

/// Summarises a sample.
///
/// The interval is the bootstrap percentile interval of B. Efron and R. J. Tibshirani, An
/// Introduction to the Bootstrap (1993), sec. 13.3: the 50th and the 1950th of the sorted means of
/// 2000 resamples, each with as many values as the sample, drawn with replacement. It makes no
/// assumption about the distribution, but it is too narrow for samples of a few values. If all
/// values are equal, it is this value.
///
/// The random numbers depend on the name alone, and only IEEE operations are used. So equal values
/// in any order and an equal name give an equal result on every machine.
///
/// @param values  any order.
/// @param name    selects the random numbers, e.g. the names of the group and of the quantity.
/// @pre values is not empty, and every value and the difference of any two are finite.
/// @note O(2000 n), about 10 ms for 1000 values. Safe from many threads.
[[nodiscard]] Summary summary_of(std::vector<double> values, std::string_view name);

/// 95 % confidence interval of a probability, from independent trials.
///
/// Model: the score interval of E. B. Wilson, "Probable inference, the law of succession, and
/// statistical inference", Journal of the American Statistical Association 22(158), 1927, without
/// continuity correction.
///
/// @return within [0, 1]; low is exactly 0 without a success, high exactly 1 without a failure.
///     Without trials: 0 to 1.
/// @pre successes <= trials
[[nodiscard]] Interval wilson_interval(std::size_t successes, std::size_t trials);

}  // namespace playpen::batch
