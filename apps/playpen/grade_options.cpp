// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "command_line.h"
#include "grading_options.h"
#include "run_options.h"

namespace playpen {
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
  add_grading_options(command, request->seeds, request->jobs, request->timeout_s);
  add_realism(line, command, request->realism);
  add_isolation(line, command, request->isolation);
  CLI::Option* const out =
      command.add_option("--out", request->output_folder, "Folder for results [out/grade/<task>]");
  line.takes(out->type_name("DIR"), ValueKind::Kind::kFolder);
  CLI::Option* const json =
      command.add_option("--json", request->json_file, "The grade as JSON [<out>/grade.json]");
  line.takes(json->type_name("FILE"), ValueKind::Kind::kFile);
  command.add_flag("--html", request->replays,
                   "Write the replay of each run as a page, replay.html in its folder");
  add_replay_size(command, request->replay_megabytes);
  command.callback([request, &line] {
    if (line.program.empty()) throw CLI::RequiredError("-- PROGRAM");
    request->command = line.program;
    request->invocation = line.invocation;
    line.status = grade_program(*request);
  });
}

}  // namespace playpen
