// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "command_line.h"
#include "grading_options.h"
#include "run_options.h"

namespace playpen {
namespace {

bool parse_part(const std::string& text, std::optional<BatchPart>& part) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return false;
  BatchPart parsed;
  if (!parse_number(text.substr(0, slash), parsed.number) ||
      !parse_number(text.substr(slash + 1), parsed.count) || parsed.number < 1 ||
      parsed.number > parsed.count) {
    return false;
  }
  part = parsed;
  return true;
}

bool parse_engine(const std::string& text, Engine& engine) {
  if (text == "local") engine = Engine::kLocal;
  if (text == "slurm") engine = Engine::kSlurm;
  if (text == "parallel") engine = Engine::kParallel;
  return text == "local" || text == "slurm" || text == "parallel";
}

void add_engine_options(CommandLine& line, CLI::App& command, BatchRequest& request) {
  line.takes(add_parsed(command, "--engine",
                        "Who runs them: local, slurm (an array of jobs) or parallel (GNU parallel) "
                        "[local]",
                        "ENGINE", "local, slurm or parallel",
                        [&request](const std::string& text) {
                          return parse_engine(text, request.engine);
                        }),
             {"local", "slurm", "parallel"});
  command
      .add_option("--engine-option", request.engine_options,
                  "A word for the engine's command, as --engine-option=--partition=lab; can be "
                  "repeated")
      ->type_name("WORD")
      ->expected(1)
      ->take_all();
  add_parsed(command, "--parts", "Parts into which the runs are divided for an engine", "N",
             "a whole number from 1 to 1000000", [&request](const std::string& text) {
               return parse_number(text, request.parts) && request.parts >= 1 &&
                      request.parts <= 1'000'000;
             });
  command.add_flag("--wait", request.wait, "With slurm: wait, and collect the results");
}

}  // namespace

void add_batch(CommandLine& line) {
  const auto request = std::make_shared<BatchRequest>();
  CLI::App& command =
      line.add_command("batch", "Run programs on many worlds with many seeds and settings");
  command.footer(
      "For example\n"
      "  playpen batch plan.json --out runs\n"
      "The same command goes on after an interruption, and runs only what is new.\n"
      "Exit status: 0 all runs have results, 1 some have none, 2 bad input.");
  CLI::Option* const plan = command.add_option(
      "plan", request->plan, "File that says which runs; without it: the batch of --out");
  line.takes(plan->type_name(""), ValueKind::Kind::kFile);
  CLI::Option* const out =
      command.add_option("--out", request->output_folder, "Folder for results");
  line.takes(out->required()->type_name("DIR"), ValueKind::Kind::kFolder);
  add_jobs(command, request->jobs);
  add_engine_options(line, command, *request);
  CLI::Option* const collect =
      command.add_flag("--collect", request->collect, "Run nothing, only collect the results");
  CLI::Option* const failed = command.add_flag(
      "--failed", request->failed, "Run those again whose program crashed or took too long");
  CLI::Option* const part =
      add_parsed(command, "--part", "Run only this part, and collect nothing: for engines", "K/N",
                 "two whole numbers, as 3/20",
                 [request](const std::string& text) { return parse_part(text, request->part); });
  CLI::Option* const repeat =
      command.add_option("--repeat", request->repeat, "Run this unit of the batch with a window")
          ->type_name("ID");
  add_isolation(line, command, request->isolation);
  failed->excludes(collect);
  for (CLI::Option* const alone : {part, repeat}) {
    alone->excludes(plan)->excludes(collect)->excludes(failed);
  }
  part->excludes(repeat);
  command.callback([request, &line] {
    request->invocation = line.invocation;
    line.status = run_batch(*request);
  });
}

}  // namespace playpen
