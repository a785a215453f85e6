// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "imr-h/logging.h"

namespace {

const double REACH = 0.6;   // obstacles farther away than this are ignored [m]
const double SIDE = 1.75;   // half the field of view that the eyes use, from straight ahead [rad]
const double FRONT = 0.5;   // half the field of view that counts as "in front" [rad]
const double V_MAX = 0.3;   // speed with nothing in front [m/s]
const double W_MAX = 2.0;   // fastest turn [rad/s]
const double WEIGHT = 6.0;  // turn rate when one eye is fully covered [rad/s]
const double CLOSE = 0.7;   // nearness in front above which the robot only turns

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 4000);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<int>("canvas-width", "columns of the world's canvas", 172);
  config.add<int>("canvas-height", "rows of the world's canvas", 186);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))) {
  // The canvas of the arena has 172 x 186 pixels of 0.02 m; other worlds may differ.
  CCMorse::WindowProxy::GetInstance(client.get(), cfg.get<int>("canvas-width"),
                                    cfg.get<int>("canvas-height"));
  while (!laser->IsFresh() || !position->IsFresh()) {
    client->Read();
  }
}

CRobot::~CRobot() {
  stop();
  join();
  delete &CCMorse::WindowProxy::GetInstance();
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
    client->Read();
    if (position->IsFresh()) {
      position->NotFresh();
      drawTrail();
    }
    if (laser->IsFresh()) {
      laser->NotFresh();
      decideSpeeds();
    }
    ScopedLock lk(mtx);
    q = quit;
  }
  position->SetMotorEnable(false);
}

void CRobot::drawTrail() {
  // Converts metres in the arena to pixels of the canvas. The trail connects consecutive poses.
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance();
  const CCMorse::ImagePoint_t pixel(window.GetX(position->GetXPos()),
                                    window.GetY(position->GetYPos()));
  if (!trailBegun) lastPixel = pixel;
  trailBegun = true;
  window.SetLine(lastPixel.x, lastPixel.y, pixel.x, pixel.y, 0, 120, 255);
  lastPixel = pixel;
}

void CRobot::decideSpeeds() {
  // The two eyes. Each is a weighted mean of nearness over its half of the scan (nearness 0:
  // nothing within reach, 1: touching). Beams that point ahead weigh more than beams that point
  // sideways.
  double left = 0.0, right = 0.0, weights = 0.0, front = 0.0;
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    const double angle = laser->GetBearing(i);  // negative to the right
    if (std::fabs(angle) > SIDE) continue;
    const double nearness = std::max(0.0, 1.0 - (*laser)[i] / REACH);
    const double weight = 0.2 + 0.8 * std::cos(0.5 * angle * PI / SIDE);
    weights += 0.5 * weight;
    (angle > 0.0 ? left : right) += weight * nearness;
    if (std::fabs(angle) < FRONT) front = std::max(front, nearness);
  }
  left /= weights;
  right /= weights;

  // Each eye drives the wheel on its own side, so the difference turns the robot away.
  double w = WEIGHT * (right - left);
  double v = V_MAX * std::max(0.0, 1.0 - front / CLOSE);
  if (front > CLOSE) {
    // Too near to drive on, and both eyes may see equally much. Turn on the spot and keep the side
    // that was chosen first; otherwise the robot would oscillate between left and right.
    if (escape == 0.0) escape = right > left ? 1.0 : -1.0;
    w = escape * W_MAX;
  } else if (front < 0.5 * CLOSE) {
    escape = 0.0;
  }
  position->SetSpeed(v, std::max(-W_MAX, std::min(W_MAX, w)));
}
