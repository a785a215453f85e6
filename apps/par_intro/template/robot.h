// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_INTRO_ROBOT_H
#define PAR_INTRO_ROBOT_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// A robot that thinks in a thread of its own: main() makes it, calls execute() to start the thread
// and join() to wait for its end. What the thread does stands in threadBody(), in robot.cc.
class CRobot : public imr::concurrent::CThread {
 public:
  // Declares the settings that can be given on the command line, with their defaults.
  static imr::CConfig& getConfig(imr::CConfig& config);

  // Connects to the robot and waits for its first data.
  explicit CRobot(imr::CConfig& cfg);
  ~CRobot();

  // Asks the thread to end after its current turn; may be called from any thread.
  void stop();

 protected:
  void threadBody() override;

 private:
  void navigation();    // the loop: read, look, decide, command
  void lookAtPose();    // yours: what to do with a new position
  void lookAtLaser();   // yours: what to do with a new laser scan
  void decideSpeeds();  // yours: which speeds to command

  // The connection, and the two devices that are reached through it. The order matters: what is
  // declared last is destroyed first, and a proxy needs its client to the end.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  imr::robot::SPosition pose;  // where the robot is: x, y [m], yaw [rad]
  double forwardSpeed = 0.0;   // commanded [m/s], ahead is positive
  double turnRate = 0.0;       // commanded [rad/s], to the left is positive
  // Your own variables go here.

  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

#endif
