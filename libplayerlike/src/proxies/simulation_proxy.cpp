// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "proxies/simulation_proxy.h"

#include <algorithm>
#include <ostream>
#include <string>

#include "core/errors.h"
#include "core/warnings.h"
#include "libplayerc++/simulationproxy.h"
#include "proxies/link.h"
#include "session/object_values.h"

namespace playerlike {
namespace {
thread_local int strict = 0;
}

StrictSimulation::StrictSimulation() noexcept { ++strict; }
StrictSimulation::~StrictSimulation() { --strict; }

bool StrictSimulation::holds() noexcept { return strict > 0; }

}  // namespace playerlike

namespace PlayerCc {
namespace {

// Maximum number of different warnings of a proxy; it bounds memory if a program makes up names
// forever.
constexpr std::size_t kMostTold = 20;

// Checks that a required name is not a null pointer.
std::string text(const char* fun, const char* what, const char* given) {
  if (given != nullptr) return given;
  playerlike::refuse(fun, std::string(what) + " is a null pointer");
}

void require_value(const char* fun, const void* value) {
  if (value != nullptr) return;
  playerlike::refuse(fun, "the value is a null pointer");
}

}  // namespace

SimulationProxy::SimulationProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_SIMULATION_CODE, aIndex, "SimulationProxy::SimulationProxy", false);
}

SimulationProxy::~SimulationProxy() { ClientProxy::Unsubscribe(); }

// The caller holds the client's mutex.
template <typename Action>
void SimulationProxy::Try(const char* aFun, Action aAction) {
  playerlike::translated(aFun, [&] {
    try {
      aAction();
    } catch (const playerlike::SessionError& e) {
      using Code = playerlike::SessionError::Code;
      if (playerlike::StrictSimulation::holds() ||
          (e.code() != Code::kBadArgument && e.code() != Code::kNotAvailable))
        throw;
      Tell(aFun, e.what());
    }
  });
}

void SimulationProxy::Tell(const char* aFun, const std::string& aWhy) {
  std::string text = std::string(aFun) + " does nothing: " + aWhy;
  if (mTold.size() >= kMostTold || std::find(mTold.begin(), mTold.end(), text) != mTold.end()) {
    return;
  }
  playerlike::warn(text);
  mTold.push_back(std::move(text));
}

void SimulationProxy::SetPose2d(char* identifier, double x, double y, double a) {
  const char* fun = "SimulationProxy::SetPose2d";
  const std::string name = text(fun, "the identifier", identifier);
  playerlike::require_finite(fun, {{"x", x}, {"y", y}, {"a", a}});
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] {
    mLink->core->session().request(playerlike::PlaceObjectRequest{name, {x, y, a}});
  });
}

void SimulationProxy::GetPose2d(char* identifier, double& x, double& y, double& a) {
  const char* fun = "SimulationProxy::GetPose2d";
  const std::string name = text(fun, "the identifier", identifier);
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] {
    const sim::Pose pose = mLink->core->session().request(playerlike::ObjectPoseRequest{name}).pose;
    x = pose.x_m;
    y = pose.y_m;
    a = pose.yaw_rad;
  });
}

void SimulationProxy::SetPose3d(char* identifier, double x, double y, double z, double roll,
                                double pitch, double yaw) {
  const char* fun = "SimulationProxy::SetPose3d";
  const std::string name = text(fun, "the identifier", identifier);
  playerlike::require_finite(
      fun, {{"x", x}, {"y", y}, {"z", z}, {"roll", roll}, {"pitch", pitch}, {"yaw", yaw}});
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] {
    mLink->core->session().request(playerlike::PlaceObjectRequest{name, {x, y, yaw}});
  });
}

void SimulationProxy::GetPose3d(char* identifier, double& x, double& y, double& z, double& roll,
                                double& pitch, double& yaw, double& time) {
  const char* fun = "SimulationProxy::GetPose3d";
  const std::string name = text(fun, "the identifier", identifier);
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] {
    const playerlike::ObjectPose object =
        mLink->core->session().request(playerlike::ObjectPoseRequest{name});
    x = object.pose.x_m;
    y = object.pose.y_m;
    z = 0.0;
    roll = 0.0;
    pitch = 0.0;
    yaw = object.pose.yaw_rad;
    time = sim::to_seconds(object.time_ns);
  });
}

void SimulationProxy::GetProperty(char* identifier, char* name, void* value, size_t value_len) {
  const char* fun = "SimulationProxy::GetProperty";
  const std::string object = text(fun, "the identifier", identifier);
  const std::string property = playerlike::property_name(text(fun, "the name", name));
  require_value(fun, value);
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] {
    const auto now =
        mLink->core->session().request(playerlike::ObjectPropertyRequest{object, property});
    playerlike::write_property(property, now, value, value_len);
  });
}

void SimulationProxy::SetProperty(char* identifier, char* name, void* value, size_t value_len) {
  const char* fun = "SimulationProxy::SetProperty";
  const std::string object = text(fun, "the identifier", identifier);
  const std::string property = playerlike::property_name(text(fun, "the name", name));
  require_value(fun, value);
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] {
    playerlike::Session& session = mLink->core->session();
    const auto now = session.request(playerlike::ObjectPropertyRequest{object, property});
    session.request(playerlike::SetObjectPropertyRequest{
        object, property, playerlike::read_property(property, now, value, value_len)});
  });
}

void SimulationProxy::SaveState(const std::string& name) {
  const char* fun = "SimulationProxy::SaveState";
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] { mLink->core->session().request(playerlike::SaveStateRequest{name}); });
}

void SimulationProxy::RestoreState(const std::string& name) {
  const char* fun = "SimulationProxy::RestoreState";
  const scoped_lock_t lock(LockData(fun));
  Try(fun, [&] { mLink->core->session().request(playerlike::RestoreStateRequest{name}); });
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::SimulationProxy& c) {
  return os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << '\n';
}

}  // namespace std
