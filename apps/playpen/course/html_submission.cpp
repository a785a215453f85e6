// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "course/html_page.h"
#include "course/html_report.h"
#include "course/html_text.h"
#include "course/results.h"
#include "sim/core/number_text.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;
using grade::GradedRun;

constexpr std::size_t kOutputLines = 40;
constexpr std::size_t kCompilerLines = 120;

std::string name_of_run(const GradedRun& run) {
  return html_escaped(run.world) + ", seed " + std::to_string(run.seed);
}

// Explanations of the headings of the table of runs.
std::string heading_words(const std::string& heading) {
  static const std::map<std::string, std::string> kWords = {{"", "verdict"},
                                                            {"cover", "coverage"},
                                                            {"correct", "map correctness"},
                                                            {"path", "path [m]"},
                                                            {"ratio", "path ratio"},
                                                            {"coll", "collisions"},
                                                            {"clear", "clearance [m]"},
                                                            {"sim", "simulated [s]"}};
  const auto words = kWords.find(heading);
  return words == kWords.end() ? heading : words->second;
}

std::string runs_table(const grade::Grade& grade) {
  const std::vector<std::vector<std::string>> cells = grade::table_cells(grade);
  std::string html =
      "<div class=\"wide\" role=\"region\" aria-label=\"Runs\" "
      "tabindex=\"0\">\n<table>\n<caption>" +
      std::to_string(grade.passed()) + " of " + std::to_string(grade.runs.size()) +
      " runs passed</caption>\n<thead><tr>";
  for (const std::string& heading : cells.front()) {
    html += "<th scope=\"col\">" + heading_words(heading) + "</th>";
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 1; r < cells.size(); ++r) {
    html += "<tr>";
    for (std::size_t c = 0; c < cells[r].size(); ++c) {
      const std::string& cell = cells[r][c];
      if (cells.front()[c].empty()) {
        const bool passed = cell == "pass";
        html += std::string("<td class=\"") + (passed ? "good" : "bad") + "\">" +
                (passed ? "passed" : "failed") + "</td>";
      } else {
        html += "<td class=\"nowrap\">" + html_escaped(cell) + "</td>";
      }
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

// All reasons of a grade, each once, with its runs.
std::string reasons_list(const grade::Grade& grade) {
  std::vector<std::pair<std::string, std::vector<const GradedRun*>>> reasons;
  for (const GradedRun& run : grade.runs) {
    for (const std::string& reason : reasons_of(run)) {
      auto known = std::find_if(reasons.begin(), reasons.end(),
                                [&](const auto& entry) { return entry.first == reason; });
      if (known == reasons.end()) known = reasons.insert(known, {reason, {}});
      known->second.push_back(&run);
    }
  }
  if (reasons.empty()) return "";
  constexpr std::size_t kMostNamed = 5;
  std::string html = "<h3>Why runs failed</h3>\n<ul>\n";
  for (const auto& [reason, runs] : reasons) {
    html += "<li>" + html_escaped(reason) + " <span class=\"faint\">(";
    for (std::size_t i = 0; i < std::min(runs.size(), kMostNamed); ++i) {
      html += (i > 0 ? "; " : "") + name_of_run(*runs[i]);
    }
    if (runs.size() > kMostNamed) {
      html += "; and " + std::to_string(runs.size() - kMostNamed) + " more";
    }
    html += ")</span></li>\n";
  }
  return html + "</ul>\n";
}

// Whether a run is better than another one: it passed, has fewer faults, more points, a better map,
// fewer collisions, or a longer distance.
bool is_better(const GradedRun& a, const GradedRun& b) {
  const auto merit = [](const GradedRun& run) {
    const grade::Measures& m = run.measures;
    return std::vector<double>{-static_cast<double>(run.faults.size()),
                               m.score.value_or(0.0),
                               m.reached.value_or(false) ? 1.0 : 0.0,
                               m.coverage.value_or(0.0),
                               -static_cast<double>(m.collisions.value_or(0)),
                               -m.path_ratio.value_or(0.0),
                               m.distance_m.value_or(0.0)};
  };
  return merit(a) > merit(b);
}

// The command that repeats a run.
std::string repeat_command(const ClassResult& result, const SubmissionResult& submission,
                           const grade::Task& task, const GradedRun& run) {
  // Worlds of this person's own are beside the page.
  const std::string world_of_own = "conditions/" + task.name + "/" + run.world + ".json";
  std::vector<std::string> words = {"playpen", "run",
                                    submission.note.empty() ? run.world : world_of_own, "--seed",
                                    std::to_string(run.seed)};
  if (task.duration_s)
    words.insert(words.end(), {"--duration", sim::shortest_text(*task.duration_s)});
  if (run.asked.realism != "course") words.insert(words.end(), {"--realism", run.asked.realism});
  if (result.isolated) words.emplace_back("--isolated=required");
  const std::string program = fs::path(submission.build.program).filename().string();
  words.insert(words.end(), {"--", "./" + program});
  words.insert(words.end(), task.arguments.begin(), task.arguments.end());
  for (const grade::TaskWorld& world : task.worlds) {
    if (grade::world_name(world.file) != run.world) continue;
    words.insert(words.end(), world.arguments.begin(), world.arguments.end());
  }
  std::string command;
  for (const std::string& word : words)
    command += (command.empty() ? "" : " ") + grade::shell_word(word);
  return command;
}

// The files of a grade's runs, seen from the page of the submission.
class RunFiles {
 public:
  RunFiles(const fs::path& submission, const grade::Grade& grade)
      : submission_(submission), task_(grade.task.name) {}

  [[nodiscard]] fs::path path(const GradedRun& run, const char* name) const {
    return submission_ / url_path(run, name);
  }
  [[nodiscard]] std::string url(const GradedRun& run, const char* name) const {
    return url_of(url_path(run, name));
  }
  [[nodiscard]] bool has(const GradedRun& run, const char* name) const {
    std::error_code error;
    return fs::symlink_status(path(run, name), error).type() == fs::file_type::regular;
  }

 private:
  [[nodiscard]] fs::path url_path(const GradedRun& run, const char* name) const {
    return fs::path(task_) / run.folder / name;
  }

  fs::path submission_;
  std::string task_;
};

// A picture of a run that is a link to itself.
std::string picture_link(const std::string& url, const std::string& words) {
  return "<a href=\"" + url + "\"><img loading=\"lazy\" src=\"" + url + "\" alt=\"" + words +
         "\"></a>";
}

// The link to the replay of a run, if it has one.
std::string replay_link(const RunFiles& files, const GradedRun& run) {
  if (!files.has(run, kReplayFile)) return "";
  return "<p><a href=\"" + files.url(run, kReplayFile) + "\">Replay of " + name_of_run(run) +
         "</a></p>";
}

// @param which  of the runs: "Best run".
std::string caption_of(const GradedRun& run, const std::string& which) {
  return "<figcaption>" + which + ": " + name_of_run(run) + ", " +
         (run.passed() ? "passed" : "failed") + "</figcaption>";
}

std::string figure_of(const RunFiles& files, const GradedRun& run, const std::string& which) {
  constexpr const char* kPicture = "scene.png";
  if (!files.has(run, kPicture)) return "";
  return "<figure>" +
         picture_link(files.url(run, kPicture), "Where the robot drove in " + name_of_run(run)) +
         caption_of(run, which) + replay_link(files, run) + "</figure>\n";
}

// The charts of a run. In narrow windows they can be scrolled, so that their texts stay legible.
std::string charts_of(const RunFiles& files, const GradedRun& run, const std::string& which) {
  if (!files.has(run, kPlotFile)) return "";
  const std::string name = "Charts of " + name_of_run(run);
  std::string words =
      name + ": speed, turn rate, clearance and path length over time, and the trajectory";
  const grade::Measures& m = run.measures;
  if (m.path_length_m) words += "; path " + sim::fixed_text(*m.path_length_m, 1) + " m";
  if (m.collisions) {
    words +=
        ", " + std::to_string(*m.collisions) + (*m.collisions == 1 ? " collision" : " collisions");
  }
  return "<figure class=\"charts\"><div class=\"wide\" role=\"region\" aria-label=\"" + name +
         "\" tabindex=\"0\">" + picture_link(files.url(run, kPlotFile), words) + "</div>" +
         caption_of(run, which) + "</figure>\n";
}

// The pictures of the best and the worst run, and their charts.
std::string figures_of(const RunFiles& files, const grade::Grade& grade) {
  std::string pictures;
  std::string charts;
  const std::vector<const GradedRun*> runs = shown_runs(grade);
  for (const GradedRun* const run : runs) {
    const std::string which = grade.runs.size() == 1 ? "The run"
                              : run == runs.front()  ? "Best run"
                                                     : "Worst run";
    pictures += figure_of(files, *run, which);
    charts += charts_of(files, *run, which);
  }
  std::string html;
  if (!pictures.empty()) {
    html += "<h3>Where the robot drove</h3>\n<div class=\"pictures\">\n" + pictures + "</div>\n";
  }
  if (!charts.empty()) html += "<h3>How the robot drove over time</h3>\n" + charts;
  return html;
}

// @param url  of the whole log.
std::string log_block(const LogTail& log, const std::string& label, const std::string& url) {
  return std::string(log.is_whole ? ""
                                  : "<p>The last lines of <a href=\"" + url +
                                        "\">the whole output</a>:</p>\n") +
         "<pre tabindex=\"0\" role=\"region\" aria-label=\"" + label + "\">" +
         [&] {
           std::string lines;  // html_escaped() replaces line breaks, too
           for (std::size_t begin = 0; begin < log.text.size();) {
             const std::size_t end = std::min(log.text.find('\n', begin), log.text.size());
             lines += html_escaped(log.text.substr(begin, end - begin)) + '\n';
             begin = end + 1;
           }
           return lines;
         }() +
         "</pre>\n";
}

std::string grade_section(const ClassResult& result, const SubmissionResult& submission,
                          const grade::Grade& grade, const fs::path& folder) {
  std::string html = "<h2>" + html_escaped(grade.task.name) + "</h2>\n";
  if (grade.runs.empty()) return html + "<p>There are no runs.</p>\n";
  html += runs_table(grade) + reasons_list(grade);
  const RunFiles files(folder / submission.folder, grade);
  html += figures_of(files, grade);
  const GradedRun* const worst = shown_runs(grade).back();
  if (worst->passed()) return html;
  const LogTail log = tail_of(files.path(*worst, "program.log"), kOutputLines);
  if (!log.text.empty()) {
    html += "<h3>What the program printed in " + name_of_run(*worst) + "</h3>\n" +
            log_block(log, "Output of the program", files.url(*worst, "program.log"));
  }
  if (!submission.build.program.empty()) {
    html += "<h3>To repeat " + name_of_run(*worst) + "</h3>\n<pre tabindex=\"0\">" +
            html_escaped(repeat_command(result, submission, grade.task, *worst)) + "</pre>\n";
  }
  return html;
}

std::string points_text(const SubmissionResult& submission) {
  std::string text = "<li><b>" + sim::fixed_text(submission.points, 1) + "</b> ";
  if (submission.most_points > 0.0)
    text += "of " + sim::fixed_text(submission.most_points, 1) + ' ';
  return text + "points</li>";
}

}  // namespace

std::vector<const GradedRun*> shown_runs(const grade::Grade& grade) {
  if (grade.runs.empty()) return {};
  const auto best = std::min_element(grade.runs.begin(), grade.runs.end(), is_better);
  const auto worst = std::max_element(grade.runs.begin(), grade.runs.end(), is_better);
  if (worst == best) return {&*best};
  return {&*best, &*worst};
}

std::string submission_page(const ClassResult& result, std::size_t index, const fs::path& folder) {
  const SubmissionResult& submission = result.submissions.at(index);
  const std::string title = html_escaped(submission.id);
  // The way back, however deep the folder is.
  const fs::path back = fs::path("index.html").lexically_relative(submission.folder);
  std::string body = "<nav><a href=\"" + url_of(back) +
                     "\">All submissions</a></nav>\n<main>\n<h1>" + isolated_name(submission.id);
  if (!submission.name.empty()) body += ": " + isolated_name(submission.name);
  body += "</h1>\n<ul class=\"facts\">" + points_text(submission);
  if (submission.runs() > 0) {
    body += "<li><b>" + std::to_string(submission.passed()) + "</b> of " +
            std::to_string(submission.runs()) + " runs passed</li>";
  }
  // The sentence below says why there is no program.
  if (submission.build.built) body += "<li>" + state_mark(submission) + "</li>";
  body += "</ul>\n";
  if (!submission.note.empty()) body += "<p>" + html_escaped(submission.note) + "</p>\n";
  if (!submission.build.built) {
    body +=
        "<p class=\"bad\">There is no program: " + html_escaped(submission.build.reason) + "</p>\n";
  }
  for (const grade::Grade& grade : submission.grades) {
    body += grade_section(result, submission, grade, folder);
  }
  if (!submission.build.log.empty()) {
    const LogTail log = tail_of(folder / submission.folder / submission.build.log, kCompilerLines);
    body +=
        "<h2>What the compiler printed</h2>\n" +
        (log.text.empty() ? std::string("<p>Nothing.</p>\n")
                          : log_block(log, "Output of the compiler", url_of(submission.build.log)));
  }
  return html_page(title, body + "</main>\n", "");
}

}  // namespace playpen::course
