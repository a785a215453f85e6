// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/client_core.h"
#include "core/errors.h"
#include "devices/morse_receiver.h"
#include "libCCMorse/MorseGripper.h"
#include "sim/devices/gripper.h"

namespace CCMorse {

using sim::GripperReading;

using Action = sim::GripCommand::Action;

MorseGripper::MorseGripper(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "gripper", "MorseGripper") {
  Attach();
}

MorseGripper::~MorseGripper() { Detach(); }

void MorseGripper::Open() {
  const auto lock = Lock("Open");
  Core()->send("MorseGripper::Open", {RobotIndex(), DeviceIndex()},
               sim::GripCommand{Action::kOpen});
}

void MorseGripper::Close() {
  const auto lock = Lock("Close");
  Core()->send("MorseGripper::Close", {RobotIndex(), DeviceIndex()},
               sim::GripCommand{Action::kClose});
}

void MorseGripper::Stop() {
  const auto lock = Lock("Stop");
  Core()->send("MorseGripper::Stop", {RobotIndex(), DeviceIndex()},
               sim::GripCommand{Action::kStop});
}

void MorseGripper::Store() {
  const auto lock = Lock("Store");
  Core()->send("MorseGripper::Store", {RobotIndex(), DeviceIndex()},
               sim::GripCommand{Action::kStore});
}

void MorseGripper::Retrieve() {
  const auto lock = Lock("Retrieve");
  Core()->send("MorseGripper::Retrieve", {RobotIndex(), DeviceIndex()},
               sim::GripCommand{Action::kRetrieve});
}

std::string MorseGripper::GetStatus() const {
  const auto lock = Lock("GetStatus");
  const auto* reading = mReceiver->newest.find<GripperReading>();
  return reading == nullptr ? "" : std::string(sim::to_string(reading->state));
}

bool MorseGripper::IsHolding() const { return Look("IsHolding", &GripperReading::holding); }

bool MorseGripper::IsOuterBeamBroken() const {
  return Look("IsOuterBeamBroken", &GripperReading::outer_beam);
}

bool MorseGripper::IsInnerBeamBroken() const {
  return Look("IsInnerBeamBroken", &GripperReading::inner_beam);
}

int MorseGripper::GetStored() const { return Look("GetStored", &GripperReading::stored); }

int MorseGripper::GetCapacity() const { return static_cast<int>(GetProperty("capacity", 0.0)); }

double MorseGripper::GetGap() const { return Look("GetGap", &GripperReading::gap_m); }

double MorseGripper::GetOpening() const { return GetProperty("opening", 0.0); }

}  // namespace CCMorse
