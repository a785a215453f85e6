// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/realism.h"

/// The implementation of `playpen batch` without argument parsing: many runs, here or by an engine
/// that has many machines. docs/batch.md explains it.
namespace playpen::batch {

/// A program of a plan.
struct PlannedProgram {
  std::string name;                  ///< different from those of the others
  std::vector<std::string> command;  ///< as the plan has it; not empty
};

/// A value of the worlds that a plan varies.
struct Parameter {
  std::string pointer;              ///< JSON pointer of its place in the world files (RFC 6901)
  std::vector<std::string> values;  ///< as JSON; at least one
};

/// Which runs a file asks for: each program on each world with each combination of the parameters'
/// values and each seed.
struct Plan {
  std::string file;
  std::string task;                      ///< as the plan has it; "": runs are not judged
  std::vector<PlannedProgram> programs;  ///< at least one
  std::vector<std::string> worlds;       ///< as the plan has them; empty: those of the task
  std::vector<std::uint64_t> seeds;      ///< different; empty: those of the task
  std::vector<Parameter> parameters;
  std::optional<double> duration_s;     ///< simulated limit; none: that of the task or world [s]
  std::optional<double> timeout_s;      ///< wall-clock limit of a run; none: that of the task [s]
  std::optional<sim::Realism> realism;  ///< none: that of each world
};

/// Number of runs that a plan may ask for.
inline constexpr std::size_t kMostUnits = 1'000'000;

/// Reads a plan.
/// @throws sim::ConfigError with every issue of the file (docs/errors.md).
[[nodiscard]] Plan read_plan(const std::string& path);

/// Reads a plan from text. `file` is its name in messages.
[[nodiscard]] Plan read_plan_text(std::string_view text, const std::string& file);

}  // namespace playpen::batch
