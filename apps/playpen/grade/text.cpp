// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/text.h"

#include "sim/core/number_text.h"

namespace playpen::grade {

std::string telling_number(double value, double limit, int decimals) {
  constexpr int kMostDecimals = 9;
  while (decimals < kMostDecimals && value != limit &&
         sim::fixed_text(value, decimals) == sim::fixed_text(limit, decimals)) {
    ++decimals;
  }
  return sim::fixed_text(value, decimals);
}

}  // namespace playpen::grade
