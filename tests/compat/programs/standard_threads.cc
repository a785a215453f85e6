// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// In the style of programs after 2011: std::thread, sleep_for, one client per thread.
#include <libplayerc++/playerc++.h>
#include <chrono>
#include <thread>
using namespace PlayerCc;

void wander(int port)
{
  PlayerClient robot("localhost", port);
  Position2dProxy pp(&robot, 0);
  LaserProxy lp(&robot, 0);
  for (int i = 0; i < 150; ++i) {
    robot.Read();
    bool blocked = std::min(lp.GetMinLeft(), lp.GetMinRight()) < 0.8;
    pp.SetSpeed(blocked ? 0.0 : 0.3, blocked ? 0.5 : 0.05);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  pp.SetSpeed(0, 0);
}

int main()
{
  std::thread a(wander, 6665), b(wander, 6666);
  a.join();
  b.join();
  return 0;
}
