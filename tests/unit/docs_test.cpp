// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Links of the documentation point to existing files and headings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

const fs::path kRoot(PLAYPEN_SOURCE_DIR);

/// The text without fenced blocks and code in backticks; line breaks are kept.
std::string prose_of(const std::string& text) {
  std::string prose;
  std::istringstream lines(text);
  bool in_fence = false;
  for (std::string line; std::getline(lines, line); prose += '\n') {
    if (line.starts_with("```")) {
      in_fence = !in_fence;
    } else if (!in_fence) {
      static const std::regex kCode("`[^`]*`");
      prose += std::regex_replace(line, kCode, "code");
    }
  }
  return prose;
}

/// Targets of links and pictures, except links to the web.
std::vector<std::string> links_of(const std::string& text) {
  static const std::regex kLink(R"(\]\(([^()\s]+(\([^()\s]*\))?)\))");
  const std::string prose = prose_of(text);
  std::vector<std::string> links;
  for (std::sregex_iterator it(prose.begin(), prose.end(), kLink), end; it != end; ++it) {
    const std::string target = (*it)[1];
    if (!target.starts_with("https://") && !target.starts_with("http://")) links.push_back(target);
  }
  return links;
}

/// The anchor of a heading: lower case, blanks become hyphens, other characters are dropped.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0 || c == '-' || c == '_') {
      anchor += static_cast<char>(std::tolower(u));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  std::istringstream lines(text);
  bool in_fence = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) in_fence = !in_fence;
    const auto level = line.find_first_not_of('#');
    if (in_fence || level == 0 || level == std::string::npos || line[level] != ' ') continue;
    anchors.insert(anchor_of(line.substr(level + 1)));
  }
  return anchors;
}

/// The broken links of a page in `file`.
std::vector<std::string> dead_links(const fs::path& file, const std::string& text) {
  std::vector<std::string> dead;
  for (const std::string& link : links_of(text)) {
    const auto hash = link.find('#');
    const std::string target = link.substr(0, hash);
    const fs::path path = target.empty() ? file : file.parent_path() / target;
    const bool there = target.empty() || fs::exists(path);
    const bool anchored =
        hash == std::string::npos ||
        (there &&
         anchors_of(target.empty() ? text : read_bytes(path)).contains(link.substr(hash + 1)));
    if (!there || !anchored) dead.push_back(link);
  }
  return dead;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot)) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  for (const char* folder : {"docs", "apps"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
  }
  return found;
}

TEST(Documentation, LinksLeadToFilesAndHeadingsThatExist) {
  const std::vector<fs::path> all = pages();
  ASSERT_GT(all.size(), 10U);
  for (const fs::path& page : all) {
    EXPECT_THAT(dead_links(page, read_bytes(page)), IsEmpty()) << page;
  }
}

TEST(Documentation, IndexListsEveryPage) {
  const fs::path docs = kRoot / "docs";
  const std::vector<std::string> listed = links_of(read_bytes(docs / "index.md"));
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(docs)) {
    const std::string page = fs::relative(entry.path(), docs).generic_string();
    if (entry.path().extension() != ".md" || page == "index.md") continue;
    EXPECT_THAT(listed, Contains(page));
  }
}

TEST(Documentation, GlossaryIsAlphabetical) {
  static const std::regex kRow("\n\\| ([^|]+) \\|");
  const std::string page = read_bytes(kRoot / "docs/glossary.md");
  std::vector<std::string> terms;
  for (std::sregex_iterator it(page.begin(), page.end(), kRow), end; it != end; ++it) {
    std::string term = (*it)[1];
    for (char& c : term) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    terms.push_back(term);
  }
  ASSERT_GT(terms.size(), 50U);
  EXPECT_TRUE(std::is_sorted(terms.begin() + 1, terms.end()));  // after the heading "term"
}

// Each row of the table runs the world that it links to.
TEST(Documentation, NamesTheWorldThatItRuns) {
  static const std::regex kRow(R"(\| \[(\w+)\]\(\.\./worlds/(\S+)\) \| `playpen run (\w+) )");
  const std::string page = read_bytes(kRoot / "docs/which_world.md");
  int rows = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), kRow), end; it != end; ++it, ++rows) {
    EXPECT_EQ((*it)[1], (*it)[3]);
    EXPECT_EQ(fs::path((*it)[2].str()).stem().string(), (*it)[3].str());
  }
  EXPECT_GT(rows, 15);
}

/// The names of all tests, "Suite.Name".
std::set<std::string> names_of_tests() {
  static const std::regex kTest(R"(\bTEST(_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_bytes(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), kTest), end; it != end; ++it) {
      names.insert((*it)[2].str() + '.' + (*it)[3].str());
    }
  }
  return names;
}

/// The tests that a page names in the last columns of its tables; '*' is a wildcard.
std::vector<std::string> tests_named_in(const std::string& page) {
  static const std::regex kName("`([A-Z][A-Za-z0-9]*\\.[A-Za-z0-9*]+)`");
  std::vector<std::string> names;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('|')) continue;
    for (std::sregex_iterator it(line.begin(), line.end(), kName), end; it != end; ++it) {
      names.push_back((*it)[1]);
    }
  }
  return names;
}

bool is_test(const std::string& name, const std::set<std::string>& tests) {
  std::string pattern;
  for (const char c : name) pattern += c == '*' ? ".*" : c == '.' ? "\\." : std::string(1, c);
  const std::regex expression(pattern);
  return std::any_of(tests.begin(), tests.end(),
                     [&](const std::string& test) { return std::regex_match(test, expression); });
}

TEST(Documentation, PromisesNameTestsThatExist) {
  const std::set<std::string> tests = names_of_tests();
  ASSERT_TRUE(is_test("Documentation.PromisesNameTestsThatExist", tests));
  ASSERT_FALSE(is_test("Documentation.PromisesNameTests", tests));
  const std::vector<std::string> named = tests_named_in(read_bytes(kRoot / "docs/trust.md"));
  EXPECT_GT(named.size(), 20U);
  for (const std::string& name : named) EXPECT_TRUE(is_test(name, tests)) << name;
}

// Tests of the checks themselves: a check that accepts everything must fail here.
TEST(DocumentationLinks, AreFoundInProseOnly) {
  EXPECT_THAT(links_of("[a](b.md) and ![c](d/e.png)\n`[f](g)`\n```\n[h](i)\n```\n[j](#k)\n"
                       "[web](https://example.org/x)\n"),
              ElementsAre("b.md", "d/e.png", "#k"));
}

TEST(DocumentationLinks, ToNothingAreDead) {
  EXPECT_THAT(dead_links(kRoot / "docs/x.md",
                         "# A b: c\n[1](no_such_page.md) [2](conventions.md)\n"
                         "[3](conventions.md#units) [4](conventions.md#nothing)\n"
                         "[5](#a-b-c) [6](#d) [7](../tests/run.sh)\n"),
              ElementsAre("no_such_page.md", "conventions.md#nothing", "#d"));
}

}  // namespace
