// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/scan/scan_kernel.h"
#include "sim/simulation/simulation.h"
#include "sim/world/description.h"

namespace sim {

/// A wrong call of a Batch: a wrong size, a value out of range, an unknown
/// robot. what() says which argument, what was expected and what was found.
class BatchError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An array of the caller: a row of numbers for each simulation and robot, or for each simulation.
///
/// The numbers of a row follow one another. Strides are counted in elements, not in bytes, and are
/// not negative. Without strides the array has C's order, [simulation][robot][number], without
/// gaps. An array in the order [robot][simulation][number] has the robot_stride N * numbers and the
/// simulation_stride `numbers`. Rows must not overlap.
template <typename T>
struct BatchArray {
  std::span<T> values = {};              ///< from the first row on; empty: there is no such array
  std::ptrdiff_t simulation_stride = 0;  ///< from a simulation's first row to the next one's; 0: no
                                         ///< gaps
  std::ptrdiff_t robot_stride = 0;       ///< from a robot's row to the next one's; 0: no gaps
};

/// Where a Batch writes what it observes. N is the number of simulations, R that of the robots of
/// BatchOptions::robots, B is Batch::beams(). Arrays without values are left out and cost nothing.
struct BatchObservations {
  /// [N][R][3]: true pose X_WB, x [m], y [m] and yaw in (-pi, pi] [rad].
  BatchArray<double> poses = {};
  /// [N][R][3]: true twist over the last step, forward [m/s], turn rate [rad/s] and to the left
  /// [m/s].
  BatchArray<double> twists = {};
  /// [N][R][B]: scan from the present pose, without noise: ranges of the robot's first laser, the
  /// rightmost beam first [m]; the greatest range where a beam meets nothing. NaN beyond the
  /// robot's own beams, and for a robot without a laser.
  BatchArray<float> scans = {};
  /// [N][R]: least distance of the footprint to any solid since the reset [m]; 0 after a collision.
  BatchArray<double> clearances = {};
  /// [N][R]: number of contacts begun since the reset.
  BatchArray<std::int32_t> collisions = {};
  /// [N]: 1 if the world's duration is over or the arena controller has ended the run, else 0.
  BatchArray<std::uint8_t> done = {};
  /// [N]: simulated time [s].
  BatchArray<double> times = {};
};

/// What a Batch consists of.
struct BatchOptions {
  int simulations = 1;                    ///< their number N, 1 to 1 000 000
  int threads = 0;                        ///< that compute, the caller's among them, 1 to 1024;
                                          ///< 0: one for each processor
  std::vector<std::uint64_t> seeds = {};  ///< one per simulation; empty: that of the world plus the
                                          ///< simulation's index
  std::vector<std::string> robots = {};   ///< names of the robots of all arrays, in their order;
                                          ///< empty: all robots that have a motion device
  int beams = 0;  ///< of each scan, over the laser's field of view, 1 to 8192; 0: the laser's own
  /// Whether sensors make readings and pens draw, as in any simulation. By default those of the
  /// chosen robots are switched off, because nobody sees them: that takes less time, and the robots
  /// move in the same way. Robots with a wander device keep theirs.
  bool readings = false;
};

/// How simulations are reset. Without members, all are.
struct BatchReset {
  std::span<const std::uint8_t> mask = {};    ///< [N]: 0: this one is not reset; empty: all are
  std::span<const std::uint64_t> seeds = {};  ///< [N]: new seeds; empty: each keeps its seed
  /// [N][R][3]: start poses X_WB [m, m, rad]; without values: those of the world.
  BatchArray<const double> poses = {};
};

/// Many independent simulations of one world, which all processors advance together.
///
/// One call runs all of them. Each does exactly what a Simulation does that gets the same commands
/// and is observed at the same moments, so the results do not depend on the number of threads. A
/// simulation that is done is not stepped any more until it is reset.
///
/// Not thread-safe: one call at a time, from any thread. Different batches may be used at once.
/// The threads wait between calls without using a processor. A process that forks must not use in
/// the child what was made before.
class Batch {
 public:
  /// Makes the simulations, on all threads.
  /// @throws ConfigError if the world is invalid, BatchError if an option is.
  Batch(const WorldDescription& world, const BatchOptions& options);
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;

  [[nodiscard]] int simulations() const noexcept;                ///< N
  [[nodiscard]] int robots() const noexcept;                     ///< R
  [[nodiscard]] int beams() const noexcept;                      ///< B; 0 if no robot has a laser
  [[nodiscard]] int threads() const noexcept;                    ///< that compute
  [[nodiscard]] const std::string& robot_name(int robot) const;  ///< robot in [0, R)
  [[nodiscard]] const Simulation& simulation(int simulation) const;  ///< simulation in [0, N)
  /// The beams of a robot's scans; nullopt if it has no laser. @param robot  in [0, R).
  [[nodiscard]] std::optional<scan::ScanGeometry> scan_geometry(int robot) const;

  /// Commands all robots, runs some steps of each simulation, and observes.
  ///
  /// @param actions  [N][R][2]: forward speed [m/s] and turn rate [rad/s], within the limits of the
  ///     motors; without values: the last commands stay.
  /// @param steps    of each simulation, 0 to 1 000 000; fewer if it is done before.
  /// @param out      observed after the last step.
  /// @throws BatchError if a number of an action is not finite or an array has a wrong size;
  /// nothing
  ///     has changed then. Or if a motion device refuses a command because it is switched off (only
  ///     in a restored state); everything else is done then.
  void step(const BatchArray<const double>& actions, int steps, const BatchObservations& out);
  /// Observes without a step.
  /// @throws BatchError as step().
  void observe(const BatchObservations& out);

  /// Makes simulations anew, with the world's start, seeds and poses of the caller. Their time and
  /// statistics begin at 0.
  /// @throws BatchError if an array has a wrong size or a pose is not finite; nothing has changed
  ///     then. Or if a robot cannot be placed because something stands there: the text names the
  ///     first such simulation. The robots of such a simulation stay at the world's start, and
  ///     everything else is done.
  void reset(const BatchReset& how = {});

  /// The state of a simulation, see Simulation::save(). @param simulation  in [0, N).
  [[nodiscard]] Snapshot save(int simulation) const;
  /// Continues simulations from a state of this world, with the seed of that state. A plain
  /// Simulation of the same world may have saved it.
  /// @param mask  as in BatchReset.
  /// @throws SnapshotError as Simulation::restore(), BatchError for a mask of a wrong size; nothing
  ///     has changed then.
  void restore(std::span<const std::uint8_t> mask, std::span<const std::uint8_t> snapshot);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sim
