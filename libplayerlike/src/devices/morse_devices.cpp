// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/client_core.h"
#include "devices/errors.h"
#include "libCCMorse/MorseActuator.h"
#include "libCCMorse/MorseBattery.h"
#include "libCCMorse/MorseCollision.h"
#include "libCCMorse/MorseDevice.h"
#include "libCCMorse/MorseInfrared.h"
#include "libCCMorse/MorseLaser.h"
#include "libCCMorse/MorseMotionVW.h"
#include "libCCMorse/MorseOdometry.h"
#include "libCCMorse/MorsePen.h"
#include "libCCMorse/MorsePose.h"
#include "libCCMorse/MorseProximity.h"
#include "libCCMorse/MorseSensor.h"
#include "libCCMorse/MorseSonar.h"
#include "sim/devices/battery.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/proximity.h"
#include "sim/devices/rangers.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::DeviceId;
using playerlike::DeviceInfo;
using playerlike::translated;

// --- MorseDevice

MorseDevice::MorseDevice(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                         const char* aClass)
    : mRobot(aRobot), mClass(aClass), mRobotIndex(-1), mDeviceIndex(-1) {
  const playerlike::RobotInfo& robot = Core()->robots().at(mRobot.mIndex);
  std::string known;
  for (const DeviceInfo& device : robot.devices) {
    if (device.type != aType) continue;
    known += (known.empty() ? "" : ", ") + device.name;
    if (mDeviceIndex >= 0 || (!aName.empty() && device.name != aName)) continue;
    mRobotIndex = device.id.robot;
    mDeviceIndex = device.id.device;
  }
  if (mDeviceIndex < 0) {
    throw PlayerError(Fun(aClass),
                      "robot " + robot.name + " has no device of type \"" + aType + "\"" +
                          (aName.empty() ? "" : " called \"" + aName + "\"") +
                          "; devices of that type: " + (known.empty() ? "none" : known),
                      PlayerError::kNoSuchDevice);
  }
}

MorseDevice::~MorseDevice() = default;

std::string MorseDevice::Fun(const char* aFunction) const {
  return std::string(mClass) + "::" + aFunction;
}

PlayerCc::mutex_t::scoped_lock MorseDevice::Lock(const char* aFunction) const {
  PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  // The name is put together only when it is needed: this is called for every beam.
  if (Core()->closed() || Core()->run_is_over()) {
    translated(Fun(aFunction).c_str(), [&] { Core()->require_usable(); });
  }
  Core()->note_look(/*has_data=*/true);
  return lock;
}

std::string MorseDevice::GetName() const {
  return Core()->info_of(DeviceId{mRobotIndex, mDeviceIndex}).name;
}

std::string MorseDevice::GetType() const {
  return Core()->info_of(DeviceId{mRobotIndex, mDeviceIndex}).type;
}

std::map<std::string, double> MorseDevice::GetProperties() const {
  return Core()->info_of(DeviceId{mRobotIndex, mDeviceIndex}).properties;
}

double MorseDevice::GetProperty(const char* aName, double aOtherwise) const {
  const auto& properties = Core()->info_of(DeviceId{mRobotIndex, mDeviceIndex}).properties;
  const auto it = properties.find(aName);
  return it == properties.end() ? aOtherwise : it->second;
}

// --- MorseSensor

struct MorseSensor::Receiver final : playerlike::ReadingListener {
  explicit Receiver(MorseSensor& owner) : sensor(owner) {}

  void on_reading(const sim::Reading& reading) override {
    time_s = sim::to_seconds(reading.time_ns);
    valid = true;
    fresh = true;
    sensor.HandleReading(reading);
  }
  void on_close() override { valid = false; }

  MorseSensor& sensor;
  double time_s = 0.0;
  bool valid = false;
  bool fresh = false;
};

MorseSensor::MorseSensor(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                         const char* aClass)
    : MorseDevice(aRobot, aName, aType, aClass), mReceiver(std::make_unique<Receiver>(*this)) {}

MorseSensor::~MorseSensor() { Detach(); }

