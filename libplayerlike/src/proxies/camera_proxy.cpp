// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <fstream>
#include <iomanip>
#include <locale>
#include <ostream>
#include <sstream>

#include "core/errors.h"
#include "libplayerc++/cameraproxy.h"
#include "proxies/link.h"
#include "sim/devices/camera.h"

namespace PlayerCc {

using sim::CameraReading;

CameraProxy::CameraProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "CameraProxy::CameraProxy";
  Attach(PLAYER_CAMERA_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  // Bounds the values that a server sends.
  const auto side = [this](const char* name, int most) {
    return static_cast<int>(std::clamp(mLink->property(name, 0.0), 0.0, 1.0 * most));
  };
  const auto black = std::make_shared<CameraReading>();
  black->width = side("image_width", sim::ViewParams::kMaxWidth);
  black->height = side("image_height", sim::ViewParams::kMaxHeight);
  black->pixels.resize(std::size_t{3} * static_cast<std::size_t>(black->width) *
                       static_cast<std::size_t>(black->height));
  mLink->show(black);
}

CameraProxy::~CameraProxy() { ClientProxy::Unsubscribe(); }

void CameraProxy::SaveFrame(const std::string aPrefix, uint32_t aWidth) {
  const char* fun = "CameraProxy::SaveFrame";
  const scoped_lock_t lock(LockData(fun));
  constexpr uint32_t kMostDigits = 16;
  std::ostringstream file;
  file.imbue(std::locale::classic());
  file << aPrefix << std::setfill('0') << std::setw(static_cast<int>(std::min(aWidth, kMostDigits)))
       << mFrame << ".ppm";
  const auto& picture = mLink->newest.as<CameraReading>();
  if (!detail::write_ppm(file.str(), picture.pixels, static_cast<uint32_t>(picture.width),
                         static_cast<uint32_t>(picture.height))) {
    throw PlayerError(fun, "the picture " + file.str() + " cannot be written",
                      PlayerError::kFailed);
  }
  ++mFrame;
}

void CameraProxy::Decompress() { const scoped_lock_t lock(LockData("CameraProxy::Decompress")); }

uint32_t CameraProxy::GetDepth() const {
  const scoped_lock_t lock(LockData("CameraProxy::GetDepth"));
  return 24;
}

uint32_t CameraProxy::GetWidth() const {
  return static_cast<uint32_t>(Look(&CameraReading::width));
}
uint32_t CameraProxy::GetHeight() const {
  return static_cast<uint32_t>(Look(&CameraReading::height));
}

uint32_t CameraProxy::GetFormat() const {
  const scoped_lock_t lock(LockData("CameraProxy::GetFormat"));
  return PLAYER_CAMERA_FORMAT_RGB888;
}

uint32_t CameraProxy::GetImageSize() const {
  return Look<CameraReading>([](const auto& r) { return static_cast<uint32_t>(r.pixels.size()); },
                             "CameraProxy::GetImageSize");
}

void CameraProxy::GetImage(uint8_t* aImage) const {
  const char* fun = "CameraProxy::GetImage";
  const scoped_lock_t lock(LockData(fun));
  if (aImage == nullptr) {
    playerlike::refuse(fun, "there is no place for the picture: it is a null pointer");
  }
  const std::vector<uint8_t>& pixels = mLink->newest.as<CameraReading>().pixels;
  std::copy(pixels.begin(), pixels.end(), aImage);
}

uint32_t CameraProxy::GetCompression() const {
  const scoped_lock_t lock(LockData("CameraProxy::GetCompression"));
  return PLAYER_CAMERA_COMPRESS_RAW;
}

bool detail::write_ppm(const std::string& aFile, const std::vector<uint8_t>& aPixels,
                       uint32_t aWidth, uint32_t aHeight) {
  std::ofstream out(aFile, std::ios::binary);
  out << "P6\n" << aWidth << ' ' << aHeight << "\n255\n";
  out.write(reinterpret_cast<const char*>(aPixels.data()),
            static_cast<std::streamsize>(aPixels.size()));
  out.close();
  return out.good();
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::CameraProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
            << "\n#width\theight\tdepth\tformat\tcompression\tsize\n"
            << c.GetWidth() << '\t' << c.GetHeight() << '\t' << c.GetDepth() << '\t'
            << c.GetFormat() << '\t' << c.GetCompression() << '\t' << c.GetImageSize() << '\n';
}

}  // namespace std
