// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <ostream>

#include "libplayerc++/fiducialproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/fiducial.h"

namespace PlayerCc {

FiducialProxy::FiducialProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  FiducialProxy::Subscribe(aIndex);
}

FiducialProxy::~FiducialProxy() { FiducialProxy::Unsubscribe(); }

void FiducialProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "FiducialProxy::FiducialProxy";
  Attach(PLAYER_FIDUCIAL_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mPose = {mLink->property("mount_x", 0.0),
           mLink->property("mount_y", 0.0),
           mLink->property("height", 0.0),
           0.0,
           0.0,
           mLink->property("mount_yaw", 0.0)};
  mNoise = mLink->property("noise", 0.0);
  mNoiseBearing = mLink->property("noise_bearing", 0.0);
  mNoiseYaw = mLink->property("noise_yaw", 0.0);
}

void FiducialProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void FiducialProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::FiducialReading*>(&aReading.measured);
  if (reading == nullptr) return;
  mItems.clear();
  for (const auto& mark : reading->marks) {
    player_fiducial_item_t item = {};
    item.id = mark.id;
    item.pose = {mark.X_ST.x_m, mark.X_ST.y_m, 0.0, 0.0, 0.0, mark.X_ST.yaw_rad};
    // Along the line of sight the distance is uncertain, across it the direction.
    const double across = mNoiseBearing * std::hypot(mark.X_ST.x_m, mark.X_ST.y_m);
    const double bearing = std::atan2(mark.X_ST.y_m, mark.X_ST.x_m);
    item.upose.px = std::hypot(mNoise * std::cos(bearing), across * std::sin(bearing));
    item.upose.py = std::hypot(mNoise * std::sin(bearing), across * std::cos(bearing));
    item.upose.pyaw = mNoiseYaw;
    mItems.push_back(item);
  }
}

bool FiducialProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return (aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_FIDUCIAL_DATA_SCAN) ||
         (aType == PLAYER_MSGTYPE_REQ && aSubtype == PLAYER_FIDUCIAL_REQ_GET_GEOM);
}

uint32_t FiducialProxy::GetCount() const {
  const scoped_lock_t lock(LockData("FiducialProxy::GetCount"));
  return static_cast<uint32_t>(mItems.size());
}

player_fiducial_item_t FiducialProxy::GetFiducialItem(uint32_t aIndex) const {
  const char* fun = "FiducialProxy::GetFiducialItem";
  const scoped_lock_t lock(LockData(fun));
  return detail::element_or_zero(fun, "thing in view", aIndex, mItems);
}

player_pose3d_t FiducialProxy::GetSensorPose() const { return GetVar(mPose); }

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
