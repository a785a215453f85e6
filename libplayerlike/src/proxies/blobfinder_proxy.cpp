// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <ostream>

#include "libplayerc++/blobfinderproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "session/player_values/blobfinder.h"
#include "sim/devices/blobfinder.h"

namespace PlayerCc {

using sim::BlobfinderReading;

BlobfinderProxy::BlobfinderProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "BlobfinderProxy::BlobfinderProxy";
  Attach(PLAYER_BLOBFINDER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  const auto pixels = [this](const char* name) {
    constexpr double kMost = 1 << 20U;  // bounds the values that a server sends
    return static_cast<int>(std::clamp(mLink->property(name, 0.0), 0.0, kMost));
  };
  const auto announced = std::make_shared<BlobfinderReading>();
  announced->width = pixels("image_width");
  announced->height = pixels("image_height");
  mLink->show(announced);
}

BlobfinderProxy::~BlobfinderProxy() { ClientProxy::Unsubscribe(); }

uint32_t BlobfinderProxy::GetCount() const {
  return Look<BlobfinderReading>(
      [](const auto& r) { return static_cast<uint32_t>(r.blobs.size()); },
      "BlobfinderProxy::GetCount");
}

playerc_blobfinder_blob_t BlobfinderProxy::GetBlob(uint32_t aIndex) const {
  const char* fun = "BlobfinderProxy::GetBlob";
  return Look<BlobfinderReading>(
      [&](const auto& r) {
        return mLink->has_element(fun, {"blob", "blobs"}, aIndex, r.blobs.size())
                   ? playerlike::to_players<playerc_blobfinder_blob_t>(r.blobs[aIndex])
                   : playerc_blobfinder_blob_t{};
      },
      fun);
}

uint32_t BlobfinderProxy::GetWidth() const {
  return static_cast<uint32_t>(Look(&BlobfinderReading::width));
}
uint32_t BlobfinderProxy::GetHeight() const {
  return static_cast<uint32_t>(Look(&BlobfinderReading::height));
}

playerc_blobfinder_blob_t BlobfinderProxy::operator[](uint32_t aIndex) const {
  return GetBlob(aIndex);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::BlobfinderProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#color\tarea\tx\ty\tleft\tright\ttop\tbottom\trange [m]\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) {
    const playerc_blobfinder_blob_t blob = c.GetBlob(i);
    os << sim::to_string(sim::Colour{static_cast<uint8_t>(blob.color >> 16),
                                     static_cast<uint8_t>(blob.color >> 8),
                                     static_cast<uint8_t>(blob.color), 255})
       << '\t' << blob.area << '\t' << blob.x << '\t' << blob.y << '\t' << blob.left << '\t'
       << blob.right << '\t' << blob.top << '\t' << blob.bottom << '\t' << blob.range << '\n';
  }
  return os;
}

}  // namespace std
