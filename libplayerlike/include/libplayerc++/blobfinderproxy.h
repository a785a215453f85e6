// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A sensor that detects coloured robots and obstacles as blobs in an image
/// (docs/devices/blobfinder.md).
///
/// Blobs are sorted from right to left, as in Stage. The fields of a blob are: `color`, 0xRRGGBB;
/// `area`, its number of pixels; `x` and `y`, its centre pixel; `left`, `right`, `top` and
/// `bottom`, its outermost columns and rows (inclusive); `range`, its distance [m]; `id`, always 0.
/// Column 0 is on the left, row 0 at the top. Before the first reading there are 0 blobs.
///
/// A blob whose index is not below GetCount() is all zeros; while there are blobs, a warning on
/// standard error says so, once for each proxy.
class BlobfinderProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  BlobfinderProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~BlobfinderProxy() override;

  uint32_t GetCount() const;  ///< number of blobs in view
  playerc_blobfinder_blob_t GetBlob(uint32_t aIndex) const;
  uint32_t GetWidth() const;   ///< of the image [pixels]; known from the start
  uint32_t GetHeight() const;  ///< [pixels]; known from the start
  /// Same as GetBlob().
  playerc_blobfinder_blob_t operator[](uint32_t aIndex) const;
};

}  // namespace PlayerCc

namespace std {
/// Prints the blobs, one per line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BlobfinderProxy& c);
}  // namespace std
