// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Tries one port after another until it finds a robot, and does without missing devices.
#include <libplayerc++/playerc++.h>
#include <memory>
using namespace PlayerCc;
using namespace std;

int main()
{
  PlayerClient *robot = NULL;
  int port;
  for (port = 6663; port < 6670 && !robot; ++port) {
    try {
      robot = new PlayerClient("localhost", port);
    } catch (PlayerError &e) {
      cerr << "port " << port << ": " << e.GetErrorStr() << endl;
    }
  }
  if (!robot) return 1;
  cout << "robot on port " << robot->GetPort() << endl;
  LimbProxy *arm = 0;
  try {
    arm = new LimbProxy(robot, 0);
  } catch (PlayerError e) {
    cout << "no arm: " << e << endl;
  }
  try {
    LaserProxy none(robot, 77);
    return 1;
  } catch (const PlayerError &e) {
    cout << e.GetErrorFun() << endl;
  }
  Position2dProxy pp(robot, 0);
  try {
    while (true) {
      robot->Read();
      pp.SetSpeed(0.1, 0.3);
    }
  } catch (PlayerError &e) {
    cout << "ended: " << e.GetErrorStr() << endl;
  }
  return arm == 0 ? 0 : 1;
}
