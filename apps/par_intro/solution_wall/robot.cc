// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "imr-h/imr_exceptions.h"
#include "imr-h/logging.h"

namespace {

const double LASER_X = 0.035;       // distance of the laser ahead of the robot's centre [m]
const double RADIUS = 0.105;        // circle that contains the robot, with clearance [m]
const double WALL_DISTANCE = 0.14;  // desired distance from centre to wall [m]
const double WALL_FOUND = 0.30;     // the robot follows a wall that is nearer [m]

const double V_MAX = 0.35;   // [m/s]
const double W_MAX = 2.5;    // [rad/s]
const double KP = 8.0;       // P gain: turn rate per distance error, [rad/s] per metre
const double KD = 2.5;       // D gain: turn rate per heading error, [rad/s] per radian
const double BRAKING = 1.5;  // speed per free distance ahead, [m/s] per metre

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
      decideSpeeds(look());
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
  window.SetLine(lastPixel.x, lastPixel.y, pixel.x, pixel.y, 0, 160, 0);
  lastPixel = pixel;
}

CRobot::View CRobot::look() const {
  View view = {laser->GetMaxRange(), laser->GetMaxRange(), 0.5 * PI};
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    const double range = (*laser)[i];
    if (range >= laser->GetMaxRange()) continue;  // this beam hit nothing

    // The end point of the beam in the robot's frame: x ahead, y towards the side of the wall.
    const double x = LASER_X + range * std::cos(laser->GetBearing(i));
    const double y = side * range * std::sin(laser->GetBearing(i));

    // Ahead: the robot sweeps a lane as wide as its circle. At lateral offset y the edge of the
    // circle is sqrt(RADIUS^2 - y^2) ahead of its centre. The robot touches the point when that
    // edge reaches it.
    if (x > 0.0 && std::fabs(y) < RADIUS) {
      const double free = x - std::sqrt(RADIUS * RADIUS - y * y);
      view.freeAhead = std::min(view.freeAhead, std::max(0.0, free));
    }
    // The wall: the nearest point on its side. The side begins a little beyond straight ahead.
    if (y > -0.5 * RADIUS && std::hypot(x, y) < view.wallRange) {
      view.wallRange = std::hypot(x, y);
      view.wallAngle = std::atan2(y, x);
    }
  }
  return view;
}

void CRobot::decideSpeeds(const View& view) {
  wallFound = wallFound || view.wallRange < WALL_FOUND || view.freeAhead < RADIUS;

  // Drive as fast as the free distance ahead allows.
  double v = clamp(BRAKING * view.freeAhead, 0.0, V_MAX);
  double away = 0.0;  // turn rate away from the wall
  if (wallFound) {
    // A PD controller. P term: turn away if the robot is too near, towards the wall if it is too
    // far. D term: the heading along the wall says how the distance will change. If the nearest
    // point is ahead of the robot's side (angle < pi/2), the robot drives into the wall and must
    // turn away. This rule also handles corners: in an inner corner the nearest point jumps ahead,
    // at an outer corner it falls behind.
    away = KP * (WALL_DISTANCE - view.wallRange) + KD * (0.5 * PI - view.wallAngle);
    // Slow down in sharp turns. Limit the turn towards the wall to a circle round the wall's end;
    // otherwise the robot would turn on the spot for ever after it has lost the wall.
    v *= clamp(1.0 - std::fabs(away) / W_MAX, 0.3, 1.0);
    away = clamp(away, -v / WALL_DISTANCE, W_MAX);
    // Blocked ahead: a corner or a dead end. The robot's circle can always turn on the spot.
    if (view.freeAhead < 0.02) away = W_MAX;
  }
  position->SetSpeed(v, -side * away);
}
