// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// One thread reads four clients in turn, one per port.
#include <libplayerc++/playerc++.h>
#include <vector>
#include <sstream>
using namespace PlayerCc;

struct Robot {
  PlayerClient client;
  Position2dProxy position;
  LaserProxy laser;
  Robot(int port) : client("localhost", port), position(&client, 0), laser(&client, 0) {}
};

int main(int argc, char **argv)
{
  std::vector<Robot *> robots;
  for (int i = 0; i < 4; i++) robots.push_back(new Robot(6665 + i));
  for (int round = 0; round < 300; ++round) {
    for (size_t i = 0; i < robots.size(); i++) {
      Robot &r = *robots[i];
      r.client.Read();
      double left = r.laser.GetMinLeft(), right = r.laser.GetMinRight();
      double nearest = left < right ? left : right;
      if (nearest < 0.7)
        r.position.SetSpeed(0.0, left > right ? 0.5 : -0.5);
      else
        r.position.SetSpeed(0.2 + 0.05 * i, 0.0);
    }
  }
  for (size_t i = 0; i < robots.size(); i++) {
    std::cout << "robot " << i << " at " << robots[i]->position.GetXPos() << std::endl;
    delete robots[i];
  }
  return 0;
}
