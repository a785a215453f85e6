// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/results.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "course/html_text.h"
#include "grade/rubric.h"
#include "grade/run_record.h"
#include "grade/sight.h"
#include "grade/text.h"
#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;
using grade::begins_character;
using grade::character_count;
using grade::csv_value;
using nlohmann::ordered_json;

std::string points_text(double points) { return sim::fixed_text(points, 1); }

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + plain_text(part);
  return text;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + html_escaped(value) + '"';
}

std::string time_text(double seconds) { return sim::fixed_text(seconds, 3); }

std::string run_name(const grade::GradedRun& run) {
  return run.world + " seed " + std::to_string(run.seed);
}

/// A test suite of a JUnit file, and its numbers.
class JunitSuite {
 public:
  void add_case(const std::string& group, const std::string& name, double seconds,
                const char* element, const std::vector<std::string>& reasons) {
    ++tests_;
    seconds_ += seconds;
    cases_ += "    <testcase" + attribute("classname", group) + attribute("name", name) +
              attribute("time", time_text(seconds));
    if (reasons.empty()) {
      cases_ += "/>\n";
      return;
    }
    ++(std::strcmp(element, "error") == 0 ? errors_ : failures_);
    cases_ += std::string(">\n      <") + element + attribute("message", reasons.front()) + ">" +
              html_escaped(joined(reasons, "; ")) + "</" + element + ">\n    </testcase>\n";
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    return "  <testsuite" + attribute("name", name) + numbers() + ">\n" + cases_ +
           "  </testsuite>\n";
  }
  /// The attributes of the suite.
  [[nodiscard]] std::string numbers() const {
    return attribute("tests", std::to_string(tests_)) +
           attribute("failures", std::to_string(failures_)) +
           attribute("errors", std::to_string(errors_)) + attribute("time", time_text(seconds_));
  }
  void count(const JunitSuite& other) {
    tests_ += other.tests_;
    failures_ += other.failures_;
    errors_ += other.errors_;
    seconds_ += other.seconds_;
  }

 private:
  std::string cases_;
  std::size_t tests_ = 0;
  std::size_t failures_ = 0;
  std::size_t errors_ = 0;
  double seconds_ = 0.0;
};

JunitSuite suite_of(const SubmissionResult& submission) {
  JunitSuite suite;
  const Build& build = submission.build;
  suite.add_case(submission.id, "build", build.wall_time_s, "error",
                 build.built ? std::vector<std::string>{} : std::vector{build.reason});
  for (const grade::Grade& grade : submission.grades) {
    for (const grade::GradedRun& run : grade.runs) {
      suite.add_case(submission.id + '.' + grade.task.name, run_name(run), run.wall_time_s,
                     "failure", reasons_of(run));
    }
  }
  return suite;
}

ordered_json to_json(const SubmissionResult& submission) {
  ordered_json grades = ordered_json::array();
  for (const grade::Grade& grade : submission.grades) {
    ordered_json runs = ordered_json::array();
    for (const grade::GradedRun& run : grade.runs) {
      ordered_json document = ordered_json::parse(grade::run_text(run));
      document["points"] = points_of(grade.task, run).total;
      runs.push_back(std::move(document));
    }
    grades.push_back({{"task", grade.task.name},
                      {"passed", grade.passed() == grade.runs.size()},
                      {"points", mean_points(grade)},
                      {"most_points", maximum_points(grade.task)},
                      {"runs", runs}});
  }
  const Build& build = submission.build;
  return {{"id", plain_text(submission.id)},
          {"name", plain_text(submission.name)},
          {"folder", submission.folder},
          {"handed_in", submission.handed_in},
          {"points", submission.points},
          {"most_points", submission.most_points},
          {"runs", submission.runs()},
          {"passed", submission.passed()},
          {"reason", main_reason(submission)},
          {"note", submission.note},
          {"build",
           {{"built", build.built},
            {"reason", plain_text(build.reason)},
            {"program", plain_text(build.program)},
            {"log", build.log},
            {"wall_time", build.wall_time_s}}},
          {"tasks", grades}};
}

std::string dumped(const ordered_json& document) {
  return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

/// A text of a column, whose width is counted in characters.
std::string padded(const std::string& text, std::size_t width, bool is_number) {
  const std::size_t length = character_count(text);
  const std::string blanks(length < width ? width - length : 0, ' ');
  return is_number ? blanks + text : text + blanks;
}

std::string cut(const std::string& text, std::size_t width) {
  if (character_count(text) <= width) return text;
  constexpr std::size_t kLeast = 4;
  std::string result;
  std::size_t characters = 0;
  for (const char c : text) {
    if (begins_character(c) && ++characters + 3 > std::max(width, kLeast)) break;
    result += c;
  }
  return result + "...";
}

}  // namespace

