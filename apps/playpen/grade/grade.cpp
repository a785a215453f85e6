// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/grade.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "playerlike/host/program.h"
#include "playerlike/host/results.h"
#include "playerlike/host/run_settings.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
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

playerlike::ProgramJob job_for(const GradeSettings& settings, const TaskWorld& world,
                               const sim::WorldDescription& description, std::uint64_t seed,
                               const fs::path& folder, playerlike::Grading& asked) {
  playerlike::RunSettings run;
  run.seed = seed;
  run.realism = settings.realism;
  run.duration_s = settings.task.duration_s;
  run.output_folder = folder.string();
  run.quiet_end = true;
  run.virtual_time = !settings.virtual_time.empty();
  sim::WorldDescription as_run = description;
  run.apply_to(as_run);
  asked = playerlike::grading_of(new_nonce(), as_run);
  run.grading = asked;
  playerlike::ProgramJob job;
  job.command = settings.program;
  for (const auto* more : {&settings.task.arguments, &world.arguments}) {
    job.command.insert(job.command.end(), more->begin(), more->end());
  }
  job.environment = playerlike::run_environment(world.file, run);
  job.environment.insert(settings.virtual_time.begin(), settings.virtual_time.end());
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
  const Task& task = settings.task;
  Grade result{task, settings.program, {}};
  std::vector<Reference> references;
  std::vector<sim::WorldDescription> descriptions;
  for (const TaskWorld& world : task.worlds) {
    descriptions.push_back(sim::load_world(world.file));
    references.push_back(make_reference(task, world, descriptions.back()));
  }
  std::vector<playerlike::ProgramJob> jobs;
  std::vector<const Reference*> reference_of;
  const fs::path out(settings.output_folder);
  const WorkFolder work(out);
  for (std::size_t i = 0; i < task.worlds.size(); ++i) {
    for (const std::uint64_t seed : task.seeds) {
      GradedRun run;
      run.world = references[i].world;
      run.seed = seed;
      run.folder = run.world + "_seed" + std::to_string(seed);
      run.faults = {"not run yet"};
      prepare_folder(out / run.folder);
      prepare_folder(work.path() / run.folder);
      jobs.push_back(job_for(settings, task.worlds[i], descriptions[i], seed,
                             work.path() / run.folder, run.asked));
      reference_of.push_back(&references[i]);
      result.runs.push_back(std::move(run));
    }
  }

  playerlike::JobLimits limits;
  limits.at_once = settings.jobs;
  limits.timeout_s = task.timeout_s;
  Progress progress{jobs.size(), 0, 0};
  const auto tell = [&] {
    if (on_progress) on_progress(progress, result);
  };
  tell();
  const std::vector<playerlike::JobEnd> ends = playerlike::run_programs(
      jobs, limits,
      [&](std::size_t /*index*/) {
        ++progress.running;
        tell();
      },
      [&](std::size_t index, const playerlike::JobEnd& end) {
        // All processes of this run have ended, but those of other runs may still change files. So
        // grade the run now.
        GradedRun& run = result.runs[index];
        take_results(work.path() / run.folder, out / run.folder);
        evaluate(task, *reference_of[index], end, out / run.folder, run);
        --progress.running;
        ++progress.ended;
        tell();
      });
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].kind != playerlike::JobEnd::Kind::kNotStarted) continue;
    evaluate(task, *reference_of[i], ends[i], out / result.runs[i].folder, result.runs[i]);
  }
  return result;
}

}  // namespace playpen::grade
