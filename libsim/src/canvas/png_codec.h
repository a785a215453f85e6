// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace sim {

/// One row of a decoded picture, as decode_png() hands it out.
struct PngRow {
  const std::uint8_t* samples = nullptr;  ///< 16-bit samples have their high byte first
  int width = 0;                          ///< pixels
  int channels = 0;                       ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int bytes_per_sample = 0;               ///< 1 or 2
};

/// Unpacks a PNG (PNG specification, W3C 2003) by libpng, row by row, from the top. Palettes, fewer
/// than 8 bits a sample and transparent colours are expanded; nothing is done about gamma or colour
/// profiles.
/// @param row            called for each row; must not throw.
/// @param width, height  that it must have [pixels].
/// @return false if the picture is damaged, cut short, or of another size.
[[nodiscard]] bool decode_png(const std::vector<std::uint8_t>& bytes, int width, int height,
                              const std::function<void(const PngRow&)>& row);

/// Packs RGB bytes (row-major from the top left, 3 * width * height of them) as a PNG. Equal
/// pictures give equal bytes: the PNG holds no time or name.
/// @param level  of zlib, 1 (quick) to 9 (small).
/// @return the file's bytes; empty if there is no memory for it.
[[nodiscard]] std::vector<std::uint8_t> encode_png(int width, int height, const std::uint8_t* rgb,
                                                   int level);

}  // namespace sim
