// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program for onlooker_test: for each line of its standard input it reads 100 times and
// drives by what its laser sees, and then prints "drove".
#include <libplayerc++/playerc++.h>

#include <cstdio>
#include <iostream>
#include <string>

int main() {
  try {
    PlayerCc::PlayerClient client("localhost", 6665);
    PlayerCc::Position2dProxy position(&client, 0);
    PlayerCc::LaserProxy laser(&client, 0);
    std::string line;
    while (std::getline(std::cin, line)) {
      for (int i = 0; i < 100; ++i) {
        client.Read();
        // The noise of a beam decides where the robot goes.
        if (laser.GetCount() > 0) position.SetSpeed(0.05, laser.GetRange(laser.GetCount() / 2) - 1);
      }
      std::printf("drove\n");
      std::fflush(stdout);
    }
  } catch (const PlayerCc::PlayerError& error) {
    std::fprintf(stderr, "told: %s\n", error.GetErrorStr().c_str());
    return 3;
  }
  return 0;
}
