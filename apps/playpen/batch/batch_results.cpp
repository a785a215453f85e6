// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/batch_results.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "batch/group_charts.h"
#include "batch/unit_runs.h"
#include "grade/figures.h"
#include "grade/run_json.h"
#include "grade/text.h"
#include "sim/core/number_text.h"

namespace playpen::batch {
namespace {

namespace fs = std::filesystem;
using grade::csv_value;
using grade::GradedRun;
using nlohmann::ordered_json;

std::string number_text(double value) { return sim::shortest_text(value); }

/// The figure of some runs, summarised. @pre there are values.
FigureSummary summary_of_figure(std::string name, std::string unit, bool is_yes_or_no,
                                std::vector<double> values, const std::string& group) {
  FigureSummary figure{std::move(name), std::move(unit), is_yes_or_no, {}, std::move(values)};
  if (!is_yes_or_no) {
    figure.summary = summary_of(figure.values, group + ' ' + figure.name);
    return figure;
  }
  const auto yes =
      static_cast<std::size_t>(std::count(figure.values.begin(), figure.values.end(), 1.0));
  figure.summary.count = figure.values.size();
  figure.summary.mean = static_cast<double>(yes) / static_cast<double>(figure.values.size());
  figure.summary.interval = wilson_interval(yes, figure.values.size());
  return figure;
}

/// The figures of some runs that ended.
std::vector<FigureSummary> figures_of(const std::vector<const GradedRun*>& runs,
                                      const std::string& group) {
  std::vector<FigureSummary> figures;
  if (runs.empty()) return figures;
  std::vector<double> passed;
  for (const GradedRun* run : runs) passed.push_back(run->passed() ? 1.0 : 0.0);
  figures.push_back(summary_of_figure("passed", "", true, std::move(passed), group));
  for (const grade::Figure& figure : grade::kFigures) {
    std::vector<double> values;
    for (const GradedRun* run : runs) {
      const std::optional<double> value = grade::value_of(run->measures, figure);
      if (value && std::isfinite(*value)) values.push_back(*value);
    }
    if (values.empty()) continue;
    figures.push_back(summary_of_figure(std::string(figure.name), std::string(figure.unit),
                                        grade::is_yes_or_no(figure), std::move(values), group));
  }
  return figures;
}

/// The values of a condition as an object, pointers as keys.
ordered_json values_json(const Batch& batch, const Condition& condition) {
  ordered_json values = ordered_json::object();
  for (std::size_t i = 0; i < batch.parameters.size(); ++i) {
    values[batch.parameters[i]] = ordered_json::parse(condition.values[i]);
  }
  return values;
}

std::string joined_faults(const GradedRun& run) {
  std::string text;
  for (const std::string& fault : run.faults) text += (text.empty() ? "" : "; ") + fault;
  return text;
}

/// The columns that say what a line is about.
std::string csv_condition(const Batch& batch, std::size_t program, std::size_t condition) {
  const Condition& asked = batch.conditions[condition];
  std::string text = csv_value(batch.programs[program].name) + ',' + csv_value(asked.world);
  for (const std::string& value : asked.values) {
    const ordered_json parsed = ordered_json::parse(value);
    // A negative number is no formula.
    text += ',' + (parsed.is_number()
                       ? value
                       : csv_value(parsed.is_string() ? parsed.get<std::string>() : value));
  }
  return text;
}

std::string csv_names(const Batch& batch) {
  std::string text = "program,world";
  for (const std::string& parameter : batch.parameters) text += ',' + csv_value(parameter);
  return text;
}

std::string results_csv(const BatchResult& result) {
  std::string text = "unit," + csv_names(result.batch) + ",seed,passed,end,faults";
  for (const grade::Figure& figure : grade::kFigures) text += ',' + std::string(figure.name);
  text += ",wall_time\r\n";
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const Unit& unit = result.batch.units[i];
    text += unit.id + ',' + csv_condition(result.batch, unit.program, unit.condition) + ',' +
            std::to_string(unit.seed);
    const std::optional<GradedRun>& run = result.runs[i];
    if (!run) {
      text += ",,missing," + std::string(grade::kFigures.size() + 1, ',') + "\r\n";
      continue;
    }
    text += std::string(run->passed() ? ",yes," : ",no,") + grade::name_of(run->ending) + ',' +
            csv_value(joined_faults(*run));
    for (const grade::Figure& figure : grade::kFigures) {
      const std::optional<double> value = grade::value_of(run->measures, figure);
      text += ',';
      if (!value) continue;
      text += !grade::is_yes_or_no(figure) ? number_text(*value) : *value == 1.0 ? "yes" : "no";
    }
    text += ',' + number_text(run->wall_time_s) + "\r\n";
  }
  return text;
}

std::string statistics_csv(const Batch& batch, const std::vector<GroupSummary>& groups) {
  std::string text =
      csv_names(batch) + ",figure,unit,count,mean,deviation,least,median,most,low,high\r\n";
  for (const GroupSummary& group : groups) {
    const std::string begin = csv_condition(batch, group.program, group.condition);
    for (const FigureSummary& figure : group.figures) {
      const Summary& s = figure.summary;
      text += begin + ',' + figure.name + ',' + figure.unit + ',' + std::to_string(s.count) + ',' +
              number_text(s.mean) + ',';
      if (!figure.is_yes_or_no) {
        text += number_text(s.deviation) + ',' + number_text(s.least) + ',' +
                number_text(s.median) + ',' + number_text(s.most) + ',';
      } else {
        text += ",,,,";
      }
      text += number_text(s.interval.low) + ',' + number_text(s.interval.high) + "\r\n";
    }
  }
  return text;
}

ordered_json to_json(const FigureSummary& figure) {
  const Summary& s = figure.summary;
  if (figure.is_yes_or_no) {
    return {
        {"count", s.count}, {"share", s.mean}, {"low", s.interval.low}, {"high", s.interval.high}};
  }
  return {{"count", s.count},      {"mean", s.mean},         {"deviation", s.deviation},
          {"least", s.least},      {"median", s.median},     {"most", s.most},
          {"low", s.interval.low}, {"high", s.interval.high}};
}

std::string json_text(const BatchResult& result, const std::vector<GroupSummary>& groups) {
  const Batch& batch = result.batch;
  ordered_json summaries = ordered_json::array();
  for (const GroupSummary& group : groups) {
    ordered_json figures = ordered_json::object();
    for (const FigureSummary& figure : group.figures) figures[figure.name] = to_json(figure);
    const Condition& condition = batch.conditions[group.condition];
    summaries.push_back({{"program", batch.programs[group.program].name},
                         {"world", condition.world},
                         {"values", values_json(batch, condition)},
                         {"runs", group.units},
                         {"ended", group.ended},
                         {"figures", figures}});
  }
  ordered_json runs = ordered_json::array();
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const Unit& unit = batch.units[i];
    const Condition& condition = batch.conditions[unit.condition];
    ordered_json run = {{"unit", unit.id},
                        {"program", batch.programs[unit.program].name},
                        {"values", values_json(batch, condition)},
                        {"missing", !result.runs[i].has_value()},
                        {"world", condition.world},
                        {"seed", unit.seed}};
    if (result.runs[i]) {
      GradedRun named = *result.runs[i];
      named.world = condition.world;
      named.folder = "units/" + unit.id;
      run.update(grade::json_of(named));
    }
    runs.push_back(std::move(run));
  }
  const ordered_json whole = {{"version", batch.version},
                              {"complete", result.ended() == result.runs.size()},
                              {"runs", result.runs.size()},
                              {"ended", result.ended()},
                              {"passed", result.passed()},
                              {"groups", summaries},
                              {"units", runs}};
  return whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

/// A column of the table for people: its heading, then a cell for each group.
struct Column {
  std::vector<std::string> cells;
  bool is_words = false;

