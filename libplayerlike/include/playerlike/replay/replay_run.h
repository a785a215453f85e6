// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/core/time.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/simulation/arena_event.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/simulation/simulation.h"
#include "sim/world/description.h"

/// What a replay shows of a run. Plain data; lengths in m, angles in rad, poses in W unless a
/// comment says otherwise.
namespace playerlike::replay {

/// Units of the whole numbers in change logs and columns.
inline constexpr double kPlaceUnit_m = 1e-4;                               ///< [m]
inline constexpr double kAngleUnit_rad = 0.01 * std::numbers::pi / 180.0;  ///< [rad]
inline constexpr double kRangeUnit = 1e-3;  ///< of ranges and heights [m]

/// Records of whole numbers, each from its time until the next one's.
class ChangeLog {
 public:
  /// Adds a record unless it equals the newest one. @pre times do not decrease.
  void note(sim::SimTime time_ns, std::vector<std::int64_t> record);

  [[nodiscard]] const std::vector<sim::SimTime>& times_ns() const noexcept { return times_ns_; }
  [[nodiscard]] const std::vector<std::int64_t>& lengths() const noexcept { return lengths_; }
  /// All records, one after the other.
  [[nodiscard]] const std::vector<std::int64_t>& values() const noexcept { return values_; }
  /// The length of all records; nullopt if they differ.
  [[nodiscard]] std::optional<std::size_t> common_length() const;

  /// The records since the last call of take(), which are removed here, except for the newest one.
  [[nodiscard]] ChangeLog take();
  /// The newest record only.
  [[nodiscard]] ChangeLog newest() const {
    return from(times_ns_.empty() ? 0 : times_ns_.size() - 1);
  }

 private:
  [[nodiscard]] ChangeLog from(std::size_t first) const;

