// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The client reads in its own thread; the control loop sleeps.
#include <libplayerc++/playerc++.h>
#include <unistd.h>
using namespace PlayerCc;
using namespace std;

int main()
{
  PlayerClient robot("localhost", 6665);
  Position2dProxy pp(&robot, 0);
  LaserProxy lp(&robot, 0);
  robot.StartThread();
  usleep(500000);
  for (int i = 0; i < 250; i++) {
    double speed = 0.3, turn = 0;
    {
      PlayerClient::mutex_t::scoped_lock lock(robot.mMutex);
      lock.unlock();
    }
    if (lp.GetCount() > 0 && MIN(lp.GetMinLeft(), lp.GetMinRight()) < 0.8) {
      speed = 0.0;
      turn = lp.GetMinLeft() > lp.GetMinRight() ? 0.6 : -0.6;
    }
    pp.SetSpeed(speed, turn);
    usleep(100000);
  }
  pp.SetSpeed(0, 0);
  usleep(200000);
  robot.StopThread();
  cout << "ended at " << pp.GetXPos() << " " << pp.GetYPos() << endl;
  return 0;
}
