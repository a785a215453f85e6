/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Three robots on three ports, read together by one thread: each turns at its own rate. */
#include <libplayerc/playerc.h>
#include <math.h>
#include <stdio.h>

#define ROBOTS 3

int main(void)
{
  playerc_mclient_t *mclient = playerc_mclient_create();
  playerc_client_t *client[ROBOTS];
  playerc_position2d_t *position[ROBOTS];
  int readings[ROBOTS] = {0};
  double turned[ROBOTS] = {0};
  double last[ROBOTS] = {0};
  int i;

  for (i = 0; i < ROBOTS; i++) {
    client[i] = playerc_client_create(mclient, "localhost", 6665 + i);
    if (playerc_client_connect(client[i]) != 0) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return 1;
    }
    position[i] = playerc_position2d_create(client[i], 0);
    if (playerc_position2d_subscribe(position[i], PLAYERC_OPEN_MODE) != 0) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return 1;
    }
    if (playerc_position2d_set_cmd_vel(position[i], 0, 0, 0.2 * (i + 1), 1) != 0) return 1;
  }

  while (mclient->time < 10.0) {
    if (playerc_mclient_read(mclient, 1000) <= 0) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return 2;
    }
    for (i = 0; i < ROBOTS; i++) {
      if (!position[i]->info.fresh) continue;
      position[i]->info.fresh = 0;
      if (readings[i]++ > 0)
        turned[i] += atan2(sin(position[i]->pa - last[i]), cos(position[i]->pa - last[i]));
      last[i] = position[i]->pa;
    }
  }
  for (i = 0; i < ROBOTS; i++) {
    printf("robot %d: %d readings, turned by %.3f rad until %.2f s\n", i, readings[i], turned[i],
           position[i]->info.datatime);
    /* Ten a second; the first is after a tenth of a second of turning, with a ramp. */
    if (readings[i] != 100) return 3;
    if (fabs(turned[i] - 0.2 * (i + 1) * 9.9) > 0.1) return 4;
  }
  for (i = 0; i < ROBOTS; i++) {
    playerc_position2d_destroy(position[i]);
    playerc_client_destroy(client[i]);
  }
  playerc_mclient_destroy(mclient);
  return 0;
}
