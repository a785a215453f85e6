// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace CCMorse {

/// A cell of the grid-map: column x, counted from the left, and row y, counted from the top. Both
/// start at 0.
struct ImagePoint_t {
  int x;
  int y;

  /// The top left cell.
  constexpr ImagePoint_t() noexcept : x(0), y(0) {}
  constexpr ImagePoint_t(int aX, int aY) noexcept : x(aX), y(aY) {}

  friend constexpr bool operator==(const ImagePoint_t& a, const ImagePoint_t& b) noexcept {
    return a.x == b.x && a.y == b.y;
  }
  friend constexpr bool operator!=(const ImagePoint_t& a, const ImagePoint_t& b) noexcept {
    return !(a == b);
  }
};

/// A colour with 8 bits per channel. Alpha 255 is opaque, 0 is fully transparent.
struct ImageColour_t {
  std::uint8_t r;
  std::uint8_t g;
  std::uint8_t b;
  std::uint8_t a;

  /// Opaque black.
  constexpr ImageColour_t() noexcept : r(0), g(0), b(0), a(255) {}
  constexpr ImageColour_t(std::uint8_t aR, std::uint8_t aG, std::uint8_t aB,
                          std::uint8_t aA = 255) noexcept
      : r(aR), g(aG), b(aB), a(aA) {}

  friend constexpr bool operator==(const ImageColour_t& c, const ImageColour_t& d) noexcept {
    return c.r == d.r && c.g == d.g && c.b == d.b && c.a == d.a;
  }
  friend constexpr bool operator!=(const ImageColour_t& c, const ImageColour_t& d) noexcept {
    return !(c == d);
  }
};

/// A cell and its new colour, an element of the list for Drawing::UpdateImage().
struct ImagePixel_t {
  int x;
  int y;
  ImageColour_t colour;

  constexpr ImagePixel_t() noexcept : x(0), y(0) {}
  constexpr ImagePixel_t(int aX, int aY, const ImageColour_t& aColour) noexcept
      : x(aX), y(aY), colour(aColour) {}
  constexpr ImagePixel_t(int aX, int aY, std::uint8_t aR, std::uint8_t aG, std::uint8_t aB,
                         std::uint8_t aA = 255) noexcept
      : x(aX), y(aY), colour(aR, aG, aB, aA) {}
};

}  // namespace CCMorse