  std::size_t taken_ = 0;  ///< records at the begin that take() has returned: 0 or 1
  std::vector<sim::SimTime> times_ns_;
  std::vector<std::int64_t> lengths_;
  std::vector<std::int64_t> values_;
};

/// A number of a device over time.
struct Series {
  std::string name;
  std::string unit;
  std::vector<std::string> words;  ///< names of the values 0, 1, ...; empty: it is a number
  std::vector<double> values;      ///< one per reading; NaN: the reading has none
};

/// A list of numbers of a device over time.
struct ListSeries {
  std::string name;
  std::string unit;
  std::vector<std::int64_t> counts;  ///< of numbers in each reading
  std::vector<std::int64_t> values;  ///< of all readings, in kRangeUnit times `unit`, at most 65535
                                     ///< of them
};

/// Where the beams of a range sensor point, for drawing.
struct BeamGeometry {
  std::vector<sim::Pose> X_BS;      ///< of a laser (one), or of the transducers
  double angle_min_rad = 0.0;       ///< laser: of the first beam
  double resolution_rad = 0.0;      ///< laser: between beams; 0: transducers, a beam each
  double field_of_view_rad = 0.0;   ///< of a transducer's cone; 0: a ray
  std::vector<double> range_max_m;  ///< of all beams (one), or of each transducer
};

/// A device and its readings.
struct DeviceLog {
  int robot = 0;  ///< index
  std::string name;
  std::string type;
  std::optional<BeamGeometry> beams;   ///< of range sensors; its ranges are lists[0]
  std::vector<sim::SimTime> times_ns;  ///< of the readings, when they were measured
  std::vector<sim::Pose> X_WB;         ///< of range sensors: the robot's pose at these times
  std::vector<Series> series;
  std::vector<ListSeries> lists;
  /// Of a part of a run: how many of the series and lists occur in earlier parts.
  std::size_t known_series = 0;
  std::size_t known_lists = 0;
};

/// A robot's motion, one element per frame.
struct RobotLog {
  sim::RobotSnapshot start;  ///< its name, colour and shape
  std::vector<sim::Pose> X_WB;
  std::vector<sim::Twist> twists;
  std::vector<std::int64_t> stalled;  ///< 0 or 1
  /// What changes in its look: see look_of() in replay_builder.cpp.
  ChangeLog looks;
};

/// A line that the program or the simulation printed.
struct OutputLine {
  sim::SimTime time_ns = 0;
  std::string text;
  bool is_error = false;  ///< of the standard error
};

/// A command to a device.
struct CommandNote {
  sim::SimTime time_ns = 0;
  int robot = 0;
  int device = 0;
  std::size_t text = 0;  ///< index in ReplayRun::command_texts
};

/// A goal of a robot.
struct GoalNote {
  int robot = 0;
  sim::Vec2 place = sim::Vec2::Zero();
  sim::SimTime given_ns = 0;
  std::optional<sim::SimTime> reached_ns = {};
};

/// Equal cells of a layer, one after the other, row by row from the top left.
struct CellRun {
  std::uint32_t first = 0;  ///< index of the first cell
  std::uint32_t count = 0;  ///< > 0
  sim::Colour colour;       ///< alpha 0: blank
};

/// Cells that changed at one time.
struct LayerChange {
  sim::SimTime time_ns = 0;
  std::vector<CellRun> runs;
};

/// A layer over time; blank at first. Its bottom left corner is that of the canvas. When the canvas
/// changes its size, layers become blank, and others of the same names go on.
struct LayerLog {
  std::string name;
  sim::Colour colour;  ///< of its entry in legends
  bool visible = true;
  int priority = 0;                  ///< higher priorities lie above lower ones
  bool is_grey = false;              ///< an occupancy grid: its legend says free, unknown, occupied
  int width = 0;                     ///< columns
  int height = 0;                    ///< rows
  std::vector<LayerChange> changes;  ///< in the order of time
  bool is_known = false;             ///< of a part of a run: it occurs in earlier parts
};

/// A text of the arena controller.
struct TextNote {
  sim::SceneText text;
  sim::SimTime shown_ns = 0;
  std::optional<sim::SimTime> gone_ns = {};
};

/// A run, as ReplayBuilder has recorded it.
struct ReplayRun {
  std::string name;               ///< for people, e.g. the folder of the results
  std::string world;              ///< its name
  sim::SimTime end_ns = 0;        ///< time of the last frame
  sim::ArenaDescription arena;    ///< at the start
  sim::CanvasDescription canvas;  ///< at the start
  std::vector<sim::SimTime> frames_ns;
  std::vector<RobotLog> robots;
  std::vector<ChangeLog> obstacles;  ///< see obstacle_record() in replay_builder.cpp
  std::vector<sim::ObstacleTrack> tracks;
  std::vector<DeviceLog> devices;
  std::vector<sim::Collision> collisions;
  std::vector<sim::ArenaEvent> events;
  std::vector<sim::SpokenText> spoken;
  std::vector<sim::TrapMark> traps;  ///< at the start
  ChangeLog trap_states;             ///< of each trap: 0 off, 1 on, 2 on with a robot inside
  std::vector<std::string> timers;   ///< names of the arena controller's timers
  ChangeLog timer_dues;              ///< of each timer: when it acts next [ms], or -1: it does not
  ChangeLog scores;                  ///< of each robot, in thousandths of a point
  std::vector<TextNote> texts;
  std::optional<sim::Verdict> verdict;
  std::vector<GoalNote> goals;
  std::vector<CommandNote> commands;
  std::vector<std::string> command_texts;
  std::vector<OutputLine> output;
  std::vector<LayerLog> layers;
  std::vector<std::string> notes;  ///< what was left out, in words
  /// Of a part of a run, see ReplayBuilder::take(): the numbers of the first elements of `goals`
  /// and `texts` among all of the run.
  std::size_t first_goal = 0;
  std::size_t first_text = 0;
};

}  // namespace playerlike::replay
