// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.h"

#include <cmath>
#include <iostream>

#include "sim/core/number_text.h"

namespace playpen {
namespace {

/// "5 s", "3 min", "2.5 h".
std::string rough_time(double seconds) {
  constexpr double kMinute_s = 60.0;
  constexpr double kHour_s = 3600.0;
  if (seconds < 2 * kMinute_s) return sim::fixed_text(std::ceil(seconds), 0) + " s";
  if (seconds < 2 * kHour_s) return sim::fixed_text(std::ceil(seconds / kMinute_s), 0) + " min";
  return sim::fixed_text(seconds / kHour_s, 1) + " h";
}

}  // namespace

void ProgressBar::begin(const std::string& name) {
  clear();
  name_ = name;
  start_ = Clock::now();
}

void ProgressBar::show(std::size_t ended, std::size_t all) const {
  if (!is_terminal_ || all == 0) return;
  constexpr std::size_t kBarWidth = 20;
  const std::size_t filled = kBarWidth * ended / all;
  std::string line = "\r\033[K" + name_ + " [" + std::string(filled, '#') +
                     std::string(kBarWidth - filled, ' ') + "] " + std::to_string(ended) + " of " +
                     std::to_string(all);
  if (ended > 0) {
    const std::chrono::duration<double> spent = Clock::now() - start_;
    const double each = spent.count() / static_cast<double>(ended);
    line += ", " + rough_time(each * static_cast<double>(all - ended)) + " left";
  }
  std::cerr << line << std::flush;
}

void ProgressBar::clear() const {
  if (is_terminal_) std::cerr << "\r\033[K" << std::flush;
}

}  // namespace playpen
