// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives until it bumps into something, backs up, turns and goes on. Reads and sleeps.
#include <unistd.h>
#include <iostream>
#include "libplayerc++/playerc++.h"
using namespace std;
using namespace PlayerCc;

int main(int argc, char *argv[])
{
  PlayerClient robot("localhost");
  BumperProxy bp(&robot, 0);
  Position2dProxy pp(&robot, 0);
  int bumps = 0;
  pp.SetMotorEnable(true);
  bp.RequestBumperConfig();
  cout << bp.GetPoseCount() << " bumpers" << endl;

  for (int i = 0; i < 250; i++) {
    robot.Read();
    bool left = bp[0] || bp[1], right = bp[3] || bp[4];
    if (bp.IsAnyBumped()) {
      bumps++;
      pp.SetSpeed(-0.3, 0);
      sleep(1);
      robot.Read();
      pp.SetSpeed(0, left || !right ? -0.8 : 0.8);
      sleep(1);
    } else {
      pp.SetSpeed(0.5, 0.0);
    }
    usleep(100 * 1000);
  }
  pp.SetSpeed(0, 0);
  cout << "bumped " << bumps << " times" << endl;
  return 0;
}
