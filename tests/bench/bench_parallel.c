/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
/* Speed of many simulations at once, by the C interface: decisions with a fresh scan each, by a trivial
 * policy, for one robot in the SyRoTek arena. Prints lines "figure NAME VALUE".
 *
 * On a machine with other work, only figures per second of processor time mean something:
 *   per_cpu_second       decisions in a second of processor time of the whole process
 *   per_second           decisions in a second of the wall clock
 *   work_of_2_threads    processor time of a decision with two threads over that with one; two idle
 *                        processors are 2 / work_of_2_threads times as fast as one
 *   us_a_call            by the wall clock, without the policy: the tenth of the calls that was fastest took
 *                        at most so long
 *   speedup_of_2_threads by the wall clock, the median of rounds that alternate
 *   speedup_of_calls     one thread's us_a_call over that of two
 *
 * With --pin each thread is kept on its processor. On a machine with other work, the system otherwise may
 * run both threads on one processor for a while.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

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
  double call_s; /* of a whole call, only in the result of run() */
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

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a;
  const double y = *(const double*)b;
  return (x > y) - (x < y);
}

/* Keeps the threads of the process on one processor each, as far as there are. */
static void pin_threads(void) {
  const long processors = sysconf(_SC_NPROCESSORS_ONLN);
  DIR* tasks = opendir("/proc/self/task");
  if (tasks == NULL) return;
  const struct dirent* task;
  for (long k = 0; (task = readdir(tasks)) != NULL;) {
    const int thread = atoi(task->d_name);
    if (thread == 0) continue; /* . and .. */
    cpu_set_t processor;
    CPU_ZERO(&processor);
    CPU_SET((size_t)(k++ % processors), &processor);
    sched_setaffinity(thread, sizeof processor, &processor);
  }
  closedir(tasks);
}

/* Lets new threads run anywhere. */
static void unpin(void) {
  cpu_set_t all;
  memset(&all, 0xff, sizeof all);
  sched_setaffinity(0, sizeof all, &all);
}

static double seconds_of(const struct timeval* time) {
  return (double)time->tv_sec + 1e-6 * (double)time->tv_usec;
}

static double wall_s(void) {
  struct timespec wall;
  clock_gettime(CLOCK_MONOTONIC, &wall);
  return (double)wall.tv_sec + 1e-9 * (double)wall.tv_nsec;
}

static Times now(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  Times times = {seconds_of(&usage.ru_utime) + seconds_of(&usage.ru_stime), wall_s(), 0};
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
  double* call_times = calloc((size_t)calls, sizeof(double));
  const Times before = now();
  for (int k = 0; k < calls; ++k) {
    decide(work);
    const double begin_s = wall_s();
    check(playpen_batch_step(work->batch, &actions, steps, &out));
    call_times[k] = wall_s() - begin_s;
  }
  const Times after = now();
  qsort(call_times, (size_t)calls, sizeof *call_times, compare);
  const double call_s = call_times[calls / 10];
  free(call_times);
  const double done = (double)calls * work->simulations;
  Times each = {(after.cpu_s - before.cpu_s) / done, (after.wall_s - before.wall_s) / done, call_s};
  return each;
}

static double median(double* values) {
  qsort(values, kRounds, sizeof *values, compare);
  return values[kRounds / 2];
}

/* One and two threads take turns, so that a slow moment of the machine affects both. Of processor time, the
 * least counts, because other processes can only add to it. */
static void measure(int simulations, int beams, int steps, int decisions, int pin) {
  Work works[2] = {make(simulations, 1, beams), make(simulations, 2, beams)};
  if (pin) pin_threads();
  Times best[2] = {{1e30, 1e30, 1e30}, {1e30, 1e30, 1e30}};
  double speedups[kRounds];
  for (int t = 0; t < 2; ++t) run(&works[t], decisions / 4, steps);
  for (int round = 0; round < kRounds; ++round) {
    Times times[2];
    for (int t = 0; t < 2; ++t) {
      times[t] = run(&works[t], decisions, steps);
      if (times[t].cpu_s < best[t].cpu_s) best[t].cpu_s = times[t].cpu_s;
      if (times[t].wall_s < best[t].wall_s) best[t].wall_s = times[t].wall_s;
      if (times[t].call_s < best[t].call_s) best[t].call_s = times[t].call_s;
    }
    speedups[round] = times[0].wall_s / times[1].wall_s;
  }
  for (int t = 0; t < 2; ++t) {
    char name[64];
    snprintf(name, sizeof name, "many_%d_beams_%d_steps_%d_threads_%d", simulations, works[t].beams,
             steps, t + 1);
    printf("figure %s_per_cpu_second %.4g\n", name, 1.0 / best[t].cpu_s);
    printf("figure %s_per_second %.4g\n", name, 1.0 / best[t].wall_s);
    printf("figure %s_us_a_call %.4g\n", name, 1e6 * best[t].call_s);
  }
  printf("figure many_%d_beams_%d_steps_%d_work_of_2_threads %.4g\n", simulations, works[0].beams,
         steps, best[1].cpu_s / best[0].cpu_s);
  printf("figure many_%d_beams_%d_steps_%d_speedup_of_2_threads %.4g\n", simulations, works[0].beams,
         steps, median(speedups));
  printf("figure many_%d_beams_%d_steps_%d_speedup_of_calls %.4g\n", simulations, works[0].beams, steps,
         best[0].call_s / best[1].call_s);
  for (int t = 0; t < 2; ++t) destroy(&works[t]);
  if (pin) unpin();
}

int main(int argc, char** argv) {
  const int pin = argc == 2 && strcmp(argv[1], "--pin") == 0;
  if (argc > 1 && !pin) {
    fprintf(stderr, "Usage: bench_parallel [--pin]\n");
    return 2;
  }
  static const int kCounts[] = {64, 256, 1024};
  for (size_t k = 0; k < sizeof kCounts / sizeof *kCounts; ++k) {
    measure(kCounts[k], 0, 1, 100000, pin);
    measure(kCounts[k], 180, 1, 100000, pin);
    measure(kCounts[k], 0, 10, 30000, pin);
    measure(kCounts[k], 180, 10, 30000, pin);
  }
  return 0;
}
