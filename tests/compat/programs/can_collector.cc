// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A Pioneer turns until it sees something red, drives to it, takes it and puts it into its store.
// It does this twice.
#include <iostream>
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

int main(int argc, char **argv)
{
  PlayerClient robot("localhost", 6665);
  Position2dProxy pos(&robot, 0);
  BlobfinderProxy blobs(&robot, 0);
  GripperProxy gripper(&robot, 0);

  pos.SetMotorEnable(true);
  gripper.Open();
  int cans = 0;
  while (cans < 2) {
    robot.Read();
    if (gripper.GetInnerBreakBeam()) {
      pos.SetSpeed(0, 0);
      gripper.Close();
      do
        robot.Read();
      while (gripper.GetState() == PLAYER_GRIPPER_STATE_MOVING || gripper.GetState() == PLAYER_GRIPPER_STATE_OPEN);
      if (gripper.GetState() != PLAYER_GRIPPER_STATE_CLOSED) return 2;
      gripper.Store();
      cans++;
      std::cout << "can " << cans << " at " << pos.GetXPos() << " " << pos.GetYPos() << std::endl;
      for (int i = 0; i < 10; i++) robot.Read();
      continue;
    }
    bool seen = false;
    double to_left = 0;
    uint32_t largest = 0;
    for (uint32_t i = 0; i < blobs.GetCount(); i++) {
      if (blobs[i].color != 0xff0000 || blobs[i].area < largest) continue;
      seen = true;
      largest = blobs[i].area;
      to_left = 0.5 - (blobs[i].x + 0.5) / blobs.GetWidth();
    }
    if (seen)
      pos.SetSpeed(to_left > 0.1 || to_left < -0.1 ? 0.05 : 0.2, 1.5 * to_left);
    else
      pos.SetSpeed(0, 0.5);
  }
  pos.SetSpeed(0, 0);
  std::cout << cans << " cans in the store" << std::endl;
  return 0;
}
