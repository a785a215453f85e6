// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/html_report.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "course/html_page.h"
#include "course/html_style.h"
#include "course/html_text.h"
#include "course/results.h"
#include "grade/text.h"
#include "sim/core/number_text.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

std::string link_to(const SubmissionResult& submission) {
  return "<a href=\"" + url_of(fs::path(submission.folder) / "index.html") + "\">" +
         isolated_name(submission.id) + "</a>";
}

// The number of pairs that a submission belongs to.
std::ptrdiff_t pairs_of(const ClassResult& result, std::size_t index) {
  return std::count_if(result.pairs.begin(), result.pairs.end(), [index](const LikePair& pair) {
    return pair.first == index || pair.second == index;
  });
}

// The marks of the pairs that a submission belongs to.
std::string pair_marks(const ClassResult& result, std::size_t index) {
  constexpr std::size_t kMostMarks = 3;
  std::string marks;
  std::size_t count = 0;
  for (const LikePair& pair : result.pairs) {
    if (pair.first != index && pair.second != index) continue;
    if (++count > kMostMarks) continue;
    const std::size_t other = pair.first == index ? pair.second : pair.first;
    marks += (marks.empty() ? "" : " ") + std::string("<a class=\"like\" href=\"#alike\">like ") +
             isolated_name(result.submissions[other].id) + "</a>";
  }
  if (count > kMostMarks) {
    marks +=
        " <a class=\"like\" href=\"#alike\">" + std::to_string(count - kMostMarks) + " more</a>";
  }
  return marks;
}

std::string ranking_row(const ClassResult& result, std::size_t rank, std::size_t index) {
  const SubmissionResult& submission = result.submissions[index];
  const std::size_t runs = submission.runs();
  const std::string passed =
      runs == 0 ? "" : std::to_string(submission.passed()) + " of " + std::to_string(runs);
  const auto cell = [](const std::string& kind, const std::string& value,
                       const std::string& content) {
    return "<td role=\"cell\" class=\"" + kind + "\" data-value=\"" + value + "\">" + content +
           "</td>";
  };
  return "<tr role=\"row\">" + cell("number", std::to_string(rank), std::to_string(rank)) +
         cell("name", html_escaped(submission.id), link_to(submission)) +
         cell("person", html_escaped(submission.name),
              submission.name.empty() ? "" : isolated_name(submission.name)) +
         cell("number points", sim::shortest_text(submission.points),
              sim::fixed_text(submission.points, 1)) +
         cell("number passed", std::to_string(submission.passed()), passed) +
         cell(submission.build.built ? "state nowrap ok" : "state nowrap", build_state(submission),
              state_mark(submission)) +
         cell("reason", html_escaped(main_reason(submission)),
              html_escaped(main_reason(submission))) +
         cell("alike", std::to_string(pairs_of(result, index)), pair_marks(result, index)) +
         "</tr>\n";
}

