// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/runs.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "playerlike/host/rerun.h"
#include "playerlike/host/results.h"
#include "playerlike/host/run_settings.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/core/replace_file.h"
#include "sim/simulation/simulation.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;

/// Creates a run's folder and removes the results of earlier runs from it.
void prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    throw std::runtime_error("the output folder '" + folder.string() +
                             "' can't be made: " + error.message());
  }
  playerlike::remove_results(folder.string());
}

/// A number that is unique to the run.
std::string new_nonce() {
  std::random_device random;
  std::string nonce;
  for (int i = 0; i < 4; ++i) nonce += sim::hexadecimal_text(random(), 8);
  return nonce;
}

playerlike::RunSettings settings_of_run(const GradeSettings& settings, const Task& task,
                                        std::uint64_t seed, const fs::path& folder) {
  playerlike::RunSettings run;
  run.seed = seed;
  run.realism = settings.realism;
  run.duration_s = task.duration_s;
  run.output_folder = folder.string();
  run.quiet_end = true;
  run.virtual_time = settings.virtual_time;
  return run;
}

playerlike::ProgramJob job_for(const GradeSettings& settings, const Task& task,
                               const TaskWorld& world, const sim::WorldDescription& description,
                               const playerlike::TaskRules& rules, std::uint64_t seed,
                               const fs::path& folder, playerlike::Grading& asked) {
  playerlike::RunSettings run = settings_of_run(settings, task, seed, folder);
  sim::WorldDescription as_run = description;
  run.apply_to(as_run);
  asked = playerlike::grading_of(new_nonce(), rules, as_run);
  run.grading = asked;
  playerlike::ProgramJob job;
  job.command = settings.launcher;
  job.command.insert(job.command.end(), settings.program.begin(), settings.program.end());
  for (const auto* more : {&task.arguments, &world.arguments}) {
    job.command.insert(job.command.end(), more->begin(), more->end());
  }
  job.environment = playerlike::run_environment(world.file, run);
  job.environment.insert(settings.environment.begin(), settings.environment.end());
  job.working_folder = settings.working_folder;
  job.output_file = (folder / playerlike::kProgramLog).string();
  job.folder = folder.string();
  job.folder_limit = kMostOutput;
  return job;
}

/// Writes the results of a run whose program has died, from what its host has kept. Such a run
/// fails, so signing its report for the program gives nothing away.
/// @return whether there were results to write.
bool complete(const playerlike::KeptRun& kept, sim::WorldDescription world,
              const playerlike::RunSettings& settings, const playerlike::JobEnd& end,
              const GradedRun& run) {
  settings.apply_to(world);
  if (!playerlike::complete_results(kept, world, settings, end.program)) return false;
  const std::string file = (fs::path(settings.output_folder) / "report.json").string();
  std::string text;
  if (sim::read_whole_file(file, {}, text)) return true;
  if (const int error = sim::replace_file(file, playerlike::signed_report(text, run.asked))) {
    throw std::runtime_error("cannot write " + file + ": " + std::strerror(error));
  }
  return true;
}

/// Moves the results of a run to their folder.
void take_results(const fs::path& from, const fs::path& to) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(from, error)) {
    entries.push_back(entry.path());
  }
  for (const fs::path& entry : entries) {
    const fs::path place = to / entry.filename();
    fs::rename(entry, place, error);
    if (!error) continue;
    fs::remove_all(place, error);  // removes an existing folder
    fs::rename(entry, place);
  }
  fs::remove_all(from, error);
}

constexpr const char* kWorkPrefix = ".running-";

/// Removes the work folders of a grader that was killed.
void remove_those_of_others(const fs::path& out) {
  std::error_code ignored;
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(out, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kWorkPrefix)) continue;
    const int process = std::atoi(name.c_str() + std::strlen(kWorkPrefix));
    if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) left.push_back(entry.path());
  }
  for (const fs::path& folder : left) fs::remove_all(folder, ignored);
}

}  // namespace

PreparedTask::PreparedTask(Task task) : task_(std::move(task)) {
  for (const TaskWorld& world : task_.worlds) {
    references_.push_back(make_reference(task_, world, sim::load_world(world.file)));
  }
}

WorkFolder::WorkFolder(const fs::path& out) {
  remove_those_of_others(out);
  path_ = out / (kWorkPrefix + std::to_string(getpid()));
  prepare_folder(path_);
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

ProgramRuns::ProgramRuns(const PreparedTask& task, const GradeSettings& settings, Grade& result,
                         const Known& known)
    : task_(task),
      settings_(settings),
      result_(result),
      out_(settings.output_folder),
      work_(out_),
      kept_(task.task().worlds.size() * task.task().seeds.size()) {
  for (std::size_t world = 0; world < task_.task().worlds.size(); ++world) {
    for (const std::uint64_t seed : task_.task().seeds) prepare(world, seed, known);
  }
}

void ProgramRuns::prepare(std::size_t world, std::uint64_t seed, const Known& known) {
  const Reference& reference = task_.reference(world);
  GradedRun run;
  run.world = reference.world;
  run.robot = reference.robot;
  run.goal = reference.goal;
  run.seed = seed;
  run.folder = run.world + "_seed" + std::to_string(seed);
  run.faults = {"not run yet"};
  const fs::path work = work_.path() / run.folder;
  playerlike::ProgramJob job =
      job_for(settings_, task_.task(), task_.task().worlds[world], task_.description(world),
              rules_of(task_.task(), reference), seed, work, run.asked);
  if (std::optional<GradedRun> earlier = known ? known(run) : std::nullopt) {
    result_.runs.push_back(*std::move(earlier));
    return;
  }
  prepare_folder(out_ / run.folder);
  prepare_folder(work);
  std::unique_ptr<playerlike::KeptRun>& kept = kept_[jobs_.size()];
  job.at_start = [&kept] {
    kept = std::make_unique<playerlike::KeptRun>();
    return playerlike::EnvironmentChanges{{"PLAYPEN_STATE", kept->file()}};
  };
  job.kept = [&kept]() -> const playerlike::KeptRun& { return *kept; };
  jobs_.push_back(std::move(job));
  world_of_.push_back(world);
  run_of_.push_back(result_.runs.size());
  result_.runs.push_back(std::move(run));
}

const GradedRun& ProgramRuns::judge(std::size_t job, const playerlike::JobEnd& end) {
  GradedRun& run = result_.runs[run_of_[job]];
  const fs::path folder = work_.path() / run.folder;
  bool completed = false;
  std::string problem;
  try {
    completed = complete(*kept_[job], task_.description(world_of_[job]),
                         settings_of_run(settings_, task_.task(), run.seed, folder), end, run);
  } catch (const std::exception& error) {
    completed = true;
    problem = std::string("results of the run are missing: ") + error.what();
  }
  kept_[job].reset();
  take_results(folder, out_ / run.folder);
  evaluate(task_.task(), task_.reference(world_of_[job]), end, out_ / run.folder, completed, run);
  if (!problem.empty()) run.faults.push_back(std::move(problem));
  return run;
}

void ProgramRuns::judge_unstarted(std::size_t job, const playerlike::JobEnd& end) {
  GradedRun& run = result_.runs[run_of_[job]];
  evaluate(task_.task(), task_.reference(world_of_[job]), end, out_ / run.folder,
           /*completed=*/false, run);
}

}  // namespace playpen::grade
