// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace playerlike {
class Planner;
struct PlannerState;
}  // namespace playerlike

namespace PlayerCc {

/// A path planner that also drives the robot to the goal: a driver "wavefront" of the world
/// (docs/wavefront.md), or the planner of a Player server.
///
/// Frame: all poses are in the world's frame W.
///
/// Time: the data change with the readings of the robot's pose. They are those of the planner's
/// last round before the current simulated time, so a run is repeatable. A goal is planned in the
/// planner's first round after SetGoalPose(); until then there is no path.
///
/// Threads: as ClientProxy. In a world of Playpen, all proxies of a robot's planner in a process
/// share one planner, which has a thread of its own and ends with the last of them.
class PlannerProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the world has no such planner; the text names what there
  ///         is. kNotAvailable if this client may not read the world's map, or if a Player server
  ///         does not open the planner.
  PlannerProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~PlannerProxy() override;

  /// Plans a path to a goal [m, m, rad] and drives along it, in place of an earlier goal.
  /// @throws PlayerError kBadArgument for a number that is not finite.
  void SetGoalPose(double aGx, double aGy, double aGa);
  /// Plans from this pose [m, m, rad] instead of the robot's. The robot stops, and the planner only
  /// plans until SetEnable(true).
  void SetStartPose(double aSx, double aSy, double aSa);
  /// Fetches the waypoints of the path; see GetWaypoint(). Waypoints and GetPathLength() do not
  /// change otherwise.
  void RequestWaypoints();
  /// Stops the robot, or drives on. Initially enabled.
  void SetEnable(bool aEnable);

  uint32_t GetPathValid() const;  ///< 1 if there is a path to the goal, otherwise 0
  uint32_t GetPathDone() const;   ///< 1 if the goal is reached, otherwise 0
  double GetPathLength() const;   ///< length of the path along the waypoints [m]

  double GetPx() const;             ///< x of the robot [m]
  double GetPy() const;             ///< y of the robot [m]
  double GetPa() const;             ///< yaw of the robot [rad]
  player_pose2d_t GetPose() const;  ///< pose of the robot [m, rad]
  double GetGx() const;             ///< x of the goal [m]
  double GetGy() const;             ///< y of the goal [m]
  double GetGa() const;             ///< yaw at the goal [rad]
  player_pose2d_t GetGoal() const;  ///< pose of the goal [m, rad]
  double GetWx() const;             ///< x of the current waypoint [m]
  double GetWy() const;             ///< y of the current waypoint [m]
  double GetWa() const;             ///< direction of the path to the current waypoint [rad]
  player_pose2d_t GetCurrentWaypoint() const;  ///< the current waypoint [m, rad]

  double GetIx(int i) const;  ///< x of a waypoint [m]; see GetWaypoint()
  double GetIy(int i) const;  ///< y of a waypoint [m]
  double GetIa(int i) const;  ///< direction of the path to a waypoint [rad]
  /// A waypoint [m, rad] that RequestWaypoints() fetched. The heading of the last one is that of
  /// the goal. An index that is not below their number gives zeros; a warning says so, once for
  /// each proxy.
  player_pose2d_t GetWaypoint(uint32_t aIndex) const;
  /// Index of the current waypoint; -1 if the robot is not on its way.
  int GetCurrentWaypointId() const;
  /// Number of waypoints of the path.
  uint32_t GetWaypointCount() const;
  /// Same as GetWaypoint().
  player_pose2d_t operator[](uint32_t aIndex) const { return GetWaypoint(aIndex); }

 protected:
  void HandleReading(const playerlike::NewReading& aNew) override;

 private:
  std::shared_ptr<const playerlike::PlannerState> State(const char* aFun) const;

  std::shared_ptr<playerlike::Planner> mPlanner;
  // Guarded by the client's mutex.
  std::shared_ptr<const playerlike::PlannerState> mState;
  std::shared_ptr<const playerlike::PlannerState> mFetched;  ///< by RequestWaypoints()
  uint32_t mWaypointCount = 0;
};

}  // namespace PlayerCc

namespace std {
/// Prints whether there is a path and whether it is done, then the waypoints, one per line.
std::ostream& operator<<(std::ostream& os, const PlayerCc::PlannerProxy& c);
}  // namespace std
