// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <string>

#include "imr-h/logging.h"

// Fill in the three functions at the end of this file: lookAtPose(), lookAtLaser() and
// decideSpeeds(). As it is, the program reads its sensors and stands still.

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  // "localhost" is the simulation inside this program; any other name is a robot (or a simulation)
  // on another computer. Port 4000 serves all robots, and the index selects one. Ports 6665, 6666,
  // ... serve one robot each, with index 0.
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
  // Proxies are empty until the first data arrive.
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
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
  }
}

void CRobot::navigation() {
  position->SetMotorEnable(true);
  bool q = false;
  while (!q) {
    // Waits for new data from at least one sensor, usually for a tenth of a second. Simulated time
    // advances only inside Read(): however long your computation takes between two reads, the robot
    // misses nothing.
    client->Read();

    // New data set the flag "fresh". You clear it, so that you use no data twice.
    if (position->IsFresh()) {
      position->NotFresh();
      lookAtPose();
    }
    if (laser->IsFresh()) {
      laser->NotFresh();
      lookAtLaser();
    }

    // A command stays in effect until the next one: a robot without a new command drives on.
    decideSpeeds();
    position->SetSpeed(forwardSpeed, turnRate);

    ScopedLock lk(mtx);
    q = quit;
  }
  position->SetMotorEnable(false);
}

void CRobot::lookAtPose() {
  // The robot's pose in the arena's frame. The origin is the bottom left corner; x points to the
  // right and y up, in metres. Yaw is the heading in radians, counter-clockwise, 0 along x.
  pose = imr::robot::SPosition(position->GetXPos(), position->GetYPos(), position->GetYaw());
  DEBUG("pose " << pose.x << " " << pose.y << " " << pose.yaw);

  // Try first: run with IMR_LOG_LEVEL=debug in the environment and watch these lines.
}

void CRobot::lookAtLaser() {
  // A scan is a list of laser->GetCount() ranges in metres. Beam 0 is the RIGHTMOST beam, and the
  // index increases counter-clockwise: the middle beam points straight ahead, the last one far to
  // the left.
  //   (*laser)[i]            range of beam i; GetMaxRange() means that it hit nothing
  //   laser->GetBearing(i)   its angle from straight ahead [rad], negative to the right
  // The laser is 0.035 m ahead of the robot's centre; the robot is about 0.17 m long and wide.
  //
  // Try first: find the smallest range within 40 degrees of straight ahead, separately for left and
  // right. Keep both in variables of your own, in robot.h.
}

void CRobot::decideSpeeds() {
  // The S1R drives at most 0.5 m/s and turns at most 3 rad/s.
  //
  // Try first: forwardSpeed = 0.3, and see in scene.png where the robot ends.
  // Then: stop when an obstacle ahead is nearer than 0.2 m.
  // Then: instead of stopping, turn on the spot at 1.5 rad/s, away from the side with the nearer
  // obstacle. Drive on when the way is free.
  // Then: in a corner, that robot turns left, right, left, ... and never gets out. So choose the
  // side only when a turn begins, and turn until nothing ahead is nearer than 0.4 m.
  // Such a robot passes the grade: playpen grade par_intro.
  // Next: follow a wall at a distance of 0.2 m.
}
