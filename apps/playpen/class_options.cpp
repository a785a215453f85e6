// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "command_line.h"
#include "grading_options.h"
#include "run_options.h"

namespace playpen {

void add_class(CommandLine& line) {
  const auto request = std::make_shared<ClassRequest>();
  CLI::App& command =
      line.add_command("class", "Compile and grade the submissions of a whole class");
  command.footer(
      "Each folder and each archive (.zip, .tar) in the folder of submissions is one. For example\n"
      "  playpen class par_intro --submissions handed_in --out graded\n"
      "The same command goes on after an interruption, and grades only what is new.\n"
      "Exit status: 0 everything was graded, 1 it was interrupted (or --must-pass), 2 bad input.");
  CLI::Option* const tasks = command.add_option(
      "task", request->tasks, "Task files, or names of shipped tasks (par_intro)");
  line.takes(tasks->required()->type_name(""), ValueKind::Kind::kTask);
  CLI::Option* const folder = command.add_option("--submissions", request->submissions_folder,
                                                 "Folder with the submissions");
  line.takes(folder->type_name("DIR"), ValueKind::Kind::kFolder);
  CLI::Option* const one = command.add_option(
      "--submission", request->submission, "Instead: a single submission, a folder or an archive");
  line.takes(one->type_name("PLACE")->excludes(folder), ValueKind::Kind::kFile);
  command.add_option("--id", request->id, "With --submission: the id of its author [its name]")
      ->type_name("ID")
      ->needs(one);
  CLI::Option* const out =
      command.add_option("--out", request->output_folder, "Folder for results");
  line.takes(out->required()->type_name("DIR"), ValueKind::Kind::kFolder);
  CLI::Option* const roster = command.add_option(
      "--roster", request->roster_file, "CSV file with the columns id and name of the class");
  line.takes(roster->type_name("FILE")->excludes(one), ValueKind::Kind::kFile);
  command
      .add_option("--program", request->program,
                  "File name of the program, where a submission compiles to several")
      ->type_name("NAME");
  CLI::Option* const baseline = command.add_option(
      "--baseline", request->baselines,
      "A program that everybody knows, a folder or an archive: what submissions do like it is no "
      "likeness; can be repeated");
  line.takes(baseline->type_name("PLACE")->expected(1)->take_all(), ValueKind::Kind::kFile);
  add_grading_options(command, request->seeds, request->jobs, request->timeout_s);
  add_time_limit(command, "--build-timeout", "Wall-clock limit of compiling a submission [300]",
                 request->build_timeout_s);
  add_realism(line, command, request->realism);
  add_isolation(line, command, request->isolation);
  command.add_flag("--individual", request->individual,
                   "Start poses, blocks and seeds of each person's own, derived from the id");
  command.add_flag(
      "--replays", request->replays,
      "Write the replays of the best and the worst run of each submission, linked from "
      "its page");
  command.add_flag("--must-pass", request->must_pass,
                   "Exit status 1 also if a run has not passed, for continuous integration");
  command.callback([request, &line, folder, one] {
    if (folder->empty() && one->empty()) {
      throw CLI::RequiredError("--submissions or --submission");
    }
    line.status = grade_class(*request);
  });
}

}  // namespace playpen
