// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "diff/difference_text.h"
#include "diff/recorded_difference.h"
#include "diff/run_difference.h"
#include "diff_page.h"
#include "playerlike/host/rerun.h"
#include "plot_data.h"
#include "plot_parts.h"
#include "sim/simulation/world_hash.h"

namespace playpen {
namespace {

// The folders of two runs.
using FolderPair = std::pair<std::string, std::string>;

std::string last_name(const std::string& folder) {
  return std::filesystem::absolute(std::filesystem::path(folder) / "")
      .parent_path()
      .filename()
      .string();
}

void report_left_out(const std::string& folder, const std::string& reason) {
  std::cerr << "playpen: left out '" << folder << "': " << reason << '\n';
}

// Matches the runs of two folders. Runs of grades are matched by their names.
// @throws std::runtime_error if no runs match.
std::vector<FolderPair> matched_runs(const DiffRequest& request) {
  std::vector<std::string> skipped;
  const std::vector<std::string> first = run_folders(request.first, skipped);
  const std::vector<std::string> second = run_folders(request.second, skipped);
  for (const std::string& folder : skipped) report_left_out(folder, "the run has no results");
  if (first.size() == 1 && second.size() == 1) return {{first.front(), second.front()}};
  std::vector<FolderPair> pairs;
  std::vector<std::string> unmatched;
  std::vector<bool> found(second.size(), false);
  for (const std::string& folder : first) {
    const auto other = std::find_if(second.begin(), second.end(), [&folder](const auto& candidate) {
      return last_name(candidate) == last_name(folder);
    });
    if (other == second.end()) {
      unmatched.push_back(folder);
      continue;
    }
    found[static_cast<std::size_t>(other - second.begin())] = true;
    pairs.emplace_back(folder, *other);
  }
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (!found[i]) unmatched.push_back(second[i]);
  }
  if (pairs.empty()) {
    throw std::runtime_error("expected runs of the same name in '" + request.first + "' and '" +
                             request.second + "', found '" + last_name(first.front()) + "' (of " +
                             std::to_string(first.size()) + ") and '" + last_name(second.front()) +
                             "' (of " + std::to_string(second.size()) +
                             "); name the folders of two runs");
  }
  for (const std::string& folder : unmatched) {
    report_left_out(folder, "the other folder has no run of this name");
  }
  return pairs;
}

diff::ComparedRun compared(const RunData& run) {
  diff::ComparedRun result;
  result.report = run.report;
  for (const Track& track : run.tracks) result.trajectories.push_back(&track);
  result.goals = run.goals;
  result.passed = run.passed;
  result.faults = run.faults;
  if (run.world) result.world_hash = sim::world_hash(*run.world);
  return result;
}

// The first command and the first reading that differ, or why they are not known.
std::string recorded_text(const FolderPair& pair) {
  try {
    playerlike::Rerun first(pair.first);
    playerlike::Rerun second(pair.second);
    return diff::text_of(diff::recorded_difference(first, second));
  } catch (const playerlike::RecordingError& e) {
    return std::string("commands and readings are not compared: ") + e.what() + '\n';
  }
}

void draw_difference(const std::vector<RunData>& runs, const diff::RunDifference& difference,
                     const std::string& file) {
  if (!runs.front().world) {
    std::cerr << "playpen: no arena in the picture: " << runs.front().world_problem << '\n';
  }
  write_page(diff_page(runs, difference), file, "picture");
  std::cout << "picture: " << file << '\n';
}

}  // namespace

int compare_runs(const DiffRequest& request) {
  const std::vector<FolderPair> pairs = matched_runs(request);
  std::size_t differing = 0;
  // The first pair that differs, or the first pair.
  std::vector<RunData> drawn;
  diff::RunDifference drawn_difference;
  for (const FolderPair& pair : pairs) {
    std::vector<RunData> runs;
    runs.push_back(read_run(pair.first));
    runs.push_back(read_run(pair.second));
    const diff::ComparedRun first = compared(runs.front());
    const diff::ComparedRun second = compared(runs.back());
    diff::RunDifference difference = diff::difference_of(first, second);
    std::cout << (&pair == pairs.data() ? "" : "\n") << "run 1: " << pair.first
              << "\nrun 2: " << pair.second << '\n'
              << diff::text_of(difference, first, second);
    if (difference.trajectories_differ()) std::cout << recorded_text(pair);
    const bool differs = difference.any();
    if (drawn.empty() || (differs && differing == 0)) {
      drawn = std::move(runs);
      drawn_difference = std::move(difference);
    }
    if (differs) ++differing;
  }
  if (pairs.size() > 1) {
    std::cout << '\n' << differing << " of " << pairs.size() << " pairs of runs differ\n";
  }
  if (!request.file.empty()) draw_difference(drawn, drawn_difference, request.file);
  return differing == 0 ? kOk : kProgramFailed;
}

}  // namespace playpen
