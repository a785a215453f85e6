// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A car drives a winding path by speed and steering angle.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy car(&robot, 0);
  car.SetMotorEnable(true);
  double turned = 0, last = 0;
  for (int i = 0; i < 120; ++i) {
    car.SetCarlike(0.4, (i + 10) / 20 % 2 ? -0.2 : 0.2);
    robot.Read();
    turned += fabs(normalize(car.GetYaw() - last));
    last = car.GetYaw();
  }
  car.SetCarlike(0, 0);
  robot.Read();
  std::cout << "turned " << turned << " rad in all, heading " << car.GetYaw() << std::endl;
  return 0;
}
