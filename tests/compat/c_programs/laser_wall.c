/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Drives towards a wall and stops before it. Callbacks do the work; the loop only reads, a round
   at a time, and lets go of things in an order of its own. */
#include <libplayerc/playerc.h>
#include <math.h>
#include <stdio.h>

static playerc_laser_t *laser;
static playerc_position2d_t *position;
static int scans, poses, rounds;

static void on_scan(void *data)
{
  double *stop = data;
  double nearest = laser->max_range, ahead;
  int i;
  for (i = 0; i < laser->scan_count; i++) {
    /* Only what lies in the way of the robot. */
    if (laser->point[i].px > 0 && fabs(laser->point[i].py) < 0.1 && laser->scan[i][0] < nearest)
      nearest = laser->scan[i][0];
  }
  ahead = fmax(0.0, fmin(0.4, nearest - *stop));
  playerc_position2d_set_cmd_vel(position, ahead, 0, 0, 1);
  scans++;
}

static void on_pose(void *data)
{
  (*(int *)data)++;
}

int main(void)
{
  playerc_client_t *client = playerc_client_create(NULL, "localhost", 6665);
  double stop = 0.3, front;
  void *device;

  if (playerc_client_connect(client) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  if (playerc_client_set_replace_rule(client, -1, -1, PLAYER_MSGTYPE_DATA, -1, 1) != 0) return 1;

  laser = playerc_laser_create(client, 0);
  position = playerc_position2d_create(client, 0);
  if (playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE) != 0 ||
      playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  playerc_client_addcallback(client, &laser->info, on_scan, &stop);
  playerc_client_addcallback(client, &position->info, on_pose, &poses);
  if (playerc_laser_get_geom(laser) != 0) return 1;

  while (rounds < 150) {
    device = playerc_client_read(client);
    if (device == NULL) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return 1;
    }
    if (device != client) return 5;
    rounds++;
    laser->info.fresh = 0;
  }
  front = laser->ranges[laser->scan_count / 2];
  printf("%s: %d rounds, %d scans of %d beams, %d poses; %.3f m to the wall, stall %d\n",
         laser->info.drivername, rounds, scans, laser->scan_count, poses, front, position->stall);
  if (scans != rounds || poses != rounds) return 2;
  if (fabs(front - stop) > 0.01 || position->stall) return 3;
  if (fabs(laser->info.datatime - 15.0) > 1e-6) return 4;

  /* The client goes first. */
  playerc_client_destroy(client);
  playerc_laser_destroy(laser);
  playerc_position2d_destroy(position);
  return 0;
}
