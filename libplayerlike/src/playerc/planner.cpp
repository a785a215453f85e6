// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <vector>

#include "libplayerc++/plannerproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::with_device;

class Planner final
    : public playerlike::clib::ProxyBacked<playerc_planner_t, PlayerCc::PlannerProxy> {
 public:
  void fetch_waypoints() {
    PlayerCc::PlannerProxy& proxy = proxy_or_throw();
    proxy.RequestWaypoints();
    const uint32_t count = proxy.GetWaypointCount();
    waypoints_.clear();
    waypoints_.reserve(count + 1);  // an array also without waypoints, as in Player's library
    for (uint32_t i = 0; i < count; ++i) {
      const player_pose2d_t pose = proxy.GetWaypoint(i);
      waypoints_.push_back({pose.px, pose.py, pose.pa});
    }
    waypoints = reinterpret_cast<double(*)[3]>(waypoints_.data());
    waypoint_count = static_cast<int>(count);
    waypoint_distance = proxy.GetPathLength();
  }

 private:
  void refresh() override {
    const PlayerCc::PlannerProxy& proxy = proxy_or_throw();
    path_valid = static_cast<int>(proxy.GetPathValid());
    path_done = static_cast<int>(proxy.GetPathDone());
    const auto put = [](const player_pose2d_t& pose, double& x, double& y, double& a) {
      x = pose.px;
      y = pose.py;
      a = pose.pa;
    };
    put(proxy.GetPose(), px, py, pa);
    put(proxy.GetGoal(), gx, gy, ga);
    put(proxy.GetCurrentWaypoint(), wx, wy, wa);
    curr_waypoint = proxy.GetCurrentWaypointId();
    if (waypoints_.empty()) waypoint_count = static_cast<int>(proxy.GetWaypointCount());
  }

  std::vector<std::array<double, 3>> waypoints_;
};

}  // namespace

PLAYERLIKE_CLIB_FRAME(planner, Planner, PLAYER_PLANNER_CODE)

int playerc_planner_set_cmd_pose(playerc_planner_t* device, double gx, double gy, double ga) {
  return with_device<Planner>(
      __func__, device, [&](Planner& self) { self.proxy_or_throw().SetGoalPose(gx, gy, ga); });
}

int playerc_planner_set_cmd_start(playerc_planner_t* device, double sx, double sy, double sa) {
  return with_device<Planner>(
      __func__, device, [&](Planner& self) { self.proxy_or_throw().SetStartPose(sx, sy, sa); });
}

int playerc_planner_get_waypoints(playerc_planner_t* device) {
  return with_device<Planner>(__func__, device, [](Planner& self) { self.fetch_waypoints(); });
}

int playerc_planner_enable(playerc_planner_t* device, int state) {
  return with_device<Planner>(__func__, device,
                              [&](Planner& self) { self.proxy_or_throw().SetEnable(state != 0); });
}