void MorseSensor::Attach() {
  const PlayerCc::mutex_t::scoped_lock lock(Lock("Attach"));
  translated(Fun("Attach").c_str(), [&] {
    Core()->add(DeviceId{RobotIndex(), DeviceIndex()}, *mReceiver);
  });
}

void MorseSensor::Detach() { Core()->remove(*mReceiver); }

bool MorseSensor::IsValid() const {
  const PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  Core()->note_look(mReceiver->valid);
  return mReceiver->valid;
}

bool MorseSensor::IsFresh() const {
  const PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  Core()->note_look(mReceiver->valid);
  return mReceiver->fresh;
}

void MorseSensor::NotFresh() {
  const PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  mReceiver->fresh = false;
}

double MorseSensor::GetTime() const {
  const auto lock = Lock("GetTime");
  return mReceiver->time_s;
}

double MorseSensor::GetFrequency() const { return GetProperty("frequency", 0.0); }

// --- MorseActuator

MorseActuator::MorseActuator(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                             const char* aClass)
    : MorseDevice(aRobot, aName, aType, aClass) {}

MorseActuator::~MorseActuator() = default;

// --- MorsePose, MorseOdometry

MorseLocalization::MorseLocalization(const MorseRobot& aRobot, const std::string& aName,
                                     const char* aType, const char* aClass)
    : MorseSensor(aRobot, aName, aType, aClass), mPose(), mVelocity(), mStall(false) {
  Attach();
}

MorseLocalization::~MorseLocalization() { Detach(); }

void MorseLocalization::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::PoseReading*>(&aReading);
  if (reading == nullptr) return;
  mPose = {reading->pose.x_m, reading->pose.y_m, reading->pose.yaw_rad};
  mVelocity = {reading->twist.v_mps, reading->twist.lateral_mps, reading->twist.omega_radps};
  mStall = reading->stalled;
}

player_pose2d_t MorseLocalization::GetPose() const {
  const auto lock = Lock("GetPose");
  return mPose;
}
double MorseLocalization::GetX() const { return GetPose().px; }
double MorseLocalization::GetY() const { return GetPose().py; }
double MorseLocalization::GetYaw() const { return GetPose().pa; }

double MorseLocalization::GetSpeed() const {
  const auto lock = Lock("GetSpeed");
  return mVelocity.px;
}

double MorseLocalization::GetLateralSpeed() const {
  const auto lock = Lock("GetLateralSpeed");
  return mVelocity.py;
}

double MorseLocalization::GetTurnRate() const {
  const auto lock = Lock("GetTurnRate");
  return mVelocity.pa;
}

bool MorseLocalization::GetStall() const {
  const auto lock = Lock("GetStall");
  return mStall;
}

void MorseLocalization::SetPose(double aX, double aY, double aYaw) {
  const std::string fun = Fun("SetPose");
  playerlike::require_finite(fun.c_str(), {{"x", aX}, {"y", aY}, {"the heading", aYaw}});
  const auto lock = Lock("SetPose");
  translated(fun.c_str(), [&] {
    Core()->session().send(DeviceId{RobotIndex(), DeviceIndex()},
                           sim::SetPoseCommand{{aX, aY, sim::normalize_angle(aYaw)}});
  });
}

MorsePose::MorsePose(const MorseRobot& aRobot, const std::string& aName)
    : MorseLocalization(aRobot, aName, "pose", "MorsePose") {}
MorsePose::~MorsePose() = default;

MorseOdometry::MorseOdometry(const MorseRobot& aRobot, const std::string& aName)
    : MorseLocalization(aRobot, aName, "odometry", "MorseOdometry") {}
MorseOdometry::~MorseOdometry() = default;

// --- MorseLaser

MorseLaser::MorseLaser(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "laser", "MorseLaser"),
      mMinAngle(0.0),
      mResolution(GetProperty("resolution", 0.0)),
      mMaxRange(GetProperty("range_max", 0.0)) {
  // The simulated laser is symmetric about forward.
  mMinAngle = -0.5 * std::max(0.0, GetProperty("beams", 0.0) - 1.0) * mResolution;
  Attach();
}

MorseLaser::~MorseLaser() { Detach(); }

