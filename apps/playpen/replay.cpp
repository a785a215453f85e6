// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "course/html_report.h"
#include "course/html_text.h"
#include "grade/text.h"
#include "playerlike/host/rerun.h"
#include "plot_data.h"
#include "replay/replay_page.h"
#include "replay/run_mcap.h"
#include "replay/run_replay.h"
#include "sim/core/number_text.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

// The goals of a task, which no device has.
std::vector<playerlike::replay::GoalNote> goals_of(const RunData& run) {
  std::vector<playerlike::replay::GoalNote> goals;
  if (!run.passed || run.goals.size() <= run.report.goals.size()) return goals;
  for (std::size_t i = run.report.goals.size(); i < run.goals.size(); ++i) {
    playerlike::replay::GoalNote note;
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

// The last part of a folder's name: the page may be for others.
std::string page_name_of(const std::string& folder) {
  return fs::absolute(fs::path(folder) / "").parent_path().filename().string();
}

playerlike::replay::ReplayRun replay_of_folder(const std::string& folder) {
  const RunData run = read_run(folder);
  playerlike::Rerun rerun(folder);
  return replay::replay_of(rerun, folder, page_name_of(folder), goals_of(run));
}

void write_page_of(const std::vector<playerlike::replay::ReplayRun>& runs, const std::string& file,
                   double most_megabytes) {
  replay::PageOptions options;
  options.most_bytes = static_cast<std::size_t>(most_megabytes * 1e6);
  grade::write_text_file(file, replay::html(runs, options));
}

void tell_address(const std::string& file, const ReplayRequest& request) {
  std::string fragment;
  if (request.time_s) fragment = "#t=" + sim::shortest_text(*request.time_s);
  if (!request.robot.empty()) {
    fragment += (fragment.empty() ? "#robot=" : "&robot=") + course::url_of(request.robot);
  }
  std::cout << "replay: " << file << "\nopen it: file://"
            << course::url_of(fs::absolute(file).string()) << fragment << '\n';
}

// The folders of the runs that one page shows, or of several runs with a page each.
std::vector<std::string> folders_of(const ReplayRequest& request) {
  std::vector<std::string> skipped;
  std::vector<std::string> folders = run_folders(request.first, skipped);
  if (!request.second.empty()) {
    const std::vector<std::string> others = run_folders(request.second, skipped);
    if (folders.size() > 1 || others.size() > 1) {
      throw std::runtime_error("expected the folders of two runs, found a grade of several in '" +
                               (folders.size() > 1 ? request.first : request.second) + "'");
    }
    folders.push_back(others.front());
  } else if (folders.size() > 1 && !request.file.empty()) {
    throw std::runtime_error("--html: expected one run, found " + std::to_string(folders.size()) +
                             " runs in '" + request.first +
                             "'; name the folder of one, or leave out --html");
  }
  return folders;
}

}  // namespace

std::string write_replay(const std::string& folder, const std::string& file,
                         double most_megabytes) {
  std::vector<playerlike::replay::ReplayRun> runs;
  runs.push_back(replay_of_folder(folder));
  std::string page = file.empty() ? (fs::path(folder) / course::kReplayFile).string() : file;
  write_page_of(runs, page, most_megabytes);
  return page;
}

int make_replay(const ReplayRequest& request) {
  if (!request.mcap_file.empty()) {
    std::vector<std::string> skipped;
    const std::vector<std::string> runs = run_folders(request.first, skipped);
    if (runs.size() > 1) {
      throw std::runtime_error("--mcap: expected one run, found " + std::to_string(runs.size()) +
                               " runs in '" + request.first + "'; name the folder of one");
    }
    playerlike::Rerun rerun(runs.front());
    replay::write_mcap(rerun, request.mcap_file);
    std::cout << "MCAP file: " << request.mcap_file << '\n';
    return kOk;
  }
  const std::vector<std::string> folders = folders_of(request);
  if (request.second.empty()) {
    for (const std::string& folder : folders) {
      tell_address(write_replay(folder, request.file, request.most_megabytes), request);
    }
    return kOk;
  }
  std::vector<playerlike::replay::ReplayRun> runs;
  for (const std::string& folder : folders) runs.push_back(replay_of_folder(folder));
  if (runs.front().name == runs.back().name) {
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i].name = folders[i];
  }
  const std::string page = request.file.empty()
                               ? (fs::path(folders.front()) / course::kReplayFile).string()
                               : request.file;
  write_page_of(runs, page, request.most_megabytes);
  tell_address(page, request);
  return kOk;
}

}  // namespace playpen