std::string ranking_table(const ClassResult& result) {
  struct Heading {
    const char* words;
    bool is_number;  ///< sorted by number
    const char* kind;
  };
  constexpr Heading kHeadings[] = {{"Rank", true, "number"},    {"Submission", false, "name"},
                                   {"Name", false, "person"},   {"Points", true, "number"},
                                   {"Passed", true, "number"},  {"Program", false, "state"},
                                   {"Reason", false, "reason"}, {"Alike", true, "alike"}};
  std::string html =
      "<div class=\"wide\" role=\"region\" aria-labelledby=\"ranking\" tabindex=\"0\">\n"
      "<table class=\"ranking\" role=\"table\">\n"
      "<caption>Press a heading to sort by it.</caption>\n"
      "<thead role=\"rowgroup\"><tr role=\"row\">";
  for (const Heading& heading : kHeadings) {
    html += std::string("<th role=\"columnheader\" scope=\"col\" class=\"") + heading.kind + '"' +
            (heading.is_number ? " data-numeric" : "") +
            (std::strcmp(heading.words, "Rank") == 0 ? " aria-sort=\"ascending\"" : "") +
            "><button type=\"button\">" + heading.words + "</button></th>";
  }
  html += "</tr></thead>\n<tbody role=\"rowgroup\">\n";
  const std::vector<std::size_t> order = ranking(result);
  std::size_t rank = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    // Equal points have equal ranks.
    const auto points = [&](std::size_t k) { return result.submissions[order[k]].points; };
    if (i == 0 || points(i) < points(i - 1)) rank = i + 1;
    html += ranking_row(result, rank, order[i]);
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

std::string pairs_section(const ClassResult& result) {
  if (result.pairs.empty()) return "";
  std::string html =
      "<h2 id=\"alike\">Programs that drive alike</h2>\n"
      "<p>The robots of these pairs drove the same way, and not as the template or another "
      "baseline does. That is a reason to compare both sources, not a verdict.</p>\n"
      "<div class=\"pictures\">\n";
  std::size_t shown = 0;
  for (const LikePair& pair : result.pairs) {
    if (pair.picture.empty()) continue;
    ++shown;
    const SubmissionResult& first = result.submissions[pair.first];
    const SubmissionResult& second = result.submissions[pair.second];
    const std::string url = url_of(pair.picture);
    html += "<figure><a href=\"" + url + "\"><img loading=\"lazy\" src=\"" + url +
            "\" alt=\"Trajectories of " + html_escaped(first.id) + " and " +
            html_escaped(second.id) + " over each other\"></a>";
    html += "<figcaption>" + link_to(first) + " and " + link_to(second) + ": alike in " +
            std::to_string(pair.alike) + " of " + std::to_string(pair.runs) +
            " runs</figcaption></figure>\n";
  }
  html += "</div>\n";
  if (shown < result.pairs.size()) {
    html += "<p>" + std::to_string(result.pairs.size() - shown) +
            " more pairs are in <a href=\"class.json\">class.json</a>.</p>\n";
  }
  return html;
}

std::string class_facts(const ClassResult& result) {
  std::size_t built = 0;
  std::size_t passed = 0;
  for (const SubmissionResult& submission : result.submissions) {
    built += submission.build.built ? 1 : 0;
    passed += submission.runs() > 0 && submission.passed() == submission.runs() ? 1 : 0;
  }
  std::string html = "<ul class=\"facts\">" + fact(result.submissions.size(), "submissions") +
                     fact(built, "compile") + fact(passed, "pass all runs");
  if (!result.pairs.empty()) {
    html += "<li><b>" + std::to_string(result.pairs.size()) +
            "</b> <a href=\"#alike\">pairs drive alike</a></li>";
  }
  html += "</ul>\n";
  if (!result.complete) {
    html +=
        "<p class=\"bad\">Not complete: the grading was interrupted. The same command goes on "
        "from there.</p>\n";
  }
  if (!result.isolated) {
    html +=
        "<p class=\"bad\">The programs ran without a sandbox: a program that is made to "
        "deceive may have changed results.</p>\n";
  }
  return html;
}

}  // namespace

std::string overview_page(const ClassResult& result) {
  const std::string title = task_names(result);
  std::string body = "<main>\n<h1>" + title + "</h1>\n" + class_facts(result) +
                     "<h2 id=\"ranking\">Ranking</h2>\n" + ranking_table(result) +
                     pairs_section(result) + "</main>\n";
  return html_page(title, body, kSortScript);
}

void write_html_report(const ClassResult& result, const fs::path& folder) {
  for (std::size_t i = 0; i < result.submissions.size(); ++i) {
    grade::write_text_file(folder / result.submissions[i].folder / "index.html",
                           submission_page(result, i, folder));
  }
  grade::write_text_file(folder / "index.html", overview_page(result));
}

}  // namespace playpen::course
