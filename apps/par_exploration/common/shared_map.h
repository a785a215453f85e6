// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_SHARED_MAP_H
#define PAR_EXPLORATION_SHARED_MAP_H

#include <vector>

#include "imr-h/thread.h"
#include "par_common/occupancy_grid.h"

// An observation of one moment, in addition to the map.
struct Observation {
  double time = 0.0;               // simulated [s]
  par::Pose robot;                 // pose of its centre, in the map's frame
  std::vector<par::Point> echoes;  // echoes of the laser, in the robot's frame: x ahead, y left [m]
};

// A rectangle of the floor.
struct Area {
  par::Pose centre;     // yaw: the direction of its length
  double length = 0.0;  // [m]
  double width = 0.0;   // [m]
};

// The map and its time: the only data that the two threads share.
//
// The thread that collects data writes; the thread that drives reads. A reader that has received
// data of time t from its own client waits for the map of time t. So its decisions do not depend on
// which thread the operating system runs first. In lockstep the wait loses nothing, because
// simulated time stands still.
class CSharedMap {
 public:
  explicit CSharedMap(const par::OccupancyGrid& empty) : map(empty) {}

  // For the writer: the map now contains everything seen until this moment.
  void publish(const par::OccupancyGrid& newMap, const Observation& observation);
  // For both, when their thread ends for any reason: ends all waiting.
  void close();

  // For the reader: waits for the map of this time, or a later one. Returns false if the map was
  // closed before that.
  bool waitFor(double time, Observation& observation);
  // A copy of the map, which does not change while the other thread continues.
  par::OccupancyGrid copy() const;
  // Asks the writer to forget what it knows of an area, before it adds the next scan.
  void forget(const Area& area);
  // For the writer: the areas since its last call.
  std::vector<Area> takeForgotten();
  // Whether close() was called.
  bool closed() const;

 private:
  typedef imr::concurrent::Mutex Mutex;
  typedef imr::concurrent::ScopedLock ScopedLock;

  mutable Mutex mtx;  // guards all members below
  imr::concurrent::Condition changed;
  par::OccupancyGrid map;
  Observation newest;
  std::vector<Area> forgotten;
  bool isClosed = false;
};

#endif
