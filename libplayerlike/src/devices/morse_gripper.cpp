// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "devices/client_core.h"
#include "devices/errors.h"
#include "devices/morse_receiver.h"
#include "libCCMorse/MorseGripper.h"
#include "sim/devices/gripper.h"

namespace CCMorse {

using sim::GripperReading;

namespace {

using Action = sim::GripCommand::Action;

void send(playerlike::ClientCore& core, const char* fun, playerlike::DeviceId device,
          Action action) {
  playerlike::translated(fun, [&] { core.session().send(device, sim::GripCommand{action}); });
}

}  // namespace

MorseGripper::MorseGripper(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "gripper", "MorseGripper") {
  Attach();
}

MorseGripper::~MorseGripper() { Detach(); }

void MorseGripper::Open() {
  const auto lock = Lock("Open");
  send(*Core(), "MorseGripper::Open", {RobotIndex(), DeviceIndex()}, Action::kOpen);
}

void MorseGripper::Close() {
  const auto lock = Lock("Close");
  send(*Core(), "MorseGripper::Close", {RobotIndex(), DeviceIndex()}, Action::kClose);
}

void MorseGripper::Stop() {
  const auto lock = Lock("Stop");
  send(*Core(), "MorseGripper::Stop", {RobotIndex(), DeviceIndex()}, Action::kStop);
}

void MorseGripper::Store() {
  const auto lock = Lock("Store");
  send(*Core(), "MorseGripper::Store", {RobotIndex(), DeviceIndex()}, Action::kStore);
}

void MorseGripper::Retrieve() {
  const auto lock = Lock("Retrieve");
  send(*Core(), "MorseGripper::Retrieve", {RobotIndex(), DeviceIndex()}, Action::kRetrieve);
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
