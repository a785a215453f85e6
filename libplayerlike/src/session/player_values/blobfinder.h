// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "session/player_values/fields.h"
#include "sim/devices/blobfinder.h"

/// @file
/// Player's interface blobfinder.
namespace playerlike {

template <typename Blob>
[[nodiscard]] Blob blob_of(const sim::BlobfinderReading::Blob& seen) {
  Blob blob = {};
  blob.color = static_cast<std::uint32_t>(seen.colour.r << 16 | seen.colour.g << 8 | seen.colour.b);
  blob.area = static_cast<std::uint32_t>(seen.area);
  blob.x = static_cast<std::uint32_t>(seen.x);
  blob.y = static_cast<std::uint32_t>(seen.y);
  blob.left = static_cast<std::uint32_t>(seen.left);
  blob.right = static_cast<std::uint32_t>(seen.right);
  blob.top = static_cast<std::uint32_t>(seen.top);
  blob.bottom = static_cast<std::uint32_t>(seen.bottom);
  blob.range = static_cast<float>(seen.range_m);
  return blob;
}
template <typename Blob>
[[nodiscard]] sim::BlobfinderReading::Blob seen_blob(const Blob& blob) {
  sim::BlobfinderReading::Blob seen;
  seen.colour = {static_cast<std::uint8_t>(blob.color >> 16U),
                 static_cast<std::uint8_t>(blob.color >> 8U), static_cast<std::uint8_t>(blob.color),
                 255};
  seen.area = as_int(blob.area);
  seen.x = as_int(blob.x);
  seen.y = as_int(blob.y);
  seen.left = as_int(blob.left);
  seen.right = as_int(blob.right);
  seen.top = as_int(blob.top);
  seen.bottom = as_int(blob.bottom);
  seen.range_m = static_cast<double>(blob.range);
  return seen;
}

}  // namespace playerlike
