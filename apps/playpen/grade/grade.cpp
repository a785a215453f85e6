// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/grade.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "playerlike/host/kept_results.h"
#include "playerlike/host/program.h"
#include "playerlike/host/results.h"
#include "playerlike/host/run_settings.h"
#include "sim/core/error.h"
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

bool same_world(const std::string& a, const std::string& b) {
  if (a == b) return true;
  std::error_code error;
  return !a.empty() && !b.empty() && fs::equivalent(a, b, error);
}

/// A number that is unique to the run.
std::string new_nonce() {
  std::random_device random;
  std::string nonce;
  for (int i = 0; i < 4; ++i) nonce += sim::hexadecimal_text(random(), 8);
  return nonce;
}

playerlike::RunSettings settings_of_run(const GradeSettings& settings, std::uint64_t seed,
                                        const fs::path& folder) {
  playerlike::RunSettings run;
  run.seed = seed;
  run.realism = settings.realism;
  run.duration_s = settings.task.duration_s;
  run.output_folder = folder.string();
  run.quiet_end = true;
  run.virtual_time = settings.virtual_time;
  return run;
}

playerlike::ProgramJob job_for(const GradeSettings& settings, const TaskWorld& world,
                               const sim::WorldDescription& description,
                               const playerlike::TaskRules& rules, std::uint64_t seed,
                               const fs::path& folder, playerlike::Grading& asked) {
  playerlike::RunSettings run = settings_of_run(settings, seed, folder);
  sim::WorldDescription as_run = description;
  run.apply_to(as_run);
  asked = playerlike::grading_of(new_nonce(), rules, as_run);
  run.grading = asked;
  playerlike::ProgramJob job;
  job.command = settings.launcher;
  job.command.insert(job.command.end(), settings.program.begin(), settings.program.end());
  for (const auto* more : {&settings.task.arguments, &world.arguments}) {
    job.command.insert(job.command.end(), more->begin(), more->end());
  }
  job.environment = playerlike::run_environment(world.file, run);
  job.environment.insert(settings.environment.begin(), settings.environment.end());
  job.output_file = (folder / "program.log").string();
  job.folder = folder.string();
  job.folder_limit = kMostOutput;
  return job;
}

/// The folder in which programs run, separate from the results. The grader moves a program's output
/// out of it before grading.
class WorkFolder {
 public:
  explicit WorkFolder(const fs::path& out) {
    remove_those_of_others(out);
    path_ = out / (kPrefix + std::to_string(getpid()));
    prepare_folder(path_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  [[nodiscard]] const fs::path& path() const noexcept { return path_; }

 private:
  static constexpr const char* kPrefix = ".running-";

  /// Removes the work folders of a grader that was killed.
  static void remove_those_of_others(const fs::path& out) {
    std::error_code ignored;
    std::vector<fs::path> left;
    for (const fs::directory_entry& entry : fs::directory_iterator(out, ignored)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(kPrefix)) continue;
      const int process = std::atoi(name.c_str() + std::string(kPrefix).size());
      if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) left.push_back(entry.path());
    }
    for (const fs::path& folder : left) fs::remove_all(folder, ignored);
  }

  fs::path path_;
};

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

/// The runs of a grading: prepares them, and judges them when they have ended.
class Runs {
 public:
  /// @param result  gets the runs; must outlive this object.
  Runs(const GradeSettings& settings, Grade& result)
      : settings_(settings),
        result_(result),
        out_(settings.output_folder),
        kept_(settings.task.worlds.size() * settings.task.seeds.size()) {
    for (const TaskWorld& world : settings.task.worlds) {
      descriptions_.push_back(sim::load_world(world.file));
      references_.push_back(make_reference(settings.task, world, descriptions_.back()));
    }
    work_.emplace(out_);
    for (std::size_t world = 0; world < references_.size(); ++world) {
      for (const std::uint64_t seed : settings.task.seeds) prepare(world, seed);
    }
  }

  [[nodiscard]] const std::vector<playerlike::ProgramJob>& jobs() const noexcept { return jobs_; }

