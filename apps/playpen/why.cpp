// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "grade/text.h"
#include "playerlike/host/rerun.h"
#include "plot_data.h"
#include "sim/core/number_text.h"
#include "sim/render/render.h"
#include "terminal.h"
#include "why/reasons.h"
#include "why/reasons_json.h"
#include "why/story.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

// The robot that a run is explained for: the one that the user names, the one with the goal of a
// task, the first one that was commanded, or the first one.
// @throws std::runtime_error if there is no robot of that name.
std::size_t robot_of(const RunData& run, const std::string& name) {
  const auto& robots = run.report.robots;
  if (!name.empty()) {
    const auto named = std::find_if(robots.begin(), robots.end(),
                                    [&name](const auto& robot) { return robot.name == name; });
    if (named != robots.end()) return static_cast<std::size_t>(named - robots.begin());
    std::string all;
    for (const auto& robot : robots) all += (all.empty() ? "" : ", ") + robot.name;
    throw std::runtime_error("--robot: expected a robot of the run (" + all + "), found '" + name +
                             "'");
  }
  if (run.passed && !run.goals.empty()) return static_cast<std::size_t>(run.goals.back().robot);
  const auto commanded = std::find_if(
      robots.begin(), robots.end(), [](const auto& robot) { return robot.commanded.has_value(); });
  return commanded == robots.end() ? 0 : static_cast<std::size_t>(commanded - robots.begin());
}

why::RunFacts facts_of(const RunData& run, std::size_t robot,
                       const sim::SimulationDescription& settings) {
  why::RunFacts facts;
  for (const sim::GoalMark& goal : run.goals) {
    if (goal.robot != static_cast<int>(robot) || !goal.newest) continue;
    facts.goal = goal.place;
    facts.goal_reached = goal.reached;
  }
  if (settings.duration_ns) facts.duration_s = sim::to_seconds(*settings.duration_ns);
  if (const auto& ended = run.report.ended) {
    facts.ended_by_program = ended->by == playerlike::RunEnd::By::kProgram;
    if (ended->by == playerlike::RunEnd::By::kSignal) facts.signal = ended->signal;
  }
  facts.passed = run.passed.value_or(false);
  facts.faults = run.faults;
  if (const auto& seen = run.report.robots[robot].seen) facts.seen_area_m2 = seen->area_m2;
  if (run.report.refused) {
    for (const auto& refusal : *run.report.refused) {
      facts.refused.emplace_back(refusal.time_s, refusal.what);
    }
  }
  return facts;
}

// Draws the scene at a moment. @return the file.
std::string draw_moment(const std::string& folder, const WhyRequest& request,
                        const std::string& robot, double time_s) {
  constexpr double kWholeArena_m = 6.0;  // of a larger one, the surroundings are drawn
  playerlike::Rerun rerun(folder);
  const sim::SceneSnapshot scene = why::scene_at(rerun, time_s);
  sim::render::RenderOptions options;
  if (scene.arena.size.maxCoeff() > kWholeArena_m) {
    options.follow = robot;
    options.follow_width_m = kWholeArena_m;
  }
  std::string file = request.file.empty() ? (fs::path(folder) / "why.png").string() : request.file;
  sim::render::write_png(sim::render::draw_scene(scene, options), file);
  return file;
}

// @param most  how many of them.
void print_reasons(const std::vector<why::Reason>& reasons, std::size_t most) {
  const std::size_t width = terminal_columns(STDOUT_FILENO);
  for (std::size_t i = 0; i < std::min(reasons.size(), most); ++i) {
    std::string words;
    for (const std::string& sentence : reasons[i].text) {
      words += (words.empty() ? "" : " ") + sentence;
    }
    std::cout << wrapped(std::to_string(i + 1) + ". " + grade::plain_text(words), width, 3) << '\n';
  }
}

// Explains one run.
// @param most  prints so many reasons.
why::ExplainedRun explain_run(const std::string& folder, const WhyRequest& request,
                              std::size_t most) {
  const RunData run = read_run(folder);
  playerlike::Rerun rerun(folder);
  const std::size_t robot = robot_of(run, request.robot);
  const std::string& name = run.report.robots[robot].name;
  const auto index = rerun.simulation().find_robot(name);
  if (!index) {
    throw std::runtime_error("the recording in '" + folder + "' has no robot " + name +
                             ", but its report has");
  }
  const why::Story story = why::story_of(rerun, *index);
  why::ExplainedRun explained{
      folder, name, story.samples.back().time_s, story.complete, run.passed, run.faults, {}};
  explained.reasons =
      why::reasons_of(story, facts_of(run, robot, rerun.simulation().world().simulation));
  const std::vector<why::Reason>& reasons = explained.reasons;
  std::cout << "run: " << folder << "\nrobot " << name << ": ";
  if (run.passed) {
    std::cout << (*run.passed ? "passed" : "failed");
    for (const std::string& fault : run.faults) std::cout << "; " << grade::plain_text(fault);
    std::cout << '\n';
  } else {
    std::cout << sim::fixed_text(story.samples.back().time_s, 1) << " s of simulated time\n";
  }
  if (!story.complete) {
    std::cout
        << "The recording ends before the run did, so the last tenth of a second is missing.\n";
  }
  if (reasons.empty()) {
    std::cout << "Nothing went wrong: no contact, no stall, no turning on the spot.\n";
    return explained;
  }
  print_reasons(reasons, most);
  const double moment_s = reasons.front().time_s;
  const std::string time = sim::fixed_text(moment_s, 1);
  std::cout << "picture after " << time << " s: " << draw_moment(folder, request, name, moment_s)
            << "\nsee it: playpen replay " << grade::shell_word(folder) << " --at " << time << '\n';
  return explained;
}

void write_json(const WhyRequest& request, const std::vector<why::ExplainedRun>& runs) {
  if (request.json_file.empty()) return;
  grade::write_text_file(request.json_file, why::reasons_json(runs));
}

}  // namespace

int explain(const WhyRequest& request) {
  std::vector<std::string> skipped;
  std::vector<std::string> folders = run_folders(request.folder, skipped);
  if (folders.size() > 1) {
    std::vector<std::string> failed;
    for (const std::string& folder : folders) {
      if (!read_run(folder).passed.value_or(false)) failed.push_back(folder);
    }
    if (failed.empty()) {
      write_json(request, {});
      std::cout << "All " << folders.size() << " runs have passed.\n";
      return kOk;
    }
    if (!request.file.empty() && failed.size() > 1) {
      throw std::runtime_error("--out: expected one run, found " + std::to_string(failed.size()) +
                               " runs that failed in '" + request.folder +
                               "'; name the folder of one");
    }
    folders = std::move(failed);
  }
  std::vector<why::ExplainedRun> explained;
  for (const std::string& folder : folders) {
    if (&folder != folders.data()) std::cout << '\n';
    // Runs of one program mostly fail alike.
    constexpr std::size_t kMost = 6;
    explained.push_back(explain_run(folder, request, &folder == folders.data() ? kMost : 1));
  }
  write_json(request, explained);
  return kOk;
}

}  // namespace playpen
