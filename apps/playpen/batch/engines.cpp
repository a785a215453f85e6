// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/engines.h"

#include <algorithm>

#include "terminal.h"

namespace playpen::batch {

std::pair<std::size_t, std::size_t> units_of_part(std::size_t units, std::size_t part,
                                                  std::size_t parts) {
  return {units * (part - 1) / parts, units * part / parts};
}

std::size_t usual_parts(std::size_t units) {
  constexpr std::size_t kUnits = 25;
  constexpr std::size_t kMost = 1000;
  return std::clamp<std::size_t>((units + kUnits - 1) / kUnits, 1, kMost);
}

std::string number_set(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (auto first = numbers.begin(); first != numbers.end();) {
    auto last = first;
    while (last + 1 != numbers.end() && *(last + 1) == *last + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(*first);
    if (last != first) text += '-' + std::to_string(*last);
    first = last + 1;
  }
  return text;
}

std::string slurm_script(const EngineCall& call) {
  return "#!/bin/sh\n# Runs one part of a batch. playpen batch --engine slurm submits it.\nexec " +
         shell_word(call.command) + " batch --out " + shell_word(call.out.string()) +
         " --part \"$SLURM_ARRAY_TASK_ID/" + std::to_string(call.parts) +
         "\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\"\n";
}

std::vector<std::string> slurm_command(const EngineCall& call,
                                       const std::filesystem::path& script) {
  std::vector<std::string> words = {"sbatch",
                                    "--job-name=playpen",
                                    "--array=" + number_set(call.wanted),
                                    "--requeue",
                                    "--open-mode=append",
                                    "--output=" + (call.out / "slurm" / "part-%a.log").string()};
  if (call.wait) words.emplace_back("--wait");
  words.insert(words.end(), call.options.begin(), call.options.end());
  words.push_back(script.string());
  return words;
}

std::vector<std::string> parallel_command(const EngineCall& call) {
  std::vector<std::string> words = {"parallel",  "--will-cite",
                                    "--retries", "3",
                                    "--joblog",  (call.out / "parallel.log").string()};
  words.insert(words.end(), call.options.begin(), call.options.end());
  // Parallel gives its command to a shell.
  words.push_back(shell_word(call.command) + " batch --out " + shell_word(call.out.string()) +
                  " --part {}/" + std::to_string(call.parts) + " --jobs 1");
  words.emplace_back(":::");
  for (const std::size_t part : call.wanted) words.push_back(std::to_string(part));
  return words;
}

}  // namespace playpen::batch
