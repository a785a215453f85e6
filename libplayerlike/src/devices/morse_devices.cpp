// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "core/client_core.h"
#include "core/errors.h"
#include "devices/morse_receiver.h"
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
#include "sim/core/math.h"
#include "sim/devices/battery.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/proximity.h"
#include "sim/devices/rangers.h"
#include "sim/world/limits.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::DeviceId;
using playerlike::DeviceInfo;
using playerlike::translated;
using sim::BatteryReading;
using sim::LaserReading;
using sim::PoseReading;
using sim::RangerReading;

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

PlayerCc::mutex_t::scoped_lock MorseDevice::Lock(const char* aFunction, int aLooks) const {
  PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  // Builds the function's name only for an error.
  if (!Core()->usable()) translated(Fun(aFunction).c_str(), [&] { Core()->require_usable(); });
  Core()->count_data_reads(aLooks, /*has_data=*/true);
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

void MorseSensor::Receiver::on_reading(const sim::SharedReading& reading) {
  time_s = sim::to_seconds(reading->time_ns);
  newest.valid = true;
  fresh = true;
  newest.reading = reading;
  playerlike::show_elements(sensor.mElements, newest);
  sensor.HandleReading();
}

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

void MorseSensor::HandleReading() {}

void MorseSensor::Detach() { Core()->remove(*mReceiver); }

bool MorseSensor::IsValid() const {
  const PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  Core()->count_data_reads(1, mReceiver->newest.valid);
  return mReceiver->newest.valid;
}

bool MorseSensor::IsFresh() const {
  const PlayerCc::mutex_t::scoped_lock lock(Core()->mutex());
  Core()->count_data_reads(1, mReceiver->newest.valid);
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
    : MorseSensor(aRobot, aName, aType, aClass) {
  Attach();
}

MorseLocalization::~MorseLocalization() { Detach(); }

player_pose2d_t MorseLocalization::GetPose() const {
  const sim::Pose pose = Look("GetPose", &PoseReading::pose);
  return {pose.x_m, pose.y_m, pose.yaw_rad};
}
double MorseLocalization::GetX() const { return GetPose().px; }
double MorseLocalization::GetY() const { return GetPose().py; }
double MorseLocalization::GetYaw() const { return GetPose().pa; }

double MorseLocalization::GetSpeed() const { return Look("GetSpeed", &PoseReading::twist).v_mps; }

double MorseLocalization::GetLateralSpeed() const {
  return Look("GetLateralSpeed", &PoseReading::twist).lateral_mps;
}

double MorseLocalization::GetTurnRate() const {
  return Look("GetTurnRate", &PoseReading::twist).omega_radps;
}

bool MorseLocalization::GetStall() const { return Look("GetStall", &PoseReading::stalled); }

void MorseLocalization::SetPose(double aX, double aY, double aYaw) {
  const std::string fun = Fun("SetPose");
  playerlike::require_finite(fun.c_str(), {{"x", aX}, {"y", aY}, {"the heading", aYaw}});
  const auto lock = Lock("SetPose");
  Core()->send(fun.c_str(), {RobotIndex(), DeviceIndex()},
               sim::SetPoseCommand{{aX, aY, sim::normalize_angle(aYaw)}});
}

MorsePose::MorsePose(const MorseRobot& aRobot, const std::string& aName)
    : MorseLocalization(aRobot, aName, "pose", "MorsePose") {}
MorsePose::~MorsePose() = default;

MorseOdometry::MorseOdometry(const MorseRobot& aRobot, const std::string& aName)
    : MorseLocalization(aRobot, aName, "odometry", "MorseOdometry") {}
MorseOdometry::~MorseOdometry() = default;

// --- MorseLaser

namespace {

uint32_t count_of(const LaserReading& scan) { return static_cast<uint32_t>(scan.ranges_m.size()); }

}  // namespace

MorseLaser::MorseLaser(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "laser", "MorseLaser") {
  const auto announced = std::make_shared<LaserReading>();
  announced->resolution_rad = GetProperty("resolution", 0.0);
  announced->range_max_m = GetProperty("range_max", 0.0);
  // The simulated laser is symmetric about forward.
  announced->angle_min_rad =
      -0.5 * std::max(0.0, GetProperty("beams", 0.0) - 1.0) * announced->resolution_rad;
  mReceiver->newest.reading = announced;
  Attach();
}

MorseLaser::~MorseLaser() { Detach(); }

void MorseLaser::Check(uint32_t aIndex, uint32_t aCount, const char* aFunction) const {
  if (aIndex < aCount) return;
  playerlike::refuse(Fun(aFunction), "there is no beam " + std::to_string(aIndex) +
                                         ": the scan has " + std::to_string(aCount) +
                                         ", counted from 0");
}

uint32_t MorseLaser::GetCount() const { return Look<LaserReading>("GetCount", count_of); }

double MorseLaser::LockedRange(uint32_t aIndex) const {
  const auto lock = mReceiver->lock_element("GetRange");
  const auto& scan = mReceiver->newest.as<LaserReading>();
  Check(aIndex, count_of(scan), "GetRange");
  return scan.ranges_m[aIndex];
}

double MorseLaser::GetBearing(uint32_t aIndex) const {
  return Look<LaserReading>("GetBearing", [&](const auto& scan) {
    Check(aIndex, count_of(scan), "GetBearing");
    return scan.angle_min_rad + aIndex * scan.resolution_rad;
  });
}

player_point_2d_t MorseLaser::GetPoint(uint32_t aIndex) const {
  return Look<LaserReading>("GetPoint", [&](const auto& scan) -> player_point_2d_t {
    Check(aIndex, count_of(scan), "GetPoint");
    const double range = scan.ranges_m[aIndex];
    const double bearing = scan.angle_min_rad + aIndex * scan.resolution_rad;
    return {range * sim::math::cos(bearing), range * sim::math::sin(bearing)};
  });
}

std::vector<double> MorseLaser::GetRanges() const {
  return Look("GetRanges", &LaserReading::ranges_m);
}

double MorseLaser::GetMinAngle() const { return Look("GetMinAngle", &LaserReading::angle_min_rad); }

double MorseLaser::GetMaxAngle() const {
  return Look<LaserReading>("GetMaxAngle", [this](const auto& scan) {
    const double beams =
        scan.ranges_m.empty() ? GetProperty("beams", 1.0) : static_cast<double>(count_of(scan));
    return scan.angle_min_rad + (beams - 1.0) * scan.resolution_rad;
  });
}

double MorseLaser::GetResolution() const {
  return Look("GetResolution", &LaserReading::resolution_rad);
}

double MorseLaser::GetMaxRange() const { return Look("GetMaxRange", &LaserReading::range_max_m); }

double MorseLaser::GetLeastRange() const {
  return Look<LaserReading>("GetLeastRange", [](const auto& scan) { return scan.least_range_m(); });
}

double MorseLaser::GetLeastAngle() const {
  return Look<LaserReading>("GetLeastAngle",
                            [](const auto& scan) { return scan.least_angle_rad(); });
}

player_pose2d_t MorseLaser::GetMountPose() const {
  return {GetProperty("mount_x", 0.0), GetProperty("mount_y", 0.0), GetProperty("mount_yaw", 0.0)};
}

// --- MorseCollision

MorseCollision::MorseCollision(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "collision", "MorseCollision") {
  Attach();
}

MorseCollision::~MorseCollision() { Detach(); }

bool MorseCollision::GetCollision() const {
  return Look("GetCollision", &sim::CollisionReading::collision);
}

std::vector<std::string> MorseCollision::GetObjects() const {
  return Look("GetObjects", &sim::CollisionReading::objects);
}

bool MorseCollision::Touches(const std::string& aName) const {
  const std::vector<std::string> objects = Look("Touches", &sim::CollisionReading::objects);
  return std::find(objects.begin(), objects.end(), aName) != objects.end();
}

// --- MorseBattery

MorseBattery::MorseBattery(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "battery", "MorseBattery") {
  Attach();
}

MorseBattery::~MorseBattery() { Detach(); }

double MorseBattery::GetCharge() const {
  return Look("GetCharge", &BatteryReading::charge_percent);
}
double MorseBattery::GetVoltage() const { return Look("GetVoltage", &BatteryReading::voltage_v); }
double MorseBattery::GetEnergy() const { return Look("GetEnergy", &BatteryReading::energy_wh); }
double MorseBattery::GetCapacity() const { return GetProperty("capacity", 0.0); }

std::string MorseBattery::GetStatus() const {
  const auto lock = Lock("GetStatus");
  const auto* reading = mReceiver->newest.find<BatteryReading>();
  return reading == nullptr ? "" : std::string(sim::to_string(reading->status));
}

bool MorseBattery::IsDocked() const {
  return Look("IsDocked", &BatteryReading::status) != sim::BatteryStatus::kDischarging;
}

// --- MorseProximity

namespace {

// If several neighbours have one name, emplace() keeps the nearest, which comes first.
std::map<std::string, double> distances(const sim::ProximityReading& reading) {
  std::map<std::string, double> near;
  for (const auto& neighbour : reading.near_objects) {
    near.emplace(neighbour.name, neighbour.distance_m);
  }
  return near;
}

}  // namespace

MorseProximity::MorseProximity(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "proximity", "MorseProximity") {
  Attach();
}

MorseProximity::~MorseProximity() { Detach(); }

std::map<std::string, double> MorseProximity::GetNearObjects() const {
  return Look<sim::ProximityReading>("GetNearObjects", distances);
}

bool MorseProximity::IsNear(const std::string& aName) const {
  return Look<sim::ProximityReading>("IsNear", distances).count(aName) > 0;
}

double MorseProximity::GetDistance(const std::string& aName) const {
  const auto near = Look<sim::ProximityReading>("GetDistance", distances);
  const auto it = near.find(aName);
  if (it != near.end()) return it->second;
  std::string known;
  for (const auto& [name, distance] : near) known += (known.empty() ? "" : ", ") + name;
  playerlike::refuse(Fun("GetDistance"), "\"" + aName + "\" is not near; near are: " +
                                             (known.empty() ? "none" : known));
}

double MorseProximity::GetMaxRange() const { return GetProperty("range", 0.0); }

// --- MorseInfrared, MorseSonar

MorseRanger::MorseRanger(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                         const char* aClass)
    : MorseSensor(aRobot, aName, aType, aClass) {
  // Bounds the value that a server sends.
  const auto count = static_cast<std::size_t>(
      std::clamp(GetProperty("count", 0.0), 0.0, double{sim::kMostTransducers}));
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    mMounts.push_back({GetProperty(("mount_x_" + number).c_str(), 0.0),
                       GetProperty(("mount_y_" + number).c_str(), 0.0),
                       GetProperty(("mount_yaw_" + number).c_str(), 0.0)});
  }
  const auto announced = std::make_shared<RangerReading>();
  announced->ranges_m.assign(count, GetProperty("range_max", 0.0));
  mReceiver->newest.reading = announced;
  Attach();
}

MorseRanger::~MorseRanger() { Detach(); }

// The range of a transducer; throws if there is none. The client's mutex is held.
double MorseRanger::Checked(uint32_t aIndex, const char* aFunction) const {
  const std::vector<double>& ranges = mReceiver->newest.as<RangerReading>().ranges_m;
  const std::size_t count = std::min(ranges.size(), mMounts.size());
  if (aIndex >= count) {
    playerlike::refuse(Fun(aFunction), "there is no transducer " + std::to_string(aIndex) +
                                           ": the device has " + std::to_string(count) +
                                           ", counted from 0");
  }
  return ranges[aIndex];
}

uint32_t MorseRanger::GetCount() const {
  return static_cast<uint32_t>(Look("GetCount", &RangerReading::ranges_m).size());
}

double MorseRanger::GetRange(uint32_t aIndex) const {
  const auto lock = Lock("GetRange");
  return Checked(aIndex, "GetRange");
}

double MorseRanger::operator[](uint32_t aIndex) const { return GetRange(aIndex); }

std::vector<double> MorseRanger::GetRanges() const {
  return Look("GetRanges", &RangerReading::ranges_m);
}

player_pose2d_t MorseRanger::GetMountPose(uint32_t aIndex) const {
  const auto lock = Lock("GetMountPose");
  static_cast<void>(Checked(aIndex, "GetMountPose"));
  return mMounts[aIndex];
}

player_point_2d_t MorseRanger::GetPoint(uint32_t aIndex) const {
  const auto lock = Lock("GetPoint");
  const double range = Checked(aIndex, "GetPoint");
  const player_pose2d_t& mount = mMounts[aIndex];
  return {mount.px + range * sim::math::cos(mount.pa), mount.py + range * sim::math::sin(mount.pa)};
}

double MorseRanger::GetMaxRange() const { return GetProperty("range_max", 0.0); }

double MorseRanger::GetFieldOfView() const { return GetProperty("field_of_view", 0.0); }

double MorseRanger::GetLeastRange() const {
  const std::vector<double> ranges = GetRanges();
  if (ranges.empty()) return GetMaxRange();
  return *std::min_element(ranges.begin(), ranges.end());
}

uint32_t MorseRanger::GetLeastIndex() const {
  const std::vector<double> ranges = GetRanges();
  const auto least = std::min_element(ranges.begin(), ranges.end());
  return static_cast<uint32_t>(least - ranges.begin());
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
  Core()->send(fun, {RobotIndex(), DeviceIndex()},
               sim::TwistCommand{{.v_mps = aSpeed, .omega_radps = aTurnRate}});
}

void MorseMotionVW::Stop() { SetSpeed(0.0, 0.0); }

void MorseMotionVW::SetMotorEnable(bool aEnable) {
  const auto lock = Lock("SetMotorEnable");
  Core()->send("MorseMotionVW::SetMotorEnable", {RobotIndex(), DeviceIndex()},
               sim::MotorEnableCommand{aEnable});
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
