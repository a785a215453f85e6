// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "class_plots.h"

#include <algorithm>
#include <array>
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

// A plot or replay of an honest run takes less than a second.
constexpr double kPlotTimeout_s = 30.0;

// What a command makes of the results of a run.
struct Product {
  const char* file;     // in the folder of the run
  const char* command;  // of this program
  const char* option;   // that takes the file
};
constexpr std::array kProducts{Product{course::kPlotFile, "plot", "--out"},
                               Product{course::kReplayFile, "replay", "--html"}};
// Something that is to be made.
struct Wanted {
  fs::path folder;
  const Product* product;
};

bool is_regular(const fs::path& file) {
  std::error_code error;
  return fs::symlink_status(file, error).type() == fs::file_type::regular;
}

bool has_results(const fs::path& run) {
  return is_regular(run / "report.json") && is_regular(run / "trajectory.csv");
}

// Whether the plot or replay of a run shows its results. A time in the future is not one at which
// it was made.
bool has_fresh(const fs::path& run, const Product& product) {
  const fs::path plot = run / product.file;
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

// What the pages lack.
std::vector<Wanted> wanted_of(const course::ClassResult& result, const fs::path& out,
                              bool replays) {
  std::vector<Wanted> wanted;
  for (const course::SubmissionResult& submission : result.submissions) {
    for (const grade::Grade& grade : submission.grades) {
      for (const grade::GradedRun* run : course::shown_runs(grade)) {
        const fs::path folder = folder_of(out, submission, grade) / run->folder;
        for (const Product& product : kProducts) {
          if (&product == &kProducts.back() && !replays) continue;
          // What cannot be removed is not replaced: a link would be followed.
          std::error_code error;
          const bool is_free =
              fs::symlink_status(folder / product.file, error).type() == fs::file_type::not_found;
          if (is_free && has_results(folder)) wanted.push_back({folder, &product});
        }
      }
    }
  }
  return wanted;
}

}  // namespace

void remove_stale_plots(const course::ClassResult& result, const fs::path& out) {
  for (const course::SubmissionResult& submission : result.submissions) {
    for (const grade::Grade& grade : submission.grades) {
      for (const grade::GradedRun& run : grade.runs) {
        const fs::path folder = folder_of(out, submission, grade) / run.folder;
        for (const Product& product : kProducts) {
          std::error_code ignored;
          if (!has_fresh(folder, product)) fs::remove_all(folder / product.file, ignored);
        }
      }
    }
  }
}

bool draw_class_plots(const course::ClassResult& result, const fs::path& out, int jobs,
                      bool replays,
                      const std::function<void(std::size_t, std::size_t)>& on_progress) {
  remove_stale_plots(result, out);
  const std::vector<Wanted> wanted = wanted_of(result, out, replays);
  if (wanted.empty()) return true;
  const std::string command = fs::read_symlink("/proc/self/exe").string();
  std::vector<playerlike::ProgramJob> processes;
  for (const auto& [folder, product] : wanted) {
    playerlike::ProgramJob process;
    process.command = {command, product->command, folder.string(), product->option,
                       (folder / product->file).string()};
    process.output_file = "/dev/null";
    processes.push_back(std::move(process));
  }
  playerlike::JobLimits limits;
  limits.at_once = jobs;
  limits.timeout_s = kPlotTimeout_s;
  std::size_t ended = 0;
  if (on_progress) on_progress(ended, wanted.size());
  const std::vector<playerlike::JobEnd> ends = playerlike::run_programs(
      processes, limits, {}, [&](std::size_t index, const playerlike::JobEnd& end) {
        if (end.kind != playerlike::JobEnd::Kind::kEnded || !end.program.success()) {
          std::error_code ignored;
          const fs::path file = wanted[index].folder / wanted[index].product->file;
          fs::remove(sim::part_file_name(file.string()), ignored);
        }
        if (on_progress) on_progress(++ended, wanted.size());
      });
  return std::all_of(ends.begin(), ends.end(), [](const playerlike::JobEnd& end) {
    return end.kind != playerlike::JobEnd::Kind::kInterrupted &&
           end.kind != playerlike::JobEnd::Kind::kNotStarted;
  });
}

}  // namespace playpen
