// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program in the original style for Player: one include, two namespaces, no build system.
#include <libplayerc++/playerc++.h>

using namespace std;
using namespace PlayerCc;

int main(int argc, char** argv) {
  string host = argc > 1 ? argv[1] : "localhost";
  try {
    PlayerClient robot(host, 6665);
    Position2dProxy pp(&robot, 0);
    LaserProxy lp(&robot, 0);
    pp.SetMotorEnable(true);
    for (uint i = 0; i < 50; i++) {
      robot.Read();
      double turn = lp.GetMinLeft() < lp.GetMinRight() ? dtor(-20) : dtor(20);
      pp.SetSpeed(0.1, min(lp.GetMinLeft(), lp.GetMinRight()) < 0.4 ? turn : 0.0);
    }
    cout << "saw " << lp.GetCount() << " beams, drove to " << pp.GetXPos() << " " << pp.GetYPos()
         << endl;
  } catch (PlayerError e) {
    cerr << e << endl;
    return 1;
  }
  return 0;
}
