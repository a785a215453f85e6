// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/rubric_reader.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "sim/core/number_text.h"

namespace playpen::grade {
namespace {

using sim::io::NumberRange;
using sim::io::Reader;

constexpr std::size_t kMostItems = 1000;  ///< items, steps
constexpr NumberRange kItemPoints{0.0, 1e6, true, ""};
constexpr NumberRange kStepPoints{0.0, 1e6, false, ""};
constexpr NumberRange kBound{-1e9, 1e9, false, ""};

/// Reads a step and adds it to the item. The first step decides which of the two keys of limits all
/// steps have.
void read_step(Reader& step, RubricItem& item) {
  if (!step.expect_object()) return;
  const bool is_first = item.steps.empty();
  if (is_first) item.limits_are_least = !step.has("at_most") && step.has("at_least");
  const std::string key = item.limits_are_least ? "at_least" : "at_most";
  if (!step.has(key)) {
    step.issue("world/missing-key", is_first ? "\"at_most\" or \"at_least\"" : '"' + key + '"',
               "none", is_first ? "" : "the steps of an item have the same key");
    return;
  }
  RubricStep read{step.number(key, 0.0, kBound), 1.0};
  if (step.require("points", "the points of the step")) {
    read.points = step.number("points", read.points, kStepPoints);
  }
  step.finish();
  if (!item.steps.empty()) {
    const double before = item.steps.back().limit;
    const bool can_count = item.limits_are_least ? read.limit < before : read.limit > before;
    if (!can_count) {
      step.issue("task/unused-step",
                 (item.limits_are_least ? "less than " : "more than ") + sim::shortest_text(before),
                 sim::shortest_text(read.limit), "the first step that holds counts", key);
    }
  }
  item.steps.push_back(read);
}

void read_steps(Reader& reader, RubricItem& item) {
  std::vector<Reader> steps = reader.array("steps", kMostItems);
  if (const std::optional<Reader> list = reader.child("steps"); steps.empty() && list->is_array()) {
    reader.issue("world/out-of-range", "at least one step", list->description_for_message(), "",
                 "steps");
  }
  for (Reader& step : steps) read_step(step, item);
  reader.explain_unknown_keys([](std::string_view key) {
    const bool is_linear = key == "points" || key == "best" || key == "worst";
    return is_linear ? "each step has its own points and limit" : "";
  });
}

void read_points(Reader& reader, RubricItem& item) {
  if (reader.require("points", "the points of the item")) {
    item.points = reader.number("points", 0.0, kItemPoints);
  }
}

void read_linear(Reader& reader, RubricItem& item) {
  if (!reader.has("best") && !reader.has("worst")) {
    reader.issue("world/missing-key", "\"steps\", or \"best\" and \"worst\"", "none",
                 '"' + item.figure + "\" is a number");
    static_cast<void>(reader.has("points"));  // its error would be another one
    return;
  }
  read_points(reader, item);
  if (!reader.require("best", "the value for all points") ||
      !reader.require("worst", "the value for no points")) {
    return;
  }
  item.best = reader.number("best", 0.0, kBound);
  item.worst = reader.number("worst", 1.0, kBound);
  if (*item.best == *item.worst) {
    reader.issue("world/out-of-range", "another number than \"best\"",
                 sim::shortest_text(*item.worst), "for a single limit use \"steps\"", "worst");
  }
}

void read_yes_or_no(Reader& reader, RubricItem& item) {
  read_points(reader, item);
  const std::string hint = '"' + item.figure + "\" is true or false: all points or none";
  reader.explain_unknown_keys([hint](std::string_view key) {
    return key == "best" || key == "worst" || key == "steps" ? hint : "";
  });
}

std::vector<std::string> names_of_figures() {
  std::vector<std::string> names{"passed", std::string(kVerdictFigure.name)};
  for (const Figure& figure : kFigures) names.emplace_back(figure.name);
  return names;
}

std::optional<RubricItem> read_item(Reader& reader,
                                    const std::function<void(Reader&, FigureNeed)>& check_need) {
  if (!reader.expect_object() || !reader.require("figure", "the name of a figure of a run")) {
    return std::nullopt;
  }
  RubricItem item;
  item.figure = reader.choice("figure", "", names_of_figures());
  if (item.figure.empty()) return std::nullopt;
  item.name = reader.string("name", item.figure);
  item.is_bonus = reader.boolean("bonus", false);
  item.only_if_passed = reader.boolean("only_if_passed", false);
  const Figure* figure = find_figure(item.figure);
  if (figure != nullptr) check_need(reader, figure->need);
  if (figure == nullptr || is_yes_or_no(*figure)) {
    read_yes_or_no(reader, item);
  } else if (reader.has("steps")) {
    read_steps(reader, item);
  } else {
    read_linear(reader, item);
  }
  reader.finish();
  return item;
}

}  // namespace

std::vector<RubricItem> read_rubric(Reader& root,
                                    const std::function<void(Reader&, FigureNeed)>& check_need) {
  std::vector<RubricItem> items;
  if (!root.has("rubric")) return items;
  std::vector<Reader> elements = root.array("rubric", kMostItems);
  bool all_valid = root.child("rubric")->is_array();
  for (Reader& element : elements) {
    std::optional<RubricItem> item = read_item(element, check_need);
    all_valid &= item.has_value();
    if (item) items.push_back(std::move(*item));
  }
  const auto adds_nothing = [](const RubricItem& item) {
    return item.is_bonus || (!item.steps.empty() && maximum_points(item) == 0.0);
  };
  if (all_valid && std::all_of(items.begin(), items.end(), adds_nothing)) {
    root.issue("world/out-of-range", "at least one item that gives points and is not a bonus",
               items.empty() ? "an empty list" : "none", "", "rubric");
  }
  return items;
}

}  // namespace playpen::grade
