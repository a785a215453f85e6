// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program in the style of existing ones: client and proxies at namespace scope, all namespaces
// opened, only Player's headers, errors caught by value, a loop that counts its iterations.
#include <libplayerc++/playerc++.h>

using namespace std;
using namespace PlayerCc;

string host = PLAYER_HOSTNAME;
PlayerClient robot(host);
PlayerClient* second = new PlayerClient("localhost", 6665);  // never deleted
Position2dProxy pp(&robot, 0);
LaserProxy lp(&robot);

int main(int argc, char** argv) {
  uint turns = 40;
  if (argc > 1) turns = static_cast<uint>(atoi(argv[1]));
  try {
    robot.SetDataMode(PLAYER_DATAMODE_PULL);
    robot.SetReplaceRule(true, PLAYER_MSGTYPE_DATA, -1, -1);
    Position2dProxy odometry(second, 1);
    pp.SetMotorEnable(true);
    pp.RequestGeom();
    lp.RequestGeom();
    lp.RequestConfigure();
    vector<double> ranges;
    list<string> log;
    for (uint i = 0; i < turns; i++) {
      robot.Read();
      second->Read();
      double left = min(lp.GetMinLeft(), lp.GetMaxRange());
      double right = min(lp.MinRight(), 5.0);
      double turn = limit((left - right) * 2.0, -1.0, 1.0);
      double speed = MIN(0.3, max(0.0, lp[lp.GetCount() / 2] - 0.3));
      if (fabs(normalize(pp.GetYaw() - dtor(90))) > M_PI) abort();
      pp.SetSpeed(speed, turn);
      ranges.push_back(lp.GetRange(0));
      player_pose2d_t here = {pp.GetXPos(), pp.GetYPos(), pp.GetYaw()};
      log.push_back(to_string(here.px));
      if (pp.IsFresh()) pp.NotFresh();
    }
    pp.SetMotorEnable(false);
    cout << robot << pp << lp.GetBearing(0) << " " << rtod(lp.GetBearing(0)) << endl;
    printf("%d turns, %.3f s, %.3f m from the start\n", static_cast<int>(ranges.size()),
           pp.GetDataTime(), hypot(odometry.GetXPos(), odometry.GetYPos()));
    // One Read() is 100 ms.
    if (fabs(pp.GetDataTime() - 0.1 * turns) > 1e-6) return 1;
    if (hypot(odometry.GetXPos(), odometry.GetYPos()) < 0.05) return 2;
    LaserProxy none(&robot, 42);
    return 3;
  } catch (PlayerError e) {
    cerr << e << endl;
    return e.GetErrorCode() == PlayerError::kNoSuchDevice ? 0 : 4;
  }
}
