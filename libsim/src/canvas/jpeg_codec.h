// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sim {

/// What a program does with a picture that is decoded.
struct PictureVisitor {
  /// Called with the size before any memory for pixels is allocated. @return whether to go on.
  std::function<bool(std::uint32_t width, std::uint32_t height)> begin;
  /// Called for each row from the top: `channels` samples for each pixel, 1 (grey) or 3 (RGB).
  std::function<void(const std::uint8_t* samples, int channels)> row;
};

/// Decodes a JPEG (ITU-T T.81) with libjpeg, row by row. Colours of four channels (CMYK) are not
/// supported. Neither function of the visitor may throw.
/// @return why it cannot be decoded; empty if all rows were visited, or begin() returned false.
[[nodiscard]] std::string decode_jpeg(const std::vector<std::uint8_t>& bytes,
                                      const PictureVisitor& visitor);

}  // namespace sim
