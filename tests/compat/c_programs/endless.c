/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Never looks at what a call returns, and never ends: the end of the run ends it. */
#include <libplayerc/playerc.h>

int main(void)
{
  playerc_client_t *client = playerc_client_create(NULL, "localhost", 6665);
  playerc_position2d_t *position;
  playerc_laser_t *laser;
  playerc_client_connect(client);
  position = playerc_position2d_create(client, 0);
  laser = playerc_laser_create(client, 0);
  playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE);
  playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE);
  for (;;) {
    playerc_client_read(client);
    playerc_position2d_set_cmd_vel(position, 0.2, 0, laser->min_left > laser->min_right ? 1 : -1,
                                   1);
  }
}