void MorseLaser::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::LaserReading*>(&aReading);
  if (reading == nullptr) return;
  mRanges = reading->ranges_m;
  mMinAngle = reading->angle_min_rad;
  mResolution = reading->resolution_rad;
  mMaxRange = reading->range_max_m;
}

double MorseLaser::Checked(uint32_t aIndex, const char* aFunction) const {
  if (aIndex >= mRanges.size()) {
    throw PlayerError(Fun(aFunction),
                      "there is no beam " + std::to_string(aIndex) + ": the scan has " +
                          std::to_string(mRanges.size()) + ", counted from 0",
                      PlayerError::kBadArgument);
  }
  return mRanges[aIndex];
}

uint32_t MorseLaser::GetCount() const {
  const auto lock = Lock("GetCount");
  return static_cast<uint32_t>(mRanges.size());
}

double MorseLaser::GetRange(uint32_t aIndex) const {
  const auto lock = Lock("GetRange");
  return Checked(aIndex, "GetRange");
}

double MorseLaser::operator[](uint32_t aIndex) const { return GetRange(aIndex); }

double MorseLaser::GetBearing(uint32_t aIndex) const {
  const auto lock = Lock("GetBearing");
  static_cast<void>(Checked(aIndex, "GetBearing"));
  return mMinAngle + aIndex * mResolution;
}

player_point_2d_t MorseLaser::GetPoint(uint32_t aIndex) const {
  const auto lock = Lock("GetPoint");
  const double range = Checked(aIndex, "GetPoint");
  const double bearing = mMinAngle + aIndex * mResolution;
  return {range * std::cos(bearing), range * std::sin(bearing)};
}

std::vector<double> MorseLaser::GetRanges() const {
  const auto lock = Lock("GetRanges");
  return mRanges;
}

double MorseLaser::GetMinAngle() const {
  const auto lock = Lock("GetMinAngle");
  return mMinAngle;
}

double MorseLaser::GetMaxAngle() const {
  const auto lock = Lock("GetMaxAngle");
  const double beams =
      mRanges.empty() ? GetProperty("beams", 1.0) : static_cast<double>(mRanges.size());
  return mMinAngle + (beams - 1.0) * mResolution;
}

double MorseLaser::GetResolution() const {
  const auto lock = Lock("GetResolution");
  return mResolution;
}

double MorseLaser::GetMaxRange() const {
  const auto lock = Lock("GetMaxRange");
  return mMaxRange;
}

double MorseLaser::GetLeastRange() const {
  const auto lock = Lock("GetLeastRange");
  if (mRanges.empty()) return mMaxRange;
  return *std::min_element(mRanges.begin(), mRanges.end());
}

double MorseLaser::GetLeastAngle() const {
  const auto lock = Lock("GetLeastAngle");
  if (mRanges.empty()) return 0.0;
  const auto least = std::min_element(mRanges.begin(), mRanges.end());
  return mMinAngle + static_cast<double>(least - mRanges.begin()) * mResolution;
}

player_pose2d_t MorseLaser::GetMountPose() const {
  return {GetProperty("mount_x", 0.0), GetProperty("mount_y", 0.0), GetProperty("mount_yaw", 0.0)};
}

// --- MorseCollision

MorseCollision::MorseCollision(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "collision", "MorseCollision"), mCollision(false) {
  Attach();
}

MorseCollision::~MorseCollision() { Detach(); }

void MorseCollision::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::CollisionReading*>(&aReading);
  if (reading == nullptr) return;
  mCollision = reading->collision;
  mObjects = reading->objects;
}

bool MorseCollision::GetCollision() const {
  const auto lock = Lock("GetCollision");
  return mCollision;
}

std::vector<std::string> MorseCollision::GetObjects() const {
  const auto lock = Lock("GetObjects");
  return mObjects;
}

bool MorseCollision::Touches(const std::string& aName) const {
  const auto lock = Lock("Touches");
  return std::find(mObjects.begin(), mObjects.end(), aName) != mObjects.end();
}

// --- MorseBattery

MorseBattery::MorseBattery(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "battery", "MorseBattery"),
      mCharge(0.0),
      mVoltage(0.0),
      mEnergy(0.0),
      mDocked(false) {
  Attach();
}

