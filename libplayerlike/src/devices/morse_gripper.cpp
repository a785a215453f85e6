// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "devices/client_core.h"
#include "devices/errors.h"
#include "libCCMorse/MorseGripper.h"
#include "sim/devices/gripper.h"

namespace CCMorse {
namespace {

using Action = sim::GripCommand::Action;

void send(playerlike::ClientCore& core, const char* fun, playerlike::DeviceId device,
          Action action) {
  playerlike::translated(fun, [&] { core.session().send(device, sim::GripCommand{action}); });
}

}  // namespace

MorseGripper::MorseGripper(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "gripper", "MorseGripper"),
      mHolding(false),
      mOuterBeam(false),
      mInnerBeam(false),
      mStored(0),
      mGap(0.0) {
  Attach();
}

MorseGripper::~MorseGripper() { Detach(); }

void MorseGripper::HandleReading(const sim::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::GripperReading*>(&aReading);
  if (reading == nullptr) return;
  mStatus = std::string(sim::to_string(reading->state));
  mHolding = reading->holding;
  mOuterBeam = reading->outer_beam;
  mInnerBeam = reading->inner_beam;
  mStored = reading->stored;
  mGap = reading->gap_m;
}

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
  return mStatus;
}

bool MorseGripper::IsHolding() const {
  const auto lock = Lock("IsHolding");
  return mHolding;
}

bool MorseGripper::IsOuterBeamBroken() const {
  const auto lock = Lock("IsOuterBeamBroken");
  return mOuterBeam;
}

bool MorseGripper::IsInnerBeamBroken() const {
  const auto lock = Lock("IsInnerBeamBroken");
  return mInnerBeam;
}

int MorseGripper::GetStored() const {
  const auto lock = Lock("GetStored");
  return mStored;
}

int MorseGripper::GetCapacity() const { return static_cast<int>(GetProperty("capacity", 0.0)); }

double MorseGripper::GetGap() const {
  const auto lock = Lock("GetGap");
  return mGap;
}

double MorseGripper::GetOpening() const { return GetProperty("opening", 0.0); }

}  // namespace CCMorse
