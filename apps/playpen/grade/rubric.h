// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Rubrics: points for the figures of a run (docs/grading.md).
namespace playpen::grade {

enum class FigureNeed;
struct Figure;
struct Grade;
struct GradedRun;
struct Task;

/// A step of an item: points for a figure within a limit.
struct RubricStep {
  double limit = 0.0;
  double points = 0.0;  ///< >= 0
};

/// An item of a rubric: points that depend on one figure of a run. It is of one of three kinds:
/// - steps: the points of the first step whose limit holds, or none;
/// - linear: all points at `best` and beyond, none at `worst` and beyond, linear between them;
/// - otherwise all points if the figure is true. It is true or false, as "passed" is.
///
/// A figure without a value gives no points.
struct RubricItem {
  std::string name = {};  ///< for people; that of the figure unless the file names it
  /// "passed", or the name of a measure (see find_figure())
  std::string figure = {};
  double points = 0.0;               ///< > 0; unused with steps
  std::optional<double> best = {};   ///< both or none
  std::optional<double> worst = {};  ///< not equal to `best`
  std::vector<RubricStep> steps = {};
  bool limits_are_least = false;  ///< of the steps: "at_least" and not "at_most"
  bool is_bonus = false;          ///< does not count for the maximum of the rubric
  bool only_if_passed = false;    ///< no points for a run that has failed
};

/// The points of a run for an item.
struct ItemPoints {
  std::string name;
  double points = 0.0;
  double maximum = 0.0;
  bool is_bonus = false;
};

/// The points of a run.
struct RunPoints {
  double total = 0.0;             ///< bonuses included, so it may be above the maximum
  std::vector<ItemPoints> items;  ///< in the order of the rubric
};

/// The figure of this name of a measure or of the verdict; null if there is none.
[[nodiscard]] const Figure* find_figure(std::string_view name);

/// Whether an item of the task's rubric has a figure with this need.
[[nodiscard]] bool rubric_needs(const Task& task, FigureNeed need);

/// The rubric of a task. A task without one gives 100 points for a run that has passed, so the mean
/// is the percentage of such runs.
[[nodiscard]] const std::vector<RubricItem>& rubric_of(const Task& task);

/// The most points of a run for an item.
[[nodiscard]] double maximum_points(const RubricItem& item);

/// The most points of a run of a task, bonuses excluded; > 0.
[[nodiscard]] double maximum_points(const Task& task);

/// The points of a run for an item.
[[nodiscard]] double points_of(const RubricItem& item, const GradedRun& run);

/// The points of a run of a task.
[[nodiscard]] RunPoints points_of(const Task& task, const GradedRun& run);

/// The mean of the points over all runs of a grade, those that were not run included; 0 without
/// runs.
[[nodiscard]] double mean_points(const Grade& grade);

}  // namespace playpen::grade