std::string main_reason(const SubmissionResult& submission) {
  if (!submission.build.built) return plain_text(submission.build.reason);
  std::vector<std::pair<std::string, std::size_t>> reasons;
  std::size_t failed = 0;
  for (const grade::Grade& grade : submission.grades) {
    for (const grade::GradedRun& run : grade.runs) {
      if (run.passed()) continue;
      ++failed;
      const std::string& fault = run.faults.front();
      const auto known = std::find_if(reasons.begin(), reasons.end(),
                                      [&fault](const auto& r) { return r.first == fault; });
      if (known == reasons.end()) {
        reasons.emplace_back(fault, 1);
      } else {
        ++known->second;
      }
    }
  }
  if (failed == 0) return "";
  const auto most =
      std::max_element(reasons.begin(), reasons.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (submission.runs() == 1) return plain_text(most->first);
  return plain_text(most->first) + " (" + std::to_string(most->second) + " of " +
         std::to_string(submission.runs()) + " runs)";
}

std::vector<std::string> reasons_of(const grade::GradedRun& run) {
  std::vector<std::string> reasons = run.faults;
  if (const auto& first = run.measures.first_collision; first && !run.passed()) {
    const std::string text = grade::contact_text(*first);
    const auto tells = [&text](const std::string& fault) { return fault.ends_with(text); };
    if (std::none_of(reasons.begin(), reasons.end(), tells)) reasons.push_back(text);
  }
  switch (run.ending) {
    case grade::Ending::kSignal:
      reasons.emplace_back("the program crashed: a debugger shows the line");
      break;
    case grade::Ending::kTimedOut:
      reasons.emplace_back(
          "the program took too long: look for loops that never read from the robot");
      break;
    case grade::Ending::kTooMuchOutput:
      reasons.emplace_back("the program wrote too much: print less in each step");
      break;
    default:
      break;
  }
  return reasons;
}

std::vector<std::size_t> ranking(const ClassResult& result) {
  std::vector<std::size_t> order(result.submissions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&result](std::size_t a, std::size_t b) {
    return result.submissions[a].points > result.submissions[b].points;
  });
  return order;
}

std::string class_table(const ClassResult& result, std::size_t columns) {
  std::vector<std::vector<std::string>> rows = {{"id", "name", "points", "passed", "reason"}};
  for (const std::size_t index : ranking(result)) {
    const SubmissionResult& one = result.submissions[index];
    rows.push_back(
        {plain_text(one.id), plain_text(one.name), points_text(one.points),
         one.runs() == 0 ? "-" : std::to_string(one.passed()) + " of " + std::to_string(one.runs()),
         main_reason(one)});
  }
  constexpr std::size_t kReason = 4;
  constexpr std::size_t kName = 1;
  constexpr std::size_t kPoints = 2;
  std::vector<std::size_t> widths(kReason, 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < kReason; ++i) {
      widths[i] = std::max(widths[i], character_count(row[i]));
    }
  }
  const bool names = std::any_of(rows.begin() + 1, rows.end(),
                                 [](const auto& row) { return !row[kName].empty(); });
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < kReason; ++i) {
      if (i != kName || names) line += padded(row[i], widths[i], i == kPoints) + "  ";
    }
    const std::size_t used = character_count(line);
    line += cut(row[kReason], columns > used ? columns - used : 0);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  constexpr std::size_t kMostPairs = 20;
  const std::size_t pairs = std::min(result.pairs.size(), kMostPairs);
  for (std::size_t i = 0; i < pairs; ++i) {
    const LikePair& pair = result.pairs[i];
    text += "alike: " + plain_text(result.submissions[pair.first].id) + " and " +
            plain_text(result.submissions[pair.second].id) + " in " + std::to_string(pair.alike) +
            " of " + std::to_string(pair.runs) + " runs\n";
  }
  if (pairs < result.pairs.size()) {
    text += "alike: " + std::to_string(result.pairs.size() - pairs) + " more pairs\n";
  }
  std::size_t built = 0;
  std::size_t all = 0;
  for (const SubmissionResult& one : result.submissions) {
    built += one.build.built ? 1 : 0;
    all += one.runs() > 0 && one.passed() == one.runs() ? 1 : 0;
  }
  return text + std::to_string(result.submissions.size()) + " submissions, " +
         std::to_string(built) + " compiled, " + std::to_string(all) + " passed all runs\n";
}