  /// Judges a run whose processes have all ended. Those of other runs may still change files, so
  /// this must be done before anything else.
  void judge(std::size_t index, const playerlike::JobEnd& end) {
    GradedRun& run = result_.runs[index];
    const fs::path folder = work_->path() / run.folder;
    bool completed = false;
    std::string problem;
    try {
      completed = complete(*kept_[index], descriptions_[world_of_[index]],
                           settings_of_run(settings_, run.seed, folder), end, run);
    } catch (const std::exception& error) {
      completed = true;
      problem = std::string("results of the run are missing: ") + error.what();
    }
    kept_[index].reset();
    take_results(folder, out_ / run.folder);
    evaluate(settings_.task, references_[world_of_[index]], end, out_ / run.folder, completed, run);
    if (!problem.empty()) run.faults.push_back(std::move(problem));
  }

  /// Judges a run that was not started.
  void judge_unstarted(std::size_t index, const playerlike::JobEnd& end) {
    GradedRun& run = result_.runs[index];
    evaluate(settings_.task, references_[world_of_[index]], end, out_ / run.folder,
             /*completed=*/false, run);
  }

 private:
  void prepare(std::size_t world, std::uint64_t seed) {
    GradedRun run;
    run.world = references_[world].world;
    run.robot = references_[world].robot;
    run.goal = references_[world].goal;
    run.seed = seed;
    run.folder = run.world + "_seed" + std::to_string(seed);
    run.faults = {"not run yet"};
    prepare_folder(out_ / run.folder);
    prepare_folder(work_->path() / run.folder);
    jobs_.push_back(job_for(settings_, settings_.task.worlds[world], descriptions_[world],
                            rules_of(settings_.task, references_[world]), seed,
                            work_->path() / run.folder, run.asked));
    std::unique_ptr<playerlike::KeptRun>& kept = kept_[world_of_.size()];
    jobs_.back().at_start = [&kept] {
      kept = std::make_unique<playerlike::KeptRun>();
      return playerlike::EnvironmentChanges{{"PLAYPEN_STATE", kept->file()}};
    };
    world_of_.push_back(world);
    result_.runs.push_back(std::move(run));
  }

  const GradeSettings& settings_;
  Grade& result_;
  const fs::path out_;
  std::optional<WorkFolder> work_;  ///< made when the worlds are known to be usable
  std::vector<sim::WorldDescription> descriptions_;
  std::vector<Reference> references_;
  std::vector<playerlike::ProgramJob> jobs_;
  std::vector<std::size_t> world_of_;                       ///< by run
  std::vector<std::unique_ptr<playerlike::KeptRun>> kept_;  ///< by run; null unless it runs
};

}  // namespace

void choose_worlds(Task& task, const std::vector<std::string>& files) {
  std::vector<TaskWorld> chosen;
  std::set<std::string> names;
  for (const std::string& file : files) {
    const std::string name = world_name(file);
    if (!names.insert(name).second) {
      throw sim::ConfigError(
          sim::ConfigIssue{"task/duplicate-world", file, "", "worlds with names of their own",
                           '"' + name + "\" a second time", "runs are told apart by these names"});
    }
    const auto known =
        std::find_if(task.worlds.begin(), task.worlds.end(),
                     [&file](const TaskWorld& world) { return same_world(world.file, file); });
    if (known != task.worlds.end()) {
      chosen.push_back(*known);
    } else {
      chosen.push_back({file, {}, std::nullopt});
    }
  }
  task.worlds = std::move(chosen);
}

Grade grade(const GradeSettings& settings,
            const std::function<void(const Progress&, const Grade&)>& on_progress) {
  Grade result{settings.task, settings.program, {}, !settings.launcher.empty()};
  Runs runs(settings, result);
  playerlike::JobLimits limits;
  limits.at_once = settings.jobs;
  limits.timeout_s = settings.task.timeout_s;
  Progress progress{runs.jobs().size(), 0, 0};
  const auto tell = [&] {
    if (on_progress) on_progress(progress, result);
  };
  tell();
  const std::vector<playerlike::JobEnd> ends = playerlike::run_programs(
      runs.jobs(), limits,
      [&](std::size_t /*index*/) {
        ++progress.running;
        tell();
      },
      [&](std::size_t index, const playerlike::JobEnd& end) {
        runs.judge(index, end);
        --progress.running;
        ++progress.ended;
        tell();
      });
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].kind == playerlike::JobEnd::Kind::kNotStarted) runs.judge_unstarted(i, ends[i]);
  }
  return result;
}

}  // namespace playpen::grade
