// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_CHASE_SOLUTION_ROBOT_H
#define PAR_CHASE_SOLUTION_ROBOT_H

#include <memory>
#include <string>
#include <vector>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "par_common/path_follower.h"
#include "par_common/planners.h"

// Finds and reaches a moving robot, the fox, on a known map. While the fox is in sight, the robot
// drives to where the fox will be soon. Otherwise it patrols: it remembers for each cell of the
// floor when the cell was last in view, and drives to the cell for which that is longest ago, less
// the time to get there.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();

  // Whether the robot has reached the fox. Call it after the thread has ended.
  bool succeeded() const { return success; }

 protected:
  void threadBody() override;

 private:
  // A sight of the fox.
  struct Sight {
    par::Point at;        // in the arena's frame [m]
    double time = -1.0;   // [s]; negative: never
    double speedX = 0.0;  // estimated [m/s]
    double speedY = 0.0;
  };

  void navigation();
  void fetchMap();
  void lookAround();
  void noteFox(const par::Point& at);
  void noteView();
  par::Point whereIsFox(double ahead) const;
  par::Cell patrolGoal(const par::Cell& from) const;
  void plan();
  void drawCells(const std::string& layer, const par::Mask& cells) const;
  void drawPath(const std::vector<par::Cell>& path) const;
  void drawFox() const;

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::Position2dProxy> position;
  std::unique_ptr<PlayerCc::FiducialProxy> fiducial;
  CCMorse::WindowProxy& window;

  par::Mask walls;
  par::Mask inflated;      // where the robot's centre cannot be
  par::Grid<double> seen;  // when each cell was last in view [s]
  par::Pose pose;          // where the robot is
  double now = 0.0;        // [s]
  Sight fox;
  par::PathFollower follower;

  bool success = false;
  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
