// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/html_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "course/html_text.h"
#include "temporary_folder.h"

namespace {

using namespace playpen;
using namespace playpen::course;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// A strict reader of the part of HTML that the report uses: what is wrong with a page, or "".
// Each element is closed in order, attributes have quoted values or none, ids are unique, and no
// text contains a bare & or <.
class PageChecker {
 public:
  explicit PageChecker(std::string page) : page_(std::move(page)) {}

  std::string problem() {
    if (!page_.starts_with("<!DOCTYPE html>\n")) return "no doctype";
    at_ = 15;
    while (at_ < page_.size() && problem_.empty()) {
      if (page_[at_] == '<') {
        read_tag();
      } else {
        read_text();
      }
    }
    if (problem_.empty() && !open_.empty()) return "open at the end: " + open_.back();
    return problem_;
  }

  /// Values of the attributes href and src.
  std::vector<std::string> links;
  /// The names of all elements.
  std::vector<std::string> elements;

 private:
  void fail(const std::string& what) {
    problem_ = what + ": " + page_.substr(at_ < 40 ? 0 : at_ - 40, 100);
  }

  void read_text() {
    const bool raw = !open_.empty() && (open_.back() == "style" || open_.back() == "script");
    const std::size_t end = raw ? page_.find("</" + open_.back(), at_) : page_.find('<', at_);
    const std::string text = page_.substr(at_, end - at_);
    if (!raw) check_references(text);
    for (const char c : text) {
      if (static_cast<unsigned char>(c) < ' ' && c != '\n') fail("control character");
    }
    at_ = std::min(end, page_.size());
  }

  void check_references(const std::string& text) {
    if (text.find('>') != std::string::npos) fail("bare >");
    for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
      const std::string reference = text.substr(at, text.find(';', at) - at + 1);
      const std::array<std::string, 5> known = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
      if (std::find(known.begin(), known.end(), reference) == known.end()) fail("bare &");
    }
  }

  std::string read_name() {
    const std::size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(page_[at_])) != 0 || page_[at_] == '-') ++at_;
    if (at_ == begin) fail("name expected");
    return page_.substr(begin, at_ - begin);
  }

  void read_tag() {
    ++at_;
    if (page_[at_] == '/') {
      ++at_;
      const std::string name = read_name();
      if (open_.empty() || open_.back() != name) return fail("</" + name + "> does not match");
      open_.pop_back();
      if (page_[at_++] != '>') fail("> expected");
      return;
    }
    const std::string name = read_name();
    elements.push_back(name);
    while (problem_.empty() && page_[at_] == ' ') {
      ++at_;
      read_attribute();
    }
    if (page_[at_++] != '>') return fail("> expected");
    const std::array<std::string, 4> empty = {"meta", "img", "br", "link"};
    if (std::find(empty.begin(), empty.end(), name) == empty.end()) open_.push_back(name);
  }

  void read_attribute() {
    const std::string name = read_name();
    if (page_[at_] != '=') return;
    if (page_[at_ + 1] != '"') return fail("quote expected");
    const std::size_t end = page_.find('"', at_ + 2);
    const std::string value = page_.substr(at_ + 2, end - at_ - 2);
    check_references(value);
    if (value.find('<') != std::string::npos) fail("bare <");
    if (name == "href" || name == "src") links.push_back(value);
    if (name == "id" && std::count(ids_.begin(), ids_.end(), value) > 0) fail("two ids");
    if (name == "id") ids_.push_back(value);
    if (name.starts_with("on")) fail("event handler");
    at_ = end + 1;
  }

  std::string page_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  std::vector<std::string> ids_;
  std::string problem_;
};

std::string decoded(const std::string& url) {
  std::string path;
  for (std::size_t i = 0; i < url.size(); ++i) {
    if (url[i] != '%') {
      path += url[i];
      continue;
    }
    path += static_cast<char>(std::stoi(url.substr(i + 1, 2), nullptr, 16));
    i += 2;
  }
  return path;
}

// A folder that a student may hand in.
constexpr const char* kHostile = "<script>alert('x')<_script> & \"50%\" #1?";

grade::GradedRun run_with(std::uint64_t seed, std::vector<std::string> faults) {
  grade::GradedRun run;
  run.world = "maze";
  run.seed = seed;
  run.folder = "maze_seed" + std::to_string(seed);
  run.ending = grade::Ending::kTimeOver;
  run.faults = std::move(faults);
  run.measures.path_length_m = 10.0;
  run.measures.collisions = static_cast<int>(run.faults.size());
  return run;
}