MorseBattery::~MorseBattery() { Detach(); }

void MorseBattery::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::BatteryReading*>(&aReading);
  if (reading == nullptr) return;
  mCharge = reading->charge_percent;
  mVoltage = reading->voltage_v;
  mEnergy = reading->energy_wh;
  mStatus = std::string(sim::to_string(reading->status));
  mDocked = reading->status != sim::BatteryStatus::kDischarging;
}

double MorseBattery::GetCharge() const {
  const auto lock = Lock("GetCharge");
  return mCharge;
}

double MorseBattery::GetVoltage() const {
  const auto lock = Lock("GetVoltage");
  return mVoltage;
}

double MorseBattery::GetEnergy() const {
  const auto lock = Lock("GetEnergy");
  return mEnergy;
}

double MorseBattery::GetCapacity() const { return GetProperty("capacity", 0.0); }

std::string MorseBattery::GetStatus() const {
  const auto lock = Lock("GetStatus");
  return mStatus;
}

bool MorseBattery::IsDocked() const {
  const auto lock = Lock("IsDocked");
  return mDocked;
}

// --- MorseProximity

MorseProximity::MorseProximity(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "proximity", "MorseProximity") {
  Attach();
}

MorseProximity::~MorseProximity() { Detach(); }

void MorseProximity::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::ProximityReading*>(&aReading);
  if (reading == nullptr) return;
  mNear.clear();
  // Of one name the nearer comes first, and stays.
  for (const auto& neighbour : reading->near_objects) {
    mNear.emplace(neighbour.name, neighbour.distance_m);
  }
}

std::map<std::string, double> MorseProximity::GetNearObjects() const {
  const auto lock = Lock("GetNearObjects");
  return mNear;
}

bool MorseProximity::IsNear(const std::string& aName) const {
  const auto lock = Lock("IsNear");
  return mNear.count(aName) > 0;
}

double MorseProximity::GetDistance(const std::string& aName) const {
  const auto lock = Lock("GetDistance");
  const auto it = mNear.find(aName);
  if (it != mNear.end()) return it->second;
  std::string known;
  for (const auto& [name, distance] : mNear) known += (known.empty() ? "" : ", ") + name;
  throw PlayerError(Fun("GetDistance"),
                    "\"" + aName + "\" is not near; near are: " + (known.empty() ? "none" : known),
                    PlayerError::kBadArgument);
}

double MorseProximity::GetMaxRange() const { return GetProperty("range", 0.0); }

// --- MorseInfrared, MorseSonar

MorseRanger::MorseRanger(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                         const char* aClass)
    : MorseSensor(aRobot, aName, aType, aClass) {
  // What a server says is not believed without bounds.
  const auto count = static_cast<std::size_t>(
      std::clamp(GetProperty("count", 0.0), 0.0, double{sim::RangerParams::kMaxTransducers}));
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    mMounts.push_back({GetProperty(("mount_x_" + number).c_str(), 0.0),
                       GetProperty(("mount_y_" + number).c_str(), 0.0),
                       GetProperty(("mount_yaw_" + number).c_str(), 0.0)});
  }
  mRanges.assign(count, GetProperty("range_max", 0.0));
  Attach();
}

MorseRanger::~MorseRanger() { Detach(); }

void MorseRanger::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::RangerReading*>(&aReading);
  if (reading == nullptr) return;
  mRanges = reading->ranges_m;
}

std::size_t MorseRanger::Checked(uint32_t aIndex, const char* aFunction) const {
  const std::size_t count = std::min(mRanges.size(), mMounts.size());
  if (aIndex >= count) {
    throw PlayerError(Fun(aFunction),
                      "there is no transducer " + std::to_string(aIndex) + ": the device has " +
                          std::to_string(count) + ", counted from 0",
                      PlayerError::kBadArgument);
  }
  return aIndex;
}

uint32_t MorseRanger::GetCount() const {
  const auto lock = Lock("GetCount");
  return static_cast<uint32_t>(mRanges.size());
}

double MorseRanger::GetRange(uint32_t aIndex) const {
  const auto lock = Lock("GetRange");
  return mRanges[Checked(aIndex, "GetRange")];
}

