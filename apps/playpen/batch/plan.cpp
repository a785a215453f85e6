// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/plan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/io/reader.h"
#include "sim/io/settings_file.h"

namespace playpen::batch {
namespace {

using nlohmann::ordered_json;
using sim::io::NumberRange;
using sim::io::Reader;

constexpr std::size_t kMostItems = 10'000;  ///< of a list
constexpr NumberRange kTime{0.0, 1e9, true, "s"};
constexpr NumberRange kValue{-1e12, 1e12, false, ""};

/// A number with at most 12 digits, without the error of adding decimal fractions: 0.3, not
/// 0.30000000000000004.
std::string decimal_text(double value) {
  constexpr int kDigits = 12;
  std::array<char, 32> text{};
  const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value,
                                                 std::chars_format::general, kDigits);
  double rounded = 0.0;
  std::from_chars(text.data(), end.ptr, rounded);
  return sim::shortest_text(rounded + 0.0);
}

/// The values of {"from", "to", "step"} or {"from", "to", "count"}.
std::vector<std::string> range_values(Reader& range) {
  static_cast<void>(range.require("from", "the first value"));
  static_cast<void>(range.require("to", "the last value"));
  const double from = range.number("from", 0.0, kValue);
  const double to = range.number("to", 0.0, kValue);
  const bool has_step = range.has("step");
  const bool has_count = range.has("count");
  const double step = range.number("step", 1.0, {0.0, 1e12, true, ""});
  const std::int64_t asked = range.integer("count", 2, 1, static_cast<std::int64_t>(kMostItems));
  range.finish();
  if (has_step == has_count) {
    range.issue("plan/range", "either \"step\" or \"count\"", has_step ? "both" : "neither");
    return {};
  }
  if (to < from) {
    range.issue("plan/range", "a \"to\" that is not below \"from\"", sim::shortest_text(to));
    return {};
  }
  constexpr double kSlack = 1e-9;  // of a step
  const double steps = has_step ? std::floor((to - from) / step + kSlack)
                                : static_cast<double>(std::max<std::int64_t>(asked - 1, 1));
  if (steps >= static_cast<double>(kMostItems)) {
    range.issue("plan/range", "at most " + std::to_string(kMostItems) + " values",
                sim::fixed_text(steps + 1.0, 0));
    return {};
  }
  const auto count =
      has_count ? static_cast<std::size_t>(asked) : static_cast<std::size_t>(steps) + 1;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double along = static_cast<double>(i);
    values.push_back(
        decimal_text(has_step ? from + along * step : from + along * ((to - from) / steps)));
  }
  return values;
}

/// Whether a text is a JSON pointer to something in a document.
bool is_pointer(const std::string& text) {
  if (text.size() < 2 || text.front() != '/') return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '~' && (i + 1 == text.size() || (text[i + 1] != '0' && text[i + 1] != '1'))) {
      return false;
    }
  }
  return true;
}

class PlanReader {
 public:
  /// @param document  the same file, for values that may be anything.
  PlanReader(std::string file, const ordered_json& document) : document_(document) {
    plan_.file = std::move(file);
  }

  void read(Reader& root) {
    if (!root.expect_object()) return;
    static_cast<void>(root.string("$schema", ""));
    static_cast<void>(root.string("description", ""));
    plan_.task = root.string("task", "");
    read_programs(root);
    read_worlds(root);
    read_seeds(root);
    read_parameters(root);
    if (root.has("duration")) plan_.duration_s = root.number("duration", 1.0, kTime);
    if (root.has("timeout")) plan_.timeout_s = root.number("timeout", 1.0, kTime);
    if (root.has("realism")) {
      std::vector<std::string> names;
      for (const sim::Realism level : sim::kRealismLevels) names.emplace_back(to_string(level));
      plan_.realism = sim::parse_realism(root.choice("realism", names.front(), names));
    }
    root.finish();
    check_size(root);
  }

  [[nodiscard]] Plan take() { return std::move(plan_); }

 private:
  void read_programs(Reader& root) {
    if (!root.require("programs", "a list of programs")) return;
    for (Reader& element : root.array("programs", kMostItems)) {
      PlannedProgram program;
      if (element.is_string()) {
        program.command = {element.scalar_text().value_or("")};
      } else if (element.is_object()) {
        if (element.require("command", "a list: the program and its arguments")) {
          for (Reader& word : element.array("command", kMostItems)) {
            if (!word.is_string()) {
              word.issue("world/wrong-type", "a text in double quotes",
                         word.description_for_message());
            }
            program.command.push_back(word.scalar_text().value_or(""));
          }
        }
        program.name = element.string("name", "");
        element.finish();
      }
      if (program.command.empty() || program.command.front().empty()) {
        element.issue("plan/program", "the path of a program, or {\"command\": [...]}",
                      element.description_for_message());
        continue;
      }
      if (program.name.empty()) {
        program.name = std::filesystem::path(program.command.front()).filename().string();
      }
      const bool is_known = std::any_of(
          plan_.programs.begin(), plan_.programs.end(),
          [&program](const PlannedProgram& other) { return other.name == program.name; });
      if (is_known) {
        element.issue("plan/duplicate-name", "programs with names of their own",
                      '"' + program.name + "\" a second time", "give it a \"name\"");
        continue;
      }
      plan_.programs.push_back(std::move(program));
    }
    require_some(root, "programs");
  }

