// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grade/trajectory.h"
#include "playerlike/host/report.h"
#include "sim/core/pose.h"
#include "sim/simulation/scene_snapshot.h"

/// The comparison of two runs by their results. Plain computation: no files, no streams.
namespace playpen::diff {

/// Distances between the robots at which the trajectories part [m].
inline constexpr std::array<double, 3> kDistances_m = {0.001, 0.01, 0.1};
/// Differences of the headings at which the trajectories part [degrees].
inline constexpr std::array<double, 2> kHeadings_deg = {1.0, 10.0};

/// What is known of a run.
struct ComparedRun {
  playerlike::Report report;
  /// one per robot, in the order of trajectory.csv; never null
  std::vector<const grade::Trajectory*> trajectories;
  std::vector<sim::GoalMark> goals;  ///< robots are indices into `trajectories`
  std::optional<bool> passed;        ///< verdict of the grading; none: not graded
  std::vector<std::string> faults;   ///< why it has not passed
  /// sim::world_hash() of the world's file as it is now; none: there is no file to read
  std::optional<std::uint64_t> world_hash;
};

/// Something that two runs have in different forms, in words or numbers for people.
struct Pair {
  std::string name;    ///< "seed"
  std::string first;   ///< of the first run
  std::string second;  ///< of the second run
};

/// A row of a table of figures.
struct Figure {
  Pair values;
  bool differs = false;  ///< whether the exact values differ; their texts differ then, too
};

/// The figures of a robot, or of the runs as a whole.
struct FigureGroup {
  std::string robot;  ///< "": of the runs
  std::vector<Figure> figures;
};

/// The first row of the trajectories in which the runs differ.
struct FirstDifference {
  double time_s = 0.0;
  std::string robot;
  /// "x", "y", "yaw", "v" or "omega", as in trajectory.csv; "": one run has no such row
  std::string value;
  double first = 0.0;
  double second = 0.0;
  bool in_first = true;  ///< if `value` is empty: whether the row is in the first run
};

/// The first time at which robots differ by more than a limit.
struct Parting {
  double limit = 0.0;  ///< [m] or [degrees]
  double time_s = 0.0;
  sim::Pose first;   ///< of the robot in the first run
  sim::Pose second;  ///< of the robot in the second run
};

/// A distance at a time.
struct DistanceAt {
  double distance_m = 0.0;
  double time_s = 0.0;
};

/// How the trajectories of one robot differ. A row of one run is compared with the row of the other
/// run that has the same time.
struct RobotDifference {
  std::string robot;
  std::size_t in_first = 0;         ///< index into ComparedRun::trajectories
  std::size_t in_second = 0;        ///< index into ComparedRun::trajectories
  std::vector<double> time_s;       ///< of the compared rows
  std::vector<double> distance_m;   ///< between the robots, one per compared row
  std::vector<double> heading_deg;  ///< difference of the headings, 0..180, one per compared row
  std::vector<Parting> distances;   ///< for each of kDistances_m that is exceeded
  std::vector<Parting> headings;    ///< for each of kHeadings_deg that is exceeded
  DistanceAt greatest;              ///< the first of the greatest distances
  DistanceAt last;                  ///< in the last compared row
  double first_end_s = 0.0;         ///< last time in the first run
  double second_end_s = 0.0;        ///< last time in the second run
  /// rows up to the earlier end that only one run has
  std::size_t unmatched = 0;
};

/// How two runs differ.
struct RunDifference {
  std::vector<Pair> settings;  ///< conditions of the runs that differ; empty: comparable
  std::optional<FirstDifference> first;
  std::vector<RobotDifference> robots;   ///< that both have, in the order of the first run
  std::vector<std::string> only_first;   ///< robots that only the first run has
  std::vector<std::string> only_second;  ///< robots that only the second run has
  std::vector<FigureGroup> figures;      ///< of the runs, then of the robots that both have
  /// JSON pointer of the first member of the reports that differs, in alphabetical order, without
  /// those that say how long a run took and where its files are; "": there is none
  std::string report_member;

  /// Whether the trajectories differ, also in length.
  [[nodiscard]] bool trajectories_differ() const noexcept;
  /// Whether nothing but `report_member` differs.
  [[nodiscard]] bool only_report_differs() const noexcept;
  /// Whether anything differs.
  [[nodiscard]] bool any() const noexcept;
};

/// Compares two runs. Robots are matched by their names, rows of trajectories by their times. A
/// limit is exceeded by more than 1e-9 m or degrees, because trajectory.csv has values in decimals.
/// Numbers may be any finite ones; a distance that is no double is infinite.
[[nodiscard]] RunDifference difference_of(const ComparedRun& first, const ComparedRun& second);

/// The figures of two runs beside each other: of the runs, then of the robots that both have.
[[nodiscard]] std::vector<FigureGroup> figures_of(const ComparedRun& first,
                                                  const ComparedRun& second);

}  // namespace playpen::diff
