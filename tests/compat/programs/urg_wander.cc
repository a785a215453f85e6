// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders with a Hokuyo URG. It counts beams, like programs for a specific laser: 667 over 240
// degrees, or 681 or more of the S1R's.
#include <iostream>
#include <cstdlib>
#include <libplayerc++/playerc++.h>
using namespace std;
using namespace PlayerCc;

#define URG_BEAMS 667

double nearest(LaserProxy &lp, int from, int to)
{
  double best = 100;
  for (int i = from; i < to; i++)
    if (lp[i] < best) best = lp[i];
  return best;
}

int main(int argc, char *argv[])
{
  PlayerClient robot("localhost", 6665);
  LaserProxy lp(&robot, 0);
  Position2dProxy pp(&robot, 0);
  robot.Read();
  int n = lp.GetCount();
  if (n != URG_BEAMS && n != 681 && n != 682) {
    cerr << n << " beams: this is no URG" << endl;
    return 2;
  }
  double close = n == URG_BEAMS ? 0.7 : 0.3;
  pp.SetMotorEnable(true);
  double turn = 0;
  for (int i = 0; i < 590; i++) {
    robot.Read();
    double right = nearest(lp, n / 4, n * 2 / 5), ahead = nearest(lp, n * 2 / 5, n * 3 / 5),
           left = nearest(lp, n * 3 / 5, n * 3 / 4);
    if (ahead < close || left < close / 2 || right < close / 2) {
      if (turn == 0) turn = left > right ? 0.8 : -0.8;
      pp.SetSpeed(0, turn);
    } else {
      turn = 0;
      pp.SetSpeed(close / 2, 0);
    }
  }
  cout << n << " beams from " << rtod(lp.GetMinAngle()) << " to " << rtod(lp.GetMaxAngle()) << " degrees" << endl;
  return 0;
}
