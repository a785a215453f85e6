// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "session/player_values/fields.h"
#include "sim/devices/blobfinder.h"

/// @file
/// Player's interface blobfinder.
namespace playerlike {

/// A colour as 0xRRGGBB.
[[nodiscard]] inline std::uint32_t colour_code(const sim::Colour& colour) {
  return static_cast<std::uint32_t>(colour.r << 16 | colour.g << 8 | colour.b);
}
[[nodiscard]] inline sim::Colour colour_of_code(std::uint32_t code) {
  return {static_cast<std::uint8_t>(code >> 16U), static_cast<std::uint8_t>(code >> 8U),
          static_cast<std::uint8_t>(code), 255};
}

template <typename Blob, MaybeConst<sim::BlobfinderReading::Blob> Seen, typename Same>
void same_values(Blob& blob, Seen& seen, Same same) {
  same.converted(blob.color, seen.colour, colour_code, colour_of_code);
  same(blob.area, seen.area);
  same(blob.x, seen.x);
  same(blob.y, seen.y);
  same(blob.left, seen.left);
  same(blob.right, seen.right);
  same(blob.top, seen.top);
  same(blob.bottom, seen.bottom);
  same(blob.range, seen.range_m);
}

template <typename Data, MaybeConst<sim::BlobfinderReading> Seen, typename Same>
void same_values(Data& data, Seen& seen, Same same) {
  same(data.width, seen.width);
  same(data.height, seen.height);
  same(data.blobs, seen.blobs);
}

}  // namespace playerlike
