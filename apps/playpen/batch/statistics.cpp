// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/core/assert.h"
#include "sim/core/random_stream.h"

namespace playpen::batch {
namespace {

// The mean as a difference to the least value: rounding cannot make it differ from equal values.
double mean_of(const std::vector<double>& sorted) {
  double sum = 0.0;
  for (const double value : sorted) sum += value - sorted.front();
  return sorted.front() + sum / static_cast<double>(sorted.size());
}

double deviation_of(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return 0.0;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double median_of(const std::vector<double>& sorted) {
  const std::size_t middle = sorted.size() / 2;
  if (sorted.size() % 2 == 1) return sorted[middle];
  return sorted[middle - 1] + 0.5 * (sorted[middle] - sorted[middle - 1]);
}

Interval bootstrap_interval(const std::vector<double>& sorted, std::string_view name) {
  constexpr std::size_t kResamples = 2000;
  constexpr std::size_t kBelow = kResamples / 40;  // 2.5 %
  if (sorted.front() == sorted.back()) return {sorted.front(), sorted.front()};
  constexpr std::uint64_t kSeed = 0;  // the name alone selects the stream
  sim::RandomStream random(kSeed, name);
  const auto count = static_cast<double>(sorted.size());
  std::vector<double> means;
  means.reserve(kResamples);
  for (std::size_t resample = 0; resample < kResamples; ++resample) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      // The product is less than the count: uniform() is at most 1 - 2^-53, and the rounding of
      // (1 - 2^-53) n does not reach n.
      sum += sorted[static_cast<std::size_t>(random.uniform() * count)] - sorted.front();
    }
    means.push_back(sorted.front() + sum / count);
  }
  std::sort(means.begin(), means.end());
  return {means[kBelow - 1], means[kResamples - kBelow - 1]};
}

}  // namespace

Summary summary_of(std::vector<double> values, std::string_view name) {
  SIM_ASSERT(!values.empty());
  SIM_ASSERT(std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
  std::sort(values.begin(), values.end());
  Summary summary;
  summary.count = values.size();
  summary.mean = mean_of(values);
  summary.deviation = deviation_of(values, summary.mean);
  summary.least = values.front();
  summary.median = median_of(values);
  summary.most = values.back();
  summary.interval = bootstrap_interval(values, name);
  return summary;
}

Interval wilson_interval(std::size_t successes, std::size_t trials) {
  SIM_ASSERT(successes <= trials);
  if (trials == 0) return {0.0, 1.0};
  constexpr double kDeviations = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  constexpr double kSquare = kDeviations * kDeviations;
  const auto n = static_cast<double>(trials);
  const auto k = static_cast<double>(successes);
  const double middle = (k + 0.5 * kSquare) / (n + kSquare);
  const double half = kDeviations / (n + kSquare) * std::sqrt(k * (n - k) / n + 0.25 * kSquare);
  return {successes == 0 ? 0.0 : std::max(middle - half, 0.0),
          successes == trials ? 1.0 : std::min(middle + half, 1.0)};
}

}  // namespace playpen::batch