  void read_worlds(Reader& root) {
    if (!root.has("worlds")) {
      if (plan_.task.empty()) static_cast<void>(root.require("worlds", "a list of worlds"));
      return;
    }
    for (Reader& element : root.array("worlds", kMostItems)) {
      if (!element.is_string()) {
        element.issue("world/wrong-type", "the name or file of a world in double quotes",
                      element.description_for_message());
      }
      plan_.worlds.push_back(element.scalar_text().value_or(""));
    }
    require_some(root, "worlds");
  }

  /// N: the seeds 1 to N; or a list of seeds.
  void read_seeds(Reader& root) {
    std::optional<Reader> seeds = root.child("seeds");
    if (!seeds) {
      if (plan_.task.empty()) plan_.seeds = {1};
      return;
    }
    if (seeds->is_number()) {
      const std::int64_t count = root.integer("seeds", 1, 1, static_cast<std::int64_t>(kMostItems));
      for (std::int64_t seed = 1; seed <= count; ++seed) {
        plan_.seeds.push_back(static_cast<std::uint64_t>(seed));
      }
      return;
    }
    for (const Reader& element : root.array("seeds", kMostItems)) {
      const std::string text = element.scalar_text().value_or("");
      const char* const end = text.data() + text.size();
      std::uint64_t seed = 0;
      const auto [rest, error] = std::from_chars(text.data(), end, seed);
      if (!element.is_number() || error != std::errc() || rest != end ||
          std::find(plan_.seeds.begin(), plan_.seeds.end(), seed) != plan_.seeds.end()) {
        seeds->issue("plan/seeds", "a number of seeds, or a list of different whole numbers",
                     element.description_for_message());
        return;
      }
      plan_.seeds.push_back(seed);
    }
    require_some(root, "seeds");
  }

  void read_parameters(Reader& root) {
    std::optional<Reader> all = root.object("parameters");
    if (!all) return;
    for (const std::string& pointer : all->keys()) {
      Parameter parameter{pointer, {}};
      if (!is_pointer(pointer)) {
        all->issue("plan/pointer", "a JSON pointer into the world file, \"/robots/0/pose/x\"",
                   '"' + pointer + '"', "", pointer);
      }
      std::optional<Reader> values = all->child(pointer);
      if (values->is_object()) {
        parameter.values = range_values(*values);
      } else {
        static_cast<void>(all->array(pointer, kMostItems));  // an issue unless it is one
        parameter.values = raw_values(pointer);
        if (values->is_array()) require_some(*all, pointer);
      }
      plan_.parameters.push_back(std::move(parameter));
    }
    all->finish();
  }

  /// The elements of a list of values, as JSON.
  [[nodiscard]] std::vector<std::string> raw_values(const std::string& pointer) const {
    std::vector<std::string> values;
    const auto parameters = document_.find("parameters");
    if (parameters == document_.end() || !parameters->is_object()) return values;
    const auto list = parameters->find(pointer);
    if (list == parameters->end() || !list->is_array()) return values;
    for (const ordered_json& value : *list) values.push_back(value.dump());
    return values;
  }

  /// Records an issue if a list is empty.
  static void require_some(Reader& parent, std::string_view key) {
    const std::optional<Reader> list = parent.child(key);
    if (list && list->is_array() && list->elements().empty()) {
      parent.issue("world/out-of-range", "at least one element", list->description_for_message(),
                   "", key);
    }
  }

  /// Refuses plans whose runs no disk could hold.
  void check_size(Reader& root) {
    double units = static_cast<double>(plan_.programs.size()) *
                   static_cast<double>(std::max<std::size_t>(plan_.worlds.size(), 1)) *
                   static_cast<double>(std::max<std::size_t>(plan_.seeds.size(), 1));
    for (const Parameter& parameter : plan_.parameters) {
      units *= static_cast<double>(std::max<std::size_t>(parameter.values.size(), 1));
    }
    if (units > static_cast<double>(kMostUnits)) {
      root.issue("plan/too-many-runs", "at most " + std::to_string(kMostUnits) + " runs",
                 sim::fixed_text(units, 0));
    }
  }

  const ordered_json& document_;
  Plan plan_;
};

}  // namespace

Plan read_plan_text(std::string_view text, const std::string& file) {
  const ordered_json document = ordered_json::parse(text, nullptr, /*allow_exceptions=*/false,
                                                    /*ignore_comments=*/true);
  PlanReader reader(file, document);
  sim::io::read_settings_text(text, file, "plan", [&reader](Reader& root) { reader.read(root); });
  return reader.take();
}

Plan read_plan(const std::string& path) {
  std::string text;
  if (sim::read_whole_file(path, {}, text)) {
    sim::io::read_settings(path, "plan", [](Reader& /*root*/) {});  // throws
  }
  return read_plan_text(text, path);
}

}  // namespace playpen::batch
