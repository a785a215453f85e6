// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/report_summary.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "playerlike/host/report.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

/// A column of numbers. Its heading names the unit and sets its width.
struct Column {
  const char* heading;
  std::optional<double> (*value)(const Report::Robot& robot);
  int decimals;
};

constexpr Column kColumns[] = {
    {"path [m]", [](const Report::Robot& r) { return std::optional(r.path_length_m); }, 2},
    {"collisions", [](const Report::Robot& r) { return std::optional<double>(r.collisions); }, 0},
    {"least clearance [m]", [](const Report::Robot& r) { return r.least_clearance_m; }, 3},
    {"stalled [s]", [](const Report::Robot& r) { return std::optional(r.stalled_time_s); }, 2},
};

int width_of(const Column& column) {
  return static_cast<int>(std::string(column.heading).size()) + 2;
}

// Returns a line for each robot that stalled for more than half of its driven time.
std::string stall_advice(const Report& report) {
  constexpr double kMost = 0.5;
  constexpr double kLeastDriven_s = 1.0;  // shorter times are not significant
  std::string advice;
  for (const Report::Robot& robot : report.robots) {
    const double driven_s = robot.driven_time_s.value_or(0.0);
    if (driven_s < kLeastDriven_s || robot.stalled_time_s <= kMost * driven_s) continue;
    advice +=
        robot.name + " was stalled for " +
        sim::fixed_text(100.0 * std::min(robot.stalled_time_s / driven_s, 1.0), 0) +
        " % of the time that it drove: 'playpen doc which_world' names the world that suits a "
        "program\n";
  }
  return advice;
}

// Returns the scores and the verdict of the arena controller, or why there is none.
std::string arena_summary(const Report& report) {
  if (!report.scores) return "";
  std::string text;
  std::vector<Report::Score> scores = *report.scores;
  std::ranges::sort(scores, {}, &Report::Score::robot);
  for (const Report::Score& score : scores) {
    text += text.empty() ? "scores: " : ", ";
    text += score.robot + ' ' + sim::shortest_text(score.points);
  }
  if (!text.empty()) text += '\n';
  if (!report.verdict) return text + "verdict: none\n";
  const Report::Verdict& verdict = *report.verdict;
  text += verdict.passed ? "verdict: passed" : "verdict: failed";
  text += " after " + sim::fixed_text(verdict.time_s, 2) + " s";
  if (!verdict.reason.empty()) text += ": " + verdict.reason;
  return text + '\n';
}

Report read_report(const std::string& file) {
  std::string text;
  if (const auto problem = sim::read_whole_file(file, {}, text)) {
    throw std::runtime_error("the report " + file + " can't be read: " + problem->found);
  }
  try {
    return report_from(text);
  } catch (const std::exception& error) {
    throw std::runtime_error("the report " + file + " is not as expected: " + error.what());
  }
}

}  // namespace

std::string summarize_report(const std::string& file) {
  const Report report = read_report(file);
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(1) << report.run.sim_time_s << " s simulated in "
      << std::setprecision(3) << report.run.wall_time_s << " s: " << std::setprecision(1)
      << report.run.real_time_factor << " times real time (seed " << report.run.seed;
  if (report.run.realism != "course") out << ", realism " << report.run.realism;
  out << ")\n";
  if (report.run.repeatable_why) {
    out << "another run may differ:\n";
    for (const std::string& why : *report.run.repeatable_why) out << "  " << why << '\n';
  }

  std::size_t name_width = std::string("robot").size();
  for (const Report::Robot& robot : report.robots) {
    name_width = std::max(name_width, robot.name.size());
  }
  const int name_column = static_cast<int>(name_width);
  out << "  " << std::left << std::setw(name_column) << "robot" << std::right;
  for (const Column& column : kColumns) out << std::setw(width_of(column)) << column.heading;
  out << '\n';
  for (const Report::Robot& robot : report.robots) {
    out << "  " << std::left << std::setw(name_column) << robot.name << std::right;
    for (const Column& column : kColumns) {
      out << std::setw(width_of(column)) << std::setprecision(column.decimals);
      if (const std::optional<double> value = column.value(robot)) {
        out << *value;
      } else {
        out << '-';
      }
    }
    out << '\n';
  }
  return out.str() + arena_summary(report) + stall_advice(report);
}

double simulated_time_of_report(const std::string& file) {
  return read_report(file).run.sim_time_s;
}

}  // namespace playerlike
