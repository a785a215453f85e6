// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_INTRO_ROBOT_H
#define PAR_INTRO_ROBOT_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// An obstacle avoider after Valentino Braitenberg, "Vehicles: Experiments in Synthetic Psychology"
// (MIT Press, 1984), vehicle 2a. It has two eyes and two wheels; each eye drives the wheel on its
// own side. An obstacle on the left makes the left wheel faster, so the robot turns away. Unlike
// Braitenberg's vehicle, this one also drives ahead without a stimulus, and slows down when
// something is in front.
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
  void navigation();
  void drawTrail();
  void decideSpeeds();

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  double escape = 0.0;  // 1: turns left on the spot, -1: right, 0: not escaping

  CCMorse::ImagePoint_t lastPixel;  // pixel of the canvas where the trail ends
  bool trailBegun = false;

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
