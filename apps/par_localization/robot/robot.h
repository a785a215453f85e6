// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_LOCALIZATION_ROBOT_H
#define PAR_LOCALIZATION_ROBOT_H

#include <memory>
#include <string>
#include <vector>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "localizer.h"
#include "par_common/path_follower.h"
#include "par_common/planners.h"
#include "robot_types.h"

// Finds out where it is on a known map, then drives to a goal. While it does not know its pose, it
// wanders and touches nothing. The localizer is in localizer.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();

  // Whether the robot reached the goal. Call it after the thread has ended.
  bool succeeded() const { return success; }

 protected:
  void threadBody() override;

 private:
  bool navigation();
  void fetchMap();
  bool planFrom(const par::Pose& pose);
  void lookAtScan();
  double agreement(const par::Pose& pose) const;
  double roomAhead(double halfWidth) const;
  par::Velocity wander();
  void halt();
  void drawCells(const std::string& layer, const par::Mask& cells) const;
  void drawParticles() const;
  void drawPath(const par::Path& way) const;
  void drawGoal() const;

  double goalX, goalY;  // [m]
  double inflation;     // radius by which obstacles are inflated [m]

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  CCMorse::WindowProxy& window;

  par::Mask walls;               // the map: 1 where there is a wall
  par::Grid<double> wallsAt;     // distance of each cell to the nearest wall [m]
  par::Mask inflated;            // where the robot's centre cannot be
  std::vector<par::Point> scan;  // end points of the newest scan, seen from the robot [m]
  double turning = 0.0;          // while wandering: the turn rate, until the way ahead is free
  par::PathFollower follower;
  std::unique_ptr<Localizer> localizer;

  bool success = false;
  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
