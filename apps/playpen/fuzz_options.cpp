// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "grading_options.h"
#include "parsed_option.h"
#include "run_options.h"

namespace playpen {
namespace {

/// Reads a time such as "90", "30s", "5m" or "1h".
bool parse_budget(std::string text, double& seconds) {
  double unit = 1.0;
  if (!text.empty() && (text.back() == 's' || text.back() == 'm' || text.back() == 'h')) {
    unit = text.back() == 's' ? 1.0 : text.back() == 'm' ? 60.0 : 3600.0;
    text.pop_back();
  }
  if (!parse_number(text, seconds) || !(seconds > 0.0) || seconds > 1e6) return false;
  seconds *= unit;
  return true;
}

bool parse_kinds(const std::string& text, std::vector<fuzz::Kind>& kinds) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const auto found = std::ranges::find(fuzz::all_kinds(), name, fuzz::name_of);
    if (found == fuzz::all_kinds().end()) return false;
    kinds.push_back(*found);
    begin = end + 1;
  }
  return true;
}

/// Reads words and sets what they mean. @param value  of `faults`.
bool parse_changes(const std::string& text, bool only_faults, bool value, fuzz::Freedom& freedom) {
  const std::pair<const char*, bool fuzz::Freedom::*> all[] = {
      {"starts", &fuzz::Freedom::starts}, {"obstacles", &fuzz::Freedom::obstacles},
      {"moving", &fuzz::Freedom::moving}, {"maps", &fuzz::Freedom::maps},
      {"blocks", &fuzz::Freedom::blocks}, {"noise", &fuzz::Freedom::noise}};
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    begin = end + 1;
    if (name == "faults") {
      freedom.faults = value;
      continue;
    }
    const auto* const found =
        std::ranges::find_if(all, [&name](const auto& one) { return name == one.first; });
    if (only_faults || found == std::end(all)) return false;
    freedom.*(found->second) = value;
  }
  return true;
}

std::string kind_names() {
  std::string names;
  for (const fuzz::Kind kind : fuzz::all_kinds()) {
    names += (names.empty() ? "" : ", ") + std::string(fuzz::name_of(kind));
  }
  return names;
}

}  // namespace

void add_fuzz(CommandLine& line) {
  const auto request = std::make_shared<FuzzRequest>();
  const auto expectations = std::make_shared<std::vector<std::string>>();
  CLI::App& command = line.add_command("fuzz", "Search for worlds in which a client program fails");
  line.with_program.insert(&command);
  command.footer(
      "After '--' come the client program and its arguments, for example\n"
      "  playpen fuzz par_intro --budget 5m -- build/my_robot\n"
      "Adds obstacles, doors, mazes, moving things, noise and other starts to the\n"
      "world, and makes what is found as simple as possible.\n"
      "Exit status: 0 nothing found, 1 something found or interrupted, 2 bad input.");
  CLI::Option* const world =
      command.add_option("world", request->world, "World or task, a file or a name");
  line.takes(world->required()->type_name(""), ValueKind::Kind::kWorld);
  add_parsed(command, "--budget", "Time for the search: 90, 30s, 5m or 1h [60s]", "TIME",
             "a time above 0, such as 30s, 5m or 1h", [request](const std::string& text) {
               double seconds = 0.0;
               const bool good = parse_budget(text, seconds);
               if (good) request->budget_s = seconds;
               return good;
             });
  add_parsed(command, "--runs", "Number of runs of the search, instead of a time", "N",
             "a whole number above 0", [request](const std::string& text) {
               std::size_t runs = 0;
               const bool good = parse_number(text, runs) && runs > 0;
               if (good) request->runs = runs;
               return good;
             });
  add_parsed(command, "--seed", "Seed of the search [1]", "N", "a whole number",
             [request](const std::string& text) { return parse_number(text, request->seed); });
  add_parsed(command, "--duration", "Simulated seconds of each run [30]", "S",
             "a number of seconds from 1 to 3600", [request](const std::string& text) {
               return parse_number(text, request->duration_s) && request->duration_s >= 1.0 &&
                      request->duration_s <= 3600.0;
             });
  add_parsed(command, "--most", "End after this number of findings [5]", "N",
             "a whole number above 0", [request](const std::string& text) {
               return parse_number(text, request->most_findings) && request->most_findings > 0;
             });
  add_jobs(command, request->jobs);
  add_time_limit(command, "--timeout", "Processor time after which a run hangs [20]",
                 request->timeout_s);
  command.add_option("--robot", request->robot, "Robot under test [the task's, or the first]")
      ->type_name("NAME");
  add_parsed(command, "--look-for", "What counts as a failure [everything; see 'playpen doc fuzz']",
             "LIST", "a list of " + kind_names(),
             [request](const std::string& text) { return parse_kinds(text, request->kinds); });
  command
      .add_option("--expect", *expectations,
                  "A figure of each run must be so, such as \"stalled_time < 1\"; can be repeated")
      ->expected(1)
      ->take_all()
      ->type_name("EXPECTATION");
  add_parsed(command, "--without",
             "What is not changed: starts, obstacles, moving, maps, blocks, noise, faults", "LIST",
             "a list of starts, obstacles, moving, maps, blocks, noise and faults",
             [request](const std::string& text) {
               return parse_changes(text, false, false, request->freedom);
             });
  add_parsed(command, "--with", "What is changed, too: faults (devices that fail)", "LIST",
             "faults", [request](const std::string& text) {
               return parse_changes(text, true, true, request->freedom);
             });
  command.add_flag("--random", request->random, "Do not learn from earlier runs");
  CLI::Option* const out =
      command.add_option("--out", request->output_folder, "Folder for findings [out/fuzz/<world>]");
  line.takes(out->type_name("DIR"), ValueKind::Kind::kFolder);
  CLI::Option* const keep = command.add_option(
      "--keep", request->keep_folder, "Also keep worlds here, with tests of them in found.cmake");
  line.takes(keep->type_name("DIR"), ValueKind::Kind::kFolder);
  command.add_flag("--quiet", request->quiet, "No summary");
  command.callback([request, expectations, &line] {
    if (line.program.empty()) throw CLI::RequiredError("-- PROGRAM");
    for (const std::string& text : *expectations) {
      request->expectations.push_back(parsed_expectation("--expect", text));
    }
    request->command = line.program;
    line.status = fuzz_program(*request);
  });
}

}  // namespace playpen
