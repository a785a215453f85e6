// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>
#include <ostream>

#include "libplayerc++/irproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/rangers.h"

namespace PlayerCc {

IrProxy::IrProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  IrProxy::Subscribe(aIndex);
}

IrProxy::~IrProxy() { IrProxy::Unsubscribe(); }

void IrProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "IrProxy::IrProxy";
  Attach(PLAYER_IR_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mPoses = detail::element_poses(mLink->info().properties);
  mGain = mLink->property("voltage_gain", 0.0);
  mShift = mLink->property("voltage_shift", 0.0);
}

void IrProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void IrProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::RangerReading*>(&aReading.measured);
  if (reading == nullptr) return;
  mRanges = reading->ranges_m;
  mVoltages.clear();
  std::transform(mRanges.begin(), mRanges.end(), std::back_inserter(mVoltages),
                 [this](double range) { return sim::infrared_voltage_v(range, mGain, mShift); });
}

bool IrProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return (aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_IR_DATA_RANGES) ||
         (aType == PLAYER_MSGTYPE_REQ && aSubtype == PLAYER_IR_REQ_POSE);
}

uint32_t IrProxy::GetCount() const {
  const scoped_lock_t lock(LockData("IrProxy::GetCount"));
  return static_cast<uint32_t>(mRanges.size());
}

double IrProxy::GetRange(uint32_t aIndex) const {
  const char* fun = "IrProxy::GetRange";
  const scoped_lock_t lock(LockData(fun));
  return detail::element_or_zero(fun, "transducer", aIndex, mRanges);
}

double IrProxy::GetVoltage(uint32_t aIndex) const {
  const char* fun = "IrProxy::GetVoltage";
  const scoped_lock_t lock(LockData(fun));
  return detail::element_or_zero(fun, "transducer", aIndex, mVoltages);
}

uint32_t IrProxy::GetPoseCount() const {
  const scoped_lock_t lock(LockData("IrProxy::GetPoseCount"));
  return static_cast<uint32_t>(mPoses.size());
}

player_pose3d_t IrProxy::GetPose(uint32_t aIndex) const {
  const char* fun = "IrProxy::GetPose";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "transducer", aIndex, mPoses.size());
  return mPoses[aIndex];
}

void IrProxy::RequestGeom() { const scoped_lock_t lock(LockData("IrProxy::RequestGeom")); }

double IrProxy::operator[](uint32_t aIndex) const { return GetRange(aIndex); }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::IrProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#x [m]\ty [m]\tyaw [rad]\trange [m]\tvoltage [V]\n";
  for (uint32_t i = 0; i < c.GetPoseCount(); ++i) {
    PlayerCc::detail::print_pose(os, c.GetPose(i));
    os << '\t' << c.GetRange(i) << '\t' << c.GetVoltage(i) << '\n';
  }
  return os;
}

}  // namespace std
