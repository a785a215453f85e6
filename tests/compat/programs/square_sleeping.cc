// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A square timed only by sleeping, without any Read().
#include <libplayerc++/playerc++.h>
#include <unistd.h>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy p2d(&robot);
  p2d.SetMotorEnable(true);
  for (int i = 0; i < 4; ++i) {
    p2d.SetSpeed(0.5, 0.0);
    usleep(2000000);
    p2d.SetSpeed(0.0, M_PI / 4);
    sleep(2);
  }
  p2d.SetSpeed(0, 0);
  usleep(100000);
}
