// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Follows the wall on its right at 0.8 m.
#include <libplayerc++/playerc++.h>
#include <math.h>
#include <stdio.h>
using namespace PlayerCc;

#define DISTANCE 0.8

static double range_at(LaserProxy &laser, double bearing)
{
  double best = 1e9, range = laser.GetMaxRange();
  for (uint i = 0; i < laser.GetCount(); i++) {
    double off = fabs(laser.GetBearing(i) - bearing);
    if (off < best) {
      best = off;
      range = laser.GetRange(i);
    }
  }
  return range;
}

int main(int argc, char **argv)
{
  PlayerClient client("localhost", 6665);
  LaserProxy laser(&client, 0);
  Position2dProxy position(&client, 0);
  client.Read();
  while (1) {
    client.Read();
    double side = range_at(laser, DTOR(-90)), ahead_side = range_at(laser, DTOR(-45)),
           ahead = range_at(laser, 0);
    for (int a = -20; a <= 20; a += 5) ahead = MIN(ahead, range_at(laser, DTOR(a)));
    double slope = ahead_side / sqrt(2.0) - side;  // 0 along the wall
    double turn = -0.8 * (side - DISTANCE) - 0.6 * slope;
    turn = MAX(-0.7, MIN(0.7, turn));
    if (ahead < 1.1) turn = 0.7;
    position.SetSpeed(ahead < 0.8 ? 0.02 : 0.3, turn);
  }
  return 0;
}
