// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_intro/template, implemented as the comments there describe.

// insert into robot.cc before: #include "imr-h/logging.h"
#include <algorithm>
#include <cmath>

// insert into robot.h before:   bool quit = false;
double left = 0.0;   // smallest range ahead on the left [m]
double right = 0.0;  // smallest range ahead on the right [m]
double side = 0.0;   // direction of the current turn: 1 left, -1 right, 0 none

// function: void CRobot::lookAtLaser(
void CRobot::lookAtLaser() {
  left = right = laser->GetMaxRange();
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    const double bearing = laser->GetBearing(i);
    if (std::fabs(bearing) > 40.0 * PI / 180.0) continue;
    double& least = bearing > 0.0 ? left : right;
    least = std::min(least, (*laser)[i]);
  }
}

// function: void CRobot::decideSpeeds(
void CRobot::decideSpeeds() {
  const double ahead = std::min(left, right);
  if (side == 0.0 && ahead < 0.2) side = left < right ? -1.0 : 1.0;
  if (ahead > 0.4) side = 0.0;
  forwardSpeed = side == 0.0 ? 0.3 : 0.0;
  turnRate = 1.5 * side;
}
