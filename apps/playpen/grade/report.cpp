// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/report.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "grade/run_json.h"
#include "sim/core/number_text.h"

namespace playpen::grade {
namespace {

using nlohmann::ordered_json;

/// A measure that appears in the summary: its name in the JSON file and in the summary's lines.
struct Summarized {
  const char* key;
  const char* words;
  int decimals;
  std::optional<double> Measures::*value;
};

constexpr Summarized kSummarized[] = {
    {"coverage", "coverage", 3, &Measures::coverage},
    {"correctness", "map correctness", 3, &Measures::correctness},
    {"path_ratio", "path ratio", 2, &Measures::path_ratio},
    {"path_length", "path [m]", 2, &Measures::path_length_m},
    {"least_clearance", "least clearance [m]", 3, &Measures::least_clearance_m},
    {"sim_time", "simulated time [s]", 1, &Measures::sim_time_s},
    {"score", "score", 0, &Measures::score},
};

struct Spread {
  double least = 0.0;
  double mean = 0.0;
  double most = 0.0;
};

std::optional<Spread> spread_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  double sum = 0.0;
  for (const double v : values) sum += v;
  return Spread{*least, sum / static_cast<double>(values.size()), *most};
}

std::optional<Spread> spread_of(const Grade& grade, std::optional<double> Measures::*value) {
  std::vector<double> values;
  for (const GradedRun& run : grade.runs) {
    if (const std::optional<double>& v = run.measures.*value) values.push_back(*v);
  }
  return spread_of(values);
}

/// The points of all runs; nullopt if the task has no rubric, or there are no runs.
std::optional<Spread> spread_of_points(const Grade& grade) {
  if (grade.task.rubric.empty()) return std::nullopt;
  std::vector<double> totals;
  for (const GradedRun& run : grade.runs) totals.push_back(points_of(grade.task, run).total);
  return spread_of(totals);
}

std::string ending_text(const GradedRun& run) {
  switch (run.ending) {
    case Ending::kBySelf:
      return "by itself";
    case Ending::kTimeOver:
      return "time over";
    case Ending::kBadStatus:
      return "status " + std::to_string(run.status);
    case Ending::kSignal:
      return "signal " + std::to_string(run.signal.value_or(0));
    case Ending::kVerdict:
    case Ending::kTimedOut:
    case Ending::kTooMuchOutput:
    case Ending::kInterrupted:
      return name_of(run.ending);
    case Ending::kNotRun:
      return "not run";
  }
  return "";
}

std::string number_or_dash(const std::optional<double>& value, int decimals) {
  return value ? sim::fixed_text(*value, decimals) : "-";
}

/// A column of the table.
struct Column {
  const char* heading;
  bool is_words;     ///< aligned left; numbers are aligned right
  bool is_optional;  ///< hidden if no run has a value
};

constexpr Column kColumns[] = {
    {"world", true, false}, {"seed", false, false},  {"", true, false},
    {"end", true, false},   {"points", false, true}, {"goal", false, true},
    {"score", false, true}, {"cover", false, true},  {"correct", false, true},
    {"path", false, true},  {"ratio", false, true},  {"coll", false, true},
    {"clear", false, true}, {"sim", false, true},    {"wall", false, true},
};
constexpr std::size_t kVerdict = 2;
constexpr std::size_t kLeastColumns = 4;  ///< world, seed, verdict and end are always shown

using Row = std::vector<std::string>;

constexpr int kPointDecimals = 2;

Row row_of(const Task& task, const GradedRun& run) {
  const Measures& m = run.measures;
  return {run.world,
          std::to_string(run.seed),
          run.passed() ? "pass" : "FAIL",
          ending_text(run),
          task.rubric.empty() ? "-" : sim::fixed_text(points_of(task, run).total, kPointDecimals),
          m.reached ? (*m.reached ? "yes" : "no") : "-",
          number_or_dash(m.score, 0),
          number_or_dash(m.coverage, 3),
          number_or_dash(m.correctness, 3),
          number_or_dash(m.path_length_m, 2),
          number_or_dash(m.path_ratio, 2),
          m.collisions ? std::to_string(*m.collisions) : "-",
          number_or_dash(m.least_clearance_m, 3),
          number_or_dash(m.sim_time_s, 1),
          run.ending == Ending::kNotRun ? "-" : sim::fixed_text(run.wall_time_s, 1)};
}

/// The headings, and the rows of the runs.
std::vector<Row> rows_of(const Grade& grade) {
  std::vector<Row> rows;
  Row headings;
  for (const Column& column : kColumns) headings.emplace_back(column.heading);
  rows.push_back(std::move(headings));
  for (const GradedRun& run : grade.runs) rows.push_back(row_of(grade.task, run));
  return rows;
}

/// The columns that are not hidden.
std::vector<std::size_t> shown_columns(const std::vector<Row>& rows) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < std::size(kColumns); ++i) {
    const auto is_measured = [i](const Row& row) { return row[i] != "-"; };
    const bool any = std::any_of(rows.begin() + 1, rows.end(), is_measured);
    if (any || !kColumns[i].is_optional) shown.push_back(i);
  }
  return shown;
}

