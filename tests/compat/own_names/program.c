/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Reads ten rounds while it drives, and saves a picture. own_names_test.py links it with a file that
   defines names of the C library. */
#include <libplayerc/playerc.h>

int main(int argc, char *argv[])
{
  playerc_client_t *client = playerc_client_create(NULL, argc > 1 ? argv[1] : "localhost", 6665);
  playerc_position2d_t *position;
  playerc_laser_t *laser;
  playerc_camera_t *camera;
  int i;

  if (playerc_client_connect(client) != 0) return 1;
  position = playerc_position2d_create(client, 0);
  laser = playerc_laser_create(client, 0);
  camera = playerc_camera_create(client, 0);
  if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0) return 2;
  if (playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE) != 0) return 3;
  if (playerc_camera_subscribe(camera, PLAYERC_OPEN_MODE) != 0) return 4;
  playerc_position2d_set_cmd_vel(position, 0.2, 0, 0, 1);
  for (i = 0; i < 10; i++)
    if (playerc_client_read(client) == NULL) return 5;
  if (laser->scan_count < 100 || position->vx < 0.1) return 6;
  if (argc > 2) playerc_camera_save(camera, argv[2]);
  /* An error, with its text. */
  if (playerc_position2d_subscribe(playerc_position2d_create(client, 7), PLAYERC_OPEN_MODE) == 0) return 7;
  playerc_client_destroy(client);
  return 0;
}
