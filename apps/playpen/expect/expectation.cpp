// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "expect/expectation.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace playpen::expect {
namespace {

using nlohmann::ordered_json;
using playerlike::Report;

// Longer ones first.
constexpr std::array<std::pair<std::string_view, Expectation::Comparison>, 6> kComparisons{
    {{"==", Expectation::Comparison::kEqual},
     {"!=", Expectation::Comparison::kUnequal},
     {"<=", Expectation::Comparison::kAtMost},
     {">=", Expectation::Comparison::kAtLeast},
     {"<", Expectation::Comparison::kLess},
     {">", Expectation::Comparison::kGreater}}};

// Calls visit(name, value) for each number in an object and in the objects of it: "final_pose.x".
void visit_numbers(const ordered_json& object, const std::string& prefix,
                   const std::function<void(const std::string&, double)>& visit) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_number()) visit(prefix + key, value.get<double>());
    if (value.is_object()) visit_numbers(value, prefix + key + '.', visit);
  }
}

// A report in which each robot has all that it can have.
Report full_report() {
  Report report;
  Report::Robot& robot = report.robots.emplace_back();
  robot.least_clearance_m = 0.0;
  robot.driven_time_s = 0.0;
  robot.distance_m = 0.0;
  robot.visited_area_m2 = 0.0;
  robot.commanded.emplace(Report::Commanded{});
  return report;
}

ordered_json json_of(const Report& report) {
  return ordered_json::parse(playerlike::text_of_report(report));
}

std::vector<Figure> all_figures() {
  // Settings, and figures of the wall clock, which differ from run to run.
  const std::set<std::string> others = {"seed", "wall_time", "real_time_factor"};
  std::vector<Figure> all;
  const ordered_json report = json_of(full_report());
  visit_numbers(report["robots"][0], "", [&](const std::string& name, double) {
    all.push_back({name, true, false});
  });
  all.push_back({"reached", true, true});
  all.push_back({"score", true, false});
  visit_numbers(report["run"], "", [&](const std::string& name, double) {
    if (!others.contains(name)) all.push_back({name, false, false});
  });
  all.push_back({"passed", false, true});
  return all;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// The robot's own figures that are no members of it in the report.
std::optional<double> other_figure(const Report& report, const std::string& robot,
                                   const std::string& figure) {
  if (figure == "score" && report.scores) {
    for (const Report::Score& score : *report.scores) {
      if (score.robot == robot) return score.points;
    }
  }
  if (figure == "reached") {
    std::optional<double> all;
    for (const Report::Goal& goal : report.goals) {
      if (goal.robot == robot) all = std::min(all.value_or(1.0), goal.reached_s ? 1.0 : 0.0);
    }
    return all;
  }
  return std::nullopt;
}

std::optional<double> figure_in(const ordered_json& object, const std::string& figure) {
  std::optional<double> found;
  visit_numbers(object, "", [&](const std::string& name, double value) {
    if (name == figure) found = value;
  });
  return found;
}

// What helps to understand a figure of a robot that is not as expected.
std::string remark(const Report& report, const std::string& robot, const std::string& figure) {
  if (figure == "collisions") {
    for (const Report::Collision& one : report.collisions) {
      if (one.robot != robot) continue;
      return "; the first with " + one.with + " at " + sim::fixed_text(one.time_s, 2) + " s, x " +
             sim::fixed_text(one.place.x(), 2) + ", y " + sim::fixed_text(one.place.y(), 2);
    }
  }
  if (figure == "passed" && report.verdict && !report.verdict->reason.empty()) {
    return ": " + report.verdict->reason;
  }
  return "";
}

const Figure& figure_named(std::string_view name) {
  const auto found = std::ranges::find(figures(), name, &Figure::name);
  if (found != figures().end()) return *found;
  std::string names;
  for (const Figure& figure : figures()) names += (names.empty() ? "" : ", ") + figure.name;
  throw std::invalid_argument("there is no figure '" + sim::escape_invalid_utf8(name) +
                              "'; expected [ROBOT.] and one of " + names);
}

}  // namespace

const std::vector<Figure>& figures() {
  static const std::vector<Figure> kAll = all_figures();
  return kAll;
}

