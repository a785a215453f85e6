// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives thirteen robots with one client. All proxies use one port, and their index selects the
// robot.
#include <libplayerc++/playerc++.h>
#include <iostream>
#include <vector>

using namespace PlayerCc;

#define ROBOTS 13

int main()
{
  PlayerClient client("localhost", 6665);
  std::vector<Position2dProxy*> pos;
  std::vector<RangerProxy*> sonar;
  std::vector<LaserProxy*> laser;
  for (int i = 0; i < ROBOTS; i++) {
    pos.push_back(new Position2dProxy(&client, i));
    laser.push_back(new LaserProxy(&client, i));
    sonar.push_back(new RangerProxy(&client, 2 * i + 1));
    pos[i]->SetMotorEnable(true);
  }

  // Each robot drives anticlockwise on a circle and avoids obstacles with its laser.
  for (int step = 0; step < 550; step++) {
    client.Read();
    for (int i = 0; i < ROBOTS; i++) {
      double nearest = 8.0;
      for (unsigned int b = laser[i]->GetCount() / 3; b < 2 * laser[i]->GetCount() / 3; b++)
        if ((*laser[i])[b] < nearest) nearest = (*laser[i])[b];
      if (nearest < 1.0)
        pos[i]->SetSpeed(0.0, 0.4);
      else
        pos[i]->SetSpeed(0.2 + 0.01 * i, 0.03);
    }
  }
  int driven = 0;
  for (int i = 0; i < ROBOTS; i++) {
    std::cout << "robot " << i << ": x " << pos[i]->GetXPos() << ", " << sonar[i]->GetRangeCount()
              << " sonars" << std::endl;
    if (pos[i]->GetXPos() != 0.0) driven++;
    pos[i]->SetSpeed(0.0, 0.0);
  }
  std::cout << driven << " of " << ROBOTS << " robots drove" << std::endl;
  for (int i = 0; i < ROBOTS; i++) {
    delete pos[i];
    delete laser[i];
    delete sonar[i];
  }
  return 0;
}
