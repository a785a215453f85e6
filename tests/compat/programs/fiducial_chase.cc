// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Turns until it sees a fiducial, then drives up to the nearest.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

int main()
{
  PlayerClient robot("localhost", 6665);
  FiducialProxy fp(&robot, 0);
  Position2dProxy pp(&robot, 0);
  for (int turns = 0; turns < 500; ++turns) {
    robot.Read();
    int n = fp.GetCount();
    if (n == 0) {
      pp.SetSpeed(0, 0.4);
      continue;
    }
    player_fiducial_item item = fp.GetFiducialItem(0);
    for (int i = 1; i < n; ++i) {
      player_fiducial_item_t other = fp[i];
      if (hypot(other.pose.px, other.pose.py) < hypot(item.pose.px, item.pose.py)) item = other;
    }
    double distance = hypot(item.pose.px, item.pose.py);
    double bearing = atan2(item.pose.py, item.pose.px);
    if (distance < 0.8) {
      pp.SetSpeed(0, 0);
      robot.Read();
      cout << "reached fiducial " << item.id << " at " << distance << " m" << endl;
      return 0;
    }
    pp.SetSpeed(fabs(bearing) < 0.3 ? 0.4 : 0.0, limit(2 * bearing, -0.7, 0.7));
  }
  cout << "no fiducial reached" << endl;
  return 1;
}
