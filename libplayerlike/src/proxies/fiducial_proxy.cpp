// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/fiducialproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "session/player_values/fiducial.h"
#include "sim/devices/fiducial.h"

namespace PlayerCc {

using sim::FiducialReading;

FiducialProxy::FiducialProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_FIDUCIAL_CODE, aIndex, "FiducialProxy::FiducialProxy");
}

FiducialProxy::~FiducialProxy() { ClientProxy::Unsubscribe(); }

uint32_t FiducialProxy::GetCount() const {
  return Look<FiducialReading>([](const auto& r) { return static_cast<uint32_t>(r.marks.size()); },
                               "FiducialProxy::GetCount");
}

player_fiducial_item_t FiducialProxy::GetFiducialItem(uint32_t aIndex) const {
  const char* fun = "FiducialProxy::GetFiducialItem";
  const scoped_lock_t lock(LockData(fun));
  const auto& marks = mLink->newest.as<FiducialReading>().marks;
  constexpr ElementWords kThings{"thing in view", "things"};
  if (!mLink->has_element(fun, kThings, aIndex, marks.size())) return {};
  return playerlike::fiducial_item<player_fiducial_item_t>(marks[aIndex], mLink->info().properties);
}

player_pose3d_t FiducialProxy::GetSensorPose() const {
  const scoped_lock_t lock(LockData());
  return playerlike::to_players<player_pose3d_t>(playerlike::mounting_of(mLink->info().properties));
}

player_bbox3d_t FiducialProxy::GetSensorSize() const {
  const scoped_lock_t lock(LockData("FiducialProxy::GetSensorSize"));
  return {0.0, 0.0, 0.0};
}

player_bbox2d_t FiducialProxy::GetFiducialSize() const {
  const scoped_lock_t lock(LockData("FiducialProxy::GetFiducialSize"));
  return {0.0, 0.0};
}

void FiducialProxy::RequestGeometry() {
  const scoped_lock_t lock(LockData("FiducialProxy::RequestGeometry"));
}

player_fiducial_item_t FiducialProxy::operator[](uint32_t aIndex) const {
  return GetFiducialItem(aIndex);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::FiducialProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#id\tx [m]\ty [m]\tyaw [rad]\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) {
    const player_fiducial_item_t item = c.GetFiducialItem(i);
    os << item.id << '\t';
    PlayerCc::detail::print_pose(os, item.pose);
    os << '\n';
  }
  return os;
}

}  // namespace std
