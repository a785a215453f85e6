// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/grade.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "grade/runs.h"
#include "playerlike/host/program.h"
#include "sim/core/error.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;

bool same_world(const std::string& a, const std::string& b) {
  if (a == b) return true;
  std::error_code error;
  return !a.empty() && !b.empty() && fs::equivalent(a, b, error);
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
  Grade result{settings.task, settings.program, {}, !settings.launcher.empty()};
  const PreparedTask task(settings.task);
  ProgramRuns runs(task, settings, result);
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
