// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A square by counting iterations of the loop: one Read() takes a tenth of a second.
#include <iostream>
#include <libplayerc++/playerc++.h>

int main(int argc, char *argv[])
{
  using namespace PlayerCc;

  PlayerClient    robot("localhost", 6665);
  Position2dProxy pp(&robot, 0);

  pp.SetMotorEnable(1);
  for (int side = 0; side < 4; side++)
  {
    for (int i = 0; i < 20; i++)   // two seconds ahead
    {
      robot.Read();
      pp.SetSpeed(0.5, 0);
    }
    for (int i = 0; i < 20; i++)   // two seconds round the corner
    {
      robot.Read();
      pp.SetSpeed(0, dtor(45));
    }
  }
  pp.SetSpeed(0, 0);
  robot.Read();
  std::cout << "at " << pp.GetXPos() << " " << pp.GetYPos() << " " << rtod(pp.GetYaw()) << std::endl;
  return 0;
}