/// The runs' rows, the visible columns and their widths.
class Table {
 public:
  Table(const Grade& grade, const TableStyle& style)
      : style_(style), rows_(rows_of(grade)), shown_(shown_columns(rows_)) {
    fit();
  }

  [[nodiscard]] std::string text() const {
    std::string text = line(rows_.front());
    std::string world;
    for (std::size_t r = 1; r < rows_.size(); ++r) {
      if (worlds_are_headings_ && rows_[r].front() != world) {
        world = rows_[r].front();
        text += world + ":\n";
      }
      text += line(rows_[r]);
    }
    return text;
  }

 private:
  [[nodiscard]] std::size_t width_of(std::size_t column) const {
    std::size_t width = 0;
    for (const Row& row : rows_) width = std::max(width, row[column].size());
    return width;
  }

  [[nodiscard]] std::size_t width() const {
    std::size_t width = 0;
    for (const std::size_t column : shown_) {
      width += width_of(column) + (width > 0 ? gap_ : 0);
    }
    return width;
  }

  void fit() {
    if (width() <= style_.columns) return;
    gap_ = 1;
    if (width() <= style_.columns) return;
    worlds_are_headings_ = true;
    shown_.erase(shown_.begin());
    while (width() > style_.columns && shown_.size() >= kLeastColumns) shown_.pop_back();
  }

  [[nodiscard]] std::string line(const Row& row) const {
    std::string text;
    for (const std::size_t column : shown_) {
      const std::string blanks(width_of(column) - row[column].size(), ' ');
      const std::string cell = column == kVerdict ? coloured(row[column]) : row[column];
      if (column != shown_.front()) text += std::string(gap_, ' ');
      text += kColumns[column].is_words ? cell + blanks : blanks + cell;
    }
    return text + '\n';
  }

  [[nodiscard]] std::string coloured(const std::string& verdict) const {
    if (!style_.colour || verdict.empty()) return verdict;
    return (verdict == "pass" ? "\033[32m" : "\033[1;31m") + verdict + "\033[0m";
  }

  TableStyle style_;
  std::vector<Row> rows_;
  std::vector<std::size_t> shown_;
  std::size_t gap_ = 2;
  bool worlds_are_headings_ = false;
};

/// "seed 3", "seeds 1 to 5", "seeds 1, 2 and 7".
std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  if (seeds.size() == 1) return "seed " + std::to_string(seeds.front());
  bool is_range = seeds.size() > 2;
  for (std::size_t i = 1; i < seeds.size(); ++i) is_range &= seeds[i] == seeds[i - 1] + 1;
  if (is_range) {
    return "seeds " + std::to_string(seeds.front()) + " to " + std::to_string(seeds.back());
  }
  std::string text = "seeds ";
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (i > 0) text += i + 1 < seeds.size() ? ", " : " and ";
    text += std::to_string(seeds[i]);
  }
  return text;
}

/// The faults of the runs of one world, each once, and the advice.
std::string reasons_text(std::span<const GradedRun> runs, const TableStyle& style) {
  std::vector<std::pair<std::string, std::vector<std::uint64_t>>> faults;
  std::vector<std::string> advice;
  std::set<Ending> advised;
  for (const GradedRun& run : runs) {
    for (const std::string& fault : run.faults) {
      auto known = std::find_if(faults.begin(), faults.end(),
                                [&fault](const auto& entry) { return entry.first == fault; });
      if (known == faults.end()) known = faults.insert(known, {fault, {}});
      known->second.push_back(run.seed);
    }
    if (run.passed() || !style.advice || !advised.insert(run.ending).second) continue;
    for (std::string& line : style.advice(run)) advice.push_back(std::move(line));
  }
  std::string text;
  for (const auto& [fault, seeds] : faults) {
    text += runs.front().world + ' ' + seeds_text(seeds) + ": " + fault + '\n';
  }
  for (const std::string& line : advice) text += "  " + line + '\n';
  return text;
}

