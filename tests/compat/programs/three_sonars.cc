// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders by the three sonars of an S1R: front left, front, front right.
#include <cmath>
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  SonarProxy sonar(&robot, 0);
  Position2dProxy pp(&robot, 0);

  pp.SetMotorEnable(true);
  robot.Read();
  std::cout << sonar.GetCount() << " sonars" << std::endl;
  double turn = 0;
  for (int i = 0; i < 590; i++) {
    robot.Read();
    double left = sonar[0], ahead = sonar[1], right = sonar[2];
    if (ahead < 0.2 || left < 0.1 || right < 0.1) {
      if (turn == 0) turn = left > right ? 1.0 : -1.0;
      pp.SetSpeed(0, turn);
    } else {
      turn = 0;
      pp.SetSpeed(0.2, limit(1.5 * (left - right), -0.5, 0.5));
    }
  }
  return 0;
}
