// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// Engines that run parts of a batch on other machines. Each part is a call of `playpen batch
/// --part`, in a folder that all machines share.
namespace playpen::batch {

/// The units of a part: indices from `first` up to, and not including, `second`. Parts are equal in
/// size but for one unit.
/// @param part  1 to `parts`.
[[nodiscard]] std::pair<std::size_t, std::size_t> units_of_part(std::size_t units, std::size_t part,
                                                                std::size_t parts);

/// A number of parts that keeps a cluster busy, and each of them for some time: one for 25 units,
/// at most 1000 (an array of Slurm has at most 1001 elements by default).
[[nodiscard]] std::size_t usual_parts(std::size_t units);

/// What an engine is told.
struct EngineCall {
  std::string command;               ///< absolute path of `playpen`
  std::filesystem::path out;         ///< absolute
  std::size_t parts = 1;             ///< into which the units are divided
  std::vector<std::size_t> wanted;   ///< the parts to run, ascending; not empty
  std::vector<std::string> options;  ///< of the engine, from the user
  bool wait = false;                 ///< until all parts have ended
};

/// "1,3-7": numbers as Slurm writes a set of them.
[[nodiscard]] std::string number_set(const std::vector<std::size_t>& numbers);

/// The batch script of Slurm for one element of an array.
[[nodiscard]] std::string slurm_script(const EngineCall& call);

/// The command that submits that script as an array (sbatch(1)).
/// @param script  its file.
[[nodiscard]] std::vector<std::string> slurm_command(const EngineCall& call,
                                                     const std::filesystem::path& script);

/// The command that runs the parts by GNU parallel (parallel(1)), and ends when they have ended.
[[nodiscard]] std::vector<std::string> parallel_command(const EngineCall& call);

}  // namespace playpen::batch
