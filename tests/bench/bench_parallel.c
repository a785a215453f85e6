/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Speed of many simulations at once, by the C interface: decisions with a fresh scan each, by a trivial
 * policy, for one robot in the SyRoTek arena. Prints lines "figure NAME VALUE".
 *
 * On a machine with other work, only figures per second of processor time mean something:
 *   per_cpu_second       decisions in a second of processor time of the whole process
 *   per_second           decisions in a second of the wall clock
 *   work_of_2_threads    processor time of a decision with two threads over that with one; two idle
 *                        processors are 2 / work_of_2_threads times as fast as one
 *   speedup_of_2_threads by the wall clock, the median of rounds that alternate
 */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "playpen_batch.h"

enum { kMostSimulations = 1024, kRounds = 9 };

typedef struct {
  playpen_batch* batch;
  double* actions;
  float* scans;
  int simulations;
  int beams;
} Work;

typedef struct {
  double cpu_s;
  double wall_s;
} Times;

static void check(playpen_batch_status status) {
  if (status == PLAYPEN_BATCH_OK) return;
  fprintf(stderr, "bench_parallel: %s\n", playpen_batch_last_error());
  exit(1);
}

static Work make(int simulations, int threads, int beams) {
  playpen_batch_options options;
  playpen_batch_options_init(&options);
  options.simulations = simulations;
  options.threads = threads;
  options.beams = beams;
  Work work;
  work.simulations = simulations;
  check(playpen_batch_create(PLAYPEN_SOURCE_DIR "/worlds/syrotek.json", &options, &work.batch));
  /* Each robot begins with another heading. */
  double poses[kMostSimulations * 3];
  for (int i = 0; i < simulations; ++i) {
    poses[3 * i] = 0.5;
    poses[3 * i + 1] = 0.4;
    poses[3 * i + 2] = 6.28 * i / simulations;
  }
  const playpen_batch_array starts = {poses, (size_t)simulations * 3, 0, 0};
  check(playpen_batch_reset(work.batch, NULL, 0, NULL, 0, &starts));
  work.beams = playpen_batch_beams(work.batch);
  work.actions = calloc((size_t)simulations * 2, sizeof(double));
  work.scans = calloc((size_t)simulations * (size_t)work.beams, sizeof(float));
  return work;
}

static void destroy(Work* work) {
  playpen_batch_destroy(work->batch);
  free(work->actions);
  free(work->scans);
}

/* Drives on, and turns away from what is near ahead. */
static void decide(const Work* work) {
  enum { kRays = 12 };
  for (int i = 0; i < work->simulations; ++i) {
    const float* scan = work->scans + (size_t)i * (size_t)work->beams;
    const int middle = work->beams / 2;
    const int step = work->beams / 40;
    float left = 5.0F;
    float right = 5.0F;
    for (int k = 0; k < kRays; ++k) {
      const float on_left = scan[middle + k * step];
      const float on_right = scan[middle - k * step];
      left = on_left < left ? on_left : left;
      right = on_right < right ? on_right : right;
    }
    const float nearest = left < right ? left : right;
    work->actions[2 * i] = nearest > 0.3F ? 0.3 : 0.0;
    work->actions[2 * i + 1] = nearest > 0.3F ? 0.0 : i % 2 == 0 ? 1.5 : -1.5;
  }
}

static double seconds_of(const struct timeval* time) {
  return (double)time->tv_sec + 1e-6 * (double)time->tv_usec;
}

static Times now(void) {
  struct rusage usage;
  struct timespec wall;
  getrusage(RUSAGE_SELF, &usage);
  clock_gettime(CLOCK_MONOTONIC, &wall);
  Times times = {seconds_of(&usage.ru_utime) + seconds_of(&usage.ru_stime),
                 (double)wall.tv_sec + 1e-9 * (double)wall.tv_nsec};
  return times;
}

/* Times of a decision. */
static Times run(const Work* work, int decisions, int steps) {
  playpen_batch_array actions = {work->actions, (size_t)work->simulations * 2, 0, 0};
  playpen_batch_observations out;
  memset(&out, 0, sizeof out);
  out.struct_size = sizeof out;
  out.scans.data = work->scans;
  out.scans.size = (size_t)work->simulations * (size_t)work->beams;
  const int calls = decisions / work->simulations;
  const Times before = now();
  for (int k = 0; k < calls; ++k) {
    decide(work);
    check(playpen_batch_step(work->batch, &actions, steps, &out));
  }
  const Times after = now();
  const double done = (double)calls * work->simulations;
  Times each = {(after.cpu_s - before.cpu_s) / done, (after.wall_s - before.wall_s) / done};
  return each;
}

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a;
  const double y = *(const double*)b;
  return (x > y) - (x < y);
}

static double median(double* values) {
  qsort(values, kRounds, sizeof *values, compare);
  return values[kRounds / 2];
}

/* One and two threads take turns, so that a slow moment of the machine affects both. Of processor time, the
 * least counts, because other processes can only add to it. */
static void measure(int simulations, int beams, int steps, int decisions) {
  Work works[2] = {make(simulations, 1, beams), make(simulations, 2, beams)};
  Times best[2] = {{1e30, 1e30}, {1e30, 1e30}};
  double speedups[kRounds];
  for (int t = 0; t < 2; ++t) run(&works[t], decisions / 4, steps);
  for (int round = 0; round < kRounds; ++round) {
    Times times[2];
    for (int t = 0; t < 2; ++t) {
      times[t] = run(&works[t], decisions, steps);
      if (times[t].cpu_s < best[t].cpu_s) best[t].cpu_s = times[t].cpu_s;
      if (times[t].wall_s < best[t].wall_s) best[t].wall_s = times[t].wall_s;
    }
    speedups[round] = times[0].wall_s / times[1].wall_s;
  }
  for (int t = 0; t < 2; ++t) {
    char name[64];
    snprintf(name, sizeof name, "many_%d_beams_%d_steps_%d_threads_%d", simulations, works[t].beams,
             steps, t + 1);
    printf("figure %s_per_cpu_second %.4g\n", name, 1.0 / best[t].cpu_s);
    printf("figure %s_per_second %.4g\n", name, 1.0 / best[t].wall_s);
  }
  printf("figure many_%d_beams_%d_steps_%d_work_of_2_threads %.4g\n", simulations, works[0].beams,
         steps, best[1].cpu_s / best[0].cpu_s);
  printf("figure many_%d_beams_%d_steps_%d_speedup_of_2_threads %.4g\n", simulations, works[0].beams,
         steps, median(speedups));
  for (int t = 0; t < 2; ++t) destroy(&works[t]);
}

int main(void) {
  static const int kCounts[] = {64, 256, 1024};
  for (size_t k = 0; k < sizeof kCounts / sizeof *kCounts; ++k) {
    measure(kCounts[k], 0, 1, 100000);
    measure(kCounts[k], 180, 1, 100000);
    measure(kCounts[k], 0, 10, 30000);
    measure(kCounts[k], 180, 10, 30000);
  }
  return 0;
}
