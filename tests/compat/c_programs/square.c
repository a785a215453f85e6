/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* A square of 0.5 m by odometry: ahead until the way is long enough, round until the heading is
   right. The results of calls are looked at, as careful programs do. */
#include <libplayerc/playerc.h>
#include <math.h>
#include <stdio.h>

#define SIDE 0.5
#define QUARTER 1.5707963267948966

static playerc_client_t *client;
static playerc_position2d_t *position;

/* Waits for the next position. */
static int next(void)
{
  void *device;
  do {
    device = playerc_client_read(client);
    if (device == NULL) {
      fprintf(stderr, "error: %s\n", playerc_error_str());
      return -1;
    }
  } while (device != position->info.id);
  return 0;
}

static int ahead(double length)
{
  double x, y, left;
  if (next() != 0) return -1;
  x = position->px;
  y = position->py;
  while ((left = length - hypot(position->px - x, position->py - y)) > 0.001) {
    playerc_position2d_set_cmd_vel(position, fmin(0.3, 0.01 + left), 0, 0, 1);
    if (next() != 0) return -1;
  }
  playerc_position2d_set_cmd_vel(position, 0, 0, 0, 1);
  return 0;
}

static int turn(double angle)
{
  double goal, left;
  if (next() != 0) return -1;
  goal = position->pa + angle;
  while (fabs(left = atan2(sin(goal - position->pa), cos(goal - position->pa))) > 0.002) {
    playerc_position2d_set_cmd_vel(position, 0, 0, fmax(-1.0, fmin(1.0, 2 * left)), 1);
    if (next() != 0) return -1;
  }
  playerc_position2d_set_cmd_vel(position, 0, 0, 0, 1);
  return 0;
}

int main(int argc, char *argv[])
{
  const char *host = argc > 1 ? argv[1] : "localhost";
  double x, y;
  int i;

  client = playerc_client_create(NULL, host, 6665);
  if (playerc_client_connect(client) != 0) {
    fprintf(stderr, "error: %s\n", playerc_error_str());
    return 1;
  }
  if (playerc_client_datamode(client, PLAYERC_DATAMODE_PUSH) != 0) return 1;
  position = playerc_position2d_create(client, 0);
  if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0) {
    fprintf(stderr, "error: %s\n", playerc_error_str());
    return 1;
  }
  if (playerc_position2d_get_geom(position) != 0) return 1;
  playerc_position2d_enable(position, 1);

  if (next() != 0) return 1;
  x = position->px;
  y = position->py;
  for (i = 0; i < 4; i++) {
    if (ahead(SIDE) != 0 || turn(QUARTER) != 0) return 1;
    printf("corner %d: %.3f %.3f %.3f\n", i, position->px, position->py, position->pa);
    if (i == 1 && fabs(hypot(position->px - x, position->py - y) - sqrt(2) * SIDE) > 0.02) return 2;
  }
  printf("closed within %.3f m, robot of %.3f x %.3f m\n",
         hypot(position->px - x, position->py - y), position->size[0], position->size[1]);
  if (hypot(position->px - x, position->py - y) > 0.02) return 3;

  playerc_position2d_unsubscribe(position);
  playerc_position2d_destroy(position);
  playerc_client_disconnect(client);
  playerc_client_destroy(client);
  return 0;
}
