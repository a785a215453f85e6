// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>

#include "class_plots.h"
#include "commands.h"
#include "course/class_likeness.h"
#include "course/class_runs.h"
#include "course/html_report.h"
#include "course/results.h"
#include "preload.h"
#include "progress_bar.h"
#include "project.h"
#include "shipped.h"
#include "sim/core/error.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

/// Shows what is being done with a class.
class ClassProgressLine {
 public:
  void show(const course::ClassProgress& progress) {
    if (progress.ended == 0 && progress.running == 0) {
      const bool builds = progress.step == course::ClassProgress::Step::kBuild;
      bar_.begin(builds ? "compiling" : progress.task);
      std::cerr << (builds ? "compile: " : progress.task + ": ") << progress.all
                << (builds ? " submissions" : " runs");
      if (progress.known > 0) std::cerr << ", " << progress.known << " known from before";
      std::cerr << '\n';
    }
    bar_.show(progress.ended, progress.all);
  }
  /// Shows how many plots are drawn, of `all`.
  void show_plots(std::size_t ended, std::size_t all) {
    if (ended == 0) {
      bar_.begin("plots");
      std::cerr << "plots: " << all << " runs\n";
    }
    bar_.show(ended, all);
  }
  void clear() const { bar_.clear(); }

 private:
  ProgressBar bar_;
};

/// The variables by which build tools find this Playpen.
playerlike::EnvironmentChanges build_environment() {
  const std::optional<fs::path> prefix = package_prefix();
  if (!prefix) {
    throw std::runtime_error("Playpen's CMake package is missing, so nothing can be compiled: " +
                             std::string("cmake --install BUILD --prefix PREFIX"));
  }
  playerlike::EnvironmentChanges variables;
  variables["CMAKE_PREFIX_PATH"] = prefix->string();
  if (const std::optional<fs::path> folder = pkgconfig_folder()) {
    variables["PKG_CONFIG_PATH"] = folder->string();
    const std::string libraries = folder->parent_path().string();
    variables["CPATH"] = (*prefix / "include/player-3.1").string();
    variables["LIBRARY_PATH"] = libraries;
    variables["LD_RUN_PATH"] = libraries;
  }
  return variables;
}

std::vector<grade::Task> load_tasks(const ClassRequest& request) {
  std::vector<grade::Task> tasks;
  std::set<std::string> names;
  for (const std::string& name : request.tasks) {
    grade::Task task = load_task(name);
    if (!names.insert(task.name).second) {
      throw std::runtime_error("the task '" + task.name + "' was named twice");
    }
    if (!request.seeds.empty()) task.seeds = request.seeds;
    if (request.timeout_s) task.timeout_s = *request.timeout_s;
    tasks.push_back(std::move(task));
  }
  return tasks;
}

/// The programs that everybody in a class knows: the templates of the tasks, and those that the
/// user names. A single submission is not compared with others.
std::vector<course::Submission> baselines_of(const ClassRequest& request,
                                             const course::ClassSettings& settings) {
  std::vector<course::Submission> baselines;
  if (settings.submissions.size() < 2 || settings.individual) return baselines;
  for (const ProjectTemplate& kind : kProjectTemplates) {
    const auto is_its_task = [&kind](const grade::Task& task) { return task.name == kind.task; };
    const std::optional<fs::path> folder = template_folder(kind);
    if (folder && std::any_of(settings.tasks.begin(), settings.tasks.end(), is_its_task)) {
      baselines.push_back(
          course::one_submission(*folder, std::string("template ") + kind.name, {}));
    }
  }
  for (const std::string& place : request.baselines) {
    baselines.push_back(course::one_submission(place, "", {}));
  }
  course::name_folders(baselines);
  return baselines;
}

/// Draws the plots of the report and writes its replays, unless the grading was interrupted.
/// @return whether all are drawn, as far as they can be.
bool draw_plots(const course::ClassResult& result, const course::ClassSettings& settings,
                bool replays, ClassProgressLine& line) {
  if (!result.complete) {
    remove_stale_plots(result, settings.output_folder);
    return false;
  }
  const bool drawn = draw_class_plots(
      result, settings.output_folder, settings.jobs, replays,
      [&line](std::size_t ended, std::size_t all) { line.show_plots(ended, all); });
  line.clear();
  return drawn;
}

}  // namespace

int grade_class(const ClassRequest& request) {
  const IsolatedPrograms isolated(request.isolation);
  const PreloadedLibrary virtual_time;
  course::ClassSettings settings;
  settings.tasks = load_tasks(request);
  const std::vector<course::Person> roster = request.roster_file.empty()
                                                 ? std::vector<course::Person>{}
                                                 : course::read_roster(request.roster_file);
  settings.submissions = request.submission.empty()
                             ? course::find_submissions(request.submissions_folder, roster)
                             : std::vector{course::one_submission(request.submission, request.id,
                                                                  request.output_folder)};
  settings.output_folder = request.output_folder;
  settings.version = PLAYPEN_VERSION;
  settings.jobs = request.jobs;
  settings.realism = request.realism;
  settings.individual = request.individual;
  settings.isolated = isolated.isolated();
  if (!settings.isolated) virtual_time.add_to(settings.environment);
  add_libraries_folder(settings.environment);
  settings.launcher = [&](const grade::Task& task, const std::string& source) {
    std::vector<std::string> hidden = {task.file};
    for (const grade::TaskWorld& world : task.worlds) hidden.push_back(world.file);
    return isolated.launcher(virtual_time.file(), hidden, {source});
  };
  settings.build.program = request.program;
  if (request.build_timeout_s) settings.build.timeout_s = *request.build_timeout_s;
  settings.build.environment = build_environment();
  settings.build.launcher = [&isolated](const std::vector<std::string>& readable) {
    return isolated.build_launcher(readable);
  };
  settings.baselines = baselines_of(request, settings);
  fs::create_directories(request.output_folder);

  ClassProgressLine line;
  course::ClassResult result = course::grade_class(
      settings, [&line](const course::ClassProgress& progress) { line.show(progress); });
  line.clear();
  for (const course::SubmissionResult& one : result.baselines) {
    if (one.build.built) continue;
    std::cerr << "playpen: the baseline '" << one.id << "' has no program: " << one.build.reason
              << '\n';
  }
  // Under other conditions, robots drive other ways.
  if (result.complete && !request.individual)
    course::compare_submissions(result, request.output_folder);
  course::write_results(result, request.output_folder);
  const bool drawn = draw_plots(result, settings, request.replays, line);
  course::write_html_report(result, request.output_folder);
  std::cout << course::class_table(result, terminal_columns(STDOUT_FILENO));
  if (!result.complete || !drawn) {
    std::cout << "interrupted: the same command goes on from here\n";
    return kProgramFailed;
  }
  std::cout << "details: " << (fs::path(request.output_folder) / "class.json").string() << '\n'
            << "report: " << (fs::path(request.output_folder) / "index.html").string() << '\n';
  const bool all_passed =
      std::all_of(result.submissions.begin(), result.submissions.end(),
                  [](const auto& one) { return one.build.built && one.passed() == one.runs(); });
  return all_passed || !request.must_pass ? kOk : kProgramFailed;
}

}  // namespace playpen
