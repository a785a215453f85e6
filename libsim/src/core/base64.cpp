// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/base64.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sim {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> digit_values() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}

}  // namespace

std::string to_base64(std::span<const std::uint8_t> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  std::size_t out = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = unsigned{bytes[i]} << 16U;
    if (count > 1) group |= unsigned{bytes[i + 1]} << 8U;
    if (count > 2) group |= unsigned{bytes[i + 2]};
    for (std::size_t d = 0; d <= count; ++d) {
      text[out + d] = kDigits[group >> (18U - 6U * static_cast<unsigned>(d)) & 63U];
    }
    out += 4;
  }
  return text;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  static constexpr std::array<std::int8_t, 256> kValues = digit_values();
  if (text.size() % 4 != 0) return std::nullopt;
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  std::vector<std::uint8_t> bytes(text.size() / 4 * 3 - padding);
  std::size_t out = 0;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    const bool is_last = i + 4 == text.size();
    const std::size_t digits = is_last ? 4 - padding : 4;
    unsigned group = 0;
    for (std::size_t d = 0; d < 4; ++d) {
      const int value = d < digits ? kValues[static_cast<unsigned char>(text[i + d])] : 0;
      if (value < 0) return std::nullopt;
      group = group << 6U | static_cast<unsigned>(value);
    }
    for (std::size_t b = 0; b < digits - 1; ++b) {
      bytes[out++] = static_cast<std::uint8_t>(group >> (16U - 8U * static_cast<unsigned>(b)));
    }
    // The unused bits before the padding must be zero.
    if ((group & ((1U << (8U * static_cast<unsigned>(4 - digits))) - 1U)) != 0) {
      return std::nullopt;
    }
  }
  return bytes;
}

}  // namespace sim
