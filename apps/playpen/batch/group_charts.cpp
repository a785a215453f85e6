// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/group_charts.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

namespace playpen::batch {
namespace {

namespace fs = std::filesystem;

/// The number that a value of a parameter is.
std::optional<double> number_of(const std::string& value) {
  const nlohmann::json parsed = nlohmann::json::parse(value, nullptr, /*allow_exceptions=*/false);
  return parsed.is_number() ? std::optional(parsed.get<double>()) : std::nullopt;
}

/// What differs between the groups, and how they are told apart in charts.
class Differences {
 public:
  explicit Differences(const Batch& batch) : batch_(batch) {
    std::set<std::string> worlds;
    std::vector<std::set<std::string>> values(batch.parameters.size());
    for (const Condition& condition : batch.conditions) {
      worlds.insert(condition.world);
      for (std::size_t i = 0; i < values.size(); ++i) values[i].insert(condition.values[i]);
    }
    several_worlds_ = worlds.size() > 1;
    std::size_t most = 1;
    for (std::size_t i = 0; i < values.size(); ++i) {
      varies_.push_back(values[i].size() > 1);
      const bool are_numbers = std::all_of(values[i].begin(), values[i].end(),
                                           [](const auto& v) { return number_of(v).has_value(); });
      if (are_numbers && values[i].size() > most) {
        most = values[i].size();
        axis_ = i;
      }
    }
  }

  [[nodiscard]] std::string axis_name() const { return axis_ ? batch_.parameters[*axis_] : ""; }
  [[nodiscard]] std::optional<double> place_on_axis(const GroupSummary& group) const {
    if (!axis_) return std::nullopt;
    return number_of(batch_.conditions[group.condition].values[*axis_]);
  }
  /// "robot", or with an axis "robot, cave, /robots/0/laser/noise 0.1".
  [[nodiscard]] std::string series_of(const GroupSummary& group) const {
    std::string text = batch_.programs.size() > 1 ? batch_.programs[group.program].name : "";
    if (axis_) append(text, condition_text(group));
    return text;
  }
  /// "cave, /robots/0/laser/noise 0.1"; if nothing differs, the program.
  [[nodiscard]] std::string label_of(const GroupSummary& group) const {
    const std::string text = condition_text(group);
    return text.empty() ? batch_.programs[group.program].name : text;
  }

 private:
  static void append(std::string& text, const std::string& more) {
    text += (text.empty() || more.empty() ? "" : ", ") + more;
  }

  [[nodiscard]] std::string condition_text(const GroupSummary& group) const {
    const Condition& condition = batch_.conditions[group.condition];
    std::string text = several_worlds_ ? condition.world : "";
    for (std::size_t i = 0; i < varies_.size(); ++i) {
      if (!varies_[i] || axis_ == i) continue;
      append(text, batch_.parameters[i] + ' ' + condition.values[i]);
    }
    return text;
  }

  const Batch& batch_;
  bool several_worlds_ = false;
  std::vector<bool> varies_;         ///< by parameter
  std::optional<std::size_t> axis_;  ///< the parameter on the horizontal axis
};

const FigureSummary* find_figure(const GroupSummary& group, const std::string& name) {
  for (const FigureSummary& figure : group.figures) {
    if (figure.name == name) return &figure;
  }
  return nullptr;
}

/// "path length".
std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

Chart chart_of(const Batch& batch, const std::vector<GroupSummary>& groups,
               const std::string& name) {
  const Differences differences(batch);
  Chart chart;
  chart.x_name = differences.axis_name();
  for (const GroupSummary& group : groups) {
    const FigureSummary* const figure = find_figure(group, name);
    if (figure == nullptr) continue;
    chart.is_share = figure->is_yes_or_no;
    chart.value_name = words_of(name) + (figure->unit.empty() ? "" : " [" + figure->unit + ']');
    chart.title = figure->is_yes_or_no ? "share of runs: " + words_of(name) : words_of(name);
    const std::string series_name = differences.series_of(group);
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const ChartSeries& s) { return s.name == series_name; });
    if (series == chart.series.end()) {
      series = chart.series.insert(series, ChartSeries{series_name, {}});
    }
    ChartPoint point;
    point.label = differences.label_of(group);
    point.x = differences.place_on_axis(group);
    point.value = figure->summary.mean;
    point.interval = figure->summary.interval;
    if (!figure->is_yes_or_no) point.values = figure->values;
    series->points.push_back(std::move(point));
  }
  return chart;
}

void write_charts(const Batch& batch, const std::vector<GroupSummary>& groups,
                  const fs::path& folder) {
  std::map<std::string, double> first;  // value of each figure
  std::set<std::string> names;          // of figures that differ
  for (const GroupSummary& group : groups) {
    for (const FigureSummary& figure : group.figures) {
      const double value = first.emplace(figure.name, figure.values.front()).first->second;
      const bool differs = std::any_of(figure.values.begin(), figure.values.end(),
                                       [value](double other) { return other != value; });
      if (differs) names.insert(figure.name);
    }
  }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  if (names.empty()) return;
  fs::create_directories(folder);
  for (const std::string& name : names) {
    write_chart(chart_of(batch, groups, name), folder / (name + ".png"));
  }
}

}  // namespace playpen::batch
