// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Wanders with the thirteen infrared rangers of a Scorpion, by their names in its driver's header.
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

enum { BN_ENE, BN_WNW, BN_N, BN_NE, BN_NW, TE_NNW, TE_NNE, TW_NNW, TW_NNE, BS_W, BS_E, BW_S, BE_S };

int main(int argc, char **argv)
{
  PlayerClient client("localhost", 6665);
  IrProxy ir(&client, 0);
  Position2dProxy pos(&client, 0);
  ir.RequestGeom();
  pos.SetMotorEnable(true);
  int turns = 0;
  bool turning = false;
  double turnrate = 0;
  for (int t = 0; t < 590; t++) {
    client.Read();
    // those that look ahead, and those in the bumper, which cross one another
    double front = 10;
    const int ahead[] = {BN_N, BN_NE, BN_NW, TE_NNW, TE_NNE, TW_NNW, TW_NNE};
    for (int i = 0; i < 7; i++) {
      double r = ir[ahead[i]];
      if (r < front) front = r;
    }
    double left = ir[BS_W] + ir[BN_WNW] + ir[TW_NNW] + ir[BN_NW];
    double right = ir[BS_E] + ir[BN_ENE] + ir[TE_NNE] + ir[BN_NE];
    if (front < 0.4) {
      if (!turning) {
        turns++;
        turnrate = left > right ? 0.9 : -0.9;
      }
      turning = true;
      pos.SetSpeed(0, turnrate);
    } else if (front > 0.55 || !turning) {
      turning = false;
      pos.SetSpeed(0.25, 0.2 * (left - right));
    }
  }
  pos.SetSpeed(0, 0);
  std::cout << ir.GetCount() << " infra-reds, turned " << turns << " times, the left one looks to "
            << rtod(ir.GetPose(BS_W).pyaw) << " degrees" << std::endl;
  return 0;
}
