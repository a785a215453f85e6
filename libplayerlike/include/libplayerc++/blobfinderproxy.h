// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A sensor that sees coloured things, robots and obstacles, as blobs in a picture
/// (docs/devices/blobfinder.md).
///
/// Blobs come from right to left, as from Stage. Of a blob, `color` is 0xRRGGBB, `area` how many
/// pixels it has, `x` and `y` the pixel in its middle, `left`, `right`, `top` and `bottom` its
/// outermost columns and rows, which belong to it, and `range` how far away it is [m]; column 0 is
/// on the left, row 0 on top. `id` is 0. Before the first reading there are 0 blobs.
///
/// A blob whose index is not below GetCount() is all zeros; while there are blobs, a warning on
/// standard error says so, once for each proxy.
class BlobfinderProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  BlobfinderProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~BlobfinderProxy() override;

  uint32_t GetCount() const;  ///< blobs in view
  playerc_blobfinder_blob_t GetBlob(uint32_t aIndex) const;
  uint32_t GetWidth() const;   ///< of the picture [pixels]; known from the start
  uint32_t GetHeight() const;  ///< [pixels]; known from the start
  /// GetBlob().
  playerc_blobfinder_blob_t operator[](uint32_t aIndex) const;
};

}  // namespace PlayerCc

namespace std {
/// Prints the blobs, one a line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BlobfinderProxy& c);
}  // namespace std
