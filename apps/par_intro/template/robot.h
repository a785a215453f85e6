// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_INTRO_ROBOT_H
#define PAR_INTRO_ROBOT_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// A robot controlled by its own thread. main() creates it, calls execute() to start the thread and
// join() to wait until the thread ends. The thread runs threadBody(), in robot.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the command-line settings and their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current iteration. Any thread may call this.
  void stop();

 protected:
  void threadBody() override;

 private:
  void navigation();    // the loop: read, process, decide, command
  void lookAtPose();    // yours: process a new position
  void lookAtLaser();   // yours: process a new laser scan
  void decideSpeeds();  // yours: choose the speeds to command

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  imr::robot::SPosition pose;  // where the robot is: x, y [m], yaw [rad]
  double forwardSpeed = 0.0;   // commanded [m/s], positive ahead
  double turnRate = 0.0;       // commanded [rad/s], positive to the left
  // Your own variables go here.

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
