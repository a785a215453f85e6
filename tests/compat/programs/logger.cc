// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Writes its readings into a file as text, and prints proxies with operator<<.
#include <libplayerc++/playerc++.h>
#include <fstream>
#include <iomanip>
using namespace std;
using namespace PlayerCc;

int main(int argc, char **argv)
{
  PlayerClient robot("localhost");
  Position2dProxy pp(&robot, 0);
  LaserProxy lp(&robot, 0);
  SonarProxy sp(&robot, 0);
  ofstream log(argc > 1 ? argv[1] : "log.txt");
  for (int i = 0; i < 100; ++i) {
    robot.Read();
    pp.SetSpeed(0.2, i < 50 ? 0.2 : -0.2);
    log << fixed << setprecision(3) << pp.GetDataTime() << '\t' << pp.GetXPos() << '\t' << pp.GetYPos() << '\t'
        << pp.GetYaw() << '\t' << lp.GetCount() << '\t' << lp.GetRange(lp.GetCount() / 2) << '\t' << sp[3] << '\n';
  }
  pp.SetSpeed(0, 0);
  cout << robot << endl << pp << endl << sp << endl;
  list<playerc_device_info_t> devices;
  robot.RequestDeviceList();
  devices = robot.GetDeviceList();
  for (list<playerc_device_info_t>::iterator i = devices.begin(); i != devices.end(); ++i)
    cout << robot.LookupName(i->addr.interf) << ":" << i->addr.index << " " << i->drivername << endl;
  return log.good() && devices.size() > 3 ? 0 : 1;
}
