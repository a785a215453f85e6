// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders by sonar: turns away from the nearer side, and drives slower near obstacles.
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

int main(int argc, char *argv[])
{
  PlayerClient    client(PlayerCc::PLAYER_HOSTNAME, PlayerCc::PLAYER_PORTNUM);
  SonarProxy      sp(&client, 0);
  Position2dProxy pp(&client, 0);
  sp.RequestGeom();
  double least = 1e9;

  for (;;)
  {
    double turn_rate, speed;
    client.Read();

    double left = sp[0] + sp[1] + sp[2];
    double right = sp[5] + sp[6] + sp[7];
    double front = min(min(sp[2], sp[3]), min(sp[4], sp[5]));
    for (unsigned i = 0; i < sp.GetCount(); ++i)
      if (sp[i] < least) least = sp[i];

    turn_rate = left < right ? dtor(-30) : dtor(30);
    if (front > 1.5) turn_rate = limit((left - right) * 0.1, -0.3, 0.3);
    speed = front < 0.7 ? 0.0 : 0.3;
    pp.SetSpeed(speed, turn_rate);
  }
}
