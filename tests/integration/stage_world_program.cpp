// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives the robot of a world of Stage and prints what its devices say.
#include <libplayerc++/playerc++.h>

#include <cstdio>

int main() {
  PlayerCc::PlayerClient client("localhost", 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  PlayerCc::RangerProxy sonar(&client, 0);
  PlayerCc::RangerProxy laser(&client, 1);
  for (int i = 0; i < 10; ++i) {
    client.Read();
    position.SetSpeed(0.5, 0.0);
  }
  for (int i = 0; i < 10; ++i) client.Read();
  std::printf("x %.2f, %u sonars, %u beams\n", position.GetXPos(), sonar.GetRangeCount(),
              laser.GetRangeCount());
  return 0;
}
