// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grade/evaluation.h"
#include "grade/grade.h"
#include "grade/report.h"
#include "grade/task.h"
#include "playerlike/host/kept_results.h"
#include "playerlike/host/program.h"
#include "sim/world/description.h"

namespace playpen::grade {

/// A task with its worlds loaded and its reference values computed, for runs of any program.
class PreparedTask {
 public:
  /// @throws sim::ConfigError for a world that can't be used or does not match the task.
  explicit PreparedTask(Task task);

  [[nodiscard]] const Task& task() const noexcept { return task_; }
  /// @param world  index of a world of the task.
  [[nodiscard]] const sim::WorldDescription& description(std::size_t world) const {
    return references_.at(world).description;
  }
  [[nodiscard]] const Reference& reference(std::size_t world) const {
    return references_.at(world);
  }

 private:
  Task task_;
  std::vector<Reference> references_;
};

/// The folder in which programs run, separate from the results. The grader moves a program's output
/// out of it before grading.
class WorkFolder {
 public:
  /// Makes the folder .running-N in a folder, and removes those of graders that were killed.
  explicit WorkFolder(const std::filesystem::path& out);
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// The runs of a program on a task: prepares them, and judges them when they have ended.
class ProgramRuns {
 public:
  /// Says the grade of a run that needs not be run again.
  using Known = std::function<std::optional<GradedRun>(const GradedRun& prepared)>;

  /// @param task      must outlive this object, as the settings and the result.
  /// @param settings  of the program; their task is not looked at.
  /// @param result    gets all runs: worlds in the order of the task, and their seeds.
  /// @param known     called for each run with its world, seed, folder and settings, if set.
  /// @throws std::exception if an output folder can't be prepared.
  ProgramRuns(const PreparedTask& task, const GradeSettings& settings, Grade& result,
              const Known& known = {});

  /// The runs that are not known, to be started in any order.
  [[nodiscard]] const std::vector<playerlike::ProgramJob>& jobs() const noexcept { return jobs_; }

  /// Judges a run whose processes have all ended. Those of other runs may still change files, so
  /// this must be done before anything else.
  /// @param job  index of its job.
  /// @return the run.
  const GradedRun& judge(std::size_t job, const playerlike::JobEnd& end);
  /// Judges a run that was not started.
  void judge_unstarted(std::size_t job, const playerlike::JobEnd& end);

 private:
  void prepare(std::size_t world, std::uint64_t seed, const Known& known);

  const PreparedTask& task_;
  const GradeSettings& settings_;
  Grade& result_;
  const std::filesystem::path out_;
  WorkFolder work_;
  std::vector<playerlike::ProgramJob> jobs_;
  std::vector<std::size_t> run_of_;                         ///< by job
  std::vector<std::size_t> world_of_;                       ///< by job
  std::vector<std::unique_ptr<playerlike::KeptRun>> kept_;  ///< by job; null unless it runs
};

}  // namespace playpen::grade
