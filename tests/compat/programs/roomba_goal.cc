// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A Roomba gets its position from the localisation and drives to (5, -3.5). It avoids obstacles
// with its laser of 361 beams, and backs off after a bump.
#include <cmath>
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

player_pose2d_t whereAmI(LocalizeProxy &lp)
{
  player_pose2d_t pose;
  pose.px = pose.py = pose.pa = 0;
  double best = 0;
  for (uint32_t i = 0; i < lp.GetHypothCount(); i++) {
    if (lp.GetHypoth(i).alpha > best) {
      best = lp.GetHypoth(i).alpha;
      pose = lp.GetHypoth(i).mean;
    }
  }
  return pose;
}

int main(int argc, char *argv[])
{
  PlayerClient robot("localhost");
  BumperProxy bp(&robot, 0);
  Position2dProxy pp(&robot, 0);
  LocalizeProxy lp(&robot, 0);
  LaserProxy sp(&robot, 0);
  const double goalX = 5, goalY = -3.5;

  pp.SetMotorEnable(true);
  pp.SetSpeed(0.2, 0.1);
  while (lp.GetHypothCount() == 0 || lp.GetHypoth(0).alpha < 0.9)
    robot.Read();
  player_pose2d_t pose = whereAmI(lp);
  std::cout << sp.GetCount() << " beams; I am at (" << pose.px << ", " << pose.py << "), odometry says ("
            << pp.GetXPos() << ", " << pp.GetYPos() << ")" << std::endl;

  while (hypot(goalX - pose.px, goalY - pose.py) > 0.1) {
    robot.Read();
    pose = whereAmI(lp);
    double bearing = normalize(atan2(goalY - pose.py, goalX - pose.px) - pose.pa);
    if (bp[0] || bp[1])
      pp.SetSpeed(-0.2, bp[0] ? -0.5 : 0.5);
    else if (sp.MinLeft() < 0.5)
      pp.SetSpeed(0.1, -0.6);
    else if (sp.MinRight() < 0.5)
      pp.SetSpeed(0.1, 0.6);
    else
      pp.SetSpeed(fabs(bearing) < 0.3 ? 0.45 : 0, limit(1.5 * bearing, -1.0, 1.0));
  }
  pp.SetSpeed(0, 0);
  std::cout << "at the goal: (" << pose.px << ", " << pose.py << ")" << std::endl;
  return 0;
}
