// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sim {

/// A picture in shades of grey, e.g. the floor plan of a map: 0 is black, 255 white.
struct GreyImage {
  int width = 0;                     ///< pixels, 1..kMaxGreyImageSide once loaded
  int height = 0;                    ///< pixels, likewise
  std::vector<std::uint8_t> pixels;  ///< row-major from the top left, width * height of them
};

/// The longest side of a picture that load_grey_image takes [pixels].
inline constexpr int kMaxGreyImageSide = 16384;
/// The most pixels that it takes, whatever the sides: a small file may claim a huge picture.
inline constexpr std::size_t kMaxGreyImagePixels = std::size_t{8192} * 8192;
/// The largest file that it takes [bytes].
inline constexpr std::size_t kMaxGreyImageBytes = std::size_t{256} << 20;

/// Reads a PNG or a PGM (plain or raw), told apart by what the file begins with.
///
/// Colours become their luma (ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B); what is transparent
/// shows the white of the paper behind it; 16-bit samples and PGMs of another maximum are scaled
/// to 0..255. Reads no pixel before the size in the file's header has been checked.
/// @throws std::runtime_error "PATH: reason" if the file cannot be read, is of another format, is
///     damaged, has a side longer than kMaxGreyImageSide or more than kMaxGreyImagePixels,
///     or is no regular file of at most kMaxGreyImageBytes.
[[nodiscard]] GreyImage load_grey_image(const std::string& path);

}  // namespace sim
