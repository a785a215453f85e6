// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A square by odometry: drives ahead until the distance is reached, turns until the heading is
// reached.
#include "libplayerc++/playerc++.h"
#include <cstdio>

using namespace std;
using namespace PlayerCc;

PlayerClient *robot;
Position2dProxy *pp;

void forward(double length)
{
  robot->Read();
  double x0 = pp->GetXPos(), y0 = pp->GetYPos(), way = 0;
  do {
    pp->SetSpeed(min(0.4, 0.1 + 2 * (length - way)), 0);
    robot->Read();
    way = hypot(pp->GetXPos() - x0, pp->GetYPos() - y0);
  } while (way < length);
  pp->SetSpeed(0, 0);
}

void turn(double angle)
{
  robot->Read();
  double goal = normalize(pp->GetYaw() + angle);
  double left;
  do {
    left = normalize(goal - pp->GetYaw());
    pp->SetSpeed(0, limit(left, -0.6, 0.6));
    robot->Read();
  } while (fabs(left) > 0.01);
  pp->SetSpeed(0, 0);
}

int main(int argc, char **argv)
{
  robot = new PlayerClient("localhost", 6665);
  pp = new Position2dProxy(robot, 0);
  for (int i = 0; i < 4; i++) {
    forward(1.0);
    turn(DTOR(90));
  }
  robot->Read();
  printf("closed within %.3f m\n", hypot(pp->GetXPos(), pp->GetYPos()));
  delete pp;
  delete robot;
  return 0;
}
