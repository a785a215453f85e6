// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A Roomba leaves a maze: it drives straight to the first wall and then follows the wall on its
// right. The bumpers detect walls ahead, the laser the wall beside it. The odometry shows when it
// is outside.
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main(int argc, char *argv[])
{
  PlayerClient robot("localhost");
  BumperProxy bp(&robot, 0);
  Position2dProxy pp(&robot, 0);
  LaserProxy sp(&robot, 0);

  double speed = 0, turnrate = 0;
  bool following = false;
  int backing = 0, turning = 0, bumps = 0, both = 0, turns = 0;

  pp.SetMotorEnable(true);

  while (!(pp.GetXPos() < -1.2 && pp.GetYPos() > 9)) {
    robot.Read();
    turns++;
    if (bp[0] || bp[1]) {
      bumps++;
      if (bp[0] && bp[1]) both++;
      following = true;
      backing = 4;
      turning = !bp[0] ? 4 : !bp[1] ? 8 : 14;  // from the wall on the right, or from one ahead
    }
    if (backing > 0) {
      backing--;
      speed = -0.2;
      turnrate = 0;
    } else if (turning > 0) {
      turning--;
      speed = 0;
      turnrate = 1.0;
    } else {
      double right = sp.GetMaxRange();
      for (int i = 0; i < 50; i++)  // of 361 beams, those that look to the right
        if (sp[i] < right) right = sp[i];
      speed = 0.45;
      turnrate = following ? -1.5 * (right - 0.45) : 0;
      if (turnrate > 0.8) turnrate = 0.8;
      if (turnrate < -0.8) turnrate = -0.8;
    }
    pp.SetSpeed(speed, turnrate);
  }
  pp.SetSpeed(0, 0);
  std::cout << "out of the maze after " << turns / 10 << " s, " << bumps << " bumps, " << both
            << " of them straight ahead" << std::endl;
  return 0;
}