Expectation Expectation::parse(const std::string& text) {
  const std::size_t at = text.find_first_of("=!<>");
  const auto comparison = at == std::string::npos
                              ? kComparisons.end()
                              : std::ranges::find_if(kComparisons, [&](const auto& one) {
                                  return std::string_view(text).substr(at).starts_with(one.first);
                                });
  if (comparison == kComparisons.end()) {
    throw std::invalid_argument(
        "expected FIGURE OPERATOR VALUE with one of == != < <= > >=, found '" +
        sim::escape_invalid_utf8(text) + "'");
  }
  Expectation made;
  made.comparison_ = comparison->second;
  std::string_view name = trimmed(std::string_view(text).substr(0, at));
  const std::string_view value =
      trimmed(std::string_view(text).substr(at + comparison->first.size()));
  // Figures have dots, too: the name of a robot comes before all of them.
  const std::size_t dot = name.find('.');
  const bool is_known = std::ranges::find(figures(), name, &Figure::name) != figures().end();
  if (!is_known && dot != std::string_view::npos) {
    made.robot_ = name.substr(0, dot);
    name.remove_prefix(dot + 1);
  }
  const Figure& figure = figure_named(name);
  if (!made.robot_.empty() && !figure.of_robot) {
    throw std::invalid_argument("'" + figure.name + "' is a figure of the run, not of a robot");
  }
  made.figure_ = figure.name;
  const bool is_word = value == "yes" || value == "no";
  const std::optional<double> bound = is_word ? value == "yes" ? 1.0 : 0.0 : number_of(value);
  if (!bound || is_word != figure.yes_or_no) {
    throw std::invalid_argument("'" + figure.name + "' is compared with " +
                                (figure.yes_or_no ? "yes or no" : "a number") + ", found '" +
                                sim::escape_invalid_utf8(value) + "'");
  }
  made.bound_ = *bound;
  made.text_ = (made.robot_.empty() ? "" : made.robot_ + '.') + made.figure_ + ' ' +
               std::string(comparison->first) + ' ' + std::string(value);
  return made;
}

void Expectation::require_robot_of(const sim::WorldDescription& world) const {
  if (robot_.empty()) return;
  std::string names;
  for (const sim::RobotDescription& robot : world.robots) {
    if (robot.name == robot_) return;
    names += (names.empty() ? "" : ", ") + robot.name;
  }
  throw std::invalid_argument("the world has no robot '" + robot_ + "'; its robots are " + names);
}

bool Expectation::is_met_by(double value) const noexcept {
  switch (comparison_) {
    case Comparison::kEqual:
      return value == bound_;
    case Comparison::kUnequal:
      return value != bound_;
    case Comparison::kLess:
      return value < bound_;
    case Comparison::kAtMost:
      return value <= bound_;
    case Comparison::kGreater:
      return value > bound_;
    case Comparison::kAtLeast:
      return value >= bound_;
  }
  return false;
}

std::vector<std::string> Expectation::faults_of(const Report& report) const {
  constexpr int kDigits = 6;
  const Figure& figure = figure_named(figure_);
  const ordered_json json = json_of(report);
  std::vector<std::string> faults;
  const auto judge = [&](const std::string& who, const std::optional<double>& value) {
    if (value && is_met_by(*value)) return;
    if (!value) {
      faults.push_back(who + " has no value of it");
      return;
    }
    const std::string measured = !figure.yes_or_no ? sim::rounded_text(*value, kDigits)
                                 : *value == 1.0   ? "yes"
                                                   : "no";
    faults.push_back(who + " has " + measured + remark(report, who, figure_));
  };
  if (!figure.of_robot) {
    std::optional<double> value = figure_in(json["run"], figure_);
    if (figure_ == "passed" && report.verdict) value = report.verdict->passed ? 1.0 : 0.0;
    judge("the run", value);
    return faults;
  }
  bool is_there = false;
  for (std::size_t i = 0; i < report.robots.size(); ++i) {
    const std::string& name = report.robots[i].name;
    if (!robot_.empty() && robot_ != name) continue;
    is_there = true;
    std::optional<double> value = figure_in(json["robots"][i], figure_);
    if (!value) value = other_figure(report, name, figure_);
    judge(name, value);
  }
  if (!is_there) {
    faults.push_back(robot_.empty() ? "the run has no robot" : "the run has no robot " + robot_);
  }
  return faults;
}

}  // namespace playpen::expect
