// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sim {

/// A grey-scale image, e.g. the floor plan of a map: 0 is black, 255 is white.
struct GreyImage {
  int width = 0;                     ///< pixels, 1..kMaxGreyImageSide after loading
  int height = 0;                    ///< pixels, 1..kMaxGreyImageSide after loading
  std::vector<std::uint8_t> pixels;  ///< row-major from the top left, width * height values
};

/// Maximum side of an image for load_grey_image [pixels].
inline constexpr int kMaxGreyImageSide = 16384;
/// Maximum number of pixels, since a small file may claim a huge image.
inline constexpr std::size_t kMaxGreyImagePixels = std::size_t{8192} * 16384;
/// Maximum size of a file [bytes].
inline constexpr std::size_t kMaxGreyImageBytes = std::size_t{256} << 20;

/// Reads a PNG or a PGM (plain or raw). The first bytes of the file determine the format.
///
/// Colours are converted to luma (ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B). Transparent pixels
/// are blended over white. 16-bit samples, and PGMs with another maximum, are scaled to 0..255.
/// Reads no pixels before it has checked the size in the file's header.
/// @throws std::runtime_error "PATH: reason" if the file cannot be read, has another format, is
///     damaged, has a side longer than kMaxGreyImageSide or more than kMaxGreyImagePixels, or is
///     not a regular file of at most kMaxGreyImageBytes.
[[nodiscard]] GreyImage load_grey_image(const std::string& path);

/// Like load_grey_image, from the bytes of a file.
/// @param name  of the file, for messages.
[[nodiscard]] GreyImage decode_grey_image(const std::vector<std::uint8_t>& bytes,
                                          const std::string& name);

/// Reads the first sample of each pixel of a PNG, JPEG, BMP, PBM, PGM or PPM (plain or raw): red,
/// or the shade of grey. Transparency has no influence. Otherwise like load_grey_image.
[[nodiscard]] GreyImage load_first_samples(const std::string& path);

}  // namespace sim
