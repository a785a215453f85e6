// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders by the laser's least ranges on both sides. Defines functions with names of Player's
// functions.
#include <iostream>
#include <cstdlib>
#include <libplayerc++/playerc++.h>

using namespace std;
using namespace PlayerCc;

double limit(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

int main(int argc, char **argv)
{
  string host = argc > 1 ? argv[1] : "localhost";
  uint port = argc > 2 ? atoi(argv[2]) : 6665;
  try {
    PlayerClient robot(host, port);
    Position2dProxy pp(&robot, 0);
    LaserProxy lp(&robot, 0);
    cout << robot << endl;
    pp.SetMotorEnable(true);
    while (true) {
      robot.Read();
      double l = lp.MinLeft(), r = lp.MinRight();
      double newspeed = limit(0.25 * (l + r) - 0.3, 0.0, 0.4);
      double newturnrate = limit(30.0 * (l - r), -40.0, 40.0);
      if (l < 0.6 && r < 0.6) newturnrate = 40.0;
      pp.SetSpeed(newspeed, dtor(newturnrate));
    }
  } catch (PlayerError e) {
    cerr << e << endl;
    return 0;
  }
}
