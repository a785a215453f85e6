// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>

#include "libplayerc++/blobfinderproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/blobfinder.h"

namespace PlayerCc {

BlobfinderProxy::BlobfinderProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  BlobfinderProxy::Subscribe(aIndex);
}

BlobfinderProxy::~BlobfinderProxy() { BlobfinderProxy::Unsubscribe(); }

void BlobfinderProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "BlobfinderProxy::BlobfinderProxy";
  Attach(PLAYER_BLOBFINDER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  const auto pixels = [this](const char* name) {
    constexpr double kMost = 1 << 20U;  // servers may say what they like
    return static_cast<uint32_t>(std::clamp(mLink->property(name, 0.0), 0.0, kMost));
  };
  mWidth = pixels("image_width");
  mHeight = pixels("image_height");
}

void BlobfinderProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void BlobfinderProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::BlobfinderReading*>(&aReading.measured);
  if (reading == nullptr) return;
  mWidth = static_cast<uint32_t>(reading->width);
  mHeight = static_cast<uint32_t>(reading->height);
  mBlobs.clear();
  for (const auto& seen : reading->blobs) {
    playerc_blobfinder_blob_t blob = {};
    blob.color = static_cast<uint32_t>(seen.colour.r << 16 | seen.colour.g << 8 | seen.colour.b);
    blob.area = static_cast<uint32_t>(seen.area);
    blob.x = static_cast<uint32_t>(seen.x);
    blob.y = static_cast<uint32_t>(seen.y);
    blob.left = static_cast<uint32_t>(seen.left);
    blob.right = static_cast<uint32_t>(seen.right);
    blob.top = static_cast<uint32_t>(seen.top);
    blob.bottom = static_cast<uint32_t>(seen.bottom);
    blob.range = static_cast<float>(seen.range_m);
    mBlobs.push_back(blob);
  }
}

bool BlobfinderProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_BLOBFINDER_DATA_BLOBS;
}

uint32_t BlobfinderProxy::GetCount() const {
  const scoped_lock_t lock(LockData("BlobfinderProxy::GetCount"));
  return static_cast<uint32_t>(mBlobs.size());
}

playerc_blobfinder_blob_t BlobfinderProxy::GetBlob(uint32_t aIndex) const {
  const char* fun = "BlobfinderProxy::GetBlob";
  const scoped_lock_t lock(LockData(fun));
  return detail::element_or_zero(fun, "blob", aIndex, mBlobs);
}

uint32_t BlobfinderProxy::GetWidth() const { return GetVar(mWidth); }
uint32_t BlobfinderProxy::GetHeight() const { return GetVar(mHeight); }

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
