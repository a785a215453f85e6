// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "diff/difference_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "grade/text.h"
#include "sim/core/number_text.h"

namespace playpen::diff {
namespace {

using Cells = std::vector<std::string>;

// Rows as lines. The first `left` columns are aligned to the left, the others to the right.
std::string lines_of(const std::vector<Cells>& rows, std::size_t left) {
  std::vector<std::size_t> widths;
  for (const Cells& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], grade::character_count(row[i]));
  }
  std::string text;
  for (const Cells& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - grade::character_count(row[i]), ' ');
      line += (i == 0 ? " " : "  ") + (i < left ? row[i] + blanks : blanks + row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + grade::plain_text(word);
  }
  return text;
}

std::string settings_text(const RunDifference& difference, const playerlike::Report& report) {
  if (difference.settings.empty()) {
    return "conditions: equal (world " + grade::plain_text(report.run.world) + ", seed " +
           std::to_string(report.run.seed) + ", realism " + grade::plain_text(report.run.realism) +
           ")\n";
  }
  std::string text = "conditions that differ:\n";
  std::vector<Cells> rows = {{"", "run 1", "run 2"}};
  for (const Pair& pair : difference.settings) {
    rows.push_back({pair.name, grade::plain_text(pair.first), grade::plain_text(pair.second)});
  }
  return text + lines_of(rows, 3);
}

std::string unit_of(const std::string& value) {
  if (value == "yaw") return " rad";
  if (value == "v") return " m/s";
  if (value == "omega") return " rad/s";
  return " m";
}

std::string first_text(const RunDifference& difference) {
  std::string text;
  if (const auto& first = difference.first) {
    text = "first difference: at " + number_text(first->time_s, 3) + " s, " +
           grade::plain_text(first->robot) + ", ";
    if (first->value.empty()) {
      text += std::string("a row that only run ") + (first->in_first ? "1" : "2") + " has";
    } else {
      constexpr int kDecimals = 6;  // of trajectory.csv
      const std::string unit = unit_of(first->value);
      std::string a = number_text(first->first, kDecimals);
      std::string b = number_text(first->second, kDecimals);
      if (a == b) {
        a = sim::shortest_text(first->first);
        b = sim::shortest_text(first->second);
      }
      text += first->value + ": " + a + unit + " in run 1, " + b + unit + " in run 2";
    }
    text += '\n';
  } else if (!difference.robots.empty()) {
    text = "trajectories: equal\n";
  }
  if (!difference.only_first.empty()) {
    text += "only in run 1: " + listed(difference.only_first) + '\n';
  }
  if (!difference.only_second.empty()) {
    text += "only in run 2: " + listed(difference.only_second) + '\n';
  }
  return text;
}

// Up to which time the trajectories of a robot were compared, if they are not of the same length.
std::string length_text(const RobotDifference& robot) {
  std::string text;
  const std::string name = grade::plain_text(robot.robot);
  if (robot.time_s.empty()) return name + ": not compared, the runs have no time in common\n";
  if (robot.first_end_s != robot.second_end_s) {
    const bool first_ends = robot.first_end_s < robot.second_end_s;
    text += name + ": compared up to " +
            number_text(std::min(robot.first_end_s, robot.second_end_s), 3) + " s, where run " +
            (first_ends ? "1" : "2") + " ends; run " + (first_ends ? "2" : "1") +
            " goes on until " + number_text(std::max(robot.first_end_s, robot.second_end_s), 3) +
            " s\n";
  }
  if (robot.unmatched > 0) {
    text += name + ": " + std::to_string(robot.unmatched) +
            (robot.unmatched == 1 ? " row has a time" : " rows have times") +
            " that the other run has no row of\n";
  }
  return text;
}

std::string place_text(const sim::Pose& X_WB) {
  return "(" + number_text(X_WB.x_m, 3) + ", " + number_text(X_WB.y_m, 3) + ")";
}

std::string heading_text(const sim::Pose& X_WB) {
  constexpr double kDegrees = 57.29577951308232;
  return number_text(sim::normalize_angle(X_WB.yaw_rad) * kDegrees, 1) + "°";
}

