// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grade/task.h"
#include "playerlike/host/grading.h"
#include "playerlike/host/program.h"
#include "sim/core/pose.h"
#include "sim/world/description.h"
#include "sim/world/occupancy_map.h"

namespace playpen::grade {

/// The reference values of a task on one world.
struct Reference {
  std::string world_file;
  std::string world;  ///< see world_name()
  std::string robot;  ///< the robot that is graded
  sim::Vec2 start = sim::Vec2::Zero();
  std::optional<double> duration_s;  ///< simulated limit [s]
  std::optional<Goal> goal;
  std::optional<double> shortest_path_m;  ///< from start to goal; none without a goal
  sim::OccupancyMap truth;            ///< at the start; empty unless the task names a map or a goal
  sim::WorldDescription description;  ///< of the world, at the start
};

/// Computes what does not depend on the program: the true map and the shortest path to the goal.
///
/// The path is that of the robot's centre on the true map (kTruthCell_m), inflated by the radius of
/// the largest circle around the middle of its axle that fits into its outline.
///
/// @throws sim::ConfigError if the task does not match the world: no robot or device of a name; a
///         goal or a controller that is missing although the thresholds need one; or a goal that
///         can't be reached.
[[nodiscard]] Reference make_reference(const Task& task, const TaskWorld& task_world,
                                       const sim::WorldDescription& world);

/// What a range sensor of the graded robot showed of a place before the robot touched it there.
struct Sight {
  /// Whether the sensor's last measurement before the contact showed the place; otherwise why not.
  enum class State {
    kShown,
    kOutside,  ///< the place was outside of the sensor's field of view
    kTooLow,   ///< the sensor looks over what was hit
    kTooHigh,  ///< the sensor looks under it
    kHidden,   ///< something was in front of the place
  };
  State state = State::kShown;
  std::string sensor;  ///< name of the device
  /// Time from the sensor's first measurement that showed the place without an interruption until
  /// the contact [s]; 0 unless kShown. At most kLongestSight_s, which means that or longer.
  double shown_for_s = 0.0;
  /// Time from the last measurement that showed the place until the contact [s]; none if there was
  /// none in the last kLongestSight_s before it, and if kShown.
  std::optional<double> last_shown_s;
  /// Distance of the robot's outline from the place at the first measurement that showed it, or at
  /// the last one before the contact [m]; 0 within the outline.
  double distance_m = 0.0;
  /// Direction of the place from the sensor at that time, from the robot's heading,
  /// counter-clockwise [rad], (-pi, pi].
  double bearing_rad = 0.0;
  double field_of_view_rad = 0.0;  ///< full angle of the sensor, of a sonar: of one cone [rad]
};

/// Limit of the times of a Sight [s].
inline constexpr double kLongestSight_s = 60.0;

/// All states of a Sight.
inline constexpr std::array kSightStates{Sight::State::kShown, Sight::State::kOutside,
                                         Sight::State::kTooLow, Sight::State::kTooHigh,
                                         Sight::State::kHidden};

/// Name of a state in the JSON file: "shown", "outside", "too-low", "too-high", "hidden".
[[nodiscard]] std::string name_of(Sight::State state);

/// A contact of the graded robot.
struct Contact {
  double time_s = 0.0;
  std::string partner;                  ///< an obstacle, a robot, "border" or "wall"
  sim::Vec2 place = sim::Vec2::Zero();  ///< in W [m]
  std::optional<Sight> sight = {};      ///< of the place; only of runs that fail; none: not known
};

/// Something that the task does not let a program use, and that the program has requested.
struct Refusal {
  double time_s = 0.0;  ///< of the first time
  std::string what;     ///< "the map of the world"
};

/// The measures of a run; unknown ones are empty.
struct Measures {
  std::optional<bool> reached;  ///< whether the robot reached the goal; none without a goal
  std::optional<double> goal_distance_m;  ///< from the goal, at the end [m]
  std::optional<double> coverage;         ///< see MapScore
  std::optional<double> drawn;            ///< see MapScore
  std::optional<double> seen;             ///< see MapScore
  std::optional<double> correctness;      ///< see MapScore
  std::optional<double> path_length_m;    ///< length of the driven path [m]
  std::optional<double> distance_m;       ///< driven, without movements on the spot [m]
  std::optional<double> visited_area_m2;  ///< of the floor that the robot has been on [m^2]
  std::optional<double> shortest_path_m;  ///< length of the shortest possible path [m]
  std::optional<double> path_ratio;       ///< their ratio, if the goal was reached
  std::optional<int> collisions;
  std::optional<Contact> first_collision;
  std::optional<double> least_clearance_m;
  std::optional<double> stalled_time_s;
  std::optional<double> sim_time_s;
  std::optional<double> score;  ///< points of the robot; none without a controller of the arena
  std::optional<bool> verdict;  ///< of the controller: whether the run has passed; none: no verdict
  std::string verdict_reason;   ///< for people; may be empty
  std::vector<std::string> commanded;  ///< names of the robots that the program has commanded
  std::vector<Refusal> refused;        ///< in the order of their times
};

/// Limit of the output of a program [bytes]: the total size of the files in its output folder.
inline constexpr std::uint64_t kMostOutput = 250'000'000;

/// How a run ended.
enum class Ending {
  kBySelf,         ///< with status 0, before the end of the simulated time
  kTimeOver,       ///< with status 0, at the end of the simulated time
  kVerdict,        ///< with status 0, after the world's controller had ended the run
  kBadStatus,      ///< the program ended with another status
  kSignal,         ///< a signal ended it: it crashed, or was killed
  kTimedOut,       ///< it exceeded its wall-clock limit
  kTooMuchOutput,  ///< it wrote too much into its output folder
  kInterrupted,    ///< the grader was told to stop during the run
  kNotRun,         ///< the grader was told to stop before the run
};

/// All of them.
inline constexpr std::array kEndings{
    Ending::kBySelf,        Ending::kTimeOver,    Ending::kVerdict,
    Ending::kBadStatus,     Ending::kSignal,      Ending::kTimedOut,
    Ending::kTooMuchOutput, Ending::kInterrupted, Ending::kNotRun};

/// Name of an ending in the JSON file: "by-itself", "time-over", "verdict", "bad-status", "signal",
/// "timeout", "too-much-output", "interrupted", "not-run".
[[nodiscard]] std::string name_of(Ending ending);

/// A run and its grade.
struct GradedRun {
  std::string world;
  std::uint64_t seed = 0;
  std::string folder;  ///< folder of its results, in the grader's output folder
  std::string robot;   ///< the robot that is graded
  std::optional<Goal> goal;
  Ending ending = Ending::kNotRun;
  playerlike::Grading asked;  ///< settings that the report must match
  int status = 0;             ///< exit status of the program, with kBadStatus
  std::optional<int> signal;  ///< with kSignal
  Measures measures;
  std::vector<std::string> faults;  ///< reasons why it fails, one sentence each; empty: it passes
  double wall_time_s = 0.0;

  [[nodiscard]] bool passed() const noexcept { return faults.empty(); }
};

/// The rules of a task for the host of a run.
[[nodiscard]] playerlike::TaskRules rules_of(const Task& task, const Reference& reference);

/// Grades a run by the content of its output folder. Whatever the program has done, and whatever
/// its files contain, gives a result and not an error.
/// @param completed  the program died or left in the middle of its run, and the results are those
///     until then. Such a run fails.
/// @param run  with world, seed, folder and settings; the function fills in the rest.
void evaluate(const Task& task, const Reference& reference, const playerlike::JobEnd& end,
              const std::filesystem::path& folder, bool completed, GradedRun& run);

/// The threshold violations: "3 collisions, at most 0 allowed".
[[nodiscard]] std::vector<std::string> faults_of(const Thresholds& thresholds,
                                                 const Measures& measures, Ending ending);

}  // namespace playpen::grade
