// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Turns until its camera sees something blue, then drives up to the largest blob of that colour.
#include <libplayerc++/playerc++.h>
#include <iostream>

int main(int argc, char *argv[])
{
  using namespace PlayerCc;
  PlayerClient robot("localhost", 6665);
  Position2dProxy p2dProxy(&robot, 0);
  BlobfinderProxy blobProxy(&robot, 0);
  PtzProxy ptz(&robot, 0);

  p2dProxy.SetMotorEnable(1);
  ptz.SetCam(0, 0, dtor(60));
  while (true) {
    robot.Read();
    int noBlobs = blobProxy.GetCount();
    uint32_t biggestArea = 0;
    playerc_blobfinder_blob_t blob;
    for (int i = 0; i < noBlobs; i++) {
      player_blobfinder_blob current = blobProxy[i];
      if (current.color == 0x2040e0 && current.area > biggestArea) {
        biggestArea = current.area;
        blob = current;
      }
    }
    if (biggestArea == 0) {
      p2dProxy.SetSpeed(0, 0.5);
      continue;
    }
    if (blob.range < 0.6) {
      p2dProxy.SetSpeed(0, 0);
      robot.Read();
      std::cout << "blob " << blob.left << ".." << blob.right << " x " << blob.top << ".." << blob.bottom
                << " of " << blobProxy.GetWidth() << "x" << blobProxy.GetHeight() << " reached" << std::endl;
      std::cout << blobProxy << ptz;
      return 0;
    }
    int margin = blobProxy.GetWidth() / 20;
    int centre = blobProxy.GetWidth() / 2;
    double turn = 0;
    if ((int)blob.x < centre - margin) turn = 0.2;
    if ((int)blob.x > centre + margin) turn = -0.2;
    p2dProxy.SetSpeed(turn == 0 ? 0.4 : 0.1, turn);
  }
}
