// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A potential field over the laser's points, which it also draws.
#include <libplayerc++/playerc++.h>
#include <vector>
using namespace std;
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  LaserProxy lp(&robot, 0);
  Graphics2dProxy gp(&robot, 0);
  gp.Color(255, 0, 0, 0);
  for (int turn = 0; turn < 300; ++turn) {
    robot.Read();
    player_point_2d force = {1.0, 0.0};
    vector<player_point_2d_t> points;
    for (uint i = 0; i < lp.GetCount(); i += 5) {
      player_point_2d_t p = lp.GetPoint(i);
      double r = max(0.1, lp[i]);
      if (r > 3) continue;
      force.px -= 0.02 * p.px / (r * r * r);
      force.py -= 0.02 * p.py / (r * r * r);
      points.push_back(p);
    }
    if (turn % 50 == 0 && !points.empty()) gp.DrawPoints(&points[0], points.size());
    double heading = atan2(force.py, force.px);
    pp.SetSpeed(limit(0.4 * cos(heading), 0.0, 0.4), limit(1.2 * heading, -0.8, 0.8));
  }
  pp.SetSpeed(0, 0);
  return 0;
}
