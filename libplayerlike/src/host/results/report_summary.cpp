// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/report_summary.h"

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "sim/core/file.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

/// A column of numbers. Its heading names the unit and sets its width.
struct Column {
  const char* heading;
  const char* key;
  int decimals;
};

constexpr Column kColumns[] = {
    {"path [m]", "path_length", 2},
    {"collisions", "collisions", 0},
    {"least clearance [m]", "least_clearance", 3},
    {"stalled [s]", "stalled_time", 2},
};

int width_of(const Column& column) {
  return static_cast<int>(std::string(column.heading).size()) + 2;
}

// Returns a line for each robot that stalled for more than half of its driven time.
std::string stall_advice(const nlohmann::json& report) {
  constexpr double kMost = 0.5;
  constexpr double kLeastDriven_s = 1.0;  // shorter times are not significant
  std::string advice;
  for (const nlohmann::json& robot : report.at("robots")) {
    const double driven_s = robot.value("driven_time", 0.0);
    const double stalled_s = robot.at("stalled_time").get<double>();
    if (driven_s < kLeastDriven_s || stalled_s <= kMost * driven_s) continue;
    advice +=
        robot.at("name").get<std::string>() + " was stalled for " +
        sim::fixed_text(100.0 * std::min(stalled_s / driven_s, 1.0), 0) +
        " % of the time that it drove: 'playpen doc which_world' names the world that suits a "
        "program\n";
  }
  return advice;
}

// Returns the scores and the verdict of the arena controller, or why there is none.
std::string arena_summary(const nlohmann::json& report) {
  if (!report.contains("scores")) return "";
  std::string text;
  for (const auto& [robot, points] : report.at("scores").items()) {
    text += text.empty() ? "scores: " : ", ";
    text += robot + ' ' + sim::shortest_text(points.get<double>());
  }
  if (!text.empty()) text += '\n';
  const nlohmann::json& verdict = report.at("verdict");
  if (verdict.is_null()) return text + "verdict: none\n";
  text += verdict.at("passed").get<bool>() ? "verdict: passed" : "verdict: failed";
  text += " after " + sim::fixed_text(verdict.at("time").get<double>(), 2) + " s";
  const std::string reason = verdict.at("reason").get<std::string>();
  if (!reason.empty()) text += ": " + reason;
  return text + '\n';
}

std::string summarize(const nlohmann::json& report) {
  const nlohmann::json& run = report.at("run");
  const nlohmann::json& robots = report.at("robots");
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(1) << run.at("sim_time").get<double>()
      << " s simulated in " << std::setprecision(3) << run.at("wall_time").get<double>()
      << " s: " << std::setprecision(1) << run.at("real_time_factor").get<double>()
      << " times real time (seed " << run.at("seed").get<std::uint64_t>();
  const std::string realism = run.value("realism", "course");
  if (realism != "course") out << ", realism " << realism;
  out << ")\n";
  if (!run.value("repeatable", true)) {
    out << "another run may differ:\n";
    for (const nlohmann::json& why : run.at("repeatable_why")) {
      out << "  " << why.get<std::string>() << '\n';
    }
  }

  std::size_t name_width = std::string("robot").size();
  for (const nlohmann::json& robot : robots) {
    name_width = std::max(name_width, robot.at("name").get<std::string>().size());
  }
  const int name_column = static_cast<int>(name_width);
  out << "  " << std::left << std::setw(name_column) << "robot" << std::right;
  for (const Column& column : kColumns) out << std::setw(width_of(column)) << column.heading;
  out << '\n';
  for (const nlohmann::json& robot : robots) {
    out << "  " << std::left << std::setw(name_column) << robot.at("name").get<std::string>()
        << std::right;
    for (const Column& column : kColumns) {
      out << std::setw(width_of(column)) << std::setprecision(column.decimals)
          << robot.at(column.key).get<double>();
    }
    out << '\n';
  }
  return out.str() + arena_summary(report) + stall_advice(report);
}

template <typename Use>
auto read_report(const std::string& file, Use use) {
  std::string text;
  if (const auto problem = sim::read_whole_file(file, {}, text)) {
    throw std::runtime_error("the report " + file + " can't be read: " + problem->found);
  }
  try {
    return use(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("the report " + file + " is not as expected: " + error.what());
  }
}

}  // namespace

std::string summarize_report(const std::string& file) { return read_report(file, summarize); }

double simulated_time_of_report(const std::string& file) {
  return read_report(file, [](const nlohmann::json& report) {
    return report.at("run").at("sim_time").get<double>();
  });
}

}  // namespace playerlike
