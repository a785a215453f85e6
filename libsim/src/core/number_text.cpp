// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/number_text.h"

#include <array>
#include <charconv>

#include "sim/core/assert.h"

namespace sim {
namespace {

template <typename... Arguments>
std::string text_of(Arguments... arguments) {
  std::array<char, 400> text{};  // the largest double has 309 digits before the point
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), arguments...);
  SIM_ASSERT(error == std::errc());
  return {text.data(), end};
}

}  // namespace

std::string shortest_text(double value) { return text_of(value); }
std::string shortest_text(float value) { return text_of(value); }

std::string fixed_text(double value, int decimals) {
  return text_of(value, std::chars_format::fixed, decimals);
}

std::string rounded_text(double value, int digits) {
  return text_of(value, std::chars_format::general, digits);
}

std::string hexadecimal_text(std::uint64_t value, int digits) {
  SIM_ASSERT(digits >= 0 && digits <= 16);
  std::string text(static_cast<std::size_t>(digits), '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4U) {
    *digit = "0123456789abcdef"[value & 15U];
  }
  return text;
}

}  // namespace sim
