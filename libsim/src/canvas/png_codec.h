// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace sim {

/// One row of a decoded picture, as decode_png() passes it on.
struct PngRow {
  const std::uint8_t* samples = nullptr;  ///< the high byte of 16-bit samples comes first
  int width = 0;                          ///< pixels
  int channels = 0;                       ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int bytes_per_sample = 0;               ///< 1 or 2
};

/// Decodes a PNG (PNG specification, W3C 2003) with libpng, row by row from the top. Palettes,
/// samples of less than 8 bits and transparent colours are expanded. Gamma and colour profiles are
/// ignored.
/// @param row            called for each row; must not throw.
/// @param width, height  expected size [pixels].
/// @return false if the picture is damaged, truncated, or has another size.
[[nodiscard]] bool decode_png(const std::vector<std::uint8_t>& bytes, int width, int height,
                              const std::function<void(const PngRow&)>& row);

/// Encodes RGB bytes (row-major from the top left, 3 * width * height values) as a PNG: with a
/// palette if there are at most 256 colours, as canvases have, which is both smaller and faster.
/// Equal pictures give equal bytes, since the PNG contains no time or name.
/// @param copies  how often each row appears in the PNG, at least 1; it is `copies` * height high.
/// @return the file's bytes; empty if memory runs out.
[[nodiscard]] std::vector<std::uint8_t> encode_png(int width, int height, const std::uint8_t* rgb,
                                                   int copies = 1);

}  // namespace sim
