// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_INTRO_ROBOT_H
#define PAR_INTRO_ROBOT_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// A wall follower: keeps a wall at a fixed distance on one side by a PD controller, and so finds
// its way round every corner and out of every dead end, like a person in a maze with one hand on
// the wall.
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
  // What the robot makes of a scan. The frame is the robot's, but seen in a mirror if the wall is
  // on its right: y then counts to the right, and one set of rules serves both hands.
  struct View {
    double freeAhead;  // how far it can drive straight on before it touches something [m]
    double wallRange;  // from its centre to the nearest point on the side of the wall [m]
    double wallAngle;  // direction of that point: 0 ahead, pi/2 abeam [rad]
  };

  void navigation();
  void drawTrail();
  View look() const;
  void decideSpeeds(const View& view);

  // The connection, and the two devices that are reached through it. The order matters: what is
  // declared last is destroyed first, and a proxy needs its client to the end.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  double side;             // 1: the wall is on the left, -1: on the right
  bool wallFound = false;  // until then the robot drives straight on

  CCMorse::ImagePoint_t lastPixel;  // of the canvas, where the trail ends
  bool trailBegun = false;

  bool quit = false;  // guarded by mtx: stop() sets it from another thread
  Mutex mtx;
};

#endif
