// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/plan.h"
#include "grade/task.h"

namespace playpen::batch {

/// A world with one value for each parameter of the plan.
struct Condition {
  std::string world;     ///< its name, without those values
  std::string original;  ///< absolute path of the world's file; "": the default world
  std::string file;      ///< of the world with the values; equals `original` without parameters
  std::vector<std::string> values;  ///< as JSON, in the order of Batch::parameters
};

/// A run. Units with equal ids have equal results.
struct Unit {
  /// Fingerprint of what the results depend on: program, world, seed, task, settings and version.
  std::string id;
  std::size_t program = 0;    ///< index into Batch::programs
  std::size_t condition = 0;  ///< index into Batch::conditions
  std::uint64_t seed = 0;
};

/// All runs of a plan, with everything that a process on another machine needs to run some of them.
/// The file units.json in the output folder contains it.
struct Batch {
  std::string version;    ///< of Playpen
  std::string task_file;  ///< absolute; "": runs are not judged
  std::optional<double> duration_s;
  std::optional<double> timeout_s;
  std::optional<sim::Realism> realism;
  std::string isolation = "off";         ///< level, as of --isolated
  std::vector<std::string> readable;     ///< for isolated programs, absolute
  std::vector<PlannedProgram> programs;  ///< with absolute paths
  std::vector<std::string> parameters;   ///< their pointers
  std::vector<Condition> conditions;
  std::vector<Unit> units;  ///< by program, condition and seed
};

/// What a batch has besides its plan.
struct BatchSettings {
  std::string version;
  std::string isolation = "off";
  std::vector<std::string> readable;
  std::filesystem::path out;  ///< gets the worlds with values of parameters
};

/// Makes the units of a plan, and writes the worlds that they need.
/// @param plan  with a task, programs and worlds that are absolute paths; "" is the default world.
/// @throws sim::ConfigError for a task or a world that can't be used, also with values of the
///         plan; std::exception if a file can't be written.
[[nodiscard]] Batch make_batch(const Plan& plan, const BatchSettings& settings);

/// Writes units.json.
/// @throws std::runtime_error that names the file.
void write_batch(const Batch& batch, const std::filesystem::path& out);

/// Reads units.json.
/// @throws std::runtime_error if there is none, or if write_batch() has not written it.
[[nodiscard]] Batch read_batch(const std::filesystem::path& out);

/// The task of the runs under a condition: its only world is that of the condition.
/// @throws sim::ConfigError for a bad task.
[[nodiscard]] grade::Task task_of(const Batch& batch, const Condition& condition);

}  // namespace playpen::batch
