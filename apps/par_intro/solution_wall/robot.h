// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_INTRO_ROBOT_H
#define PAR_INTRO_ROBOT_H

#include <memory>

#include "imr-h/imr_config.h"
#include "imr-h/thread.h"
#include "libCCMorse/CCMorse.h"
#include "robot_types.h"

// A wall follower. A PD controller keeps the wall on one side at a fixed distance. The robot finds
// its way round every corner and out of every dead end, like a person in a maze with one hand on
// the wall.
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
  // What the robot extracts from a scan. The frame is the robot's. If the wall is on the right, the
  // frame is mirrored (y points to the right), so one set of rules works for both sides.
  struct View {
    double freeAhead;  // distance that the robot can drive straight ahead before it touches
                       // something [m]
    // distance from the robot's centre to the nearest point on the wall's side [m]
    double wallRange;
    double wallAngle;  // direction of that point: 0 ahead, pi/2 to the side [rad]
  };

  void navigation();
  void drawTrail();
  View look() const;
  void decideSpeeds(const View& view);

  // The connection and its devices. The order matters: members are destroyed in reverse order, and
  // a proxy must be destroyed before its client.
  std::unique_ptr<CCMorse::PlayerClient> client;
  std::unique_ptr<CCMorse::LaserProxy> laser;
  std::unique_ptr<CCMorse::Position2dProxy> position;

  double side;             // 1: the wall is on the left, -1: on the right
  bool wallFound = false;  // until it is true, the robot drives straight ahead

  CCMorse::ImagePoint_t lastPixel;  // pixel of the canvas where the trail ends
  bool trailBegun = false;

  bool quit = false;  // guarded by mtx; stop() sets it from another thread
  Mutex mtx;
};

#endif
