// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "libCCMorse/MorseGps.h"
#include "libCCMorse/MorseImu.h"
#include "sim/devices/gps.h"
#include "sim/devices/imu.h"

namespace CCMorse {
namespace {

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

}  // namespace

// --- MorseGps

MorseGps::MorseGps(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "gps", "MorseGps"),
      mLatitude(0.0),
      mLongitude(0.0),
      mAltitude(0.0),
      mVelocity(0.0),
      mHeading(0.0),
      mFix(false) {
  Attach();
}

MorseGps::~MorseGps() { Detach(); }

void MorseGps::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::GpsReading*>(&aReading);
  if (reading == nullptr) return;
  mLatitude = degrees(reading->latitude_rad);
  mLongitude = degrees(reading->longitude_rad);
  mAltitude = reading->altitude_m;
  mVelocity = reading->speed_mps;
  mHeading = degrees(reading->course_rad);
  mFix = reading->quality > 0;
}

double MorseGps::GetLatitude() const {
  const auto lock = Lock("GetLatitude");
  return mLatitude;
}

double MorseGps::GetLongitude() const {
  const auto lock = Lock("GetLongitude");
  return mLongitude;
}

double MorseGps::GetAltitude() const {
  const auto lock = Lock("GetAltitude");
  return mAltitude;
}

double MorseGps::GetVelocity() const {
  const auto lock = Lock("GetVelocity");
  return mVelocity;
}

double MorseGps::GetHeading() const {
  const auto lock = Lock("GetHeading");
  return mHeading;
}

bool MorseGps::HasFix() const {
  const auto lock = Lock("HasFix");
  return mFix;
}

// --- MorseImu

MorseImu::MorseImu(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "imu", "MorseImu"), mRate{}, mAcceleration{}, mField{}, mYaw(0.0) {
  Attach();
}

MorseImu::~MorseImu() { Detach(); }

void MorseImu::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::ImuReading*>(&aReading);
  if (reading == nullptr) return;
  mRate = reading->rate_radps;
  mAcceleration = reading->acceleration_mps2;
  mField = reading->field_ut;
  mYaw = reading->yaw_rad;
}

std::array<double, 3> MorseImu::GetAngularVelocity() const {
  const auto lock = Lock("GetAngularVelocity");
  return mRate;
}

std::array<double, 3> MorseImu::GetLinearAcceleration() const {
  const auto lock = Lock("GetLinearAcceleration");
  return mAcceleration;
}

std::array<double, 3> MorseImu::GetMagneticField() const {
  const auto lock = Lock("GetMagneticField");
  return mField;
}

double MorseImu::GetYaw() const {
  const auto lock = Lock("GetYaw");
  return mYaw;
}

}  // namespace CCMorse
