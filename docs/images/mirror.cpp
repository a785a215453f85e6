// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives the robot of docs/images/mirror.json along an S for the picture of docs/mirror.md (see
// make_pictures.sh).
#include <libplayerc++/playerc++.h>

int main() {
  PlayerCc::PlayerClient client("localhost", 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  PlayerCc::LaserProxy laser(&client, 0);
  try {
    for (;;) {
      client.Read();
      position.SetSpeed(0.2, position.GetXPos() < 1.0 ? -0.15 : 0.25);
    }
  } catch (const PlayerCc::PlayerError&) {
    return 0;  // the run is over
  }
}
