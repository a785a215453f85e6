// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <vector>

#include "libplayerc++/irproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"

namespace PlayerCc {

using detail::count_of_ranges;
using sim::RangerReading;

IrProxy::IrProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "IrProxy::IrProxy";
  Attach(PLAYER_IR_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mPoses = detail::element_poses(mLink->info().properties);
}

IrProxy::~IrProxy() { ClientProxy::Unsubscribe(); }

uint32_t IrProxy::GetCount() const {
  uint32_t count = 0;
  if (mElements.Count(count)) return count;
  const scoped_lock_t lock(mLink->lock_element("IrProxy::GetCount"));
  return count_of_ranges(mLink->newest.as<RangerReading>());
}

double IrProxy::GetRange(uint32_t aIndex) const {
  double range = 0.0;
  if (mElements.Find(aIndex, range)) return range;
  const char* fun = "IrProxy::GetRange";
  const scoped_lock_t lock(mLink->lock_element(fun));
  return mLink->element_or_zero(fun, detail::kTransducers, aIndex,
                                mLink->newest.as<RangerReading>().ranges_m);
}

double IrProxy::GetVoltage(uint32_t aIndex) const {
  const char* fun = "IrProxy::GetVoltage";
  const scoped_lock_t lock(LockData(fun));
  const auto& reading = mLink->newest.as<RangerReading>();
  const std::vector<double>& ranges = reading.ranges_m;
  if (aIndex < reading.voltages_v.size()) return reading.voltages_v[aIndex];
  if (!mLink->has_element(fun, detail::kTransducers, aIndex, ranges.size())) return 0.0;
  return playerlike::voltage_v(reading, aIndex, mLink->info().properties);
}

uint32_t IrProxy::GetPoseCount() const {
  const scoped_lock_t lock(LockData("IrProxy::GetPoseCount"));
  return static_cast<uint32_t>(mPoses.size());
}

player_pose3d_t IrProxy::GetPose(uint32_t aIndex) const {
  const char* fun = "IrProxy::GetPose";
  const scoped_lock_t lock(LockData(fun));
  return mLink->element_or_zero(fun, detail::kTransducers, aIndex, mPoses);
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
