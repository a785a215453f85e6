// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_SHARED_MAP_H
#define PAR_EXPLORATION_SHARED_MAP_H

#include <vector>

#include "imr-h/thread.h"
#include "par_common/occupancy_grid.h"

// What was seen at one moment, beside the map.
struct Observation {
  double time = 0.0;               // simulated [s]
  par::Pose robot;                 // its centre, in the map's frame
  std::vector<par::Point> echoes;  // where the laser's beams met something, in the robot's frame:
                                   // x ahead, y to the left [m]
};

// The one thing that the two threads share: the map, with the time it belongs to.
//
// The thread that collects data writes, the thread that drives reads. A reader that has got data of
// time t from its own client waits until the map of time t is there, so what it decides does not
// depend on which of the threads the operating system happened to run first. In lockstep nothing is
// lost by the wait: simulated time stands still.
class CSharedMap {
 public:
  explicit CSharedMap(const par::OccupancyGrid& empty) : map(empty) {}

  // For the writer: the map now tells all that was seen until this moment.
  void publish(const par::OccupancyGrid& newMap, const Observation& observation);
  // For both, when their thread ends, for whatever reason: nobody must wait any longer.
  void close();

  // For the reader: waits for the map of this time, or a later one.
  // Returns false if it will never come, since the map was closed.
  bool waitFor(double time, Observation& observation);
  // A copy: it stays as it is while the other thread goes on.
  par::OccupancyGrid copy() const;
  // Whether close() was called.
  bool closed() const;

 private:
  typedef imr::concurrent::Mutex Mutex;
  typedef imr::concurrent::ScopedLock ScopedLock;

  mutable Mutex mtx;  // guards all that follows
  imr::concurrent::Condition changed;
  par::OccupancyGrid map;
  Observation newest;
  bool isClosed = false;
};

#endif