class HtmlReport : public testing::Test {
 protected:
  HtmlReport() {
    grade::Task task;
    task.name = "maze";
    task.arguments = {"--goal=1 m"};
    result_.tasks = {task};
    SubmissionResult ada;
    ada.id = "ada";
    ada.name = "Ada <b>";
    ada.folder = "submissions/ada";
    ada.build = {true, "", "build/source/robot", "build.log", 2.0};
    ada.grades = {{task, {"robot"}, {}, true}};
    ada.grades.front().runs = {run_with(1, {}), run_with(2, {"2 collisions", "too late & <slow>"}),
                               run_with(3, {"2 collisions"})};
    ada.grades.front().runs[2].ending = grade::Ending::kSignal;
    ada.points = 33.5;
    ada.most_points = 100.0;
    SubmissionResult hostile;
    hostile.id = kHostile;
    hostile.folder = std::string("submissions/") + kHostile;
    hostile.build.reason = "does not compile: <script>";
    hostile.build.log = "build.log";
    SubmissionResult missing;
    missing.id = "zoe";
    missing.folder = "submissions/zoe";
    missing.handed_in = false;
    missing.build.reason = "nothing was handed in";
    result_.submissions = {hostile, ada, missing};
    result_.pairs = {{0, 1, 3, 2, 0.004, "pairs/0 1.png"}};
    for (const char* seed : {"1", "2", "3"}) {
      folder_.write(std::string("submissions/ada/maze/maze_seed") + seed + "/scene.png", "png");
    }
    for (const char* seed : {"1", "3"}) {
      folder_.write(std::string("submissions/ada/maze/maze_seed") + seed + "/plot.png", "png");
    }
    folder_.write("submissions/ada/maze/maze_seed2/program.log",
                  "start\n\x1b[31m</pre><script>alert(1)</script>\x1b[0m\nlast & least\n");
    folder_.write("submissions/ada/build.log", "");
    folder_.write(hostile.folder + "/build.log",
                  "first\n" + std::string(200, '\n') + "main.cc:1: error: vector<int>\x07\n");
    folder_.write("pairs/0 1.png", "png");
    write_html_report(result_, folder_.path());
  }

  [[nodiscard]] std::string page_of(const std::string& id) const {
    return text_of(folder_.path() / "submissions" / id / "index.html");
  }

  TemporaryFolder folder_;
  ClassResult result_;
};

TEST_F(HtmlReport, Pages_AreWellFormedAndLinksExist) {
  for (const std::string& page :
       {std::string("index.html"), std::string("submissions/ada/index.html"),
        "submissions/" + std::string(kHostile) + "/index.html",
        std::string("submissions/zoe/index.html")}) {
    PageChecker checker(text_of(folder_.path() / page));
    EXPECT_EQ(checker.problem(), "") << page;
    EXPECT_FALSE(checker.links.empty()) << page;
    for (const std::string& link : checker.links) {
      if (link.starts_with('#')) continue;
      const fs::path target = (folder_.path() / page).parent_path() / decoded(link);
      EXPECT_TRUE(fs::is_regular_file(target)) << page << ": " << link;
    }
  }
}

TEST_F(HtmlReport, TextsOfSubmissions_StayText) {
  // The overview has one script, its own; pages of submissions have none.
  const auto scripts = [](const std::string& text) {
    PageChecker checker(text);
    EXPECT_EQ(checker.problem(), "");
    return std::count(checker.elements.begin(), checker.elements.end(), "script");
  };
  EXPECT_EQ(scripts(text_of(folder_.path() / "index.html")), 1);
  EXPECT_EQ(scripts(page_of("ada")), 0);
  EXPECT_EQ(scripts(page_of(kHostile)), 0);
  EXPECT_THAT(page_of("ada"),
              HasSubstr("&lt;/pre&gt;&lt;script&gt;alert(1)&lt;/script&gt;\nlast &amp; "
                        "least\n</pre>"));
  EXPECT_THAT(page_of("ada"), Not(HasSubstr("\x1b")));
  EXPECT_THAT(page_of("ada"), Not(HasSubstr("script-src")));
  EXPECT_THAT(page_of(kHostile), HasSubstr("vector&lt;int&gt;?\n"));
}

