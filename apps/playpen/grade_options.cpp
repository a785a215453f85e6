// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>

#include "command_line.h"
#include "parsed_option.h"
#include "run_options.h"

namespace playpen {
namespace {

/// "1,7,9": these seeds; "5": the seeds 1 to 5.
bool parse_seeds(const std::string& text, std::vector<std::uint64_t>& seeds) {
  constexpr std::uint64_t kMost = 10'000;
  seeds.clear();
  if (text.find(',') == std::string::npos) {
    std::uint64_t count = 0;
    if (!parse_number(text, count) || count < 1 || count > kMost) return false;
    for (std::uint64_t seed = 1; seed <= count; ++seed) seeds.push_back(seed);
    return true;
  }
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    std::uint64_t seed = 0;
    if (!parse_number(part, seed) || seeds.size() == kMost) return false;
    if (std::find(seeds.begin(), seeds.end(), seed) != seeds.end()) return false;
    seeds.push_back(seed);
  }
  return !seeds.empty();
}

}  // namespace

void add_grade(CommandLine& line) {
  const auto request = std::make_shared<GradeRequest>();
  CLI::App& command =
      line.add_command("grade", "Run a client program on the worlds of a task and judge it");
  line.with_program.insert(&command);
  command.footer(
      "After '--' come the client program and its arguments, for example\n"
      "  playpen grade par_intro --seeds 5 -- ./robot\n"
      "'playpen list tasks' shows the names of tasks.\n"
      "Exit status: 0 all runs passed, 1 some did not, 2 bad input.");
  CLI::Option* const task = command.add_option(
      "task", request->task, "Task file, or the name of a shipped task (par_intro)");
  line.takes(task->required()->type_name(""), ValueKind::Kind::kTask);
  CLI::Option* const worlds =
      command.add_option("world", request->worlds, "World files or names [those of the task]");
  line.takes(worlds->type_name(""), ValueKind::Kind::kWorld);
  add_parsed(command, "--seeds", "N: the seeds 1 to N; or a list of seeds, '7,' for one", "N,N,...",
             "a number from 1 to 10000, or different seeds with commas between them",
             [request](const std::string& text) { return parse_seeds(text, request->seeds); });
  add_parsed(command, "--jobs", "Programs that run side by side [the number of processors]", "N",
             "a whole number from 1 to 1000", [request](const std::string& text) {
               int& jobs = request->jobs;
               return parse_number(text, jobs) && jobs >= 1 && jobs <= 1000;
             });
  add_parsed(command, "--timeout", "Wall-clock limit of a run [the task's]", "S",
             "a number of seconds above 0", [request](const std::string& text) {
               double seconds = 0.0;
               const bool good =
                   parse_number(text, seconds) && std::isfinite(seconds) && seconds > 0.0;
               if (good) request->timeout_s = seconds;
               return good;
             });
  add_realism(line, command, request->realism);
  add_isolation(line, command, request->isolation);
  CLI::Option* const out =
      command.add_option("--out", request->output_folder, "Folder for results [out/grade/<task>]");
  line.takes(out->type_name("DIR"), ValueKind::Kind::kFolder);
  CLI::Option* const json =
      command.add_option("--json", request->json_file, "The grade as JSON [<out>/grade.json]");
  line.takes(json->type_name("FILE"), ValueKind::Kind::kFile);
  command.callback([request, &line] {
    if (line.program.empty()) throw CLI::RequiredError("-- PROGRAM");
    request->command = line.program;
    request->invocation = line.invocation;
    line.status = grade_program(*request);
  });
}

}  // namespace playpen
