// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Pictures of a camera (docs/devices/camera.md): red, green and blue, 8 bits each, row by row from
/// the top, not compressed. Sizes are known from the start; before the first reading the picture is
/// black.
class CameraProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  CameraProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~CameraProxy() override;

  /// Writes the newest picture to a file of the client's machine, PREFIX and a running number from
  /// 0 on, filled up with zeros, and ".ppm": a binary PPM.
  /// @param aWidth  digits of the number, at most 16.
  /// @throws PlayerError kFailed if it cannot be written.
  void SaveFrame(const std::string aPrefix, uint32_t aWidth = 4);
  /// Nothing: pictures are not compressed.
  void Decompress();
  uint32_t GetDepth() const;      ///< bits a pixel: 24
  uint32_t GetWidth() const;      ///< [pixels]
  uint32_t GetHeight() const;     ///< [pixels]
  uint32_t GetFormat() const;     ///< PLAYER_CAMERA_FORMAT_RGB888
  uint32_t GetImageSize() const;  ///< [bytes]
  /// Copies the picture: GetImageSize() bytes.
  void GetImage(uint8_t* aImage) const;
  uint32_t GetCompression() const;  ///< PLAYER_CAMERA_COMPRESS_RAW

 private:
  uint32_t mFrame = 0;  // number of the next saved picture
};

namespace detail {
/// Writes red, green and blue of each pixel as a binary PPM. @return whether that was possible.
bool write_ppm(const std::string& aFile, const std::vector<uint8_t>& aPixels, uint32_t aWidth,
               uint32_t aHeight);
}  // namespace detail

}  // namespace PlayerCc

namespace std {
/// Prints size and kind of the pictures.
std::ostream& operator<<(std::ostream& os, const PlayerCc::CameraProxy& c);
}  // namespace std
