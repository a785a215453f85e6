// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_chase/template, implemented as the comments there describe.

// insert into robot.h before:   bool quit = false;
double foxX = 0.0;  // where the fox was seen last [m]
double foxY = 0.0;
double foxTime = -100.0;    // when that was [s]
std::size_t patrolled = 0;  // number of places of the patrol that were reached

// function: void CRobot::lookAround(
void CRobot::lookAround() {
  if (fiducial->GetCount() == 0) return;
  const player_fiducial_item_t item = fiducial->GetFiducialItem(0);
  foxX = pose.x + std::cos(pose.yaw) * item.pose.px - std::sin(pose.yaw) * item.pose.py;
  foxY = pose.y + std::sin(pose.yaw) * item.pose.px + std::cos(pose.yaw) * item.pose.py;
  foxTime = position->GetDataTime();
}

// function: void CRobot::chooseGoal(
void CRobot::chooseGoal() {
  if (position->GetDataTime() - foxTime < 5.0) {
    goalX = foxX;
    goalY = foxY;
    return;
  }
  const double places[][2] = {{1.2, 0.9}, {1.85, 1.6}, {2.5, 1.7}, {3.2, 2.2}, {3.1, 3.1},
                              {2.4, 2.8}, {3.2, 1.0},  {3.1, 0.3}, {1.5, 0.3}};
  const std::size_t count = sizeof places / sizeof places[0];
  if (std::hypot(places[patrolled % count][0] - pose.x, places[patrolled % count][1] - pose.y) <
      0.1) {
    patrolled++;
  }
  goalX = places[patrolled % count][0];
  goalY = places[patrolled % count][1];
}