TEST_F(HtmlReport, Ranking_BestFirstWithEqualRanks) {
  const std::string page = text_of(folder_.path() / "index.html");
  const std::size_t ada = page.find("data-value=\"1\">1</td>");
  const std::size_t second = page.find("data-value=\"2\">2</td>");
  ASSERT_NE(ada, std::string::npos);
  EXPECT_LT(ada, second);
  EXPECT_NE(page.find("data-value=\"2\">2</td>", second + 1), std::string::npos);  // 0 points, too
  EXPECT_THAT(page, HasSubstr("1 of 3</td>"));
  EXPECT_THAT(page,
              HasSubstr("<b>3</b> submissions</li><li><b>1</b> compile</li><li><b>0</b> pass"));
  EXPECT_THAT(page, HasSubstr("alike in 2 of 3 runs"));
  EXPECT_THAT(page, HasSubstr("like <bdi>ada</bdi>"));
}

TEST_F(HtmlReport, SubmissionThatFails_HasReasonsPicturesOutputAndCommand) {
  const std::string page = page_of("ada");
  EXPECT_THAT(page, HasSubstr("the program crashed: a debugger shows the line <span "
                              "class=\"faint\">(maze, seed 3)"));
  EXPECT_THAT(page, HasSubstr("2 collisions <span class=\"faint\">(maze, seed 2; maze, seed 3)"));
  EXPECT_THAT(page, HasSubstr("too late &amp; &lt;slow&gt;"));
  EXPECT_THAT(page, HasSubstr("Best run: maze, seed 1, passed"));
  EXPECT_THAT(page, HasSubstr("Worst run: maze, seed 2, failed"));
  EXPECT_THAT(page, HasSubstr("What the program printed in maze, seed 2"));
  EXPECT_THAT(page, HasSubstr("playpen run maze --seed 2 --isolated=required -- ./robot "
                              "&#39;--goal=1 m&#39;</pre>"));
  EXPECT_THAT(page, HasSubstr("<b>33.5</b> of 100.0 points"));
}

TEST_F(HtmlReport, Charts_OfShownRunsThatHaveThem) {
  const std::string page = page_of("ada");
  EXPECT_THAT(
      page, HasSubstr("<a href=\"maze/maze_seed1/plot.png\"><img loading=\"lazy\" "
                      "src=\"maze/maze_seed1/plot.png\" alt=\"Charts of maze, seed 1: speed, turn "
                      "rate, clearance and path length over time, and the trajectory; path 10.0 m, "
                      "0 collisions\"></a></div><figcaption>Best run: maze, seed 1, passed</f"));
  EXPECT_THAT(page, Not(HasSubstr("maze_seed2/plot.png"))) << "the worst run has no charts";
  EXPECT_THAT(page, Not(HasSubstr("maze_seed3/plot.png"))) << "neither the best nor the worst";
  const fs::path charts = folder_.path() / "submissions/ada/maze/maze_seed1/plot.png";
  fs::remove(charts);
  fs::create_symlink(folder_.path() / "pairs/0 1.png", charts);
  write_html_report(result_, folder_.path());
  EXPECT_THAT(page_of("ada"), Not(HasSubstr("over time")));
}

TEST_F(HtmlReport, ShownRuns_BestFirstAndEachOnce) {
  grade::Grade grade = result_.submissions[1].grades.front();
  const auto seeds = [&grade] {
    std::vector<std::uint64_t> all;
    for (const grade::GradedRun* run : shown_runs(grade)) all.push_back(run->seed);
    return all;
  };
  EXPECT_THAT(seeds(), ElementsAre(1, 2));
  grade.runs.resize(1);
  EXPECT_THAT(seeds(), ElementsAre(1));
  grade.runs.push_back(run_with(2, {}));
  EXPECT_THAT(seeds(), ElementsAre(1)) << "equal runs";
  grade.runs.clear();
  EXPECT_THAT(seeds(), IsEmpty());
}

TEST_F(HtmlReport, PageOfAStudent_ShowsNothingOfOthers) {
  EXPECT_THAT(page_of("ada"), Not(HasSubstr("alert(&#39;x&#39;)")));
  EXPECT_THAT(page_of("ada"), Not(HasSubstr("#alike")));
  EXPECT_THAT(page_of("ada"), Not(HasSubstr("over each other")));
}

