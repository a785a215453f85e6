// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders with a ring of sixteen infrared rangers. Ranger 0 points ahead; the numbers increase
// anticlockwise.
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

#define IRS 16

int main(int argc, char **argv)
{
  PlayerClient client("localhost", 6665);
  IrProxy ir(&client, 0);
  Position2dProxy pos(&client, 0);
  ir.RequestGeom();
  pos.SetMotorEnable(true);
  int turns = 0;
  bool turning = false;
  for (int t = 0; t < 590; t++) {
    client.Read();
    // the five rangers that point forward
    double front = 10, left = 0, right = 0;
    for (int i = -2; i <= 2; i++) {
      double r = ir[(i + IRS) % IRS];
      if (r < front) front = r;
    }
    for (int i = 1; i <= 4; i++) {
      left += ir[i];
      right += ir[IRS - i];
    }
    if (front < 0.3) {
      if (!turning) turns++;
      turning = true;
      pos.SetSpeed(0, left > right ? 0.9 : -0.9);
    } else if (front > 0.45 || !turning) {
      turning = false;
      pos.SetSpeed(0.25, 0.2 * (left - right));
    }
  }
  pos.SetSpeed(0, 0);
  std::cout << ir.GetCount() << " infra-reds, turned " << turns << " times, the last looks to "
            << rtod(ir.GetPose(15).pyaw) << " degrees" << std::endl;
  return 0;
}
