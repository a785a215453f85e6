// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "diff/run_difference.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "diff/difference_text.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"

namespace playpen::diff {
namespace {

using grade::Trajectory;

// --- Conditions of the runs

std::string robot_names(const playerlike::Report& report) {
  std::string names;
  for (const playerlike::Report::Robot& robot : report.robots) {
    names += (names.empty() ? "" : ", ") + robot.name;
  }
  return names.empty() ? "none" : names;
}

void add_setting(RunDifference& result, const std::string& name, std::string first,
                 std::string second) {
  if (first == second) return;
  result.settings.push_back({name, std::move(first), std::move(second)});
}

// The conditions that only graded runs record.
void compare_grading(const playerlike::Report& first, const playerlike::Report& second,
                     RunDifference& result) {
  if (!first.graded || !second.graded) return;
  const auto duration = [](const playerlike::Report& report) {
    const std::optional<double>& duration_s = report.graded->duration_s;
    return duration_s ? sim::shortest_text(*duration_s) + " s" : std::string("unlimited");
  };
  add_setting(result, "duration", duration(first), duration(second));
  add_setting(result, "time mode", first.graded->time, second.graded->time);
  if (first.graded->rules != second.graded->rules) {
    add_setting(result, "rules of the task", first.graded->rules.value_or("none"),
                second.graded->rules.value_or("none"));
  }
}

void compare_settings(const ComparedRun& first, const ComparedRun& second, RunDifference& result) {
  const playerlike::Report::Run& a = first.report.run;
  const playerlike::Report::Run& b = second.report.run;
  add_setting(result, "world", a.world, b.world);
  if (first.world_hash && second.world_hash && first.world_hash != second.world_hash) {
    add_setting(result, "content of the world's file", a.world_file.value_or("none"),
                b.world_file.value_or("none"));
  }
  add_setting(result, "seed", std::to_string(a.seed), std::to_string(b.seed));
  add_setting(result, "realism", a.realism, b.realism);
  add_setting(result, "repeatable", a.repeatable ? "yes" : "no", b.repeatable ? "yes" : "no");
  compare_grading(first.report, second.report, result);
  add_setting(result, "robots", robot_names(first.report), robot_names(second.report));
}

// --- Trajectories

// A row, as in trajectory.csv.
constexpr std::array<const char*, 5> kValueNames = {"x", "y", "yaw", "v", "omega"};

std::array<double, 5> values_of(const Trajectory& track, std::size_t row) {
  const sim::Pose& X_WB = track.X_WB[row];
  return {X_WB.x_m, X_WB.y_m, X_WB.yaw_rad, track.v_mps[row], track.omega_radps[row]};
}

// Notes the first row of a robot in which the runs differ.
class FirstOfRobot {
 public:
  explicit FirstOfRobot(const std::string& robot) : robot_(robot) {}

  void compare(const Trajectory& a, std::size_t i, const Trajectory& b, std::size_t k) {
    if (found_) return;
    const std::array<double, 5> first = values_of(a, i);
    const std::array<double, 5> second = values_of(b, k);
    for (std::size_t n = 0; n < first.size(); ++n) {
      if (first.at(n) == second.at(n)) continue;
      found_ = {a.time_s[i], robot_, kValueNames.at(n), first.at(n), second.at(n), true};
      return;
    }
  }
  void miss(double time_s, bool in_first) {
    if (!found_) found_ = {time_s, robot_, "", 0.0, 0.0, in_first};
  }
  [[nodiscard]] const std::optional<FirstDifference>& found() const { return found_; }

