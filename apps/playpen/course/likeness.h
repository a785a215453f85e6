// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/pose.h"

namespace playpen::course {

/// Where a robot was during a run. Both lists have the same length.
struct Drive {
  std::vector<double> time_s;  ///< simulated, never decreasing
  std::vector<sim::Pose> X_WB;

  [[nodiscard]] bool empty() const noexcept { return time_s.empty(); }
};

/// The drives of one program, one per run of the class (world x seed), in the same order for all
/// programs. An empty drive means that the program has no trajectory of this run.
using ProgramDrives = std::vector<Drive>;

/// What find_alike() calls alike. The defaults were measured (docs/decisions/likeness.md).
struct LikenessLimits {
  double apart_m = 0.15;        ///< robots part when they are farther from each other than this [m]
  double least_driven_m = 3.0;  ///< a run in which both drive less than this is left out [m]
  double least_likeness = 4.5;  ///< of a pair in `enough_worlds` worlds or more [sqrt(m rad)]
  std::size_t enough_worlds = 5;   ///< in fewer worlds, least_in() is larger
  double one_world_likeness = 12;  ///< of a pair in one world [sqrt(m rad)]
  double nearly_equal = 0.033;  ///< relative difference of constants that differ in the third digit
  double changed_factor =
      0.45;                   ///< of the least likeness, if both speeds differ in the third digit
  double other_factor = 2.0;  ///< of the least likeness, if a speed differs by more

  /// Least likeness of a pair that was compared in a number of different worlds, > 0: it is
  /// inversely proportional to their number up to `enough_worlds`, and at most that in one world.
  [[nodiscard]] double least_in(std::size_t worlds) const noexcept;
};

/// Two programs whose robots drive the same way.
struct Likeness {
  std::size_t first = 0;    ///< index of a program
  std::size_t second = 0;   ///< index of another one, > first
  std::size_t runs = 0;     ///< number of different runs that were compared
  std::size_t worlds = 0;   ///< number of different worlds among them
  std::size_t alike = 0;    ///< number of runs whose own likeness reaches `threshold`
  double likeness = 0.0;    ///< mean of the compared runs [sqrt(m rad)]
  double threshold = 0.0;   ///< least likeness of a pair with so many worlds
  std::size_t run = 0;      ///< index of the run that is most alike
  double shared_m = 0.0;    ///< how far both drive together in `run`, after the baselines [m]
  double distance_m = 0.0;  ///< mean distance between both until they part, in `run` [m]
  std::optional<double> parted_s;  ///< when they part in `run` [s]; none: they never part
};

/// Finds the pairs of programs whose robots drive alike.
///
/// Runs are deterministic: a copied program whose names, comments or order were changed drives the
/// same trajectory as the original, and one with slightly changed constants leaves it slowly. So
/// drives of the same run are compared in lock-step: by the Euclidean distance between both robots
/// at the same simulated time (Toohey and Duckham, "Trajectory similarity measures", SIGSPATIAL
/// Special 7(1), 2015). Unlike there, the measure of a run is not the mean of this distance. Two
/// robots that are once apart meet other obstacles, and their distance tells nothing any more. The
/// likeness of a run is sqrt(s a), where s is how far both drive and a how much both turn until
/// they are `apart_m` from each other for the first time. It is 0 for a straight line, which
/// many honest programs begin with, and for turning on the spot. Trembling does not count: s is a
/// sum of straight moves of 0.25 m, a a sum of turns of 0.2 rad.
///
/// The least likeness depends on the speeds that the programs command most often, when they drive
/// straight and when they turn on the spot. If both differ, but by less than `nearly_equal`, the
/// programs differ as copies with changed constants do, and `changed_factor` applies: people choose
/// constants with one or two digits, which are either equal or farther apart. If one of them
/// differs by more, the constants are other ones, and `other_factor` applies. A program without
/// such speeds, for example one that always drives on curves, is compared with the least likeness
/// itself.
///
/// What a baseline does too does not count: s and a begin when both robots have parted from all
/// baselines. A run is left out if one of the programs has no drive of it, if after the baselines
/// both drive less than `least_driven_m`, or if both repeat an earlier run of the same world, as
/// in worlds without noise, where the seed changes nothing.
///
/// @param worlds     name of the world of each run.
/// @param programs   the drives of each program.
/// @param baselines  the drives of programs that everybody knows: a template, shipped solutions.
/// @return pairs whose mean likeness reaches the threshold; the most alike first.
/// @throws std::invalid_argument if the numbers of runs differ.
/// @note Cost: O(pairs x runs x samples until they part). 200 programs with 10 runs of 120 s take
///       about a second.
[[nodiscard]] std::vector<Likeness> find_alike(const std::vector<std::string>& worlds,
                                               const std::vector<ProgramDrives>& programs,
                                               const std::vector<ProgramDrives>& baselines,
                                               const LikenessLimits& limits = {});

}  // namespace playpen::course
