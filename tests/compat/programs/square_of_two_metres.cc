// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Five metres straight ahead and back, then a square of two metres, by speed and time: one Read()
// takes a tenth of a second.
#include <cmath>
#include <iostream>
#include <libplayerc++/playerc++.h>

PlayerCc::PlayerClient robot("localhost", 6665);
PlayerCc::Position2dProxy position(&robot, 0);

void drive(double speed, double turn, double seconds)
{
  position.SetSpeed(speed, turn);
  for (int i = 0; i < seconds * 10; i++)
    robot.Read();
  position.SetSpeed(0, 0);
  for (int i = 0; i < 10; i++)  // it takes a while to stand
    robot.Read();
}

int main()
{
  position.SetMotorEnable(true);
  drive(0.5, 0, 10);
  std::cout << "straight on: " << position.GetXPos() << " m" << std::endl;
  drive(-0.5, 0, 10);
  for (int i = 0; i < 4; i++) {
    drive(0.5, 0, 4);
    drive(0, M_PI / 4, 2);
  }
  double off = sqrt(position.GetXPos() * position.GetXPos() + position.GetYPos() * position.GetYPos());
  std::cout << (off < 0.1 ? "square closed" : "square open") << ", " << off << " m off" << std::endl;
  return 0;
}
