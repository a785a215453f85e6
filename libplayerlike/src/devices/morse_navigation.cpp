// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "devices/morse_receiver.h"
#include "libCCMorse/MorseGps.h"
#include "libCCMorse/MorseImu.h"
#include "sim/devices/gps.h"
#include "sim/devices/imu.h"

namespace CCMorse {

using sim::GpsReading;
using sim::ImuReading;

namespace {

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

}  // namespace

// --- MorseGps

MorseGps::MorseGps(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "gps", "MorseGps") {
  Attach();
}

MorseGps::~MorseGps() { Detach(); }

double MorseGps::GetLatitude() const {
  return degrees(Look("GetLatitude", &GpsReading::latitude_rad));
}

double MorseGps::GetLongitude() const {
  return degrees(Look("GetLongitude", &GpsReading::longitude_rad));
}

double MorseGps::GetAltitude() const { return Look("GetAltitude", &GpsReading::altitude_m); }
double MorseGps::GetVelocity() const { return Look("GetVelocity", &GpsReading::speed_mps); }
double MorseGps::GetHeading() const { return degrees(Look("GetHeading", &GpsReading::course_rad)); }
bool MorseGps::HasFix() const { return Look("HasFix", &GpsReading::quality) > 0; }

// --- MorseImu

MorseImu::MorseImu(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "imu", "MorseImu") {
  Attach();
}

MorseImu::~MorseImu() { Detach(); }

std::array<double, 3> MorseImu::GetAngularVelocity() const {
  return Look("GetAngularVelocity", &ImuReading::rate_radps);
}

std::array<double, 3> MorseImu::GetLinearAcceleration() const {
  return Look("GetLinearAcceleration", &ImuReading::acceleration_mps2);
}

std::array<double, 3> MorseImu::GetMagneticField() const {
  return Look("GetMagneticField", &ImuReading::field_ut);
}

double MorseImu::GetYaw() const { return Look("GetYaw", &ImuReading::yaw_rad); }

}  // namespace CCMorse
