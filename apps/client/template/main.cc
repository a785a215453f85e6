// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

// Drives ahead and turns away from near obstacles: a starting point for your own program.
int main(int argc, char** argv) {
  // "localhost" is the simulation inside this very program; each robot has a port of its own.
  const std::string host = argc > 1 ? argv[1] : "localhost";
  const unsigned port = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 6665;
  try {
    PlayerCc::PlayerClient client(host, port);
    PlayerCc::Position2dProxy position(&client, 0);
    PlayerCc::LaserProxy laser(&client, 0);
    position.SetMotorEnable(true);
    for (;;) {
      client.Read();                           // waits for new data: a tenth of a simulated second
      const double left = laser.GetMinLeft();  // least range on the left [m]
      const double right = laser.GetMinRight();  // least range on the right [m]
      const double nearest = std::min(left, right);
      if (nearest < 0.5) {
        position.SetSpeed(0.05, left < right ? -0.8 : 0.8);  // [m/s], [rad/s] to the left
      } else {
        position.SetSpeed(std::min(0.4, nearest / 2), 0.0);
      }
    }
  } catch (const PlayerCc::PlayerError& error) {
    // Read() also throws when the simulated run ends.
    std::cerr << error.GetErrorStr() << '\n';
  }
}
