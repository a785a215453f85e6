/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#ifndef PLAYPEN_BATCH_H
#define PLAYPEN_BATCH_H

/**
 * @file
 * Many simulations at once, for programs in C (C99) and for languages that call C: Python, Julia,
 * Rust. docs/many_simulations.md explains it with examples; sim::Batch of sim/parallel/batch.h is
 * the same in C++.
 *
 * N is the number of simulations, R that of the robots of the arrays, B that of the beams of a
 * scan. Angles are in radians, counter-clockwise from the x axis; lengths in metres.
 *
 * Functions that return a playpen_batch_status return PLAYPEN_BATCH_OK (0) on success. Otherwise
 * playpen_batch_last_error() says in English what is wrong. No function throws, prints, or ends the
 * process. A batch takes one call at a time, from any thread; different batches may be used at
 * once. A call while another one of the same batch is running is refused with
 * PLAYPEN_BATCH_ARGUMENT. So are calls of a child process with batches that its parent has made
 * before fork(); playpen_batch_destroy() does nothing then.
 */

/* This is C, with the names of C. */
/* NOLINTBEGIN(readability-identifier-naming,modernize-*) */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define PLAYPEN_BATCH_EXPORT __attribute__((visibility("default")))
#else
#define PLAYPEN_BATCH_EXPORT
#endif

/** Version of this interface. It grows when something is added; programs that are compiled with an
 * older header still run. A change that breaks programs changes the name of the shared library,
 * too. */
#define PLAYPEN_BATCH_VERSION 1

/** PLAYPEN_BATCH_VERSION of the library that is loaded. */
PLAYPEN_BATCH_EXPORT int32_t playpen_batch_version(void);

/** Result of a call. */
typedef enum playpen_batch_status {
  PLAYPEN_BATCH_OK = 0,       /**< done */
  PLAYPEN_BATCH_ARGUMENT = 1, /**< an argument is wrong: a size, a number, a null pointer, a name */
  PLAYPEN_BATCH_WORLD = 2,    /**< the world cannot be read or has errors */
  PLAYPEN_BATCH_STATE = 3,    /**< a saved state is damaged, or of another world or version */
  PLAYPEN_BATCH_FAILED = 4    /**< no memory, or another failure that is not the caller's */
} playpen_batch_status;

/** Text of the calling thread's last error, in UTF-8; empty if there was none. Never null. Valid
 * until the thread's next call of a function that returns a status. */
PLAYPEN_BATCH_EXPORT const char* playpen_batch_last_error(void);

/** Many simulations of one world. */
typedef struct playpen_batch playpen_batch;

/** What a batch consists of. Initialise it with playpen_batch_options_init(), then set members. */
typedef struct playpen_batch_options {
  size_t struct_size;  /**< set by playpen_batch_options_init() */
  int32_t simulations; /**< N, 1 (the default) to 1 000 000 */
  int32_t threads;     /**< that compute, the caller's among them; 0 (the default): one for each
                            processor */
  int32_t beams;       /**< B, over the laser's field of view; 0 (the default): the laser's own */
  int32_t readings; /**< 0 (the default): the robots' sensors make no readings and their pens do not
                         draw, which takes less time; 1: they do */
  const uint64_t* seeds;     /**< one per simulation; null (the default): that of the world plus the
                                  simulation's index */
  size_t seed_count;         /**< N, or 0 without seeds */
  const char* const* robots; /**< names of the robots of the arrays; null (the default): all robots
                                that have a motion device */
  size_t robot_count;        /**< number of names */
} playpen_batch_options;

/** Sets all members to their defaults. @param options  not null. */
PLAYPEN_BATCH_EXPORT void playpen_batch_options_init(playpen_batch_options* options);

/** Makes a batch from a world file.
 * @param world_file  path in UTF-8; "" is the default world, the SyRoTek arena with one robot.
 * @param options     null: the defaults.
 * @param batch       receives the batch; null on failure. playpen_batch_destroy() frees it. */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_create(const char* world_file,
                                                               const playpen_batch_options* options,
                                                               playpen_batch** batch);
/** Makes a batch from the text of a world file.
 * @param world_text  JSON in UTF-8. Other parameters: as for playpen_batch_create(). */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_create_from_text(
    const char* world_text, const playpen_batch_options* options, playpen_batch** batch);
/** Ends the threads of a batch and frees it. Null: nothing happens. */
PLAYPEN_BATCH_EXPORT void playpen_batch_destroy(playpen_batch* batch);

/** N; 0 for null. */
PLAYPEN_BATCH_EXPORT int32_t playpen_batch_simulations(const playpen_batch* batch);
/** R; 0 for null. */
PLAYPEN_BATCH_EXPORT int32_t playpen_batch_robots(const playpen_batch* batch);
/** B, the greatest number of beams of a robot; 0 for null, or if no robot has a laser. */
PLAYPEN_BATCH_EXPORT int32_t playpen_batch_beams(const playpen_batch* batch);
/** Number of threads that compute; 0 for null. */
PLAYPEN_BATCH_EXPORT int32_t playpen_batch_threads(const playpen_batch* batch);
/** Name of a robot in UTF-8, valid as long as the batch; null if there is no such robot.
 * @param robot  0 to R - 1. */
PLAYPEN_BATCH_EXPORT const char* playpen_batch_robot_name(const playpen_batch* batch,
                                                          int32_t robot);

/** The beams of a robot's scans. Beam i has the angle first_rad + i * step_rad from the laser's x
 * axis. */
typedef struct playpen_batch_scan {
  int32_t beams;      /**< 0: the robot has no laser */
  double first_rad;   /**< angle of beam 0, the rightmost [rad] */
  double step_rad;    /**< angle between neighbouring beams [rad] */
  double range_max_m; /**< the range of a beam that meets nothing [m] */
} playpen_batch_scan;

