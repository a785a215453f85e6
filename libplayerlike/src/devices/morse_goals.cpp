// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/client_core.h"
#include "core/errors.h"
#include "devices/morse_receiver.h"
#include "libCCMorse/MorseTeleport.h"
#include "libCCMorse/MorseWaypoint.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/devices/waypoint.h"

namespace CCMorse {

using playerlike::DeviceId;
using playerlike::require_finite;
using playerlike::translated;

// --- MorseWaypoint

namespace {

void require_positive(const char* fun, const char* what, double value) {
  if (value > 0.0) return;
  playerlike::refuse(
      fun, std::string(what) + " must be greater than 0, not " + sim::rounded_text(value, 6));
}

}  // namespace

MorseWaypoint::MorseWaypoint(const MorseRobot& aRobot, const std::string& aName)
    : MorseSensor(aRobot, aName, "waypoint", "MorseWaypoint"),
      mStatus(sim::to_string(sim::WaypointStatus::kArrived)),
      mOrderTime(-1.0),
      mDistance(0.0),
      mGoalNumber(0) {
  const sim::Pose& start = Core()->robots().at(static_cast<std::size_t>(RobotIndex())).initial_pose;
  mPosition = {start.x_m, start.y_m};
  mGoal = mPosition;
  Attach();
}

MorseWaypoint::~MorseWaypoint() { Detach(); }

void MorseWaypoint::HandleReading() {
  const auto* reading = mReceiver->newest.find<sim::WaypointReading>();
  if (reading == nullptr) return;
  mPosition = {reading->position_m.x(), reading->position_m.y()};
  mGoalNumber = static_cast<uint32_t>(reading->goal_number);
  if (sim::to_seconds(reading->time_ns) <= mOrderTime) return;
  mStatus = sim::to_string(reading->status);
  mGoal = {reading->goal_m.x(), reading->goal_m.y()};
  mDistance = reading->distance_m;
}

void MorseWaypoint::Ordered(const char* aStatus) {
  mStatus = aStatus;
  mOrderTime = sim::to_seconds(Core()->session().request(playerlike::TimeRequest{}).sim_time_ns);
  mDistance = sim::math::hypot(mGoal.px - mPosition.px, mGoal.py - mPosition.py);
}

void MorseWaypoint::Goto(double aX, double aY, double aTolerance, double aSpeed) {
  const char* fun = "MorseWaypoint::Goto";
  require_finite(fun, {{"x", aX}, {"y", aY}, {"the tolerance", aTolerance}, {"the speed", aSpeed}});
  require_positive(fun, "the tolerance", aTolerance);
  require_positive(fun, "the speed", aSpeed);
  const auto lock = Lock("Goto");
  translated(fun, [&] {
    Core()->session().send(DeviceId{RobotIndex(), DeviceIndex()},
                           sim::GotoCommand{{aX, aY}, aTolerance, aSpeed});
    mGoal = {aX, aY};
    Ordered("Transit");
  });
}

void MorseWaypoint::Goto(double aX, double aY) { Goto(aX, aY, GetTolerance(), GetSpeed()); }

bool MorseWaypoint::SetDest(double aX, double aY, double aTolerance, double aSpeed) {
  {
    const auto lock = Lock("SetDest");
    if (sim::math::hypot(aX - mPosition.px, aY - mPosition.py) <= aTolerance) return false;
  }
  Goto(aX, aY, aTolerance, aSpeed);
  return true;
}

bool MorseWaypoint::SetDest(double aX, double aY) {
  return SetDest(aX, aY, GetTolerance(), GetSpeed());
}

void MorseWaypoint::Stop() {
  const auto lock = Lock("Stop");
  translated("MorseWaypoint::Stop", [&] {
    Core()->session().send(DeviceId{RobotIndex(), DeviceIndex()}, sim::StopCommand{});
    Ordered("Stop");
  });
}

void MorseWaypoint::Resume() {
  const auto lock = Lock("Resume");
  translated("MorseWaypoint::Resume", [&] {
    Core()->session().send(DeviceId{RobotIndex(), DeviceIndex()}, sim::ResumeCommand{});
    Ordered("Transit");
  });
}

std::string MorseWaypoint::GetStatus() const {
  const auto lock = Lock("GetStatus");
  return mStatus;
}

bool MorseWaypoint::IsArrived() const { return GetStatus() == "Arrived"; }

player_point_2d_t MorseWaypoint::GetGoal() const {
  const auto lock = Lock("GetGoal");
  return mGoal;
}

double MorseWaypoint::GetDistance() const {
  const auto lock = Lock("GetDistance");
  return mDistance;
}

uint32_t MorseWaypoint::GetGoalNumber() const {
  const auto lock = Lock("GetGoalNumber");
  return mGoalNumber;
}

double MorseWaypoint::GetTolerance() const { return GetProperty("tolerance", 0.5); }
double MorseWaypoint::GetSpeed() const { return GetProperty("speed", 1.0); }

// --- MorseTeleport

MorseTeleport::MorseTeleport(const MorseRobot& aRobot, const std::string& aName)
    : MorseActuator(aRobot, aName, "teleport", "MorseTeleport") {}
MorseTeleport::~MorseTeleport() = default;

void MorseTeleport::Place(double aX, double aY, double aYaw) {
  const char* fun = "MorseTeleport::Place";
  require_finite(fun, {{"x", aX}, {"y", aY}, {"the heading", aYaw}});
  const auto lock = Lock("Place");
  Core()->send(fun, {RobotIndex(), DeviceIndex()},
               sim::PlaceCommand{{aX, aY, sim::normalize_angle(aYaw)}});
}

void MorseTeleport::Translate(double aX, double aY) {
  const char* fun = "MorseTeleport::Translate";
  require_finite(fun, {{"x", aX}, {"y", aY}});
  const auto lock = Lock("Translate");
  Core()->send(fun, {RobotIndex(), DeviceIndex()}, sim::TranslateCommand{{aX, aY}});
}

void MorseTeleport::Rotate(double aYaw) {
  const char* fun = "MorseTeleport::Rotate";
  require_finite(fun, {{"the turn", aYaw}});
  const auto lock = Lock("Rotate");
  Core()->send(fun, {RobotIndex(), DeviceIndex()}, sim::RotateCommand{aYaw});
}

}  // namespace CCMorse
