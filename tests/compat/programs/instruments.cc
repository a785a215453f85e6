// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Reads a vehicle's instruments while it drives a circle.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

int main()
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  PowerProxy power(&robot, 0);
  GpsProxy gps(&robot, 0);
  ImuProxy imu(&robot, 0);
  double gyro = 0;
  int n = 0;
  for (int i = 0; i < 100; ++i) {
    robot.Read();
    pp.SetSpeed(0.2, 0.4);
    if (i > 20) {
      gyro += imu.GetZGyro();
      n++;
    }
  }
  cout << "charge " << power.GetPercent() << " %, at " << gps.GetLatitude() << " " << gps.GetLongitude()
       << ", turning at " << gyro / n << " rad/s" << endl;
  return fabs(gyro / n - 0.4) < 0.05 && power.GetPercent() > 1 ? 0 : 1;
}
