// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Images of a camera (docs/devices/camera.md): uncompressed RGB with 8 bits per channel, row by
/// row from the top. The size is known from the start; before the first reading the image is black.
class CameraProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  CameraProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~CameraProxy() override;

  /// Writes the newest image as a binary PPM file on the client's machine. The file name is the
  /// prefix, a zero-padded sequence number that starts at 0, and ".ppm".
  /// @param aWidth  minimum number of digits of the number, at most 16.
  /// @throws PlayerError kFailed if the file cannot be written.
  void SaveFrame(const std::string aPrefix, uint32_t aWidth = 4);
  /// Does nothing, because images are not compressed.
  void Decompress();
  uint32_t GetDepth() const;      ///< bits per pixel: 24
  uint32_t GetWidth() const;      ///< [pixels]
  uint32_t GetHeight() const;     ///< [pixels]
  uint32_t GetFormat() const;     ///< PLAYER_CAMERA_FORMAT_RGB888
  uint32_t GetImageSize() const;  ///< [bytes]
  /// Copies the image: GetImageSize() bytes.
  void GetImage(uint8_t* aImage) const;
  uint32_t GetCompression() const;  ///< PLAYER_CAMERA_COMPRESS_RAW

 private:
  uint32_t mFrame = 0;  // number of the next saved image
};

namespace detail {
/// Writes an RGB image as a binary PPM file.
/// @return whether writing succeeded.
bool write_ppm(const std::string& aFile, const std::vector<uint8_t>& aPixels, uint32_t aWidth,
               uint32_t aHeight);
}  // namespace detail

}  // namespace PlayerCc

namespace std {
/// Prints size and format of the images.
std::ostream& operator<<(std::ostream& os, const PlayerCc::CameraProxy& c);
}  // namespace std