  [[nodiscard]] std::size_t width() const {
    std::size_t most = 0;
    for (const std::string& cell : cells) most = std::max(most, grade::character_count(cell));
    return most;
  }
};

constexpr std::size_t kColumnGap = 2;

/// The mean of a figure; "-" if it has no values.
std::string mean_text(const GroupSummary& group, const char* name, int decimals) {
  const auto figure =
      std::find_if(group.figures.begin(), group.figures.end(),
                   [name](const FigureSummary& known) { return known.name == name; });
  return figure == group.figures.end() ? "-" : sim::fixed_text(figure->summary.mean, decimals);
}

std::string passed_text(const GroupSummary& group) {
  if (group.figures.empty()) return "-";
  const Summary& passed = group.figures.front().summary;
  return sim::fixed_text(passed.mean * static_cast<double>(passed.count), 0) + " of " +
         std::to_string(passed.count);
}

/// The end of a pointer that no other parameter has: "x", or "0/pose/x".
std::string short_name(const std::vector<std::string>& pointers, std::size_t index) {
  const std::string& pointer = pointers[index];
  for (std::size_t slash = pointer.rfind('/'); slash != 0 && slash != std::string::npos;
       slash = pointer.rfind('/', slash - 1)) {
    const std::string end = pointer.substr(slash);
    const auto has_end = [&end](const std::string& other) { return other.ends_with(end); };
    if (std::count_if(pointers.begin(), pointers.end(), has_end) == 1) return end.substr(1);
  }
  return pointer;
}

/// The columns of the table: what differs between the groups, and some figures.
std::vector<Column> columns_of(const Batch& batch, const std::vector<GroupSummary>& groups) {
  std::vector<Column> columns;
  const auto add = [&](const std::string& heading, bool is_words, const auto& cell_of) {
    Column column{{heading}, is_words};
    for (const GroupSummary& group : groups) column.cells.push_back(cell_of(group));
    const bool differs = std::any_of(column.cells.begin() + 1, column.cells.end(),
                                     [&](const auto& cell) { return cell != column.cells[1]; });
    if (differs || !is_words || columns.empty()) columns.push_back(std::move(column));
  };
  add("program", true, [&](const GroupSummary& group) {
    return grade::plain_text(batch.programs[group.program].name);
  });
  add("world", true,
      [&](const GroupSummary& group) { return batch.conditions[group.condition].world; });
  for (std::size_t i = 0; i < batch.parameters.size(); ++i) {
    add(grade::plain_text(short_name(batch.parameters, i)), true,
        [&](const GroupSummary& group) { return batch.conditions[group.condition].values[i]; });
  }
  add("passed", false, passed_text);
  const auto add_mean = [&add](const char* heading, const char* figure, int decimals) {
    add(heading, false,
        [&](const GroupSummary& group) { return mean_text(group, figure, decimals); });
  };
  add_mean("path [m]", "path_length", 2);
  add_mean("collisions", "collisions", 1);
  add_mean("time [s]", "sim_time", 1);
  return columns;
}

}  // namespace

