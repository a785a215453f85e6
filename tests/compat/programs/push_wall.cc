// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives straight ahead without using sensors.
#include <libplayerc++/playerc++.h>

int main()
{
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy position(&client, 0);
  for (int i = 0; i < 290; i++) {
    client.Read();
    position.SetSpeed(0.5, 0);
  }
  return 0;
}
