// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

#include "command_line.h"
#include "parsed_option.h"

namespace playpen {

void add_diff(CommandLine& line) {
  const auto request = std::make_shared<DiffRequest>();
  CLI::App& command = line.add_command("diff", "Compare two runs: where and how they differ");
  CLI::Option* const first = command.add_option(
      "first", request->first, "Folder of results of a run, or of 'playpen grade'");
  line.takes(first->required()->type_name(""), ValueKind::Kind::kFolder);
  CLI::Option* const second =
      command.add_option("second", request->second, "The folder to compare it with");
  line.takes(second->required()->type_name(""), ValueKind::Kind::kFolder);
  CLI::Option* const out =
      add_parsed(command, "--out", "Picture to write, .png or .svg [none]", "FILE",
                 "a file ending in .png or .svg", [request](const std::string& text) {
                   request->file = text;
                   return is_file_name(text, ".png") || is_file_name(text, ".svg");
                 });
  line.takes(out, ValueKind::Kind::kFile);
  command.footer(
      "Prints the conditions that differ, the first value of the trajectories that\n"
      "differs, when and where the robots are first more than 1, 10 and 100 mm apart,\n"
      "and the figures of both runs. The picture shows both trajectories and the\n"
      "distance over time. Runs of two grades are matched by their names. For example:\n"
      "  playpen diff out/before out/after --out difference.png\n"
      "  playpen diff out/grade/par_intro/par_intro_seed1 out/first\n"
      "Exit status: 0 the runs are equal, 1 they differ, 2 bad input.");
  command.callback([request, &line] { line.status = compare_runs(*request); });
}

}  // namespace playpen
