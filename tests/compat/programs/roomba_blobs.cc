// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Turns a Roomba until it sees a red thing, drives up to it, and stops when it bumps. One client reads
// the robot, and a second one on the same port reads the blobfinder.
#include <libplayerc++/playerc++.h>
#include <iostream>
#define CENTRE 160  // of the 320 columns
using namespace PlayerCc;

int main(int argc, char *argv[])
{
  PlayerClient    robot("localhost");
  BumperProxy     bp(&robot,0);
  Position2dProxy pp(&robot,0);
  PlayerClient    camera("localhost");
  BlobfinderProxy bf(&camera,0);
  pp.SetMotorEnable(true);

  int seen = 0;
  while (true)
  {
    robot.Read();
    camera.Read();
    if (bp[0] || bp[1]) break;
    double speed = 0, turnrate = 0.3;
    for (unsigned i = 0; i < bf.GetCount(); i++)
    {
      player_blobfinder_blob_t blob = bf.GetBlob(i);
      if (blob.color != 0xff0000) continue;
      seen++;
      double off = CENTRE - (double)blob.x;
      turnrate = 0.005 * off;
      speed = fabs(off) < 40 ? 0.4 : 0;
    }
    pp.SetSpeed(speed, turnrate);
  }
  pp.SetSpeed(0, 0);
  robot.Read();
  std::cout << "bumped into red, " << (seen > 50 ? "seen often" : "seen seldom") << std::endl;
  return 0;
}
