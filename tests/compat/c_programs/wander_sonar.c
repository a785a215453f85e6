/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Half a minute in the cave by sonar: away from what is near, and back from what was bumped into. */
#include <libplayerc/playerc.h>
#include <math.h>
#include <stdio.h>

int main(void)
{
  playerc_client_t *client = playerc_client_create(NULL, "localhost", 6665);
  playerc_position2d_t *position;
  playerc_sonar_t *sonar;
  playerc_bumper_t *bumper;
  double way = 0, x = 0, y = 0, left, right;
  int i, bumped, bumps = 0, readings = 0;

  if (playerc_client_connect(client) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  position = playerc_position2d_create(client, 0);
  sonar = playerc_sonar_create(client, 0);
  bumper = playerc_bumper_create(client, 0);
  if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0 ||
      playerc_sonar_subscribe(sonar, PLAYERC_OPEN_MODE) != 0 ||
      playerc_bumper_subscribe(bumper, PLAYERC_OPEN_MODE) != 0 ||
      playerc_sonar_get_geom(sonar) != 0 || playerc_bumper_get_geom(bumper) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  printf("%d sonars, %d bumpers\n", sonar->pose_count, bumper->pose_count);
  playerc_position2d_enable(position, 1);

  while (position->info.datatime < 30) {
    if (playerc_client_read(client) == NULL) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return 2;
    }
    if (position->info.fresh) {
      if (readings++ > 0) way += hypot(position->px - x, position->py - y);
      x = position->px;
      y = position->py;
      position->info.fresh = 0;
    }
    if (!sonar->info.fresh) continue;
    sonar->info.fresh = 0;

    left = right = 3;
    for (i = 0; i < sonar->scan_count; i++) {
      if (sonar->poses[i].pyaw > 0 && sonar->poses[i].pyaw < DTOR(95))
        left = MIN(left, sonar->scan[i]);
      else if (sonar->poses[i].pyaw < 0 && sonar->poses[i].pyaw > -DTOR(95))
        right = MIN(right, sonar->scan[i]);
    }
    bumped = 0;
    for (i = 0; i < bumper->bumper_count; i++) bumped |= bumper->bumpers[i];
    bumps += bumped;
    if (bumped)
      playerc_position2d_set_cmd_vel(position, -0.2, 0, 0.5, 1);
    else
      playerc_position2d_set_cmd_vel(position, MIN(left, right) > 0.5 ? 0.3 : 0.05, 0,
                                     MIN(left, right) > 1 ? 0 : left < right ? -0.8 : 0.8, 1);
  }
  printf("%d poses, %.2f m, bumped %d times\n", readings, way, bumps);
  playerc_bumper_destroy(bumper);
  playerc_sonar_destroy(sonar);
  playerc_position2d_destroy(position);
  playerc_client_destroy(client);
  return way > 3 ? 0 : 3;
}
