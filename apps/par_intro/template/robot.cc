// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <string>

#include "imr-h/logging.h"

// The three functions that are yours to fill, lookAtPose(), lookAtLaser() and decideSpeeds(), are
// at the end of this file. As it is, the program reads its sensors and stands still.

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  // "localhost" is the simulation inside this very program; any other name is a robot (or a
  // simulation) somewhere else. On port 4000 all robots are visible, and the index says which one;
  // ports 6665, 6666, ... are one robot each, with index 0.
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 4000);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))) {
  // Proxies are empty until the first data come.
  while (!laser->IsFresh() || !position->IsFresh()) {
    client->Read();
  }
}

CRobot::~CRobot() {
  stop();
  join();
}

void CRobot::stop() {
  ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  try {
    navigation();
  } catch (const CCMorse::MorseError& e) {
    // Also the way in which a simulated run ends: when its time is over, Read() throws.
    INFO("The run is over: " << e.GetErrorStr());
  }
}

void CRobot::navigation() {
  position->SetMotorEnable(true);
  bool q = false;
  while (!q) {
    // Waits for new data of at least one sensor, usually a tenth of a second. Simulated time goes
    // on in here only: however long you compute between two reads, the robot loses nothing.
    client->Read();

    // "Fresh" is raised by new data and lowered by you, so that no data are used twice.
    if (position->IsFresh()) {
      position->NotFresh();
      lookAtPose();
    }
    if (laser->IsFresh()) {
      laser->NotFresh();
      lookAtLaser();
    }

    // A command holds until the next one: a robot that nobody stops goes on for ever.
    decideSpeeds();
    position->SetSpeed(forwardSpeed, turnRate);

    ScopedLock lk(mtx);
    q = quit;
  }
  position->SetMotorEnable(false);
}

void CRobot::lookAtPose() {
  // The robot's pose in the frame of the arena: x to the right and y up on its plan, in metres from
  // the bottom left corner; yaw is the heading in radians, counter-clockwise, 0 along x.
  pose = imr::robot::SPosition(position->GetXPos(), position->GetYPos(), position->GetYaw());
  DEBUG("pose " << pose.x << " " << pose.y << " " << pose.yaw);

  // Try first: run with IMR_LOG_LEVEL=debug in the environment and watch these lines.
}

void CRobot::lookAtLaser() {
  // A scan is laser->GetCount() ranges in metres. Beam 0 is the RIGHTMOST one, and they go on
  // counter-clockwise: the middle beam looks straight ahead, the last one far to the left.
  //   (*laser)[i]            range of beam i; GetMaxRange() means that it met nothing
  //   laser->GetBearing(i)   its angle against straight ahead [rad], negative to the right
  // The laser sits 0.035 m ahead of the robot's centre; the robot is about 0.17 m long and wide.
  //
  // Try first: find the least range within 40 degrees of straight ahead, left and right apart. Keep
  // both in variables of your own, in robot.h.
}

void CRobot::decideSpeeds() {
  // The S1R drives at most 0.5 m/s and turns at most 3 rad/s.
  //
  // Try first: forwardSpeed = 0.3, and see in scene.png where the robot ends.
  // Then: stop when an obstacle ahead is nearer than 0.2 m.
  // Then: instead of standing still, turn on the spot at 1.5 rad/s, away from the side on which the
  // obstacle is nearer, and drive on when the way is free.
  // Then: in a corner that robot turns left, right, left, ... and never leaves. So choose the side
  // only when a turn begins, and turn on until nothing ahead is nearer than 0.4 m.
  // Such a robot passes the grade: playpen grade par_intro.
  // Next: follow a wall at a distance of 0.2 m.
}
