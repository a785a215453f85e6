// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program that never reads: it drives by sleeping.
#include <libplayerc++/playerc++.h>
#include <unistd.h>

int main() {
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::Position2dProxy position(&robot, 0);
  position.SetSpeed(0.1, 0.0);
  usleep(3000000);
  position.SetSpeed(0.0, 0.0);
  usleep(500000);
  return 0;
}
