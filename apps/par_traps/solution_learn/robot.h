// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_TRAPS_ROBOT_H
#define PAR_TRAPS_ROBOT_H

#include <memory>
#include <string>
#include <vector>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/ArenaProxy.h"
#include "libCCMorse/CCMorse.h"
#include "par_common/path_follower.h"
#include "par_common/planners.h"
#include "traps.h"

// Drives to a goal on a known map with unknown traps. The robot takes the cheapest path, and learns
// from the arena's events: where a trap has sprung, what it cost, and that the map has changed.
// After each such event it plans anew.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();

  // Whether the robot has reached the goal. Call it after the thread has ended.
  bool succeeded() const { return success; }

 protected:
  void threadBody() override;

 private:
  void navigation();
  void fetchMap();
  bool lookAtEvents();
  bool plan();
  void drawCells(const std::string& layer, const par::Mask& cells) const;
  void drawPath(const std::vector<par::Cell>& path) const;
  void drawGoal() const;
  par::Point place() const { return {position->GetXPos(), position->GetYPos()}; }

  par::Point goal;  // [m]

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<CCMorse::ArenaProxy> arena;
  CCMorse::WindowProxy& window;

  par::Mask inflated;  // where the robot's centre cannot be
  CTraps traps;
  par::Point last;  // where the robot was one reading ago
  par::PathFollower follower;

  bool success = false;
  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
