// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "diff/difference_text.h"
#include "diff/run_difference.h"
#include "sim/core/number_text.h"

namespace playpen::diff {
namespace {

using playerlike::Report;
using playerlike::RunEnd;

// Two numbers with `decimals` digits, or with more if they differ, but would look the same.
Figure number_figure(std::string name, const std::optional<double>& first,
                     const std::optional<double>& second, int decimals) {
  constexpr int kMostDecimals = 12;
  Figure figure{{std::move(name), "-", "-"}, first != second};
  for (int digits = decimals; digits <= kMostDecimals; ++digits) {
    if (first) figure.values.first = number_text(*first, digits);
    if (second) figure.values.second = number_text(*second, digits);
    if (!figure.differs || figure.values.first != figure.values.second) return figure;
  }
  figure.values.first = sim::shortest_text(*first);
  figure.values.second = sim::shortest_text(*second);
  return figure;
}

Figure text_figure(std::string name, std::string first, std::string second) {
  const bool differs = first != second;
  return {{std::move(name), std::move(first), std::move(second)}, differs};
}

std::string end_text(const Report& report) {
  if (!report.ended) return "not ended";
  const RunEnd& end = *report.ended;
  switch (end.by) {
    case RunEnd::By::kDuration:
      return "time over";
    case RunEnd::By::kVerdict:
      return "verdict";
    case RunEnd::By::kProgram:
      return end.status ? "program ended, status " + std::to_string(*end.status) : "program ended";
    case RunEnd::By::kRequest:
      return "stopped" + (end.signal ? " by " + *end.signal : "");
    case RunEnd::By::kWindow:
      return "window closed";
    case RunEnd::By::kSignal:
      return "program killed" + (end.signal ? " by " + *end.signal : "");
    case RunEnd::By::kRealRobot:
      return "real robot lost";
  }
  return "unknown";
}

std::string verdict_text(const Report& report) {
  if (!report.verdict) return "-";
  return std::string(report.verdict->passed ? "passed" : "failed") +
         (report.verdict->reason.empty() ? "" : ": " + report.verdict->reason);
}

std::string judgement_text(const std::optional<bool>& passed) {
  if (!passed) return "not graded";
  return *passed ? "passed" : "failed";
}

FigureGroup figures_of_runs(const ComparedRun& first_run, const ComparedRun& second_run) {
  const Report& first = first_run.report;
  const Report& second = second_run.report;
  FigureGroup group;
  if (first_run.passed || second_run.passed) {
    Figure figure =
        text_figure("grade", judgement_text(first_run.passed), judgement_text(second_run.passed));
    // Whether somebody has graded a run does not change it.
    figure.differs = figure.differs && first_run.passed && second_run.passed;
    group.figures.push_back(std::move(figure));
  }
  group.figures.push_back(
      number_figure("simulated time [s]", first.run.sim_time_s, second.run.sim_time_s, 1));
  group.figures.push_back(text_figure("end", end_text(first), end_text(second)));
  if (first.verdict || second.verdict) {
    group.figures.push_back(text_figure("verdict", verdict_text(first), verdict_text(second)));
  }
  if (!first.run.state_hash && !second.run.state_hash) return group;
  group.figures.push_back(text_figure("hash of the final state", first.run.state_hash.value_or("-"),
                                      second.run.state_hash.value_or("-")));
  return group;
}

const Report::Robot* robot_of(const Report& report, const std::string& name) {
  const auto found =
      std::find_if(report.robots.begin(), report.robots.end(),
                   [&name](const Report::Robot& robot) { return robot.name == name; });
  return found == report.robots.end() ? nullptr : &*found;
}

// The first collision of a robot; null: there was none.
const Report::Collision* collision_of(const Report& report, const std::string& robot) {
  const auto found = std::find_if(
      report.collisions.begin(), report.collisions.end(),
      [&robot](const Report::Collision& collision) { return collision.robot == robot; });
  return found == report.collisions.end() ? nullptr : &*found;
}

// "1 of 2" goals reached; "-" if the robot had none.
std::string goals_text(const ComparedRun& run, const std::string& robot) {
  std::size_t all = 0;
  std::size_t reached = 0;
  for (const sim::GoalMark& goal : run.goals) {
    const auto index = static_cast<std::size_t>(goal.robot);
    if (index >= run.trajectories.size() || run.trajectories[index]->robot != robot) continue;
    ++all;
    if (goal.reached) ++reached;
  }
  return all == 0 ? "-" : std::to_string(reached) + " of " + std::to_string(all);
}

std::optional<double> points_of(const Report& report, const std::string& robot) {
  if (!report.scores) return std::nullopt;
  for (const Report::Score& score : *report.scores) {
    if (score.robot == robot) return score.points;
  }
  return std::nullopt;
}

void add_first_collision(const Report& first, const Report& second, FigureGroup& group) {
  const Report::Collision* const a = collision_of(first, group.robot);
  const Report::Collision* const b = collision_of(second, group.robot);
  if (a == nullptr && b == nullptr) return;
  const auto add = [&](const char* name, const auto& value_of, int decimals) {
    const auto value = [&](const Report::Collision* collision) {
      return collision == nullptr ? std::optional<double>() : value_of(*collision);
    };
    group.figures.push_back(number_figure(name, value(a), value(b), decimals));
  };
  add(
      "first collision [s]", [](const Report::Collision& c) { return c.time_s; }, 3);
  add(
      "first collision, x [m]", [](const Report::Collision& c) { return c.place.x(); }, 3);
  add(
      "first collision, y [m]", [](const Report::Collision& c) { return c.place.y(); }, 3);
  group.figures.push_back(text_figure("first collision with", a == nullptr ? "-" : a->with,
                                      b == nullptr ? "-" : b->with));
}

FigureGroup figures_of_robot(const ComparedRun& first, const ComparedRun& second,
                             const std::string& robot) {
  const Report::Robot& a = *robot_of(first.report, robot);
  const Report::Robot& b = *robot_of(second.report, robot);
  FigureGroup group;
  group.robot = robot;
  const auto add = [&](const char* name, auto member, int decimals) {
    group.figures.push_back(number_figure(name, a.*member, b.*member, decimals));
  };
  add("path length [m]", &Report::Robot::path_length_m, 2);
  add("collisions", &Report::Robot::collisions, 0);
  add_first_collision(first.report, second.report, group);
  add("least clearance [m]", &Report::Robot::least_clearance_m, 3);
  add("stalled time [s]", &Report::Robot::stalled_time_s, 2);
  const std::string goals = goals_text(first, robot);
  const std::string other_goals = goals_text(second, robot);
  if (goals != "-" || other_goals != "-") {
    group.figures.push_back(text_figure("goals reached", goals, other_goals));
  }
  if (first.report.scores || second.report.scores) {
    group.figures.push_back(number_figure("points", points_of(first.report, robot),
                                          points_of(second.report, robot), 1));
  }
  return group;
}

}  // namespace

std::vector<FigureGroup> figures_of(const ComparedRun& first, const ComparedRun& second) {
  std::vector<FigureGroup> groups = {figures_of_runs(first, second)};
  for (const Report::Robot& robot : first.report.robots) {
    if (robot_of(second.report, robot.name) == nullptr) continue;
    groups.push_back(figures_of_robot(first, second, robot.name));
  }
  return groups;
}

}  // namespace playpen::diff