/** Describes the scans of a robot.
 * @param robot  0 to R - 1.
 * @param scan   receives the description. */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_describe_scan(const playpen_batch* batch,
                                                                      int32_t robot,
                                                                      playpen_batch_scan* scan);

/**
 * An array of the caller: a row of numbers for each simulation and robot, or for each simulation.
 *
 * The numbers of a row follow one another. Sizes and strides are counted in elements, not in bytes.
 * With both strides 0, the array has C's order, [simulation][robot][number], without gaps, and
 * `size` must be the product. Otherwise row (i, r) begins at data + i * simulation_stride + r *
 * robot_stride; rows must not overlap. A stride of 0 is the one without gaps. Members that are not
 * mentioned are 0 in C.
 */
typedef struct playpen_batch_array {
  void* data;  /**< first element, aligned for its type; null: there is no such array */
  size_t size; /**< number of elements from `data` on that belong to the array */
  ptrdiff_t simulation_stride; /**< from a simulation to the next one, >= 0 */
  ptrdiff_t robot_stride;      /**< from a robot to the next one, >= 0 */
} playpen_batch_array;

/** Where observations are written. Arrays without data are left out and cost nothing. */
typedef struct playpen_batch_observations {
  size_t struct_size;         /**< sizeof(playpen_batch_observations) */
  playpen_batch_array poses;  /**< double [N][R][3]: true x [m], y [m], yaw in (-pi, pi] [rad] */
  playpen_batch_array twists; /**< double [N][R][3]: true speed forward [m/s], turn rate [rad/s],
                                 speed to the left [m/s] */
  playpen_batch_array scans;  /**< float [N][R][B]: ranges without noise from the present pose, the
                                   rightmost beam first [m]; NaN beyond the robot's own beams */
  playpen_batch_array clearances; /**< double [N][R]: least distance to any solid since the reset
                                     [m]; 0 after a collision */
  playpen_batch_array collisions; /**< int32_t [N][R]: number of contacts begun since the reset */
  playpen_batch_array done;  /**< uint8_t [N]: 1 if the run is over: the world's duration, or the
                                arena  controller's verdict */
  playpen_batch_array times; /**< double [N]: simulated time [s] */
} playpen_batch_observations;

/** Commands all robots, runs steps of each simulation, on all threads, and observes. A simulation
 * that is done is not stepped.
 * @param actions  double [N][R][2]: speed forward [m/s], turn rate [rad/s], all finite; the limits
 * of the motors apply. Only read. Null, or no data: the last commands stay.
 * @param steps    0 to 1 000 000 steps of the world's `step` (0.01 s by default).
 * @param observations  what is observed after the last step; null: nothing.
 * @return PLAYPEN_BATCH_ARGUMENT for a wrong size or a number that is not finite; nothing has
 * changed then. */
PLAYPEN_BATCH_EXPORT playpen_batch_status
playpen_batch_step(playpen_batch* batch, const playpen_batch_array* actions, int32_t steps,
                   const playpen_batch_observations* observations);
/** Observes without a step. @param observations  null: nothing. */
PLAYPEN_BATCH_EXPORT playpen_batch_status
playpen_batch_observe(playpen_batch* batch, const playpen_batch_observations* observations);

/** Makes simulations anew, at time 0.
 * @param mask       N bytes: 0: this one is not reset. Null: all are reset.
 * @param mask_size  N, or 0 for null.
 * @param seeds      N seeds, of which those of the mask are used. Null: each keeps its seed.
 * @param seed_count N, or 0 for null.
 * @param poses      double [N][R][3]: start poses x [m], y [m], yaw [rad], of which those of the
 * mask are used. Null, or no data: those of the world.
 * @return PLAYPEN_BATCH_ARGUMENT for a wrong size or a number that is not finite; nothing has
 * changed then. Also if a robot would stand where something is: the robots of that simulation stay
 * at the world's start then, and everything else is done. */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_reset(playpen_batch* batch,
                                                              const uint8_t* mask, size_t mask_size,
                                                              const uint64_t* seeds,
                                                              size_t seed_count,
                                                              const playpen_batch_array* poses);

/** Writes the state of a simulation.
 * @param simulation  0 to N - 1.
 * @param data        receives the state; null: only the size is wanted.
 * @param capacity    bytes at `data`.
 * @param size        receives the size of the state in bytes, also if the capacity is too small.
 * @return PLAYPEN_BATCH_ARGUMENT if the capacity is too small; nothing is written to `data` then.
 */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_save(const playpen_batch* batch,
                                                             int32_t simulation, void* data,
                                                             size_t capacity, size_t* size);
/** Continues simulations from a state of the same world, which this or another batch or process has
 * saved, with the same version of Playpen. They have the seed of that state then.
 * @param mask       as for playpen_batch_reset().
 * @param mask_size  N, or 0 for null.
 * @param data       the state.
 * @param size       its size in bytes.
 * @return PLAYPEN_BATCH_STATE if the state is damaged or of another world; nothing has changed
 * then. */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_restore(playpen_batch* batch,
                                                                const uint8_t* mask,
                                                                size_t mask_size, const void* data,
                                                                size_t size);
/** Hash of the state of a simulation: equal hashes mean equal futures.
 * @param simulation  0 to N - 1.
 * @param hash        receives the hash. */
PLAYPEN_BATCH_EXPORT playpen_batch_status playpen_batch_state_hash(const playpen_batch* batch,
                                                                   int32_t simulation,
                                                                   uint64_t* hash);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming,modernize-*) */

#endif /* PLAYPEN_BATCH_H */
