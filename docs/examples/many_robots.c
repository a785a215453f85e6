/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* 64 robots, each in a simulation of its own, roam for a minute. A robot that collides begins anew.
 * Usage: many_robots [WORLD]. docs/many_simulations.md explains it. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <playpen_batch.h>

enum { N = 64 };

static void check(playpen_batch_status status) {
  if (status == PLAYPEN_BATCH_OK) return;
  fprintf(stderr, "many_robots: %s\n", playpen_batch_last_error());
  exit(1);
}

int main(int argc, char** argv) {
  playpen_batch_options options;
  playpen_batch_options_init(&options);
  options.simulations = N;
  options.beams = 36;
  playpen_batch* batch;
  check(playpen_batch_create(argc > 1 ? argv[1] : "", &options, &batch));
  if (playpen_batch_robots(batch) != 1 || playpen_batch_beams(batch) != 36) {
    fprintf(stderr, "many_robots: expected a world of one robot with a laser\n");
    return 1;
  }

  /* A row for each simulation; here with one robot each. */
  static double actions[N][2];
  static float scans[N][36];
  static int32_t collisions[N];
  static double poses[N][3];
  const playpen_batch_array action_array = {actions, N * 2, 0, 0};
  playpen_batch_observations out = {0};
  out.struct_size = sizeof out;
  out.scans.data = scans;
  out.scans.size = N * 36;
  out.collisions.data = collisions;
  out.collisions.size = N;
  out.poses.data = poses;
  out.poses.size = N * 3;
  check(playpen_batch_observe(batch, &out));

  int crashes = 0;
  for (int decision = 0; decision < 600; ++decision) {
    for (int i = 0; i < N; ++i) {
      float ahead = 5.0F; /* least range up to 45 degrees aside */
      for (int beam = 12; beam < 24; ++beam) {
        if (scans[i][beam] < ahead) ahead = scans[i][beam];
      }
      /* Each robot has its own speed, and so its own way. The fastest ones do not always stop in time. */
      actions[i][0] = ahead < 0.14F ? 0.0 : 0.2 + 0.004 * i;
      actions[i][1] = ahead < 0.14F ? 1.5 : 0.0;
    }
    check(playpen_batch_step(batch, &action_array, 10, &out)); /* 0.1 s */

    uint8_t crashed[N];
    int count = 0;
    for (int i = 0; i < N; ++i) {
      crashed[i] = collisions[i] > 0;
      count += crashed[i];
    }
    if (count == 0) continue;
    crashes += count;
    check(playpen_batch_reset(batch, crashed, N, NULL, 0, NULL));
    check(playpen_batch_observe(batch, &out));
  }
  printf("%d robots, %d threads, 60 s: %d collisions\n", N, (int)playpen_batch_threads(batch), crashes);
  printf("the first robot is at (%.3f, %.3f), the last one at (%.3f, %.3f)\n", poses[0][0],
         poses[0][1], poses[N - 1][0], poses[N - 1][1]);
  playpen_batch_destroy(batch);
  return 0;
}
