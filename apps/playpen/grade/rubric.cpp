// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/rubric.h"

#include <algorithm>

#include "grade/figures.h"
#include "grade/report.h"

namespace playpen::grade {
namespace {

std::optional<double> figure_of(const GradedRun& run, std::string_view name) {
  if (name == "passed") return run.passed() ? 1.0 : 0.0;
  const Figure* figure = find_figure(name);
  return figure != nullptr ? value_of(run.measures, *figure) : std::nullopt;
}

double points_of_steps(const RubricItem& item, double value) {
  for (const RubricStep& step : item.steps) {
    const bool holds = item.limits_are_least ? value >= step.limit : value <= step.limit;
    if (holds) return step.points;
  }
  return 0.0;
}

double linear_points(const RubricItem& item, double best, double worst, double value) {
  const bool more_is_better = best > worst;
  if (more_is_better ? value >= best : value <= best) return item.points;
  if (more_is_better ? value <= worst : value >= worst) return 0.0;
  return item.points * ((value - worst) / (best - worst));
}

}  // namespace

const Figure* find_figure(std::string_view name) {
  if (name == kVerdictFigure.name) return &kVerdictFigure;
  const auto found = std::find_if(kFigures.begin(), kFigures.end(),
                                  [name](const Figure& figure) { return figure.name == name; });
  return found != kFigures.end() ? &*found : nullptr;
}

bool rubric_needs(const Task& task, FigureNeed need) {
  return std::any_of(task.rubric.begin(), task.rubric.end(), [need](const RubricItem& item) {
    const Figure* figure = find_figure(item.figure);
    return figure != nullptr && figure->need == need;
  });
}

const std::vector<RubricItem>& rubric_of(const Task& task) {
  static const std::vector<RubricItem> kPassed{
      {.name = "passed", .figure = "passed", .points = 100.0}};
  return task.rubric.empty() ? kPassed : task.rubric;
}

double maximum_points(const RubricItem& item) {
  double most = item.points;
  for (const RubricStep& step : item.steps) most = std::max(most, step.points);
  return most;
}

double maximum_points(const Task& task) {
  double sum = 0.0;
  for (const RubricItem& item : rubric_of(task)) {
    if (!item.is_bonus) sum += maximum_points(item);
  }
  return sum;
}

double points_of(const RubricItem& item, const GradedRun& run) {
  if (item.only_if_passed && !run.passed()) return 0.0;
  const std::optional<double> value = figure_of(run, item.figure);
  if (!value) return 0.0;
  if (!item.steps.empty()) return points_of_steps(item, *value);
  if (item.best && item.worst) return linear_points(item, *item.best, *item.worst, *value);
  return *value != 0.0 ? item.points : 0.0;
}

RunPoints points_of(const Task& task, const GradedRun& run) {
  RunPoints result;
  for (const RubricItem& item : rubric_of(task)) {
    const double points = points_of(item, run);
    result.total += points;
    result.items.push_back({item.name, points, maximum_points(item), item.is_bonus});
  }
  return result;
}

double mean_points(const Grade& grade) {
  if (grade.runs.empty()) return 0.0;
  double sum = 0.0;
  for (const GradedRun& run : grade.runs) sum += points_of(grade.task, run).total;
  return sum / static_cast<double>(grade.runs.size());
}

}  // namespace playpen::grade
