// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives into the next wall, logs all readings of its robot, and prints; for mcap_test.py.
// Usage: logging_program SECONDS
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::Position2dProxy position(&robot, 0);
  PlayerCc::LogProxy log(&robot, 0);
  log.SetFilename("readings");
  log.SetWriteState(1);
  do {
    robot.Read();
    position.SetSpeed(0.3, 0.2 * std::sin(position.GetDataTime()));
    std::cout << "at " << position.GetXPos() << '\n';
  } while (position.GetDataTime() < std::atof(argv[1]));
  return 0;
}
