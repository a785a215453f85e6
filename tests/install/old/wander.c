/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
   A program in C as they were written for Player. */
#include <libplayerc/playerc.h>
#include <stdio.h>

int main(int argc, char** argv) {
  int i;
  playerc_client_t* client = playerc_client_create(NULL, argc > 1 ? argv[1] : "localhost", 6665);
  playerc_position2d_t* position;
  if (playerc_client_connect(client) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  position = playerc_position2d_create(client, 0);
  if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  playerc_position2d_enable(position, 1);
  for (i = 0; i < 50; i++) {
    playerc_client_read(client);
    playerc_position2d_set_cmd_vel(position, 0.1, 0, 0.2, 1);
  }
  printf("drove to %.3f %.3f\n", position->px, position->py);
  playerc_position2d_unsubscribe(position);
  playerc_position2d_destroy(position);
  playerc_client_disconnect(client);
  playerc_client_destroy(client);
  return 0;
}