 private:
  std::string robot_;
  std::optional<FirstDifference> found_;
};

// Decimals of a text are not exact in binary: 0.401 - 0.400 is a little more than 0.001.
bool exceeds(double value, double limit) { return value > limit + 1e-9; }

template <std::size_t kCount>
void note_partings(const std::array<double, kCount>& limits, double value, const Parting& here,
                   std::vector<Parting>& partings) {
  while (partings.size() < kCount && exceeds(value, limits.at(partings.size()))) {
    partings.push_back(here);
    partings.back().limit = limits.at(partings.size() - 1);
  }
}

void add_row(const Trajectory& a, std::size_t i, const Trajectory& b, std::size_t k,
             RobotDifference& result) {
  const sim::Pose& first = a.X_WB[i];
  const sim::Pose& second = b.X_WB[k];
  const double distance_m = sim::math::hypot(first.x_m - second.x_m, first.y_m - second.y_m);
  // Wrapped one by one: the difference of two finite numbers may be infinite.
  const double turn_rad = sim::normalize_angle(sim::normalize_angle(first.yaw_rad) -
                                               sim::normalize_angle(second.yaw_rad));
  const double heading_deg = std::abs(turn_rad) * 180.0 / std::numbers::pi;
  const double time_s = a.time_s[i];
  if (result.time_s.empty() || distance_m > result.greatest.distance_m) {
    result.greatest = {distance_m, time_s};
  }
  result.last = {distance_m, time_s};
  result.time_s.push_back(time_s);
  result.distance_m.push_back(distance_m);
  result.heading_deg.push_back(heading_deg);
  const Parting here{0.0, time_s, first, second};
  note_partings(kDistances_m, distance_m, here, result.distances);
  note_partings(kHeadings_deg, heading_deg, here, result.headings);
}

// Compares the trajectories of a robot up to the end of the shorter one.
RobotDifference compare_tracks(const Trajectory& a, const Trajectory& b, FirstOfRobot& first) {
  RobotDifference result;
  result.robot = a.robot;
  result.first_end_s = a.time_s.back();
  result.second_end_s = b.time_s.back();
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.time_s.size() && k < b.time_s.size()) {
    if (a.time_s[i] == b.time_s[k]) {
      first.compare(a, i, b, k);
      add_row(a, i++, b, k++, result);
      continue;
    }
    const bool in_first = a.time_s[i] < b.time_s[k];
    first.miss(in_first ? a.time_s[i++] : b.time_s[k++], in_first);
    ++result.unmatched;
  }
  // Where one run ends, the other one may go on.
  if (i < a.time_s.size()) first.miss(a.time_s[i], true);
  if (k < b.time_s.size()) first.miss(b.time_s[k], false);
  return result;
}

void compare_trajectories(const ComparedRun& first, const ComparedRun& second,
                          RunDifference& result) {
  std::vector<bool> matched(second.trajectories.size(), false);
  for (std::size_t i = 0; i < first.trajectories.size(); ++i) {
    const Trajectory& a = *first.trajectories[i];
    const auto found = std::find_if(second.trajectories.begin(), second.trajectories.end(),
                                    [&a](const Trajectory* b) { return b->robot == a.robot; });
    if (found == second.trajectories.end()) {
      result.only_first.push_back(a.robot);
      continue;
    }
    const auto k = static_cast<std::size_t>(found - second.trajectories.begin());
    matched[k] = true;
    FirstOfRobot of_robot(a.robot);
    RobotDifference& robot = result.robots.emplace_back(compare_tracks(a, **found, of_robot));
    robot.in_first = i;
    robot.in_second = k;
    if (!of_robot.found()) continue;
    if (!result.first || of_robot.found()->time_s < result.first->time_s) {
      result.first = of_robot.found();
    }
  }
  for (std::size_t k = 0; k < matched.size(); ++k) {
    if (!matched[k]) result.only_second.push_back(second.trajectories[k]->robot);
  }
}

// --- The rest of the reports

nlohmann::json compared_members(const playerlike::Report& report) {
  nlohmann::json members = nlohmann::json::parse(playerlike::text_of_report(report));
  for (const char* const name : {"wall_time", "real_time_factor", "world_file"}) {
    members["run"].erase(name);
  }
  members.erase("graded");  // its conditions are compared as such
  return members;
}

std::string differing_member(const playerlike::Report& first, const playerlike::Report& second) {
  const nlohmann::json a = compared_members(first);
  const nlohmann::json b = compared_members(second);
  if (a == b) return "";
  const nlohmann::json changes = nlohmann::json::diff(a, b);
  return changes.empty() ? "" : changes.front().at("path").get<std::string>();
}

}  // namespace

bool RunDifference::trajectories_differ() const noexcept {
  return first.has_value() || !only_first.empty() || !only_second.empty();
}

bool RunDifference::any() const noexcept {
  return !report_member.empty() || !only_report_differs();
}

bool RunDifference::only_report_differs() const noexcept {
  const auto differs = [](const FigureGroup& group) {
    return std::any_of(group.figures.begin(), group.figures.end(),
                       [](const Figure& figure) { return figure.differs; });
  };
  return settings.empty() && !trajectories_differ() &&
         std::none_of(figures.begin(), figures.end(), differs);
}

RunDifference difference_of(const ComparedRun& first, const ComparedRun& second) {
  RunDifference result;
  compare_settings(first, second, result);
  compare_trajectories(first, second, result);
  result.figures = figures_of(first, second);
  result.report_member = differing_member(first.report, second.report);
  return result;
}

}  // namespace playpen::diff
