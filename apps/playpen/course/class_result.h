// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "grade/report.h"
#include "grade/task.h"

/// The implementation of `playpen class`, without argument parsing.
namespace playpen::course {

/// What became of the sources of a submission.
struct Build {
  bool built = false;
  std::string reason;   ///< why there is no program, for people; "": there is one
  std::string program;  ///< path of the program in the folder of the submission; "": none
  std::string log;      ///< path of what the compiler printed there; "": nothing was compiled
  double wall_time_s = 0.0;
};

/// What one person has handed in, and how it was graded.
struct SubmissionResult {
  std::string id;         ///< from the roster, or the name of the submission's folder or archive
  std::string name;       ///< of the person, from the roster; "": unknown
  std::string folder;     ///< of all its files, in the output folder: "submissions/ID"
  bool handed_in = true;  ///< false: the roster has this person, but there is no submission
  Build build;
  /// One per task. The folder of a run is relative to the folder of the submission and of the task:
  /// OUT/FOLDER/TASK/RUN. Without a program there are no runs.
  std::vector<grade::Grade> grades;
  double points = 0.0;       ///< of all tasks together
  double most_points = 0.0;  ///< what can be had without bonuses
  std::string note;          ///< conditions of this person's own; "": those of all

  [[nodiscard]] std::size_t passed() const noexcept {
    std::size_t count = 0;
    for (const grade::Grade& grade : grades) count += grade.passed();
    return count;
  }
  [[nodiscard]] std::size_t runs() const noexcept {
    std::size_t count = 0;
    for (const grade::Grade& grade : grades) count += grade.runs.size();
    return count;
  }
};

/// Two submissions whose robots drove the same way.
struct LikePair {
  std::size_t first = 0;    ///< index of a submission
  std::size_t second = 0;   ///< index of another one, > first
  std::size_t runs = 0;     ///< runs that were compared
  std::size_t alike = 0;    ///< runs whose trajectories are alike
  double distance_m = 0.0;  ///< mean, until they part, in the run that is most alike [m]
  std::string picture;      ///< path in the output folder; "": none
  double likeness = 0.0;    ///< mean of the runs (docs/decisions/likeness.md) [sqrt(m rad)]
  double threshold = 0.0;   ///< the least likeness of a pair that is listed
  double shared_m = 0.0;    ///< how far both drive together in the run that is most alike [m]
};

/// A graded class.
struct ClassResult {
  std::vector<grade::Task> tasks;
  std::vector<SubmissionResult> submissions;  ///< ordered by id
  std::vector<LikePair> pairs;                ///< the most alike first
  /// Programs that everybody knows: what submissions do like them is no likeness.
  std::vector<SubmissionResult> baselines;
  bool isolated = true;
  bool complete = true;  ///< false: this process was told to stop before the end
};

}  // namespace playpen::course
