// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program that uses both client libraries: it reads with one and commands with the other.
#include <libplayerc++/playerc++.h>
#include <libplayerc/playerc.h>

int main() {
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::Position2dProxy seen(&robot, 0);
  playerc_client_t* client = playerc_client_create(NULL, "localhost", 6665);
  if (playerc_client_connect(client) != 0) return 1;
  playerc_position2d_t* driven = playerc_position2d_create(client, 0);
  if (playerc_position2d_subscribe(driven, PLAYERC_OPEN_MODE) != 0) return 1;
  robot.Read();
  const double start_x = seen.GetXPos(), start_y = seen.GetYPos();
  playerc_position2d_set_cmd_vel(driven, 0.2, 0, 0, 1);
  for (int i = 0; i < 10; i++) robot.Read();
  const double way = hypot(seen.GetXPos() - start_x, seen.GetYPos() - start_y);
  std::cout << (way > 0.05 ? "one robot for both libraries" : "two robots") << std::endl;
  playerc_position2d_destroy(driven);
  playerc_client_destroy(client);
  return 0;
}