// One line for each limit: when it was exceeded first.
template <std::size_t kCount, typename Name, typename Value>
void add_partings(const std::array<double, kCount>& limits, const std::vector<Parting>& partings,
                  const Name& name_of, const Value& value_of, const std::string& robot,
                  std::vector<Cells>& rows) {
  for (std::size_t i = 0; i < kCount; ++i) {
    Cells row = {robot, name_of(limits.at(i))};
    if (i < partings.size()) {
      const Parting& parting = partings[i];
      row.insert(row.end(), {number_text(parting.time_s, 3), value_of(parting.first),
                             value_of(parting.second)});
    } else {
      row.emplace_back("never");
    }
    rows.push_back(std::move(row));
  }
}

std::string parting_text(const RunDifference& difference) {
  std::vector<Cells> rows = {{"robot", "apart by more than", "at [s]", "run 1", "run 2"}};
  std::string notes;
  std::string lengths;
  for (const RobotDifference& robot : difference.robots) {
    lengths += length_text(robot);
    if (robot.time_s.empty()) continue;
    const std::string name = grade::plain_text(robot.robot);
    if (robot.greatest.distance_m == 0.0 && robot.headings.empty()) continue;
    add_partings(kDistances_m, robot.distances, distance_text, place_text, name, rows);
    add_partings(
        kHeadings_deg, robot.headings,
        [](double limit) { return sim::shortest_text(limit) + "° of heading"; }, heading_text, name,
        rows);
    notes += name + ": greatest distance " + number_text(robot.greatest.distance_m, 6) + " m at " +
             number_text(robot.greatest.time_s, 3) + " s, last distance " +
             number_text(robot.last.distance_m, 6) + " m at " + number_text(robot.last.time_s, 3) +
             " s\n";
  }
  if (rows.size() > 1)
    lengths += "\nwhere the trajectories part (places in m):\n" + lines_of(rows, 2);
  return lengths + notes;
}

std::string figures_text(const RunDifference& difference) {
  std::vector<Cells> rows = {{"figure", "run 1", "run 2", ""}};
  for (const FigureGroup& group : difference.figures) {
    const std::string robot = group.robot.empty() ? "" : grade::plain_text(group.robot) + ": ";
    for (const Figure& figure : group.figures) {
      rows.push_back({robot + figure.values.name, grade::plain_text(figure.values.first),
                      grade::plain_text(figure.values.second), figure.differs ? "differs" : ""});
    }
  }
  return "\nfigures:\n" + lines_of(rows, 1);
}

// Why a run has not passed.
std::string faults_text(const std::string& run, const ComparedRun& graded) {
  std::string text;
  for (const std::string& fault : graded.faults) {
    text += "run " + run + " failed: " + grade::plain_text(fault) + '\n';
  }
  return text;
}

}  // namespace

std::string number_text(double value, int decimals) {
  constexpr double kMostFixed = 1e7;
  return std::abs(value) < kMostFixed ? sim::fixed_text(value, decimals)
                                      : sim::rounded_text(value, 6);
}

std::string distance_text(double limit_m) { return sim::rounded_text(limit_m * 1000.0, 6) + " mm"; }

std::string text_of(const RunDifference& difference, const ComparedRun& first,
                    const ComparedRun& second) {
  std::string text = settings_text(difference, first.report);
  text += first_text(difference);
  if (!difference.any()) {
    std::size_t rows = 0;
    for (const RobotDifference& robot : difference.robots) rows += robot.time_s.size();
    return text + "The runs are equal: all " + std::to_string(rows) +
           " rows of trajectories, and all figures.\n";
  }
  text += parting_text(difference);
  text += figures_text(difference) + faults_text("1", first) + faults_text("2", second);
  // It is only worth a line if nothing above differs.
  if (!difference.report_member.empty() && difference.only_report_differs()) {
    text += "\nfirst member of report.json that differs: " +
            grade::plain_text(difference.report_member) + '\n';
  }
  return text;
}

}  // namespace playpen::diff
