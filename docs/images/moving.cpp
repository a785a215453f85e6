// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The robot of worlds/examples/moving.json: it pushes the crates and the drum along. It draws the
// picture of docs/moving_obstacles.md (see make_pictures.sh).
#include <libplayerc++/playerc++.h>

int main() {
  PlayerCc::PlayerClient client("localhost", 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  try {
    for (;;) {
      client.Read();
      position.SetSpeed(0.2, 0.0);
    }
  } catch (const PlayerCc::PlayerError&) {
    return 0;  // the run is over
  }
}
