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

// The thread that collects data. Ten times a second it reads the robot's pose and the laser, and
// updates the map.
//
// It has its own client. In lockstep, simulated time advances only when every client's thread waits
// in Read(), so no scan is lost, however long the other thread plans.
class CCollector : public imr::concurrent::CThread {
 public:
  static imr::CConfig& getConfig(imr::CConfig& config);

  // The arguments passed by reference must outlive this object. Only this thread may use the
  // client.
  CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& client, CSharedMap& map, CLayers& layers);
  ~CCollector() override;

  // Waits for the first data. Call it before execute().
  void waitForData();
  // The thread ends after its next Read(). The map that it published before remains the last one.
  void stop();
  // Whether the thread ended because of an error, rather than by the end of the run or by stop().
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
  std::unique_ptr<CCMorse::Position2dProxy> position;  // source of the map's poses
  std::unique_ptr<CCMorse::Position2dProxy> arena;  // the arena's localisation, for the start pose

  par::OccupancyGrid grid;  // this thread's own map; it publishes copies
  par::Pose origin;         // pose, in the map, of the frame in which `position` reports poses
  int scans = 0;

  mutable Mutex mtx;    // guards what follows
  bool quit = false;    // stop() sets it from another thread
  bool failed = false;  // read after the thread has ended
};

#endif
