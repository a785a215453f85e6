// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Two clients of one robot that had its own network address: one reads and steers, the other one
// only reads.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

int main()
{
  PlayerClient driver("192.0.2.17", 6665), watcher("robot-lab", 6665);
  driver.SetDataMode(PLAYER_DATAMODE_PULL);
  driver.SetReplaceRule(true, PLAYER_MSGTYPE_DATA, -1, -1);
  watcher.SetDataMode(PLAYER_DATAMODE_PULL);
  watcher.SetReplaceRule(true);
  Position2dProxy steering(&driver, 0), seen(&watcher, 0);
  LaserProxy laser(&watcher, 0);
  int rounds = 0;
  double length = 0, x = 0, y = 0;
  while (rounds++ < 200) {
    steering.SetSpeed(laser.GetCount() > 0 && laser.GetRange(laser.GetCount() / 2) < 0.9 ? 0.0 : 0.3, 0.25);
    driver.Read();
    watcher.Read();
    length += hypot(seen.GetXPos() - x, seen.GetYPos() - y);
    x = seen.GetXPos();
    y = seen.GetYPos();
  }
  cout << "way " << length << " m, speed " << steering.GetXSpeed() << endl;
  return 0;
}