TEST_F(HtmlReport, NoProgram_SaysWhyAndShowsTheCompiler) {
  EXPECT_THAT(page_of(kHostile),
              HasSubstr("There is no program: does not compile: &lt;script&gt;"));
  EXPECT_THAT(page_of(kHostile), HasSubstr("What the compiler printed"));
  EXPECT_THAT(page_of(kHostile), HasSubstr("last lines of <a href=\"build.log\">"));
  EXPECT_THAT(page_of("zoe"), HasSubstr("There is no program: nothing was handed in"));
  for (const std::string& words : {std::string("does not compile"), std::string("handed in")}) {
    const std::string page = page_of(words == "handed in" ? "zoe" : kHostile);
    EXPECT_EQ(page.find(words), page.rfind(words)) << words << " is there once";
  }
  EXPECT_THAT(page_of("zoe"), Not(HasSubstr("What the compiler printed")));
}

TEST_F(HtmlReport, SameClass_GivesTheSamePages) {
  const std::string first = text_of(folder_.path() / "index.html") + page_of("ada");
  write_html_report(result_, folder_.path());
  EXPECT_EQ(text_of(folder_.path() / "index.html") + page_of("ada"), first);
}

TEST(PageChecker, BrokenPages_AreFound) {
  const auto problem = [](const std::string& body) {
    return PageChecker("<!DOCTYPE html>\n" + body).problem();
  };
  EXPECT_EQ(problem("<p>a &amp; b</p>"), "");
  for (const char* body : {"<p>", "</p>", "<p></b>", "a & b", "a &nbsp; b", "<p id=a></p>",
                           "<p id=\"a\"></p><p id=\"a\"></p>", "<p onclick=\"x\"></p>", "a > b",
                           "<p title=\"<\"></p>", "< p", "a \x07"}) {
    EXPECT_NE(problem(body), "") << body;
  }
}

TEST(HtmlText, TerminalOutput_BecomesText) {
  EXPECT_EQ(terminal_text("a\tb\n"), "a    b\n");
  EXPECT_EQ(terminal_text("\x1b[1;31mred\x1b[0m"), "red");
  EXPECT_EQ(terminal_text("\x1b]0;title\x07text"), "text");
  EXPECT_EQ(terminal_text("\x1b]8;;http://x\x1b\\link"), "link");
  EXPECT_EQ(terminal_text("\x1b]never ends\nnext"), "\nnext");
  EXPECT_EQ(terminal_text("\x1b(Btext\x1b="), "text");
  EXPECT_EQ(terminal_text("10 %\r20 %\r\nend"), "20 %\nend");
  EXPECT_EQ(terminal_text("ab\bc"), "ac");
  EXPECT_EQ(terminal_text(std::string("a\0b\x7f", 4)), "a?b?");
  EXPECT_EQ(terminal_text("cut \x1b"), "cut ");
  EXPECT_EQ(terminal_text("cut \x1b[3"), "cut ");
}

TEST(HtmlText, Escapes_CoverAllSpecialCharacters) {
  EXPECT_EQ(html_escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(html_escaped("\xc3\xa4\xff\x01"), "\xc3\xa4\\xff?");
  EXPECT_EQ(html_escaped("\xc2\x9b"
                         "0m\xc2\xb0"),
            "?0m\xc2\xb0");
  EXPECT_EQ(url_of("a b/<c>#?%\".png"), "a%20b/%3Cc%3E%23%3F%25%22.png");
  EXPECT_EQ(url_of("\xc3\xa4-._~"), "%C3%A4-._~");
}

TEST(HtmlText, LongLog_OnlyItsEnd) {
  const TemporaryFolder folder;
  std::string lines;
  for (int i = 1; i <= 30; ++i) lines += std::to_string(i) + "\n";
  const LogTail three = tail_of(folder.write("a.log", lines), 3);
  EXPECT_EQ(three.text, "28\n29\n30\n");
  EXPECT_FALSE(three.is_whole);
  EXPECT_TRUE(tail_of(folder / "a.log", 30).is_whole);
  // Of a line of 2000 bytes, 1500 are read, and 500 shown.
  const LogTail wide = tail_of(folder.write("b.log", std::string(2000, 'x')), 3);
  EXPECT_EQ(wide.text, std::string(500, 'x') + "...\n");
  EXPECT_EQ(tail_of(folder.write("c.log", ""), 3).text, "");
  EXPECT_EQ(tail_of(folder / "none.log", 3).text, "");
  fs::create_symlink(folder / "a.log", folder / "link.log");
  EXPECT_EQ(tail_of(folder / "link.log", 3).text, "");
}

}  // namespace
