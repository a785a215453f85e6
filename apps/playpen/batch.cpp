// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <system_error>

#include "batch/batch_results.h"
#include "batch/engines.h"
#include "batch/plan.h"
#include "batch/unit_runs.h"
#include "batch/units.h"
#include "commands.h"
#include "grade/text.h"
#include "playerlike/host/program.h"
#include "preload.h"
#include "progress_bar.h"
#include "shipped.h"
#include "sim/core/error.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kIsolationNames{"off", "best", "required"};

IsolationSettings isolation_of(const batch::Batch& batch) {
  const auto* const name =
      std::find(kIsolationNames.begin(), kIsolationNames.end(), batch.isolation);
  if (name == kIsolationNames.end()) {
    throw std::runtime_error("units.json asks for the isolation '" + batch.isolation +
                             "': expected off, best or required");
  }
  return {static_cast<Isolation>(name - kIsolationNames.begin()), batch.readable};
}

/// A name of a plan that is a file beside the plan; otherwise the name.
std::string beside(const std::string& plan_file, const std::string& name) {
  const fs::path file = fs::absolute(plan_file).parent_path() / name;
  std::error_code error;
  return fs::exists(file, error) ? file.lexically_normal().string() : name;
}

/// The program of a plan. A name with a slash is relative to the plan, another one is on the PATH.
std::string found_program(const std::string& plan_file, const std::string& name) {
  const std::string place =
      name.find('/') == std::string::npos
          ? playerlike::find_program(name)
          : playerlike::find_program((fs::absolute(plan_file).parent_path() / name).string());
  return fs::absolute(place).lexically_normal().string();
}

/// Makes a plan's names of files absolute. Names of worlds and tasks may be those of shipped ones.
void find_files_of(batch::Plan& plan) {
  if (!plan.task.empty()) {
    plan.task = fs::absolute(load_task(beside(plan.file, plan.task)).file).string();
  }
  for (std::string& world : plan.worlds) {
    world = find_world(beside(plan.file, world));
    if (!world.empty()) world = fs::absolute(world).string();
  }
  for (batch::PlannedProgram& program : plan.programs) {
    program.command.front() = found_program(plan.file, program.command.front());
  }
}

/// The batch that the request is about: that of its plan, or that of the output folder.
batch::Batch batch_of(const BatchRequest& request, const fs::path& out) {
  if (request.plan.empty()) {
    batch::Batch known = batch::read_batch(out);
    if (known.version == PLAYPEN_VERSION) return known;
    throw std::runtime_error("the batch of '" + out.string() + "' belongs to Playpen " +
                             known.version +
                             ", and this is Playpen " PLAYPEN_VERSION ": give its plan again");
  }
  batch::Plan plan = batch::read_plan(request.plan);
  find_files_of(plan);
  batch::BatchSettings settings;
  settings.version = PLAYPEN_VERSION;
  settings.isolation = kIsolationNames.at(static_cast<std::size_t>(request.isolation.level));
  for (const std::string& path : request.isolation.readable) {
    settings.readable.push_back(fs::absolute(path).lexically_normal().string());
  }
  settings.out = out;
  batch::Batch made = batch::make_batch(plan, settings);
  batch::write_batch(made, out);
  return made;
}

/// Runs units in this process.
/// @param shown  whether the progress is shown.
/// @return whether all have results.
bool run_here(const batch::Batch& batch, const std::vector<std::size_t>& units,
              const BatchRequest& request, const fs::path& out, bool shown) {
  const IsolatedPrograms isolated(isolation_of(batch));
  const PreloadedLibrary virtual_time;
  batch::UnitRunSettings settings;
  settings.out = out;
  settings.jobs = request.jobs;
  if (!isolated.isolated()) virtual_time.add_to(settings.environment);
  add_libraries_folder(settings.environment);
  settings.launcher = [&](const batch::Condition& condition) {
    return isolated.launcher(virtual_time.file(),
                             {out.string(), batch.task_file, condition.file, condition.original});
  };
  ProgressBar bar;
  bool begun = false;
  const bool complete =
      batch::run_units(batch, units, settings, [&](const batch::UnitProgress& progress) {
        if (!shown) return;
        if (!begun) {
          bar.begin("batch");
          std::cerr << "batch: " << progress.all << " runs";
          if (progress.known > 0) std::cerr << ", " << progress.known << " known from before";
          std::cerr << '\n';
          begun = true;
        }
        bar.show(progress.ended, progress.all);
      });
  bar.clear();
  return complete;
}

/// The parts of a batch that have a unit without results.
std::vector<std::size_t> unfinished_parts(const batch::Batch& batch, const fs::path& out,
                                          std::size_t parts) {
  std::vector<std::size_t> unfinished;
  for (std::size_t part = 1; part <= parts; ++part) {
    const auto [begin, end] = batch::units_of_part(batch.units.size(), part, parts);
    for (std::size_t i = begin; i < end; ++i) {
      if (batch::read_unit(out, batch.units[i])) continue;
      unfinished.push_back(part);
      break;
    }
  }
  return unfinished;
}

