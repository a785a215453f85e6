// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "imr-h/imr_exceptions.h"
#include "imr-h/logging.h"

namespace {

const double LASER_X = 0.035;       // the laser is so far ahead of the robot's centre [m]
const double RADIUS = 0.105;        // of a circle that holds the robot, with a little air [m]
const double WALL_DISTANCE = 0.14;  // wanted, from the robot's centre to the wall [m]
const double WALL_FOUND = 0.30;     // a wall so near is one to follow [m]

const double V_MAX = 0.35;   // [m/s]
const double W_MAX = 2.5;    // [rad/s]
const double KP = 8.0;       // turn rate for being too near or too far, [rad/s] a metre
const double KD = 2.5;       // turn rate for not driving along the wall, [rad/s] a radian
const double BRAKING = 1.5;  // speed for the free way ahead, [m/s] a metre

double clamp(double value, double low, double high) { return std::max(low, std::min(high, value)); }

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 4000);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<int>("canvas-width", "columns of the world's canvas", 172);
  config.add<int>("canvas-height", "rows of the world's canvas", 186);
  config.add<std::string>("side", "hand that is kept on the wall: left or right", "left");
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      side(cfg.get<std::string>("side") == "right" ? -1.0 : 1.0) {
  imr::assert_argument(side < 0.0 || cfg.get<std::string>("side") == "left",
                       "--side must be left or right");
  // The canvas of the arena has 172 x 186 pixels of 0.02 m; another world may have another one.
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
    // Also the way in which a simulated run ends: when its time is over, Read() throws.
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
      decideSpeeds(look());
    }
    ScopedLock lk(mtx);
    q = quit;
  }
  position->SetMotorEnable(false);
}

void CRobot::drawTrail() {
  // From metres in the arena to pixels of the canvas; the trail is a line from pose to pose.
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance();
  const CCMorse::ImagePoint_t pixel(window.GetX(position->GetXPos()),
                                    window.GetY(position->GetYPos()));
  if (!trailBegun) lastPixel = pixel;
  trailBegun = true;
  window.SetLine(lastPixel.x, lastPixel.y, pixel.x, pixel.y, 0, 160, 0);
  lastPixel = pixel;
}

CRobot::View CRobot::look() const {
  View view = {laser->GetMaxRange(), laser->GetMaxRange(), 0.5 * PI};
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    const double range = (*laser)[i];
    if (range >= laser->GetMaxRange()) continue;  // this beam met nothing

    // Where the beam ended: in the robot's frame, x ahead, y to the side of the wall.
    const double x = LASER_X + range * std::cos(laser->GetBearing(i));
    const double y = side * range * std::sin(laser->GetBearing(i));

    // Ahead: the robot sweeps a lane as wide as its circle. It touches the point when the circle's
    // edge, which at this y is sqrt(RADIUS^2 - y^2) ahead of its centre, gets there.
    if (x > 0.0 && std::fabs(y) < RADIUS) {
      const double free = x - std::sqrt(RADIUS * RADIUS - y * y);
      view.freeAhead = std::min(view.freeAhead, std::max(0.0, free));
    }
    // The wall: the nearest point on its side, a little beyond straight ahead included.
    if (y > -0.5 * RADIUS && std::hypot(x, y) < view.wallRange) {
      view.wallRange = std::hypot(x, y);
      view.wallAngle = std::atan2(y, x);
    }
  }
  return view;
}

void CRobot::decideSpeeds(const View& view) {
  wallFound = wallFound || view.wallRange < WALL_FOUND || view.freeAhead < RADIUS;

  // As fast as the way ahead allows.
  double v = clamp(BRAKING * view.freeAhead, 0.0, V_MAX);
  double away = 0.0;  // turn rate away from the wall
  if (wallFound) {
    // A PD controller. P: too near, turn away; too far, turn towards the wall. D: what the distance
    // is about to do depends on the heading along the wall. If the nearest point is ahead of abeam
    // (angle < pi/2), the robot drives into the wall and must turn away. That handles corners too:
    // in an inner one the nearest point jumps ahead, at an outer one it falls behind.
    away = KP * (WALL_DISTANCE - view.wallRange) + KD * (0.5 * PI - view.wallAngle);
    // The sharper the turn, the slower; and never tighter than round the end of a wall, or it
    // would turn on the spot for ever when the wall is lost.
    v *= clamp(1.0 - std::fabs(away) / W_MAX, 0.3, 1.0);
    away = clamp(away, -v / WALL_DISTANCE, W_MAX);
    // No way ahead: a corner or a dead end. Its circle can always turn on the spot.
    if (view.freeAhead < 0.02) away = W_MAX;
  }
  position->SetSpeed(v, -side * away);
}
