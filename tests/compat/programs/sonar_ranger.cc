// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders by the sonars of Stage's simple.world, which are ranger:0 there. It only prints the
// properties of the laser, ranger:1.
#include <cstdio>
#include <cmath>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main(int argc, char **argv)
{
  PlayerClient robot("localhost", 6665);
  Position2dProxy p2d(&robot, 0);
  RangerProxy sonar(&robot, 0);
  RangerProxy laser(&robot, 1);

  p2d.SetMotorEnable(1);
  sonar.RequestGeom();
  laser.RequestConfigure();
  robot.Read();
  printf("%u sonars, %u beams, start at %.0f %.0f\n", sonar.GetRangeCount(), laser.GetRangeCount(),
         p2d.GetXPos(), p2d.GetYPos());

  double speed = 0, turn = 0, farthest = 0;
  for (int i = 0; i < 590; i++) {
    robot.Read();
    double left = fmin(sonar[1], sonar[2]), front = fmin(sonar[3], sonar[4]), right = fmin(sonar[5], sonar[6]);
    if (front < 0.6 || left < 0.35 || right < 0.35) {
      speed = 0;
      if (turn == 0) turn = left > right ? dtor(50) : dtor(-50);  // and on until the way is free
    } else {
      speed = 0.4;
      turn = 0;
      if (left < 0.7) turn = dtor(-15);
      if (right < 0.7) turn = dtor(15);
    }
    p2d.SetSpeed(speed, turn);
    farthest = fmax(farthest, hypot(p2d.GetXPos() + 7, p2d.GetYPos() + 7));
  }
  printf("got %.1f m from the start\n", farthest);
  return 0;
}
