// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Files and functions are small enough to read in one sitting. Generated headers do not count, and
// neither do tests, which are lists of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFileLines = 700;
constexpr std::size_t kFunctionLines = 80;

struct Excuse {
  std::size_t lines;  // it may have, and no more
  const char* reason;
};

// Functions, identified by file and the line of their opening brace. This list may only shrink.
const std::map<std::string, Excuse>& excused_functions() {
  static const std::map<std::string, Excuse> excused = {
      {"apps/playpen/completion.cpp: std::string bash_script(const CommandLine& line) {",
       {84, "most of it is the text of a script"}},
  };
  return excused;
}

struct Function {
  std::string first_line;
  std::size_t lines;
};

/// For each line, the number of braces that it opens minus the number that it closes, ignoring
/// string literals and comments.
std::vector<int> braces_of(const std::vector<std::string>& lines) {
  std::vector<int> braces;
  std::string raw_end;  // of the raw text that goes on, if one does
  for (const std::string& line : lines) {
    int& open = braces.emplace_back(0);
    std::size_t i = 0;
    while (i < line.size()) {
      if (!raw_end.empty()) {
        const std::size_t end = line.find(raw_end, i);
        if (end == std::string::npos) break;
        i = end + raw_end.size();
        raw_end.clear();
      } else if (line.compare(i, 2, "//") == 0) {
        break;
      } else if (line.compare(i, 2, "R\"") == 0) {
        const std::size_t begin = line.find('(', i);
        raw_end = ')' + line.substr(i + 2, begin - i - 2) + '"';
        i = begin + 1;
      } else if (line[i] == '"' ||
                 (line[i] == '\'' && (i == 0 || std::isalnum(line[i - 1]) == 0))) {
        const char quote = line[i++];
        while (i < line.size() && line[i] != quote) i += line[i] == '\\' ? 2 : 1;
        ++i;
      } else {
        open += line[i] == '{' ? 1 : (line[i] == '}' ? -1 : 0);
        ++i;
      }
    }
  }
  return braces;
}

/// Functions in a source formatted by clang-format: from the line that ends with the opening brace
/// to the closing brace. Statements and lambdas may look like functions, but they are shorter than
/// the function that contains them.
std::vector<Function> functions_of(const std::vector<std::string>& lines) {
  const std::vector<int> braces = braces_of(lines);
  std::vector<Function> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool is_comment = lines[i].find_first_not_of(' ') == lines[i].find("//");
    if (is_comment || !lines[i].ends_with(" {") || lines[i].find(')') == std::string::npos)
      continue;
    std::size_t end = i;
    int open = 1;  // also if the line closes another one
    while (open > 0 && end + 1 < lines.size()) open += braces[++end];
    found.push_back({lines[i].substr(lines[i].find_first_not_of(' ')), end - i + 1});
  }
  return found;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Sources of libraries and programs: path in the repository -> lines.
std::map<std::string, std::vector<std::string>> sources() {
  const fs::path root(PLAYPEN_SOURCE_DIR);
  std::map<std::string, std::vector<std::string>> all;
  for (const char* folder : {"libsim", "libplayerlike", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp" && extension != ".cc") continue;
      all.emplace(fs::relative(entry.path(), root).generic_string(), lines_of(entry.path()));
    }
  }
  return all;
}

TEST(Size, FilesHave700LinesAtMost) {
  for (const auto& [path, lines] : sources()) {
    EXPECT_LE(lines.size(), kFileLines) << path << ": divide it along what its parts own";
  }
}

TEST(Size, FunctionsHave80LinesAtMost) {
  for (const auto& [path, lines] : sources()) {
    for (const Function& function : functions_of(lines)) {
      const std::string name = path + ": " + function.first_line;
      const auto excuse = excused_functions().find(name);
      const std::size_t most =
          excuse == excused_functions().end() ? kFunctionLines : excuse->second.lines;
      EXPECT_LE(function.lines, most) << name;
      EXPECT_TRUE(excuse == excused_functions().end() || function.lines > kFunctionLines)
          << name << " needs no excuse any more: take it off the list";
    }
  }
}

TEST(Size, ExcusesAreForWhatIsThere) {
  const auto all = sources();
  for (const auto& [name, excuse] : excused_functions()) {
    const auto source = all.find(name.substr(0, name.find(": ")));
    ASSERT_TRUE(source != all.end()) << name << " (" << excuse.reason << ")";
    const auto functions = functions_of(source->second);
    EXPECT_TRUE(std::any_of(functions.begin(), functions.end(), [&](const Function& function) {
      return name.ends_with(": " + function.first_line);
    })) << name;
  }
}

// A test of the measure itself: one that finds nothing must fail.
TEST(SizeRules, MeasureFunctions) {
  const auto found = functions_of({"namespace {", "int one() { return 1; }", "int two(int a,",
                                   "        int b) const {", "  if (a == '}') return 0;  // }",
                                   "  return R\"(", "}}", ")\";", "}", "class C {",
                                   "  void three() {", "  }", "};", "}  // namespace"});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first_line, "int b) const {");
  EXPECT_EQ(found[0].lines, 6U);
  EXPECT_EQ(found[1].first_line, "void three() {");
  EXPECT_EQ(found[1].lines, 2U);
}

}  // namespace
