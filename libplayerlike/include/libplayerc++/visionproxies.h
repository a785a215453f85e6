// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Proxies of what sees in three dimensions. Programs with them compile; no device of Playpen
/// carries their interfaces.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libplayerc++/proxywithoutdevice.h"

namespace PlayerCc {

/// Images of two cameras, and what is made of the difference.
class StereoProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  StereoProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_STEREO_CODE, "StereoProxy::StereoProxy") {}

  /// Writes the newest left image to a file; see CameraProxy::SaveFrame().
  void SaveLeftFrame(const std::string /*aPrefix*/, uint32_t /*aWidth*/ = 4) { NoDevice(); }
  /// Writes the newest right image to a file.
  void SaveRightFrame(const std::string /*aPrefix*/, uint32_t /*aWidth*/ = 4) { NoDevice(); }
  /// Writes the newest disparity image to a file.
  void SaveDisparityFrame(const std::string /*aPrefix*/, uint32_t /*aWidth*/ = 4) { NoDevice(); }
  /// Unpacks a compressed left image.
  void DecompressLeft() { NoDevice(); }
  /// Unpacks a compressed right image.
  void DecompressRight() { NoDevice(); }
  /// Unpacks a compressed disparity image.
  void DecompressDisparity() { NoDevice(); }
  /// Bits a pixel, left.
  uint32_t GetLeftDepth() const { return NoDevice(); }
  /// Bits a pixel, right.
  uint32_t GetRightDepth() const { return NoDevice(); }
  /// Bits a pixel of the disparity.
  uint32_t GetDisparityDepth() const { return NoDevice(); }
  /// Width [pixels], left.
  uint32_t GetLeftWidth() const { return NoDevice(); }
  /// Width [pixels], right.
  uint32_t GetRightWidth() const { return NoDevice(); }
  /// Width of the disparity [pixels].
  uint32_t GetDisparityWidth() const { return NoDevice(); }
  /// Height [pixels], left.
  uint32_t GetLeftHeight() const { return NoDevice(); }
  /// Height [pixels], right.
  uint32_t GetRightHeight() const { return NoDevice(); }
  /// Height of the disparity [pixels].
  uint32_t GetDisparityHeight() const { return NoDevice(); }
  /// One of PLAYER_CAMERA_FORMAT_..., left.
  uint32_t GetLeftFormat() const { return NoDevice(); }
  /// One of PLAYER_CAMERA_FORMAT_..., right.
  uint32_t GetRightFormat() const { return NoDevice(); }
  /// One of PLAYER_CAMERA_FORMAT_..., of the disparity.
  uint32_t GetDisparityFormat() const { return NoDevice(); }
  /// Size of the left image [bytes].
  uint32_t GetLeftImageSize() const { return NoDevice(); }
  /// Size of the right image [bytes].
  uint32_t GetRightImageSize() const { return NoDevice(); }
  /// Size of the disparity image [bytes].
  uint32_t GetDisparityImageSize() const { return NoDevice(); }
  /// Copies the left image.
  void GetLeftImage(uint8_t* /*aImage*/) const { NoDevice(); }
  /// Copies the right image.
  void GetRightImage(uint8_t* /*aImage*/) const { NoDevice(); }
  /// Copies the disparity image.
  void GetDisparityImage(uint8_t* /*aImage*/) const { NoDevice(); }
  /// PLAYER_CAMERA_COMPRESS_RAW or _JPEG, left.
  uint32_t GetLeftCompression() const { return NoDevice(); }
  /// PLAYER_CAMERA_COMPRESS_RAW or _JPEG, right.
  uint32_t GetRightCompression() const { return NoDevice(); }
  /// PLAYER_CAMERA_COMPRESS_RAW or _JPEG, of the disparity.
  uint32_t GetDisparityCompression() const { return NoDevice(); }
  /// How many points in space were found.
  uint32_t GetCount() const { return NoDevice(); }
  /// A point in space [m] with its colour.
  player_pointcloud3d_stereo_element_t GetPoint(uint32_t /*aIndex*/) const { return NoDevice(); }
  /// The same as GetPoint().
  player_pointcloud3d_stereo_element_t operator[](uint32_t /*aIndex*/) const { return NoDevice(); }
};

/// Points in space.
class Pointcloud3dProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  Pointcloud3dProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_POINTCLOUD3D_CODE,
                           "Pointcloud3dProxy::Pointcloud3dProxy") {}

  /// How many points there are.
  uint32_t GetCount() const { return NoDevice(); }
  /// A point [m] with its colour.
  player_pointcloud3d_element_t GetPoint(uint32_t /*aIndex*/) const { return NoDevice(); }
  /// The same as GetPoint().
  player_pointcloud3d_element_t operator[](uint32_t /*aIndex*/) const { return NoDevice(); }
};

}  // namespace PlayerCc
