// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_COLLECTOR_H
#define PAR_EXPLORATION_COLLECTOR_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "layers.h"
#include "libCCMorse/CCMorse.h"
#include "par_common/occupancy_grid.h"
#include "shared_map.h"

// The thread that collects data: ten times a second it reads where the robot is and what its laser
// sees, and learns it into the map.
//
// It has a client for itself. In lockstep, simulated time goes on only when every client's thread
// waits in Read(), so no scan is lost, however long the other thread plans.
class CCollector : public imr::concurrent::CThread {
 public:
  static imr::CConfig& getConfig(imr::CConfig& config);

  // What is passed by reference must outlive this object; the client is for this thread only.
  CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& client, CSharedMap& map, CLayers& layers);
  ~CCollector() override;

  // Waits for the first data. Call it before execute().
  void waitForData();
  // Lets the thread end after its next Read(). A map that was published before stays the last one.
  void stop();
  // Whether the thread ended by a fault, and not by the end of the run or by stop().
  bool hasFailed() const;

 protected:
  void threadBody() override;

 private:
  void collect();
  void integrate();
  void setOrigin();
  par::Pose robotPose() const;

  CCMorse::PlayerClient& client;
  CSharedMap& map;
  CLayers& layers;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;  // where the map's poses come from
  std::unique_ptr<CCMorse::Position2dProxy> arena;     // the arena's localisation: where it began

  par::OccupancyGrid grid;  // its own: what it publishes are copies
  par::Pose origin;         // of the frame in which `position` tells where the robot is, in the map
  int scans = 0;

  mutable Mutex mtx;    // guards what follows
  bool quit = false;    // stop() sets it from another thread
  bool failed = false;  // read when the thread has ended
};

#endif
