// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/text.h"

#include <array>
#include <charconv>

namespace playpen::grade {

std::string fixed(double value, int decimals) {
  std::array<char, 400> buffer{};  // the greatest double has 309 digits
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  return {buffer.data(), end.ptr};
}

std::string short_number(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

std::string telling_number(double value, double limit, int decimals) {
  constexpr int kMostDecimals = 9;
  while (decimals < kMostDecimals && value != limit &&
         fixed(value, decimals) == fixed(limit, decimals)) {
    ++decimals;
  }
  return fixed(value, decimals);
}

}  // namespace playpen::grade
