// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "course/html_text.h"
#include "grade/text.h"
#include "playerlike/host/rerun.h"
#include "plot_data.h"
#include "replay/replay_page.h"
#include "replay/run_replay.h"
#include "sim/core/number_text.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

// The goals of a task, which no device has.
std::vector<replay::GoalNote> goals_of(const RunData& run) {
  std::vector<replay::GoalNote> goals;
  if (!run.passed || run.goals.size() <= run.report.goals.size()) return goals;
  for (std::size_t i = run.report.goals.size(); i < run.goals.size(); ++i) {
    replay::GoalNote note;
    note.robot = run.goals[i].robot;
    note.place = run.goals[i].place;
    for (const Moment& reached : run.reached) {
      if (run.goals[i].reached && reached.robot == note.robot) {
        note.reached_ns = sim::from_seconds(reached.time_s);
      }
    }
    goals.push_back(note);
  }
  return goals;
}

replay::ReplayRun replay_of_folder(const std::string& folder) {
  const RunData run = read_run(folder);
  playerlike::Rerun rerun(folder);
  return replay::replay_of(rerun, folder, goals_of(run));
}

void write_replay(const std::vector<replay::ReplayRun>& runs, const std::string& file,
                  const ReplayRequest& request) {
  replay::PageOptions options;
  options.most_bytes = static_cast<std::size_t>(request.most_megabytes * 1e6);
  grade::write_text_file(file, replay::html(runs, options));
  std::cout << "replay: " << file << '\n';
  std::string fragment;
  if (request.time_s) fragment = "#t=" + sim::shortest_text(*request.time_s);
  if (!request.robot.empty()) {
    fragment += (fragment.empty() ? "#robot=" : "&robot=") + course::url_of(request.robot);
  }
  std::cout << "open it: file://" << course::url_of(fs::absolute(file).string()) << fragment
            << '\n';
}

}  // namespace

int make_replay(const ReplayRequest& request) {
  std::vector<std::string> skipped;
  std::vector<std::string> folders = run_folders(request.first, skipped);
  if (!request.second.empty()) {
    const std::vector<std::string> others = run_folders(request.second, skipped);
    if (folders.size() > 1 || others.size() > 1) {
      throw std::runtime_error("expected the folders of two runs, found a grade of several in '" +
                               (folders.size() > 1 ? request.first : request.second) + "'");
    }
    folders.push_back(others.front());
  }
  if (request.second.empty() && folders.size() > 1) {
    if (!request.file.empty()) {
      throw std::runtime_error("--html: expected one run, found " + std::to_string(folders.size()) +
                               " runs in '" + request.first +
                               "'; name the folder of one, or leave out --html");
    }
    for (const std::string& folder : folders) {
      std::vector<replay::ReplayRun> runs;
      runs.push_back(replay_of_folder(folder));
      write_replay(runs, (fs::path(folder) / kReplayFile).string(), request);
    }
    return kOk;
  }
  std::vector<replay::ReplayRun> runs;
  for (const std::string& folder : folders) runs.push_back(replay_of_folder(folder));
  write_replay(
      runs,
      request.file.empty() ? (fs::path(folders.front()) / kReplayFile).string() : request.file,
      request);
  return kOk;
}

}  // namespace playpen