std::size_t BatchResult::ended() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.has_value(); }));
}

std::size_t BatchResult::passed() const noexcept {
  return static_cast<std::size_t>(std::count_if(
      runs.begin(), runs.end(), [](const auto& run) { return run && run->passed(); }));
}

bool ended_well(const GradedRun& run) {
  return run.ending == grade::Ending::kBySelf || run.ending == grade::Ending::kTimeOver ||
         run.ending == grade::Ending::kVerdict;
}

BatchResult collect(const Batch& batch, const fs::path& out) {
  BatchResult result{batch, {}};
  for (const Unit& unit : batch.units) result.runs.push_back(read_unit(out, unit));
  return result;
}

std::vector<GroupSummary> summarize(const BatchResult& result) {
  std::vector<GroupSummary> groups;
  std::vector<const GradedRun*> runs;
  const std::vector<Unit>& units = result.batch.units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (groups.empty() || groups.back().program != units[i].program ||
        groups.back().condition != units[i].condition) {
      groups.push_back({units[i].program, units[i].condition, 0, 0, {}});
      runs.clear();
    }
    GroupSummary& group = groups.back();
    ++group.units;
    if (result.runs[i]) runs.push_back(&*result.runs[i]);
    group.ended = runs.size();
    const bool is_last = i + 1 == units.size() || units[i + 1].program != group.program ||
                         units[i + 1].condition != group.condition;
    if (is_last)
      group.figures = figures_of(runs, csv_condition(result.batch, group.program, group.condition));
  }
  return groups;
}

std::string batch_table(const BatchResult& result, const std::vector<GroupSummary>& groups,
                        std::size_t columns) {
  std::vector<Column> table = columns_of(result.batch, groups);
  const auto width = [&table] {
    std::size_t sum = 0;
    for (const Column& column : table) sum += column.width() + kColumnGap;
    return sum - kColumnGap;
  };
  constexpr std::size_t kFewest = 2;
  while (table.size() > kFewest && width() > columns) table.pop_back();
  std::string text;
  for (std::size_t row = 0; row < table.front().cells.size(); ++row) {
    std::string line;
    for (const Column& column : table) {
      const std::string& cell = column.cells[row];
      const std::string blanks(column.width() - grade::character_count(cell), ' ');
      line += (line.empty() ? "" : std::string(kColumnGap, ' ')) +
              (column.is_words ? cell + blanks : blanks + cell);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text + std::to_string(result.runs.size()) + " runs, " + std::to_string(result.ended()) +
         " ended, " + std::to_string(result.passed()) + " passed\n";
}

void write_results(const BatchResult& result, const std::vector<GroupSummary>& groups,
                   const fs::path& out) {
  grade::write_text_file(out / "results.csv", results_csv(result));
  grade::write_text_file(out / "statistics.csv", statistics_csv(result.batch, groups));
  grade::write_text_file(out / "batch.json", json_text(result, groups));
  write_charts(result.batch, groups, out / "charts");
}

}  // namespace playpen::batch
