// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/actarrayproxy.h"
#include "proxies/link.h"
#include "session/player_values/actarray.h"
#include "sim/core/number_text.h"
#include "sim/devices/actarray.h"

namespace PlayerCc {

using sim::ActArrayReading;
using JointMode = sim::JointCommand::Mode;
using JointSetting = sim::JointSettingCommand::Setting;

namespace {

constexpr ElementWords kJointWords{"joint", "joints"};
constexpr uint32_t kAllJoints = static_cast<uint32_t>(-1);

// Positions of clients are single-precision numbers.
constexpr double kRounding = 1e-5;

std::vector<double> doubles(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

ActArrayProxy::ActArrayProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "ActArrayProxy::ActArrayProxy";
  Attach(PLAYER_ACTARRAY_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  constexpr double kMost = sim::ActArrayParams::kMaxJoints;
  mJoints = static_cast<std::size_t>(std::clamp(mLink->property("count", 0.0), 0.0, kMost));
}

ActArrayProxy::~ActArrayProxy() { ClientProxy::Unsubscribe(); }

void ActArrayProxy::RequestGeometry() {
  const scoped_lock_t lock(LockData("ActArrayProxy::RequestGeometry"));
}

// --- settings

void ActArrayProxy::Set(const char* aFun, int aSetting, uint32_t aJoint, double aValue) {
  const scoped_lock_t lock(mLink->lock_for_command(aFun));
  const auto setting = static_cast<JointSetting>(aSetting);
  if (aJoint != kAllJoints && aJoint >= mJoints) {
    playerlike::refuse(aFun, "there is no joint " + std::to_string(aJoint) + ": there are " +
                                 std::to_string(mJoints) + ", counted from 0");
  }
  const bool is_rate = setting == JointSetting::kSpeed || setting == JointSetting::kAcceleration;
  if (is_rate && aValue == 0.0) {
    playerlike::refuse(aFun, std::string("the ") +
                                 (setting == JointSetting::kSpeed ? "speed" : "acceleration") +
                                 " of a joint cannot be set to 0");
  }
  if (setting == JointSetting::kPower) mSwitchedOn = aValue != 0.0;
  const int joint = aJoint == kAllJoints ? -1 : static_cast<int>(aJoint);
  mLink->send(aFun, sim::JointSettingCommand{setting, joint, aValue});
}

void ActArrayProxy::SetPowerConfig(bool aVal) {
  Set("ActArrayProxy::SetPowerConfig", static_cast<int>(JointSetting::kPower), kAllJoints,
      aVal ? 1.0 : 0.0);
}
void ActArrayProxy::SetBrakesConfig(bool aVal) {
  Set("ActArrayProxy::SetBrakesConfig", static_cast<int>(JointSetting::kBrakes), kAllJoints,
      aVal ? 1.0 : 0.0);
}
void ActArrayProxy::SetSpeedConfig(uint32_t aJoint, float aSpeed) {
  Set("ActArrayProxy::SetSpeedConfig", static_cast<int>(JointSetting::kSpeed), aJoint,
      double{aSpeed});
}
void ActArrayProxy::SetAccelerationConfig(uint32_t aJoint, float aAcc) {
  Set("ActArrayProxy::SetAccelerationConfig", static_cast<int>(JointSetting::kAcceleration), aJoint,
      double{aAcc});
}

// --- movements

double ActArrayProxy::OfJoint(const char* aName, std::size_t aJoint) const {
  return playerlike::joint_setting(mLink->info().properties, aName, aJoint);
}

void ActArrayProxy::WarnBeyondLimits(const char* aFun, std::size_t aFirst, std::size_t aEnd,
                                     const std::vector<double>& aPositions) const {
  for (std::size_t joint = aFirst; joint < aEnd; ++joint) {
    const std::size_t index = std::min(joint - aFirst, aPositions.size() - 1);
    const double min = OfJoint("min", joint);
    const double max = OfJoint("max", joint);
    const double position = aPositions[index];
    if (!(position < min - kRounding || position > max + kRounding)) continue;  // or NaN
    mLink->warn_once(aFun, "joint " + std::to_string(joint) + " cannot move to " +
                               sim::rounded_text(position, 6) + ", only from " +
                               sim::rounded_text(min, 6) + " to " + sim::rounded_text(max, 6) +
                               "; it stops at the limit");
  }
}

void ActArrayProxy::Move(const char* aFun, int aMode, uint32_t aJoint,
                         std::vector<double> aValues) {
  const scoped_lock_t lock(mLink->lock_for_command(aFun));
  const auto mode = static_cast<JointMode>(aMode);
  const bool moves_all = aJoint == kAllJoints;
  const std::size_t moved = mode == JointMode::kHome ? 1 : aValues.size();
  const std::size_t first = moves_all ? 0 : aJoint;
  const std::size_t end = moves_all ? mJoints : first + moved;
  if (moved == 0) return;
  if (end > mJoints) {
    mLink->warn_once(aFun, "there is no joint " + std::to_string(end - 1) + ": there are " +
                               std::to_string(mJoints) +
                               ", counted from 0; commands to joints beyond have no effect");
    if (first >= mJoints) return;
    aValues.resize(mJoints - first);
  }
  const auto* reading = mLink->newest.find<ActArrayReading>();
  if (reading != nullptr && !reading->is_powered && !mSwitchedOn) {
    mLink->warn_once(aFun,
                     "the motors are off, so no joint moves; SetPowerConfig(true) switches "
                     "them on");
  }
  if (mode == JointMode::kPosition) {
    WarnBeyondLimits(aFun, first, std::min(end, mJoints), aValues);
  }
  const int joint = moves_all ? -1 : static_cast<int>(first);
  mLink->send(aFun, sim::JointCommand{mode, joint, std::move(aValues)});
}

void ActArrayProxy::MoveTo(uint32_t aJoint, float aPos) {
  Move("ActArrayProxy::MoveTo", static_cast<int>(JointMode::kPosition), aJoint, {double{aPos}});
}
void ActArrayProxy::MoveToMulti(std::vector<float> aPos) {
  Move("ActArrayProxy::MoveToMulti", static_cast<int>(JointMode::kPosition), 0, doubles(aPos));
}
void ActArrayProxy::MoveAtSpeed(uint32_t aJoint, float aSpeed) {
  Move("ActArrayProxy::MoveAtSpeed", static_cast<int>(JointMode::kSpeed), aJoint, {double{aSpeed}});
}
void ActArrayProxy::MoveAtSpeedMulti(std::vector<float> aSpeed) {
  Move("ActArrayProxy::MoveAtSpeedMulti", static_cast<int>(JointMode::kSpeed), 0, doubles(aSpeed));
}
void ActArrayProxy::MoveHome(int aJoint) {
  Move("ActArrayProxy::MoveHome", static_cast<int>(JointMode::kHome), static_cast<uint32_t>(aJoint),
       {});
}
void ActArrayProxy::SetActuatorCurrent(uint32_t aJoint, float aCurrent) {
  Move("ActArrayProxy::SetActuatorCurrent", static_cast<int>(JointMode::kCurrent), aJoint,
       {double{aCurrent}});
}
void ActArrayProxy::SetActuatorCurrentMulti(std::vector<float> aCurrent) {
  Move("ActArrayProxy::SetActuatorCurrentMulti", static_cast<int>(JointMode::kCurrent), 0,
       doubles(aCurrent));
}

// --- data

uint32_t ActArrayProxy::GetCount() const {
  return static_cast<uint32_t>(Look(&ActArrayReading::joints, "ActArrayProxy::GetCount").size());
}

player_actarray_actuator_t ActArrayProxy::GetActuatorData(uint32_t aJoint) const {
  const char* fun = "ActArrayProxy::GetActuatorData";
  const scoped_lock_t lock(LockData(fun));
  const auto& joints = mLink->newest.as<ActArrayReading>().joints;
  if (!mLink->has_element(fun, kJointWords, aJoint, joints.size())) return {};
  return playerlike::to_players<player_actarray_actuator_t>(joints[aJoint]);
}

player_actarray_actuatorgeom_t ActArrayProxy::GetActuatorGeom(uint32_t aJoint) const {
  const char* fun = "ActArrayProxy::GetActuatorGeom";
  const scoped_lock_t lock(LockData(fun));
  if (!mLink->has_element(fun, kJointWords, aJoint, mJoints)) return {};
  const auto& joints = mLink->newest.as<ActArrayReading>().joints;
  return playerlike::actuator_geometry<player_actarray_actuatorgeom_t>(
      mLink->info().properties, aJoint, aJoint < joints.size() ? &joints[aJoint] : nullptr);
}

player_point_3d_t ActArrayProxy::GetBasePos() const {
  const scoped_lock_t lock(LockData());
  return {mLink->property("mount_x", 0.0), mLink->property("mount_y", 0.0),
          mLink->property("height", 0.0)};
}

player_orientation_3d_t ActArrayProxy::GetBaseOrientation() const {
  const scoped_lock_t lock(LockData());
  return {mLink->property("roll", 0.0), mLink->property("pitch", 0.0),
          mLink->property("mount_yaw", 0.0)};
}

bool ActArrayProxy::IsPowered() const {
  const scoped_lock_t lock(LockData());
  const auto* reading = mLink->newest.find<ActArrayReading>();
  return reading != nullptr && reading->is_powered;
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::ActArrayProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#position\tspeed\tstate\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) {
    const player_actarray_actuator_t joint = c.GetActuatorData(i);
    os << joint.position << '\t' << joint.speed << '\t' << static_cast<int>(joint.state) << '\n';
  }
  return os;
}

}  // namespace std
