// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "playerlike/host/task_rules.h"
#include "sim/world/description.h"

namespace playerlike {

/// The run that a grader requests, or the run that a host has executed. A grade counts only if the
/// two are equal. The host writes this data to report.json under "graded", with a signature over
/// the whole report.
///
/// Program, library and host are one process. The check therefore detects mistakes (another world,
/// another program's report, an edited report), but not a program that deceives deliberately.
struct Grading {
  std::string nonce;        ///< nonce of the grader, unique for each run; "": the run is not graded
  std::string world_name;   ///< name of the world, for messages
  std::uint64_t world = 0;  ///< sim::world_hash()
  std::uint64_t seed = 0;
  std::optional<double> duration_s;  ///< simulated duration
  std::string time = "lockstep";     ///< "lockstep", or the real-time factor
  std::string realism = "course";    ///< level of realism
  TaskRules rules;                   ///< what the program may use, and what is measured
};

/// Returns the grading data of a run of this world.
/// @param world  world as simulated, i.e. after RunSettings::apply_to().
[[nodiscard]] Grading grading_of(const std::string& nonce, const TaskRules& rules,
                                 const sim::WorldDescription& world);

/// Adds the entry "graded" to a report. Returns the report unchanged if the run is not graded.
/// @param report  text of report.json.
[[nodiscard]] std::string signed_report(const std::string& report, const Grading& grading);

/// Checks that a report belongs to the run that a grader requested. Returns nullopt if it does,
/// otherwise the reason as text for the verdict: the report is not signed, it has another run,
/// world, level of realism, seed, duration, time mode or rules, it was changed afterwards, or its
/// simulation never stepped.
/// @throws std::exception if the report is not JSON or not in the host's format.
[[nodiscard]] std::optional<std::string> fault_of_graded(const std::string& report,
                                                         const Grading& expected);

}  // namespace playerlike
