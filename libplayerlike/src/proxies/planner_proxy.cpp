// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <ostream>

#include "core/errors.h"
#include "libplayerc++/plannerproxy.h"
#include "proxies/link.h"
#include "proxies/planner.h"
#include "session/player_values/poses.h"

namespace PlayerCc {

using playerlike::PlannerState;
using playerlike::require_finite;
using playerlike::to_players;
using playerlike::translated;

PlannerProxy::PlannerProxy(PlayerClient* aPc, uint32_t aIndex)
    : ClientProxy(aPc, aIndex),
      mState(std::make_shared<PlannerState>()),
      mFetched(std::make_shared<PlannerState>()) {
  const char* fun = "PlannerProxy::PlannerProxy";
  Attach(PLAYER_PLANNER_CODE, aIndex, fun);
  mPlanner = translated(
      fun, [&] { return playerlike::share_planner(mLink->core->session(), mLink->binding); });
}

PlannerProxy::~PlannerProxy() { ClientProxy::Unsubscribe(); }

void PlannerProxy::HandleReading(const playerlike::NewReading& aNew) {
  if (mPlanner == nullptr) return;  // a reading during the constructor
  mPlanner->on_reading(*aNew.reading);
  mState = std::make_shared<PlannerState>(mPlanner->state());
  mWaypointCount = static_cast<uint32_t>(mState->waypoint_count());
}

void PlannerProxy::SetGoalPose(double aGx, double aGy, double aGa) {
  const char* fun = "PlannerProxy::SetGoalPose";
  require_finite(fun, {{"the goal's x", aGx}, {"the goal's y", aGy}, {"the goal's heading", aGa}});
  const scoped_lock_t lock(LockData(fun));
  translated(fun, [&] {
    mPlanner->set_goal({aGx, aGy, sim::normalize_angle(aGa)});
    mState = std::make_shared<PlannerState>(mPlanner->state());
    mWaypointCount = static_cast<uint32_t>(mState->waypoint_count());
  });
}

void PlannerProxy::SetStartPose(double aSx, double aSy, double aSa) {
  const char* fun = "PlannerProxy::SetStartPose";
  require_finite(fun,
                 {{"the start's x", aSx}, {"the start's y", aSy}, {"the start's heading", aSa}});
  const scoped_lock_t lock(LockData(fun));
  translated(fun, [&] { mPlanner->set_start({aSx, aSy, sim::normalize_angle(aSa)}); });
}

void PlannerProxy::RequestWaypoints() {
  const char* fun = "PlannerProxy::RequestWaypoints";
  const scoped_lock_t lock(LockData(fun));
  translated(fun, [&] {
    mFetched = std::make_shared<PlannerState>(mPlanner->state_with_waypoints());
    mWaypointCount = static_cast<uint32_t>(mFetched->waypoints.size());
  });
}

void PlannerProxy::SetEnable(bool aEnable) {
  const char* fun = "PlannerProxy::SetEnable";
  const scoped_lock_t lock(LockData(fun));
  translated(fun, [&] { mPlanner->enable(aEnable); });
}

std::shared_ptr<const PlannerState> PlannerProxy::State(const char* aFun) const {
  const scoped_lock_t lock(LockData(aFun));
  return mState;
}

uint32_t PlannerProxy::GetPathValid() const {
  return State("PlannerProxy::GetPathValid")->valid ? 1 : 0;
}
uint32_t PlannerProxy::GetPathDone() const {
  return State("PlannerProxy::GetPathDone")->done ? 1 : 0;
}
double PlannerProxy::GetPathLength() const {
  const scoped_lock_t lock(LockData("PlannerProxy::GetPathLength"));
  return mFetched->length_m;
}

player_pose2d_t PlannerProxy::GetPose() const {
  return to_players<player_pose2d_t>(State("PlannerProxy::GetPose")->pose);
}
double PlannerProxy::GetPx() const { return GetPose().px; }
double PlannerProxy::GetPy() const { return GetPose().py; }
double PlannerProxy::GetPa() const { return GetPose().pa; }

player_pose2d_t PlannerProxy::GetGoal() const {
  return to_players<player_pose2d_t>(State("PlannerProxy::GetGoal")->goal);
}
double PlannerProxy::GetGx() const { return GetGoal().px; }
double PlannerProxy::GetGy() const { return GetGoal().py; }
double PlannerProxy::GetGa() const { return GetGoal().pa; }

player_pose2d_t PlannerProxy::GetCurrentWaypoint() const {
  return to_players<player_pose2d_t>(State("PlannerProxy::GetCurrentWaypoint")->waypoint);
}
double PlannerProxy::GetWx() const { return GetCurrentWaypoint().px; }
double PlannerProxy::GetWy() const { return GetCurrentWaypoint().py; }
double PlannerProxy::GetWa() const { return GetCurrentWaypoint().pa; }

player_pose2d_t PlannerProxy::GetWaypoint(uint32_t aIndex) const {
  const char* fun = "PlannerProxy::GetWaypoint";
  const scoped_lock_t lock(LockData(fun));
  return to_players<player_pose2d_t>(
      mLink->element_or_zero(fun, {"waypoint", "waypoints"}, aIndex, mFetched->waypoints));
}
double PlannerProxy::GetIx(int i) const { return GetWaypoint(static_cast<uint32_t>(i)).px; }
double PlannerProxy::GetIy(int i) const { return GetWaypoint(static_cast<uint32_t>(i)).py; }
double PlannerProxy::GetIa(int i) const { return GetWaypoint(static_cast<uint32_t>(i)).pa; }

int PlannerProxy::GetCurrentWaypointId() const {
  return State("PlannerProxy::GetCurrentWaypointId")->waypoint_index;
}
uint32_t PlannerProxy::GetWaypointCount() const {
  const scoped_lock_t lock(LockData("PlannerProxy::GetWaypointCount"));
  return mWaypointCount;
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::PlannerProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c) << "\n#valid\tdone\n"
     << c.GetPathValid() << '\t' << c.GetPathDone() << "\n#waypoint x [m]\ty [m]\tyaw [rad]\n";
  for (uint32_t i = 0; i < c.GetWaypointCount(); ++i) {
    os << c.GetIx(static_cast<int>(i)) << '\t' << c.GetIy(static_cast<int>(i)) << '\t'
       << c.GetIa(static_cast<int>(i)) << '\n';
  }
  return os;
}

}  // namespace std
