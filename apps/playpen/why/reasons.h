// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/pose.h"
#include "why/story.h"

namespace playpen::why {

/// Kinds of reasons, in words for programs.
namespace kind {
inline constexpr const char* kCrash = "crash";           ///< a signal ended the program
inline constexpr const char* kRefused = "refused";       ///< the task forbids something it did
inline constexpr const char* kUnits = "units";           ///< commands far beyond the limits
inline constexpr const char* kNoCommand = "no-command";  ///< it never moved the robot
inline constexpr const char* kMotorsOff = "motors-off";  ///< the motors were switched off
inline constexpr const char* kNoRead = "no-read";        ///< it did not read before a contact
inline constexpr const char* kStale = "stale-data";      ///< it acted on old readings
inline constexpr const char* kNoReaction =
    "no-reaction";  ///< it commanded nothing before a contact
inline constexpr const char* kTowards = "turned-towards";  ///< it turned to what it hit
inline constexpr const char* kLate = "late";               ///< it reacted too late
inline constexpr const char* kSlowTurn = "slow-turn";      ///< it turned away too slowly
inline constexpr const char* kStraight = "straight-on";    ///< it saw something and drove on
inline constexpr const char* kUnseen = "unseen";           ///< no beam showed what it hit
inline constexpr const char* kTrap = "trap";
inline constexpr const char* kNoStop = "no-stop";      ///< it was at the goal and drove on
inline constexpr const char* kWrongWay = "wrong-way";  ///< it turned away from the goal
inline constexpr const char* kMissed = "goal-missed";
inline constexpr const char* kStall = "stall";  ///< it pushed against something
inline constexpr const char* kOscillation =
    "oscillation";  ///< it turned left and right on the spot
inline constexpr const char* kCircles = "circles";
inline constexpr const char* kSlow = "slow";  ///< it drove slowly until the time was over
inline constexpr const char* kUnseenFloor = "unseen-floor";
inline constexpr const char* kEnded = "ended-early";  ///< the program ended by itself
}  // namespace kind

/// A reason why a run went wrong, or something odd in it.
struct Reason {
  std::string kind;     ///< one of why::kind
  double time_s = 0.0;  ///< the decisive moment
  /// Sentences for people. The first one says what and when, the others what the robot saw and
  /// what the program commanded.
  std::vector<std::string> text;
  std::optional<sim::Vec2> place = std::nullopt;  ///< where, in W [m]
  /// What the text is made of. Names end with the unit; docs/why.md lists them.
  std::map<std::string, double> numbers = {};
};

/// What is known of a run besides its story.
struct RunFacts {
  std::optional<sim::Vec2> goal;  ///< of the robot, in W [m]
  bool goal_reached = false;
  std::optional<double> duration_s;    ///< simulated limit [s]
  std::optional<std::string> signal;   ///< that ended the program
  bool ended_by_program = false;       ///< before the simulated time was over
  bool passed = false;                 ///< a graded run that passed
  std::vector<std::string> faults;     ///< of a graded run that failed
  std::optional<double> seen_area_m2;  ///< floor that its sensors have seen
  /// What the task has refused, with the time of the first request [s].
  std::vector<std::pair<double, std::string>> refused;
};

/// Finds reasons in a run, the most likely one first. May be empty.
[[nodiscard]] std::vector<Reason> reasons_of(const Story& story, const RunFacts& facts);

/// @name Parts of it
/// @{
/// Why the robot touched something.
[[nodiscard]] Reason reason_of_contact(const Story& story, const sim::Collision& contact);
/// Commands far beyond the robot's limits, as of degrees instead of radians; nullopt: none.
[[nodiscard]] std::optional<Reason> unit_reason(const Story& story);
/// Standing still, turning about and driving in circles.
void add_movement_reasons(const Story& story, std::vector<Reason>& reasons);
/// What concerns the goal.
void add_goal_reasons(const Story& story, const RunFacts& facts, std::vector<Reason>& reasons);
/// @}

/// @name Words
/// @{
[[nodiscard]] std::string seconds_text(double time_s);          ///< "31.4 s"
[[nodiscard]] std::string metres_text(double distance_m);       ///< "0.32 m"
[[nodiscard]] std::string place_text(const sim::Vec2& place);   ///< "(1.20, 2.05)"
[[nodiscard]] std::string twist_text(const sim::Twist& twist);  ///< "0.30 m/s, 0.5 rad/s"
/// "24 degrees to the left", "straight ahead".
[[nodiscard]] std::string bearing_text(double bearing_rad);
/// @}

}  // namespace playpen::why