/// The points of all runs, and below them the mean points of each item.
std::string points_text(const Grade& grade) {
  const std::optional<Spread> spread = spread_of_points(grade);
  if (!spread) return "";
  const bool is_single = grade.runs.size() == 1;
  const auto text_of = [](double points) { return sim::fixed_text(points, kPointDecimals); };
  std::string text = "  points: ";
  if (!is_single) text += text_of(spread->least) + " to " + text_of(spread->most) + ", mean ";
  text += text_of(spread->mean) + " of " + sim::shortest_text(maximum_points(grade.task)) + '\n';
  for (const RubricItem& item : grade.task.rubric) {
    double sum = 0.0;
    for (const GradedRun& run : grade.runs) sum += points_of(item, run);
    text += "    " + item.name + ": " + (is_single ? "" : "mean ") +
            text_of(sum / static_cast<double>(grade.runs.size())) + " of " +
            sim::shortest_text(maximum_points(item)) + (item.is_bonus ? " (bonus)" : "") + '\n';
  }
  return text;
}

ordered_json points_json(const Task& task, const GradedRun& run) {
  const RunPoints points = points_of(task, run);
  ordered_json items = ordered_json::array();
  for (const ItemPoints& item : points.items) {
    items.push_back({{"name", item.name},
                     {"points", item.points},
                     {"maximum", item.maximum},
                     {"bonus", item.is_bonus}});
  }
  return {{"total", points.total}, {"maximum", maximum_points(task)}, {"items", items}};
}

}  // namespace

std::size_t Grade::passed() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [](const GradedRun& run) { return run.passed(); }));
}

std::vector<std::vector<std::string>> table_cells(const Grade& grade) {
  const std::vector<Row> rows = rows_of(grade);
  std::vector<std::size_t> columns = shown_columns(rows);
  std::erase(columns, std::size(kColumns) - 1);  // the wall-clock time
  std::vector<std::vector<std::string>> cells;
  for (const Row& row : rows) {
    std::vector<std::string>& shown = cells.emplace_back();
    for (const std::size_t column : columns) shown.push_back(row[column]);
  }
  return cells;
}

std::string table(const Grade& grade, const TableStyle& style) {
  std::string text = Table(grade, style).text();
  for (auto first = grade.runs.begin(); first != grade.runs.end();) {
    const auto last = std::find_if(first, grade.runs.end(), [&first](const GradedRun& run) {
      return run.world != first->world;
    });
    text += reasons_text({first, last}, style);
    first = last;
  }
  text += grade.task.name + ": " + std::to_string(grade.passed()) + " of " +
          std::to_string(grade.runs.size()) + " runs passed\n" + points_text(grade);
  if (grade.runs.size() == 1) return text;  // the table already contains everything
  for (const Summarized& what : kSummarized) {
    const std::optional<Spread> spread = spread_of(grade, what.value);
    if (!spread) continue;
    text += "  " + std::string(what.words) + ": " + sim::fixed_text(spread->least, what.decimals) +
            " to " + sim::fixed_text(spread->most, what.decimals) + ", mean " +
            sim::fixed_text(spread->mean, what.decimals) + '\n';
  }
  return text;
}

std::string json_text(const Grade& grade) {
  ordered_json runs = ordered_json::array();
  for (const GradedRun& run : grade.runs) {
    runs.push_back(json_of(run));
    if (!grade.task.rubric.empty()) runs.back()["points"] = points_json(grade.task, run);
  }
  ordered_json summary = {{"runs", grade.runs.size()},
                          {"passed", grade.passed()},
                          {"failed", grade.runs.size() - grade.passed()}};
  for (const Summarized& what : kSummarized) {
    const std::optional<Spread> spread = spread_of(grade, what.value);
    summary[what.key] =
        spread ? ordered_json{{"min", spread->least}, {"mean", spread->mean}, {"max", spread->most}}
               : ordered_json(nullptr);
  }
  if (const std::optional<Spread> spread = spread_of_points(grade)) {
    summary["points"] = {{"min", spread->least},
                         {"mean", spread->mean},
                         {"max", spread->most},
                         {"maximum", maximum_points(grade.task)}};
  }
  const ordered_json whole = {
      {"task", grade.task.name},    {"program", grade.program},
      {"isolated", grade.isolated}, {"passed", grade.passed() == grade.runs.size()},
      {"summary", summary},         {"runs", runs}};
  // Arguments and folders may contain bytes that are not valid UTF-8.
  return whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace playpen::grade
