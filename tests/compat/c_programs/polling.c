/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Never waits: looks whether data are there, and does something else meanwhile. */
#include <libplayerc/playerc.h>
#include <stdio.h>

int main(void)
{
  playerc_client_t *client = playerc_client_create(NULL, "localhost", 6665);
  playerc_position2d_t *position;
  long idle = 0;
  int readings = 0, got;

  if (playerc_client_connect(client) != 0) return 1;
  position = playerc_position2d_create(client, 0);
  if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0) return 1;
  playerc_position2d_set_cmd_vel(position, 0.1, 0, 0, 1);
  while (readings < 50) {
    got = playerc_client_read_nonblock(client);
    if (got < 0) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return 2;
    }
    if (got > 0) readings++;
    else idle++;
  }
  printf("%d readings, %ld times nothing to do, at %.3f %.3f after %.1f s\n", readings, idle,
         position->px, position->py, position->info.datatime);
  playerc_position2d_destroy(position);
  playerc_client_destroy(client);
  /* Ten a second, and a step of 10 ms each time that there is nothing. */
  return idle > 0 ? 0 : 3;
}
