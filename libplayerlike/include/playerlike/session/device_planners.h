// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/devices/device.h"

namespace playerlike {

/// State of a planner. All poses are in the world's frame.
struct PlannerState {
  bool valid = false;  ///< there is a path to the goal
  bool done = false;   ///< the goal is reached
  sim::Pose pose;      ///< of the robot
  sim::Pose goal;
  sim::Pose waypoint;                ///< the current one
  int waypoint_index = -1;           ///< of the current one in `waypoints`; negative: none
  std::vector<sim::Pose> waypoints;  ///< from the start to the goal
  double length_m = 0.0;             ///< of the path along the waypoints
  /// Number of the path's waypoints if `waypoints` is not filled, as in a planner's readings.
  std::optional<std::size_t> reported_waypoints{};

  [[nodiscard]] std::size_t waypoint_count() const {
    return reported_waypoints.value_or(waypoints.size());
  }
};

/// Reading of a planner of a server. The waypoints themselves are not part of it.
struct PlannerReading : sim::Reading {
  PlannerState state;
};

/// Plans by planners of a server. Sessions with servers whose devices include planners derive from
/// it: those with Player servers.
class DevicePlanners {
 public:
  /// The waypoints of a planner's path.
  struct Path {
    std::vector<sim::Pose> waypoints;
    double length_m = 0.0;
  };

  /// @name Calls for the device with this index of the interface planner
  /// @throws SessionError kNoSuchDevice, kNotAvailable (the device does not open, or refuses),
  ///         kDisconnected.
  /// @{
  virtual void set_planner_goal(unsigned index, const sim::Pose& goal) = 0;
  virtual void set_planner_start(unsigned index, const sim::Pose& start) = 0;
  virtual void enable_planner(unsigned index, bool on) = 0;
  [[nodiscard]] virtual Path planner_path(unsigned index) = 0;
  /// @}

 protected:
  ~DevicePlanners() = default;
};

}  // namespace playerlike