/// Hands the units to an engine.
/// @return whether the engine has ended.
bool run_by_engine(const batch::Batch& batch, const BatchRequest& request, const fs::path& out) {
  batch::EngineCall call;
  call.command = fs::read_symlink("/proc/self/exe").string();
  call.out = out;
  call.parts = request.parts > 0 ? std::min(request.parts, batch.units.size())
                                 : batch::usual_parts(batch.units.size());
  call.wanted = unfinished_parts(batch, out, call.parts);
  call.options = request.engine_options;
  call.wait = request.wait;
  if (call.wanted.empty()) return true;
  std::vector<std::string> words;
  if (request.engine == Engine::kSlurm) {
    const fs::path script = out / "slurm" / "part.sh";
    grade::write_text_file(script, batch::slurm_script(call));
    words = batch::slurm_command(call, script);
  } else {
    words = batch::parallel_command(call);
  }
  std::cerr << "batch: " << call.wanted.size() << " parts of " << call.parts << " for "
            << words.front() << '\n';
  words.front() = playerlike::find_program(words.front());
  const playerlike::ProgramEnd end = playerlike::run_program(words, {});
  const bool waits = request.wait || request.engine == Engine::kParallel;
  // Parts that failed are units without results, which the results say.
  if (!end.success() && !waits) {
    throw std::runtime_error(words.front() + ' ' + end.text());
  }
  return waits;
}

/// What helps with the runs that did not end well or did not pass.
void print_advice(const batch::BatchResult& result, const BatchRequest& request,
                  const fs::path& out) {
  constexpr std::size_t kMostShown = 5;
  std::vector<std::size_t> failed;
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    if (result.runs[i] && !result.runs[i]->passed()) failed.push_back(i);
  }
  for (std::size_t k = 0; k < std::min(failed.size(), kMostShown); ++k) {
    const batch::Unit& unit = result.batch.units[failed[k]];
    std::cout << unit.id << ": " << result.batch.programs[unit.program].name << " on "
              << result.batch.conditions[unit.condition].world << " with seed " << unit.seed << ": "
              << grade::plain_text(result.runs[failed[k]]->faults.front()) << '\n';
  }
  if (failed.size() > kMostShown) {
    std::cout << "and " << failed.size() - kMostShown << " more in results.csv\n";
  }
  if (failed.empty()) return;
  std::cout << "repeat one with a window: " << shell_word(request.invocation) << " batch --out "
            << shell_word(request.output_folder) << " --repeat "
            << result.batch.units[failed.front()].id << '\n'
            << "its pictures and output: "
            << batch::folder_of(out, result.batch.units[failed.front()]).string() << '\n';
}

/// Collects and shows the results.
int show_results(const batch::Batch& batch, const BatchRequest& request, const fs::path& out) {
  const batch::BatchResult result = batch::collect(batch, out);
  const std::vector<batch::GroupSummary> groups = batch::summarize(result);
  batch::write_results(result, groups, out);
  std::cout << batch::batch_table(result, groups, terminal_columns(STDOUT_FILENO));
  print_advice(result, request, out);
  std::cout << "details: " << (out / "batch.json").string() << ", results.csv, statistics.csv, "
            << "charts\n";
  if (result.ended() == result.runs.size()) return kOk;
  std::cout << result.runs.size() - result.ended()
            << " runs have no results yet: the same command goes on from here\n";
  return kProgramFailed;
}

int run_part(const batch::Batch& batch, const BatchRequest& request, const fs::path& out) {
  const auto [begin, end] =
      batch::units_of_part(batch.units.size(), request.part->number, request.part->count);
  std::vector<std::size_t> units(end - begin);
  std::iota(units.begin(), units.end(), begin);
  return run_here(batch, units, request, out, false) ? kOk : kProgramFailed;
}

/// Runs a unit once more, with a window. Its results stay as they are.
int repeat_unit(const batch::Batch& batch, const BatchRequest& request) {
  const auto unit =
      std::find_if(batch.units.begin(), batch.units.end(),
                   [&request](const batch::Unit& known) { return known.id == request.repeat; });
  if (unit == batch.units.end()) {
    throw std::runtime_error("the batch has no unit '" + request.repeat +
                             "': the first column of results.csv has them all");
  }
  const batch::Condition& condition = batch.conditions[unit->condition];
  const grade::Task task = batch::task_of(batch, condition);
  RunRequest run;
  run.world = condition.file;
  run.settings.seed = unit->seed;
  run.settings.duration_s = task.duration_s;
  run.settings.realism = batch.realism;
  run.settings.time_mode = sim::TimeMode::kLockstep;
  run.view = true;
  run.isolation = isolation_of(batch);
  run.command = batch.programs[unit->program].command;
  for (const auto* more : {&task.arguments, &task.worlds.front().arguments}) {
    run.command.insert(run.command.end(), more->begin(), more->end());
  }
  run.call = {request.invocation, "run", condition.file, "--seed", std::to_string(unit->seed)};
  return playpen::run(std::move(run));
}

}  // namespace

int run_batch(const BatchRequest& request) {
  const fs::path out = fs::absolute(request.output_folder).lexically_normal();
  const batch::Batch batch = batch_of(request, out);
  if (!request.repeat.empty()) return repeat_unit(batch, request);
  if (request.part) return run_part(batch, request, out);
  if (request.collect) return show_results(batch, request, out);
  if (request.failed) {
    for (const batch::Unit& unit : batch.units) {
      const auto run = batch::read_unit(out, unit);
      if (run && !batch::ended_well(*run)) batch::forget_unit(out, unit);
    }
  }
  if (request.engine == Engine::kLocal) {
    std::vector<std::size_t> units(batch.units.size());
    std::iota(units.begin(), units.end(), std::size_t{0});
    static_cast<void>(run_here(batch, units, request, out, true));  // the results say what ended
    return show_results(batch, request, out);
  }
  if (run_by_engine(batch, request, out)) return show_results(batch, request, out);
  std::cout << "when the engine has ended: " << shell_word(request.invocation) << " batch --out "
            << shell_word(request.output_folder) << " --collect\n";
  return kOk;
}

}  // namespace playpen
