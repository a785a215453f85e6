/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Moves each joint of an arm to its limits and back home, then stops it by the power switch. */
#include <libplayerc/playerc.h>
#include <math.h>
#include <stdio.h>

static playerc_client_t *client;
static playerc_actarray_t *arm;

static int read_once(void)
{
  void *device;
  do {
    device = playerc_client_read(client);
    if (device == NULL) {
      fprintf(stderr, "%s\n", playerc_error_str());
      return -1;
    }
  } while (device != arm->info.id);
  return 0;
}

/* Waits until no joint moves, 20 s at most. */
static int wait_for_rest(void)
{
  int i, moving, rounds;
  for (rounds = 0; rounds < 200; rounds++) {
    if (read_once() != 0) return -1;
    moving = 0;
    for (i = 0; i < (int) arm->actuators_count; i++)
      if (arm->actuators_data[i].state == PLAYER_ACTARRAY_ACTSTATE_MOVING) moving = 1;
    if (!moving) return 0;
  }
  return -1;
}

int main(void)
{
  float goals[16];
  int i, count;
  player_actarray_actuatorgeom_t geom;

  client = playerc_client_create(NULL, "localhost", 6665);
  if (playerc_client_connect(client) != 0) return 1;
  if (playerc_client_datamode(client, PLAYERC_DATAMODE_PUSH) != 0) return 1;
  arm = playerc_actarray_create(client, 0);
  if (playerc_actarray_subscribe(arm, PLAYERC_OPEN_MODE) != 0) {
    fprintf(stderr, "%s\n", playerc_error_str());
    return 1;
  }
  if (playerc_actarray_get_geom(arm) != 0 || playerc_actarray_power(arm, 1) != 0) return 1;
  count = (int) arm->actuators_geom_count;
  if (count != 6 || read_once() != 0) return 2;

  for (i = 0; i < count; i++) {
    geom = playerc_actarray_get_actuator_geom(arm, (uint32_t) i);
    goals[i] = geom.max;
    if (!(geom.min < geom.max)) return 3;
  }
  if (playerc_actarray_multi_position_cmd(arm, goals, count) != 0 || wait_for_rest() != 0) return 4;
  for (i = 0; i < count; i++)
    if (fabs(arm->actuators_data[i].position - goals[i]) > 1e-3) return 5;

  for (i = 0; i < count; i++)
    if (playerc_actarray_position_cmd(arm, i, arm->actuators_geom[i].min) != 0) return 6;
  if (wait_for_rest() != 0) return 6;
  for (i = 0; i < count; i++)
    if (fabs(arm->actuators_data[i].position - arm->actuators_geom[i].min) > 1e-3) return 7;

  if (playerc_actarray_home_cmd(arm, -1) != 0 || wait_for_rest() != 0) return 8;
  for (i = 0; i < count; i++)
    if (fabs(arm->actuators_data[i].position - arm->actuators_geom[i].home) > 1e-3) return 9;

  if (playerc_actarray_speed_cmd(arm, 0, 0.3f) != 0) return 10;
  for (i = 0; i < 10; i++)
    if (read_once() != 0) return 10;
  if (fabs(arm->actuators_data[0].speed - 0.3) > 1e-3) return 11;
  if (playerc_actarray_power(arm, 0) != 0 || read_once() != 0) return 12;
  printf("%d joints, motors %s, joint 0 at %.3f\n", count, arm->motor_state ? "on" : "off",
         arm->actuators_data[0].position);
  if (arm->motor_state != 0 || arm->actuators_data[0].speed != 0.0f) return 13;

  playerc_actarray_unsubscribe(arm);
  playerc_actarray_destroy(arm);
  playerc_client_disconnect(client);
  playerc_client_destroy(client);
  return 0;
}
