// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/class_likeness.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "course/build.h"
#include "course/likeness.h"
#include "course/likeness_picture.h"
#include "course/results.h"
#include "course/source_export.h"
#include "grade/text.h"
#include "grade/trajectory.h"
#include "sim/simulation/simulation.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

/// A run that all programs of a class have.
struct CommonRun {
  const grade::Task* task = nullptr;
  const grade::TaskWorld* world = nullptr;
  std::uint64_t seed = 0;

  [[nodiscard]] std::string world_name() const { return grade::world_name(world->file); }
};

std::vector<CommonRun> runs_of(const ClassResult& result) {
  std::vector<CommonRun> runs;
  for (const grade::Task& task : result.tasks) {
    for (const grade::TaskWorld& world : task.worlds) {
      for (const std::uint64_t seed : task.seeds) runs.push_back({&task, &world, seed});
    }
  }
  return runs;
}

/// The drive of the graded robot; empty if there is none.
Drive drive_of(const grade::GradedRun& run, const fs::path& folder) {
  Drive drive;
  try {
    for (grade::Trajectory& one : grade::read_trajectories(folder / "trajectory.csv")) {
      if (one.robot != run.robot) continue;
      drive.time_s = std::move(one.time_s);
      drive.X_WB = std::move(one.X_WB);
    }
  } catch (const std::exception&) {
    // A program that never connected leaves no trajectory.
  }
  return drive;
}

/// In the order of runs_of(), which is that of the grades.
ProgramDrives drives_of(const SubmissionResult& submission, std::size_t runs,
                        const fs::path& folder) {
  ProgramDrives drives;
  for (const grade::Grade& grade : submission.grades) {
    for (const grade::GradedRun& run : grade.runs) {
      drives.push_back(drive_of(run, folder / submission.folder / grade.task.name / run.folder));
    }
  }
  drives.resize(runs);
  return drives;
}

void export_all_sources(const ClassResult& result, const fs::path& folder) {
  std::vector<SourceFolder> folders;
  for (const SubmissionResult& one : result.submissions) {
    if (!one.handed_in) continue;
    folders.push_back(
        {fs::path(one.folder).filename().string(), source_folder(folder / one.folder)});
  }
  std::error_code ignored;
  fs::remove_all(folder / "sources", ignored);
  export_sources(folders, folder / "sources");
}

}  // namespace

void compare_submissions(ClassResult& result, const fs::path& folder) {
  const std::vector<CommonRun> runs = runs_of(result);
  std::vector<std::string> worlds;
  for (const CommonRun& run : runs) worlds.push_back(run.world_name());
  std::vector<ProgramDrives> programs;
  for (const SubmissionResult& one : result.submissions) {
    programs.push_back(drives_of(one, runs.size(), folder));
  }
  std::vector<ProgramDrives> baselines;
  for (const SubmissionResult& one : result.baselines) {
    baselines.push_back(drives_of(one, runs.size(), folder));
  }
  std::error_code ignored;
  fs::remove_all(folder / "pairs", ignored);
  result.pairs.clear();
  for (const Likeness& likeness : find_alike(worlds, programs, baselines)) {
    const SubmissionResult& first = result.submissions[likeness.first];
    const SubmissionResult& second = result.submissions[likeness.second];
    LikePair pair;
    pair.first = likeness.first;
    pair.second = likeness.second;
    pair.runs = likeness.runs;
    pair.alike = likeness.alike;
    pair.distance_m = likeness.distance_m;
    pair.likeness = likeness.likeness;
    pair.threshold = likeness.threshold;
    pair.shared_m = likeness.shared_m;
    if (result.pairs.size() >= kMostDrawnPairs) {
      result.pairs.push_back(std::move(pair));
      continue;
    }
    pair.picture = "pairs/" + fs::path(first.folder).filename().string() + "-" +
                   fs::path(second.folder).filename().string() + ".svg";
    const CommonRun& run = runs[likeness.run];
    const sim::WorldDescription world = sim::load_world(run.world->file);
    const PairPicture picture{plain_text(first.id),
                              plain_text(second.id),
                              run.world_name() + ", seed " + std::to_string(run.seed),
                              world.arena,
                              programs[likeness.first][likeness.run],
                              programs[likeness.second][likeness.run],
                              likeness.parted_s};
    grade::write_text_file(folder / pair.picture, pair_picture(picture).svg());
    result.pairs.push_back(std::move(pair));
  }
  export_all_sources(result, folder);
}

}  // namespace playpen::course
