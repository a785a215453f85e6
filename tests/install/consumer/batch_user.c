/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Uses many simulations at once by the C interface. */
#include <playpen_batch.h>
#include <stdio.h>

int main(void) {
  playpen_batch_options options;
  playpen_batch_options_init(&options);
  options.simulations = 3;
  playpen_batch* batch;
  double times[3];
  playpen_batch_observations out = {0};
  out.struct_size = sizeof out;
  out.times.data = times;
  out.times.size = 3;
  if (playpen_batch_create("", &options, &batch) != PLAYPEN_BATCH_OK ||
      playpen_batch_step(batch, NULL, 20, &out) != PLAYPEN_BATCH_OK) {
    fprintf(stderr, "%s\n", playpen_batch_last_error());
    return 1;
  }
  printf("%d simulations after %.1f s\n", (int)playpen_batch_simulations(batch), times[2]);
  playpen_batch_destroy(batch);
  return 0;
}
