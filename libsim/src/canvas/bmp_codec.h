// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canvas/jpeg_codec.h"

namespace sim {

/// Decodes a BMP without compression, of 1, 4, 8, 24 or 32 bits a pixel (Windows GDI,
/// BITMAPFILEHEADER and BITMAPINFOHEADER), row by row as RGB. The function row() of the visitor may
/// not throw.
/// @return why it cannot be decoded; empty if all rows were visited, or begin() returned false.
[[nodiscard]] std::string decode_bmp(const std::vector<std::uint8_t>& bytes,
                                     const PictureVisitor& visitor);

}  // namespace sim