double MorseRanger::operator[](uint32_t aIndex) const { return GetRange(aIndex); }

std::vector<double> MorseRanger::GetRanges() const {
  const auto lock = Lock("GetRanges");
  return mRanges;
}

player_pose2d_t MorseRanger::GetMountPose(uint32_t aIndex) const {
  const auto lock = Lock("GetMountPose");
  return mMounts[Checked(aIndex, "GetMountPose")];
}

player_point_2d_t MorseRanger::GetPoint(uint32_t aIndex) const {
  const auto lock = Lock("GetPoint");
  const std::size_t i = Checked(aIndex, "GetPoint");
  const player_pose2d_t& mount = mMounts[i];
  return {mount.px + mRanges[i] * std::cos(mount.pa), mount.py + mRanges[i] * std::sin(mount.pa)};
}

double MorseRanger::GetMaxRange() const { return GetProperty("range_max", 0.0); }

double MorseRanger::GetFieldOfView() const { return GetProperty("field_of_view", 0.0); }

double MorseRanger::GetLeastRange() const {
  const auto lock = Lock("GetLeastRange");
  if (mRanges.empty()) return GetProperty("range_max", 0.0);
  return *std::min_element(mRanges.begin(), mRanges.end());
}

uint32_t MorseRanger::GetLeastIndex() const {
  const auto lock = Lock("GetLeastIndex");
  const auto least = std::min_element(mRanges.begin(), mRanges.end());
  return static_cast<uint32_t>(least - mRanges.begin());
}

MorseInfrared::MorseInfrared(const MorseRobot& aRobot, const std::string& aName)
    : MorseRanger(aRobot, aName, "infrared", "MorseInfrared") {}
MorseInfrared::~MorseInfrared() = default;

MorseSonar::MorseSonar(const MorseRobot& aRobot, const std::string& aName)
    : MorseRanger(aRobot, aName, "sonar", "MorseSonar") {}
MorseSonar::~MorseSonar() = default;

// --- MorseMotionVW

MorseMotionVW::MorseMotionVW(const MorseRobot& aRobot, const std::string& aName)
    : MorseActuator(aRobot, aName, "motion", "MorseMotionVW") {}
MorseMotionVW::~MorseMotionVW() = default;

void MorseMotionVW::SetSpeed(double aSpeed, double aTurnRate) {
  const char* fun = "MorseMotionVW::SetSpeed";
  playerlike::require_finite(fun, {{"the forward speed", aSpeed}, {"the turn rate", aTurnRate}});
  const auto lock = Lock("SetSpeed");
  translated(fun, [&] {
    Core()->session().send(DeviceId{RobotIndex(), DeviceIndex()},
                           sim::TwistCommand{{aSpeed, aTurnRate}});
  });
}

void MorseMotionVW::Stop() { SetSpeed(0.0, 0.0); }

void MorseMotionVW::SetMotorEnable(bool aEnable) {
  const auto lock = Lock("SetMotorEnable");
  translated("MorseMotionVW::SetMotorEnable", [&] {
    Core()->session().send(DeviceId{RobotIndex(), DeviceIndex()}, sim::MotorEnableCommand{aEnable});
  });
}

double MorseMotionVW::GetMaxSpeed() const {
  return std::min(GetRobot().GetMaxSpeed(), GetProperty("max_speed", GetRobot().GetMaxSpeed()));
}

double MorseMotionVW::GetMaxTurnRate() const {
  return std::min(GetRobot().GetMaxTurnRate(),
                  GetProperty("max_turn_rate", GetRobot().GetMaxTurnRate()));
}

// --- MorsePen

MorsePen::MorsePen(const MorseRobot& aRobot, const std::string& aName)
    : MorseActuator(aRobot, aName, "pen", "MorsePen"), CanvasDrawing(aRobot.mCore, "MorsePen") {
  const sim::Colour& c = aRobot.mCore->robots().at(aRobot.mIndex).colour;
  SetMarkColour(ImageColour_t(c.r, c.g, c.b, c.a));
}

MorsePen::~MorsePen() = default;

}  // namespace CCMorse
