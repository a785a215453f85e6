// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Moves its robot through the simulation proxy, and reads its position.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

int main(int argc, char **argv)
{
  char *name = argc > 1 ? argv[1] : (char *)"r1";
  PlayerClient robot("localhost");
  SimulationProxy sim(&robot, 0);
  Position2dProxy pp(&robot, 0);
  robot.Read();
  double x, y, a;
  sim.GetPose2d(name, x, y, a);
  cout << "was at " << x << " " << y << endl;
  sim.SetPose2d(name, x + 0.3, y, a + 1.0);
  double x2, y2, a2;
  sim.GetPose2d(name, x2, y2, a2);
  cout << "moved by " << x2 - x << " turned by " << normalize(a2 - a) << endl;
  pp.SetSpeed(0.2, 0);
  for (int i = 0; i < 10; i++) robot.Read();
  double x3, y3, a3;
  sim.GetPose2d(name, x3, y3, a3);
  cout << "drove " << hypot(x3 - x2, y3 - y2) << endl;
  double other = 42;
  sim.GetPose2d((char *)"nobody", other, y, a);
  sim.SetPose2d((char *)"nobody", x, y, a);
  cout << "nobody is at " << other << endl;
  return fabs(x2 - x - 0.3) < 1e-3 ? 0 : 1;
}
