// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Gives goals to the position device and checks whether the robot has arrived.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

bool go(PlayerClient &robot, Position2dProxy &pp, double x, double y, double a)
{
  pp.GoTo(x, y, a);
  for (int i = 0; i < 200; ++i) {
    robot.Read();
    if (hypot(x - pp.GetXPos(), y - pp.GetYPos()) < 0.1 && fabs(normalize(a - pp.GetYaw())) < 0.1) return true;
    if (pp.GetStall()) return false;
  }
  return false;
}

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  pp.SetMotorEnable(true);
  pp.RequestGeom();
  player_bbox3d_t size = pp.GetSize();
  cout << "robot of " << size.sl << " x " << size.sw << endl;
  int reached = 0;
  if (go(robot, pp, 1.0, 0.0, 0.0)) reached++;
  if (go(robot, pp, 1.0, 1.0, M_PI / 2)) reached++;
  player_pose2d_t home = {0, 0, 0};
  pp.GoTo(home);
  for (int i = 0; i < 200; ++i) robot.Read();
  if (hypot(pp.GetXPos(), pp.GetYPos()) < 0.1) reached++;
  cout << reached << " goals reached" << endl;
  return reached == 3 ? 0 : 1;
}
