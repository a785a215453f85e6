// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "class_plots.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "course/html_report.h"
#include "playerlike/host/program.h"
#include "sim/core/replace_file.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

// A plot of an honest run takes less than a second.
constexpr double kPlotTimeout_s = 30.0;

bool is_regular(const fs::path& file) {
  std::error_code error;
  return fs::symlink_status(file, error).type() == fs::file_type::regular;
}

bool has_results(const fs::path& run) {
  return is_regular(run / "report.json") && is_regular(run / "trajectory.csv");
}

// Whether the plot of a run shows its results. A time in the future is not one at which a plot was
// drawn.
bool has_fresh_plot(const fs::path& run) {
  const fs::path plot = run / course::kPlotFile;
  if (!is_regular(plot) || !has_results(run)) return false;
  std::error_code error;
  const fs::file_time_type drawn = fs::last_write_time(plot, error);
  if (error || drawn > fs::file_time_type::clock::now()) return false;
  for (const char* const name : {"report.json", "trajectory.csv"}) {
    const fs::file_time_type written = fs::last_write_time(run / name, error);
    if (error || written >= drawn) return false;
  }
  return true;
}

// The folder of a grade's runs, absolute, so that no option looks like it.
fs::path folder_of(const fs::path& out, const course::SubmissionResult& submission,
                   const grade::Grade& grade) {
  return fs::absolute(out / submission.folder / grade.task.name);
}

// The runs that need a plot.
std::vector<fs::path> unplotted_runs(const course::ClassResult& result, const fs::path& out) {
  std::vector<fs::path> folders;
  for (const course::SubmissionResult& submission : result.submissions) {
    for (const grade::Grade& grade : submission.grades) {
      for (const grade::GradedRun* run : course::shown_runs(grade)) {
        const fs::path folder = folder_of(out, submission, grade) / run->folder;
        // What cannot be removed is not replaced: a link would be followed.
        std::error_code error;
        const bool is_free = fs::symlink_status(folder / course::kPlotFile, error).type() ==
                             fs::file_type::not_found;
        if (is_free && has_results(folder)) folders.push_back(folder);
      }
    }
  }
  return folders;
}

}  // namespace

void remove_stale_plots(const course::ClassResult& result, const fs::path& out) {
  for (const course::SubmissionResult& submission : result.submissions) {
    for (const grade::Grade& grade : submission.grades) {
      for (const grade::GradedRun& run : grade.runs) {
        const fs::path folder = folder_of(out, submission, grade) / run.folder;
        std::error_code ignored;
        if (!has_fresh_plot(folder)) fs::remove_all(folder / course::kPlotFile, ignored);
      }
    }
  }
}

bool draw_class_plots(const course::ClassResult& result, const fs::path& out, int jobs,
                      const std::function<void(std::size_t, std::size_t)>& on_progress) {
  remove_stale_plots(result, out);
  const std::vector<fs::path> folders = unplotted_runs(result, out);
  if (folders.empty()) return true;
  const std::string command = fs::read_symlink("/proc/self/exe").string();
  std::vector<playerlike::ProgramJob> processes;
  for (const fs::path& folder : folders) {
    playerlike::ProgramJob process;
    process.command = {command, "plot", folder.string(), "--out",
                       (folder / course::kPlotFile).string()};
    process.output_file = "/dev/null";
    processes.push_back(std::move(process));
  }
  playerlike::JobLimits limits;
  limits.at_once = jobs;
  limits.timeout_s = kPlotTimeout_s;
  std::size_t ended = 0;
  if (on_progress) on_progress(ended, folders.size());
  const std::vector<playerlike::JobEnd> ends = playerlike::run_programs(
      processes, limits, {}, [&](std::size_t index, const playerlike::JobEnd& end) {
        if (end.kind != playerlike::JobEnd::Kind::kEnded || !end.program.success()) {
          std::error_code ignored;
          const std::string plot = (folders[index] / course::kPlotFile).string();
          fs::remove(sim::part_file_name(plot), ignored);
        }
        if (on_progress) on_progress(++ended, folders.size());
      });
  return std::all_of(ends.begin(), ends.end(), [](const playerlike::JobEnd& end) {
    return end.kind != playerlike::JobEnd::Kind::kInterrupted &&
           end.kind != playerlike::JobEnd::Kind::kNotStarted;
  });
}

}  // namespace playpen