std::string csv_text(const ClassResult& result) {
  std::string text = "id,name,points,most_points,passed,runs,handed_in,compiled,reason";
  for (const grade::Task& task : result.tasks) text += ',' + csv_value(task.name + "_passed");
  text += "\r\n";
  for (const SubmissionResult& one : result.submissions) {
    text += csv_value(one.id) + ',' + csv_value(one.name) + ',' + sim::shortest_text(one.points) +
            ',' + sim::shortest_text(one.most_points) + ',' + std::to_string(one.passed()) + ',' +
            std::to_string(one.runs()) + ',' + (one.handed_in ? "yes" : "no") + ',' +
            (one.build.built ? "yes" : "no") + ',' + csv_value(main_reason(one));
    for (std::size_t task = 0; task < result.tasks.size(); ++task) {
      text += ',' + std::to_string(task < one.grades.size() ? one.grades[task].passed() : 0);
    }
    text += "\r\n";
  }
  return text;
}

std::string json_text(const ClassResult& result) {
  ordered_json tasks = ordered_json::array();
  for (const grade::Task& task : result.tasks) tasks.push_back(task.name);
  ordered_json submissions = ordered_json::array();
  for (const SubmissionResult& one : result.submissions) submissions.push_back(to_json(one));
  ordered_json pairs = ordered_json::array();
  for (const LikePair& pair : result.pairs) {
    pairs.push_back({{"first", plain_text(result.submissions[pair.first].id)},
                     {"second", plain_text(result.submissions[pair.second].id)},
                     {"runs", pair.runs},
                     {"alike", pair.alike},
                     {"likeness", pair.likeness},
                     {"threshold", pair.threshold},
                     {"shared", pair.shared_m},
                     {"distance", pair.distance_m},
                     {"picture", pair.picture}});
  }
  return dumped({{"tasks", tasks},
                 {"isolated", result.isolated},
                 {"complete", result.complete},
                 {"submissions", submissions},
                 {"alike", pairs}});
}

std::string junit_text(const ClassResult& result) {
  JunitSuite all;
  std::string suites;
  for (const SubmissionResult& one : result.submissions) {
    const JunitSuite suite = suite_of(one);
    all.count(suite);
    suites += suite.text(one.id);
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"playpen class\"" +
         all.numbers() + ">\n" + suites + "</testsuites>\n";
}

std::string gradescope_text(const SubmissionResult& submission) {
  ordered_json tests = ordered_json::array();
  const auto add = [&tests](const std::string& name, bool passed,
                            const std::string& output) -> ordered_json& {
    return tests.emplace_back(ordered_json{{"name", plain_text(name)},
                                           {"status", passed ? "passed" : "failed"},
                                           {"output", plain_text(output)}});
  };
  add("build", submission.build.built, submission.build.reason);
  double wall_time_s = submission.build.wall_time_s;
  for (const grade::Grade& grade : submission.grades) {
    for (const grade::GradedRun& run : grade.runs) {
      wall_time_s += run.wall_time_s;
      ordered_json& test =
          add(grade.task.name + ": " + run_name(run), run.passed(), joined(reasons_of(run), "; "));
      // The shares of the runs make up the whole score.
      const auto runs = static_cast<double>(grade.runs.size());
      test["score"] = points_of(grade.task, run).total / runs;
      test["max_score"] = maximum_points(grade.task) / runs;
    }
  }
  return dumped(
      {{"score", submission.points},
       {"execution_time", wall_time_s},
       {"output", submission.note.empty() ? main_reason(submission)
                                          : submission.note + ". " + main_reason(submission)},
       {"output_format", "text"},
       {"test_output_format", "text"},
       {"stdout_visibility", "hidden"},
       {"tests", tests}});
}

void write_results(const ClassResult& result, const fs::path& folder) {
  grade::write_text_file(folder / "class.json", json_text(result));
  grade::write_text_file(folder / "results.csv", csv_text(result));
  grade::write_text_file(folder / "junit.xml", junit_text(result));
  for (const SubmissionResult& one : result.submissions) {
    grade::write_text_file(folder / one.folder / "results.json", gradescope_text(one));
  }
}

}  // namespace playpen::course
