// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_INTRO_ROBOT_H
#define PAR_INTRO_ROBOT_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// An obstacle avoider after Valentino Braitenberg, "Vehicles: Experiments in Synthetic Psychology"
// (MIT Press, 1984), vehicle 2a: two eyes, two wheels, and each eye drives the wheel of its own
// side. What it sees on the left makes the left wheel faster, so it turns away. Ours also drives
// ahead of its own accord, and more slowly the more it sees in front.
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
  void navigation();
  void drawTrail();
  void decideSpeeds();

  // The connection, and the two devices that are reached through it. The order matters: what is
  // declared last is destroyed first, and a proxy needs its client to the end.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  double escape = 0.0;  // 1: turning left on the spot, -1: right, 0: not

  CCMorse::ImagePoint_t lastPixel;  // of the canvas, where the trail ends
  bool trailBegun = false;

  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

#endif
