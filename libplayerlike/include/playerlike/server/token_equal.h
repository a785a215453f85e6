// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "playerlike/server/server_settings.h"

namespace playerlike::server {

/// Compares two tokens of at most kMaxToken bytes in constant time, so that timing reveals nothing,
/// not even the length. Header only, so that the live page's process needs no library for it.
[[nodiscard]] inline bool equal_tokens(std::string_view a, std::string_view b) noexcept {
  using PaddedToken = std::array<unsigned char, kMaxToken>;
  const auto padded = [](std::string_view token) {
    PaddedToken bytes{};
    std::copy_n(token.begin(), std::min(token.size(), bytes.size()), bytes.begin());
    return bytes;
  };
  const PaddedToken left = padded(a);
  const PaddedToken right = padded(b);
  // Volatile, so that the compiler cannot leave the loop early.
  volatile std::size_t difference = a.size() ^ b.size();
  for (std::size_t i = 0; i < left.size(); ++i) {
    difference = difference | static_cast<std::size_t>(left[i] ^ right[i]);
  }
  return difference == 0;
}

}  // namespace playerlike::server
