// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/world/description.h"

namespace playerlike {

/// What a grader asks for, and what a host has run: a grade counts only if the two are the same.
/// The host writes it into report.json under "graded", with a signature over the whole report.
///
/// Program, library and host are one process, so this finds mistakes (another world, another
/// program's report, a report that was edited), not a program that is made to deceive.
struct Grading {
  std::string nonce;        ///< the grader's, other for each run; "": nobody grades
  std::string world_name;   ///< for messages
  std::uint64_t world = 0;  ///< sim::world_hash()
  std::uint64_t seed = 0;
  std::optional<double> duration_s;  ///< simulated
  std::string time = "lockstep";     ///< or the factor of real time
};

/// The grading of a run of that world.
/// @param world  as the host simulates it: after RunSettings::apply_to().
[[nodiscard]] Grading grading_of(const std::string& nonce, const sim::WorldDescription& world);

/// A report with the entry "graded"; the same report if nobody grades.
/// @param report  JSON.
[[nodiscard]] std::string signed_report(const std::string& report, const Grading& grading);

/// Why a report is not that of the run that a grader asked for, in words for a verdict: not signed,
/// of another run, world, seed, duration or time, changed afterwards, or of a simulation that
/// never stepped. nullopt if it is.
/// @throws nlohmann::json::exception if the report is no JSON, or not as a host writes it.
[[nodiscard]] std::optional<std::string> fault_of_graded(const std::string& report,
                                                         const Grading& expected);

}  // namespace playerlike
