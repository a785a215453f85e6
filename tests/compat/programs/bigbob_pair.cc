// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives two Bigbobs with one client each. The first robot wanders with its sonars and the three
// rays of ranger:2. The second robot uses only the rays, and backs off if an object is between its
// teeth. The program also lists the pucks and moves one of them, as the tutorial does with oranges.
#include <stdio.h>
#include <libplayerc++/playerc++.h>

using namespace PlayerCc;

int main(int argc, char *argv[])
{
  PlayerClient robot1("localhost", 6665);
  PlayerClient robot2("localhost", 6666);
  Position2dProxy p2dProxy1(&robot1, 0);
  RangerProxy sonarProxy(&robot1, 0);
  RangerProxy toothLaserProxy(&robot1, 1);
  RangerProxy irProxy(&robot1, 2);
  SimulationProxy simProxy(&robot1, 0);
  Position2dProxy p2dProxy2(&robot2, 0);
  RangerProxy irProxy2(&robot2, 2);
  RangerProxy toothLaserProxy2(&robot2, 1);

  p2dProxy1.SetMotorEnable(1);
  p2dProxy2.SetMotorEnable(1);

  double x, y, yaw;
  char puck[] = "puck1";
  for (int i = 1; i <= 4; i++)
  {
    puck[4] = '0' + i;
    simProxy.GetPose2d(puck, x, y, yaw);
    printf("%s is at %.1f %.1f\n", puck, x, y);
  }
  puck[4] = '1';
  simProxy.SetPose2d(puck, 6, -6.5, 0);
  simProxy.GetPose2d(puck, x, y, yaw);
  printf("%s moved to %.1f %.1f\n", puck, x, y);

  unsigned int rays = 0, beams = 0;
  int backing = 0;
  for (int step = 0; step < 550; step++)
  {
    robot1.Read();
    robot2.Read();
    rays = irProxy.GetRangeCount();
    beams = toothLaserProxy.GetRangeCount();

    double ahead = irProxy[0], left = irProxy[1], right = irProxy[2];
    double sonar = sonarProxy[0] < sonarProxy[1] ? sonarProxy[0] : sonarProxy[1];
    if (ahead < 1.5 || left < 0.9 || right < 0.9 || sonar < 0.9)
      p2dProxy1.SetSpeed(0, left > right ? 0.6 : -0.6);
    else
      p2dProxy1.SetSpeed(0.4, 0);

    if (toothLaserProxy2[90] < 0.24) backing = 25;
    if (backing > 0)
    {
      p2dProxy2.SetSpeed(backing > 12 ? -0.4 : 0, backing > 12 ? 0 : -0.6);
      backing--;
    }
    else if (irProxy2[0] < 1.5 || irProxy2[1] < 0.9 || irProxy2[2] < 0.9)
      p2dProxy2.SetSpeed(0, -0.6);
    else
      p2dProxy2.SetSpeed(0.4, 0);
  }
  p2dProxy1.SetSpeed(0, 0);
  p2dProxy2.SetSpeed(0, 0);
  printf("%u rays, %u beams between the teeth\n", rays, beams);
  return 0;
}
