// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/fields.h"
#include "sim/core/pose.h"

/// @file
/// The content of report.json. Its tables of fields (host/results/report_fields.cpp) say what each
/// member means: text, reader and the tables of the pages are made from them.
namespace playerlike {

/// How a run ended.
struct RunEnd {
  /// What ended it.
  enum class By {
    kDuration,   ///< the simulated duration is over
    kVerdict,    ///< the arena controller ended the run
    kProgram,    ///< the program ended, or stopped using the simulation
    kRequest,    ///< a signal requested the end
    kWindow,     ///< the user closed the window
    kSignal,     ///< a signal ended the program: it crashed or was killed
    kRealRobot,  ///< the connection to a real robot was lost
  };
  By by = By::kProgram;
  std::optional<int> status = {};          ///< exit status of the program, if that ended the run
  std::optional<std::string> signal = {};  ///< name of the signal of kRequest and kSignal
};

/// The name of a signal: "SIGINT".
[[nodiscard]] std::string signal_name(int number);

/// Mean and maximum of a series.
struct SeriesReport {
  double mean = 0.0;
  double max = 0.0;
};

/// What the report says of a robot that mirrors a real one.
struct MirrorReport {
  /// A lost connection.
  struct Loss {
    double time_s = 0.0;
    std::string reason;
  };
  /// Comparison of scans.
  struct ScanDifference {
    SeriesReport range_m;
    SeriesReport share;
  };
  /// Comparison with the ghost.
  struct GhostDifference {
    SeriesReport distance_m;
    double final_distance_m = 0.0;
    SeriesReport heading_rad;
  };
  std::string robot;
  std::string server;
  std::string drive;
  bool connected = false;
  std::optional<Loss> lost;
  std::uint64_t reconnections = 0;
  std::uint64_t readings = 0;
  std::uint64_t poses = 0;
  std::uint64_t scans = 0;
  std::optional<SeriesReport> latency_s;
  std::optional<SeriesReport> screen_latency_s;
  std::optional<ScanDifference> scan_difference;
  std::optional<GhostDifference> ghost;  ///< only if `drive` is "both"
};

/// The results of a run.
struct Report {
  /// The run as a whole.
  struct Run {
    std::string world;
    std::uint64_t seed = 0;
    std::string realism = "course";
    std::uint64_t steps = 0;
    double sim_time_s = 0.0;
    double wall_time_s = 0.0;
    double real_time_factor = 0.0;
    std::optional<std::string> state_hash;
    std::optional<std::string> world_file;
    bool repeatable = true;
    std::optional<std::vector<std::string>> repeatable_why;
    std::optional<std::string> repeatable_on;
    std::optional<double> box2d_from_s;
  };
  /// The floor that a robot's sensors have seen; see SeenFloor for the cells.
  struct Seen {
    double area_m2 = 0.0;
    double cell_size_m = 0.0;
    sim::Vec2 origin = sim::Vec2::Zero();
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> cells;
  };
  /// The commands to a robot.
  struct Commanded {
    double first_s = 0.0;
    std::uint64_t commands = 0;
    std::vector<int> ports;
  };
  /// A robot.
  struct Robot {
    std::string name;
    double path_length_m = 0.0;
    int collisions = 0;
    std::optional<double> least_clearance_m;  ///< none: there is nothing solid
    double stalled_time_s = 0.0;
    sim::Pose final_pose;
    std::optional<double> driven_time_s;
    std::optional<double> distance_m;
    std::optional<double> visited_area_m2;
    std::optional<Seen> seen;
    std::optional<Commanded> commanded;
  };
  /// A text that a robot said.
  struct Said {
    double time_s = 0.0;
    std::string robot;
    std::string text;
  };
  /// The start of a contact.
  struct Collision {
    double time_s = 0.0;
    std::string robot;
    std::string with;
    sim::Vec2 place = sim::Vec2::Zero();
  };
  /// A goal of a robot.
  struct Goal {
    double time_s = 0.0;
    std::string robot;
    sim::Vec2 place = sim::Vec2::Zero();
    std::optional<double> reached_s;
  };
  /// An event of the arena, see sim::ArenaEvent.
  struct Event {
    std::uint64_t number = 0;
    double time_s = 0.0;
    std::string kind;
    std::string what;
    std::optional<std::string> who;
    std::optional<std::string> text;
    std::optional<double> value;
  };
  /// A dynamic block.
  struct Block {
    std::string name;
    std::string state;
  };
  /// The points of a robot.
  struct Score {
    std::string robot;
    double points = 0.0;
  };
  /// The verdict of the arena controller.
  struct Verdict {
    bool passed = false;
    std::string reason;
    double time_s = 0.0;
  };
  /// Something that the task has refused to the program.
  struct Refusal {
    double time_s = 0.0;
    std::string what;
  };
  /// The run that a grader has asked for, see Grading.
  struct Graded {
    std::string nonce;
    std::string world_name;
    std::string world;
    std::uint64_t seed = 0;
    std::optional<double> duration_s;
    std::string time;
    std::optional<std::string> realism;
    std::optional<std::string> rules;
    std::optional<std::string> signature;
  };

  Run run;
  std::vector<Robot> robots;
  std::vector<Said> said;
  std::vector<Collision> collisions;
  std::vector<Goal> goals;
  std::optional<std::vector<Event>> events;         ///< missing if the arena cannot change
  std::optional<std::vector<Block>> blocks;         ///< missing if the arena cannot change
  std::optional<std::vector<Score>> scores;         ///< missing without an arena controller
  std::optional<Verdict> verdict;                   ///< only if there are scores
  std::optional<std::vector<Refusal>> refused;      ///< missing if there was none
  std::optional<std::vector<MirrorReport>> mirror;  ///< missing if no robot mirrors a real one
  std::optional<RunEnd> ended;                      ///< nullopt: the run goes on
  std::optional<Graded> graded;
};

/// The text of report.json. Invalid UTF-8 is replaced.
[[nodiscard]] std::string text_of_report(const Report& report);
/// Reads the text of report.json. @throws std::exception with the reason if it is not a report.
[[nodiscard]] Report report_from(const std::string& text);

}  // namespace playerlike

namespace sim {
SIM_HAS_FIELDS(playerlike::MirrorReport)
SIM_HAS_FIELDS(playerlike::Report)
SIM_HAS_FIELDS(playerlike::Report::Graded)
}  // namespace sim
